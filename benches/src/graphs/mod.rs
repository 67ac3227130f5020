//! Large problems for the graph of the solver: bundle adjustment and pose graphs, read from the
//! files in which they are exchanged and made up.
//!
//! | problem | residual | files | made up |
//! |---|---|---|---|
//! | bundle adjustment | [`solver::bundle_adjustment`] | there | [`cameras`] |
//! | pose graph | [`solver::pose_graph`] | there | [`walks`] |
//! | shared parameters | [`groups`] | | [`groups`] |

pub mod cameras;
pub mod groups;
pub mod walks;
