//! A line through the offsets of turns that outliers do not bend.

use crate::averages::NORMAL_OVER_MEDIAN;

findings::tuning! {
    /// Turns that a drift takes.
    FEWEST: usize = 8;
    /// Turns whose offset is known better than this share of the usual count no more.
    NO_BETTER: f64 = 0.3;
    /// Turns that miss the line by so many times the usual count half.
    OUTLIER: f64 = 2.5;
    /// Rounds of the weights.
    ROUNDS_OF_WEIGHTS: usize = 30;
}

/// An offset that changes with time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    /// Seconds a second.
    pub slope: f64,
    /// Where `at_middle` holds, s.
    pub middle: f64,
    /// The offset there, s.
    pub at_middle: f64,
}

impl Line {
    pub fn at(&self, t: f64) -> f64 {
        self.at_middle + self.slope * (t - self.middle)
    }
}

/// The offset that a turn shows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Offset {
    /// Middle of the turn, s.
    pub t: f64,
    /// Remaining delay of the gyroscope's clock, s.
    pub value: f64,
    /// Standard error if the force were off by chance in every bin, s.
    pub error: f64,
}

/// The reading at a share of all of them in order; 0 without any.
pub(super) fn quantile(values: &mut [f64], share: f64) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let place = (share * (values.len() - 1) as f64) as usize;
    *values.select_nth_unstable_by(place, f64::total_cmp).1
}

/// The robust line through the offsets, and the standard error of its slope by how they scatter about it, each as if
/// the line had been drawn without it (MacKinnon and White 1985, HC3).
pub(super) fn line_through(offsets: &[Offset], middle: f64) -> Option<(Line, f64)> {
    if offsets.len() < FEWEST.get() {
        return None;
    }
    let usual = quantile(
        &mut offsets.iter().map(|o| o.error).collect::<Vec<_>>(),
        0.5,
    );
    let errors: Vec<f64> = offsets
        .iter()
        .map(|o| o.error.hypot(NO_BETTER.get() * usual))
        .collect();
    let mut weights: Vec<f64> = errors.iter().map(|e| e.powi(-2)).collect();
    let sum = |weights: &[f64], of: &dyn Fn(&Offset) -> f64| -> f64 {
        weights.iter().zip(offsets).map(|(w, o)| w * of(o)).sum()
    };
    let mut fitted = None;
    for _ in 0..ROUNDS_OF_WEIGHTS.get() {
        let whole = sum(&weights, &|_| 1.0);
        let t = sum(&weights, &|o| o.t) / whole;
        let mean = sum(&weights, &|o| o.value) / whole;
        let spread = sum(&weights, &|o| (o.t - t).powi(2));
        if spread.is_nan() || spread <= 0.0 {
            return None;
        }
        let slope = sum(&weights, &|o| (o.t - t) * (o.value - mean)) / spread;
        let left = |o: &Offset| o.value - mean - slope * (o.t - t);
        let apart = |weight: f64, o: &Offset| {
            let own = weight / whole + weight * (o.t - t).powi(2) / spread;
            weight * (o.t - t) * left(o) / (1.0 - own).max(0.1)
        };
        let square: f64 = weights
            .iter()
            .zip(offsets)
            .map(|(w, o)| apart(*w, o).powi(2))
            .sum();
        let line = Line {
            slope,
            middle,
            at_middle: mean + slope * (middle - t),
        };
        fitted = Some((line, square.sqrt() / spread));
        let ratios: Vec<f64> = offsets
            .iter()
            .zip(&errors)
            .map(|(o, e)| left(o) / e)
            .collect();
        let mut sizes: Vec<f64> = ratios.iter().map(|z| z.abs()).collect();
        let scale = OUTLIER.get() * (NORMAL_OVER_MEDIAN * quantile(&mut sizes, 0.5)).max(1e-6);
        for ((weight, error), z) in weights.iter_mut().zip(&errors).zip(&ratios) {
            *weight = error.powi(-2) / (1.0 + (z / scale).powi(2));
        }
    }
    fitted
}
