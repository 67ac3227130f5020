//! Accelerometer, gyroscope and effects in one weighted problem.
//!
//! ```text
//! rests, turns ──► Data ──► Rows r(x), J ──► Analysis: noise levels, disturbances ──► JointFit
//!                   chunks     chart, turn     restricted likelihood, score tests        covariance
//! ```
//!
//! Parameters: both models, a bias per recording, and as nuisance the direction (2) of every static
//! interval. Rows: mean readings of chunks of rests against what the model foretells there, and the
//! direction before each turn carried through it against the one after. Weights come from the
//! recordings' own noise: white noise within the rests, carried through the turns, and random
//! walk of the biases between all rows, its density by restricted likelihood. Because the directions
//! are parameters, two turns that share a rest share no noise: their rows are independent given it, and
//! their correlation through it is in the covariance of the result.

mod analysis;
mod approach;
mod attitudes;
mod belief;
mod bias_noise;
mod blocks;
mod broken;
mod budget;
mod centred;
mod chart;
mod clock;
mod clock_fit;
mod coning;
mod data;
mod disturbance;
mod earth;
mod error_columns;
mod exposure;
mod finish;
mod fit;
mod influence;
mod judgement;
mod knowledge;
mod layout;
mod left_out;
mod likelihood;
mod marginal;
mod minimum;
mod misfit;
mod noise;
mod orientation;
mod oriented;
mod oriented_interval;
mod over_time;
mod prediction;
mod problem;
mod request;
mod result;
mod rounding;
mod row_noise;
mod run;
mod sampling;
mod sensitivity;
mod shake;
mod slopes;
mod start;
mod trial;
mod trim;
mod turn;
mod undersampled;
mod values;
mod walk_filter;
mod walks;
mod weights;
mod windows;

pub use bias_noise::{BiasNoise, Within, within};
pub use budget::{MOST_IN_A_SEARCH, MOST_STATIC_INTERVALS, within_budget};
pub use chart::Chart;
pub use clock::{ClockMode, ClockState, SourceClock, TurnClock};
pub use data::{Chunk, Data, LostTurn, Mean, Rest, Source, TurnSamples};
pub use disturbance::{Disturbance, Suspect, excursions, suspects};
pub use error_columns::{
    Instant, Place, Sampling, effect_columns, effect_slopes, error_columns, step_columns,
};
pub use fit::JointFit;
pub use influence::Influence;
pub use layout::Layout;
pub use likelihood::{Restricted, both_sides, left_null_space};
pub use marginal::{columns, orthonormal, without};
pub use misfit::ChannelMisfit;
pub use noise::SensorNoise;
pub use orientation::{Pattern, Shown, StaticNumbers};
pub use oriented_interval::Oriented;
pub use over_time::BiasMotion;
pub use prediction::Prediction;
pub use problem::{Linear, Rows};
pub use request::{Accused, JointRequest, Known};
pub use result::Channel;
pub use row_noise::RowNoise;
pub use run::fit_joint;
pub use sampling::Share;
pub use sensitivity::{MeanSensitivity, Sensitivities, TurnSensitivity};
pub use turn::Carried;
pub use undersampled::Undersampled;
pub use weights::covariance_at;
pub use weights::{Component, ComponentKind, NoiseLevel, White, Whitening};
