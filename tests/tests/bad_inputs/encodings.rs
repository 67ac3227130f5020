//! Cases 1 to 25: what a text can be encoded, separated and quoted like.

use super::bench::Bench;
use super::device::{HEADER, csv, good, lines, table};

/// What `calibrate` says of this file.
#[track_caller]
fn refused(content: impl AsRef<[u8]>, words: &[&str]) {
    let bench = Bench::with("r.csv", content);
    let run = bench.run(&["calibrate", "r.csv", "-o", "cal.json"]);
    run.ends(3).says(&["r.csv"]).says(words).changes(&[]);
}

/// Calibrated, with a warning that holds `words`.
#[track_caller]
fn accepted(content: impl AsRef<[u8]>, words: &[&str]) {
    let bench = Bench::with("r.csv", content);
    bench.run(&["calibrate", "r.csv"]).ends(0).says(words);
}

#[test]
fn case_001_an_empty_file() {
    refused("", &["file is empty"]);
}

#[test]
fn case_002_a_header_without_rows() {
    refused(format!("{HEADER}\n"), &["header found, no data rows"]);
}

#[test]
fn case_003_numbers_without_a_header() {
    accepted(lines(good()).join("\n"), &["no header", "t=1,ax=2"]);
    refused("1 2\n3 4\n5 6\n", &["--columns"]);
}

#[test]
fn case_004_unknown_names_get_a_line_to_paste() {
    let text = table("clock,a1_x,a1_y,a1_z,r1_x,r1_y,r1_z", &lines(good()));
    refused(text, &["r.csv:1", "`a1_x`", "--columns t="]);
}

#[test]
fn case_005_doubled_columns() {
    refused(
        table("t,ax,ay,ax,gx,gy,gz", &lines(good())),
        &["column 2", "or column 4"],
    );
}

#[test]
fn case_006_a_byte_order_mark() {
    let bench = Bench::with("r.csv", format!("\u{feff}{}", csv(good())));
    bench
        .run(&["calibrate", "r.csv"])
        .ends(0)
        .is_silent_on(&["mark"]);
}

#[test]
fn case_007_line_ends_of_three_kinds_and_true_line_numbers() {
    for end in ["\n", "\r\n", "\r"] {
        let good = csv(good());
        accepted(good.replace('\n', end), &[]);
        let mut spoilt: Vec<&str> = good.lines().collect();
        spoilt[99] = "x,1,2,3,4,5,6";
        refused(spoilt.join(end), &["r.csv:100:1"]);
    }
}

#[test]
fn case_008_utf_16_with_a_warning() {
    let text = csv(good());
    for big in [false, true] {
        let mark = std::iter::once(0xfeff_u16).chain(text.encode_utf16());
        let bytes: Vec<u8> = mark
            .flat_map(|unit| {
                if big {
                    unit.to_be_bytes()
                } else {
                    unit.to_le_bytes()
                }
            })
            .collect();
        accepted(bytes, &["UTF-16"]);
    }
}

#[test]
fn case_009_latin_1_in_the_header() {
    let header = "t (s),ax (m/s\u{b2}),ay (m/s\u{b2}),az (m/s\u{b2}),gx,gy,gz";
    let latin = |text: &str| -> Vec<u8> { text.chars().map(|c| c as u8).collect() };
    accepted(latin(&table(header, &lines(good()))), &["Latin-1"]);
}

#[test]
fn case_010_a_nul_byte_inside_the_text() {
    let mut bytes = csv(good()).into_bytes();
    bytes[5000] = 0;
    refused(bytes, &["byte 5000"]);
}

#[test]
fn case_011_semicolons() {
    accepted(csv(good()).replace(',', ";"), &[]);
}

#[test]
fn case_012_semicolons_and_decimal_commas() {
    accepted(
        csv(good()).replace(',', ";").replace('.', ","),
        &["decimal comma"],
    );
}

