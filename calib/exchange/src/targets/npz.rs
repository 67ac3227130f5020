//! NumPy's archive of arrays, as `numpy.load` reads it.

use findings::{Finding, Kind};
use flate2::Crc;
use nalgebra::{Matrix3, Vector3};

use super::document::{document, matrix};
use crate::error::Error;
use crate::kept::Kept;
use crate::source::Source;
use crate::target::{Form, Settings, Target, Written};

/// `accelerometer_T` (3 × 3), `accelerometer_bias` (3), `accelerometer_T_std`, `accelerometer_bias_std`, the same of the
/// gyroscope, `g_sensitivity`, `gravity`, `covariance`, `parameters` (names), and `cal_json`, the whole file as text.
pub const TARGET: Target = Target {
    name: "npz",
    about: "a NumPy archive: T and bias of every sensor, covariance, and all of cal.json as text",
    form: Form::File,
    keeps: Kept::all_of,
    write,
};

fn write(source: &Source<'_>, _: &Settings) -> Result<Written, Error> {
    let mut archive = Archive::default();
    let tree = document(source)?;
    let calibration = source.calibration;
    let sensors = [
        ("accelerometer", &calibration.accelerometer),
        ("gyroscope", &calibration.gyroscope),
        ("magnetometer", &calibration.magnetometer),
    ];
    for (name, triad) in sensors {
        let Some(triad) = triad else { continue };
        let base = triad.base();
        archive.numbers(&format!("{name}_T"), &[3, 3], &in_rows(&base.t))?;
        archive.numbers(&format!("{name}_bias"), &[3], base.bias.as_slice())?;
        let t_std = Matrix3::from_fn(|i, j| triad.t_std[i][j].unwrap_or(f64::NAN));
        let bias_std = Vector3::from(triad.bias_std.map(|v| v.unwrap_or(f64::NAN)));
        archive.numbers(&format!("{name}_T_std"), &[3, 3], &in_rows(&t_std))?;
        archive.numbers(&format!("{name}_bias_std"), &[3], bias_std.as_slice())?;
    }
    if let Some(g) = &source.g_sensitivity {
        archive.numbers("g_sensitivity", &[3, 3], &in_rows(g))?;
    }
    archive.numbers("gravity", &[], &[calibration.gravity])?;
    if let Some(rows) = tree.get("covariance").and_then(matrix) {
        let n = rows.len();
        archive.numbers("covariance", &[n, n], &rows.concat())?;
    }
    let names: Vec<&str> = calibration.parameters.iter().map(String::as_str).collect();
    archive.texts("parameters", &[names.len()], &names)?;
    archive.texts("cal_json", &[], &[&tree.to_string()])?;
    Ok(Written {
        files: vec![archive.finish()?],
        notes: Vec::new(),
    })
}

fn in_rows(m: &Matrix3<f64>) -> [f64; 9] {
    crate::source::rows(m)
}

/// A zip archive of `.npy` files, stored: a reader must find numbers where they are, and there are few.
///
/// Source: PKWARE, APPNOTE.TXT 6.3.9, sections 4.3.7, 4.3.12 and 4.3.16; NumPy, `numpy.lib.format`, version 1.0.
#[derive(Default)]
struct Archive {
    bytes: Vec<u8>,
    directory: Vec<u8>,
    entries: u16,
}

impl Archive {
    fn numbers(&mut self, name: &str, shape: &[usize], values: &[f64]) -> Result<(), Error> {
        let data: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.add(name, "<f8", shape, &data)
    }

    fn texts(&mut self, name: &str, shape: &[usize], values: &[&str]) -> Result<(), Error> {
        let longest = values.iter().map(|v| v.chars().count()).max();
        let longest = longest.unwrap_or(1).max(1);
        let mut data = Vec::new();
        for value in values {
            let mut points: Vec<u32> = value.chars().map(u32::from).collect();
            points.resize(longest, 0);
            data.extend(points.iter().flat_map(|p| p.to_le_bytes()));
        }
        self.add(name, &format!("<U{longest}"), shape, &data)
    }

    fn add(&mut self, name: &str, kind: &str, shape: &[usize], data: &[u8]) -> Result<(), Error> {
        let shape: String = shape.iter().map(|n| format!("{n},")).collect();
        let mut header =
            format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({shape}), }}");
        // Magic, version and length take 10 bytes, the line end 1; the data begin at a multiple of 64.
        let padding = (64 - (header.len() + 11) % 64) % 64;
        header.push_str(&" ".repeat(padding));
        header.push('\n');
        let length = u16::try_from(header.len()).map_err(|e| Error::unwritten(&e))?;
        let mut file = b"\x93NUMPY\x01\x00".to_vec();
        file.extend(length.to_le_bytes());
        file.extend(header.as_bytes());
        file.extend(data);
        self.store(&format!("{name}.npy"), &file)
    }

    fn store(&mut self, name: &str, file: &[u8]) -> Result<(), Error> {
        let too_large = |_| Error::format(Finding::of(Kind::ARCHIVE_TOO_LARGE));
        let size = u32::try_from(file.len()).map_err(too_large)?;
        let start = u32::try_from(self.bytes.len()).map_err(too_large)?;
        let mut crc = Crc::new();
        crc.update(file);
        // Version 2.0, no flags, stored, 1 January 1980: same input, same bytes.
        let mut common = Vec::new();
        common.extend([20, 0, 0, 0, 0, 0, 0, 0, 0x21, 0]);
        for v in [crc.sum(), size, size] {
            common.extend(v.to_le_bytes());
        }
        common.extend((name.len() as u16).to_le_bytes());
        common.extend([0, 0]);
        self.bytes.extend(b"PK\x03\x04");
        self.bytes.extend(&common);
        self.bytes.extend(name.as_bytes());
        self.bytes.extend(file);
        self.directory.extend(b"PK\x01\x02\x14\x00");
        self.directory.extend(&common);
        // No comment, first disk, no attributes.
        self.directory.extend([0; 10]);
        self.directory.extend(start.to_le_bytes());
        self.directory.extend(name.as_bytes());
        self.entries += 1;
        Ok(())
    }

    fn finish(mut self) -> Result<Vec<u8>, Error> {
        let too_large = |_| Error::format(Finding::of(Kind::ARCHIVE_TOO_LARGE));
        let start = u32::try_from(self.bytes.len()).map_err(too_large)?;
        let size = u32::try_from(self.directory.len()).map_err(too_large)?;
        self.bytes.append(&mut self.directory);
        self.bytes.extend(b"PK\x05\x06\0\0\0\0");
        self.bytes.extend(self.entries.to_le_bytes());
        self.bytes.extend(self.entries.to_le_bytes());
        self.bytes.extend(size.to_le_bytes());
        self.bytes.extend(start.to_le_bytes());
        self.bytes.extend([0, 0]);
        Ok(self.bytes)
    }
}
