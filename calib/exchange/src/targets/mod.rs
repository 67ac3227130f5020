//! One file per target, and their list.

mod ardupilot;
pub(crate) mod code;
mod document;
mod imu_tk;
mod in_force;
mod kalibr;
mod matlab;
mod npz;
mod numpy;
mod px4;
mod ros;
mod ros2;
mod toml_table;

use crate::target::Target;

/// Every target.
pub static TARGETS: [&Target; 12] = [
    &imu_tk::TARGET,
    &kalibr::TARGET,
    &ros::TARGET,
    &ros2::TARGET,
    &px4::TARGET,
    &ardupilot::TARGET,
    &code::c_header::TARGET,
    &code::rust_module::TARGET,
    &toml_table::TARGET,
    &matlab::TARGET,
    &numpy::TARGET,
    &npz::TARGET,
];

/// The target that `--to` calls so.
pub fn by_name(name: &str) -> Option<&'static Target> {
    TARGETS.into_iter().find(|target| target.name == name)
}
