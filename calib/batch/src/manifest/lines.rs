//! Manifest files: CSV with a header, JSON lines, or TOML with `[[device]]` tables.

use std::path::{Path, PathBuf};

use calib::recording::shown::{shown, shown_path};
use findings::{Finding, Kind};
use serde_json::{Map, Value};

use super::device::{Device, DeviceOptions};
use crate::error::Error;

/// Keys of a line that are no options.
const KEYS: [&str; 5] = ["id", "inputs", "lot", "station", "time"];
/// Options that are numbers, words and lists.
const NUMBERS: [&str; 5] = ["gravity", "latitude", "multiplier", "min_static", "rate"];
const WORDS: [&str; 4] = ["method", "accel_unit", "gyro_unit", "mag_unit"];
const LISTS: [&str; 1] = ["effects"];

/// The devices of a manifest file; paths are relative to its folder.
pub(super) fn devices(path: &Path) -> Result<Vec<Device>, Error> {
    let text = calib::read_text(path).map_err(|e| Error::Manifest(e.finding().into()))?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    let name = shown_path(path);
    let at = |line: usize, found: Box<Finding>| {
        Error::Manifest(found.in_file(&name).at_line(line as u64).into())
    };
    let lines = match ending.as_deref() {
        Some("toml") => of_toml(&text),
        Some("jsonl" | "ndjson" | "json") => of_json(&text),
        _ => of_csv(&text),
    };
    let lines = lines.map_err(|(line, found)| at(line, found))?;
    let device = |(line, entry): (usize, Map<String, Value>)| {
        let device = device(entry, folder);
        device.map_err(|found| at(line, found))
    };
    lines.into_iter().map(device).collect()
}

type Lines = Result<Vec<(usize, Map<String, Value>)>, (usize, Box<Finding>)>;

fn of_toml(text: &str) -> Lines {
    let line = |span: Option<std::ops::Range<usize>>| {
        let at = span.map_or(0, |span| span.start);
        text.get(..at).unwrap_or(text).matches('\n').count() + 1
    };
    #[derive(serde::Deserialize)]
    #[serde(deny_unknown_fields)]
    struct File {
        device: Vec<toml::Spanned<Map<String, Value>>>,
    }
    let file: File = toml::from_str(text)
        .map_err(|e| (line(e.span()), damaged(calib::explain_toml(e.message()))))?;
    let entries = file.device.into_iter();
    Ok(entries
        .map(|e| (line(Some(e.span())), e.into_inner()))
        .collect())
}

fn of_json(text: &str) -> Lines {
    let lines = text
        .lines()
        .enumerate()
        .filter(|(_, line)| !line.trim().is_empty());
    let entry = |(k, line): (usize, &str)| {
        let entry = serde_json::from_str(line);
        entry
            .map(|e| (k + 1, e))
            .map_err(|e| (k + 1, damaged(e.to_string())))
    };
    lines.map(entry).collect()
}

fn of_csv(text: &str) -> Lines {
    let mut reader = csv::ReaderBuilder::new();
    let mut reader = reader
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let fault = |e: csv::Error| {
        let line = e.position().map_or(1, |p| p.line() as usize);
        (line, damaged(e.to_string()))
    };
    let header = reader.headers().map_err(fault)?.clone();
    let mut entries = Vec::new();
    for row in reader.records() {
        let row = row.map_err(fault)?;
        let line = row.position().map_or(1, |p| p.line() as usize);
        let mut entry = Map::new();
        for (key, cell) in header
            .iter()
            .zip(row.iter())
            .filter(|(_, cell)| !cell.is_empty())
        {
            let value = if NUMBERS.contains(&key) {
                let number: f64 = cell
                    .parse()
                    .map_err(|_| (line, unexpected(key, &format!("`{cell}`"), "a number")))?;
                Value::from(number)
            } else {
                Value::from(cell)
            };
            entry.insert(key.to_owned(), value);
        }
        entries.push((line, entry));
    }
    Ok(entries)
}

