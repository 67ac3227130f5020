//! A recording that was checked.

use std::path::Path;
use std::sync::Arc;

use calib::recording::{ReadOptions, Rows, Stream, to_csv};
use sensor::Sensor;

use findings::Front;

use crate::Error;

/// Name of a recording from arrays, unless [`Recording::named`] sets another.
const UNNAMED: &str = "arrays";

/// Recording of one device, each sensor on its own clock, in SI units. A clone shares the samples.
#[derive(Clone, Debug, Default)]
pub struct Recording(Arc<calib::Recording>);

impl Recording {
    /// The recording in arrays with one row per stamp: `t` (s, `n`), `accel` (specific force in m/s², `n × 3`, +g on the
    /// axis that points up), `gyro` (angular rate in rad/s, `n × 3`, right-handed) and `temperature` (°C, `n`). `accel`
    /// or `gyro` may be empty, not both.
    ///
    /// It is the recording that a plain CSV with these numbers gives, bit for bit: readings in g, °/s or counts are told
    /// by gravity and by the turns and are said in [`Recording::warnings`]; rows with equal stamps become one. The samples
    /// are copied once.
    ///
    /// # Errors
    /// [`ErrorKind::Input`](crate::ErrorKind::Input) for arrays of different lengths, a number that is not finite, time
    /// that goes backwards, an axis that never changes, gravity that is missing; [`Error::line`] is the row, from 1.
    /// [`ErrorKind::NotEnoughInformation`](crate::ErrorKind::NotEnoughInformation) for a single row.
    ///
    /// # Examples
    /// ```
    /// use stillpoint::{Recording, Sensor};
    ///
    /// let (t, accel, gyro, celsius) = stillpoint::example::session();
    /// let recording = Recording::from_arrays(&t, &accel, &gyro, Some(&celsius))?.named("morning");
    /// assert_eq!(recording.rows(Sensor::Accelerometer), t.len());
    /// let back = [t[1], t[0]];
    /// assert!(Recording::from_arrays(&back, &accel[..2], &[], None).is_err());
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn from_arrays(
        t: &[f64],
        accel: &[[f64; 3]],
        gyro: &[[f64; 3]],
        temperature: Option<&[f64]>,
    ) -> Result<Self, Error> {
        let rows = Rows {
            t,
            accel,
            gyro,
            temperature: temperature.unwrap_or_default(),
            ..Rows::default()
        };
        Self::from_rows(rows)
    }

    /// [`Recording::from_arrays`] with a magnetometer, or whatever else [`Rows`] has: its field in µT, one row per stamp.
    ///
    /// # Errors
    /// As [`Recording::from_arrays`].
    ///
    /// # Examples
    /// ```
    /// use stillpoint::{Recording, Rows};
    ///
    /// let (t, accel, gyro, celsius) = stillpoint::example::session();
    /// let mag = vec![[20.0, 0.0, -40.0]; t.len()];
    /// let rows = Rows { t: &t, accel: &accel, gyro: &gyro, temperature: &celsius, mag: &mag };
    /// assert!(Recording::from_rows(rows).is_ok());
    /// let short = Recording::from_rows(Rows { mag: &mag[1..], ..rows }).unwrap_err();
    /// assert!(short.message.contains("mag has"));
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn from_rows(rows: Rows<'_>) -> Result<Self, Error> {
        match calib::Recording::from_rows(UNNAMED, rows) {
            Ok(recording) => Ok(Self(Arc::new(recording))),
            Err(error) => Err(Error::of_arrays(&error)),
        }
    }

    /// The recording in a file or a folder of any known format, recognised by its content.
    ///
    /// # Errors
    /// A file that cannot be read or is no recording, with [`Error::file`], line and column.
    ///
    /// # Examples
    /// ```
    /// let error = stillpoint::Recording::from_file("no_such.csv").unwrap_err();
    /// assert_eq!(error.file.as_deref(), Some("no_such.csv"));
    /// ```
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self, Error> {
        Self::from_file_with(path, &ReadOptions::default())
    }

