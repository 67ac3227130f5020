//! Times of day without marks, `042659.99` for 04:26:59.99, as receivers of satellites write them: counted in seconds.

use crate::clock::even::usual_step;
use crate::rows::table::Table;
use crate::units::TimeUnit;

findings::tuning! {
    /// Seconds that the digits leap over from minute to minute.
    LEAP: f64 = 40.0;
    /// Steps that may be lost where a minute begins.
    LOST: f64 = 10.0;
}

/// Counts the stamps of `tables` in seconds, or in milliseconds of the day, where their digits are hours, minutes and seconds.
pub(crate) fn count_on(tables: &mut [Table]) {
    let in_digits = |unit: TimeUnit| {
        let may_be = |table: &Table| {
            let is_plain = !table.clock.dates && table.time_affine.is_none();
            let stated = table.stated.time.is_none_or(|stated| stated == unit);
            let stamps = [&table.accel.t, &table.gyro.t, &table.magnetometer.t];
            is_plain
                && stated
                && table.clock.origin.is_none_or(|origin| origin == 0)
                && stamps.iter().all(|t| are_digits(t, unit))
        };
        let leaps = |table: &Table| leap(&table.longer().t, unit);
        tables.iter().all(may_be) && tables.iter().any(leaps)
    };
    let units = [TimeUnit::Seconds, TimeUnit::Milliseconds];
    if let Some(unit) = units.into_iter().find(|unit| in_digits(*unit)) {
        let tables = tables.iter_mut();
        tables.for_each(|table| table.restamp(|_, t| counted(t, unit)));
    }
}

/// Hours and minutes as one number of four digits, and the seconds.
fn apart(t: f64, unit: TimeUnit) -> (f64, f64) {
    let minute = 100.0 * unit.per_second();
    let whole = (t / minute).floor();
    (whole, t - whole * minute)
}

/// The time since midnight, in the same unit.
fn counted(t: f64, unit: TimeUnit) -> f64 {
    let (whole, rest) = apart(t, unit);
    let minutes = 60.0 * (whole / 100.0).floor() + whole % 100.0;
    60.0 * unit.per_second() * minutes + rest
}

/// True if no stamp has digits that a time of day lacks.
fn are_digits(t: &[f64], unit: TimeUnit) -> bool {
    t.iter().all(|t| {
        let (whole, rest) = apart(*t, unit);
        (0.0..2400.0).contains(&whole) && whole % 100.0 < 60.0 && rest < 60.0 * unit.per_second()
    })
}

/// True if the digits leap over what a minute lacks wherever one begins, and one does.
fn leap(t: &[f64], unit: TimeUnit) -> bool {
    let Some(usual) = usual_step(t) else {
        return false;
    };
    let is_new = |pair: &&[f64]| apart(pair[0], unit).0 < apart(pair[1], unit).0;
    let goes_on = |pair: &[f64]| {
        let [before, after] = [pair[0], pair[1]];
        let step = counted(after, unit) - counted(before, unit);
        after - before > LEAP.get() * unit.per_second() && step > 0.0 && step <= LOST.get() * usual
    };
    let mut new = t.windows(2).filter(is_new).peekable();
    new.peek().is_some() && new.all(goes_on)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The digits of 04:59:30 and the following seconds, ten a second.
    fn digits(unit: f64) -> Vec<f64> {
        let of = |k: i32| match 300 {
            half if k < half => 45_930.0 + 0.1 * f64::from(k),
            half => 50_000.0 + 0.1 * f64::from(k - half),
        };
        (0..600).map(|k| unit * of(k)).collect()
    }

    #[test]
    fn digits_of_the_day_are_told_by_their_leaps() {
        for unit in [TimeUnit::Seconds, TimeUnit::Milliseconds] {
            let t = digits(unit.per_second());
            assert!(are_digits(&t, unit) && leap(&t, unit));
            let span = counted(t[599], unit) - counted(t[0], unit);
            assert!((span / unit.per_second() - 59.9).abs() < 1e-6);
        }
        // Seconds that go on, and those of less than a minute.
        let seconds: Vec<f64> = (0..900).map(|k| 0.1 * f64::from(k)).collect();
        assert!(!are_digits(&seconds, TimeUnit::Seconds));
        assert!(!leap(&seconds[..500], TimeUnit::Seconds));
        // An interruption of another length.
        let mut late = digits(1.0);
        late[300..].iter_mut().for_each(|t| *t += 7.0);
        assert!(!leap(&late, TimeUnit::Seconds));
    }
}
