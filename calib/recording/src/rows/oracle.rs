//! Tables read by plain rows, in parallel, are those read line by line.

use rand::seq::IndexedRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::table::Table;
use crate::clock::Clock;
use crate::header::sniff::Start;
use crate::recording::ReadOptions;
use crate::rows::Rows;
use crate::source::batches::Batches;

/// Method of reading a text.
enum Way {
    LineByLine,
    PlainRows,
}

/// The table of `text`, or what is wrong with it.
fn table(text: &[u8], options: &ReadOptions, way: Way, batch: usize) -> Result<Table, String> {
    let head = &text[..text.len().min(1 << 16)];
    let start = Start::look("text", head, None, options).map_err(|e| e.to_string())?;
    let mut table = Table {
        name: "text".to_owned(),
        clock: Clock::new(None, options),
        ..Table::default()
    };
    let rows = Rows::new(&mut table, &start, options);
    let batches = Batches::new(text, options.max_bytes).in_size(batch);
    match way {
        Way::LineByLine => rows.read_line_by_line(batches),
        Way::PlainRows => rows.read(batches),
    }
    .map_err(|e| e.to_string())?;
    Ok(table)
}

/// Separator and decimal mark of a text.
type Spelling = (&'static str, char);

const SPELLINGS: [Spelling; 6] = [
    (",", '.'),
    (", ", '.'),
    (";", ','),
    ("\t", '.'),
    ("   ", '.'),
    (" \t", ','),
];

/// Cells that are no plain numbers, or only just.
const ODD_CELLS: [&str; 24] = [
    "",
    "nan",
    "inf",
    "-",
    "--",
    "1e400",
    "1e15",
    "-1e300",
    "1e-320",
    "0x1p3",
    "1D-3",
    "\u{2212}2",
    "\"3\"",
    " 4 ",
    "5.",
    ".5",
    "+6",
    "1e5m",
    "1.2.3",
    "1,2,3",
    "text",
    "1e",
    "\"",
    "-0",
];

/// Lines that are no rows.
const ODD_LINES: [&str; 10] = [
    "",
    " ",
    "# 1,2,3",
    "%",
    "// 7",
    "1,2",
    "t,ax,ay,az,gx,gy,gz,temp,note",
    "\t",
    "1 2 3 4 5 6 7 8 9 10",
    "\0",
];

/// A recording with faults here and there: more of them the larger `faults` is.
fn text(random: &mut ChaCha8Rng, faults: f64) -> Vec<u8> {
    let &(separator, mark) = SPELLINGS.choose(random).unwrap();
    let &origin = [0i64, 0, 1_700_000_000, 1_700_000_000_000_000_000]
        .choose(random)
        .unwrap();
    let &end = ["\n", "\r\n", "\r"].choose(random).unwrap();
    let digits = random.random_range(0..17);
    let mut text = ["t", "ax", "ay", "az", "gx", "gy", "gz", "temp", "note"].join(separator) + end;
    for row in 0..random.random_range(1..400_i64) {
        let odd = |random: &mut ChaCha8Rng, share: f64| random.random_bool(share * faults);
        if odd(random, 0.3) {
            text += ODD_LINES.choose(random).unwrap();
            text += end;
        }
        let mut cells = vec![
            (origin
                + if origin > 1 << 40 {
                    row * 10_000_000
                } else {
                    row
                })
            .to_string(),
        ];
        cells.extend((0..8).map(|_| format!("{:.digits$}", random.random_range(-20.0..20.0))));
        if odd(random, 0.1) {
            cells[0] = format!("{}", random.random_range(0..=row));
        }
        if odd(random, 0.3) {
            let at = random.random_range(0..cells.len());
            cells[at] = (*ODD_CELLS.choose(random).unwrap()).to_owned();
        }
        if odd(random, 0.1) {
            cells.truncate(random.random_range(1..9));
        }
        let line = cells.join("\u{1f}").replace('.', &mark.to_string());
        text += &line.replace('\u{1f}', separator);
        if odd(random, 0.1) {
            text += separator;
        }
        text += if odd(random, 0.1) { "\n" } else { end };
    }
    let mut text = text.into_bytes();
    if random.random_bool(0.5) {
        text.truncate(text.len() - random.random_range(0..text.len().min(12)));
    }
    text
}

fn options(random: &mut ChaCha8Rng) -> ReadOptions {
    ReadOptions {
        na_drop: random.random_bool(0.7),
        sort_time: random.random_bool(0.5),
        skip_bad_rows: *[0, 3, 1000].choose(random).unwrap(),
        rate: random.random_bool(0.2).then_some(100.0),
        max_rows: if random.random_bool(0.1) { 100 } else { 1000 },
        max_bytes: if random.random_bool(0.1) {
            10_000
        } else {
            1 << 20
        },
        ..ReadOptions::default()
    }
}

#[test]
fn plain_rows_in_parallel_give_the_table_read_line_by_line_and_the_same_error() {
    let random = &mut ChaCha8Rng::seed_from_u64(1);
    let pools = [1, 3].map(|n| {
        rayon::ThreadPoolBuilder::new()
            .num_threads(n)
            .build()
            .unwrap()
    });
    let (mut read, mut refused) = (0, 0);
    for case in 0..400 {
        let text = text(random, [0.0, 0.01, 0.1, 1.0][case % 4]);
        let options = options(random);
        let batch = random.random_range(20..3000);
        // The debug form of a number is as exact as the number, and knows -0 from 0.
        let read_by = |way| format!("{:?}", table(&text, &options, way, batch));
        let oracle = read_by(Way::LineByLine);
        *(if oracle.starts_with("Ok") {
            &mut read
        } else {
            &mut refused
        }) += 1;
        for pool in &pools {
            let table = pool.install(|| read_by(Way::PlainRows));
            assert_eq!(table, oracle, "case {case}, batches of {batch}");
        }
    }
    assert!(read > 100 && refused > 50, "{read} read, {refused} refused");
}
