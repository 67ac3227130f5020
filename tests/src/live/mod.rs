//! A simulated phone that speaks phyphox's protocol, and a simulated person who does what a guided session says.
//!
//! ```text
//! person ──► attitude ──► phone: samples, buffers, pauses ──► server on 127.0.0.1 ──► live::Phyphox ──► live::Session
//!    ▲                                                                                                      │
//!    └────────────────────────────── instruction ───────────────────────────────────────────────────────────┘
//! ```
//! Time is simulated: every request for samples moves it on by a quarter of a second. Nothing sleeps.

mod person;
mod phone;
mod server;
mod sitting;

pub use person::{Habits, Person};
pub use phone::Phone;
pub use server::Server;
pub use sitting::{KINDS, Sitting, kind, phone, sit, sit_with};
