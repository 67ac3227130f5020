//! Section A: what a text can be encoded, separated and quoted like.

use std::io::Write;

use super::*;

#[test]
fn rows_1_and_2_empty_files_and_bare_headers_are_refused() {
    refused("", "", &["file is empty"]);
    refused("# nothing\n\n", "", &["no data"]);
    refused("# note\nt,ax,ay,az\n", "2", &["header found, no data rows"]);
}

#[test]
fn row_3_numbers_without_a_header_are_told_apart_by_gravity() {
    let text = rows(200).join("\n") + "\n";
    assert_same_samples(
        &warned(&text, &["no header", "t=1,ax=2,ay=3,az=4,gx=5"]),
        200,
    );
    let swapped = |row: &String| {
        let c: Vec<_> = row.split(',').collect();
        [c[0], c[4], c[5], c[6], c[1], c[2], c[3]].join(" ")
    };
    let text: Vec<_> = rows(200).iter().map(swapped).collect();
    assert_same_samples(&warned(text.join("\n"), &["gx=2,gy=3,gz=4,ax=5"]), 200);
    refused(
        "0 500 3 1 900 2 1\n1 500 2 1 900 2 1\n",
        "1",
        &["7 columns", "--columns"],
    );
}

#[test]
fn row_4_unknown_names_get_a_line_to_paste_that_works() {
    let text = file("clock,a1_x,a1_y,a1_z,r1_x,r1_y,r1_z", &rows(200));
    refused(
        &text,
        "1",
        &["`clock`", "`a1_x`", "--columns t=", "ax=a1_x"],
    );
    let columns = "t=clock,ax=a1_x,ay=a1_y,az=a1_z,gx=r1_x,gy=6,gz=r1_z"
        .parse()
        .unwrap();
    let recording = read(
        &text,
        &ReadOptions {
            columns,
            ..ReadOptions::default()
        },
    )
    .unwrap();
    assert_same_samples(&recording, 200);
    let columns = "t=clock,ax=a1_x,ay=a1_y,az=a1_z,gx=r1_x,gy=r1_y,gz=r1_z";
    refused(&text, "1", &[columns]);
    let columns = "t=clock,ax=a1x,ay=a1_y,az=a1_z".parse().unwrap();
    let options = ReadOptions {
        columns,
        ..ReadOptions::default()
    };
    refused_with(&text, &options, "1", &["ax=a1x", "nearest: `a1_x`"]);
    refused(
        file("t,ax,ay,foo,gx,gy,gz", &rows(9)),
        "1",
        &["no column for az"],
    );
}

#[test]
fn row_5_doubled_columns_are_refused_with_both_numbers() {
    refused(
        file("t,ax,ay,ax,gx,gy,gz", &rows(9)),
        "1",
        &["column 2", "or column 4"],
    );
}

#[test]
fn columns_that_are_said_win_and_the_others_go_by_name() {
    let text = file("t,ax,ay,ax2,gx,gy,gz", &rows(200));
    let columns = "az=ax2".parse().unwrap();
    let options = ReadOptions {
        columns,
        ..ReadOptions::default()
    };
    assert_same_samples(&read(&text, &options).unwrap(), 200);
}

#[test]
fn one_column_for_two_roles_is_a_wrong_call() {
    // Two files may share their numbers; one table may not.
    let twins = ReadOptions {
        columns: "ax=2,ay=2,az=4".parse().unwrap(),
        ..ReadOptions::default()
    };
    let error = read(file(HEADER, &rows(50)), &twins).unwrap_err();
    assert!(
        matches!(&error, Error::Usage(found) if found.text(findings::Front::CommandLine).contains("ax=2,ay=2: column 2 for both ax and ay")),
        "{error}"
    );
    let empty = "t=,ax=2".parse::<calib::recording::ColumnMap>();
    assert!(
        empty
            .unwrap_err()
            .to_string()
            .contains("`t=` names no column")
    );
    let columns = "ax=2,ay=ax,az=4".parse().unwrap();
    let options = ReadOptions {
        columns,
        ..ReadOptions::default()
    };
    let error = read(file(HEADER, &rows(50)), &options).unwrap_err();
    assert!(
        matches!(&error, Error::Usage(found) if found.text(findings::Front::CommandLine).contains("ax=2,ay=ax: column 2")),
        "{error}"
    );
    // A column that is said to be one thing is not another by its name.
    let columns = "ax=gx,ay=gy,az=gz".parse().unwrap();
    let options = ReadOptions {
        columns,
        ..ReadOptions::default()
    };
    let swapped = rows(200).into_iter().map(|row| {
        let c: Vec<_> = row.split(',').collect();
        [c[0], c[4], c[5], c[6], c[1], c[2], c[3]].join(",")
    });
    let recording = read(file(HEADER, &swapped.collect::<Vec<_>>()), &options).unwrap();
    assert!(recording.gyroscope.is_none());
    assert_eq!(recording.accelerometer.unwrap().values[0].x, 9.8);
}

