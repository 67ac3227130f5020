//! phyphox's remote access over HTTP.
//!
//! | request | answer |
//! |---|---|
//! | `/config` | the experiment: inputs with the buffer of `x`, `y`, `z`, `t`; sets of the export |
//! | `/get?B=T%7CTIME` | values of buffer `B` where buffer `TIME` exceeds `T`, eight digits; `B=full` for all |
//! | `/control?cmd=start`, `stop`, `clear` | `{"result": true}` |
//! | `/time` | `START` and `PAUSE` in experiment time and system time |
//! | `/export?format=1&set0=On` | a zip archive of CSV tables, full precision |
//!
//! Source: phyphox wiki, "Remote-interface communication"; `RemoteServer.java` of phyphox-android. The server moves the
//! threshold on by one unit of its eighth digit, so that the last stamp received is the next threshold and no sample comes
//! twice. After `clear` it answers one request in full, asked for or not. Experiment time stands still in a pause.

mod client;
mod config;
mod pauses;
mod reply;
mod sightings;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use calib::Recording;
use calib::recording::{ReadOptions, Stream};
use findings::{Finding, Front, Kind};

use crate::batch::{Batch, Event};
use crate::sources::error::{Error, Limit};
use crate::sources::recorder::Recorder;
use crate::sources::{Finished, Opening, Source};
use client::Client;
use config::{Buffers, Experiment};
use output::{Existing, Output};
use pauses::Pauses;
use reply::Reply;
use sightings::Sightings;

/// First wait after a request without an answer; doubled up to sixteen times that.
const FIRST_WAIT: Duration = Duration::from_millis(250);
const DOUBLINGS: u32 = 4;
/// Polls in a row without a sample, though it measures, after which all is asked for: its clock may have begun anew
/// unseen.
const BARREN: u32 = 40;
/// A clock that is behind by more than this has begun anew, s.
const BEGUN_ANEW: f64 = 0.5;
/// Times that the export is asked for again.
const EXPORTS: u32 = 4;
/// A measurement that begins anew more often is none.
const RESTARTS: usize = 50;
/// Most samples of a sensor, over an hour at 500 Hz: all of them are in memory.
const MOST: usize = 2_000_000;
/// The share of the samples seen that the exported file must hold.
const SAME: f64 = 0.9;
/// Folder of the samples as they came.
const RECEIVED: &str = "received";
/// The exported file.
const EXPORT: &str = "phyphox.zip";
/// CSV with comma and point, by phyphox's count of its formats.
const FORMAT: usize = 1;

/// A phone on which phyphox measures.
#[derive(Debug)]
pub struct Phyphox {
    client: Client,
    experiment: Experiment,
    sensors: [Buffers; 2],
    recorder: Recorder,
    /// Path of the exported file.
    export: PathBuf,
    /// Last stamps of both sensors by the phone's clock, s.
    last: [Option<f64>; 2],
    /// The same with pauses counted.
    last_counted: [Option<f64>; 2],
    sightings: [Sightings; 2],
    restarts: usize,
    /// Samples of both sensors so far.
    taken: [usize; 2],
    pauses: Pauses,
    session: Option<String>,
    measuring: bool,
    /// Measuring was begun here, so that it is ended here.
    started: bool,
    failures: u32,
    /// When the first of them was, by the caller's clock.
    silent_since: Duration,
    patience: Duration,
    barren: u32,
    greeted: bool,
}

impl Phyphox {
    /// Asks what is open on the phone, and begins to measure if it does not.
    ///
    /// # Errors
    /// No answer, another server, an experiment without one of the sensors, a folder that cannot be written.
    pub fn connect(address: &str, how: &Opening) -> Result<Self, Error> {
        let client = Client::new(address, how.waits);
        let text = client.get("/config").map_err(|cause| Error::Lost {
            address: address.to_owned(),
            seconds: 0.0,
            cause: cause.text(Front::Plain),
        })?;
        let experiment = Experiment::parse(&text).ok_or_else(|| not_phyphox(address, &text))?;
        let sensors = [
            sensor(address, &experiment, "accelerometer")?,
            sensor(address, &experiment, "gyroscope")?,
        ];
        Ok(Self {
            recorder: Recorder::begin(&how.folder.join(RECEIVED))?,
            export: how.folder.join(EXPORT),
            client,
            experiment,
            sensors,
            last: [None; 2],
            last_counted: [None; 2],
            sightings: [Sightings::default(), Sightings::default()],
            restarts: 0,
            taken: [0; 2],
            pauses: Pauses::default(),
            session: None,
            measuring: false,
            started: false,
            failures: 0,
            silent_since: Duration::ZERO,
            patience: how.patience,
            barren: 0,
            greeted: false,
        })
    }

