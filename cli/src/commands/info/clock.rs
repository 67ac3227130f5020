//! The clock of a stream in figures.

use calib::recording::{Stream, bursts};

/// A clock in figures.
pub struct Clock {
    /// Number of samples.
    pub samples: usize,
    /// First stamp, s.
    pub start: f64,
    /// From the first stamp to the last, s.
    pub duration: f64,
    /// Samples per second, gaps left out, Hz; those of the even clock behind stamps in bursts.
    pub rate: f64,
    /// Root mean square of the steps about their median, s.
    pub jitter: f64,
    /// Number of gaps.
    pub gaps: usize,
    /// The longest of them, s.
    pub longest_gap: f64,
}

impl Clock {
    /// Computes the figures of a stream; `None` without samples.
    pub fn of(stream: &Stream) -> Option<Self> {
        let (first, last) = stream.t.first().zip(stream.t.last())?;
        let step = stream.median_step().unwrap_or(0.0);
        let mut gaps = stream.gaps();
        let behind = bursts(&stream.t);
        if let Some(behind) = &behind {
            gaps.retain(|gap| behind.loses_samples(gap));
        }
        let lost: f64 = gaps.iter().map(|gap| gap.t1 - gap.t0).sum();
        let usual = stream
            .t
            .windows(2)
            .map(|pair| pair[1] - pair[0])
            .filter(|s| *s < 5.0 * step.max(1e-9));
        let (count, squares) = usual.fold((0usize, 0.0), |(n, sum), s| {
            (n + 1, sum + (s - step).powi(2))
        });
        let steps = stream.len().saturating_sub(1 + gaps.len());
        let duration = last - first;
        Some(Self {
            samples: stream.len(),
            start: *first,
            duration,
            rate: match behind {
                Some(behind) => behind.step.recip(),
                None if duration > lost => steps as f64 / (duration - lost),
                None => 0.0,
            },
            jitter: (squares / count.max(1) as f64).sqrt(),
            gaps: gaps.len(),
            longest_gap: gaps.iter().map(|gap| gap.t1 - gap.t0).fold(0.0, f64::max),
        })
    }

    /// The row of a table for people.
    pub fn row(&self, sensor: &str, unit: &str) -> [String; 7] {
        [
            sensor.to_owned(),
            unit.to_owned(),
            self.samples.to_string(),
            format!("{:.2}", self.duration),
            format!("{:.2}", self.rate),
            format!("{:.3}", 1e3 * self.jitter),
            match self.gaps {
                0 => "none".to_owned(),
                count => format!("{count}, to {:.3} s", self.longest_gap),
            },
        ]
    }
}
