//! A good recording of a simulated device as a table that the cases spoil.

use std::fmt::Write as _;
use std::sync::OnceLock;

use calib::simulate::{HandHeld, Motion, Spec};

/// The plain header.
pub const HEADER: &str = "t,ax,ay,az,gx,gy,gz";

/// One row: `t, ax, ay, az, gx, gy, gz` in s, m/s² and rad/s.
pub type Row = [f64; 7];

/// A recording by hand, 100 Hz: 20 placements of 5 s, turns of 2 to 3 s.
pub fn good() -> &'static [Row] {
    static ROWS: OnceLock<Vec<Row>> = OnceLock::new();
    ROWS.get_or_init(|| rows(&spec(1)))
}

/// What [`good`] simulates, with another seed.
pub fn spec(seed: u64) -> Spec {
    let mut spec = Spec::hand_held(seed);
    spec.motion = Motion::HandHeld(HandHeld {
        placements: Some(20),
        initial_rest: Some(20.0),
        rest: [5.0, 5.5],
        turn: [2.0, 3.0],
        ..HandHeld::default()
    });
    spec
}

/// The samples of a simulation whose sensors share a clock.
pub fn rows(spec: &Spec) -> Vec<Row> {
    let recording = spec.run().unwrap().recording;
    let accel = recording.accelerometer.unwrap();
    let gyro = recording.gyroscope.unwrap();
    let both = accel.t.iter().zip(&accel.values).zip(&gyro.values);
    both.map(|((t, a), g)| [*t, a.x, a.y, a.z, g.x, g.y, g.z])
        .collect()
}

/// The first `seconds` of [`good`], which rest.
pub fn at_rest(seconds: f64) -> Vec<Row> {
    let rows = good().iter().filter(|row| row[0] < seconds.min(19.0));
    rows.copied().collect()
}

/// One line of numbers.
pub fn line(row: &Row) -> String {
    let mut text = format!("{:.4}", row[0]);
    for v in &row[1..] {
        write!(text, ",{v:.6}").unwrap();
    }
    text
}

/// Lines without their ends.
pub fn lines(rows: &[Row]) -> Vec<String> {
    rows.iter().map(line).collect()
}

/// The plain header and these rows.
pub fn csv(rows: &[Row]) -> String {
    table(HEADER, &lines(rows))
}

/// A header and lines.
pub fn table(header: &str, lines: &[String]) -> String {
    format!("{header}\n{}\n", lines.join("\n"))
}

/// [`good`], every row changed.
pub fn spoilt(mut change: impl FnMut(usize, &mut Row)) -> Vec<Row> {
    let mut rows = good().to_vec();
    for (k, row) in rows.iter_mut().enumerate() {
        change(k, row);
    }
    rows
}
