//! Serial ports.

use std::fs::File;
use std::path::Path;

use crate::sources::error::Error;

/// Opens a file; a terminal device is set to `baud` bits per second, 8 data bits, and hands bytes on as they come.
pub(crate) fn open(path: &Path, baud: u32) -> Result<File, Error> {
    let refused = |source| {
        let path = path.to_owned();
        Error::Unreadable(calib::Error::Io { path, source })
    };
    let file = File::open(path).map_err(refused)?;
    set_up(&file, baud).map_err(refused)?;
    Ok(file)
}

#[cfg(unix)]
fn set_up(file: &File, baud: u32) -> std::io::Result<()> {
    use rustix::termios::{OptionalActions, isatty, tcgetattr, tcsetattr};
    if !isatty(file) {
        return Ok(());
    }
    let mut settings = tcgetattr(file)?;
    settings.make_raw();
    settings.set_speed(baud)?;
    Ok(tcsetattr(file, OptionalActions::Now, &settings)?)
}

#[cfg(not(unix))]
fn set_up(_file: &File, _baud: u32) -> std::io::Result<()> {
    Ok(())
}
