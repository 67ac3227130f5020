//! The topics of sensors.

use super::layout::Layouts;
use crate::bytes::Fields;
use crate::error::contradicted;
use crate::stream::{Handle, Recorder};
use crate::{Error, Quantity};

/// A topic that is read.
#[derive(Debug)]
pub(super) enum Topic {
    /// One sensor, stamped by the sample.
    Sensor(Sensor),
    /// Both sensors, corrected.
    Combined(Combined),
    /// Raw readings in blocks.
    Fifo(Fifo),
    /// Device ids of the sensors behind the corrected readings: offsets of both fields, and the last ids.
    Selection {
        ids: [usize; 2],
        last: Option<[u32; 2]>,
    },
}

#[derive(Debug)]
pub(super) struct Sensor {
    stream: Handle,
    stamp: usize,
    axes: [usize; 3],
    temperature: Option<(Handle, usize)>,
}

#[derive(Debug)]
pub(super) struct Combined {
    streams: [Handle; 2],
    stamp: usize,
    relative: usize,
    axes: [usize; 2],
}

#[derive(Debug)]
pub(super) struct Fifo {
    stream: Handle,
    stamp: usize,
    dt: usize,
    scale: usize,
    samples: usize,
    axes: [usize; 3],
}

/// Readings of a block.
const BLOCK: usize = 32;
/// A relative stamp of this says that there is none.
const NONE: i32 = i32::MAX;

/// Returns the fields of a message from byte `offset` on; none behind its end.
fn fields_at<'a>(body: &'a [u8], offset: usize) -> Fields<'a> {
    Fields(body.get(offset..).unwrap_or_default())
}

fn float(body: &[u8], offset: usize) -> Option<f64> {
    fields_at(body, offset).f32().map(f64::from)
}

/// A stamp in µs as ns.
fn nanoseconds(stamp: u64) -> i64 {
    i64::try_from(stamp)
        .unwrap_or(i64::MAX)
        .saturating_mul(1000)
}

impl Topic {
    /// The topic `name`, if it is one of a sensor and wanted.
    pub fn new(
        name: &str,
        instance: u8,
        layouts: &Layouts,
        recorder: &mut Recorder,
    ) -> Option<Self> {
        let offset = |field: &str, kind: &str| layouts.offset(name, field, kind);
        let axes = |kind: &str| Some([offset("x", kind)?, offset("y", kind)?, offset("z", kind)?]);
        let stamp =
            || offset("timestamp_sample", "uint64_t").or_else(|| offset("timestamp", "uint64_t"));
        let instance = u32::from(instance);
        let quantity = match name {
            "sensor_accel" | "sensor_accel_fifo" => Quantity::SpecificForce,
            "sensor_gyro" | "sensor_gyro_fifo" => Quantity::AngularRate,
            "sensor_mag" => Quantity::MagneticField,
            "sensor_combined" => {
                return Combined::new(name, instance, layouts, recorder).map(Self::Combined);
            }
            "sensor_selection" => {
                let ids = [
                    offset("accel_device_id", "uint32_t")?,
                    offset("gyro_device_id", "uint32_t")?,
                ];
                return Some(Self::Selection { ids, last: None });
            }
            _ => return None,
        };
        if name.ends_with("_fifo") {
            let (stamp, axes) = (stamp()?, axes("int16_t")?);
            let (dt, scale) = (offset("dt", "float")?, offset("scale", "float")?);
            let samples = offset("samples", "uint8_t")?;
            let stream = recorder.stream(name, instance, quantity)?;
            return Some(Self::Fifo(Fifo {
                stream,
                stamp,
                dt,
                scale,
                samples,
                axes,
            }));
        }
        let (stamp, axes) = (stamp()?, axes("float")?);
        let temperature =
            offset("temperature", "float").filter(|_| quantity == Quantity::SpecificForce);
        let stream = match quantity {
            Quantity::MagneticField => recorder.field(name, instance, "gauss")?,
            _ => recorder.stream(name, instance, quantity)?,
        };
        let temperature = temperature.and_then(|offset| {
            Some((
                recorder.stream(name, instance, Quantity::Temperature)?,
                offset,
            ))
        });
        Some(Self::Sensor(Sensor {
            stream,
            stamp,
            axes,
            temperature,
        }))
    }

