//! The sensor effects that are known: the catalogues of the sensors' crates, and effects that users write.

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod catalogue;
pub mod covariates;
pub mod effect_file;

pub use catalogue::{
    catalogue, catalogue_of, earth_rotation, effect_named, follows_turns, force_sensitivity,
    relaxation, room_field, stands_in_the_room,
};
