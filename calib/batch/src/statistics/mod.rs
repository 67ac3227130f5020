//! Statistics over many devices, for the monitoring of a production line.

mod control;
mod drift;
mod robust;
mod yields;

pub use control::{Chart, individuals, means_by_lot, spreads_by_lot};
pub use drift::{StationShift, TimeDrift, by_station, over_time, seconds};
pub use robust::{Outlier, median, outliers, robust_location_scatter, spread};
pub use yields::{Cause, SharedEffect, Yield, cared, pareto, shared_effects, yields};
