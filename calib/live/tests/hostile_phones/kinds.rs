//! What the phones answer.

const CONFIG: &str = r#"{"title": "Raw", "inputs": [
    {"source": "accelerometer", "outputs": [{"x": "aX"}, {"y": "aY"}, {"z": "aZ"}, {"t": "aT"}]},
    {"source": "gyroscope", "outputs": [{"x": "gX"}, {"y": "gY"}, {"z": "gZ"}, {"t": "gT"}]}], "export": [{}]}"#;

/// What a connection gets.
pub enum Answer {
    /// An ordinary answer.
    Body(Vec<u8>),
    /// These bytes and the end.
    Raw(Vec<u8>),
    /// Nothing, for longer than is waited.
    Silence,
    /// A byte now and then.
    Drip,
    /// These bytes again and again.
    Endless(&'static [u8]),
}

pub fn body(text: impl Into<Vec<u8>>) -> Answer {
    Answer::Body(text.into())
}

fn raw(text: impl Into<Vec<u8>>) -> Answer {
    Answer::Raw(text.into())
}

/// An answer to `/get` with `count` values of each buffer, as text.
fn samples(time: &str, value: &str, count: usize) -> Vec<u8> {
    let part = |name: &str, value: &str| {
        let values = vec![value; count].join(",");
        format!(r#""{name}":{{"updateMode":"partial","buffer":[{values}]}}"#)
    };
    let names = ["aX", "aY", "aZ", "gX", "gY", "gZ"].map(|name| part(name, value));
    let times = ["aT", "gT"].map(|name| part(name, time));
    let parts = [names.as_slice(), &times].concat().join(",");
    format!(r#"{{"buffer":{{{parts}}},"status":{{"session":"s","measuring":true}}}}"#).into_bytes()
}

/// An ordinary answer to the `n`th request, a quarter of a second on.
pub fn ordinary(path: &str, n: usize) -> Answer {
    match path {
        "/config" => body(CONFIG),
        "/get" => {
            let at = |k: usize| format!("{}", 0.25 * n as f64 + 0.01 * k as f64);
            let times: Vec<String> = (0..25).map(at).collect();
            body(samples_at(&times, "0.5"))
        }
        "/time" => body("[]"),
        "/control" => body(r#"{"result": true}"#),
        _ => body("<html>no export</html>"),
    }
}

fn samples_at(times: &[String], value: &str) -> Vec<u8> {
    let text = String::from_utf8(samples("TIMES", value, 1)).unwrap();
    let values = vec![value; times.len()].join(",");
    let text = text.replace(&format!("[{value}]"), &format!("[{values}]"));
    text.replace("[TIMES]", &format!("[{}]", times.join(",")))
        .into_bytes()
}

fn status(line: &str, rest: &str) -> Answer {
    raw(format!(
        "HTTP/1.1 {line}\r\nConnection: close\r\n{rest}\r\n"
    ))
}

fn with_length(length: &str) -> Answer {
    status("200 OK", &format!("Content-Length: {length}\r\n\r\n{{}}"))
}

/// A kind of phone: which request it answers in its own way, and how, by the number of the request.
pub type Kind = (&'static str, &'static str, fn(usize) -> Answer);

pub const KINDS: [Kind; 62] = [
    ("a page", "/config", |_| {
        body("<html>\u{1b}[31m\nred</html>")
    }),
    ("nothing", "/config", |_| body("")),
    ("deep", "/config", |_| body("[".repeat(100_000))),
    ("long", "/config", |_| body(" ".repeat(5 << 20))),
    ("other types", "/config", |_| {
        body(r#"{"title": 7, "inputs": "all"}"#)
    }),
    ("inputs of numbers", "/config", |_| {
        body(r#"{"inputs": [1, null, {"source": 3}]}"#)
    }),
    ("many inputs", "/config", |_| {
        body(format!(
            r#"{{"inputs": [{}1]}}"#,
            r#"{"source":"a\nb"},"#.repeat(50_000)
        ))
    }),
    ("a title that escapes", "/config", |_| {
        body(CONFIG.replace("Raw", "\\u001b[2J\\nstillpoint: done"))
    }),
    ("a long title", "/config", |_| {
        body(CONFIG.replace("Raw", &"x".repeat(1 << 20)))
    }),
    ("a long name of a buffer", "/config", |_| {
        body(CONFIG.replace("aX", &"x".repeat(1 << 20)))
    }),
    ("names that escape", "/config", |_| {
        body(CONFIG.replace("accelerometer", "\\u001b[2J\\r\\n"))
    }),
    ("many exports", "/config", |_| {
        body(CONFIG.replace("[{}]", &format!("[{}{{}}]", "{},".repeat(100_000))))
    }),
    ("silent", "/config", |_| Answer::Silence),
    ("dripping", "/config", |_| Answer::Drip),
    ("moved", "/config", |_| {
        status("302 Found", "Location: http://192.0.2.1/\r\n")
    }),
    ("moved to a file", "/config", |_| {
        status("301 Moved", "Location: file:///etc/passwd\r\n")
    }),
    ("moved to itself", "/config", |_| {
        status("307 Again", "Location: /config\r\n")
    }),
    ("broken", "/config", |_| status("500 \u{1b}[31mBroken", "")),
    ("no protocol", "/config", |_| raw("hello\r\n\r\n")),
    ("closed", "/config", |_| raw("")),
    ("packed", "/config", |_| {
        status(
            "200 OK",
            "Content-Encoding: gzip\r\nContent-Length: 4\r\n\r\n\u{1f}abc",
        )
    }),
    ("too long a length", "/config", |_| with_length("1000")),
    ("too short a length", "/config", |_| with_length("1")),
    ("a negative length", "/config", |_| with_length("-1")),
    ("a length beyond all", "/config", |_| {
        with_length("99999999999999999999999")
    }),
    ("two lengths", "/config", |_| {
        with_length("1\r\nContent-Length: 2")
    }),
    ("endless headers", "/config", |_| {
        Answer::Endless(b"X-A: b\r\n")
    }),
    ("endless chunks", "/config", |_| {
        Answer::Endless(b"4\r\naaaa\r\n")
    }),
    ("endless interim answers", "/config", |_| {
        Answer::Endless(b"HTTP/1.1 100 Continue\r\n\r\n")
    }),
    ("1e300 s", "/get", |_| body(samples("1e300", "0.5", 5))),
    ("-1e300 s", "/get", |_| body(samples("-1e300", "0.5", 5))),
    ("1e400 s", "/get", |_| body(samples("1e400", "0.5", 5))),
    ("1e308 m/s²", "/get", |n| {
        body(samples(&format!("{n}"), "1e308", 5))
    }),
    ("-1e9 m/s²", "/get", |n| {
        body(samples(&format!("{n}"), "-1e9", 5))
    }),
    ("not a number", "/get", |_| {
        body(samples("NaN", "Infinity", 5))
    }),
    ("nulls", "/get", |_| body(samples("null", "null", 1000))),
    ("words", "/get", |_| body(samples("\"1\"", "\"x\"", 5))),
    ("truths", "/get", |_| body(samples("true", "false", 5))),
    ("objects", "/get", |_| body(samples("{}", "[]", 5))),
    ("before the beginning", "/get", |_| {
        body(samples("-50", "0.5", 5))
    }),
    ("always the same time", "/get", |_| {
        body(samples("7", "0.5", 20_000))
    }),
    ("back in time", "/get", |n| {
        body(samples(&format!("{}", 100 - n), "0.5", 3))
    }),
    ("far jumps", "/get", |n| {
        body(samples(&format!("{}", n as f64 * 4e6), "0.5", 3))
    }),
    ("600,000 values", "/get", |_| {
        body(samples_at(
            &(0..600_000)
                .map(|k| format!("{}", f64::from(k) * 1e-3))
                .collect::<Vec<_>>(),
            "1",
        ))
    }),
    ("more values than any", "/get", |_| {
        body(format!(
            r#"{{"buffer":{{"aX":{{"updateMode":"full","buffer":[{}1]}}}},"status":{{"session":"s","measuring":true}}}}"#,
            "1,".repeat(4_000_000)
        ))
    }),
    ("lengths that differ", "/get", |n| {
        body(
            String::from_utf8(samples(&format!("{n}"), "0.5", 5))
                .unwrap()
                .replacen("[0.5,", "[", 1),
        )
    }),
    ("buffers that are missing", "/get", |_| {
        body(r#"{"buffer":{},"status":{"session":"s","measuring":true}}"#)
    }),
    ("a session of a number", "/get", |_| {
        body(r#"{"buffer":{},"status":{"session":5,"measuring":true}}"#)
    }),
    ("a session every time", "/get", |n| {
        body(
            String::from_utf8(samples(&format!("{n}"), "0.5", 2))
                .unwrap()
                .replace("\"s\"", &format!("\"s{n}\"")),
        )
    }),
    ("on and off", "/get", |n| {
        body(
            String::from_utf8(samples(&format!("{n}"), "0.5", 2))
                .unwrap()
                .replace("true", if n % 2 == 0 { "true" } else { "false" }),
        )
    }),
    ("cut off", "/get", |_| {
        body(r#"{"buffer":{"aX":{"updateMode":"partial","buffer":[1,2"#)
    }),
    ("deep", "/get", |_| body("{\"buffer\":".repeat(10_000))),
    ("silent", "/get", |_| Answer::Silence),
    ("dripping", "/get", |_| Answer::Drip),
    ("closed now and then", "/get", |n| {
        if n % 2 == 0 {
            raw("")
        } else {
            ordinary("/get", n)
        }
    }),
    ("600,000 pauses", "/time", |_| {
        body(format!("[{}]", vec![r#"{"event":"PAUSE","experimentTime":1,"systemTime":2},{"event":"START","experimentTime":1,"systemTime":3}"#; 300_000].join(",")))
    }),
    ("a pause of 1e300 s", "/time", |_| {
        body(
            r#"[{"event":"PAUSE","experimentTime":1,"systemTime":2},{"event":"START","experimentTime":1,"systemTime":1e300}]"#,
        )
    }),
    ("pauses of other types", "/time", |_| {
        body(r#"{"event": []}"#)
    }),
    ("silent about pauses", "/time", |_| Answer::Silence),
    ("an export without end", "/export", |_| Answer::Drip),
    ("an export that is none", "/export", |_| {
        body(b"PK\x03\x04\0\0\0\0\xff\xff".to_vec())
    }),
    ("silent about the export", "/export", |_| Answer::Silence),
];
