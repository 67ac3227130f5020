//! Requests to the phone.

use std::time::Duration;

use ureq::Agent;

/// Longest wait for an answer.
const TIMEOUT: Duration = Duration::from_secs(5);
/// Longest wait for the exported file.
const EXPORT_TIMEOUT: Duration = Duration::from_secs(120);
/// Largest answer, bytes.
const LARGEST: u64 = 512 << 20;

/// A phone's address.
///
/// Every request has a connection of its own: the server of phyphox does not keep them.
#[derive(Debug)]
pub(super) struct Client {
    pub(super) address: String,
    agent: Agent,
}

impl Client {
    pub(super) fn new(address: &str) -> Self {
        let config = Agent::config_builder()
            .max_idle_connections(0)
            .max_redirects(0)
            .timeout_global(Some(TIMEOUT))
            .proxy(None)
            .user_agent("stillpoint")
            .build();
        Self {
            address: address.to_owned(),
            agent: Agent::new_with_config(config),
        }
    }

    /// The answer to `path`.
    pub(super) fn get(&self, path: &str) -> Result<Vec<u8>, String> {
        self.get_within(path, TIMEOUT)
    }

    /// The exported file: it takes the phone a while to write.
    pub(super) fn export(&self, path: &str) -> Result<Vec<u8>, String> {
        self.get_within(path, EXPORT_TIMEOUT)
    }

    fn get_within(&self, path: &str, timeout: Duration) -> Result<Vec<u8>, String> {
        let request = self.agent.get(format!("{}{path}", self.address));
        let request = request.header("Connection", "close");
        let request = request.config().timeout_global(Some(timeout)).build();
        let mut response = request.call().map_err(|e| e.to_string())?;
        let body = response.body_mut().with_config().limit(LARGEST);
        body.read_to_vec().map_err(|e| e.to_string())
    }
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
