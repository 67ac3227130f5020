//! A phone with phyphox open: samples into buffers, pauses, answers.

use std::path::{Path, PathBuf};
use std::time::Instant;

use file_formats::make::{Packing, zip};
use live::Instruction;
use nalgebra::{Matrix3, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::person::Person;

/// Time between two requests for samples, s.
const POLL: f64 = 0.25;
/// Local gravity, m/s².
pub(super) const GRAVITY: f64 = 9.80665;
/// Steps of the sensors, s.
const STEPS: [f64; 2] = [1.0 / 99.7, 1.0 / 101.3];
/// White noise of a reading, m/s² and rad/s.
const NOISE: [f64; 2] = [0.012, 0.0025];
const FIRST_MOMENT: f64 = 1.79e9;

/// A sensor: `raw = T⁻¹ truth + b + noise`.
#[derive(Clone, Debug)]
pub struct Errors {
    /// Scale factors and misalignments.
    pub t: Matrix3<f64>,
    /// Bias.
    pub bias: Vector3<f64>,
}

/// Time and three values.
type Sample = (f64, Vector3<f64>);

/// The phone, and who holds it.
#[derive(Clone, Debug)]
pub struct Phone {
    /// Who holds it.
    pub person: Person,
    /// Accelerometer and gyroscope; the first upper triangular.
    pub errors: [Errors; 2],
    rng: ChaCha8Rng,
    /// Time in the room, s.
    now: f64,
    next: [f64; 2],
    buffers: [Vec<Sample>; 2],
    /// Experiment time less time in the room, while it measures.
    offset: Option<f64>,
    /// `START` and `PAUSE` by experiment time and system time.
    mappings: Vec<(&'static str, f64, f64)>,
    /// When the phone pauses by itself, s.
    pauses: Vec<f64>,
    /// When no connection comes about, s.
    drops: Vec<[f64; 2]>,
    /// The gyroscope's range, rad/s.
    range: f64,
    /// Lines of instructions that the person reads, and how many bytes of them were read.
    read: Option<(PathBuf, usize)>,
    /// Samples of both sensors that were sent.
    pub sent: [usize; 2],
    /// Of these, samples in answers before the last: who asks again has taken them.
    pub taken: [usize; 2],
    /// The exported file is of another session.
    exports_another: bool,
    /// The last request, where waiting takes real time.
    asked: Option<Instant>,
}

impl Phone {
    /// A phone of its own errors with somebody.
    pub fn new(person: Person, seed: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed ^ 0x70_68_6f_6e_65);
        let mut near = |size: f64| -> f64 { size * rng.random_range(-1.0..1.0) };
        let mut errors = |scale: f64, lean: f64, bias: f64| {
            let t = Matrix3::from_fn(|i, j| {
                if i == j {
                    1.0 + near(scale)
                } else {
                    near(lean)
                }
            });
            Errors {
                t,
                bias: Vector3::from_fn(|_, _| near(bias)),
            }
        };
        let mut errors = [errors(0.01, 0.005, 0.3), errors(0.02, 0.01, 0.01)];
        errors[0].t.fill_lower_triangle(0.0, 1);
        Self {
            person,
            errors,
            rng,
            now: 0.0,
            next: [0.0, 0.002],
            buffers: [Vec::new(), Vec::new()],
            offset: None,
            mappings: Vec::new(),
            pauses: Vec::new(),
            drops: Vec::new(),
            range: 8.727,
            read: None,
            sent: [0; 2],
            taken: [0; 2],
            exports_another: false,
            asked: None,
        }
    }

    /// Exports another session than the one it answered with: other readings at the same times.
    pub fn exporting_another(mut self) -> Self {
        self.exports_another = true;
        self
    }

    /// Pauses by itself at these times, s.
    pub fn pausing(mut self, times: Vec<f64>) -> Self {
        self.pauses = times;
        self
    }

    /// Is out of reach in these stretches of time, s.
    pub fn dropping(mut self, stretches: Vec<[f64; 2]>) -> Self {
        self.drops = stretches;
        self
    }

    /// The person reads instructions from a file that `stillpoint live --events` writes. Out of reach, time passes at
    /// least as fast as in the room of that process, which sleeps between attempts.
    pub fn with_events(mut self, events: &Path) -> Self {
        self.read = Some((events.to_owned(), 0));
        self.asked = Some(Instant::now());
        self
    }

    fn read_instructions(&mut self) {
        let Some((path, read)) = &mut self.read else {
            return;
        };
        let text = std::fs::read_to_string(path).unwrap_or_default();
        let new = text.get(*read..).unwrap_or("");
        *read += new.len();
        let told = new.lines().filter_map(|line| {
            let document: serde_json::Value = serde_json::from_str(line).ok()?;
            serde_json::from_value::<Instruction>(document.get("instruction")?.clone()).ok()
        });
        for instruction in told.collect::<Vec<_>>() {
            self.tell(instruction);
        }
    }

    /// Tells the person.
    pub fn tell(&mut self, instruction: Instruction) {
        self.person.hear(instruction, self.now);
    }

    /// Time in the room, s.
    pub fn seconds(&self) -> f64 {
        self.now
    }

    /// The answer to a request; `None` where the connection breaks.
    pub(super) fn answer(&mut self, path: &str) -> Option<Vec<u8>> {
        let (path, query) = path.split_once('?').unwrap_or((path, ""));
        let is_out = |phone: &Self| {
            phone
                .drops
                .iter()
                .any(|[from, to]| (*from..*to).contains(&phone.now))
        };
        let waited = self.asked.as_mut().map_or(0.0, |asked| {
            std::mem::replace(asked, Instant::now())
                .elapsed()
                .as_secs_f64()
        });
        if is_out(self) {
            self.advance(waited.max(POLL));
        } else if path == "/get" {
            self.advance(POLL);
        }
        if is_out(self) {
            return None;
        }
        Some(match path {
            "/config" => CONFIG.into(),
            "/get" => {
                self.taken = self.sent;
                self.sent = [0, 1].map(|k| self.buffers[k].len());
                self.get(query).into_bytes()
            }
            "/control" => self.control(query),
            "/time" => self.times().into_bytes(),
            "/export" => self.export(),
            _ => br#"{"error": "Not found."}"#.to_vec(),
        })
    }

    /// Nobody asks for so long, s.
    pub fn wait(&mut self, seconds: f64) {
        self.advance(seconds);
    }

    fn advance(&mut self, seconds: f64) {
        self.read_instructions();
        let until = self.now + seconds;
        loop {
            let k = usize::from(self.next[1] < self.next[0]);
            let t = self.next[k];
            if t > until {
                break;
            }
            self.next[k] += STEPS[k] * (1.0 + 0.01 * self.normal());
            self.pause_or_play(t);
            let [rate, force] = self.person.motion(t);
            let truth = [force * GRAVITY, rate][k];
            let reading = self.reading(k, &truth);
            if let Some(offset) = self.offset {
                self.buffers[k].push((t + offset, reading));
            }
        }
        self.now = until;
    }

    fn pause_or_play(&mut self, t: f64) {
        if let Some(at) = self.pauses.iter().position(|pause| t >= *pause) {
            self.pauses.remove(at);
            self.stop(t);
        }
        if self.person.presses_play(t) {
            self.start(t);
        }
    }

    fn start(&mut self, t: f64) {
        if self.offset.is_none() {
            let experiment = self.mappings.last().map_or(0.0, |m| m.1);
            self.offset = Some(experiment - t);
            self.mappings.push(("START", experiment, FIRST_MOMENT + t));
        }
    }

    fn stop(&mut self, t: f64) {
        if let Some(offset) = self.offset.take() {
            self.mappings.push(("PAUSE", t + offset, FIRST_MOMENT + t));
        }
    }

    fn reading(&mut self, k: usize, truth: &Vector3<f64>) -> Vector3<f64> {
        let noise = Vector3::from_fn(|_, _| NOISE[k] * self.normal());
        let errors = &self.errors[k];
        let inverse = errors.t.try_inverse().unwrap_or_else(Matrix3::identity);
        let reading = inverse * truth + errors.bias + noise;
        if k == 1 {
            reading.map(|w| w.clamp(-self.range, self.range))
        } else {
            reading
        }
    }

    fn normal(&mut self) -> f64 {
        StandardNormal.sample(&mut self.rng)
    }

    fn get(&self, query: &str) -> String {
        let parts: Vec<String> = query
            .split('&')
            .filter_map(|part| self.buffer(part))
            .collect();
        let measuring = self.offset.is_some();
        let status = format!(
            "{{\n\"session\":\"a1b2c3\", \"measuring\":{measuring}, \"timedRun\":false, \"countDown\":0\n}}"
        );
        format!(
            "{{\"buffer\":{{\n{}\n}},\n\"status\":{status}\n}}\n",
            parts.join(",\n")
        )
    }

    /// One buffer of a reply, by `name=full` or `name=threshold%7Creference`.
    fn buffer(&self, part: &str) -> Option<String> {
        let (name, wanted) = part.split_once('=')?;
        let sensor = usize::from(name.starts_with("gyr"));
        let wanted = wanted.replace("%7C", "|");
        let threshold = match wanted.split_once('|') {
            Some((threshold, reference)) => {
                assert_eq!(
                    reference,
                    ["acc_time", "gyr_time"][sensor],
                    "the reference of {name}"
                );
                let t: f64 = threshold.parse().ok()?;
                t + 10f64.powf((t.abs() / 1e7).log10().floor())
            }
            None => f64::NEG_INFINITY,
        };
        let mode = if threshold.is_finite() {
            "partial"
        } else {
            "full"
        };
        let samples = self.buffers[sensor].iter().filter(|(t, _)| *t > threshold);
        let value = |(t, v): &Sample| match name.as_bytes().last() {
            Some(b'X') => v.x,
            Some(b'Y') => v.y,
            Some(b'Z') => v.z,
            _ => *t,
        };
        let values: Vec<String> = samples
            .map(|sample| format!("{:.7E}", value(sample)))
            .collect();
        Some(format!(
            "\"{name}\":{{\"size\":0,\"updateMode\":\"{mode}\", \"buffer\":[{}]}}",
            values.join(",")
        ))
    }

    fn control(&mut self, query: &str) -> Vec<u8> {
        let t = self.now;
        match query {
            "cmd=start" => self.start(t),
            "cmd=stop" => self.stop(t),
            _ => return br#"{"result": false}"#.to_vec(),
        }
        br#"{"result": true}"#.to_vec()
    }

    fn times(&self) -> String {
        let mapping = |(event, experiment, system): &(&str, f64, f64)| {
            format!(
                "{{\"event\":\"{event}\",\"experimentTime\":{experiment},\"systemTime\":{system}}}"
            )
        };
        let all: Vec<String> = self.mappings.iter().map(mapping).collect();
        format!("[{}]", all.join(","))
    }

    fn export(&self) -> Vec<u8> {
        let table = |sensor: usize, header: &str| {
            let shift = if self.exports_another { 0.01 } else { 0.0 };
            let row = |(t, v): &Sample| {
                let v = v.add_scalar(shift);
                format!("{t:.9E},{:.9E},{:.9E},{:.9E}\n", v.x, v.y, v.z)
            };
            let rows: String = self.buffers[sensor].iter().map(row).collect();
            format!("{header}\n{rows}")
        };
        let accelerometer = table(
            0,
            r#""Time (s)","Acceleration x (m/s^2)","Acceleration y (m/s^2)","Acceleration z (m/s^2)""#,
        );
        let gyroscope = table(
            1,
            r#""Time (s)","Gyroscope x (rad/s)","Gyroscope y (rad/s)","Gyroscope z (rad/s)""#,
        );
        let mapping = |(event, experiment, system): &(&str, f64, f64)| {
            format!("\"{event}\",{experiment:.9E},{system:.9E},\"\"\n")
        };
        let times: String = self.mappings.iter().map(mapping).collect();
        let times =
            format!("\"event\",\"experiment time\",\"system time\",\"system time text\"\n{times}");
        zip(&[
            (
                "Accelerometer.csv",
                accelerometer.as_bytes(),
                Packing::Deflated,
            ),
            ("Gyroscope.csv", gyroscope.as_bytes(), Packing::Deflated),
            (
                "meta/device.csv",
                b"property,value\nversion,1.1.16\n",
                Packing::Stored,
            ),
            ("meta/time.csv", times.as_bytes(), Packing::Stored),
        ])
    }
}

const CONFIG: &str = r#"{"crc32":"0","title":"Raw","localTitle":"Simulated","category":"","localCategory":"",
"buffers":[{"name":"accX","size":0}],
"inputs":[{"source":"accelerometer","outputs":[{"x":"accX"},{"y":"accY"},{"z":"accZ"},{"t":"acc_time"}]},
{"source":"gyroscope","outputs":[{"x":"gyrX"},{"y":"gyrY"},{"z":"gyrZ"},{"t":"gyr_time"}]}],
"export":[{"set":"Accelerometer","sources":[]},{"set":"Gyroscope","sources":[]}]}"#;
