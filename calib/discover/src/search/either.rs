//! A disturbance that may be something else.

use estimate::methods::joint::Known;

use crate::family::Claim;

/// A disturbance with what else it may be.
#[derive(Clone, Debug, PartialEq)]
pub struct Either {
    /// Disturbance in the model.
    pub known: Known,
    /// Names of what explains the data about as well.
    pub or: Vec<String>,
}

impl Either {
    /// `None` where nothing has another name.
    pub(super) fn of(known: Known, ties: impl Iterator<Item = String>) -> Option<Self> {
        let own = Claim::Disturbed(known.fault);
        let mut or: Vec<String> = Vec::new();
        for name in ties {
            if name != own.name() && !or.contains(&name) {
                or.push(name);
            }
        }
        (!or.is_empty()).then_some(Self { known, or })
    }
}
