//! Nothing of its own: see `benches/per_iteration.rs` and `scipy_table.py`.