#[test]
fn rows_6_and_7_marks_and_line_ends_do_not_matter() {
    let text = file(HEADER, &rows(200));
    read_as_usual(format!("\u{feff}{text}"), 200);
    read_as_usual(text.replace('\n', "\r\n"), 200);
    read_as_usual(text.replace('\n', "\r"), 200);
    read_as_usual(text.trim_end(), 200);
    read_as_usual(
        text.replacen('\n', "\r\n", 40)
            .replacen("\n0.9", "\r0.9", 5),
        200,
    );
}

#[test]
fn row_7_line_numbers_hold_for_every_kind_of_line_end() {
    for end in ["\n", "\r\n", "\r"] {
        let mut rows = rows(20);
        rows[10] = "0.1,1,2,x7,0,0,0".to_owned();
        let text = file(&format!("# note\n\n{HEADER}"), &rows).replace('\n', end);
        refused(&text, "14:9", &["`x7`", "column 4 (`az`)"]);
        refused(text.replace("note", "\"quoted\" note"), "14:9", &["`x7`"]);
        refused(format!("\u{feff}{text}"), "14:9", &["`x7`"]);
    }
}

#[test]
fn row_8_utf_16_is_decoded_with_and_without_a_mark() {
    let text = file(HEADER, &rows(200)).replace(',', "\t");
    let marked = format!("\u{feff}{text}");
    let little = |text: &str| {
        text.encode_utf16()
            .flat_map(u16::to_le_bytes)
            .collect::<Vec<u8>>()
    };
    let big = |text: &str| {
        text.encode_utf16()
            .flat_map(u16::to_be_bytes)
            .collect::<Vec<u8>>()
    };
    for bytes in [little(&marked), big(&marked), little(&text), big(&text)] {
        assert_same_samples(&warned(bytes, &["UTF-16"]), 200);
    }
}

#[test]
fn row_9_latin_1_headers_are_read() {
    let header = "t,ax (m/s\u{b2}),ay (m/s\u{b2}),az (m/s\u{b2}),gx,gy,gz";
    let latin: Vec<u8> = file(header, &rows(200)).chars().map(|c| c as u8).collect();
    assert_same_samples(&warned(latin, &["Latin-1"]), 200);
}

#[test]
fn row_10_binary_data_in_a_text_is_refused_at_its_byte() {
    let mut bytes = file(HEADER, &rows(50)).into_bytes();
    bytes[200] = 0;
    refused(&bytes, "4", &["binary data at byte 200"]);
    refused([0u8; 5000], "1", &["binary data at byte 0"]);
}

#[test]
fn rows_11_and_15_any_separator_will_do() {
    let text = file(HEADER, &rows(200));
    for separator in [";", "\t", " , ", "   ", " \t "] {
        read_as_usual(text.replace(',', separator), 200);
    }
}

#[test]
fn row_12_decimal_commas_between_semicolons_or_blanks_are_read() {
    let text = file(HEADER, &rows(200));
    for separator in [";", "\t", " "] {
        let text = text.replace(',', separator).replace('.', ",");
        assert_same_samples(&warned(text, &["decimal comma"]), 200);
    }
}

#[test]
fn row_13_a_comma_that_is_both_separator_and_decimal_mark_is_refused() {
    let text = file(HEADER, &rows(50)).replace('.', ",");
    refused(text, "1", &["7 names", "14 cells", "decimal mark"]);
}

#[test]
fn row_14_digit_grouping_is_refused_in_its_cell() {
    let mut rows = rows(50);
    rows[3] = "0.03,\"1,234.5\",2,3,0,0,0".to_owned();
    refused(file(HEADER, &rows), "5:7", &["`1,234.5`", "thousands"]);
    let german = file(HEADER, &rows)
        .replace("\"1,234.5\"", "9")
        .replace(',', ";");
    let german = german.replace('.', ",").replace("0,03;9", "0,03;1.234,5");
    refused(german, "5:6", &["`1.234,5`", "thousands"]);
}

