//! Kinds of findings: the physical cause or the consequence of each, by a stable name.

/// Declares the kinds with their names; a kind's words stand in [`crate::words`].
macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident = $name:literal,)*) => {
        /// Physical cause or consequence that a finding names. The names are stable.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[non_exhaustive]
        pub enum Kind {
            $($(#[$doc])* $kind,)*
        }

        impl Kind {
            /// Every kind, in the order of the manual.
            pub const ALL: &'static [Self] = &[$(Self::$kind,)*];

            /// Name in snake case, as documents have it.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$kind => $name,)*
                }
            }

            /// Kind of a name; [`Kind::Remark`] of a name that this version does not know.
            pub fn named(name: &str) -> Self {
                match name {
                    $($name => Self::$kind,)*
                    _ => Self::Remark,
                }
            }
        }
    };
}

kinds! {
    // Fit and model.
    /// The fit leaves more than the noise explains.
    Misfit = "misfit",
    /// An effect that the model lacks shows in the residuals though no channel misfits as a whole.
    EffectMissing = "effect_missing",
    /// A parameter is known too badly to be used with ease.
    WeakParameter = "weak_parameter",
    /// Directions are missing among the placements.
    PlacementsMissing = "placements_missing",
    /// One static interval alone carries a parameter.
    InfluentialInterval = "influential_interval",
    /// Gravity was assumed.
    GravityAssumed = "gravity_assumed",
    /// The height was assumed.
    AltitudeAssumed = "altitude_assumed",
    // Last of all.
    /// A finding of another version, or one with a text of its own.
    Remark = "remark",
}
