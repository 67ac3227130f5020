//! One array as rows of columns ("A simple file format for NumPy arrays", NEP 1).

use super::super::rows::Cell;
use super::literal::Literal;
use crate::Error;
use crate::error::{cut, damaged};

/// The first bytes of every array.
pub(super) const SIGNATURE: &[u8] = b"\x93NUMPY";

/// More columns are none of a recording.
const WIDEST: u64 = 4096;

/// A kind of number with its size in bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Float(usize),
    Signed(usize),
    Unsigned(usize),
    /// Words of as many letters of this size; names of columns at best.
    Words(usize, usize),
    /// Anything else.
    Other,
}

/// Columns of one kind beside each other.
#[derive(Clone, Debug)]
struct Field {
    name: String,
    kind: Kind,
    big_endian: bool,
    count: usize,
    /// Its first byte in a record.
    at: usize,
}

/// An array.
#[derive(Clone, Debug)]
pub(super) struct Array {
    pub name: String,
    pub rows: u64,
    /// Names of its columns that stand beside it.
    pub given: Option<Vec<String>>,
    fields: Vec<Field>,
    is_record: bool,
    /// Bytes from a row to the next, and from a column to the next.
    steps: [usize; 2],
    bytes: Vec<u8>,
    begin: usize,
}

impl Kind {
    fn size(self) -> usize {
        match self {
            Self::Float(size) | Self::Signed(size) | Self::Unsigned(size) => size,
            Self::Words(letters, size) => letters * size,
            Self::Other => 0,
        }
    }

    /// The kind that a code such as `<f8` says, and whether its first byte is the highest.
    fn of(code: &str) -> (Self, bool) {
        let big_endian = code.starts_with('>');
        let code = code.trim_start_matches(['<', '>', '|', '=']);
        let kind = code.chars().next().unwrap_or(' ');
        let size = code[kind.len_utf8().min(code.len())..].split('[').next();
        let size: usize = size.and_then(|digits| digits.parse().ok()).unwrap_or(0);
        let kind = match (kind, size) {
            ('f', 4 | 8) => Self::Float(size),
            ('i', 1 | 2 | 4 | 8) | ('m' | 'M', 8) => Self::Signed(size),
            ('u', 1 | 2 | 4 | 8) | ('b', 1) => Self::Unsigned(size),
            ('U', 1..=256) => Self::Words(size, 4),
            ('S', 1..=256) => Self::Words(size, 1),
            _ => Self::Other,
        };
        (kind, big_endian)
    }
}

impl Array {
    /// The array called `name`.
    ///
    /// # Errors
    /// A header that is damaged, or fewer bytes than it says.
    pub fn of(name: &str, bytes: Vec<u8>) -> Result<Self, Error> {
        let refused = || Error::refused(damaged("header"));
        let rest = bytes.strip_prefix(SIGNATURE).ok_or_else(refused)?;
        let (length, wide) = match rest {
            [1, _, a, b, ..] => (usize::from(u16::from_le_bytes([*a, *b])), 4),
            [2 | 3, _, a, b, c, d, ..] => (u32::from_le_bytes([*a, *b, *c, *d]) as usize, 6),
            _ => return Err(refused()),
        };
        let header = rest.get(wide..).and_then(|rest| rest.get(..length));
        let header = Literal::of(&String::from_utf8_lossy(header.ok_or_else(refused)?));
        let header = header.ok_or_else(refused)?;
        let begin = SIGNATURE.len() + wide + length;
        let shape = header.get("shape").and_then(Literal::numbers);
        let shape: Vec<u64> = shape.ok_or_else(refused)?;
        let in_columns = header.get("fortran_order") == Some(&Literal::Truth(true));
        let descr = header.get("descr").ok_or_else(refused)?;
        let (fields, size) = fields(name, descr).ok_or_else(refused)?;
        let is_record = matches!(descr, Literal::List(_));
        let mut array = Self {
            name: name.to_owned(),
            rows: 0,
            given: None,
            fields,
            is_record,
            steps: [0; 2],
            bytes,
            begin,
        };
        let taken = array.shape(&shape, in_columns, size);
        taken.ok_or_else(|| Error::refused(cut("array", "file")))?;
        Ok(array)
    }

    /// Takes the shape in; `None` where the bytes are fewer.
    fn shape(&mut self, shape: &[u64], in_columns: bool, size: usize) -> Option<()> {
        let all = shape
            .iter()
            .try_fold(size as u64, |all, n| all.checked_mul(*n))?;
        if self.is_read_kind() && all > (self.bytes.len() - self.begin) as u64 {
            return None;
        }
        let long: Vec<u64> = shape.iter().copied().filter(|n| *n != 1).collect();
        let ([first, second], is_turned) = match long[..] {
            [] => ([1, 1], false),
            [rows] => ([rows, 1], false),
            [first, second] => ([first, second], first < second),
            _ => {
                self.fields[0].kind = Kind::Other;
                return Some(());
            }
        };
        let (rows, width) = match is_turned {
            true => (second, first),
            false => (first, second),
        };
        if width > WIDEST || (self.is_record && width > 1) {
            self.fields[0].kind = Kind::Other;
            return Some(());
        }
        self.rows = rows;
        // Bytes from an index to the next: of the first and of the second.
        let steps = match in_columns {
            true => [size, size * first as usize],
            false => [size * second as usize, size],
        };
        self.steps = if is_turned {
            [steps[1], steps[0]]
        } else {
            steps
        };
        if !self.is_record {
            self.fields[0].count = width as usize;
        }
        Some(())
    }

