//! The session as a page on 127.0.0.1.
//!
//! The address holds a random token, requests must name this machine as their host (so that a name that an attacker points
//! here is refused), and the page may run and load nothing but itself.

use std::net::{SocketAddr, TcpListener};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use live::{Direction, View};
use serde_json::{Value, json};

use super::finish::Finish;
use super::visitors::Visitors;
use super::words;
use crate::exit::{Failure, OUTPUT};

const PAGE: &str = include_str!("page.html");

/// Files that the page offers after the session, and their media types.
const NAMES: [&str; 2] = ["cal.json", "report.html"];
const KINDS: [&str; 2] = ["application/json", "text/html"];

/// State shared by the threads that answer requests.
#[derive(Debug)]
struct Shared {
    address: SocketAddr,
    token: String,
    page: String,
    policy: String,
    state: Mutex<State>,
}

/// State of the session for the page.
#[derive(Debug)]
struct State {
    /// The session, and what it came to.
    document: Value,
    /// `cal.json` and `report.html`, once they are there.
    files: Option<[String; 2]>,
    /// When the page asked last.
    asked: Option<Instant>,
}

/// A page asks five times a second, behind another one once a minute; it is closed where it has not for so long.
const CLOSED: Duration = Duration::from_secs(70);

/// A page that follows the session.
#[derive(Debug)]
pub(super) struct Web(Arc<Shared>);

impl Web {
    /// Begins to answer, on a port that is free.
    pub(super) fn start() -> Result<Self, Failure> {
        let refused =
            |why: String| Failure::new(OUTPUT, format!("--web: {why}")).advise("leave it out");
        let listener = TcpListener::bind(("127.0.0.1", 0)).map_err(|e| refused(e.to_string()))?;
        let address = listener.local_addr().map_err(|e| refused(e.to_string()))?;
        let [token, nonce] = [random().map_err(&refused)?, random().map_err(&refused)?];
        let policy = format!(
            "default-src 'none'; script-src 'nonce-{nonce}'; style-src 'nonce-{nonce}'; connect-src 'self'; base-uri 'none'; \
             form-action 'none'; frame-ancestors 'none'"
        );
        let shared = Arc::new(Shared {
            address,
            token,
            page: PAGE.replace("NONCE", &nonce),
            policy,
            state: Mutex::new(State {
                document: json!({}),
                files: None,
                asked: None,
            }),
        });
        let answering = Arc::clone(&shared);
        let thread = std::thread::Builder::new().name("page".into());
        let thread = thread.spawn(move || {
            Visitors::new(listener).serve(|request| answering.answer(request));
        });
        thread.map_err(|e| refused(e.to_string()))?;
        Ok(Self(shared))
    }

    /// Returns the address of the page.
    pub(super) fn address(&self) -> String {
        format!("http://{}/{}/", self.0.address, self.0.token)
    }

    /// Shows this from now on.
    pub(super) fn publish(&self, view: &View) {
        let [what, more] = words::instruction(&view.instruction);
        let candidates: Vec<_> = Direction::all()
            .iter()
            .map(|d| json!({"up": <[f64; 3]>::from(d.unit()), "name": words::axes(d)}))
            .collect();
        let document = json!({
            "view": view,
            "what": what,
            "more": more,
            "known": words::known(view),
            "aim": view.wanted.filter(|_| !view.instruction.ends()).map(|d| <[f64; 3]>::from(d.unit())),
            "candidates": candidates,
        });
        self.0.state().document = document;
    }

    /// Shows what the session came to, and offers it.
    pub(super) fn finish(&self, finish: &Finish) {
        let mut state = self.0.state();
        state.document["result"] = finish.shown.clone();
        state.files = Some([finish.calibration.clone(), finish.report.clone()]);
    }

    /// Shows why there is no calibration; one that is there already stays.
    pub(super) fn refuse(&self, why: &str) {
        let mut state = self.0.state();
        if state.files.is_none() {
            state.document["result"] = json!({
                "level": "bad", "verdict": "✗ No calibration", "sentence": why, "figures": [], "next": [], "files": false,
            });
        }
    }

    /// Returns true if somebody has the page open.
    pub(super) fn is_open(&self) -> bool {
        let asked = self.0.state().asked;
        asked.is_some_and(|asked| asked.elapsed() < CLOSED)
    }
}

/// Returns true if the first line of a request asks for a file of this name.
fn asked_for(request: &[u8], name: &str) -> bool {
    let line = request.split(|b| *b == b'\r').next().unwrap_or(request);
    let path = line.split(|b| *b == b' ').nth(1).unwrap_or(line);
    path.ends_with(name.as_bytes())
}

/// 128 bits that nobody can foresee.
fn random() -> Result<String, String> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).map_err(|e| e.to_string())?;
    Ok(bytes.iter().map(|b| format!("{b:02x}")).collect())
}

impl Shared {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The whole answer to a request.
    fn answer(&self, request: &[u8]) -> Vec<u8> {
        let (status, kind, body) = self.reply(request);
        // A file to keep is saved, not shown: the report's style and script have a policy of their own.
        let is_file = kind != "text/plain" && NAMES.iter().any(|name| asked_for(request, name));
        let attached = if is_file {
            "Content-Disposition: attachment\r\n"
        } else {
            ""
        };
        let head = format!(
            "HTTP/1.1 {status}\r\nContent-Type: {kind}; charset=utf-8\r\nContent-Length: {}\r\nContent-Security-Policy: {}\r\n\
             {attached}X-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\nCross-Origin-Resource-Policy: same-origin\r\n\
             Cache-Control: no-store\r\nConnection: close\r\n\r\n",
            body.len(),
            self.policy
        );
        [head.as_bytes(), body.as_bytes()].concat()
    }