    /// The next request.
    fn path(&self) -> String {
        let all = self.barren >= BARREN;
        let queries = self.sensors.iter().zip(self.last);
        let queries: Vec<String> = queries
            .map(|(s, last)| reply::query(s, last.filter(|_| !all)))
            .collect();
        format!("/get?{}", queries.join("&"))
    }

    fn no_answer(&mut self, now: Duration, cause: String) -> Result<Batch, Error> {
        if self.failures == 0 {
            self.silent_since = now;
        }
        self.failures += 1;
        let attempts = self.failures;
        let silence = now.saturating_sub(self.silent_since);
        if silence >= self.patience {
            return Err(Error::Lost {
                address: self.client.address.clone(),
                seconds: silence.as_secs_f64(),
                cause,
            });
        }
        Ok(Batch {
            events: vec![Event::Reconnecting { attempts, cause }],
            pause: Some(FIRST_WAIT * 2u32.pow((attempts - 1).min(DOUBLINGS))),
            ..Batch::default()
        })
    }

    fn take(&mut self, reply: &Reply, fresh: [Stream; 2]) -> Result<Batch, Error> {
        let mut batch = Batch::default();
        let events = &mut batch.events;
        if std::mem::take(&mut self.failures) > 0 {
            events.push(Event::Reconnected);
        }
        if self.session.is_none() {
            self.ask_for_pauses();
        }
        if self.has_begun_anew(reply, &fresh) {
            self.restarts += 1;
            if self.restarts > RESTARTS {
                return Err(Error::Restless {
                    address: self.client.address.clone(),
                    times: self.restarts,
                });
            }
            events.push(Event::Restarted);
            self.recorder.restart()?;
            self.last = [None; 2];
            self.last_counted = [None; 2];
            self.sightings = [Sightings::default(), Sightings::default()];
            self.ask_for_pauses();
        }
        self.session = Some(reply.status.session.clone());
        self.note_measuring(reply.status.measuring, events);
        let [accelerometer, gyroscope] = fresh;
        batch.accelerometer = self.newer(0, accelerometer);
        batch.gyroscope = self.newer(1, gyroscope);
        self.taken[0] += batch.accelerometer.len();
        self.taken[1] += batch.gyroscope.len();
        if self.taken.iter().any(|count| *count > MOST) {
            return Err(Error::TooMuch {
                name: self.client.address.clone(),
                limit: Limit::Samples(MOST),
            });
        }
        let barren = batch.accelerometer.is_empty() && batch.gyroscope.is_empty();
        self.barren = if barren && self.measuring && self.barren < BARREN {
            self.barren + 1
        } else {
            0
        };
        self.recorder
            .append(&batch.accelerometer, &batch.gyroscope)?;
        Ok(batch)
    }

    /// The samples of both sensors in an answer.
    fn understood(&self, text: &[u8]) -> Result<(Reply, [Stream; 2]), Box<Finding>> {
        let reply = Reply::parse(text)?;
        let of = |sensor: usize| reply.samples(&self.sensors[sensor]);
        let fresh = [of(0)?, of(1)?];
        Ok((reply, fresh))
    }

    /// Returns true if the app was restarted or its data were cleared.
    fn has_begun_anew(&self, reply: &Reply, fresh: &[Stream; 2]) -> bool {
        let Some(last) = self.last[0] else {
            return false;
        };
        let other = self
            .session
            .as_ref()
            .is_some_and(|session| *session != reply.status.session);
        let newest = fresh[0].t.last().copied().unwrap_or(0.0);
        other || reply.is_full(&self.sensors[0]) && newest < last - BEGUN_ANEW
    }

    fn note_measuring(&mut self, measuring: bool, events: &mut Vec<Event>) {
        let before = std::mem::replace(&mut self.measuring, measuring);
        let known = self.last[0].is_some();
        match (before, measuring) {
            (false, true) if known => {
                let counted = self.pauses.count();
                self.ask_for_pauses();
                if self.pauses.count() == counted {
                    let at = self.last.iter().flatten().fold(0.0, |a: f64, b| a.max(*b));
                    self.pauses = std::mem::take(&mut self.pauses).and_unknown(at);
                }
                let seconds = self.pauses.last().unwrap_or(0.0);
                events.push(Event::Resumed { seconds });
            }
            (true, false) => events.push(Event::Paused),
            // Not begun yet: a guided session is what was asked for.
            (_, false) if !known && !self.started => {
                self.started = self.client.get("/control?cmd=start").is_ok();
            }
            _ => {}
        }
    }

