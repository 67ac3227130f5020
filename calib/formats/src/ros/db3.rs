//! ROS 2 bags in SQLite: `messages(id, topic_id, timestamp, data)` and `topics(id, name, type, ..)`.

use std::io::{Cursor, Read};

use crate::format::{Format, ReadSeek};
use crate::ros::imu::{Encoding, Topics};
use crate::ros::sqlite::{Database, Value};
use crate::stream::Recorder;
use crate::{Content, Error, Limits, Wanted};

/// `.db3` bags. Its rows lie anywhere in it, so that what cannot be sought in is held in memory.
#[derive(Debug)]
pub(crate) struct Db3;

impl Format for Db3 {
    fn name(&self) -> &'static str {
        "db3"
    }

    fn about(&self) -> &'static str {
        "a ROS 2 bag in SQLite (.db3) with sensor_msgs/msg/Imu; --topic chooses among several"
    }

    fn recognises(&self, head: &[u8]) -> bool {
        head.starts_with(b"SQLite format 3\0")
    }

    fn read(
        &self,
        reader: &mut dyn Read,
        wanted: &Wanted,
        limits: Limits,
    ) -> Result<Content, Error> {
        let mut bytes = Vec::new();
        reader
            .take(limits.bytes.saturating_add(1))
            .read_to_end(&mut bytes)?;
        if bytes.len() as u64 > limits.bytes {
            return Err(Error::refused(format!(
                "a database of more than {} bytes",
                limits.bytes
            )));
        }
        self.read_seekable(&mut Cursor::new(bytes), wanted, limits)
    }

    fn read_seekable(
        &self,
        file: &mut dyn ReadSeek,
        wanted: &Wanted,
        limits: Limits,
    ) -> Result<Content, Error> {
        let mut database = Database::new(file)?;
        let tables = database.tables()?;
        let (Some(topics), Some(messages)) = (tables.get("topics"), tables.get("messages")) else {
            let mut names: Vec<&str> = tables.keys().map(String::as_str).collect();
            names.sort_unstable();
            let words = format!(
                "an SQLite database without the tables `topics` and `messages` of a ROS 2 bag; it has {}{}",
                names.join(", "),
                match tables.contains_key("Gyroscope") || tables.contains_key("Accelerometer") {
                    true => "; of Sensor Logger, export Zip or JSON",
                    false => "",
                }
            );
            return Err(Error::refused(words));
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
            Err(Error::Damaged { at, what })
                if recorder
                    .content
                    .streams
                    .iter()
                    .any(|s| !s.stamps.is_empty()) =>
            {
                recorder.content.cut = Some(
                    findings::Finding::of(findings::Kind::FileDamaged)
                        .count("byte", at as usize)
                        .detail("why", what),
                );
            }
            other => other?,
        }
        Ok(read.finish(recorder))
    }
}