#[test]
fn row_16_quoted_cells_are_read() {
    let quoted = |line: &str| {
        let cells: Vec<_> = line.split(',').map(|cell| format!("\"{cell}\"")).collect();
        cells.join(",")
    };
    let lines: Vec<_> = file(HEADER, &rows(200)).lines().map(quoted).collect();
    read_as_usual(lines.join("\n"), 200);
}

#[test]
fn row_17_an_open_quote_is_refused_where_it_opens() {
    let mut rows = rows(50);
    rows[3] = "0.03,\"1,2,3,0,0,0".to_owned();
    refused(file(HEADER, &rows), "5:6", &["never closed"]);
}

#[test]
fn row_17_a_cell_with_a_line_break_is_told_from_an_open_quote() {
    let noted = |row: &String| format!("{row},\"a, b\"");
    let mut lines: Vec<_> = rows(200).iter().map(noted).collect();
    lines[3] = rows(200)[3].clone() + ",\"first\nsecond\"";
    let text = file(&format!("{HEADER},note"), &lines);
    let column = rows(200)[3].len() + 2;
    refused(
        &text,
        &format!("5:{column}"),
        &["opened here and closed in line 6", "line break"],
    );
    let skip = ReadOptions {
        skip_bad_rows: 2,
        ..ReadOptions::default()
    };
    let recording = warned_with(&text, &skip, &["2 broken rows"]);
    assert_eq!(recording.accelerometer.unwrap().len(), 199);
    let names = HEADER.replace("ay", "\"ay\n(up)\"");
    refused(file(&names, &rows(50)), "1:6", &["closed in line 2"]);
    // Where every cell is quoted the next quote opens another.
    let quoted = |row: &String| format!("\"{}\"", row.replace(',', "\",\""));
    let mut lines: Vec<_> = rows(50).iter().map(quoted).collect();
    lines[3].pop();
    let at = format!("5:{}", lines[3].rfind('"').unwrap() + 1);
    refused(file(HEADER, &lines), &at, &["never closed"]);
}

#[test]
fn row_18_ragged_rows_are_refused_or_left_out_when_allowed() {
    let mut rows = rows(200);
    rows[3] = "0.03,1,2,3".to_owned();
    rows[7] = "0.07,1,2,3,4,5,6,7,8".to_owned();
    let text = file(HEADER, &rows);
    refused(&text, "5:1", &["4 cells, 7 expected", "--skip-bad-rows"]);
    let allow = |n| ReadOptions {
        skip_bad_rows: n,
        ..ReadOptions::default()
    };
    refused_with(&text, &allow(1), "9:1", &["9 cells"]);
    let recording = warned_with(&text, &allow(2), &["2 broken rows"]);
    assert_eq!(recording.accelerometer.unwrap().len(), 198);
}

#[test]
fn row_19_a_last_row_cut_short_is_left_out() {
    for cut in ["2.0,1,2,", "2.0", "2.0,1,2,3,4,5,-", "2.0,1,2,3,4,5,"] {
        let text = file(HEADER, &rows(200)) + cut;
        assert_same_samples(&warned(text, &["last row is cut short", "r.csv:202:"]), 200);
    }
}

#[test]
fn row_19_a_last_row_cut_within_its_last_number_is_left_out() {
    let text = file(HEADER, &rows(200)) + &row(2.0, 200);
    read_as_usual(&text, 201);
    for cut in 1..=7 {
        let text = &text[..text.len() - cut];
        assert_same_samples(&warned(text, &["last row is cut short", "r.csv:202:"]), 200);
        read(format!("{text}\n"), &ReadOptions::default()).unwrap();
    }
    // Numbers in their shortest form differ in length anyway.
    let shortest = |row: &String| row.trim_end_matches('0').to_owned();
    let lines: Vec<_> = rows(200).iter().map(shortest).collect();
    let text = file(HEADER, &lines);
    let recording = read(text.trim_end().to_owned() + "1", &ReadOptions::default()).unwrap();
    assert_eq!(
        recording.warnings.texts(findings::Front::CommandLine),
        Vec::<String>::new()
    );
}

#[test]
fn row_20_comments_are_skipped_and_may_be_the_header() {
    let mut lines = rows(200);
    lines.insert(100, "% half way".to_owned());
    lines.insert(50, "// a note, with, commas".to_owned());
    read_as_usual(file(&format!("# 2026\n#{HEADER}"), &lines), 200);
    read_as_usual(file(HEADER, &lines), 200);
    let text = "key: value\nother: 5 mm, 7\n".repeat(150);
    read_as_usual(file(&(text + HEADER), &lines), 200);
    for repeats in [300, 100_000] {
        let preface = "# a line of a log\n".repeat(repeats);
        read_as_usual(file(&(preface + HEADER), &lines), 200);
    }
    refused("#\n".repeat(33 << 20), "", &["64 MiB of comments"]);
}

