//! Reports as a browser shows them: nothing sticks out, no text lies on another, the policy holds, the size is bounded.

use std::path::Path;

use crate::common::{browsed, chromium, status, stderr, stillpoint};

/// A session of so many placements, 10 s each at 100 Hz.
fn session(folder: &Path, name: &str, placements: usize, more: &str) {
    let spec = format!(
        "seed = 21\nrate = 100.0\ngrade = \"consumer\"\n[motion.hand_held]\nplacements = {placements}\n\
         initial_rest = 60.0\n{more}"
    );
    std::fs::write(folder.join("spec.toml"), spec).unwrap();
    let made = stillpoint(folder, &["simulate", "spec.toml", "-o", name, "--force"]);
    assert_eq!(status(&made), 0, "{}", stderr(&made));
}

#[test]
fn a_report_of_180_000_samples_has_at_most_250_kb() {
    let dir = tempfile::tempdir().unwrap();
    session(
        dir.path(),
        "long",
        130,
        "rest = [10.5, 11.5]\n[effects.accel_cubic]\nsize = 2.0\n",
    );
    let rows = std::fs::read_to_string(dir.path().join("long/acc.csv")).unwrap();
    assert!(rows.lines().count() > 180_000, "{}", rows.lines().count());
    for command in ["calibrate", "discover"] {
        let args = [command, "long", "--report", "long.html", "--force"];
        let run = stillpoint(dir.path(), &args);
        assert!(status(&run) <= 1, "{}", stderr(&run));
        let bytes = std::fs::metadata(dir.path().join("long.html"))
            .unwrap()
            .len();
        assert!(bytes <= 250_000, "{command}: {bytes} bytes");
    }
}

/// What sticks out of a page, and texts of a picture that lie on each other or are cut.
const LOOK: &str = r"
const faults = [], root = document.documentElement;
if (root.scrollWidth > root.clientWidth) faults.push(`${root.scrollWidth} of ${root.clientWidth} dots`);
for (const svg of document.querySelectorAll('svg')) {
  const page = svg.getBoundingClientRect();
  const words = [...svg.querySelectorAll('text')].filter(t => t.textContent.trim() && t.getClientRects().length);
  const boxes = words.map(t => t.getBoundingClientRect());
  boxes.forEach((a, k) => {
    if (a.left < page.left - 1 || a.right > page.right + 1) faults.push(`cut: ${words[k].textContent}`);
    boxes.slice(0, k).forEach((b, j) => {
      const x = Math.min(a.right, b.right) - Math.max(a.left, b.left);
      const y = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
      if (x > 2 && y > 3) faults.push(`${words[k].textContent} on ${words[j].textContent}`);
    });
  });
}
parent.document.getElementById('found').textContent += `${innerWidth} dots wide: ${faults.join('; ') || 'sound'}. `;
";

/// A page with another one in it in two widths, without its policy, and what [`LOOK`] finds there.
fn beside_each_other(page: &str) -> String {
    let from = page
        .find("<meta http-equiv=\"Content-Security-Policy\"")
        .unwrap();
    let to = from + page[from..].find('>').unwrap() + 1;
    let bare = format!(
        "{}{}<script>addEventListener('load',()=>{{{LOOK}}})</script>",
        &page[..from],
        &page[to..]
    );
    let inside = bare.replace('&', "&amp;").replace('"', "&quot;");
    let frame = |width: u32| {
        format!(
            "<iframe width=\"{width}\" height=\"844\" frameborder=\"0\" srcdoc=\"{inside}\"></iframe>"
        )
    };
    format!(
        "<!doctype html><p id=\"found\"></p>{}{}",
        frame(390),
        frame(1280)
    )
}

#[test]
fn on_a_phone_and_on_a_desk_nothing_sticks_out_or_overlaps_and_the_policy_holds() {
    let Some(chromium) = chromium() else {
        return;
    };
    let dir = tempfile::tempdir().unwrap();
    session(dir.path(), "good", 14, "");
    session(dir.path(), "few", 6, "");
    let runs: [(&[&str], i32); 4] = [
        (
            &["calibrate", "good", "--report", "a.html", "-o", "cal.json"],
            0,
        ),
        (&["calibrate", "few", "--report", "b.html"], 4),
        (&["discover", "good", "--report", "c.html"], 0),
        (
            &[
                "evaluate",
                "few",
                "--calibration",
                "a=cal.json",
                "--report",
                "d.html",
            ],
            0,
        ),
    ];
    for (args, expected) in runs {
        let run = stillpoint(dir.path(), args);
        assert_eq!(status(&run), expected, "{args:?}: {}", stderr(&run));
        let name = args.iter().find(|a| a.ends_with(".html")).unwrap();
        let path = dir.path().join(name);
        let [_, log] = browsed(chromium, &format!("file://{}", path.display()));
        assert!(!log.contains("CONSOLE"), "{args:?}: {log}");
        let both = dir.path().join("both.html");
        std::fs::write(
            &both,
            beside_each_other(&std::fs::read_to_string(&path).unwrap()),
        )
        .unwrap();
        let [found, _] = browsed(chromium, &format!("file://{}", both.display()));
        let found = found
            .split("id=\"found\">")
            .nth(1)
            .and_then(|f| f.split("</p>").next());
        let sound = "dots wide: sound.";
        assert_eq!(
            found.map_or(0, |f| f.matches(sound).count()),
            2,
            "{args:?}: {found:?}"
        );
    }
}
