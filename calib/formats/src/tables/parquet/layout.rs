//! Types of the values in Parquet's metadata. The parser checks few of them and would read on at a wrong byte.
//! "Apache Parquet: parquet.thrift", version 2.12, <https://github.com/apache/parquet-format>.

use super::thrift::Shape::{self, List, Plain, Structure, Truth, Unread};
use super::thrift::{BINARY, BYTE, DOUBLE, I16, I32, I64};

const BYTES: Shape = Plain(BINARY);
const INT: Shape = Plain(I32);
const LONG: Shape = Plain(I64);
const EMPTY: Shape = Structure(&[]);

const DECIMAL: Shape = Structure(&[INT, INT]);
const TIME: Shape = Structure(&[Truth, Structure(&[EMPTY, EMPTY, EMPTY])]);
const INTEGER: Shape = Structure(&[Plain(BYTE), Truth]);
const VARIANT: Shape = Structure(&[Plain(BYTE)]);
const GEOMETRY: Shape = Structure(&[BYTES]);
const GEOGRAPHY: Shape = Structure(&[BYTES, INT]);
const LOGICAL: Shape = Structure(&[
    EMPTY, EMPTY, EMPTY, EMPTY, DECIMAL, EMPTY, TIME, TIME, Unread, INTEGER, EMPTY, EMPTY, EMPTY,
    EMPTY, EMPTY, VARIANT, GEOMETRY, GEOGRAPHY,
]);

/// The fields of an element of the schema.
pub(super) const ELEMENT: &[Shape] = &[INT, INT, INT, BYTES, INT, INT, INT, INT, INT, LOGICAL];

const PAIR: Shape = Structure(&[BYTES, BYTES]);
const STATISTICS: Shape = Structure(&[BYTES, BYTES, LONG, LONG, BYTES, BYTES, Truth, Truth, LONG]);
const PAGES: Shape = Structure(&[INT, INT, INT]);
const SIZES: Shape = Structure(&[LONG, List(&LONG), List(&LONG)]);
const REAL: Shape = Plain(DOUBLE);
const PLACES: Shape = Structure(&[
    Structure(&[REAL, REAL, REAL, REAL, REAL, REAL, REAL, REAL]),
    List(&INT),
]);
const COLUMN: Shape = Structure(&[
    INT,
    List(&INT),
    List(&BYTES),
    INT,
    LONG,
    LONG,
    LONG,
    List(&PAIR),
    LONG,
    LONG,
    LONG,
    STATISTICS,
    List(&PAGES),
    LONG,
    INT,
    SIZES,
    PLACES,
]);
const CHUNK: Shape = Structure(&[BYTES, LONG, COLUMN, LONG, INT, LONG, INT, Unread, BYTES]);
const SORTED: Shape = Structure(&[INT, Truth, Truth]);
const GROUP: Shape = Structure(&[
    List(&CHUNK),
    LONG,
    LONG,
    List(&SORTED),
    LONG,
    LONG,
    Plain(I16),
]);

/// The fields of the metadata, of which the second is the schema.
pub(super) const FILE: &[Shape] = &[
    INT,
    List(&Structure(ELEMENT)),
    LONG,
    List(&GROUP),
    List(&PAIR),
    BYTES,
    List(&Structure(&[EMPTY, EMPTY])),
    Unread,
    BYTES,
];

/// The fields of the header of a page.
pub(super) const PAGE: &[Shape] = &[
    INT,
    INT,
    INT,
    INT,
    Structure(&[INT, INT, INT, INT, STATISTICS]),
    EMPTY,
    Structure(&[INT, INT, Truth]),
    Structure(&[INT, INT, INT, INT, INT, INT, Truth, STATISTICS]),
];