#[test]
fn row_21_a_second_header_is_refused_at_its_line_and_one_that_comes_often_left_out() {
    let mut rows = rows(200);
    rows.insert(20, HEADER.to_owned());
    refused(
        file(HEADER, &rows),
        "22:1",
        &["header of line 1 comes again", "split"],
    );
    rows.insert(80, HEADER.to_owned());
    rows.insert(140, HEADER.to_owned());
    let recording = read(file(HEADER, &rows), &ReadOptions::default()).unwrap();
    assert_same_samples(&recording, 200);
    assert_eq!(recording.warnings.iter().count(), 1);
}

#[test]
fn row_22_glued_names_are_counted() {
    let header = "time (s)ax (m/s^2),ay (m/s^2),az (m/s^2),gx,gy,gz";
    refused(
        file(header, &rows(50)),
        "1",
        &["6 names", "7 cells", "--columns"],
    );
    let columns = "t=1,ax=2,ay=3,az=4,gx=5,gy=6,gz=7".parse().unwrap();
    let options = ReadOptions {
        columns,
        ..ReadOptions::default()
    };
    assert_same_samples(&read(file(header, &rows(200)), &options).unwrap(), 200);
}

#[test]
fn rows_23_and_24_what_is_no_number_is_refused_or_dropped_and_counted() {
    for word in ["nan", "NaN", "-Inf", "NULL", "--", "1e400", ""] {
        let mut rows = rows(200);
        rows[3] = format!("0.03,1,{word},3,4,5,6");
        let text = file(HEADER, &rows);
        refused(&text, "5:8", &["column 3 (`ay`)", "--na drop"]);
        let drop = ReadOptions {
            na_drop: true,
            ..ReadOptions::default()
        };
        let recording = warned_with(&text, &drop, &["1 row"]);
        assert_eq!(recording.gyroscope.unwrap().len(), 199);
    }
    refused(
        file(HEADER, &rows(9)).replace("0.0300,", "0.0300,1e5m"),
        "5:8",
        &["not a number"],
    );
}

#[test]
fn row_23_text_in_the_first_row_is_no_header() {
    let mut lines = rows(200);
    lines[0] = "0,1x,2x,3x,4x,5x,6x".to_owned();
    let words = ["`1x` in column 2", "not a number"];
    refused(file(HEADER, &lines), "2:3", &words);
    refused(lines.join("\n"), "1:3", &words);
    refused(
        format!("1,2x,3x\n{}", rows(200).join("\n")),
        "1:1",
        &["3 cells"],
    );
    refused(file("#nothing\nt,ax", &lines), "2", &["2 names", "7 cells"]);
}

#[test]
fn row_25_fortran_and_unicode_are_read_and_hexadecimal_is_not() {
    let mut lines = rows(200);
    lines[0] = "0,0.98D+1,0,0,0,0.01,2".to_owned();
    assert_same_samples(&warned(file(HEADER, &lines), &["exponents"]), 200);
    let text = file(HEADER, &rows(200)).replace(",-", ",\u{2212}");
    assert_same_samples(&warned(text, &["U+2212"]), 200);
    lines[0] = "0,0x1p3,0,0,0,0.01,2".to_owned();
    refused(file(HEADER, &lines), "2:3", &["hexadecimal"]);
}

#[test]
fn row_26_gzip_is_opened_and_others_are_named() {
    let text = file(HEADER, &rows(2000));
    let mut gz = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    gz.write_all(text.as_bytes()).unwrap();
    let gz = gz.finish().unwrap();
    read_as_usual(&gz, 2000);
    refused(&gz[..gz.len() / 2], "", &[]);
    refused(b"\xfd7zXZ\0 and so on", "", &["xz", "unxz"]);
    refused(b"PK\x03\x04 and so on", "", &["zip"]);
    refused(b"\x28\xb5\x2f\xfd and so on", "", &["reading stopped"]);
}

#[test]
fn row_26_a_zstd_file_is_opened() {
    let text = file(HEADER, &rows(2000));
    let level = ruzstd::encoding::CompressionLevel::Fastest;
    read_as_usual(
        ruzstd::encoding::compress_to_vec(text.as_bytes(), level),
        2000,
    );
}

#[test]
fn row_35_a_pointer_is_not_the_data() {
    refused(
        "version https://git-lfs.github.com/spec/v1\noid sha256:00\n",
        "",
        &["git lfs pull"],
    );
}