    fn ask_for_pauses(&mut self) {
        let text = self.client.get("/time").ok();
        if let Some(pauses) = text.and_then(|text| Pauses::parse(&text)) {
            self.pauses = pauses;
        }
    }

    /// Returns the samples later than all before, with pauses included in the time stamps.
    fn newer(&mut self, sensor: usize, fresh: Stream) -> Stream {
        let from = self.last[sensor].map_or(0, |last| fresh.t.partition_point(|t| *t <= last));
        if let Some(t) = fresh.t.last().filter(|_| from < fresh.len()) {
            self.last[sensor] = Some(*t);
        }
        let mut newer = Stream::default();
        for (t, reading) in fresh.t[from..].iter().zip(&fresh.values[from..]) {
            // Pauses may be told otherwise than before.
            let t = self.pauses.counted(*t);
            if self.last_counted[sensor].is_none_or(|last| t > last) {
                self.last_counted[sensor] = Some(t);
                self.sightings[sensor].see(reading);
                newer.t.push(t);
                newer.values.push(*reading);
            }
        }
        newer
    }

    /// The file of full precision, checked to be a recording of both sensors and of this session.
    fn export(&self, until: Instant) -> Result<PathBuf, Box<Finding>> {
        let sets = 0..self.experiment.export_sets.max(1);
        let sets: String = sets.map(|k| format!("&set{k}=On")).collect();
        let bytes = self
            .client
            .export(&format!("/export?format={FORMAT}{sets}"), until)?;
        let path = &self.export;
        let folder = path.parent().unwrap_or(path);
        let output = Output::claim_in(folder, EXPORT, Existing::Replace, &[]);
        let written = output.and_then(|output| output.write(&bytes));
        written.map_err(|error| error.finding())?;
        let recording =
            Recording::read(path, &ReadOptions::default()).map_err(|error| error.finding())?;
        let streams = [recording.accelerometer, recording.gyroscope].map(Option::unwrap_or_default);
        if streams.iter().any(Stream::is_empty) {
            let [accelerometer, gyroscope] = streams.each_ref().map(Stream::len);
            let found = Finding::of(Kind::EXPORT_LACKS_SAMPLES);
            let found = found.count("accelerometer", accelerometer);
            return Err(found.count("gyroscope", gyroscope).into());
        }
        let mut seen = self.sightings.iter().zip(&streams);
        if !seen.all(|(sightings, stream)| sightings.share_in(stream) >= SAME) {
            return Err(Finding::of(Kind::EXPORT_OF_OTHER).into());
        }
        Ok(path.clone())
    }
}

impl Source for Phyphox {
    fn poll(&mut self, now: Duration) -> Result<Batch, Error> {
        let answer = self.client.samples(&self.path());
        let mut batch = match answer.and_then(|text| self.understood(&text)) {
            Ok((reply, fresh)) => self.take(&reply, fresh)?,
            Err(cause) => self.no_answer(now, cause.what())?,
        };
        if !std::mem::replace(&mut self.greeted, true) {
            let name = format!("phyphox, {}", self.experiment.title);
            batch.events.insert(0, Event::Connected { name });
        }
        Ok(batch)
    }

    fn finish(&mut self) -> Result<Finished, Error> {
        if self.started {
            let _ = self.client.get("/control?cmd=stop");
        }
        let until = Instant::now() + self.client.waits.export;
        let mut exported = self.export(until);
        for attempt in 0..EXPORTS {
            let wait = FIRST_WAIT * 2u32.pow(attempt);
            if exported.is_ok() || Instant::now() + wait >= until {
                break;
            }
            std::thread::sleep(wait);
            exported = self.export(until);
        }
        let plain = self.recorder.folder().to_owned();
        Ok(match exported {
            Ok(recording) => Finished {
                recording,
                fallback: None,
            },
            Err(reason) => Finished {
                recording: plain,
                fallback: Some(reason.text(Front::Plain)),
            },
        })
    }
}

fn sensor(address: &str, experiment: &Experiment, source: &'static str) -> Result<Buffers, Error> {
    experiment
        .sensor(source)
        .cloned()
        .ok_or_else(|| Error::NoSensor {
            address: address.to_owned(),
            experiment: experiment.title.clone(),
            sensor: source,
            found: experiment.found(),
        })
}

fn not_phyphox(address: &str, text: &[u8]) -> Error {
    let begin = String::from_utf8_lossy(&text[..text.len().min(60)]);
    let begin = calib::recording::shown::shown(begin.trim());
    Error::NotPhyphox {
        address: address.to_owned(),
        begin,
    }
}