    /// Status, kind and content of the answer to a request.
    fn reply(&self, request: &[u8]) -> (&'static str, &'static str, String) {
        let mut headers = [httparse::EMPTY_HEADER; 64];
        let mut parsed = httparse::Request::new(&mut headers);
        let refused = |status, why: &str| (status, "text/plain", format!("{why}\n"));
        if !parsed
            .parse(request)
            .is_ok_and(|status| status.is_complete())
        {
            return refused("400 Bad Request", "no request");
        }
        let mut hosts = parsed
            .headers
            .iter()
            .filter(|h| h.name.eq_ignore_ascii_case("host"));
        let port = self.address.port();
        let own = [format!("127.0.0.1:{port}"), format!("localhost:{port}")];
        let is_own =
            |host: &httparse::Header<'_>| own.iter().any(|name| name.as_bytes() == host.value);
        if !hosts.next().is_some_and(is_own) || hosts.next().is_some() {
            return refused("403 Forbidden", "this page answers to its own address only");
        }
        if parsed.method != Some("GET") {
            return refused("405 Method Not Allowed", "GET only");
        }
        let path = parsed.path.unwrap_or("").strip_prefix('/').unwrap_or("");
        match path.split_once('/') {
            Some((token, "")) if token == self.token => ("200 OK", "text/html", self.page.clone()),
            Some((token, "state")) if token == self.token => {
                let mut state = self.state();
                state.asked = Some(Instant::now());
                ("200 OK", "application/json", state.document.to_string())
            }
            Some((token, name)) if token == self.token && NAMES.contains(&name) => {
                let file = NAMES.iter().position(|own| *own == name);
                let state = self.state();
                let content = state
                    .files
                    .as_ref()
                    .zip(file)
                    .map(|(all, k)| all[k].clone());
                match content {
                    Some(content) => ("200 OK", KINDS[file.unwrap_or(0)], content),
                    None => refused("404 Not Found", "the session is not over yet"),
                }
            }
            _ => refused(
                "404 Not Found",
                "nothing here; the address that the program prints has a token",
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn status(web: &Web, host: &str, path: &str) -> &'static str {
        let request = format!("GET {path} HTTP/1.1\r\nHost: {host}\r\n\r\n");
        web.0.reply(request.as_bytes()).0
    }

    #[test]
    fn only_the_own_host_with_the_token_is_answered() {
        let web = Web::start().unwrap();
        let own = web.0.address.to_string();
        let page = format!("/{}/", web.0.token);
        assert_eq!(status(&web, &own, &page), "200 OK");
        assert_eq!(status(&web, &own, &format!("{page}state")), "200 OK");
        assert_eq!(status(&web, "evil.example:80", &page), "403 Forbidden");
        assert_eq!(
            status(&web, &format!("{own}\r\nHost: evil.example"), &page),
            "403 Forbidden"
        );
        for path in ["/", "/state", "/0123/", &format!("{page}other")] {
            assert_eq!(status(&web, &own, path), "404 Not Found", "{path}");
        }
        assert_eq!(web.0.reply(b"POST / HTTP/1.1\r\n\r\n").0, "403 Forbidden");
        assert_eq!(web.0.reply(b"\0\0\r\n\r\n").0, "400 Bad Request");
    }

    #[test]
    fn files_are_there_to_be_saved_once_the_session_is_over() {
        let web = Web::start().unwrap();
        let own = web.0.address.to_string();
        let get = |name: &str| {
            let token = &web.0.token;
            let request = format!("GET /{token}/{name} HTTP/1.1\r\nHost: {own}\r\n\r\n");
            String::from_utf8(web.0.answer(request.as_bytes())).unwrap()
        };
        assert!(get("cal.json").starts_with("HTTP/1.1 404"));
        assert!(!web.is_open());
        let shown = json!({"verdict": "✓ Good"});
        web.finish(&Finish {
            shown,
            calibration: "{}\n".into(),
            report: "<p>report</p>".into(),
        });
        let (calibration, report) = (get("cal.json"), get("report.html"));
        assert!(calibration.starts_with("HTTP/1.1 200") && calibration.ends_with("{}\n"));
        assert!(
            report.ends_with("<p>report</p>") && report.contains("attachment"),
            "{report}"
        );
        assert!(get("state").contains("✓ Good") && !get("state").contains("attachment"));
        assert!(web.is_open());
        // What stands is not taken back by a gate that fails afterwards.
        web.refuse("a limit fails");
        assert!(get("state").contains("✓ Good"));
    }

    #[test]
    fn the_page_loads_and_runs_nothing_but_itself() {
        let web = Web::start().unwrap();
        assert!(
            !web.0.page.contains("src=")
                && !web.0.page.contains("http://")
                && !web.0.page.contains("https://")
        );
        assert!(
            !web.0.page.contains("NONCE")
                && !web.0.page.contains(" style=\"")
                && !web.0.page.contains(" onclick")
        );
        assert!(
            web.0
                .policy
                .starts_with("default-src 'none'; script-src 'nonce-")
        );
    }
}
