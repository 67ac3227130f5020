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
pub static TARGETS: [&dyn Target; 12] = [
    &imu_tk::ImuTk,
    &kalibr::Kalibr,
    &ros::Ros,
    &ros2::Ros2,
    &px4::Px4,
    &ardupilot::ArduPilot,
    &code::CHeader,
    &code::RustModule,
    &toml_table::TomlTable,
    &matlab::Matlab,
    &numpy::NumPy,
    &npz::Npz,
];

/// The target that `--to` calls so.
pub fn by_name(name: &str) -> Option<&'static dyn Target> {
    TARGETS.into_iter().find(|target| target.name() == name)
}
