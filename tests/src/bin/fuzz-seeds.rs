//! Seeds for the fuzzers, from our own simulator: `fuzz-seeds DIR` writes a folder per target.

use std::error::Error;
use std::path::{Path, PathBuf};

use calib::calibrate::{Request, calibrate};
use calib::recording::to_csv;
use calib::simulate::{EXAMPLE, Spec};
use clap::Parser;
use file_formats::make::{self, ImuRow, Packer, Packing, Rows, SheetCell};

/// Writes seeds for the fuzzers, a folder per target.
#[derive(Debug, Parser)]
struct Arguments {
    /// Folder to write to.
    folder: PathBuf,
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Arguments::parse().folder;
    let mut session = Spec::hand_held(1).run()?;
    let text = to_csv(&mut session.recording);
    let short: String = text
        .lines()
        .take(25)
        .map(|line| format!("{line}\n"))
        .collect();
    for (k, dialect) in dialects(&short).into_iter().enumerate() {
        let with_options = [&[(k as u8) << 1][..], dialect.as_bytes()].concat();
        write(&folder, "recording", k, &with_options)?;
    }
    for (k, header) in HEADERS.iter().enumerate() {
        write(&folder, "header", k, header.as_bytes())?;
    }
    for (k, columns) in ["t=1,ax=2,ay=3,az=4", "ax=acc_x,gy=6", "temp=T"]
        .iter()
        .enumerate()
    {
        write(&folder, "columns", k, columns.as_bytes())?;
    }
    for (k, words) in [
        "k * wx^2",
        "-k*exp(-wx/3.5e1)",
        "k * (wx - 2) * abs(sin(wx))",
    ]
    .iter()
    .enumerate()
    {
        write(&folder, "expression", k, words.as_bytes())?;
    }
    write(&folder, "effects", 0, EFFECT.as_bytes())?;
    write(&folder, "spec", 0, EXAMPLE.as_bytes())?;
    write(&folder, "spec", 1, Spec::hand_held(3).to_toml()?.as_bytes())?;
    let outcome = calibrate(&[session.recording], &[], &Request::default())?;
    write(
        &folder,
        "calibration",
        0,
        serde_json::to_string(&outcome.calibration)?.as_bytes(),
    )?;
    let findings = format!(
        "{{\"schema\":\"stillpoint.findings/1\",\"verdict\":\"none\",\"effects\":[],\"calibration\":{}}}",
        serde_json::to_string(&outcome.calibration)?
    );
    write(&folder, "findings", 0, findings.as_bytes())?;
    for (name, k, bytes) in binaries() {
        write(&folder, name, k, &bytes)?;
    }
    write(&folder, "noise", 0, NOISE.as_bytes())?;
    for (k, table) in [
        "t0,t1\n1,20\n30,40\n",
        "recording,start,stop\nr,2,50\n",
        "ax,ay,az\n0,0,9.8\n",
    ]
    .iter()
    .enumerate()
    {
        write(&folder, "tables", k, table.as_bytes())?;
    }
    Ok(())
}

