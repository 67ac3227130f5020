use super::*;
use crate::Container;
use crate::Tabular;

/// The texts of the tables in `json`, by name.
fn read(json: &str) -> Vec<(String, String)> {
    let format = Tabular::by_name("json").unwrap();
    let tables =
        Container::tables_in_memory(format, json.as_bytes().into(), Limits::default()).unwrap();
    let text = |entry: &crate::Entry| {
        let mut text = Vec::new();
        tables.write(entry, &mut text).unwrap();
        (entry.name.clone(), String::from_utf8(text).unwrap())
    };
    tables.entries().iter().map(text).collect()
}

fn only(json: &str) -> String {
    let [(name, text)] = <[_; 1]>::try_from(read(json)).unwrap();
    assert_eq!(name, "");
    text
}

fn refused(json: &str) -> String {
    let format = Tabular::by_name("json").unwrap();
    let tables = Container::tables_in_memory(format, json.as_bytes().into(), Limits::default());
    let written = tables.and_then(|tables| {
        let mut entries = tables.entries().iter();
        entries.try_for_each(|entry| tables.write(entry, &mut std::io::sink()))
    });
    written.unwrap_err().to_string()
}

#[test]
fn records_are_rows_in_lines_and_in_an_array() {
    let table = "acc.x,acc.y,acc.z,t\n1,2.5,3,1700000000000000001\n4,5,6,1700000000000000002\n";
    let a = r#"{"t": 1700000000000000001, "acc": [1, 2.5, 3]}"#;
    let b = r#"{"t": 1700000000000000002, "acc": {"x": 4, "y": 5, "z": 6}}"#;
    assert_eq!(only(&format!("{a}\n{b}\n")), table);
    assert_eq!(only(&format!("\u{feff} [{a},\n {b}]")), table);
}

#[test]
fn the_stamp_of_ros_is_one_number() {
    let json = r#"[{"header": {"stamp": {"sec": 17, "nanosec": 5000}}, "w": {"x": 1}}]"#;
    assert_eq!(only(json), "header.stamp,w.x\n17.000005000,1\n");
}

#[test]
fn records_of_two_kinds_leave_cells_blank() {
    let json = r#"[{"t": 0, "ax": 1, "on": true}, {"t": 1, "gx": 2, "note": "a,b"}, {"t": null}]"#;
    assert_eq!(
        only(json),
        "ax,on,t,gx,note\n1,1,0,,\n,,1,2,\"a,b\"\n,,,,\n"
    );
}