    /// [`Recording::from_file`] where the file does not say everything: units, columns, a rate.
    ///
    /// # Errors
    /// As [`Recording::from_file`].
    ///
    /// # Examples
    /// ```
    /// use stillpoint::{ErrorKind, ReadOptions, Recording};
    ///
    /// let impossible = ReadOptions { rate: Some(-1.0), ..ReadOptions::default() };
    /// let error = Recording::from_file_with("run.csv", &impossible).unwrap_err();
    /// assert_eq!(error.kind, ErrorKind::Usage);
    /// assert!(error.message.contains("`ReadOptions::rate`"));
    /// ```
    pub fn from_file_with(path: impl AsRef<Path>, how: &ReadOptions) -> Result<Self, Error> {
        let recording = calib::Recording::read(path.as_ref(), how)?;
        Ok(Self(Arc::new(recording)))
    }

    /// The recording in one file per sensor, both on one clock.
    ///
    /// # Errors
    /// As [`Recording::from_file`].
    ///
    /// # Examples
    /// ```
    /// use stillpoint::{ReadOptions, Recording};
    ///
    /// let how = ReadOptions::default();
    /// assert!(Recording::from_pair("acc.txt", "gyro.txt", &how).is_err());
    /// ```
    pub fn from_pair(
        accel: impl AsRef<Path>,
        gyro: impl AsRef<Path>,
        how: &ReadOptions,
    ) -> Result<Self, Error> {
        let recording = calib::Recording::read_pair(accel.as_ref(), gyro.as_ref(), how)?;
        Ok(Self(Arc::new(recording)))
    }

    /// The same with the readings of a sensor of one dimension beside the others: `t` (s on the clock of the recording, `n`), the readings
    /// (`n`) and the true signal at these times (`n`), or an empty one where nobody knows it.
    ///
    /// # Errors
    /// [`ErrorKind::Input`](crate::ErrorKind::Input) for arrays of different lengths, a number that is not finite, time that does not go
    /// on, readings outside the recording, and a name that it has already.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, _) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// let pressure = vec![101_300.0; t.len()];
    /// let recording = recording.with_scalar("barometer", &t, &pressure, &[])?;
    /// assert_eq!(recording.scalar("barometer").map(<[f64]>::len), Some(t.len()));
    /// assert!(recording.with_scalar("altimeter", &t, &pressure[1..], &[]).is_err());
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn with_scalar(
        self,
        name: &str,
        t: &[f64],
        readings: &[f64],
        truth: &[f64],
    ) -> Result<Self, Error> {
        let own = Arc::unwrap_or_clone(self.0);
        match own.with_scalar(name, t, readings, truth) {
            Ok(recording) => Ok(Self(Arc::new(recording))),
            Err(error) => Err(Error::of_arrays(&error)),
        }
    }

    /// Returns the readings of a sensor of one dimension (`n`), corrected by [`apply`](crate::apply); `None` where it was not recorded.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, _) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// assert!(recording.scalar("barometer").is_none());
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn scalar(&self, name: &str) -> Option<&[f64]> {
        self.0.scalar(name).map(|own| own.values.as_slice())
    }

