//! Many runs in one call: one problem from many starts, many problems of one shape.

pub(crate) mod batch;
pub(crate) mod multistart;
