//! Guided sessions: samples as they come, and what the person has to do next.

use calib::recording::{Rows, Stream};
use live::{Aim, Batch};

pub use live::{
    Direction, Errors, Estimate, Instruction, Motion, Promise, Shortfall, Verdict, View,
};

use crate::{Error, Recording, Request};

/// Name of the recording of a session in messages.
const NAME: &str = "session";

/// A guided session: it takes samples and says what to do next, as `stillpoint live` does. Time is that of the stamps.
///
/// # Examples
/// ```
/// use stillpoint::Rows;
/// use stillpoint::guided::{Instruction, Session};
///
/// let (t, accel, gyro, _) = stillpoint::example::session();
/// let mut session = Session::new(6, 2.0, &stillpoint::Request::default())?;
/// assert_eq!(session.instruction(), Instruction::Wait);
/// // A second of samples at a time, as a device sends them.
/// let mut said = Vec::new();
/// for ((t, accel), gyro) in t.chunks(100).zip(accel.chunks(100)).zip(gyro.chunks(100)) {
///     said.extend(session.take(Rows { t, accel, gyro, ..Rows::default() })?);
/// }
/// assert!(said.iter().any(|now| matches!(now, Instruction::Turn { .. })));
/// assert!(session.view().placements.len() > 2);
/// let recording = session.recording()?;
/// assert_eq!(recording.rows(stillpoint::Sensor::Gyroscope), t.len());
/// # Ok::<(), stillpoint::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Session(live::Session);

impl Session {
    /// A session of so many `placements`, each for `hold` seconds; the running calibration is that of `request`.
    ///
    /// # Errors
    /// [`ErrorKind::Usage`](crate::ErrorKind::Usage) for a request that contradicts itself.
    pub fn new(placements: usize, hold: f64, request: &Request) -> Result<Self, Error> {
        Ok(Self(live::Session::new(Aim {
            placements,
            hold,
            request: request.for_calibration(1)?,
        })))
    }

    /// Takes the next samples of both sensors (stamps in s, later than all before); every instruction that differs from the one before, in order.
    ///
    /// # Errors
    /// [`ErrorKind::Input`](crate::ErrorKind::Input) for arrays of different lengths, a number that is not finite, stamps that do not go on.
    /// Nothing is taken then.
    pub fn take(&mut self, rows: Rows<'_>) -> Result<Vec<Instruction>, Error> {
        let so_far = self.0.recording().accelerometer.as_ref();
        let last = so_far.and_then(|stream| stream.t.last().copied());
        let streams = rows.in_part(NAME, last);
        let [accelerometer, gyroscope] = streams.map_err(|error| Error::of_arrays(&error))?;
        Ok(self.0.take(&Batch {
            accelerometer,
            gyroscope,
            ..Batch::default()
        }))
    }

    /// The step to do now.
    pub fn instruction(&self) -> Instruction {
        self.0.instruction()
    }

    /// The session now: placements, what is wanted next, standard errors, attitude.
    pub fn view(&self) -> View {
        View::of(&self.0)
    }

    /// The samples so far.
    ///
    /// # Errors
    /// As [`Recording::from_arrays`], of which a session without samples is one.
    pub fn recording(&self) -> Result<Recording, Error> {
        let so_far = self.0.recording();
        let values = |stream: &Option<Stream>| -> Vec<[f64; 3]> {
            let values = stream.iter().flat_map(|stream| &stream.values);
            values.map(|v| (*v).into()).collect()
        };
        let t = so_far.accelerometer.as_ref().map_or(&[][..], |s| &s.t);
        let (accel, gyro) = (values(&so_far.accelerometer), values(&so_far.gyroscope));
        Recording::from_arrays(t, &accel, &gyro, None).map(|recording| recording.named(NAME))
    }
}
