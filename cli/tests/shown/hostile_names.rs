//! Names from outside stay text: in reports, pictures, JSON and on the terminal.

use std::path::Path;
use std::process::Command;

use crate::common::{folder, stderr, stdout, stillpoint};
use stillpoint_tests::needed_data::skipped;

/// Markup, an escape sequence in both spellings, a change of direction, a new line.
const NASTY: &str = "<img src=x onerror=alert(1)></script>&\"'\u{1b}[31m\u{9b}2J\u{202e}\u{7f}\nstillpoint: all good";

/// Elements that our pages and pictures are made of.
const OURS: [&str; 37] = [
    "html",
    "head",
    "meta",
    "title",
    "style",
    "body",
    "header",
    "main",
    "h1",
    "h2",
    "p",
    "div",
    "section",
    "table",
    "thead",
    "tbody",
    "tr",
    "th",
    "td",
    "dl",
    "dt",
    "dd",
    "span",
    "code",
    "ul",
    "ol",
    "li",
    "details",
    "summary",
    "figure",
    "figcaption",
    "pre",
    "svg",
    "g",
    "rect",
    "circle",
    "path",
];

/// The one script that a page runs.
const SCRIPT: &str = include_str!("../../templates/report.js");

/// True for characters that a terminal or a reader's eye may obey.
fn is_obeyed(c: char) -> bool {
    c.is_control() && c != '\n'
        || matches!(c, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Every tag of a page or picture is one of ours and runs nothing but our script: text cannot open a tag, for its `<`
/// is escaped.
fn is_plain(page: &str) {
    assert!(!page.contains(is_obeyed), "a character to obey");
    let script = format!("<script>{SCRIPT}</script>");
    let scripts = usize::from(page.starts_with("<!doctype"));
    assert_eq!(page.matches(&script).count(), scripts);
    let page = page.replace(&script, "");
    let mut rest = page.as_str();
    while let Some(at) = rest.find('<') {
        rest = &rest[at + 1..];
        let end = rest.find('>').expect("a tag without end");
        let tag = &rest[..end];
        if tag.starts_with('!') || tag.starts_with('?') {
            continue;
        }
        let name = tag
            .trim_start_matches('/')
            .split([' ', '\n', '/'])
            .next()
            .unwrap();
        assert!(OURS.contains(&name) || name == "text", "<{tag}>");
        let attributes = tag.split_whitespace().skip(1);
        for attribute in attributes.filter(|a| a.contains('=')) {
            let name = attribute.split('=').next().unwrap().to_lowercase();
            assert!(name != "style", "<{tag}>");
            let runs = name.starts_with("on")
                || ["href", "src", "srcset", "xlink:href"].contains(&name.as_str());
            // A quoted value may hold such words, but not behind a quote of its own.
            assert!(!runs || !attribute.contains("=\""), "<{tag}>");
        }
    }
}

/// The page as Chromium understands it, where that is installed.
fn as_chromium_sees(page: &Path) {
    let browsers = ["chromium", "chromium-browser", "google-chrome"];
    let dom = browsers.iter().find_map(|browser| {
        let profile = tempfile::tempdir().unwrap();
        let mut command = Command::new(browser);
        command.args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-quic",
        ]);
        command.args(["--no-first-run", "--disable-background-networking"]);
        command.args(["--disable-component-update", "--disable-sync", "--dump-dom"]);
        let mut folder = std::ffi::OsString::from("--user-data-dir=");
        folder.push(profile.path());
        command
            .arg(folder)
            .arg(page)
            .output()
            .ok()
            .filter(|output| output.status.success())
    });
    match dom {
        Some(dom) => {
            let dom = String::from_utf8_lossy(&dom.stdout);
            assert!(dom.contains("<h1>") && !dom.contains("<img"));
            // Our script has run under the policy of the page, and nothing else is one.
            assert_eq!(dom.matches("<script").count(), 1);
            assert!(dom.contains("<button"), "the script did not run");
        }
        None => skipped("no Chromium, the page was looked at by a parser only"),
    }
}