#[test]
fn a_packet_is_a_row_per_sample() {
    let packet = |t| {
        let (a, b) = (
            r#"[{"x": 1, "y": 2}, {"x": 3, "y": 4}]"#,
            "[[5, 6, 7], [8, 9, 0]]",
        );
        format!(r#"{{"imu6": {{"Timestamp": {t}, "ArrayAcc": {a}, "gyro": {b}}}}}"#)
    };
    let names =
        "imu6.ArrayAcc.x,imu6.ArrayAcc.y,imu6.Timestamp,imu6.gyro.x,imu6.gyro.y,imu6.gyro.z\n";
    let (first, second) = ("1,2,7,5,6,7\n3,4,7,8,9,0\n", "1,2,9,5,6,7\n3,4,9,8,9,0\n");
    let expected = format!("{names}{first}{second}");
    assert_eq!(only(&format!("[{},{}]", packet(7), packet(9))), expected);
    assert_eq!(only(&format!("{}\n{}\n", packet(7), packet(9))), expected);
    let ten = vec![packet(7); 10].join(",");
    let (name, text) = &read(&format!(r#"{{"data": [{ten}]}}"#))[0];
    assert_eq!(
        (name.as_str(), text),
        ("data", &format!("{names}{}", first.repeat(10)))
    );
}

#[test]
fn a_file_that_ends_within_a_record_keeps_those_before() {
    let json = "{\"t\": 0}\n{\"t\": 1}\n{\"t\":";
    assert_eq!(only(json), "t\n0\n1\n");
    let format = Tabular::by_name("json").unwrap();
    let tables =
        Container::tables_in_memory(format, json.as_bytes().into(), Limits::default()).unwrap();
    let found = &tables.warnings[0];
    assert_eq!(
        (found.kind, found.value("line")),
        (findings::Kind::FILE_CUT, Some(3.0))
    );
}

#[test]
fn tables_are_found_within_a_document() {
    let tens: Vec<String> = (0..10).map(|k| format!("[{k}, 0, 9.8]")).collect();
    let (tens, t) = (tens.join(","), "0,1,2,3,4,5,6,7,8,9");
    let columns = format!(r#"{{"rate": 100, "acc": [{tens}], "time": [{t}]}}"#);
    assert!(only(&columns).starts_with("acc.x,acc.y,acc.z,time\n0,0,9.8,0\n"));
    let named = format!(
        r#"{{"payload": {{"interval_ms": 10, "values": [{tens}], "sensors": [{{"name": "accX", "units": "m/s2"}}, {{"name": "accY"}}, "accZ"]}}}}"#
    );
    let read = read(&named);
    assert_eq!(read[0].0, "payload/values");
    let begin = "time (ms),accX (m/s2),accY,accZ\n0.0,0,0,9.8\n10.0,1,0,9.8\n";
    assert!(read[0].1.starts_with(begin), "{}", read[0].1);
}

#[test]
fn records_by_keys_of_a_database_are_rows_in_the_order_of_the_keys() {
    let record =
        |key: &str, k: u32| format!(r#""{key}": {{"t": {k}, "acc": {{"x": {k}, "y": 0}}}}"#);
    let by = |key: fn(u32) -> String| -> String {
        let records: Vec<String> = (0..11).map(|k| record(&key(k), k)).collect();
        format!(r#"{{"log": {{"imu": {{{}}}}}}}"#, records.join(","))
    };
    let read = read(&by(|k| format!("-Nx{}", char::from(b'a' + k as u8))));
    assert_eq!(read[0].0, "log/imu");
    assert!(
        read[0].1.starts_with("acc.x,acc.y,t\n0,0,0\n1,0,1\n"),
        "{}",
        read[0].1
    );
    // Numbers by their size: 9, 10.
    let read = &self::read(&by(|k| k.to_string()))[0].1;
    assert!(read.ends_with("9,0,9,9\n10,0,10,10\n"), "{read}");
    // Three sensors are no records.
    let few = r#"{"a": {"x": 1}, "b": {"x": 1}, "c": {"x": 1}}"#;
    assert!(refused(few).contains("it holds a, b, c"));
}

#[test]
fn what_is_no_table_is_refused_in_words() {
    assert!(refused(r#"{"a": 1, "b": [1, 2]}"#).contains("it holds a, b"));
    let lists = r#"[{"t": 0, "acc": [{"x": 1}, {"x": 2}], "gyro": [{"x": 1}]}]"#;
    assert!(refused(lists).contains("lists within its records, as `gyro`"));
    let lists = r#"[{"t": 0, "acc": [{"x": [[1, 2], [3, 4]]}, {"x": 2}]}]"#;
    assert!(refused(lists).contains("lists within its records, as `acc.x`"));
    assert!(refused(r#"[{"t": 0}, {"t" 1}]"#).starts_with("row 1, column 17: "));
    assert!(refused(r#"[[1, 2], {"a": 1}]"#).contains("others without"));
}

#[test]
fn a_log_in_brackets_is_no_json() {
    assert!(begins(b"{\"t\": 1}") && begins(b"\xef\xbb\xbf\n[ {") && begins(b"[[0.1"));
    assert!(!begins(b"[ 12.5] 1 2 3") && !begins(b"[INFO] [17.2]: acc") && !begins(b"{1,2}"));
}
