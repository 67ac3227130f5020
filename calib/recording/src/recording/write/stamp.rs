//! Stamps of a recording on the clock of the file that it was read from.

use std::fmt;

const NANOSECONDS: i128 = 1_000_000_000;

/// A stamp in seconds as the file counts them: `t` itself, or to the nanosecond where the file's stamps are since 1970.
#[derive(Clone, Copy, Debug)]
pub(super) struct FileStamp {
    /// Stamp in the file at `t = 0`, ns.
    pub zero_ns: i128,
    /// Stamp in the recording, s.
    pub t: f64,
}

impl FileStamp {
    fn nanoseconds(self) -> i128 {
        self.zero_ns + (self.t * NANOSECONDS as f64).round() as i128
    }

    /// The stamp in one double: of seconds since 1970 it keeps a quarter of a microsecond.
    pub fn seconds(self) -> f64 {
        match self.zero_ns {
            0 => self.t,
            _ => self.nanoseconds() as f64 / NANOSECONDS as f64,
        }
    }
}

impl fmt::Display for FileStamp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.zero_ns == 0 {
            return write!(f, "{}", self.t);
        }
        let all = self.nanoseconds();
        let sign = if all < 0 { "-" } else { "" };
        let [seconds, decimals] = [all.abs() / NANOSECONDS, all.abs() % NANOSECONDS];
        let decimals = format!(".{decimals:09}");
        let decimals = decimals.trim_end_matches('0').trim_end_matches('.');
        write!(f, "{sign}{seconds}{decimals}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stamps_since_1970_keep_their_nanoseconds() {
        let shown = |zero_ns, t| FileStamp { zero_ns, t }.to_string();
        assert_eq!(shown(0, 0.1), "0.1");
        let zero = 1_764_370_000_512_345_678;
        assert_eq!(shown(zero, 0.0), "1764370000.512345678");
        assert_eq!(shown(zero, 3600.01), "1764373600.522345678");
        assert_eq!(shown(zero, 0.487_654_322), "1764370001");
        assert_eq!(shown(-2 * NANOSECONDS, 0.5), "-1.5");
    }
}
