//! ROS 2 bags in SQLite: `messages(id, topic_id, timestamp, data)` and `topics(id, name, type, ..)`.

use findings::{Finding, Kind, Remedy};

use crate::error::counted;
use crate::format::{Format, ReadSeek, Reads};
use crate::ros::imu::{Encoding, Topics};
use crate::ros::sqlite::{Database, Value};
use crate::stream::Recorder;
use crate::{Content, Error, Limits, Wanted};

/// `.db3` bags. Its rows lie anywhere in it, so that what cannot be sought in is held in memory.
pub(crate) static DB3: Format = Format {
    name: "db3",
    about: "a ROS 2 bag in SQLite (.db3) with sensor_msgs/msg/Imu",
    begins: |head| head.starts_with(b"SQLite format 3\0"),
    reads: Reads::Seeking(read),
};

fn read(file: &mut dyn ReadSeek, wanted: &Wanted, limits: Limits) -> Result<Content, Error> {
    let mut database = Database::new(file)?;
    let tables = database.tables()?;
    let (Some(topics), Some(messages)) = (tables.get("topics"), tables.get("messages")) else {
        let mut names: Vec<&str> = tables.keys().map(String::as_str).collect();
        names.sort_unstable();
        let found = Finding::of(Kind::NO_BAG_TABLES).detail("tables", names.join(", "));
        // Of Sensor Logger.
        let of_app = ["Gyroscope", "Accelerometer"];
        return Err(Error::refused(
            match of_app.iter().any(|name| tables.contains_key(*name)) {
                true => found.remedy(Remedy::ExportAs {
                    format: "Zip or JSON".into(),
                }),
                false => found,
            },
        ));
    };
    let mut recorder = Recorder::new(wanted, limits);
    let mut read: Topics<i64> = Topics::default();
    database.rows(*topics, &mut |_, id, row| {
        let text = |at: usize| match row.get(at) {
            Some(Value::Text(text)) => String::from_utf8_lossy(text).into_owned(),
            _ => String::new(),
        };
        read.add(id, text(1), text(2), Some(Encoding::Cdr), &mut recorder);
        Ok(())
    })?;
    let walked = database.rows(*messages, &mut |at, _, row| {
        let (Some(Value::Integer(topic)), Some(Value::Blob(data))) = (row.get(1), row.get(3))
        else {
            return Ok(());
        };
        read.take(topic, data, at, &mut recorder)
    });
    match walked {
        Err(Error::Damaged(found))
            if recorder
                .content
                .streams
                .iter()
                .any(|s| !s.stamps.is_empty()) =>
        {
            let at = found.place.byte.unwrap_or(0);
            let damaged = counted(Finding::of(Kind::FILE_DAMAGED), "byte", at);
            recorder.content.cut = Some(damaged.because(*found));
        }
        other => other?,
    }
    Ok(read.finish(recorder))
}