/// Small files of the binary formats, with the name of their target.
fn binaries() -> Vec<(&'static str, usize, Vec<u8>)> {
    let imu: Vec<ImuRow> = (0..4)
        .map(|k| (k * 10_000_000, [0.1, k as f64, 9.8], [0.01, 0.02, k as f64]))
        .collect();
    let sensor: Rows = imu.iter().map(|(t, force, _)| (*t, *force)).collect();
    let topics: [(&str, &[ImuRow], [f64; 2]); 1] = [("/imu", &imu, [0.0; 2])];
    let entry = |(t, v): &(i64, [f64; 3])| {
        format!(
            "{{\"sensor\":\"TotalAcceleration\",\"time\":\"{t}\",\"z\":\"{}\",\"y\":\"{}\",\"x\":\"{}\"}}",
            v[2], v[1], v[0]
        )
    };
    let entries: Vec<String> = sensor.iter().map(entry).collect();
    let json = format!("[{}]", entries.join(","));
    let text = b"t,ax,ay,az\n0,0,0,9.8\n".as_slice();
    let cell = |row: usize, column: usize| row as f64 + 0.25 * column as f64;
    let columns: Vec<(&str, Vec<f64>)> = ["t", "ax", "ay", "az"]
        .into_iter()
        .enumerate()
        .map(|(at, name)| (name, (0..12).map(|row| cell(row, at)).collect()))
        .collect();
    let sets: Vec<_> = columns
        .iter()
        .map(|(name, values)| (*name, &[12_u64][..], values.clone()))
        .collect();
    let matrices: [(&str, &[u64], Vec<f64>); 2] = [
        ("acc", &[3, 12], vec![0.5; 36]),
        ("t", &[1, 12], columns[0].1.clone()),
    ];
    let matlab = [
        b"MATLAB 7.3 MAT-file".as_slice(),
        &[0; 512 - 19],
        &make::hdf5(&matrices),
    ];
    let sheet: Vec<Vec<SheetCell>> = (0..4)
        .map(|row| (0..4).map(|at| SheetCell::Number(cell(row, at))).collect())
        .collect();
    let named: Vec<_> = columns
        .iter()
        .map(|(name, values)| ((*name).to_owned(), values.clone()))
        .collect();
    // In a build with the feature `tables`.
    let parquet = file_formats::write_parquet(&named).ok();
    let parquet = parquet.map(|file| ("parquet", 0, file));
    let others = vec![
        ("hdf5", 0, make::hdf5(&sets)),
        ("hdf5", 1, matlab.concat()),
        ("xlsx", 0, make::workbook(&[("Raw", false, sheet)])),
        ("xlsx", 1, WORKBOOK.replace('\n', "\0").into_bytes()),
        ("mat", 0, make::mat(&[("acc", &sensor), ("gyro", &sensor)])),
        (
            "ulog",
            0,
            make::ulog(
                &[("sensor_accel", 0, &sensor), ("sensor_gyro", 0, &sensor)],
                &[("CAL_ACC0_XOFF", 0.1)],
            ),
        ),
        (
            "ardupilot",
            0,
            make::ardupilot(&imu, &[("INS_ACCOFFS_X", 0.1)]),
        ),
        ("mcap", 0, make::mcap(&topics, Packer::None)),
        ("mcap", 1, make::mcap(&topics, Packer::Lz4)),
        ("mcap", 2, make::mcap(&topics, Packer::Zstd)),
        ("bag", 0, make::bag(&topics, Packer::None)),
        ("bag", 1, make::bag(&topics, Packer::Lz4)),
        ("bag", 2, make::bag(&topics, Packer::Bz2)),
        ("db3", 0, make::db3("/imu", &imu)),
        ("sensor_logger_json", 0, json.into_bytes()),
        (
            "zip",
            0,
            make::zip(&[
                ("a.csv", text, Packing::Stored),
                ("b/c.csv", text, Packing::Deflated),
            ]),
        ),
    ];
    parquet.into_iter().chain(others).collect()
}

/// The same recording as programs write it.
fn dialects(text: &str) -> Vec<String> {
    let (_, rows) = text.split_once('\n').unwrap_or_default();
    let quoted = |line: &str| format!("\"{}\"\n", line.replace(',', "\",\""));
    vec![
        text.to_owned(),
        text.replace(',', ";"),
        text.replace(',', ";").replace('.', ","),
        text.replace(',', "\t").replace('\n', "\r\n"),
        rows.to_owned(),
        text.lines().map(quoted).collect(),
        format!("# device: phone\n% rate 100\n{text}"),
        rows.lines()
            .map(|line| format!("2026-11-22T03:04:05.{line}\n"))
            .collect(),
    ]
}

