//! Overlapping Allan deviation, streamed in bounded memory.

/// Lags (in strides) that one level of the cascade holds; up to this averaging factor the estimate
/// is the textbook one, overlapping at every sample.
const LONGEST_LAG: usize = 4096;

/// Decimation factor from one level of the cascade to the next.
const DECIMATION: usize = 4;

/// Levels of the cascade: averaging factors up to `4096 · 4¹³`, more samples than fit on a disk.
const LEVELS: usize = 14;

/// Differences summed side by side: several vectors of any machine's width, so that one need not wait
/// for the other.
const LANES: usize = 16;

findings::tuning! {
    /// Averaging factors per octave.
    PER_OCTAVE: usize = 4;
}

/// Phase values collected before a level works on them.
const BLOCK: usize = 4 * LONGEST_LAG;

/// One point of the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AllanPoint {
    /// Samples averaged, `m`.
    pub factor: usize,
    /// Averaging time `τ = m τ₀`, s.
    pub tau: f64,
    /// Allan deviation `σ(τ)`, in the unit of the samples.
    pub deviation: f64,
    /// Places that its differences begin at, gaps left out; beyond the longest lag of a level neighbours stand for each other.
    pub places: usize,
}

/// Overlapping Allan deviation over quarter octaves of the averaging time.
#[derive(Clone, Debug, PartialEq)]
pub struct AllanCurve {
    /// Time between samples `τ₀`, s.
    pub step: f64,
    /// Number of samples.
    pub samples: usize,
    /// The points, `τ` ascending.
    pub points: Vec<AllanPoint>,
}

impl AllanCurve {
    /// The curve of evenly spaced samples (unit of the result) at intervals of `step` seconds.
    pub fn of(samples: impl IntoIterator<Item = f64>, step: f64) -> Self {
        let mut accumulator = AllanAccumulator::new();
        samples.into_iter().for_each(|y| accumulator.push(y));
        accumulator.finish(step)
    }

    /// The point with averaging factor `m`.
    pub fn at_factor(&self, m: usize) -> Option<&AllanPoint> {
        self.points.iter().find(|point| point.factor == m)
    }

    /// Length of the recording without gaps, s.
    pub fn duration(&self) -> f64 {
        self.samples as f64 * self.step
    }
}

/// Sums of squared second differences of the integrated signal, sample by sample.
///
/// With `xₙ = Σ_{i<n} yᵢ` and averaging factor `m`,
/// `σ²(m) = Σ (x_{n+2m} − 2 x_{n+m} + xₙ)² / (2 m² M)` over all `M` places in the recording
/// (Riley, *Handbook of Frequency Stability Analysis*, NIST SP 1065, 2008, equation 11).
///
/// Up to `m = 4096` every place is used. Beyond, the integral is kept at every 4th, 16th, … sample
/// only: neighbouring places then still overlap by more than 99.9 %, and memory does not grow with
/// the recording (at most 3 MB). The first sample after a gap is taken off those that follow, which changes no second
/// difference: otherwise the mean of the signal would eat up the digits of a long integral.
#[derive(Clone, Debug)]
pub struct AllanAccumulator {
    levels: Vec<Level>,
    offset: Option<f64>,
    phase: f64,
    since_gap: usize,
    samples: usize,
}

impl Default for AllanAccumulator {
    fn default() -> Self {
        Self::new()
    }
}

impl AllanAccumulator {
    /// No samples yet.
    pub fn new() -> Self {
        Self {
            levels: (0..LEVELS).map(Level::new).collect(),
            offset: None,
            phase: 0.0,
            since_gap: 0,
            samples: 0,
        }
    }

    /// The next sample.
    pub fn push(&mut self, y: f64) {
        if self.since_gap == 0 {
            self.feed(0);
        }
        let offset = *self.offset.get_or_insert(y);
        self.phase += y - offset;
        self.since_gap += 1;
        self.samples += 1;
        self.feed(self.since_gap);
    }

    /// Samples are missing here: no difference may reach across.
    pub fn gap(&mut self) {
        self.levels.iter_mut().for_each(Level::cut);
        self.offset = None;
        self.phase = 0.0;
        self.since_gap = 0;
    }

    /// The curve for samples `step` seconds apart.
    pub fn finish(mut self, step: f64) -> AllanCurve {
        self.levels.iter_mut().for_each(Level::work);
        let lags = self
            .levels
            .iter()
            .flat_map(|level| level.lags.iter().map(move |lag| (level.stride, lag)));
        let points = lags
            .filter(|(_, lag)| lag.count > 0)
            .map(|(stride, lag)| {
                let m = stride * lag.strides;
                AllanPoint {
                    factor: m,
                    tau: m as f64 * step,
                    deviation: (lag.sum / (2.0 * lag.count as f64)).sqrt() / m as f64,
                    places: stride * lag.count,
                }
            })
            .collect();
        AllanCurve {
            step,
            samples: self.samples,
            points,
        }
    }