    fn is_read_kind(&self) -> bool {
        !self.fields.iter().any(|field| field.kind == Kind::Other)
    }

    /// True for numbers in rows.
    pub fn is_read(&self) -> bool {
        let is_word = |field: &Field| matches!(field.kind, Kind::Words(..));
        self.is_read_kind() && !self.fields.iter().all(is_word)
    }

    pub fn is_record(&self) -> bool {
        self.is_record
    }

    /// Columns.
    pub fn width(&self) -> usize {
        self.fields.iter().map(|field| field.count).sum()
    }

    /// Names of its columns, where they have some.
    pub fn names(&self) -> Option<Vec<String>> {
        if self.given.is_some() {
            return self.given.clone();
        }
        let named = self.is_record || (matches!(self.width(), 1 | 3) && !self.name.is_empty());
        let axes = |field: &Field| match field.count {
            1 => vec![field.name.clone()],
            3 => ["x", "y", "z"]
                .map(|axis| format!("{}_{axis}", field.name))
                .into(),
            more => (1..=more)
                .map(|at| format!("{}_{at}", field.name))
                .collect(),
        };
        named.then(|| self.fields.iter().flat_map(axes).collect())
    }

    /// The words of a vector of words.
    pub fn words(&self) -> Option<Vec<String>> {
        let [field] = &self.fields[..] else {
            return None;
        };
        let is_vector = matches!(field.kind, Kind::Words(..)) && self.rows <= WIDEST;
        is_vector.then(|| {
            let word = |row| {
                let mut cells = Vec::new();
                self.row(row, &mut cells);
                match cells.pop() {
                    Some(Cell::Text(word)) => word,
                    _ => String::new(),
                }
            };
            (0..self.rows).map(word).collect()
        })
    }

    /// Adds the cells of a row.
    pub fn row(&self, row: u64, cells: &mut Vec<Cell>) {
        let begin = self.begin + row as usize * self.steps[0];
        for field in &self.fields {
            for column in 0..field.count {
                let step = if self.is_record {
                    field.kind.size()
                } else {
                    self.steps[1]
                };
                let at = begin + field.at + column * step;
                let bytes = self.bytes.get(at..at + field.kind.size());
                cells.push(bytes.map_or(Cell::Empty, |bytes| field.cell(bytes)));
            }
        }
    }
}

impl Field {
    fn cell(&self, bytes: &[u8]) -> Cell {
        let mut little = [0; 8];
        let mut bytes = bytes.to_vec();
        if self.big_endian && !matches!(self.kind, Kind::Words(..)) {
            bytes.reverse();
        }
        if let Kind::Words(_, size) = self.kind {
            let letter = |letter: &[u8]| {
                let mut code = [0; 4];
                code[..size].copy_from_slice(letter);
                let code = if self.big_endian {
                    u32::from_be_bytes(code)
                } else {
                    u32::from_le_bytes(code)
                };
                char::from_u32(code).filter(|c| *c != '\0')
            };
            return Cell::Text(bytes.chunks_exact(size).filter_map(letter).collect());
        }
        little[..bytes.len()].copy_from_slice(&bytes);
        match self.kind {
            Kind::Float(4) => Cell::Single(f32::from_bits(u32::from_le_bytes([
                little[0], little[1], little[2], little[3],
            ]))),
            Kind::Float(_) => Cell::Double(f64::from_le_bytes(little)),
            Kind::Signed(size) => {
                let unused = 64 - 8 * size as u32;
                Cell::Whole((i64::from_le_bytes(little) << unused) >> unused)
            }
            _ => Cell::Unsigned(u64::from_le_bytes(little)),
        }
    }
}

/// The columns that `descr` describes, and the bytes of a row; `None` where it is damaged.
fn fields(name: &str, descr: &Literal) -> Option<(Vec<Field>, usize)> {
    let field = |name: &str, code: &str, count: u64, at: usize| {
        let (kind, big_endian) = Kind::of(code);
        let count = usize::try_from(count.min(WIDEST)).ok()?;
        Some(Field {
            name: name.to_owned(),
            kind,
            big_endian,
            count,
            at,
        })
    };
    let Literal::List(all) = descr else {
        let field = field(name, descr.text()?, 1, 0)?;
        let size = field.kind.size();
        return Some((vec![field], size));
    };
    let (mut fields, mut at) = (Vec::new(), 0);
    for one in all {
        let Literal::List(parts) = one else {
            return None;
        };
        let name = match parts.first()? {
            Literal::Text(name) => name.as_str(),
            // A title and a name.
            Literal::List(both) => both.last()?.text()?,
            _ => return None,
        };
        // Records within a record are of no kind that is read.
        let code = parts.get(1)?.text().unwrap_or_default();
        let count = match parts.get(2) {
            Some(Literal::Number(count)) => *count,
            Some(shape) => shape
                .numbers()?
                .iter()
                .try_fold(1_u64, |all, n| all.checked_mul(*n))?,
            None => 1,
        };
        let field = field(name, code, count, at)?;
        at += match field.kind {
            // Bytes that are passed over.
            Kind::Other => code
                .trim_start_matches('|')
                .strip_prefix('V')?
                .parse()
                .ok()?,
            kind => kind.size() * field.count,
        };
        if field.kind != Kind::Other {
            fields.push(field);
        }
    }
    (!fields.is_empty()).then_some((fields, at))
}
