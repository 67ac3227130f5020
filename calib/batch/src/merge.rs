//! Parts to one list of records, or why they do not make one.

use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::fault::Fault;
use crate::part::{Part, PartHeader, read_part};
use crate::record::Record;
use crate::shard::Shard;

/// All devices of a run, in the order of its manifest.
#[derive(Clone, Debug, PartialEq)]
pub struct Merged {
    /// SHA-256 of devices and options.
    pub manifest_sha256: String,
    /// The records.
    pub records: Vec<Record>,
}

fn refused(faults: &[Fault]) -> Error {
    Error::Parts(faults.iter().map(Fault::finding).collect())
}

/// Joins the parts in `paths`; a folder stands for the parts in it. A shard that is there twice with the same bytes counts once.
///
/// # Errors
/// [`Error::Parts`] with everything that is missing, foreign or incomplete; [`Error::Io`].
pub fn merge(paths: &[PathBuf]) -> Result<Merged, Error> {
    joined(paths, true)
}

/// Joins the parts in `paths`; unless they must be all, shards without a part are passed over.
pub(crate) fn joined(paths: &[PathBuf], all: bool) -> Result<Merged, Error> {
    let mut faults = Vec::new();
    let mut parts: Vec<(PathBuf, Part)> = Vec::new();
    for path in part_files(paths)? {
        let text = std::fs::read_to_string(&path);
        let unreadable = |error: std::io::Error| Box::new(Error::at(&path)(error).finding());
        match text.map_err(unreadable).and_then(|text| read_part(&text)) {
            Ok(part) => parts.push((path, part)),
            Err(found) => faults.push(Fault::Unreadable { path, found }),
        }
    }
    let Some(expected) = commonest(&parts) else {
        return Err(refused(&faults));
    };
    let n = expected.shard.n;
    let mut merged: Vec<Option<Record>> = vec![None; expected.devices];
    let mut seen: Vec<Option<String>> = vec![None; n];
    for (path, part) in parts {
        let own = part.header.identity();
        let shard = part.header.shard;
        let place = seen.get_mut(shard.k.wrapping_sub(1));
        let place = place.filter(|_| own == expected.identity());
        let beyond = |r: &Record| r.index >= expected.devices || !shard.has(r.index);
        match place.filter(|_| !part.records.iter().any(beyond)) {
            // Run twice.
            Some(Some(sha256)) if *sha256 == part.sha256 => {}
            Some(place @ None) => {
                *place = Some(part.sha256);
                for record in part.records {
                    let index = record.index;
                    merged[index] = Some(record);
                }
            }
            _ => faults.push(Fault::Foreign {
                path,
                found: own,
                expected: expected.identity(),
            }),
        }
    }
    let missing = seen.iter().enumerate().filter(|(_, part)| part.is_none());
    for (k, _) in missing.filter(|_| all) {
        faults.push(Fault::Missing {
            shard: Shard { k: k + 1, n },
        });
    }
    for (index, record) in merged.iter().enumerate() {
        if record.is_none() && seen[index % n].is_some() {
            faults.push(Fault::Lacks { index });
        }
    }
    if !faults.is_empty() {
        return Err(refused(&faults));
    }
    Ok(Merged {
        manifest_sha256: expected.manifest_sha256,
        records: merged.into_iter().flatten().collect(),
    })
}

/// The header that most parts agree with, the first of equals.
fn commonest(parts: &[(PathBuf, Part)]) -> Option<PartHeader> {
    let count = |header: &PartHeader| {
        let same = |part: &&(PathBuf, Part)| part.1.header.identity() == header.identity();
        parts.iter().filter(same).count()
    };
    let mut best: Option<(usize, &PartHeader)> = None;
    for (_, part) in parts {
        let own = count(&part.header);
        if best.is_none_or(|(most, _)| own > most) {
            best = Some((own, &part.header));
        }
    }
    best.map(|(_, header)| header.clone())
}

/// The part files in `paths`; a folder stands for those in it.
///
/// # Errors
/// [`Error::Io`] for a folder that cannot be read.
pub fn part_files(paths: &[PathBuf]) -> Result<Vec<PathBuf>, Error> {
    let mut files = Vec::new();
    for path in paths {
        if !crate::hash::is_folder(path)? {
            files.push(path.clone());
            continue;
        }
        let members = crate::hash::members(path).map_err(Error::at(path))?;
        files.extend(members.into_iter().filter(|path| is_part(path)));
    }
    Ok(files)
}

fn is_part(path: &Path) -> bool {
    let name = path.file_name().map(|name| name.to_string_lossy());
    name.is_some_and(|name| name.starts_with("part-") && name.ends_with(".jsonl"))
}

/// Words as a spreadsheet takes them for words: what begins like a formula gets an apostrophe in front.
fn as_text(words: &str) -> String {
    match words.starts_with(['=', '+', '-', '@', '\t', '\r']) {
        true => format!("'{words}"),
        false => words.to_owned(),
    }
}