    /// Hands the integral after `n` samples to the levels whose stride divides `n`.
    fn feed(&mut self, n: usize) {
        for level in &mut self.levels {
            if !n.is_multiple_of(level.stride) {
                break;
            }
            level.push(self.phase);
        }
    }
}

/// The integral at every `stride`-th sample, and the sums for some lags in it.
#[derive(Clone, Debug)]
struct Level {
    stride: usize,
    lags: Vec<Lag>,
    phase: Vec<f64>,
    /// Values at the front of `phase` that earlier sums have already ended on.
    done: usize,
}

/// The sum for one averaging factor.
#[derive(Clone, Debug)]
struct Lag {
    strides: usize,
    sum: f64,
    count: usize,
}

impl Level {
    fn new(level: usize) -> Self {
        let stride = DECIMATION.pow(level as u32);
        let shortest = if level == 0 {
            0
        } else {
            LONGEST_LAG / DECIMATION
        };
        let lags = quarter_octaves()
            .filter(|&m| m > shortest * stride && m <= LONGEST_LAG * stride)
            .map(|m| Lag {
                strides: (m + stride / 2) / stride,
                sum: 0.0,
                count: 0,
            })
            .collect();
        Self {
            stride,
            lags,
            phase: Vec::new(),
            done: 0,
        }
    }

    fn push(&mut self, phase: f64) {
        self.phase.push(phase);
        if self.phase.len() >= 2 * LONGEST_LAG + BLOCK {
            self.work();
            self.forget();
        }
    }

    /// Adds the differences that end on values not yet worked on.
    fn work(&mut self) {
        for lag in &mut self.lags {
            let (m, x) = (lag.strides, &self.phase);
            let from = self.done.max(2 * m);
            if from >= x.len() {
                continue;
            }
            let (old, middle, new) = (&x[from - 2 * m..], &x[from - m..], &x[from..]);
            lag.sum += sum_of_squares(old, middle, new);
            lag.count += new.len();
        }
        self.done = self.phase.len();
    }

    /// Drops what no later difference reaches.
    fn forget(&mut self) {
        self.phase
            .drain(..self.phase.len().saturating_sub(2 * LONGEST_LAG));
        self.done = self.phase.len();
    }

    fn cut(&mut self) {
        self.work();
        self.phase.clear();
        self.done = 0;
    }
}

/// `Σ (new − 2 middle + old)²` over the length of `new`, with the widest vectors there are and the
/// same digits with any.
fn sum_of_squares(old: &[f64], middle: &[f64], new: &[f64]) -> f64 {
    pulp::Arch::new().dispatch(|| sum_in_lanes(old, middle, new))
}

#[inline(always)]
fn sum_in_lanes(old: &[f64], middle: &[f64], new: &[f64]) -> f64 {
    let (a, _) = old[..new.len()].as_chunks::<LANES>();
    let (b, _) = middle[..new.len()].as_chunks::<LANES>();
    let (c, rest) = new.as_chunks::<LANES>();
    let mut lanes = [0.0; LANES];
    for ((a, b), c) in a.iter().zip(b).zip(c) {
        for lane in 0..LANES {
            let d = c[lane] - 2.0 * b[lane] + a[lane];
            lanes[lane] += d * d;
        }
    }
    let rest = new.len() - rest.len()..new.len();
    let rest = rest.map(|k| (new[k] - 2.0 * middle[k] + old[k]).powi(2));
    lanes.iter().sum::<f64>() + rest.sum::<f64>()
}

