//! What remains when everything of the catalogue has had its chance.

pub(super) mod by_interval;
pub(super) mod described;
pub(super) mod scatter;
pub(super) mod shape;
pub(super) mod shapes;
pub(super) mod unexplained;
pub(super) mod weighed_again;
pub(super) mod withdrawn;
