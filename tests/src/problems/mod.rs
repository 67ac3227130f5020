//! Collections of least-squares problems with known minima, a file per collection.

pub mod nist;