/// Averaging factors `2^(k/4)`, rounded, each once.
fn quarter_octaves() -> impl Iterator<Item = usize> {
    let mut last = 0;
    (0..)
        .map_while(|k: usize| {
            let octave = 1_usize
                .checked_shl((k / PER_OCTAVE.get()) as u32)
                .filter(|&m| (m as u64) < 1 << 40)?;
            let part = (k % PER_OCTAVE.get()) as f64 / PER_OCTAVE.get() as f64;
            Some((octave as f64 * part.exp2()).round() as usize)
        })
        .filter(move |&m| std::mem::replace(&mut last, m) != m)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The nine frequencies of NBS Monograph 140, Annex 8.E, as reprinted in NIST SP 1065, section
    /// 12.4 (ten phase points). SP 1065 gives 91.22945 and 85.95287 for the overlapping deviation;
    /// the digits beyond are those of allantools 2024.06, `oadev(data_type="freq")`.
    #[test]
    fn the_ten_points_of_nbs_monograph_140_have_their_published_deviations() {
        let frequency = [
            892.0, 809.0, 823.0, 798.0, 671.0, 644.0, 883.0, 903.0, 677.0,
        ];
        let curve = AllanCurve::of(frequency, 1.0);
        for (m, deviation) in [
            (1, 91.22944974074983),
            (2, 85.952869837681),
            (3, 71.13065052735315),
            (4, 27.6351791200998),
        ] {
            let point = curve.at_factor(m).unwrap();
            assert!(
                (point.deviation / deviation - 1.0).abs() < 1e-10,
                "m = {m}: {point:?}"
            );
        }
        assert!((curve.at_factor(1).unwrap().deviation - 91.22945).abs() < 5e-6);
        assert!((curve.at_factor(2).unwrap().deviation - 85.95287).abs() < 5e-6);
    }

    /// The 1000-point set of NIST SP 1065 (2008), section 12.4, from its own generator,
    /// `n' = 16807 n mod 2147483647`. Published: 2.922319e-1, 9.159953e-2, 3.241343e-2 at τ = 1, 10
    /// and 100; the other digits and lags are those of allantools 2024.06, `oadev`.
    #[test]
    fn the_thousand_points_of_nist_sp_1065_have_their_published_deviations() {
        let frequency = thousand_points();
        for (m, deviation) in [
            (1, 0.29223187810675916),
            (2, 0.20101604217093852),
            (4, 0.14479130721843778),
            (8, 0.10570385007869997),
            (16, 0.06191477841874486),
            (32, 0.04808214262128163),
            (64, 0.03623721298570471),
            (128, 0.02767385582069447),
            (256, 0.010282217639032731),
        ] {
            let point = *AllanCurve::of(frequency.clone(), 1.0).at_factor(m).unwrap();
            assert!(
                (point.deviation / deviation - 1.0).abs() < 1e-10,
                "m = {m}: {point:?}"
            );
        }
        // 10 and 100 are no quarter octaves: averaging by hand moves them onto the grid.
        for (m, published, allantools) in [
            (10, 9.159953e-2, 0.09159953420118652),
            (100, 3.241343e-2, 0.03241343026056983),
        ] {
            let mut level = Level {
                lags: vec![lag(m)],
                ..Level::new(0)
            };
            let mut phase = 0.0;
            level.push(phase);
            for y in &frequency {
                phase += y;
                level.push(phase);
            }
            level.work();
            let deviation =
                (level.lags[0].sum / (2.0 * level.lags[0].count as f64)).sqrt() / m as f64;
            assert!((deviation / allantools - 1.0).abs() < 1e-10);
            assert!((deviation / published - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn the_cascade_agrees_with_the_textbook_sum_far_beyond_its_longest_lag() {
        let y: Vec<f64> = noise(200_000);
        let curve = AllanCurve::of(y.clone(), 0.01);
        for m in [4096, 8192, 65_536] {
            let direct = textbook(&y, m);
            let streamed = curve.at_factor(m).unwrap().deviation;
            // Every fourth or sixteenth place of thousands that overlap.
            let tolerance = if m == 4096 { 1e-10 } else { 1e-3 };
            assert!(
                (streamed / direct - 1.0).abs() < tolerance,
                "{m}: {streamed} {direct}"
            );
        }
    }

    #[test]
    fn a_jump_across_a_gap_is_not_seen() {
        let y = noise(20_000);
        let mut accumulator = AllanAccumulator::new();
        y[..10_000].iter().for_each(|&v| accumulator.push(v));
        accumulator.gap();
        y[10_000..].iter().for_each(|&v| accumulator.push(v + 1e6));
        let apart = accumulator.finish(1.0);
        let (a, b) = (
            AllanCurve::of(y[..10_000].to_vec(), 1.0),
            AllanCurve::of(y[10_000..].to_vec(), 1.0),
        );
        for m in [1, 64, 1024] {
            let squares = [&a, &b].map(|c| {
                let p = c.at_factor(m).unwrap();
                (p.deviation.powi(2) * p.places as f64, p.places)
            });
            let together =
                ((squares[0].0 + squares[1].0) / (squares[0].1 + squares[1].1) as f64).sqrt();
            // The jump of 1e6 costs six of sixteen digits of every sample, which add up over 2m.
            assert!((apart.at_factor(m).unwrap().deviation / together - 1.0).abs() < 1e-8);
        }
    }

    fn lag(strides: usize) -> Lag {
        Lag {
            strides,
            sum: 0.0,
            count: 0,
        }
    }

    fn thousand_points() -> Vec<f64> {
        std::iter::successors(Some(1_234_567_890_u64), |n| {
            Some(16_807 * n % 2_147_483_647)
        })
        .take(1000)
        .map(|n| n as f64 / 2_147_483_647.0)
        .collect()
    }

    /// The same generator carried on, about zero.
    fn noise(samples: usize) -> Vec<f64> {
        std::iter::successors(Some(1_234_567_890_u64), |n| {
            Some(16_807 * n % 2_147_483_647)
        })
        .take(samples)
        .map(|n| n as f64 / 2_147_483_647.0 - 0.5)
        .collect()
    }

    fn textbook(y: &[f64], m: usize) -> f64 {
        let mut x = vec![0.0];
        y.iter().for_each(|v| x.push(x[x.len() - 1] + v));
        let squares: Vec<f64> = (2 * m..x.len())
            .map(|n| (x[n] - 2.0 * x[n - m] + x[n - 2 * m]).powi(2))
            .collect();
        (squares.iter().sum::<f64>() / (2.0 * squares.len() as f64)).sqrt() / m as f64
    }
}
