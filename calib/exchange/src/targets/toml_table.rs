//! TOML: `cal.json` key by key.

use serde_json::Value;

use super::document::document;
use crate::error::Error;
use crate::kept::Kept;
use crate::source::Source;
use crate::target::{Form, Settings, Target, Written};

/// The same keys as `cal.json`; what is null is `nan` in a list of numbers and absent in a table, as TOML has no null.
pub const TARGET: Target = Target {
    name: "toml",
    about: "TOML with the keys of cal.json: all of it",
    form: Form::File,
    keeps: Kept::all_of,
    write,
};

fn write(source: &Source<'_>, _: &Settings) -> Result<Written, Error> {
    let mut text = source.provenance("#");
    text.push_str(
        "# accelerometer: f = T (A - b), gyroscope: w = T (W - b), magnetometer: m = T (M - b), rows of T in order\n",
    );
    let tree = converted(&document(source)?, false);
    let tree = tree.unwrap_or_else(|| toml::Value::Table(toml::Table::new()));
    let body = toml::to_string_pretty(&tree).map_err(|e| Error::unwritten(&e))?;
    text.push_str(&body);
    Ok(Written::text(text))
}

fn converted(value: &Value, in_list: bool) -> Option<toml::Value> {
    Some(match value {
        Value::Null if in_list => toml::Value::Float(f64::NAN),
        Value::Null => return None,
        Value::Bool(v) => toml::Value::Boolean(*v),
        Value::Number(n) => match n.as_i64() {
            Some(whole) => toml::Value::Integer(whole),
            None => toml::Value::Float(n.as_f64()?),
        },
        Value::String(s) => toml::Value::String(s.clone()),
        Value::Array(all) => {
            toml::Value::Array(all.iter().filter_map(|v| converted(v, true)).collect())
        }
        Value::Object(all) => {
            let entries = all.iter();
            let entries = entries.filter_map(|(k, v)| Some((k.clone(), converted(v, false)?)));
            toml::Value::Table(entries.collect())
        }
    })
}
