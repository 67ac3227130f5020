//! Tests of suspected faults, which need no refit, and what the readings themselves show of them.

pub(crate) mod belief;
pub(crate) mod broken;
pub(crate) mod gross;
pub(crate) mod judgement;
pub(crate) mod shake;
pub(crate) mod trial;
pub(crate) mod trim;
