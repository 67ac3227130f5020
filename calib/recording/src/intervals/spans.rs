//! Arithmetic of time spans: union and the two merging rules.

use serde::Serialize;

use crate::recording::INSTANT;

/// A stretch of time, s; `from <= to`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Span {
    /// Start, s.
    #[serde(rename = "t0")]
    pub from: f64,
    /// End, s.
    #[serde(rename = "t1")]
    pub to: f64,
}

impl Span {
    /// Its length, s.
    pub fn length(&self) -> f64 {
        self.to - self.from
    }

    /// Returns true if the span lasts at least `length`, s, within the rounding of stamps.
    pub fn lasts(&self, length: f64) -> bool {
        self.length() > length - INSTANT.get()
    }

    /// Returns the number of stretches of `length`, s, that fit into the span.
    pub fn stretches(&self, length: f64) -> usize {
        ((self.length() + INSTANT.get()) / length).floor() as usize
    }

    /// Returns true if the two spans share an instant.
    pub fn touches(&self, other: &Span) -> bool {
        self.from <= other.to && other.from <= self.to
    }
}

/// The spans in order, overlapping ones made one.
pub fn union(mut spans: Vec<Span>) -> Vec<Span> {
    spans.sort_by(|a, b| a.from.total_cmp(&b.from));
    let mut merged: Vec<Span> = Vec::with_capacity(spans.len());
    for span in spans {
        match merged.last_mut() {
            Some(last) if span.from <= last.to => last.to = last.to.max(span.to),
            _ => merged.push(span),
        }
    }
    merged
}

/// Returns the parts of `whole` outside the ordered, disjoint `spans`.
pub fn complement(whole: Span, spans: &[Span]) -> Vec<Span> {
    let mut rest = Vec::with_capacity(spans.len() + 1);
    let mut from = whole.from;
    for span in spans {
        if span.from > from {
            rest.push(Span {
                from,
                to: span.from.min(whole.to),
            });
        }
        from = from.max(span.to);
    }
    if from < whole.to {
        rest.push(Span { from, to: whole.to });
    }
    rest
}

/// The static spans of `whole` after the published merging rules (Liu et al. 2021, section 3.2):
/// a dynamic span shorter than `min_dynamic` joins the static ones around it, then a static span
/// shorter than `min_static` joins the dynamic ones around it.
pub fn static_spans(whole: Span, dynamic: &[Span], min_dynamic: f64, min_static: f64) -> Vec<Span> {
    let long: Vec<Span> = dynamic
        .iter()
        .copied()
        .filter(|d| d.lasts(min_dynamic))
        .collect();
    complement(whole, &long)
        .into_iter()
        .filter(|s| s.lasts(min_static))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn span(from: f64, to: f64) -> Span {
        Span { from, to }
    }

    #[test]
    fn overlapping_spans_become_one() {
        let merged = union(vec![span(4.0, 6.0), span(0.0, 1.0), span(5.0, 7.0)]);
        assert_eq!(merged, [span(0.0, 1.0), span(4.0, 7.0)]);
    }

    #[test]
    fn a_short_shake_does_not_cut_a_rest_and_a_short_rest_is_no_rest() {
        let dynamic = [span(10.0, 10.2), span(20.0, 22.0), span(23.0, 25.0)];
        let rests = static_spans(span(0.0, 40.0), &dynamic, 0.5, 3.0);
        assert_eq!(rests, [span(0.0, 20.0), span(25.0, 40.0)]);
    }
}