#[test]
fn names_from_outside_are_text_wherever_they_are_shown() {
    let (_dir, folder) = folder();
    let recording = format!("{NASTY}.csv").replace('/', "\\");
    let text = std::fs::read_to_string(folder.join("good.csv")).unwrap();
    let header = format!("t,ax,ay,az,gx,gy,gz,\"{}\"", NASTY.replace(['"', '\n'], ""));
    let rows = text.lines().skip(1).map(|line| format!("{line},1"));
    let rows: Vec<String> = std::iter::once(header).chain(rows).collect();
    if std::fs::write(folder.join(&recording), rows.join("\n") + "\n").is_err() {
        // A file system that has no such names.
        return;
    }
    let toml = serde_json::to_string(NASTY)
        .unwrap()
        .replace("\u{7f}", "\\u007f");
    let effect = format!(
        "[[definitions]]\nname = \"gyro_own\"\nsensor = \"gyroscope\"\nequation = {toml}\nx = \"k * wy * wz\"\n\
         parameters = [{{ name = \"k\", unit = {toml}, typical = 1e-2 }}]\n"
    );
    std::fs::write(folder.join("own.toml"), effect).unwrap();
    let label = format!("{NASTY}=cal.json");
    let recording = recording.as_str();
    let own = ["--effect-file", "own.toml"];
    let calls: [Vec<&str>; 9] = [
        [&["effects"][..], &own].concat(),
        [&["effects", "--json"][..], &own].concat(),
        [
            &[
                "calibrate",
                recording,
                "--effects",
                "gyro_own",
                "-o",
                "cal.json",
                "--report",
                "c.html",
                "--plots",
                "p",
            ][..],
            &own,
        ]
        .concat(),
        vec![
            "segment", recording, "-o", "s.json", "--report", "s.html", "--plots", "p",
        ],
        vec![
            "evaluate",
            recording,
            "--calibration",
            &label,
            "--report",
            "e.html",
        ],
        vec![
            "reckon",
            recording,
            "--motion",
            "21,24",
            "--calibration",
            &label,
            "-o",
            "k.json",
            "--report",
            "k.html",
        ],
        vec![
            "bias",
            "cal.json",
            recording,
            "--accelerometer",
            "--no-gyroscope",
            "-o",
            "b.json",
            "--report",
            "b.html",
        ],
        vec![
            "allan", recording, "--rest", "0,19", "-o", "a.json", "--report", "a.html",
        ],
        vec!["segment", recording, "--columns", "ax=<b>\u{1b}[2J"],
    ];
    for call in &calls {
        let run = stillpoint(&folder, call);
        let (out, err) = (stdout(&run), stderr(&run));
        assert!(!out.contains(is_obeyed), "{call:?}: {}", out.escape_debug());
        assert!(!err.contains(is_obeyed), "{call:?}: {}", err.escape_debug());
        assert!(!err.contains("\nstillpoint: all good"), "{call:?}: {err}");
    }
    let mut pages = 0;
    for place in [folder.clone(), folder.join("p")] {
        for entry in std::fs::read_dir(place).unwrap() {
            let path = entry.unwrap().path();
            match path.extension().and_then(|e| e.to_str()) {
                Some("html" | "svg") => {
                    is_plain(&std::fs::read_to_string(&path).unwrap());
                    pages += 1;
                }
                Some("json") => {
                    let text = std::fs::read_to_string(&path).unwrap();
                    assert!(!text.contains(is_obeyed), "{}", path.display());
                    assert!(serde_json::from_str::<serde_json::Value>(&text).is_ok());
                }
                _ => {}
            }
        }
    }
    assert!(pages >= 6, "{pages}");
    as_chromium_sees(&folder.join("c.html"));
}
