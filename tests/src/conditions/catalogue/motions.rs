//! How the device is held, laid down and turned.

use calib::simulate::{Spec, Unsteady, Vibration};

use super::condition::{Condition, by_hand, row};
use crate::conditions::Kind;

fn unsteady(spec: &mut Spec, change: impl FnOnce(&mut Unsteady)) {
    change(spec.unsteady.get_or_insert_default());
}

fn yaw(spec: &mut Spec, degrees_per_second: f64) {
    unsteady(spec, |u| {
        u.yaw = degrees_per_second.to_radians();
        u.share = 0.3;
    });
}

const HELD: &[Kind] = &[Kind::Shakes, Kind::Turning, Kind::Misfit];
const TURNING: &[Kind] = &[
    Kind::Turning,
    Kind::Misfit,
    Kind::Unused,
    Kind::Crept,
    Kind::Disagrees,
];
const SHAKING: &[Kind] = &[Kind::Shakes];

pub(super) const ROWS: &[Condition] = &[
    row("tremor-5", "held in the hand, tremor of 5 mrad/s", |s| {
        unsteady(s, |u| (u.tremor, u.sway) = (5e-3, 5e-4));
    })
    .right(HELD),
    row("tremor-20", "tremor of 20 mrad/s, sway of 1 mrad", |s| {
        unsteady(s, |u| (u.tremor, u.sway) = (2e-2, 1e-3));
    })
    .right(HELD),
    row("tremor-50", "tremor of 50 mrad/s, sway of 2 mrad", |s| {
        unsteady(s, |u| (u.tremor, u.sway) = (5e-2, 2e-3));
    })
    .beyond_the_model()
    .right(HELD),
    row("vibration", "half the placements vibrate, .05 m/s2", |s| {
        s.vibration = Some(Vibration {
            rms: 0.05,
            ..Vibration::default()
        });
    })
    .right(SHAKING),
    row(
        "machine",
        "a machine of 23 Hz, .2 m/s2, rocks the table",
        |s| {
            s.vibration = Some(Vibration {
                rms: 0.2,
                frequency: Some(23.0),
                rocking: 0.02,
                ..Vibration::default()
            });
        },
    )
    .right(SHAKING),
    row("yaw-0.1", "three in ten placements turn by .1 deg/s", |s| {
        yaw(s, 0.1)
    })
    .right(TURNING),
    row("yaw-1", "three in ten placements turn by 1 deg/s", |s| {
        yaw(s, 1.0)
    })
    .right(TURNING),
    row("yaw-10", "three in ten placements turn by 10 deg/s", |s| {
        yaw(s, 10.0)
    })
    .right(TURNING),
    row("yaw-60", "three in ten placements turn by 60 deg/s", |s| {
        yaw(s, 60.0)
    })
    .right(TURNING),
    row("slow-turns", "turns of 20 to 40 s", |s| {
        by_hand(s, |hand| hand.turn = [20.0, 40.0]);
    }),
    row("short", "static intervals of 1 to 3 s", |s| {
        by_hand(s, |hand| hand.rest = [1.0, 3.0]);
    })
    .right(&[Kind::Geometry]),
    row("placements-10", "ten placements", |s| {
        by_hand(s, |hand| hand.placements = Some(10));
    })
    .right(&[Kind::Geometry]),
    row("placements-13", "thirteen placements", |s| {
        by_hand(s, |hand| hand.placements = Some(13));
    })
    .right(&[Kind::Geometry]),
    row(
        "settling",
        "the last .3 to 1 deg turned after touch-down",
        |s| {
            unsteady(s, |u| u.settling = 1.0_f64.to_radians());
        },
    )
    .right(TURNING),
    // A contact that lasts one sample is a reading that leaves its neighbours and returns: the words name knocks.
    row("shock", "table contact of 20 m/s2", |s| {
        by_hand(s, |hand| hand.shock = 20.0)
    })
    .right(&[Kind::Spikes]),
];
