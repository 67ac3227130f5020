//! Numbers whose points or commas separate thousands: `982`, `-1.458` for -1458.

findings::tuning! {
    /// Whole numbers and others that a column has at least.
    LEAST: f64 = 10.0;
    /// The same as a share of its numbers.
    SHARE: f64 = 0.01;

    /// Thousands end with a zero one time in ten; numbers that are rounded to tenths or quarters nearly always do in thousandths.
    END_WITH_ZERO: f64 = 0.25;
}

/// Size of the smallest number that is written with a separator.
const THOUSAND: f64 = 1.0;

/// Returns the first number that has a separator of thousands, where all numbers of a column are written so: whole ones below
/// a thousand, and ones with three decimals from 1 on.
pub(crate) fn separated(values: impl Iterator<Item = f64>) -> Option<usize> {
    let (mut whole, mut with_point, mut end_with_zero, mut first) = (0.0, 0.0, 0.0, None);
    for (at, value) in values.enumerate() {
        let (size, thousandths) = (value.abs(), (1e3 * value).round());
        if size == size.trunc() {
            if size >= 1e3 {
                return None;
            }
            whole += f64::from(u8::from(size >= 10.0));
        } else if size < THOUSAND || (1e3 * value - thousandths).abs() > 1e-6 * size {
            return None;
        } else {
            first = first.or(Some(at));
            with_point += 1.0;
            end_with_zero += f64::from(u8::from(thousandths % 10.0 == 0.0));
        }
    }
    let count: f64 = whole + with_point;
    let enough = |part: f64| part >= LEAST.get() && part >= SHARE.get() * count;
    first.filter(|_| {
        enough(whole) && enough(with_point) && end_with_zero < END_WITH_ZERO.get() * with_point
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn swings(step: f64, unit: f64) -> impl Iterator<Item = f64> {
        (0..2000).map(move |k| (1700.0 * (0.01 * f64::from(k)).sin() / step).round() * step * unit)
    }

    #[test]
    fn thousands_are_told_from_decimals() {
        let grouped = swings(1.0, 1.0).map(|v| if v.abs() < 1e3 { v } else { v / 1e3 });
        let first = separated(grouped);
        assert!(first.is_some_and(|at| swings(1.0, 1.0).nth(at).unwrap().abs() >= 1e3));
        for decimal in [
            swings(1.0, 1.0).collect::<Vec<_>>(),
            swings(1.0, 1e-3).collect(),
            swings(1.0, 1e-1).collect(),
            swings(250.0, 1e-3).map(|v| v + 10.0).collect(),
            swings(125.0, 1e-3).map(|v| v + 10.0).collect(),
            swings(1.0, 1e-3).map(|v| v + 10.0).collect(),
        ] {
            assert_eq!(separated(decimal.into_iter()), None);
        }
    }
}
