//! Large problems for the graph of the solver: bundle adjustment and pose graphs, read from the
//! files in which they are exchanged and made up.
//!
//! | problem | residual | files | made up |
//! |---|---|---|---|
//! | bundle adjustment | [`reprojection`] | [`bal`] | [`cameras`] |
//! | pose graph | [`poses`] | [`g2o`] | [`walks`] |
//! | shared parameters | [`groups`] | | [`groups`] |

pub mod bal;
pub mod cameras;
pub mod g2o;
pub mod groups;
pub mod poses;
pub mod reprojection;
pub mod walks;
