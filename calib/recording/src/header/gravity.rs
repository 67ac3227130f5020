//! Gravity and the acceleration without it, in columns of their own, as the fusion of a phone writes them.

use sensor::Sensor;

use super::names::compact;
use super::triads::{Triad, triads};
use crate::recording::options::{ColumnMap, Role};

/// Words of the acceleration that a system has taken gravity from, in the frame of the device.
const WITHOUT: [&str; 3] = ["user", "linear", "lin"];
/// Words of an acceleration.
const ACCELERATION: [&str; 3] = ["acc", "beschl", "acel"];
/// Words beside `gravity` in the names of what is no gravity.
const NO_GRAVITY: [&str; 7] = ["without", "no", "ohne", "incl", "with", "total", "minus"];

/// Columns whose sum is what an accelerometer reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Split {
    /// Gravity, x y z.
    pub gravity: [usize; 3],
    /// The acceleration without it, x y z.
    pub linear: [usize; 3],
    /// They are called as Apple's Core Motion calls them, which counts -1 g on the axis that points up.
    pub is_apples: bool,
}

/// The accelerometer as the sum of gravity and the acceleration without it, where the user names none.
pub(crate) fn summed(
    names: &[String],
    map: &ColumnMap,
    only: Option<Sensor>,
    roles: &mut Vec<(Role, usize)>,
) -> Option<Split> {
    let is_accel = |role: &Role| matches!(role, Role::Accel(_));
    let given = map.0.iter().any(|(role, _)| is_accel(role));
    let split = split(names, roles).filter(|_| !given && only != Some(Sensor::Gyroscope))?;
    roles.retain(|(role, _)| !is_accel(role));
    roles.extend((0..3).map(|axis| (Role::Accel(axis), split.linear[axis])));
    Some(split)
}

/// The one pair of gravity and acceleration without it among `names`, where no column of `roles` is an accelerometer's
/// reading.
fn split(names: &[String], roles: &[(Role, usize)]) -> Option<Split> {
    let found = triads(names);
    let one = |is: fn(&Triad) -> bool| {
        let mut all = found.iter().filter(|triad| is(triad));
        let first = all.next();
        first.filter(|_| all.next().is_none())
    };
    let (gravity, linear) = (one(is_gravity)?, one(is_without_gravity)?);
    let role = |at: &usize| roles.iter().find(|(_, column)| column == at);
    let is_accel = |role: Option<&(Role, usize)>| matches!(role, Some((Role::Accel(_), _)));
    let free = gravity.columns.iter().all(|at| role(at).is_none());
    let own = |at: &usize| role(at).is_none() || is_accel(role(at));
    let mut others = roles
        .iter()
        .filter(|(role, _)| matches!(role, Role::Accel(_)));
    let alone = others.all(|(_, at)| linear.columns.contains(at));
    (free && alone && linear.columns.iter().all(own)).then(|| Split {
        gravity: gravity.columns,
        linear: linear.columns,
        is_apples: compact(&linear.stem).contains("user"),
    })
}

fn is_gravity(triad: &Triad) -> bool {
    let word = compact(&triad.stem);
    word.contains("grav") && !NO_GRAVITY.iter().any(|other| word.contains(other))
}

fn is_without_gravity(triad: &Triad) -> bool {
    let word = compact(&triad.stem);
    let has = |words: &[&str]| words.iter().any(|part| word.contains(part));
    has(&WITHOUT) && has(&ACCELERATION) && !word.contains("grav")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::header::names::role_of;

    fn found(names: &str) -> Option<Split> {
        let names: Vec<String> = names.split(',').map(str::to_owned).collect();
        let roles = names.iter().enumerate();
        let roles = roles.filter_map(|(at, name)| Some((role_of(name, None)?, at)));
        split(&names, &roles.collect::<Vec<_>>())
    }

    #[test]
    fn gravity_and_the_rest_of_it_are_found_by_many_names() {
        for (names, is_apples) in [
            (
                "t,gravity.x,gravity.y,gravity.z,rotationRate.x,rotationRate.y,rotationRate.z,userAcceleration.x,userAcceleration.y,userAcceleration.z",
                true,
            ),
            (
                "t,gravityX,gravityY,gravityZ,linearAccelerationX,linearAccelerationY,linearAccelerationZ",
                false,
            ),
            (
                "Gravity X (m/s²),Gravity Y (m/s²),Gravity Z (m/s²),Linear Acceleration X (m/s²),Linear Acceleration Y (m/s²),Linear Acceleration Z (m/s²)",
                false,
            ),
            (
                "motionUserAccelerationX(G),motionUserAccelerationY(G),motionUserAccelerationZ(G),motionGravityX(G),motionGravityY(G),motionGravityZ(G)",
                true,
            ),
            (
                "user_acc_x(G),user_acc_y(G),user_acc_z(G),grav_x,grav_y,grav_z",
                true,
            ),
            ("lin_acc_x,lin_acc_y,lin_acc_z,grav_x,grav_y,grav_z", false),
        ] {
            let split = found(names);
            assert_eq!(
                split.map(|split| split.is_apples),
                Some(is_apples),
                "{names}"
            );
        }
    }

    #[test]
    fn nothing_is_added_where_an_accelerometer_is_there_or_a_part_is_not() {
        for names in [
            "ax,ay,az,gravity.x,gravity.y,gravity.z,userAcceleration.x,userAcceleration.y,userAcceleration.z",
            "userAcceleration.x,userAcceleration.y,userAcceleration.z,gx,gy,gz",
            "gravity.x,gravity.y,gravity.z,gx,gy,gz",
            "accelerationIncludingGravity.x,accelerationIncludingGravity.y,accelerationIncludingGravity.z,acceleration.x,acceleration.y,acceleration.z",
            "FreeAcc_X,FreeAcc_Y,FreeAcc_Z,gravity.x,gravity.y,gravity.z",
        ] {
            assert_eq!(found(names), None, "{names}");
        }
    }
}
