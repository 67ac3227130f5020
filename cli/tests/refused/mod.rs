//! Refusals by the system, and of visitors.

mod hostile_web;
mod refused_by_the_system;