    /// Takes a message in.
    pub fn take(&mut self, body: &[u8], at: u64, recorder: &mut Recorder) -> Result<(), Error> {
        let taken = match self {
            Self::Sensor(sensor) => sensor.take(body, recorder),
            Self::Combined(combined) => combined.take(body, recorder),
            Self::Fifo(fifo) => fifo.take(body, recorder),
            Self::Selection { ids, last } => {
                let id = |offset: usize| fields_at(body, offset).u32();
                *last = id(ids[0]).zip(id(ids[1])).map(|(a, g)| [a, g]).or(*last);
                Some(Ok(()))
            }
        };
        taken.unwrap_or_else(|| {
            Err(Error::at(
                at,
                contradicted("message", "shorter", "its format"),
            ))
        })
    }

    /// The device ids of the accelerometer and the gyroscope that were chosen.
    pub fn selected(&self) -> Option<[u32; 2]> {
        match self {
            Self::Selection { last, .. } => *last,
            _ => None,
        }
    }
}

impl Sensor {
    fn take(&self, body: &[u8], recorder: &mut Recorder) -> Option<Result<(), Error>> {
        let stamp = nanoseconds(fields_at(body, self.stamp).u64()?);
        let [x, y, z] = self.axes;
        let value = [float(body, x)?, float(body, y)?, float(body, z)?];
        if let Some((stream, offset)) = self.temperature {
            let celsius = float(body, offset)?;
            if celsius.is_finite()
                && let Err(error) = recorder.push(stream, stamp, [celsius, 0.0, 0.0])
            {
                return Some(Err(error));
            }
        }
        Some(recorder.push(self.stream, stamp, value))
    }
}

impl Combined {
    fn new(name: &str, instance: u32, layouts: &Layouts, recorder: &mut Recorder) -> Option<Self> {
        let offset = |field: &str, kind: &str| layouts.offset(name, field, kind);
        let stamp = offset("timestamp", "uint64_t")?;
        let relative = offset("accelerometer_timestamp_relative", "int32_t")?;
        let axes = [
            offset("accelerometer_m_s2", "float")?,
            offset("gyro_rad", "float")?,
        ];
        let streams = [
            recorder.stream(name, instance, Quantity::SpecificForce)?,
            recorder.stream(name, instance, Quantity::AngularRate)?,
        ];
        for stream in streams {
            recorder.at(stream).processed = true;
        }
        Some(Self {
            streams,
            stamp,
            relative,
            axes,
        })
    }

    fn take(&self, body: &[u8], recorder: &mut Recorder) -> Option<Result<(), Error>> {
        let stamp = nanoseconds(fields_at(body, self.stamp).u64()?);
        let relative = fields_at(body, self.relative).i32()?;
        let triad = |offset: usize| {
            let mut fields = fields_at(body, offset);
            Some([
                f64::from(fields.f32()?),
                f64::from(fields.f32()?),
                f64::from(fields.f32()?),
            ])
        };
        let (force, rate) = (triad(self.axes[0])?, triad(self.axes[1])?);
        if relative != NONE {
            let stamp = stamp.saturating_add(i64::from(relative) * 1000);
            if let Err(error) = recorder.push(self.streams[0], stamp, force) {
                return Some(Err(error));
            }
        }
        Some(recorder.push(self.streams[1], stamp, rate))
    }
}

impl Fifo {
    fn take(&self, body: &[u8], recorder: &mut Recorder) -> Option<Result<(), Error>> {
        let last = fields_at(body, self.stamp).u64()?;
        let (dt, scale) = (float(body, self.dt)?, float(body, self.scale)?);
        let samples = usize::from(fields_at(body, self.samples).u8()?).min(BLOCK);
        let read = |offset: usize| Some(f64::from(fields_at(body, offset).i16()?) * scale);
        for k in 0..samples {
            // The stamp is that of the last reading.
            let before = (samples - 1 - k) as f64 * dt * 1e3;
            let stamp = nanoseconds(last).saturating_sub(before.round() as i64);
            let [x, y, z] = self.axes;
            let value = [read(x + 2 * k)?, read(y + 2 * k)?, read(z + 2 * k)?];
            if let Err(error) = recorder.push(self.stream, stamp, value) {
                return Some(Err(error));
            }
        }
        Some(Ok(()))
    }
}