/// The records as a table: a row per device, a column per parameter with its standard error.
pub fn to_csv(records: &[Record]) -> String {
    let mut names: Vec<&str> = Vec::new();
    for parameter in records.iter().flat_map(|r| &r.parameters) {
        if !names.contains(&parameter.name.as_str()) {
            names.push(&parameter.name);
        }
    }
    let mut table = csv::Writer::from_writer(Vec::new());
    let fixed = [
        "id",
        "lot",
        "station",
        "time",
        "status",
        "exit",
        "reasons",
        "residual_mm_s2",
        "accelerometer_chi2",
        "static_intervals",
        "residual_deg",
        "gyroscope_chi2",
        "turns",
        "warnings",
        "verdict",
        "findings",
        "belongs",
        "calibration_verdict",
        "calibration_reasons",
        "calibration_next",
    ];
    let mut header: Vec<String> = fixed.map(str::to_owned).to_vec();
    header.extend(
        names
            .iter()
            .flat_map(|n| [(*n).to_owned(), format!("{n}.std")]),
    );
    let _ = table.write_record(&header);
    let number = |v: Option<f64>| v.map_or(String::new(), |v| v.to_string());
    let count = |v: Option<usize>| v.map_or(String::new(), |v| v.to_string());
    for r in records {
        let findings: Vec<&str> = r.findings.iter().map(|f| f.name.as_str()).collect();
        let m = &r.misfit;
        let word = |word: &Option<String>| word.as_deref().map_or(String::new(), as_text);
        let mut row = vec![
            as_text(&r.id),
            word(&r.lot),
            word(&r.station),
            word(&r.time),
            r.status.name().into(),
            r.exit.to_string(),
            as_text(&r.reasons.join("; ")),
            number(m.residual_mm_s2),
            number(m.accelerometer_chi2),
            count(m.static_intervals),
            number(m.residual_deg),
            number(m.gyroscope_chi2),
            count(m.turns),
            r.warnings.to_string(),
            word(&r.verdict),
            as_text(&findings.join(";")),
            r.belongs.map_or(String::new(), |b| b.to_string()),
        ];
        let judged = r.calibration_verdict.as_ref();
        let next = judged.and_then(|verdict| verdict.next.first());
        row.push(judged.map_or(String::new(), |verdict| verdict.level.name().into()));
        row.push(judged.map_or(String::new(), |verdict| verdict.reasons.join(";")));
        row.push(next.map_or(String::new(), |step| as_text(&step.text)));
        for name in &names {
            let found = r.parameter(name);
            row.push(number(found.map(|(v, _)| v)));
            row.push(number(found.and_then(|(_, s)| s)));
        }
        let _ = table.write_record(&row);
    }
    table
        .into_inner()
        .ok()
        .and_then(|bytes| String::from_utf8(bytes).ok())
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use findings::Kind;

    use super::*;
    use crate::device::empty;
    use crate::manifest::{Device, DeviceOptions};
    use crate::part::{part_name, part_text};

    fn write(folder: &Path, name: &str, sha: &str, shard: Shard) -> PathBuf {
        let device = |k: usize| Device {
            id: format!("d{k}"),
            inputs: Vec::new(),
            lot: None,
            station: None,
            time: None,
            options: DeviceOptions::default(),
        };
        let own = (0..7).filter(|k| shard.has(*k));
        let records: Vec<Record> = own.map(|k| empty(&device(k), k, String::new())).collect();
        let header = PartHeader::new("test 1", sha.into(), shard, 7);
        let path = folder.join(name);
        std::fs::write(&path, part_text(&header, &records)).unwrap();
        path
    }

    #[test]
    fn parts_merge_in_order_and_a_shard_run_twice_counts_once() {
        let dir = tempfile::tempdir().unwrap();
        for k in 1..=3 {
            let shard = Shard { k, n: 3 };
            write(dir.path(), &part_name(shard), "a", shard);
        }
        let again = write(dir.path(), "again.jsonl", "a", Shard { k: 2, n: 3 });
        let merged = merge(&[dir.path().into(), again]).unwrap();
        let ids: Vec<&str> = merged.records.iter().map(|r| r.id.as_str()).collect();
        assert_eq!(ids, ["d0", "d1", "d2", "d3", "d4", "d5", "d6"]);
    }

    #[test]
    fn missing_foreign_and_half_written_parts_are_listed() {
        let dir = tempfile::tempdir().unwrap();
        let shard = |k| Shard { k, n: 4 };
        write(dir.path(), "part-1-of-4.jsonl", "a", shard(1));
        write(dir.path(), "part-2-of-4.jsonl", "b", shard(2));
        let cut = write(dir.path(), "part-3-of-4.jsonl", "a", shard(3));
        let text = std::fs::read_to_string(&cut).unwrap();
        for length in [0, 10, text.len() / 2, text.len() - 1] {
            std::fs::write(&cut, &text[..length]).unwrap();
            let Err(Error::Parts(faults)) = merge(&[dir.path().into()]) else {
                panic!("merged")
            };
            let kinds: Vec<&str> = faults
                .iter()
                .map(|fault| match fault.kind {
                    Kind::PART_FOREIGN => "foreign",
                    Kind::BATCH_PART_MISSING => "missing",
                    Kind::DEVICE_IN_NO_PART => "lacks",
                    _ => "unreadable",
                })
                .collect();
            assert_eq!(
                kinds,
                ["unreadable", "foreign", "missing", "missing", "missing"]
            );
        }
    }
}
