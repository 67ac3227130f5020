//! ECMAScript modules put into one script, which a page can hold: an inline module cannot import another.
//!
//! A module becomes a function that gives what it exports. Only the forms that our modules use are understood, and others are refused:
//! `import { a, b as c } from "./other.js";` and `export` before `const`, `class`, `function` and `async function`, each on one line.

use std::fmt::Write as _;

/// The module `name` and what it imports, in the order in which they run; `read` gives the text of a module.
///
/// # Errors
/// A module that cannot be read, an import that is not understood, modules that import each other.
pub fn bundle(name: &str, read: impl Fn(&str) -> Result<String, String>) -> Result<String, String> {
    let mut bundle = Bundle {
        read,
        begun: Vec::new(),
        done: Vec::new(),
        script: String::from("\"use strict\";\n"),
    };
    bundle.add(name)?;
    Ok(bundle.script)
}

struct Bundle<R> {
    read: R,
    begun: Vec<String>,
    done: Vec<String>,
    script: String,
}

impl<R: Fn(&str) -> Result<String, String>> Bundle<R> {
    fn add(&mut self, name: &str) -> Result<(), String> {
        if self.done.iter().any(|other| other == name) {
            return Ok(());
        }
        if self.begun.iter().any(|other| other == name) {
            return Err(format!("{name}: imports itself by way of others"));
        }
        self.begun.push(name.to_owned());
        let text = (self.read)(name)?;
        let (mut body, mut exports) = (String::new(), Vec::new());
        for line in text.lines() {
            if let Some(import) = line.strip_prefix("import ") {
                let (names, from) = import_of(import).ok_or_else(|| format!("{name}: `{line}`"))?;
                self.add(from)?;
                let names = names.replace(" as ", ": ");
                let _ = writeln!(body, "const {{{names}}} = {};", variable(from));
            } else if let Some(declaration) = line.strip_prefix("export ") {
                let declared = declared(declaration).ok_or_else(|| format!("{name}: `{line}`"))?;
                exports.push(declared.to_owned());
                let _ = writeln!(body, "{declaration}");
            } else {
                let _ = writeln!(body, "{line}");
            }
        }
        let exports = exports.join(", ");
        let variable = variable(name);
        let _ = writeln!(
            self.script,
            "const {variable} = (() => {{\n{body}return {{ {exports} }};\n}})();"
        );
        self.done.push(name.to_owned());
        Ok(())
    }
}

/// The names and the file of `{ a, b } from "./other.js";`.
fn import_of(text: &str) -> Option<(&str, &str)> {
    let (names, from) = text.strip_prefix('{')?.split_once("} from \"./")?;
    Some((names, from.strip_suffix("\";")?))
}

/// The name that a declaration declares.
fn declared(text: &str) -> Option<&str> {
    let kinds = ["const ", "class ", "function ", "async function "];
    let rest = kinds.iter().find_map(|kind| text.strip_prefix(kind))?;
    let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_' && c != '$')?;
    (end > 0).then(|| &rest[..end])
}

/// A variable for a module's exports.
fn variable(file: &str) -> String {
    format!("module_{}", file.trim_end_matches(".js"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn module(name: &str) -> Result<String, String> {
        let text = match name {
            "a.js" => {
                "import { b, C as D } from \"./b.js\";\nimport { c } from \"./c.js\";\nb(c);\n"
            }
            "b.js" => {
                "import { c } from \"./c.js\";\nexport function b() {\n}\nexport class C {\n}\n"
            }
            "c.js" => "export const c = 1;\n",
            "circle.js" => "import { x } from \"./circle.js\";\n",
            "star.js" => "import * as x from \"./c.js\";\n",
            _ => return Err(format!("{name}: not there")),
        };
        Ok(text.to_owned())
    }

    #[test]
    fn modules_run_once_and_after_what_they_import() {
        let script = bundle("a.js", module).unwrap();
        let at = |text: &str| {
            script
                .find(text)
                .unwrap_or_else(|| panic!("{text}: {script}"))
        };
        assert!(at("const module_c =") < at("const module_b ="));
        assert!(at("const module_b =") < at("const module_a ="));
        assert_eq!(script.matches("const module_c =").count(), 1);
        at("return { b, C };");
        at("const { b, C: D } = module_b;");
        assert!(!script.contains("import ") && !script.contains("export "));
    }

    #[test]
    fn what_is_not_understood_is_refused() {
        assert!(
            bundle("circle.js", module)
                .unwrap_err()
                .contains("circle.js")
        );
        assert!(bundle("star.js", module).unwrap_err().contains("import *"));
        assert!(bundle("d.js", module).is_err());
    }
}
