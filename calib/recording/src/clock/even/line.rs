//! A line through the neighbours of every stamp, by sums that move along.

/// The line through the points `(ticks, excess)` within `reach` ticks of each tick, at that tick.
pub(crate) fn lines(ticks: &[u32], excess: &[f64], reach: f64) -> Vec<f64> {
    let n = ticks.len();
    let at = |k: usize| f64::from(ticks[k]);
    let mut sums = Sums::default();
    let mut window = 0..0;
    (0..n)
        .map(|k| {
            sums.move_origin(at(k) - at(k.saturating_sub(1)));
            while window.end < n && at(window.end) - at(k) <= reach {
                sums.add(at(window.end) - at(k), excess[window.end], 1.0);
                window.end += 1;
            }
            while at(k) - at(window.start) > reach {
                sums.add(at(window.start) - at(k), excess[window.start], -1.0);
                window.start += 1;
            }
            sums.line_at_origin()
        })
        .collect()
}

/// Sums for a line `y` over `x`; those of `x` are of whole numbers and exact.
#[derive(Clone, Copy, Default)]
struct Sums {
    count: f64,
    x: f64,
    y: f64,
    xx: f64,
    xy: f64,
}

impl Sums {
    /// Takes a point in, or out by `sign` −1.
    fn add(&mut self, x: f64, y: f64, sign: f64) {
        self.count += sign;
        self.x += sign * x;
        self.y += sign * y;
        self.xx += sign * x * x;
        self.xy += sign * x * y;
    }

    /// The sums for `x − by`.
    fn move_origin(&mut self, by: f64) {
        self.xx += by * (by * self.count - 2.0 * self.x);
        self.xy -= by * self.y;
        self.x -= by * self.count;
    }

    /// The line at `x = 0`.
    fn line_at_origin(&self) -> f64 {
        let spread = self.count * self.xx - self.x * self.x;
        if spread > 0.0 {
            (self.xx * self.y - self.x * self.xy) / spread
        } else {
            self.y / self.count
        }
    }
}
