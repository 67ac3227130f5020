//! What goes wrong in a recording.

use calib::simulate::{Fault, Simulation, Spec};

use super::condition::{Condition, row};
use crate::conditions::Kind;

/// Begin and end of the placements as planned; nothing for a spec that contradicts itself, which the study
/// reports by itself.
fn placements(spec: &Spec) -> Vec<(f64, f64)> {
    Simulation::new(spec).map_or_else(|_| Vec::new(), |s| s.placements())
}

/// A placement that is neither first nor last, another for every seed and every `step`.
fn inner(spec: &Spec, step: u64) -> usize {
    let inner = placements(spec).len().max(3) as u64 - 2;
    1 + ((spec.seed * 7 + step) % inner) as usize
}

const PUSHED: &[Kind] = &[Kind::Touched, Kind::Disagrees, Kind::Misfit];

pub(super) const ROWS: &[Condition] = &[
    row("slip", "one placement creeps by 2 mrad", |s| {
        let interval = inner(s, 1);
        s.faults.push(Fault::Slip {
            interval,
            angle: 2e-3,
        });
    })
    .right(&[Kind::Crept]),
    row("touch", "one placement is touched, .3 m/s2", |s| {
        let interval = inner(s, 3);
        s.faults.push(Fault::Touch {
            interval,
            size: 0.3,
        });
    })
    .right(&[Kind::Touched, Kind::Disagrees, Kind::Shakes]),
    row("gap", "a second is missing in a turn", |s| {
        let before = inner(s, 5);
        let turn = placements(s)
            .get(before..before + 2)
            .map(|p| (p[0].1, p[1].0));
        let (from, to) = turn.unwrap_or_default();
        s.faults.push(Fault::Gap {
            start: 0.5 * (from + to) - 0.5,
            length: 1.0,
        });
    })
    .right(&[Kind::Missing]),
    row(
        "lost-closed-up",
        "50 ms are lost in a turn, stamps closed up",
        |s| {
            let turn = inner(s, 7);
            s.faults.push(Fault::Lost { turn, length: 0.05 });
        },
    )
    // The words for such a turn: rows lost, or a clock that jumped.
    .right(&[Kind::Missing, Kind::BadTurn, Kind::Misfit, Kind::Clock]),
    row(
        "disturbed-two",
        "two placements are pushed by .05 m/s2",
        |s| {
            let first = inner(s, 2);
            let last = placements(s).len().saturating_sub(2).max(1);
            let second = 1 + (first + 3) % last;
            for interval in [first, second] {
                s.faults.push(Fault::Disturbed {
                    interval,
                    size: 0.05,
                });
            }
        },
    )
    .right(PUSHED),
    row(
        "clock-change",
        "the clock runs 2 % fast from half way",
        |s| {
            let end = placements(s).last().map_or(0.0, |p| p.1);
            s.faults.push(Fault::ClockChange {
                start: 0.5 * end,
                rate_error: 0.02,
            });
        },
    )
    .beyond_the_model()
    .right(&[Kind::Clock, Kind::BadTurn, Kind::Misfit]),
];
