//! Smooth functions of time with their first two derivatives in closed form.

use std::f64::consts::TAU;

/// A function of time (s) that is constant outside its span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Profile {
    /// From 0 to 1: `35u⁴ − 84u⁵ + 70u⁶ − 20u⁷`; three derivatives vanish at both ends.
    Blend {
        /// Begin, s.
        start: f64,
        /// End, s.
        end: f64,
    },
    /// From 0 to 1 in the middle and back: `(4u(1 − u))⁴`.
    Bump {
        /// Begin, s.
        start: f64,
        /// End, s.
        end: f64,
    },
    /// A sine under a bump: `(4u(1 − u))⁴ sin(2πf(t − start) + phase)`.
    Tremor {
        /// Begin, s.
        start: f64,
        /// End, s.
        end: f64,
        /// Hz.
        frequency: f64,
        /// rad.
        phase: f64,
    },
    /// A rate of 1 with smooth begin and end of length `ramp`: from 0 to `end − start − ramp`.
    Constant {
        /// Begin, s.
        start: f64,
        /// End, s.
        end: f64,
        /// s.
        ramp: f64,
    },
    /// A sine that begins and ends smoothly within `ramp`.
    Sway {
        /// Begin, s.
        start: f64,
        /// End, s.
        end: f64,
        /// s.
        ramp: f64,
        /// Hz.
        frequency: f64,
        /// rad.
        phase: f64,
    },
    /// A knock with second derivative `(6u − 6u² + u³)e^{−u}`, `u = (t − start)/decay`: its peak is 1.009.
    Knock {
        /// Begin, s.
        start: f64,
        /// Time constant, s; after 50 of them the knock is below the last bit.
        decay: f64,
    },
}

/// Value, first and second derivative of a [`Profile`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Jets {
    pub value: f64,
    /// 1/s.
    pub first: f64,
    /// 1/s².
    pub second: f64,
}

/// Time constants after which a knock is over.
const KNOCK_LENGTH: f64 = 50.0;

impl Profile {
    /// Begin and end, s: the profile is analytic between them.
    pub fn span(&self) -> (f64, f64) {
        match *self {
            Self::Blend { start, end }
            | Self::Bump { start, end }
            | Self::Tremor { start, end, .. }
            | Self::Constant { start, end, .. }
            | Self::Sway { start, end, .. } => (start, end),
            Self::Knock { start, decay } => (start, start + KNOCK_LENGTH * decay),
        }
    }

    /// Returns the times at which a mean has to be split, s: the ends, the ends of ramps, and two per time constant within a knock,
    /// which changes faster than other profiles.
    pub fn knots(&self) -> Vec<f64> {
        let (start, end) = self.span();
        let within = match *self {
            Self::Knock { decay, .. } => (1..60)
                .map(|k| start + 0.5 * decay * f64::from(k))
                .collect(),
            Self::Constant { ramp, .. } | Self::Sway { ramp, .. } => vec![start + ramp, end - ramp],
            _ => Vec::new(),
        };
        [vec![start, end], within].concat()
    }

    /// Value and derivatives at `t`.
    pub fn at(&self, t: f64) -> Jets {
        let (start, end) = self.span();
        if t <= start {
            return Jets::default();
        }
        if t >= end {
            let value = match *self {
                Self::Blend { .. } => 1.0,
                Self::Constant { ramp, .. } => end - start - ramp,
                _ => 0.0,
            };
            return Jets {
                value,
                ..Jets::default()
            };
        }
        let length = end - start;
        let u = (t - start) / length;
        match *self {
            Self::Blend { .. } => blend(u, length),
            Self::Bump { .. } => bump(u, length),
            Self::Tremor {
                frequency, phase, ..
            } => product(bump(u, length), sine(t - start, frequency, phase)),
            Self::Constant { ramp, .. } => constant(t - start, end - start, ramp),
            Self::Sway {
                ramp,
                frequency,
                phase,
                ..
            } => product(
                ramps(t - start, end - start, ramp),
                sine(t - start, frequency, phase),
            ),
            Self::Knock { decay, .. } => knock((t - start) / decay, decay),
        }
    }
}