#[test]
fn case_013_commas_for_both() {
    let text = csv(good());
    let (header, rest) = text.split_once('\n').unwrap();
    refused(
        format!("{header}\n{}", rest.replace('.', ",")),
        &["a comma is both separator and decimal mark", "semicolons"],
    );
}

#[test]
fn case_014_thousands_separators() {
    let text = csv(good()).replace(',', ";");
    let mut rows: Vec<String> = text.lines().map(str::to_owned).collect();
    rows[4] = "0.0300;1,234.5;2;3;4;5;6".to_owned();
    refused(rows.join("\n"), &["r.csv:5:8", "1,234.5"]);
}

#[test]
fn case_015_tabs_and_blanks() {
    accepted(csv(good()).replace(',', "\t"), &[]);
    accepted(csv(good()).replace(',', "   "), &[]);
}

#[test]
fn case_016_quoted_cells() {
    let quoted: Vec<String> = csv(good())
        .lines()
        .map(|line| format!("\"{}\"", line.replace(',', "\",\"")))
        .collect();
    accepted(quoted.join("\n"), &[]);
}

#[test]
fn case_017_an_open_quote_is_refused_where_it_opens() {
    let mut rows = lines(good());
    rows[48] = format!("\"{}", rows[48]);
    refused(table(HEADER, &rows), &["r.csv:50:1"]);
}

#[test]
fn case_018_a_ragged_row() {
    let mut rows = lines(good());
    rows[48] = "0.48,1,2".to_owned();
    let text = table(HEADER, &rows);
    refused(&text, &["r.csv:50", "3", "7", "--skip-bad-rows"]);
    let bench = Bench::with("r.csv", text);
    bench
        .run(&["calibrate", "r.csv", "--skip-bad-rows", "1"])
        .ends(0);
}

#[test]
fn case_019_a_last_row_cut_by_the_end() {
    let text = csv(good());
    accepted(&text[..text.len() - 30], &["last row"]);
}

#[test]
fn case_020_comment_lines() {
    accepted(format!("# a\n% b\n// c\n{}", csv(good())), &[]);
    accepted(format!("#{}", csv(good())), &[]);
}

#[test]
fn case_021_a_header_in_the_middle() {
    let mut rows = lines(good());
    rows[48] = HEADER.to_owned();
    refused(table(HEADER, &rows), &["r.csv:50", "header"]);
}

#[test]
fn case_022_a_glued_header() {
    let text = table("time (s)ax (g),ay (g),az (g),gx,gy,gz", &lines(good()));
    refused(text, &["6", "7", "--columns"]);
}

#[test]
fn case_023_text_in_a_number_cell() {
    for word in ["nan", "NULL", "--", "1e5m"] {
        let mut rows = lines(good());
        rows[48] = format!("0.48,1,{word},3,4,5,6");
        refused(table(HEADER, &rows), &["r.csv:50:8", "column 3"]);
    }
}

#[test]
fn case_024_numbers_that_are_not_finite() {
    for word in ["NaN", "Inf", "1e400"] {
        let mut rows = lines(good());
        rows[48] = format!("0.48,1,{word},3,4,5,6");
        let bench = Bench::with("r.csv", table(HEADER, &rows));
        bench
            .run(&["calibrate", "r.csv"])
            .ends(3)
            .says(&["r.csv:50:8", "column 3"]);
        let run = bench.run(&["calibrate", "r.csv", "--na", "drop"]);
        run.ends(0).says(&["1 row"]);
    }
}

#[test]
fn case_025_fortran_exponents_and_the_minus_sign() {
    accepted(csv(good()).replace('-', "\u{2212}"), &["minus"]);
    let fortran: Vec<String> = good()
        .iter()
        .map(|row| row.map(|v| format!("{v:.9e}").replace('e', "D")).join(","))
        .collect();
    accepted(table(HEADER, &fortran), &["exponent"]);
    let mut rows = lines(good());
    rows[48] = "0.48,1,0x1p3,3,4,5,6".to_owned();
    refused(table(HEADER, &rows), &["r.csv:50:8", "column 3"]);
}
