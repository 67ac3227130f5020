//! An axis: its label with a unit, its scale, its ticks.

/// Ticks wanted on a linear axis.
const TICKS: f64 = 5.0;

/// Decades above which only some are labelled.
const LABELLED_DECADES: i32 = 6;

/// An axis of a plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Plotted quantity, with its unit.
    pub label: String,
    logarithmic: bool,
    /// Words at 1, 2, … instead of numbers; none for numbers.
    names: Vec<String>,
    /// The ends where they are given.
    ends: Option<(f64, f64)>,
}

/// An axis with its ends and ticks, in coordinates that are linear on paper.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Scale {
    pub from: f64,
    pub to: f64,
    pub ticks: Vec<f64>,
    pub fine_ticks: Vec<f64>,
    decimals: Option<usize>,
    names: Vec<String>,
}

impl Axis {
    /// A linear axis.
    pub fn linear(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            logarithmic: false,
            names: Vec::new(),
            ends: None,
        }
    }

    /// A linear axis with words at 1, 2, … instead of numbers.
    pub fn categories(label: impl Into<String>, names: Vec<String>) -> Self {
        Self {
            names,
            ..Self::linear(label)
        }
    }

    /// With given ends, whatever is drawn.
    #[must_use]
    pub fn between(mut self, from: f64, to: f64) -> Self {
        self.ends = Some((from, to));
        self
    }

    /// Number of places with words; 0 of an axis of numbers.
    pub(super) fn named(&self) -> usize {
        self.names.len()
    }

    /// Returns true if the axis is logarithmic.
    pub(super) fn is_log(&self) -> bool {
        self.logarithmic
    }

    /// A logarithmic axis; values that are not positive have no place on it.
    pub fn log(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            logarithmic: true,
            names: Vec::new(),
            ends: None,
        }
    }

    /// Returns the position of a value on paper; `None` if it has none.
    pub(super) fn place(&self, value: f64) -> Option<f64> {
        let place = if self.logarithmic {
            value.log10()
        } else {
            value
        };
        place.is_finite().then_some(place)
    }

    /// Ends and ticks that hold all `values`.
    pub(super) fn scale(&self, values: impl Iterator<Item = f64>) -> Scale {
        let given = self.ends.iter().flat_map(|&(from, to)| [from, to]);
        let (low, high) = given
            .chain(values)
            .filter_map(|value| self.place(value))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| {
                (l.min(v), h.max(v))
            });
        let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        if !self.names.is_empty() {
            categories(&self.names)
        } else if self.logarithmic {
            decades(low, high)
        } else {
            linear(low, high)
        }
    }
}

impl Scale {
    /// The number beside a tick.
    pub(super) fn text(&self, tick: f64) -> String {
        if !self.names.is_empty() {
            let place = tick.round() as usize;
            return self
                .names
                .get(place.wrapping_sub(1))
                .cloned()
                .unwrap_or_default();
        }
        match self.decimals {
            // The minus sign of a rounded zero says nothing.
            Some(decimals) => format!("{:.decimals$}", tick + 0.0).replace('-', "−"),
            None => power_of_ten(tick.round() as i32),
        }
    }
}

fn categories(names: &[String]) -> Scale {
    // A place without a word has no tick: it makes room.
    let ticks: Vec<f64> = (1..=names.len())
        .filter(|k| !names[k - 1].is_empty())
        .map(|k| k as f64)
        .collect();
    Scale {
        from: 0.5,
        to: names.len() as f64 + 0.5,
        fine_ticks: ticks.clone(),
        ticks,
        decimals: None,
        names: names.to_vec(),
    }
}

fn linear(low: f64, high: f64) -> Scale {
    let span = if high > low {
        high - low
    } else {
        low.abs().max(1.0)
    };
    let (low, high) = (low - 0.05 * span, high + 0.05 * span);
    let step = round_step((high - low) / TICKS);
    let first = (low / step).ceil() as i64;
    let last = (high / step).floor() as i64;
    let ticks: Vec<f64> = (first..=last).map(|k| k as f64 * step).collect();
    let decimals = (-step.log10().floor()).clamp(0.0, 9.0) as usize;
    Scale {
        from: low,
        to: high,
        fine_ticks: ticks.clone(),
        ticks,
        decimals: Some(decimals),
        names: Vec::new(),
    }
}

/// 1, 2 or 5 times a power of ten, next above `step`.
fn round_step(step: f64) -> f64 {
    let decade = 10f64.powf(step.log10().floor());
    let factor = [1.0, 2.0, 5.0]
        .into_iter()
        .find(|f| f * decade >= step)
        .unwrap_or(10.0);
    factor * decade
}

fn decades(low: f64, high: f64) -> Scale {
    let (from, to) = (low - 0.08, high + 0.08);
    // Less than a decade has no tick of its own in it: widen to whole decades.
    let whole = (to.floor() - from.ceil()) < 1.0;
    let (from, to) = if whole {
        (from.floor(), to.ceil())
    } else {
        (from, to)
    };
    let (first, last) = (from.ceil() as i32, to.floor() as i32);
    let every = 1 + (last - first) / LABELLED_DECADES;
    let ticks = (first..=last)
        .filter(|k| k % every == 0)
        .map(f64::from)
        .collect();
    let fine = (first - 1..=last)
        .flat_map(|decade| (1..10).map(move |k| f64::from(decade) + f64::from(k).log10()));
    let fine_ticks = fine.filter(|tick| (from..=to).contains(tick)).collect();
    Scale {
        from,
        to,
        ticks,
        fine_ticks,
        decimals: None,
        names: Vec::new(),
    }
}

/// `10⁻³`, and plain numbers from 0.01 to 1000.
fn power_of_ten(exponent: i32) -> String {
    if (-2..=3).contains(&exponent) {
        return ["0.01", "0.1", "1", "10", "100", "1000"][(exponent + 2) as usize].into();
    }
    let superscript = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).unwrap_or(digit),
    };
    format!(
        "10{}",
        exponent
            .to_string()
            .chars()
            .map(superscript)
            .collect::<String>()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_ticks_are_round_and_inside() {
        let scale = Axis::linear("m").scale([-1.3, 5.2].into_iter());
        assert_eq!(scale.ticks, [0.0, 2.0, 4.0]);
        assert_eq!(scale.text(-2.0), "−2");
        assert_eq!(scale.text(-0.0), "0");
    }

    #[test]
    fn categories_stand_at_whole_numbers_under_their_words() {
        let names = ["fit", "left out"].map(str::to_owned).to_vec();
        let scale = Axis::categories("where", names).scale([1.0, 2.0].into_iter());
        assert_eq!((scale.from, scale.to), (0.5, 2.5));
        assert_eq!(scale.text(2.0), "left out");
        assert_eq!(scale.text(3.0), "");
    }

    #[test]
    fn decades_are_labelled_by_their_powers() {
        let scale = Axis::log("s").scale([2e-5, 300.0].into_iter());
        assert_eq!(scale.ticks, [-4.0, -2.0, 0.0, 2.0]);
        assert_eq!(scale.text(-4.0), "10⁻⁴");
        assert_eq!(scale.text(2.0), "100");
    }

    #[test]
    fn nothing_to_plot_and_a_single_value_still_have_an_axis() {
        for axis in [Axis::linear("m"), Axis::log("m")] {
            for values in [vec![], vec![f64::NAN], vec![0.0], vec![5.0]] {
                let scale = axis.scale(values.into_iter());
                assert!(
                    scale.to > scale.from && !scale.ticks.is_empty(),
                    "{scale:?}"
                );
            }
        }
    }
}