const HEADERS: [&str; 6] = [
    "time (s),acc_x (m/s^2),acc_y (m/s^2),acc_z (m/s^2),gyro_x (rad/s),gyro_y (rad/s),gyro_z (rad/s)",
    "\"Time (s)\",\"Acceleration x (m/s^2)\",\"Acceleration y (m/s^2)\",\"Acceleration z (m/s^2)\",gx,gy,gz",
    "#timestamp [ns],a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2],w_RS_S_x [rad s^-1],w_y,w_z",
    "t,ax,ay,az,gx,gy,gz\ns,g,g,g,deg/s,deg/s,deg/s",
    "loggingTime(txt),accelerometerAccelerationX(G),ay,az,gyroRotationX(rad/s),gy,gz",
    "# logged by hand\n# 2026\nms,AccX,AccY,AccZ,GyroX,GyroY,GyroZ",
];

const EFFECT: &str = r#"[[definitions]]
name = "gyro_swirl"
sensor = "gyroscope"
x = "k * wy * wz + c * exp(-t/tau)"
z = "k * abs(fx) * alphax"
parameters = [
    { name = "k", unit = "1/(rad/s)", typical = 1e-2 },
    { name = "c", unit = "rad/s", typical = 1e-3 },
    { name = "tau", unit = "s", nominal = 60.0, typical = 60.0 },
]
"#;

const NOISE: &str = r#"{"schema":"stillpoint.noise/1","created_by":"","accelerometer":{"samples":9,"step":0.01,"gaps":0,
"axes":[{"terms":[{"term":"random_walk","name":"","unit":"","value":1e-4,"lower":1e-5,"upper":1e-3}],"model_error":null,"curve":[]},
{"terms":[],"model_error":null,"curve":[]},{"terms":[],"model_error":1.5,"curve":[]}]},"gyroscope":null,
"initial_static_time":null,"warnings":[]}"#;

/// Shared words, styles, relations, sheets and a sheet, one a line.
const WORKBOOK: &str = r#"<sst uniqueCount="4"><si><t>t</t></si><si><r><t>a</t></r><r><t>x</t></r></si><si><t>ay</t></si><si><t>az</t></si></sst>
<styleSheet><numFmts><numFmt numFmtId="164" formatCode="0.00"/></numFmts><fonts><font><b/><sz val="9"/></font></fonts><cellXfs><xf numFmtId="0"/><xf numFmtId="22"/><xf numFmtId="164"/></cellXfs></styleSheet>
<Relationships><Relationship Id="rId1" Type="http://schemas.openxmlformats.org/officeDocument/2006/relationships/worksheet" Target="worksheets/sheet1.xml"/></Relationships>
<workbook xmlns:r="http://schemas.openxmlformats.org/officeDocument/2006/relationships"><workbookPr date1904="0"/><sheets><sheet name="Raw" sheetId="1" r:id="rId1"/></sheets></workbook>
<worksheet><dimension ref="A1:D3"/><sheetData><row r="1"><c r="A1" t="s"><v>0</v></c><c r="B1" t="s"><v>1</v></c><c t="s"><v>2</v></c><c t="inlineStr"><is><t>az</t></is></c></row><row><c><v>0.5</v></c><c s="2"><v>-1e3</v></c><c t="b"><v>1</v></c><c t="e"><v>#N/A</v></c></row><row r="3"><c r="A3" t="str"><f t="shared" si="0" ref="A3:A4">A2+1</f><v>7</v></c><c t="d"><v>2026-01-02T03:04:05</v></c><c s="1"><v>45000.5</v></c></row></sheetData></worksheet>"#;

fn write(folder: &Path, target: &str, k: usize, bytes: &[u8]) -> std::io::Result<()> {
    let folder = folder.join(target);
    std::fs::create_dir_all(&folder)?;
    std::fs::write(folder.join(format!("seed-{k}")), bytes)
}
