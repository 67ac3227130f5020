//! The page: its parts in one file, and the policy that holds for it.

use std::io::Write;
use std::num::NonZeroU64;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;
use sha2::{Digest, Sha256};
use zopfli::{Format, Options};

/// Passes over the program that make it smaller: the first of them gains nine tenths of what fifteen gain.
const PASSES: NonZeroU64 = NonZeroU64::MIN;

/// The parts of the page.
#[derive(Debug)]
pub struct Parts<'a> {
    /// The document, with `{{name}}` where a part goes.
    pub template: String,
    /// Its style.
    pub style: String,
    /// Its script, a module.
    pub script: String,
    /// The script of its threads.
    pub worker: String,
    /// The program, WebAssembly.
    pub program: &'a [u8],
}

/// The document. It loads nothing, sends nothing, and runs the one script whose hash stands in its policy.
///
/// # Errors
/// A part that would end its own element, a place of the template that is not there.
pub fn page(parts: &Parts) -> Result<String, String> {
    let program = BASE64_STANDARD.encode(squeezed(parts.program)?);
    let policy = policy(&parts.script, &parts.style);
    let filled = [
        ("policy", policy.as_str()),
        ("version", env!("CARGO_PKG_VERSION")),
        ("style", &parts.style),
        ("worker", &parts.worker),
        ("script", &parts.script),
        // The largest one last: what is before it is not searched again.
        ("program", &program),
    ];
    let mut page = parts.template.clone();
    for (name, text) in filled {
        if text.to_lowercase().contains("</s") {
            return Err(format!("the {name} would end its own element with `</s…`"));
        }
        let place = format!("{{{{{name}}}}}");
        let (before, after) = page
            .split_once(&place)
            .ok_or_else(|| format!("the template has no {place}"))?;
        page = [before, text, after].concat();
    }
    Ok(page)
}

/// Returns the content security policy of the page: its own script, the program and its threads, and no network.
fn policy(script: &str, style: &str) -> String {
    let hash = |text: &str| format!("'sha256-{}'", BASE64_STANDARD.encode(Sha256::digest(text)));
    format!(
        "default-src 'none'; script-src {} 'wasm-unsafe-eval'; style-src {}; worker-src blob:; img-src data:; base-uri 'none'; \
         form-action 'none'",
        hash(script),
        hash(style)
    )
}

/// Bytes as gzip has them, 4 % smaller than gzip makes them, in some twenty seconds; the same for the same bytes.
///
/// # Errors
/// None that memory does not give.
fn squeezed(bytes: &[u8]) -> Result<Vec<u8>, String> {
    let options = Options {
        iteration_count: PASSES,
        ..Options::default()
    };
    let mut all = Vec::new();
    zopfli::compress(options, Format::Gzip, bytes, &mut all).map_err(|error| error.to_string())?;
    Ok(all)
}

/// Bytes as gzip has them, as a server sends them.
///
/// # Errors
/// None that memory does not give.
pub fn compressed(bytes: &[u8]) -> Result<Vec<u8>, String> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder
        .write_all(bytes)
        .and_then(|()| encoder.finish())
        .map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts() -> Parts<'static> {
        Parts {
            template: include_str!("../index.html").to_owned(),
            style: "p{margin:0}".to_owned(),
            script: "f();".to_owned(),
            worker: "g();".to_owned(),
            program: b"\0asm",
        }
    }

    #[test]
    fn the_policy_names_the_one_script_and_the_one_style_and_no_network() {
        let page = page(&parts()).unwrap();
        // `printf 'f();' | openssl dgst -sha256 -binary | base64`
        let hash = BASE64_STANDARD.encode(Sha256::digest("f();"));
        assert!(page.contains(&format!("script-src 'sha256-{hash}' 'wasm-unsafe-eval';")));
        assert!(page.contains("default-src 'none'") && !page.contains("unsafe-inline"));
        assert!(
            !page.contains("connect-src") && !page.contains("http:") && !page.contains("https:")
        );
        assert!(page.contains("<script type=\"module\">f();</script>"));
        assert!(page.contains("<style>p{margin:0}</style>"));
        assert!(!page.contains("{{"));
    }

    #[test]
    fn a_part_that_would_end_its_element_is_refused() {
        let script = "x = '</Script>'".to_owned();
        let broken = Parts { script, ..parts() };
        assert!(page(&broken).unwrap_err().contains("script"));
    }
}
