//! Evidence that rows with different labels come from different devices: the order of labels in time, and the differences of readings.

use nalgebra::Vector3;

use crate::averages::median;

findings::tuning! {
    /// Changes of label below which a comparison of neighbours says nothing.
    CHANGES: usize = 20;
    /// Rows that are compared: half an hour's at 100 Hz.
    LOOKED_AT: usize = 200_000;
    /// Rows of one label that may follow one another where devices send by turns.
    RUN: usize = 20;
}

/// The rows of one sensor: stamps in the order of the text, readings, and labels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rows<'a> {
    /// Stamps as they are written.
    pub t: &'a [f64],
    /// Readings.
    pub values: &'a [Vector3<f64>],
    /// Labels.
    pub labels: &'a [u8],
}

/// Order of the labels in time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Order {
    /// Labels change often.
    pub mixed: bool,
    /// Labels come again in one order, as those of devices that send at fixed rates.
    pub in_turn: bool,
    /// Time stands still or goes back where they change, and hardly anywhere else.
    pub apart: bool,
    /// Each label has its rows in one piece.
    pub in_blocks: bool,
    /// Time goes back wherever a block ends.
    pub begins_again: bool,
}

impl Rows<'_> {
    /// The period, in rows, in which nearly all labels come again.
    fn period(&self) -> Option<usize> {
        let rows = self.labels.len();
        (2..=RUN.get()).find(|period| {
            let again = (*period..rows).filter(|i| self.labels[*i] == self.labels[i - period]);
            10 * again.count() >= 9 * rows
        })
    }

    /// Returns the order of the labels, of which `count` are different.
    pub fn order(&self, count: usize) -> Order {
        let rows = self.labels.len();
        let changes: Vec<usize> = (1..rows)
            .filter(|&i| self.labels[i] != self.labels[i - 1])
            .collect();
        let stands = |i: usize| self.t[i] <= self.t[i - 1];
        let at_changes = changes.iter().filter(|&&i| stands(i)).count();
        let in_all = (1..rows).filter(|&i| stands(i)).count();
        let in_blocks = changes.len() + 1 == count;
        let mixed = changes.len() * RUN.get() >= rows;
        Order {
            mixed,
            in_turn: mixed && self.period().is_some(),
            apart: !changes.is_empty()
                && at_changes * 5 >= changes.len() * 2
                && at_changes * 10 >= in_all * 9,
            in_blocks,
            begins_again: in_blocks && at_changes == changes.len() && !changes.is_empty(),
        }
    }

    /// Returns the distance of a row from the one before it, which has another label, over its distance from the last row with its own
    /// label (medians): about 1 or less for one device. A tenth of the offset between labels over its standard error counts instead where
    /// that is larger: the offset may be small against the noise.
    pub fn difference(&self) -> f64 {
        let (ratio, offset) = self.differences();
        ratio.max(offset)
    }

    /// The first of the two that [`Rows::difference`] looks at.
    pub fn ratio(&self) -> f64 {
        self.differences().0
    }

    fn differences(&self) -> (f64, f64) {
        let rows = self.labels.len().min(LOOKED_AT.get());
        let mut last: [Option<usize>; 256] = [None; 256];
        let (mut to_other, mut to_own) = (Vec::new(), Vec::new());
        let mut steps: Vec<(bool, Vector3<f64>)> = Vec::new();
        let first = self.labels.first().copied().unwrap_or_default();
        for i in 0..rows {
            let label = self.labels[i];
            if let Some(own) = last[usize::from(label)]
                && own + 1 < i
            {
                let step = self.values[i] - self.values[i - 1];
                to_other.push(step.norm());
                to_own.push((self.values[i] - self.values[own]).norm());
                // From the first label to others, and back.
                if label == first || self.labels[i - 1] == first {
                    steps.push((label == first, step));
                }
            }
            last[usize::from(label)] = Some(i);
        }
        if to_other.len() < CHANGES.get() {
            return (0.0, 0.0);
        }
        let (Some(other), Some(own)) = (median(to_other), median(to_own)) else {
            return (0.0, 0.0);
        };
        let ratio = match own > 0.0 {
            true => other / own,
            false if other > 0.0 => f64::INFINITY,
            false => 0.0,
        };
        // A vibration near half the rate takes turns too, and is at its other end soon after.
        let lasts = 6.0 * lasting(&steps) / own.max(f64::MIN_POSITIVE);
        (ratio.min(lasts), offset(&steps, own))
    }

    /// Returns the smallest distance between two labels' static means of the gyroscope, over the median distance of means within a
    /// label; 0 if there are too few means.
    pub fn difference_at_rest(&self, count: usize) -> f64 {
        let mut means: Vec<Vec<Vector3<f64>>> = vec![Vec::new(); count];
        let mut windows: Vec<(usize, f64, Vector3<f64>)> = Vec::new();
        let rows = self.labels.len().min(LOOKED_AT.get());
        for from in (0..rows.saturating_sub(WINDOW.get())).step_by(WINDOW.get()) {
            let label = self.labels[from];
            let window = from..from + WINDOW.get();
            if self.labels[window.clone()].iter().any(|l| *l != label) {
                continue;
            }
            let values = &self.values[window];
            let mean = values.iter().sum::<Vector3<f64>>() / WINDOW.get() as f64;
            let spread: f64 = values.iter().map(|v| (v - mean).norm_squared()).sum();
            windows.push((usize::from(label), spread, mean));
        }
        for (label, means) in means.iter_mut().enumerate() {
            let of = || windows.iter().filter(move |w| w.0 == label);
            let spreads: Vec<f64> = of().map(|w| w.1).collect();
            let Some(quiet) = crate::averages::quantile(&spreads, 0.1) else {
                continue;
            };
            means.extend(of().filter(|w| w.1 <= 4.0 * quiet).map(|w| w.2));
        }
        let centre = |means: &[Vector3<f64>]| {
            Vector3::from_fn(|axis, _| median(means.iter().map(|m| m[axis])).unwrap_or_default())
        };
        means.retain(|means| means.len() >= 5);
        if means.len() < 2 {
            return 0.0;
        }
        let centres: Vec<Vector3<f64>> = means.iter().map(|means| centre(means)).collect();
        let within = means.iter().zip(&centres);
        let within =
            within.flat_map(|(means, centre)| means.iter().map(move |m| (m - centre).norm()));
        let pairs = centres.iter().enumerate();
        let between = pairs.flat_map(|(i, a)| centres[..i].iter().map(move |b| (a - b).norm()));
        let between = between.fold(f64::INFINITY, f64::min);
        match median(within) {
            Some(within) if within > 0.0 && between.is_finite() => between / within,
            _ => 0.0,
        }
    }
}