    /// The same called `name` in warnings and results.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, _) = stillpoint::example::session();
    /// let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, None)?.named("evening");
    /// assert_eq!(recording.name(), "evening");
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    #[must_use]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        let name = name.into();
        let own = Arc::make_mut(&mut self.0);
        own.warnings.rename(&own.name, &name);
        own.name = name;
        self
    }

    /// Returns the name of the recording: the path of a file, or `arrays` for arrays without [`Recording::named`].
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, celsius) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, Some(&celsius))?;
    /// assert_eq!(recording.name(), "arrays");
    /// assert_eq!(recording.named("morning").name(), "morning");
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn name(&self) -> &str {
        &self.0.name
    }

    /// Number of samples `n` of a sensor; 0 of one that was not recorded.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, celsius) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, Some(&celsius))?;
    /// use stillpoint::Sensor;
    ///
    /// assert_eq!(recording.rows(Sensor::Gyroscope), gyro.len());
    /// assert_eq!(recording.rows(Sensor::Magnetometer), 0);
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn rows(&self, sensor: Sensor) -> usize {
        self.stream(sensor).map_or(0, Stream::len)
    }

    /// Stamps of a sensor (`n`), s, on its own clock; empty where it was not recorded.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, celsius) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, Some(&celsius))?;
    /// assert_eq!(recording.stamps(stillpoint::Sensor::Accelerometer), t);
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn stamps(&self, sensor: Sensor) -> &[f64] {
        self.stream(sensor).map_or(&[], |stream| &stream.t)
    }

    /// Samples of a sensor, m/s² or rad/s, or as recorded where the unit is not known.
    ///
    /// # Examples
    /// ```
    /// use stillpoint::{Recording, Sensor};
    ///
    /// let (t, accel, gyro, _) = stillpoint::example::session();
    /// let recording = Recording::from_arrays(&t, &accel, &gyro, None)?;
    /// assert!(recording.values(Sensor::Gyroscope).eq(gyro));
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn values(&self, sensor: Sensor) -> impl ExactSizeIterator<Item = [f64; 3]> {
        let values = self.stream(sensor).map_or(&[][..], |stream| &stream.values);
        values.iter().map(|value| (*value).into())
    }

    /// Temperature at a time (s), °C, linear between readings; `None` without a thermometer.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, celsius) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, Some(&celsius))?;
    /// let middle = recording.temperature_at(0.5 * (t[0] + t[1])).unwrap();
    /// assert!((middle - 0.5 * (celsius[0] + celsius[1])).abs() < 1e-9);
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn temperature_at(&self, t: f64) -> Option<f64> {
        self.0.temperature.as_ref()?.at(t)
    }

    /// From the first stamp to the last, s.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, celsius) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, Some(&celsius))?;
    /// assert!((recording.duration() - (t[t.len() - 1] - t[0])).abs() < 1e-9);
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn duration(&self) -> f64 {
        let both = [Sensor::Accelerometer, Sensor::Gyroscope];
        let last = both.iter().filter_map(|s| self.stamps(*s).last());
        (last.copied().fold(f64::NEG_INFINITY, f64::max) - self.0.start()).max(0.0)
    }

    /// Returns the warnings about the samples, one sentence each: a unit inferred from gravity, missing samples.
    ///
    /// # Examples
    /// ```
    /// # let (t, accel, gyro, celsius) = stillpoint::example::session();
    /// # let recording = stillpoint::Recording::from_arrays(&t, &accel, &gyro, Some(&celsius))?;
    /// assert!(recording.warnings().is_empty());
    /// let in_g: Vec<[f64; 3]> = accel.iter().map(|f| f.map(|f| f / 9.80665)).collect();
    /// let recording = stillpoint::Recording::from_arrays(&t, &in_g, &gyro, None)?;
    /// assert!(recording.warnings().iter().any(|w| w.contains(" g")), "{:?}", recording.warnings());
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn warnings(&self) -> Vec<String> {
        self.0.warnings.texts(Front::Rust)
    }

    /// Returns the recording as plain CSV. Numbers have the fewest digits that give the same bits back.
    ///
    /// # Examples
    /// ```
    /// use stillpoint::Recording;
    ///
    /// let (t, accel, gyro, _) = stillpoint::example::session();
    /// let csv = Recording::from_arrays(&t, &accel, &gyro, None)?.to_csv();
    /// assert!(csv.starts_with("t,ax,ay,az,gx,gy,gz\n"));
    /// # Ok::<(), stillpoint::Error>(())
    /// ```
    pub fn to_csv(&self) -> String {
        to_csv(&mut self.0.as_ref().clone())
    }

    fn stream(&self, sensor: Sensor) -> Option<&Stream> {
        self.0.stream(sensor)
    }

    /// The same with sensors faster than any hand read as means, as fits want it.
    pub(crate) fn at_hand_speed(&self) -> Self {
        if !self.0.is_fast() {
            return self.clone();
        }
        Self(Arc::new(self.0.as_ref().clone().decimated()))
    }
}

/// The recording as the estimators take it.
impl AsRef<calib::Recording> for Recording {
    fn as_ref(&self) -> &calib::Recording {
        &self.0
    }
}

impl From<calib::Recording> for Recording {
    fn from(recording: calib::Recording) -> Self {
        Self(Arc::new(recording))
    }
}
