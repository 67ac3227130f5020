//! Temperatures that are counts of the sensor, and the formulas that would make them °C.

use crate::order_statistic::nth_smallest;

/// `°C = reading / divisor + offset`.
struct Formula {
    divisor: f64,
    offset: f64,
    /// The formula as `--columns` takes it.
    text: &'static str,
    /// Sensor or unit that it converts.
    of: &'static str,
}

const fn formula(text: &'static str, divisor: f64, offset: f64, of: &'static str) -> Formula {
    Formula {
        divisor,
        offset,
        text,
        of,
    }
}

/// Formulas of the data sheets, the most common sensors first.
const OF_COUNTS: [Formula; 8] = [
    formula("/340+36.53", 340.0, 36.53, "MPU-6050"),
    formula("/333.87+21", 333.87, 21.0, "MPU-9250, ICM-20948"),
    formula("/512+23", 512.0, 23.0, "BMI160, BMI270"),
    formula("/256+25", 256.0, 25.0, "LSM6DSO"),
    formula("/16+25", 16.0, 25.0, "LSM6DS3, LSM9DS1"),
    formula("/132.48+25", 132.48, 25.0, "ICM-42688"),
    formula("/326.8+25", 326.8, 25.0, "ICM-20602"),
    formula("/280+82.14", 280.0, 82.14, "ITG-3200"),
];
/// Other units.
const OF_UNITS: [Formula; 4] = [
    formula("-273.15", 1.0, -273.15, "kelvin"),
    formula("/100", 100.0, 0.0, "hundredths of °C"),
    formula("/10", 10.0, 0.0, "tenths of °C"),
    formula("/1000", 1000.0, 0.0, "thousandths of °C"),
];

/// A sensor in a room or near it, warm from its own current, °C.
const USUAL: std::ops::RangeInclusive<f64> = 12.0..=60.0;

findings::tuning! {
    /// Formulas of sensors that are offered.
    OFFERED: usize = 3;

    /// No thermometer jumps by as much from one row to the next, °C; counts do.
    JUMP: f64 = 2.0;
}

/// True for whole numbers that jump from row to row as no temperature in °C does.
pub(crate) fn jump(readings: &[f64]) -> bool {
    let whole = readings.iter().all(|reading| reading.fract() == 0.0);
    let steps = readings.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    whole && nth_smallest(steps, readings.len() / 2).is_some_and(|step| step >= JUMP.get())
}

/// A formula that makes °C of readings.
pub(crate) struct Offered {
    /// The columns with it.
    pub entry: String,
    /// The sensor or the unit that it belongs to.
    of: &'static str,
    /// The least and the highest temperature that it makes, °C.
    celsius: [f64; 2],
}

impl Offered {
    /// `30.0 to 30.9 °C (MPU-6050)`.
    pub fn in_words(&self) -> String {
        let [least, most] = self.celsius;
        format!("{least:.1} to {most:.1} °C ({})", self.of)
    }
}

/// The formulas that make °C of `readings`, for the column called `column`.
pub(crate) fn formulas(readings: &[f64], column: &str) -> Vec<Offered> {
    let least = readings.iter().copied().fold(f64::INFINITY, f64::min);
    let most = readings.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let whole = readings.iter().all(|reading| reading.fract() == 0.0);
    let fits = |formula: &&Formula| {
        let celsius = [least, most].map(|reading| reading / formula.divisor + formula.offset);
        celsius.iter().all(|celsius| USUAL.contains(celsius))
    };
    let of_counts = OF_COUNTS
        .iter()
        .filter(|_| whole)
        .filter(fits)
        .take(OFFERED.get());
    let of_units = OF_UNITS.iter().filter(fits).take(1);
    let offered = |formula: &Formula| Offered {
        entry: format!("{column}{}", formula.text),
        of: formula.of,
        celsius: [least, most].map(|reading| reading / formula.divisor + formula.offset),
    };
    of_counts.chain(of_units).map(offered).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_are_offered_that_give_the_temperature_of_a_room() {
        for (readings, offered) in [
            (
                [-2220.0, -1900.0],
                "temp=raw/340+36.53: 30.0 to 30.9 °C (MPU-6050)",
            ),
            (
                [1024.0, 1536.0],
                "temp=raw/512+23: 25.0 to 26.0 °C (BMI160, BMI270)",
            ),
            ([293.2, 301.7], "temp=raw-273.15: 20.1 to 28.6 °C (kelvin)"),
            (
                [2510.0, 2630.0],
                "temp=raw/100: 25.1 to 26.3 °C (hundredths of °C)",
            ),
            (
                [-16000.0, -15000.0],
                "temp=raw/280+82.14: 25.0 to 28.6 °C (ITG-3200)",
            ),
        ] {
            let found = formulas(&readings, "temp=raw");
            let found = found
                .iter()
                .map(|f| format!("{}: {}", f.entry, f.in_words()));
            let found: Vec<String> = found.collect();
            assert!(
                found.iter().any(|f| f == offered),
                "{readings:?}: {found:?}"
            );
            assert!(found.len() <= 4, "{found:?}");
        }
        assert!(formulas(&[-9e5, 9e5], "temp=raw").is_empty());
    }

    #[test]
    fn counts_within_the_range_of_temperatures_are_known_by_their_jumps() {
        let counts: Vec<f64> = (0..100).map(|k| f64::from(k % 7 * 3)).collect();
        assert!(jump(&counts));
        let whole: Vec<f64> = (0..100).map(|k| f64::from(25 + k / 20)).collect();
        assert!(!jump(&whole));
        let fine: Vec<f64> = (0..100).map(|k| 25.0 + 3.1 * f64::from(k % 2)).collect();
        assert!(!jump(&fine));
    }
}
