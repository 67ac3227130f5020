//! Parquet: columns in row groups, <https://parquet.apache.org/docs/file-format/>.

mod claims;
mod layout;
mod thrift;

use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::sync::Arc;

use bytes::Bytes;
use findings::{Finding, Kind, Remedy};
use parquet::basic::{Compression, ConvertedType, LogicalType, Repetition, TimeUnit, Type};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::{DataType, DoubleType};
use parquet::errors::{ParquetError, Result as ParquetResult};
use parquet::file::metadata::ParquetMetaData;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{ChunkReader, FileReader, Length, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{ColumnDescriptor, Type as SchemaType};

use super::reader::{Listed, Reader};
use super::rows::{self, Cell};
use crate::error::unreadable;
use crate::shown::shown;
use crate::store::{Store, Stored};
use crate::{Error, Limits};

/// Parquet files of plain columns.
pub(super) const READER: Reader = Reader {
    tables,
    write: write_text,
};

/// Rows read at a time.
const ROWS: usize = 4096;

fn tables(store: &Store, limits: Limits) -> Result<Listed, Error> {
    let file = open(store)?;
    check(file.metadata(), store.length()?, limits)?;
    Ok(Listed {
        names: vec![String::new()],
        warnings: findings::Findings::new(),
    })
}

fn write_text(store: &Store, _: &str, limits: Limits, out: &mut dyn Write) -> Result<(), Error> {
    let file = open(store)?;
    let rows = check(file.metadata(), store.length()?, limits)?;
    let columns: Vec<Column> = {
        let schema = file.metadata().file_metadata().schema_descr();
        let all = schema.columns().iter().enumerate();
        all.filter_map(|(at, column)| Column::of(at, column))
            .collect()
    };
    let names: Vec<String> = columns.iter().map(|column| column.name.clone()).collect();
    out.write_all(rows::header(&names).as_bytes())?;
    let (mut line, mut left) = (String::new(), rows);
    for group in 0..file.num_row_groups() {
        let group = file.get_row_group(group).map_err(damaged)?;
        let mut readers = Vec::new();
        for column in &columns {
            claims::check_pages(store, group.metadata().column(column.at), limits)?;
            readers.push(group.get_column_reader(column.at).map_err(damaged)?);
        }
        loop {
            let mut cells = Vec::new();
            for (column, reader) in columns.iter().zip(&mut readers) {
                cells.push(column.cells(reader)?);
            }
            let count = cells.iter().map(Vec::len).max().unwrap_or(0);
            if count == 0 {
                break;
            }
            if cells.iter().any(|cells| cells.len() != count) {
                return Err(Error::refused(Finding::of(Kind::COLUMNS_UNEQUAL)));
            }
            left = left
                .checked_sub(count as u64)
                .ok_or_else(|| Error::refused(of_file(Kind::ROWS_BEYOND_CLAIM)))?;
            for row in 0..count {
                rows::write(out, &mut line, cells.iter().map(|cells| &cells[row]))?;
            }
        }
    }
    Ok(())
}

fn damaged(error: ParquetError) -> Error {
    unreadable(PARQUET_FILE, &error)
}

/// The format in a sentence.
const PARQUET_FILE: &str = "Parquet file";

fn of_file(kind: Kind) -> Finding {
    Finding::of(kind).detail("format", PARQUET_FILE)
}

fn open(store: &Store) -> Result<SerializedFileReader<Chunks>, Error> {
    claims::check_metadata(&mut *store.open()?)?;
    let chunks = Chunks {
        store: store.clone(),
        length: store.length()?,
    };
    SerializedFileReader::new(chunks).map_err(damaged)
}

/// Refuses what is too much in a file of `length` bytes, or packed in a way that this build does not know; else the
/// number of rows.
fn check(metadata: &ParquetMetaData, length: u64, limits: Limits) -> Result<u64, Error> {
    let rows = u64::try_from(metadata.file_metadata().num_rows()).unwrap_or(u64::MAX);
    rows::check(rows, limits.rows)?;
    let columns = metadata.file_metadata().schema_descr().num_columns();
    rows::check_cells(rows, columns, length, limits)?;
    let chunks = metadata.row_groups().iter().flat_map(|g| g.columns());
    let (mut all, mut packed): (u64, u64) = (0, 0);
    for chunk in chunks {
        let what = match chunk.compression() {
            Compression::ZSTD(_) if cfg!(not(feature = "parquet-zstd")) => Some("zstd"),
            Compression::BROTLI(_) => Some("brotli"),
            Compression::LZO => Some("lzo"),
            _ => None,
        };
        if let Some(what) = what {
            let found = Finding::of(Kind::COLUMN_COMPRESSED).detail("method", what);
            return Err(Error::refused(match what {
                "zstd" => found.remedy(Remedy::Build {
                    feature: "parquet-zstd".into(),
                }),
                _ => found,
            }));
        }
        let size = |bytes: i64| u64::try_from(bytes).unwrap_or(u64::MAX);
        let (small, large) = (
            size(chunk.compressed_size()),
            size(chunk.uncompressed_size()),
        );
        let what = format!("the column {}", shown(&chunk.column_path().string()));
        limits.check_unpacked(&what, small, large)?;
        all = all.saturating_add(large);
        packed = packed.saturating_add(small);
    }
    if packed > length {
        return Err(Error::refused(of_file(Kind::COLUMNS_BEYOND_FILE)));
    }
    if all > limits.bytes {
        return Err(limits.too_large("the Parquet file"));
    }
    Ok(rows)
}

/// A column that is read.
struct Column {
    at: usize,
    /// Its name, with the unit of stamps.
    name: String,
    /// Divisor of a decimal's whole numbers: a power of ten.
    divisor: Option<f64>,
    levels: i16,
    is_text: bool,
    /// Why its cells cannot be read.
    refused: Option<Kind>,
}

/// The name that pandas gives an index without one.
const INDEX: &str = "__index_level_";

impl Column {
    /// The column `at`; none of an index of pandas that only counts rows.
    fn of(at: usize, column: &ColumnDescriptor) -> Option<Self> {
        let logical = column.logical_type_ref();
        let unit = match (logical, column.converted_type()) {
            (Some(LogicalType::Timestamp(of) | LogicalType::Time(of)), _) => Some(match of.unit {
                TimeUnit::MILLIS => "ms",
                TimeUnit::MICROS => "us",
                TimeUnit::NANOS => "ns",
            }),
            (_, ConvertedType::TIMESTAMP_MILLIS) => Some("ms"),
            (_, ConvertedType::TIMESTAMP_MICROS) => Some("us"),
            // Nanoseconds since 1970, below.
            _ if column.physical_type() == Type::INT96 => Some("ns"),
            _ => None,
        };
        let path = column.path().parts().join(".");
        let name = match path.starts_with(INDEX) {
            true => rows::with_unit("timestamp", Some(unit?)),
            false => rows::with_unit(&path, unit),
        };
        let is_decimal = column.converted_type() == ConvertedType::DECIMAL
            || matches!(logical, Some(LogicalType::Decimal { .. }));
        let is_bytes = matches!(
            column.physical_type(),
            Type::BYTE_ARRAY | Type::FIXED_LEN_BYTE_ARRAY
        );
        let refused = if column.max_rep_level() > 0 {
            Some(Kind::CELLS_ARE_LISTS)
        } else if is_bytes && (is_decimal || matches!(logical, Some(LogicalType::Float16))) {
            Some(Kind::NUMBER_TYPE_UNREAD)
        } else {
            None
        };
        Some(Self {
            at,
            name,
            divisor: is_decimal.then(|| 10_f64.powi(column.type_scale())),
            levels: column.max_def_level(),
            is_text: column.physical_type() == Type::BYTE_ARRAY,
            refused,
        })
    }

    /// The next cells; none at the end.
    fn cells(&self, reader: &mut ColumnReader) -> Result<Vec<Cell>, Error> {
        if let Some(why) = self.refused {
            let found = Finding::of(why).detail("column", shown(&self.name));
            return Err(Error::refused(found));
        }
        let whole = |number: i64| match self.divisor {
            Some(divisor) => Cell::Double(number as f64 / divisor),
            None => Cell::Whole(number),
        };
        match reader {
            ColumnReader::BoolColumnReader(reader) => {
                self.typed(reader, |v| Cell::Whole(i64::from(*v)))
            }
            ColumnReader::Int32ColumnReader(reader) => self.typed(reader, |v| whole(i64::from(*v))),
            ColumnReader::Int64ColumnReader(reader) => self.typed(reader, |v| whole(*v)),
            ColumnReader::Int96ColumnReader(reader) => {
                self.typed(reader, |v| Cell::Whole(v.to_nanos()))
            }
            ColumnReader::FloatColumnReader(reader) => self.typed(reader, |v| Cell::Single(*v)),
            ColumnReader::DoubleColumnReader(reader) => self.typed(reader, |v| Cell::Double(*v)),
            ColumnReader::ByteArrayColumnReader(reader) => self.typed(reader, |v| {
                let words = self.is_text.then(|| String::from_utf8_lossy(v.data()));
                Cell::Text(words.unwrap_or_default().into_owned())
            }),
            ColumnReader::FixedLenByteArrayColumnReader(reader) => {
                self.typed(reader, |_| Cell::Text("binary".to_owned()))
            }
        }
    }

    fn typed<T: DataType>(
        &self,
        reader: &mut ColumnReaderImpl<T>,
        cell: impl Fn(&T::T) -> Cell,
    ) -> Result<Vec<Cell>, Error> {
        let (mut levels, mut values) = (Vec::new(), Vec::new());
        let levels_out = (self.levels > 0).then_some(&mut levels);
        reader
            .read_records(ROWS, levels_out, None, &mut values)
            .map_err(damaged)?;
        if self.levels == 0 {
            return Ok(values.iter().map(cell).collect());
        }
        let mut values = values.iter();
        let cells = levels.iter().map(|level| match *level == self.levels {
            true => values.next().map_or(Cell::Empty, &cell),
            false => Cell::Empty,
        });
        Ok(cells.collect())
    }
}

/// A file in pieces.
struct Chunks {
    store: Store,
    length: u64,
}

impl Chunks {
    fn at(&self, start: u64) -> ParquetResult<Box<dyn Stored>> {
        let external = |error: io::Error| ParquetError::External(Box::new(error));
        let opened = self.store.open();
        let mut file = opened.map_err(|error| ParquetError::General(error.to_string()))?;
        file.seek(SeekFrom::Start(start)).map_err(external)?;
        Ok(file)
    }
}

impl Length for Chunks {
    fn len(&self) -> u64 {
        self.length
    }
}

impl ChunkReader for Chunks {
    type T = BufReader<Box<dyn Stored>>;

    fn get_read(&self, start: u64) -> ParquetResult<Self::T> {
        Ok(BufReader::new(self.at(start)?))
    }

    fn get_bytes(&self, start: u64, length: usize) -> ParquetResult<Bytes> {
        let mut bytes = Vec::new();
        // Memory grows with what there is, not with what is asked for.
        self.at(start)?
            .take(length as u64)
            .read_to_end(&mut bytes)
            .map_err(|error| ParquetError::External(Box::new(error)))?;
        match bytes.len() == length {
            true => Ok(bytes.into()),
            false => Err(ParquetError::EOF(format!(
                "{} of {length} bytes at {start}",
                bytes.len()
            ))),
        }
    }
}

/// Rows of a group that is written.
const GROUP: usize = 1 << 20;

/// The file that [`super::write_parquet`] gives.
pub(super) fn write(columns: &[(String, Vec<f64>)]) -> Result<Vec<u8>, Error> {
    let cannot = |error: ParquetError| {
        let found = of_file(Kind::FORMAT_UNWRITABLE);
        Error::refused(found.detail("reason", error.to_string()))
    };
    let field = |(name, _): &(String, Vec<f64>)| {
        let field = SchemaType::primitive_type_builder(name, Type::DOUBLE)
            .with_repetition(Repetition::OPTIONAL);
        Ok(Arc::new(field.build()?))
    };
    let fields: ParquetResult<Vec<_>> = columns.iter().map(field).collect();
    let schema = SchemaType::group_type_builder("recording")
        .with_fields(fields.map_err(cannot)?)
        .build();
    // Readings hardly repeat, and a dictionary of them costs more than it saves.
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_dictionary_enabled(false)
        .build();
    let mut file = SerializedFileWriter::new(
        Vec::new(),
        Arc::new(schema.map_err(cannot)?),
        Arc::new(properties),
    )
    .map_err(cannot)?;
    let rows = columns.first().map_or(0, |(_, values)| values.len());
    for from in (0..rows).step_by(GROUP) {
        let mut group = file.next_row_group().map_err(cannot)?;
        for (_, values) in columns {
            let values = values.get(from..rows.min(from + GROUP)).unwrap_or_default();
            let levels: Vec<i16> = values.iter().map(|v| i16::from(v.is_finite())).collect();
            let there: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
            if let Some(mut column) = group.next_column().map_err(cannot)? {
                let typed = column.typed::<DoubleType>();
                typed
                    .write_batch(&there, Some(&levels), None)
                    .map_err(cannot)?;
                column.close().map_err(cannot)?;
            }
        }
        group.close().map_err(cannot)?;
    }
    file.into_inner().map_err(cannot)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_are_weighed_before_they_are_unpacked() {
        let file = write(&[("t".to_owned(), vec![0.5; 4000])]).unwrap();
        let store = Store::Memory(file.into());
        let opened = open(&store).unwrap();
        let chunk = opened.metadata().row_group(0).column(0);
        let with = |bytes| {
            let limits = Limits {
                bytes,
                ..Limits::default()
            };
            claims::check_pages(&store, chunk, limits)
        };
        // Doubles, and whether they are there.
        assert!(with(8 * 4000 + 100).is_ok());
        let error = with(8 * 4000 - 1).unwrap_err().to_string();
        assert!(error.contains("a page of t"), "{error}");
    }
}
