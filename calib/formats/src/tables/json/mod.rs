//! JSON: a record per line or in an array, of a sample or of a packet of them; lists that are columns; and documents with
//! such in them.

mod axis_order;
mod document;
mod flat;
mod packets;
mod records;

use std::io::Write;

use findings::{Finding, Kind};

use self::document::Document;
use self::flat::{Columns, Row};
use self::records::Records;
use super::reader::{Listed, Reader};
use super::rows;
use crate::shown::shown;
use crate::store::Store;
use crate::{Error, Limits};

/// JSON of records or columns.
pub(super) const READER: Reader = Reader { tables, write };

/// True for what begins as JSON with something in it: a log's line may begin with a bracket too.
pub(super) fn begins(head: &[u8]) -> bool {
    let head = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head);
    let mut marks = head.iter().filter(|byte| !byte.is_ascii_whitespace());
    match (marks.next(), marks.next()) {
        (Some(b'{'), Some(b'"')) => true,
        (Some(b'['), Some(b'{')) => true,
        (Some(b'['), Some(b'[')) => !matches!(marks.next(), None | Some(b'[')),
        _ => false,
    }
}

fn tables(store: &Store, limits: Limits) -> Result<Listed, Error> {
    if let Some(document) = Document::open(store)? {
        let names: Vec<String> = document.tables().map(|table| table.name.clone()).collect();
        return match names.len() {
            0 => {
                let found = Finding::of(Kind::JSON_WITHOUT_TABLE);
                Err(Error::refused(found.detail("listed", document.listed())))
            }
            _ => Ok(Listed {
                names,
                warnings: findings::Findings::new(),
            }),
        };
    }
    let mut columns = Columns::default();
    let cut = Records::of(store)?.each(limits, &mut |row| columns.add(&row))?;
    Ok(Listed {
        names: vec![String::new()],
        warnings: cut.into_iter().collect(),
    })
}

fn write(store: &Store, name: &str, limits: Limits, out: &mut dyn Write) -> Result<(), Error> {
    let mut columns = Columns::default();
    let mut line = String::new();
    if let Some(document) = Document::open(store)? {
        let table = document.tables().find(|table| table.name == name);
        let table = table.ok_or_else(|| {
            let found = Finding::of(Kind::TABLE_GONE);
            Error::refused(found.detail("table", shown(name)))
        })?;
        let mut count = 0;
        for at in 0..table.length() {
            let rows = table.rows(at)?;
            count += rows.len() as u64;
            rows::check(count, limits.rows)?;
            rows.iter().try_for_each(|row| columns.add(row))?;
        }
        columns.write_names(out)?;
        for at in 0..table.length() {
            let mut rows = table.rows(at)?.into_iter();
            rows.try_for_each(|row| columns.write(row, out, &mut line))?;
        }
        return Ok(());
    }
    Records::of(store)?.each(limits, &mut |row| columns.add(&row))?;
    columns.write_names(out)?;
    let mut write = |row: Row| columns.write(row, out, &mut line);
    Records::of(store)?.each(limits, &mut write).map(drop)
}

#[cfg(test)]
mod tests;