/// A device from the keys of its line.
fn device(entry: Map<String, Value>, folder: &Path) -> Result<Device, Box<Finding>> {
    let known = || {
        KEYS.iter()
            .chain(&NUMBERS)
            .chain(&WORDS)
            .chain(&LISTS)
            .copied()
    };
    if let Some(key) = entry.keys().find(|key| !known().any(|k| k == *key)) {
        let near = known().min_by_key(|k| strsim::damerau_levenshtein(key, k));
        let found = Finding::of(Kind::COLUMN_UNKNOWN).detail("column", shown(key));
        let found = found.detail("nearest", *near.as_ref().unwrap_or(&""));
        let known: Vec<&str> = known().collect();
        return Err(found.detail("known", known.join(", ")).into());
    }
    let word = |key: &str| match entry.get(key) {
        None | Some(Value::Null) => Ok(None),
        Some(Value::String(word)) => Ok(Some(word.clone())),
        Some(Value::Number(number)) => Ok(Some(number.to_string())),
        Some(other) => Err(unexpected(key, &other.to_string(), "a word")),
    };
    let number = |key: &str| match entry.get(key) {
        None | Some(Value::Null) => Ok(None),
        Some(value) => match value.as_f64().filter(|v| v.is_finite()) {
            Some(number) => Ok(Some(number)),
            None => Err(unexpected(key, &value.to_string(), "a number")),
        },
    };
    let list = |key: &str| match entry.get(key) {
        None | Some(Value::Null) => Ok(None),
        Some(Value::String(words)) => {
            let words = words.split(';').map(str::trim).filter(|w| !w.is_empty());
            Ok(Some(words.map(str::to_owned).collect::<Vec<_>>()))
        }
        Some(Value::Array(words)) => {
            let words = words.iter().map(|w| w.as_str().map(str::to_owned));
            words
                .collect::<Option<Vec<_>>>()
                .map(Some)
                .ok_or_else(|| unexpected(key, "another list", "words"))
        }
        Some(other) => Err(unexpected(key, &other.to_string(), "a list")),
    };
    let inputs = list("inputs")?.unwrap_or_default();
    let Some(first) = inputs.first().cloned() else {
        return Err(Finding::of(Kind::INPUTS_MISSING).into());
    };
    let inputs: Vec<PathBuf> = inputs.iter().map(|path| folder.join(path)).collect();
    Ok(Device {
        id: word("id")?.unwrap_or(first),
        inputs,
        lot: word("lot")?,
        station: word("station")?,
        time: word("time")?,
        options: DeviceOptions {
            gravity: number("gravity")?,
            latitude: number("latitude")?,
            method: word("method")?,
            effects: list("effects")?,
            multiplier: number("multiplier")?,
            min_static: number("min_static")?,
            rate: number("rate")?,
            accel_unit: word("accel_unit")?,
            mag_unit: word("mag_unit")?,
            gyro_unit: word("gyro_unit")?,
        },
    })
}

/// A line that is none of its format.
fn damaged(reason: String) -> Box<Finding> {
    let found = Finding::of(Kind::MANIFEST_DAMAGED);
    found.detail("reason", reason).into()
}

/// A cell that holds something else.
fn unexpected(column: &str, found: &str, expected: &str) -> Box<Finding> {
    Finding::of(Kind::CELL_UNEXPECTED)
        .detail("column", column)
        .detail("found", shown(found))
        .detail("expected", expected)
        .into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(name: &str, text: &str) -> Result<Vec<Device>, Error> {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join(name);
        std::fs::write(&path, text).unwrap();
        devices(&path)
    }

    #[test]
    fn three_kinds_of_manifest_say_the_same() {
        let csv = read(
            "m.csv",
            "id,inputs,lot,gravity,effects\n7,a.csv;b.csv,L1,9.81,gyro_g_sensitivity\n",
        );
        let toml = "[[device]]\nid = \"7\"\ninputs = [\"a.csv\", \"b.csv\"]\nlot = \"L1\"\ngravity = 9.81\neffects = [\"gyro_g_sensitivity\"]\n";
        let json = "{\"id\": 7, \"inputs\": [\"a.csv\", \"b.csv\"], \"lot\": \"L1\", \"gravity\": 9.81, \"effects\": \"gyro_g_sensitivity\"}\n";
        let strip = |devices: Result<Vec<Device>, Error>| {
            let mut device = devices.unwrap().remove(0);
            for input in &mut device.inputs {
                *input = input.file_name().unwrap().into();
            }
            device
        };
        let csv = strip(csv);
        assert_eq!(csv.inputs, [PathBuf::from("a.csv"), PathBuf::from("b.csv")]);
        assert_eq!((csv.id.as_str(), csv.options.gravity), ("7", Some(9.81)));
        assert_eq!(csv, strip(read("m.toml", toml)));
        assert_eq!(csv, strip(read("m.jsonl", json)));
    }

    #[test]
    fn what_is_wrong_with_a_manifest_has_its_line() {
        let wrong = |name: &str, text: &str| read(name, text).unwrap_err().to_string();
        let found = wrong("m.csv", "id,inputs,statoin\na,a.csv,x\n");
        assert!(
            found.contains("m.csv:2: unknown column `statoin`; did you mean `station`?"),
            "{found}"
        );
        let found = wrong("m.csv", "id,inputs,gravity\na,a.csv,9.8\nb,b.csv,x\n");
        assert!(found.contains("m.csv:3: gravity: `x` found"), "{found}");
        let found = wrong("m.toml", "[[device]]\nid = \"a\"\n");
        assert!(found.contains("m.toml:1: inputs: none"), "{found}");
    }
}