fn blend(u: f64, length: f64) -> Jets {
    let v = 1.0 - u;
    Jets {
        value: u.powi(4) * (35.0 + u * (-84.0 + u * (70.0 - 20.0 * u))),
        first: 140.0 * (u * v).powi(3) / length,
        second: 420.0 * (u * v).powi(2) * (1.0 - 2.0 * u) / (length * length),
    }
}

fn bump(u: f64, length: f64) -> Jets {
    let b = 4.0 * u * (1.0 - u);
    let slope = 4.0 * (1.0 - 2.0 * u);
    Jets {
        value: b.powi(4),
        first: 4.0 * b.powi(3) * slope / length,
        second: (12.0 * b * b * slope * slope - 32.0 * b.powi(3)) / (length * length),
    }
}

fn sine(t: f64, frequency: f64, phase: f64) -> Jets {
    let rate = TAU * frequency;
    let (sin, cos) = (rate * t + phase).sin_cos();
    Jets {
        value: sin,
        first: rate * cos,
        second: -rate * rate * sin,
    }
}

fn knock(u: f64, decay: f64) -> Jets {
    let e = (-u).exp();
    Jets {
        value: u.powi(3) * e * decay * decay,
        first: (3.0 - u) * u * u * e * decay,
        second: (6.0 + u * (u - 6.0)) * u * e,
    }
}

/// 1 with a smooth begin and end.
fn ramps(t: f64, length: f64, ramp: f64) -> Jets {
    if t < ramp {
        return blend(t / ramp, ramp);
    }
    if t > length - ramp {
        let down = blend((length - t) / ramp, ramp);
        return Jets {
            first: -down.first,
            ..down
        };
    }
    Jets {
        value: 1.0,
        ..Jets::default()
    }
}

/// The integral of [`ramps`]; that of a blend is `7u⁵ − 14u⁶ + 10u⁷ − 2.5u⁸`.
fn constant(t: f64, length: f64, ramp: f64) -> Jets {
    let rate = ramps(t, length, ramp);
    let under = |u: f64| ramp * u.powi(5) * (7.0 + u * (-14.0 + u * (10.0 - 2.5 * u)));
    let value = if t < ramp {
        under(t / ramp)
    } else if t > length - ramp {
        length - ramp - under((length - t) / ramp)
    } else {
        t - 0.5 * ramp
    };
    Jets {
        value,
        first: rate.value,
        second: rate.first,
    }
}

fn product(a: Jets, b: Jets) -> Jets {
    Jets {
        value: a.value * b.value,
        first: a.first * b.value + a.value * b.first,
        second: a.second * b.value + 2.0 * a.first * b.first + a.value * b.second,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PROFILES: [Profile; 6] = [
        Profile::Blend {
            start: 0.5,
            end: 2.5,
        },
        Profile::Bump {
            start: 0.5,
            end: 2.5,
        },
        Profile::Tremor {
            start: 0.5,
            end: 2.5,
            frequency: 3.0,
            phase: 0.4,
        },
        Profile::Constant {
            start: 0.5,
            end: 2.5,
            ramp: 0.3,
        },
        Profile::Sway {
            start: 0.5,
            end: 2.5,
            ramp: 0.3,
            frequency: 1.0,
            phase: 0.4,
        },
        Profile::Knock {
            start: 0.5,
            decay: 0.1,
        },
    ];

    #[test]
    fn derivatives_agree_with_central_differences() {
        let h = 1e-5;
        for profile in PROFILES {
            for k in 1..40 {
                let t = 0.05 * f64::from(k) + 0.521;
                let (before, at, after) = (profile.at(t - h), profile.at(t), profile.at(t + h));
                // Error of a central difference: h²/6 of the third derivative (below 1e5 here).
                assert!((at.first - (after.value - before.value) / (2.0 * h)).abs() < 2e-6);
                assert!((at.second - (after.first - before.first) / (2.0 * h)).abs() < 2e-5);
            }
        }
    }

    #[test]
    fn outside_its_span_a_profile_rests() {
        for profile in PROFILES {
            let (start, end) = profile.span();
            assert_eq!(profile.at(start), Jets::default());
            let after = profile.at(end + 1e-9);
            assert_eq!((after.first, after.second), (0.0, 0.0));
            let last = profile.at(end - 1e-9);
            assert!((last.value - after.value).abs() < 1e-12 && last.second.abs() < 1e-6);
        }
    }
}
