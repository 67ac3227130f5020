//! The parameters of an effect: names and units.

/// One parameter of an effect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Param {
    /// Name within the effect, such as `xx`.
    pub name: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Value of a perfect sensor, at which the effect is silent.
    pub nominal: f64,
    /// Size in a consumer-grade device, where it is not that of the effect.
    pub typical: Option<f64>,
}

impl Param {
    /// A parameter with the value it has in a perfect sensor.
    pub const fn new(name: &'static str, unit: &'static str, nominal: f64) -> Self {
        Self {
            name,
            unit,
            nominal,
            typical: None,
        }
    }

    /// The same with a size of its own in a consumer-grade device.
    #[must_use]
    pub const fn sized(self, typical: f64) -> Self {
        Self {
            typical: Some(typical),
            ..self
        }
    }
}

/// Parameters that share a unit and are zero for a perfect sensor.
pub const fn params<const N: usize>(unit: &'static str, names: [&'static str; N]) -> [Param; N] {
    let mut all = [Param {
        name: "",
        unit,
        nominal: 0.0,
        typical: None,
    }; N];
    let mut k = 0;
    while k < N {
        all[k].name = names[k];
        k += 1;
    }
    all
}
