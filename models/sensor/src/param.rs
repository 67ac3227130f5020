//! The parameters of an effect: names and units.

use std::borrow::Cow;

/// One parameter of an effect.
#[derive(Clone, Debug, PartialEq)]
pub struct Param {
    /// Name within the effect, such as `xx`.
    pub name: Cow<'static, str>,
    /// Unit.
    pub unit: Cow<'static, str>,
    /// Value of a perfect sensor, at which the effect is silent.
    pub nominal: f64,
    /// Size in a consumer-grade device, where it is not that of the effect.
    pub typical: Option<f64>,
    /// Role of the parameter.
    pub role: Role,
    /// Values at which it is tried where it has to be found; empty where it is a factor, or where the usual ones do.
    pub tried: &'static [f64],
}

/// Role of a parameter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Role {
    /// A factor: it belongs to the device.
    #[default]
    Coefficient,
    /// A number that the error does not grow with, such as a period: it belongs to the device.
    Shape,
    /// A time in which something settles, s: it belongs to the device.
    TimeConstant,
    /// When something happened, s since the start of a recording: it belongs to that recording and means nothing in
    /// another.
    Instant,
    /// A direction or level that the device is seen against, in the frame of one recording.
    Reference,
}

impl Param {
    /// A parameter with the value it has in a perfect sensor.
    ///
    /// # Examples
    /// ```
    /// use stillpoint_sensor::{Param, Role};
    ///
    /// const PARAMS: [Param; 2] = [
    ///     Param::new("z", "rad/s", 0.0).sized(1e-3),
    ///     Param::new("tau", "s", 60.0).in_role(Role::TimeConstant).tried_at(&[20.0, 60.0, 180.0]),
    /// ];
    /// assert_eq!(PARAMS[1].nominal, 60.0);
    /// ```
    pub const fn new(name: &'static str, unit: &'static str, nominal: f64) -> Self {
        Self {
            name: Cow::Borrowed(name),
            unit: Cow::Borrowed(unit),
            nominal,
            typical: None,
            role: Role::Coefficient,
            tried: &[],
        }
    }

    /// The same with values at which it is tried where it has to be found.
    #[must_use]
    pub const fn tried_at(mut self, tried: &'static [f64]) -> Self {
        self.tried = tried;
        self
    }

    /// The same in another role.
    #[must_use]
    pub const fn in_role(mut self, role: Role) -> Self {
        self.role = role;
        self
    }

    /// The same with a size of its own in a consumer-grade device.
    #[must_use]
    pub const fn sized(mut self, typical: f64) -> Self {
        self.typical = Some(typical);
        self
    }
}

/// Parameters that share a unit and are zero for a perfect sensor.
///
/// # Examples
/// ```
/// use stillpoint_sensor::{Param, params};
///
/// const PARAMS: &[Param] = &params("rad/s/K", ["x", "y", "z"]);
/// assert_eq!((&*PARAMS[2].name, &*PARAMS[2].unit, PARAMS[2].nominal), ("z", "rad/s/K", 0.0));
/// ```
pub const fn params<const N: usize>(unit: &'static str, names: [&'static str; N]) -> [Param; N] {
    let mut all = [const { Param::new("", "", 0.0) }; N];
    let mut k = 0;
    while k < N {
        // What stood there owns nothing; a constant function may not drop it all the same.
        std::mem::forget(std::mem::replace(
            &mut all[k],
            Param::new(names[k], unit, 0.0),
        ));
        k += 1;
    }
    all
}

/// Parameters `x`, `y` and `z`, one for each axis, as of [`params`].
pub const fn axes(unit: &'static str) -> [Param; 3] {
    params(unit, ["x", "y", "z"])
}

/// The same, and one more.
pub const fn axes_and(unit: &'static str, last: Param) -> [Param; 4] {
    [
        Param::new("x", unit, 0.0),
        Param::new("y", unit, 0.0),
        Param::new("z", unit, 0.0),
        last,
    ]
}
