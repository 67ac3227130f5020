//! ROS 2: parameters of a node.

use std::fmt::Write as _;

use sensor::Base;

use crate::error::Error;
use crate::kept::Kept;
use crate::source::{Source, rows};
use crate::target::{Form, Settings, Target, Written};

/// A parameter file for any node (`ros2 run … --ros-args --params-file FILE`): `accelerometer.T` (9, rows),
/// `accelerometer.b` (3), the same of the gyroscope, and `gyroscope.G` (9) where it is known; `f = T (A − b)`,
/// `w = T (W − b) − G f`.
pub const TARGET: Target = Target {
    name: "ros2",
    about: "ROS 2 parameters of any node: T and b of both sensors, f = T (A - b)",
    form: Form::File,
    keeps: |source| Kept {
        g_sensitivity: true,
        ..Kept::base_of(source)
    },
    write,
};

fn write(source: &Source<'_>, _: &Settings) -> Result<Written, Error> {
    source.needs_si("ros2")?;
    let mut text = source.provenance("#");
    text.push_str(
        "# f = T (A - b), w = T (W - b) - G f; matrices in rows\n/**:\n  ros__parameters:\n",
    );
    let sensors = [
        ("accelerometer", &source.accelerometer),
        ("gyroscope", &source.gyroscope),
    ];
    for (name, base) in sensors {
        let Some(Base { t, bias }) = base else {
            continue;
        };
        let _ = writeln!(text, "    {name}:");
        let _ = writeln!(text, "      T: {:?}", rows(t));
        let _ = writeln!(text, "      b: {:?}", [bias.x, bias.y, bias.z]);
        if let Some(g) = source.g_sensitivity.filter(|_| name == "gyroscope") {
            let _ = writeln!(text, "      G: {:?}", rows(&g));
        }
    }
    Ok(Written::text(text))
}
