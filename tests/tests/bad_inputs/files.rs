//! Cases 26 to 35: what a path can lead to.

use std::io::Write as _;

use super::bench::Bench;
use super::device::{csv, good, table};

#[test]
fn case_026_compressed_text_is_opened_and_other_kinds_are_named() {
    let mut gz = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    gz.write_all(csv(good()).as_bytes()).unwrap();
    let bench = Bench::with("r.csv.gz", gz.finish().unwrap());
    bench.run(&["calibrate", "r.csv.gz"]).ends(0);
    bench.write("r.xz", b"\xfd7zXZ\0\0\x04rest");
    bench
        .run(&["calibrate", "r.xz"])
        .ends(3)
        .says(&["r.xz", "xz"]);
}

#[test]
fn case_027_content_decides_and_a_wrong_extension_is_mentioned() {
    let bench = Bench::with("r.mat", csv(good()));
    bench.run(&["calibrate", "r.mat"]).ends(0).says(&["r.mat"]);
}

#[test]
fn case_028_a_folder_is_read_or_says_what_is_missing() {
    let bench = Bench::new();
    let part = |columns: [usize; 4]| -> Vec<String> {
        let pick = |row: &[f64; 7]| columns.map(|k| format!("{:.6}", row[k])).join(",");
        good().iter().map(pick).collect()
    };
    bench.write("session/acc.csv", table("t,ax,ay,az", &part([0, 1, 2, 3])));
    bench.write("session/gyro.csv", table("t,gx,gy,gz", &part([0, 4, 5, 6])));
    bench.run(&["calibrate", "session"]).ends(0);
    bench.write("empty/notes.txt", "nothing");
    bench
        .run(&["calibrate", "empty"])
        .ends(3)
        .says(&["empty", "acc.csv"]);
}

#[test]
fn case_029_a_missing_file_names_where_was_looked_and_its_neighbour() {
    let bench = Bench::with("session.csv", csv(good()));
    let run = bench.run(&["calibrate", "sesion.csv"]);
    run.ends(3).says(&["sesion.csv", "session.csv"]);
}

#[test]
fn case_030_limits_on_rows_and_bytes_hold_for_endless_inputs() {
    let bench = Bench::with("r.csv", csv(good()));
    let run = bench.run(&["calibrate", "r.csv", "--max-rows", "1000"]);
    run.ends(3).says(&["r.csv", "1000", "--max-rows"]);
    let run = bench.run(&["calibrate", "r.csv", "--max-bytes", "1000"]);
    run.ends(3).says(&["r.csv", "--max-bytes"]);
    #[cfg(unix)]
    {
        let run = bench.run(&["calibrate", "/dev/zero", "--max-bytes", "1000000"]);
        run.ends(3).says(&["/dev/zero"]);
    }
}

#[cfg(unix)]
#[test]
fn case_030_a_pipe_is_read_to_its_end() {
    let bench = Bench::with("r.csv", csv(good()));
    let made = std::process::Command::new("mkfifo")
        .arg(bench.path("pipe"))
        .status();
    assert!(made.unwrap().success());
    let (from, to) = (bench.path("r.csv"), bench.path("pipe"));
    let writer = std::thread::spawn(move || {
        let content = std::fs::read(from).unwrap();
        let mut pipe = std::fs::OpenOptions::new().write(true).open(to).unwrap();
        pipe.write_all(&content).unwrap();
    });
    let run = bench.run(&["calibrate", "pipe", "-o", "pipe.json", "--report", "p.html"]);
    run.ends(0).changes(&["p.html", "pipe.json"]);
    writer.join().unwrap();
    bench
        .run(&["calibrate", "r.csv", "-o", "file.json"])
        .ends(0);
    let numbers = |name: &str| -> serde_json::Value {
        let text = std::fs::read_to_string(bench.path(name)).unwrap();
        serde_json::from_str::<serde_json::Value>(&text).unwrap()["covariance"].clone()
    };
    assert_eq!(numbers("pipe.json"), numbers("file.json"));
}

#[test]
fn case_031_a_file_beyond_the_limit_is_refused_before_it_is_held() {
    let bench = Bench::with("r.csv", csv(good()));
    let run = bench.run(&["calibrate", "r.csv", "--max-bytes", "500000"]);
    run.ends(3).says(&["--max-bytes"]).changes(&[]);
}

#[cfg(unix)]
#[test]
fn case_032_links_in_a_circle_and_to_nowhere_are_named() {
    let bench = Bench::new();
    std::os::unix::fs::symlink("b", bench.path("a")).unwrap();
    std::os::unix::fs::symlink("a", bench.path("b")).unwrap();
    std::os::unix::fs::symlink("nowhere.csv", bench.path("broken")).unwrap();
    bench.run(&["calibrate", "a"]).ends(3).says(&["a: "]);
    bench
        .run(&["calibrate", "broken"])
        .ends(3)
        .says(&["broken"]);
}

#[cfg(unix)]
#[test]
fn case_033_odd_names_work_and_are_shown_escaped() {
    use std::os::unix::ffi::OsStrExt;
    let bench = Bench::new();
    for name in ["with space.csv", "new\nline.csv", "-rf"] {
        bench.write(name, csv(good()));
        bench.run(&["calibrate", "--", name]).ends(0);
    }
    let odd = std::ffi::OsStr::from_bytes(b"\xff\xfe.csv");
    std::fs::write(bench.path("").join(odd), csv(good())).unwrap();
    let mut command = bench.command(&["calibrate"]);
    command.arg(odd);
    bench.watch(command).ends(0);
    let long = "x".repeat(4096);
    bench
        .run(&["calibrate", &long])
        .ends(3)
        .says(&["File name too long"]);
}

#[cfg(target_os = "linux")]
#[test]
fn case_034_a_file_that_changes_while_it_is_read_is_refused() {
    // A pipe gives the reader time; the file it is appended to is the case. The file grows while the program
    // holds it open, so its size differs at the end.
    use std::sync::atomic::{AtomicBool, Ordering};
    let mut rows = Vec::new();
    for copy in 0..40 {
        let shift = 200.0 * f64::from(copy);
        rows.extend(good().iter().map(|row| {
            let mut row = *row;
            row[0] += shift;
            row
        }));
    }
    let bench = Bench::with("r.csv", csv(&rows));
    let stop = AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            let options = std::fs::OpenOptions::new().append(true).clone();
            let mut file = options.open(bench.path("r.csv")).unwrap();
            let mut t = 1e5;
            while !stop.load(Ordering::Relaxed) {
                writeln!(file, "{t:.2},0,0,9.8,0,0,0").unwrap();
                t += 0.01;
                std::thread::sleep(std::time::Duration::from_millis(1));
            }
        });
        let run = bench.command(&["segment", "r.csv"]).output().unwrap();
        stop.store(true, Ordering::Relaxed);
        let words = String::from_utf8_lossy(&run.stderr);
        assert_eq!(run.status.code(), Some(3), "{words}");
        assert!(words.contains("changed while"), "{words}");
    });
}

#[test]
fn case_035_a_pointer_is_not_the_data() {
    let pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:abc\nsize 12345\n";
    let bench = Bench::with("r.csv", pointer);
    bench
        .run(&["calibrate", "r.csv"])
        .ends(3)
        .says(&["git lfs pull"]);
}
