//! Puts the page together that calibrates in a browser: one HTML file that loads nothing, with the program of the command line in it,
//! compiled to WebAssembly. `cli/web/build` calls it.

#![cfg_attr(test, allow(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod bundle;
mod page;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use page::Parts;

/// The folder of this package, where the parts of the page lie.
const HERE: &str = env!("CARGO_MANIFEST_DIR");

fn main() -> ExitCode {
    let words: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let [program, output] = words.as_slice() else {
        let _ = writeln!(
            std::io::stderr(),
            "call: stillpoint-web PROGRAM.wasm PAGE.html"
        );
        return ExitCode::from(2);
    };
    match write(program, output) {
        Ok(sizes) => {
            let _ = writeln!(std::io::stdout(), "{sizes}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "stillpoint-web: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Writes the page of a program, and says how large it is.
fn write(program: &Path, output: &Path) -> Result<String, String> {
    let read =
        |path: &Path| std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()));
    let text = |name: &str| {
        let path = Path::new(HERE).join(name);
        String::from_utf8(read(&path)?).map_err(|_| format!("{}: not UTF-8", path.display()))
    };
    let module = |name: &str| text(&format!("modules/{name}"));
    let program = read(program)?;
    let parts = Parts {
        template: text("index.html")?,
        style: text("page.css")?,
        script: bundle::bundle("page.js", module)?,
        worker: bundle::bundle("worker.js", module)?,
        program: &program,
    };
    let page = page::page(&parts)?;
    std::fs::write(output, &page).map_err(|error| format!("{}: {error}", output.display()))?;
    let mega = |bytes: usize| bytes as f64 / 1e6;
    Ok(format!(
        "{}: {:.2} MB, {:.2} MB compressed; the program {:.2} MB",
        output.display(),
        mega(page.len()),
        mega(page::compressed(page.as_bytes())?.len()),
        mega(program.len())
    ))
}