findings::tuning! {
    /// Rows of a window of rest.
    WINDOW: usize = 40;

    /// Steps over which an offset has to last.
    LASTS: usize = 100;
}

/// The usual offset between labels, of means over some seconds.
fn lasting(steps: &[(bool, Vector3<f64>)]) -> f64 {
    let offset = |steps: &[(bool, Vector3<f64>)]| {
        let mean = |back: bool| {
            let of = || steps.iter().filter(move |(b, _)| *b == back);
            of().map(|(_, step)| step).sum::<Vector3<f64>>() / of().count().max(1) as f64
        };
        0.5 * (mean(false) - mean(true)).norm()
    };
    let length = LASTS.get().min(steps.len() / 2).max(1);
    median(steps.chunks_exact(length).map(offset)).unwrap_or_default()
}

/// The offset between labels in its own standard errors, a tenth of that; 0 where it is small against the noise.
fn offset(steps: &[(bool, Vector3<f64>)], noise: f64) -> f64 {
    let axis = |axis: usize| {
        let of = |back: bool| {
            let values = steps.iter().filter(move |(b, _)| *b == back);
            values
                .map(move |(_, step)| step[axis])
                .collect::<Vec<f64>>()
        };
        let (there, back) = (of(false), of(true));
        let (count, middle) = (
            there.len().min(back.len()),
            [&there, &back].map(|v| median(v.iter().copied())),
        );
        let [Some(there_mid), Some(back_mid)] = middle else {
            return 0.0;
        };
        let deviation = |values: &[f64], mid: f64| {
            median(values.iter().map(|v| (v - mid).abs())).unwrap_or_default()
        };
        let scatter = deviation(&there, there_mid).max(deviation(&back, back_mid));
        let offset = 0.5 * (there_mid - back_mid).abs();
        if count < 10 * CHANGES.get() || offset < 0.1 * noise || scatter == 0.0 {
            return 0.0;
        }
        // Of a normal distribution the error of the median is 1.25 σ/√n, and the median deviation 0.67 σ.
        0.1 * offset * (count as f64).sqrt() / (1.86 * scatter)
    };
    (0..3).map(axis).fold(0.0, f64::max)
}
