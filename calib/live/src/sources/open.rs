//! From a name to what delivers samples.

use std::path::Path;

use crate::sources::error::Error;
use crate::sources::lines::Lines;
use crate::sources::phyphox::Phyphox;
use crate::sources::{Opening, Source};

/// Opens what `name` says: the address of a phone (`http://HOST:PORT`, `HOST:PORT`), `-`, a serial port or a file that
/// grows.
///
/// # Errors
/// A name that is neither; a phone that does not answer or lacks a sensor; a file that cannot be opened.
pub fn open(name: &str, how: &Opening) -> Result<Box<dyn Source>, Error> {
    let path = Path::new(name);
    // What the system does not tell of is opened, which says why.
    let is_there = path.try_exists().unwrap_or(address(name).is_none());
    if name == "-" || is_there {
        return Ok(Box::new(Lines::open(path, how)?));
    }
    match address(name) {
        Some(address) => Ok(Box::new(Phyphox::connect(&address, how)?)),
        None => Err(Error::NoSource(name.to_owned())),
    }
}

/// `http://host:port` of what may be an address.
fn address(name: &str) -> Option<String> {
    let bare = name.strip_prefix("http://").unwrap_or(name);
    let bare = bare.trim_end_matches('/');
    let (host, port) = bare.rsplit_once(':').unwrap_or((bare, "80"));
    let is_host = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '-');
    let is_port = port.parse::<u16>().is_ok_and(|port| port > 0);
    let marked = name.starts_with("http://")
        || bare.contains(':')
        || bare.parse::<std::net::Ipv4Addr>().is_ok();
    let host_fits = !host.is_empty() && host.chars().all(is_host);
    (marked && is_port && host_fits).then(|| format!("http://{host}:{port}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_address_is_told_from_a_path() {
        assert_eq!(
            address("192.168.0.12:8080").as_deref(),
            Some("http://192.168.0.12:8080")
        );
        assert_eq!(
            address("http://phone.local:8080/").as_deref(),
            Some("http://phone.local:8080")
        );
        assert_eq!(address("10.0.0.7").as_deref(), Some("http://10.0.0.7:80"));
        for path in [
            "log.txt",
            "/dev/ttyUSB9",
            "a b:80",
            "https://phone:80",
            "phone:0",
        ] {
            assert_eq!(address(path), None, "{path}");
        }
    }
}
