//! Columns with a scale, an offset or the other sign: `temp=raw*0.00294+36.53`, `ax=-acc_x`.

/// Linear conversion of a cell: `scale cell + offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Affine {
    /// Factor.
    pub scale: f64,
    /// Summand, in the unit of the result.
    pub offset: f64,
}

/// The name in `column`, and what is made of its cells; `None` for a name alone.
pub(crate) fn take_apart(column: &str) -> Option<(&str, Affine)> {
    let (sign, rest) = match column.strip_prefix('-') {
        Some(rest) => (-1.0, rest.trim()),
        None => (1.0, column.trim()),
    };
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|v| v.is_finite());
    // The offset is what follows the last sign that no exponent has before it.
    let bytes = rest.as_bytes();
    let signs = (1..bytes.len())
        .rev()
        .filter(|&at| matches!(bytes[at], b'+' | b'-'));
    let mut splits = signs.filter(|&at| !matches!(bytes[at - 1], b'e' | b'E'));
    let with_offset = splits.find_map(|at| {
        let digits = rest[at + 1..].trim_start();
        let offset = number(digits).filter(|_| !digits.starts_with(['+', '-']))?;
        Some((
            &rest[..at],
            if bytes[at] == b'-' { -offset } else { offset },
        ))
    });
    let (product, offset) = with_offset.unwrap_or((rest, 0.0));
    let scaled = product
        .rsplit_once('*')
        .and_then(|(name, factor)| Some((name, number(factor)?)));
    let divided = product
        .rsplit_once('/')
        .and_then(|(name, divisor)| Some((name, 1.0 / number(divisor).filter(|d| *d != 0.0)?)));
    let (name, scale) = scaled.or(divided).unwrap_or((product, 1.0));
    let affine = Affine {
        scale: sign * scale,
        offset,
    };
    let plain = affine
        == (Affine {
            scale: 1.0,
            offset: 0.0,
        });
    (!plain && !name.trim().is_empty()).then(|| (name.trim(), affine))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_signs_factors_and_offsets_are_told_apart() {
        let parts = |column| take_apart(column).map(|(name, a)| (name, a.scale, a.offset));
        assert_eq!(parts("raw*0.00294+36.53"), Some(("raw", 0.00294, 36.53)));
        assert_eq!(parts("-acc_x"), Some(("acc_x", -1.0, 0.0)));
        assert_eq!(parts("-7 * 2e-3"), Some(("7", -2e-3, 0.0)));
        assert_eq!(parts("raw/340+36.53"), Some(("raw", 1.0 / 340.0, 36.53)));
        assert_eq!(parts("T-273.15"), Some(("T", 1.0, -273.15)));
        for name in ["acc_x", "3", "acc-x", "a*b", "m/s"] {
            assert_eq!(parts(name), None, "{name}");
        }
    }
}
