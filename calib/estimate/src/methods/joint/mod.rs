//! Accelerometer, gyroscope and effects in one weighted problem.
//!
//! ```text
//! rests, turns ──► Data ──► Rows r(x), J ──► Analysis: noise levels, disturbances ──► JointFit
//!                   chunks     chart, turn     restricted likelihood, score tests        covariance
//! ```
//!
//! A fit begins at a sphere through the means (`start`), decides the clock (`clock`), and goes to the minimum under the noise of the rows (`approach`).
//! Then noise and disturbances are judged there and the minimum is looked for again, until that bends no row (`run`); the last steps and the
//! covariance are those of the graph solver (`finish`).
//!
//! Parameters: both models, a bias per recording, and as nuisance the direction (2) of every static
//! interval. Rows: mean readings of chunks of rests against what the model predicts there, and the
//! direction before each turn carried through it against the one after. Weights come from the
//! recordings' own noise: white noise within the rests, carried through the turns, and random
//! walk of the biases between all rows, its density by restricted likelihood. Because the directions
//! are parameters, two turns that share a rest share no noise: their rows are independent given it, and
//! their correlation through it is in the covariance of the result.
//!
//! Recordings share parameters and no noise. Jacobian, covariances, projections and likelihoods are cut into
//! the rows of each (`blocks`), and the last steps are those of a graph with a factor for every recording (`graph`): time and
//! memory grow with the number of recordings and no faster.

mod approach;
mod blocks;
mod clock;
mod data;
mod disturbance;
mod faults;
mod finish;
mod fit;
mod graph;
mod minimum;
mod noise;
mod orientation;
mod request;
mod result;
mod rows;
mod run;
mod start;

pub use blocks::basis::Basis;
pub use blocks::column::Column;
pub use blocks::columns::{Columns, Part};
pub use blocks::covariance::Covariance;
pub use blocks::groups::RowGroups;
pub use clock::sampling::Share;
pub use clock::undersampled::Undersampled;
pub use clock::{ClockMode, ClockState, SourceClock, TurnClock};
pub use data::budget::IN_A_SEARCH;
pub(crate) use data::budget::STATIC_INTERVALS;
pub use data::{Chunk, Data, LostTurn, Mean, Rest, Source, TurnSamples};
pub use faults::{
    DISTURBED_INTERVAL, FAULTS, Fault, FaultRef, Flagged, OUTLYING_TURN, RATE_EXCURSION, Reason,
    Scope, Seen, Site, Suspect, suspects, suspects_beside_biases,
};
pub use fit::JointFit;
pub use noise::SensorNoise;
pub use noise::bias::{BiasNoise, Within, within};
pub use noise::chain::{Chain, Link};
pub use noise::likelihood::{Restricted, left_null_space};
pub use noise::rows::RowNoise;
pub use noise::stations::{Station, Stations};
pub use noise::weights::covariance_at;
pub use noise::weights::{Component, ComponentKind, Form, NoiseLevel, White, Whitening};
pub use orientation::interval::Oriented;
pub use orientation::{Pattern, Shown, StaticNumbers};
pub use request::{JointRequest, Known};
pub use result::apart::{Apart, PartChange, Portion};
pub use result::channel::Channel;
pub use result::influence::Influence;
pub use result::left_out::ErrorLeftOut;
pub use result::marginal::{columns, orthonormal, without};
pub use result::misfit::ChannelMisfit;
pub use result::missing::{Evidence, Missing};
pub use result::over_time::BiasMotion;
pub use result::prediction::Prediction;
pub use rows::chart::Chart;
pub use rows::error_columns::{
    Instant, Place, Sampling, effect_columns, effect_slopes, error_columns, step_columns,
};
pub use rows::layout::Layout;
pub use rows::sensitivity::{MeanSensitivity, Sensitivities, TurnSensitivity};
pub use rows::turn::Carried;
pub use rows::{Linear, Rows};
pub use run::fit_joint;
