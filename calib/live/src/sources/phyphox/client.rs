//! Requests to the phone.

use std::time::{Duration, Instant};

use calib::recording::shown::shown;
use findings::{Finding, Kind};
use ureq::Agent;

use crate::sources::Waits;

/// Largest answers, bytes: of the experiment, its pauses and its commands; of samples, a quarter of an hour at 500 Hz; of the
/// exported file.
const SMALL: u64 = 4 << 20;
const SAMPLES: u64 = 128 << 20;
const EXPORT: u64 = 512 << 20;

/// A phone's address.
///
/// Every request has a connection of its own: the server of phyphox does not keep them.
#[derive(Debug)]
pub(super) struct Client {
    pub(super) address: String,
    pub(super) waits: Waits,
    agent: Agent,
}

impl Client {
    pub(super) fn new(address: &str, waits: Waits) -> Self {
        let config = Agent::config_builder()
            .max_idle_connections(0)
            .max_redirects(0)
            .timeout_global(Some(waits.answer))
            .proxy(None)
            .user_agent("stillpoint")
            .build();
        Self {
            address: address.to_owned(),
            waits,
            agent: Agent::new_with_config(config),
        }
    }

    /// The answer to `path`, a short one.
    pub(super) fn get(&self, path: &str) -> Result<Vec<u8>, Box<Finding>> {
        self.get_within(path, self.waits.answer, SMALL)
    }

    /// The answer to `path`, which holds samples.
    pub(super) fn samples(&self, path: &str) -> Result<Vec<u8>, Box<Finding>> {
        self.get_within(path, self.waits.answer, SAMPLES)
    }

    /// The exported file, until an instant.
    pub(super) fn export(&self, path: &str, until: Instant) -> Result<Vec<u8>, Box<Finding>> {
        let left = until.saturating_duration_since(Instant::now());
        self.get_within(path, left.max(Duration::from_millis(1)), EXPORT)
    }

    /// Returns the body of the answer, at most `most` bytes. The text of an error may contain the phone's words.
    fn get_within(
        &self,
        path: &str,
        timeout: Duration,
        most: u64,
    ) -> Result<Vec<u8>, Box<Finding>> {
        let request = self.agent.get(format!("{}{path}", self.address));
        let request = request.header("Connection", "close");
        let request = request.config().timeout_global(Some(timeout)).build();
        let mut response = request.call().map_err(failed)?;
        let body = response.body_mut().with_config().limit(most);
        body.read_to_vec().map_err(failed)
    }
}

fn failed(error: ureq::Error) -> Box<Finding> {
    let found = Finding::of(Kind::REQUEST_FAILED);
    found.detail("reason", shown(&error.to_string())).into()
}

/// A buffer's name as part of a query.
pub(super) fn encoded(name: &str) -> String {
    let mut text = String::new();
    for byte in name.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'_' | b'-' | b'.' => {
                text.push(char::from(byte))
            }
            _ => text.push_str(&format!("%{byte:02X}")),
        }
    }
    text
}
