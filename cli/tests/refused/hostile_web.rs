//! Web clients that mean no good, on the page of a session whose phone does not answer: each gets its refusal or nothing, and a
//! browser its page in the meantime.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{Shutdown, SocketAddr, TcpListener, TcpStream};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// The page answers a browser within this, whoever else is there.
const SOON: Duration = Duration::from_secs(1);
/// Connections of each kind at once.
const CROWD: usize = 12;

/// Requests with what they are answered: the beginning of the answer, nothing where any or none will do. `HOST` and `TOKEN`
/// stand for those of the page.
const REQUESTS: [(&str, &str, &str); 31] = [
    ("says nothing", "", ""),
    ("half a request line", "GET /TOK", ""),
    (
        "no end of headers",
        "GET /TOKEN/ HTTP/1.1\r\nHost: HOST\r\nX-A: b\r\n",
        "",
    ),
    ("no host", "GET /TOKEN/ HTTP/1.1\r\n\r\n", "HTTP/1.1 403"),
    (
        "another host",
        "GET /TOKEN/ HTTP/1.1\r\nHost: evil.example\r\n\r\n",
        "HTTP/1.1 403",
    ),
    (
        "two hosts",
        "GET /TOKEN/ HTTP/1.1\r\nHost: HOST\r\nHost: evil.example\r\n\r\n",
        "HTTP/1.1 403",
    ),
    (
        "the same host twice",
        "GET /TOKEN/ HTTP/1.1\r\nHost: HOST\r\nHost: HOST\r\n\r\n",
        "HTTP/1.1 403",
    ),
    (
        "a host with a user",
        "GET /TOKEN/ HTTP/1.1\r\nHost: me@HOST\r\n\r\n",
        "HTTP/1.1 403",
    ),
    (
        "a host with an end",
        "GET /TOKEN/ HTTP/1.1\r\nHost: HOST.evil.example\r\n\r\n",
        "HTTP/1.1 403",
    ),
    (
        "a host without its port",
        "GET /TOKEN/ HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n",
        "HTTP/1.1 403",
    ),
    (
        "no token",
        "GET / HTTP/1.1\r\nHost: HOST\r\n\r\n",
        "HTTP/1.1 404",
    ),
    (
        "a wrong token",
        "GET /00000000000000000000000000000000/state HTTP/1.1\r\nHost: HOST\r\n\r\n",
        "HTTP/1.1 404",
    ),
    (
        "an empty token",
        "GET //state HTTP/1.1\r\nHost: HOST\r\n\r\n",
        "HTTP/1.1 404",
    ),
    (
        "up the folders",
        "GET /TOKEN/../../../etc/passwd HTTP/1.1\r\nHost: HOST\r\n\r\n",
        "HTTP/1.1 404",
    ),
    (
        "up in disguise",
        "GET /TOKEN/%2e%2e/%2e%2e/etc/passwd HTTP/1.1\r\nHost: HOST\r\n\r\n",
        "HTTP/1.1 404",
    ),
    (
        "up with backslashes",
        "GET /TOKEN/..\\..\\etc HTTP/1.1\r\nHost: HOST\r\n\r\n",
        "HTTP/1.1 404",
    ),
    (
        "a whole address",
        "GET http://evil.example/ HTTP/1.1\r\nHost: HOST\r\n\r\n",
        "HTTP/1.1 404",
    ),
    (
        "a query",
        "GET /TOKEN/state?x=1 HTTP/1.1\r\nHost: HOST\r\n\r\n",
        "HTTP/1.1 404",
    ),
    (
        "post",
        "POST /TOKEN/ HTTP/1.1\r\nHost: HOST\r\nContent-Length: 0\r\n\r\n",
        "HTTP/1.1 405",
    ),
    (
        "connect",
        "CONNECT evil.example:443 HTTP/1.1\r\nHost: HOST\r\n\r\n",
        "HTTP/1.1 405",
    ),
    (
        "a method of its own",
        "STEAL /TOKEN/ HTTP/1.1\r\nHost: HOST\r\n\r\n",
        "HTTP/1.1 405",
    ),
    (
        "a body that never comes",
        "GET /TOKEN/ HTTP/1.1\r\nHost: HOST\r\nContent-Length: 999999999999\r\n\r\n",
        "HTTP/1.1 200",
    ),
    (
        "a negative length",
        "GET /TOKEN/ HTTP/1.1\r\nHost: HOST\r\nContent-Length: -1\r\n\r\n",
        "HTTP/1.1 200",
    ),
    (
        "two lengths",
        "GET /TOKEN/ HTTP/1.1\r\nHost: HOST\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\nab",
        "HTTP/1.1 200",
    ),
    (
        "chunks",
        "GET /TOKEN/ HTTP/1.1\r\nHost: HOST\r\nTransfer-Encoding: chunked\r\n\r\nffffffff\r\n",
        "HTTP/1.1 200",
    ),
    (
        "wants to be asked",
        "GET /TOKEN/ HTTP/1.1\r\nHost: HOST\r\nExpect: 100-continue\r\n\r\n",
        "HTTP/1.1 200",
    ),
    (
        "another protocol",
        "GET /TOKEN/ HTTP/1.1\r\nHost: HOST\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\r\n",
        "HTTP/1.1 200",
    ),
    ("the oldest protocol", "GET /TOKEN/\r\n\r\n", "HTTP/1.1 400"),
    (
        "the next protocol",
        "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
        "HTTP/1.1 400",
    ),
    ("nulls", "\0\0\0\0\r\n\r\n", "HTTP/1.1 400"),
    (
        "encrypted",
        "\u{16}\u{3}\u{1}\u{2}\0\u{1}\0\r\n\r\n",
        "HTTP/1.1 400",
    ),
];

/// A session with `--web`, and its page.
struct Page {
    session: Child,
    address: SocketAddr,
    token: String,
    _folder: tempfile::TempDir,
}

const CONFIG: &str = r#"{"title": "Raw", "inputs": [
    {"source": "accelerometer", "outputs": [{"x": "aX"}, {"y": "aY"}, {"z": "aZ"}, {"t": "aT"}]},
    {"source": "gyroscope", "outputs": [{"x": "gX"}, {"y": "gY"}, {"z": "gZ"}, {"t": "gT"}]}]}"#;

/// A phone that says what it has and then nothing any more.
fn hanging_phone() -> SocketAddr {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap();
    std::thread::spawn(move || {
        let (mut first, _) = listener.accept().unwrap();
        let _ = first.read(&mut [0; 4096]);
        let head = format!(
            "HTTP/1.1 200 OK\r\nContent-Length: {}\r\n\r\n",
            CONFIG.len()
        );
        let _ = first.write_all(format!("{head}{CONFIG}").as_bytes());
        let silent: Vec<_> = listener.incoming().collect();
        drop(silent);
    });
    address
}

impl Page {
    fn start() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let mut session = Command::new(env!("CARGO_BIN_EXE_stillpoint"))
            .args(["live", &hanging_phone().to_string(), "--web"])
            .current_dir(folder.path())
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut said = BufReader::new(session.stderr.take().unwrap()).lines();
        let mut line =
            said.find_map(|line| Some(line.ok()?.split_once("open http://")?.1.to_owned()));
        let line = line.take().unwrap();
        let (address, token) = line.split_once('/').unwrap();
        let token = token.split('/').next().unwrap().to_owned();
        // What is said later goes nowhere.
        std::thread::spawn(move || said.count());
        Self {
            session,
            address: address.parse().unwrap(),
            token,
            _folder: folder,
        }
    }

    fn filled(&self, text: &str) -> Vec<u8> {
        let text = text.replace("HOST", &self.address.to_string());
        text.replace("TOKEN", &self.token).into_bytes()
    }

    fn connection(&self) -> TcpStream {
        let stream = TcpStream::connect(self.address).unwrap();
        stream
            .set_read_timeout(Some(Duration::from_secs(10)))
            .unwrap();
        stream
            .set_write_timeout(Some(Duration::from_secs(10)))
            .unwrap();
        stream
    }

    /// A connection that has sent `text`, as far as it is taken.
    fn sent(&self, text: &[u8]) -> TcpStream {
        let mut stream = self.connection();
        let _ = stream.write_all(text);
        stream
    }

    /// How long a browser waits for the page.
    fn browser_waits(&self) -> Duration {
        let begin = Instant::now();
        let request = self.filled("GET /TOKEN/state HTTP/1.1\r\nHost: HOST\r\n\r\n");
        let answer = answer(self.sent(&request));
        assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
        begin.elapsed()
    }
}

impl Drop for Page {
    fn drop(&mut self) {
        let _ = self.session.kill();
        let _ = self.session.wait();
    }
}

fn answer(mut stream: TcpStream) -> String {
    let mut answer = Vec::new();
    let _ = stream.read_to_end(&mut answer);
    String::from_utf8_lossy(&answer).into_owned()
}

#[test]
fn crowds_of_hostile_clients_are_refused_and_keep_no_browser_waiting() {
    let page = Page::start();
    for (name, request, expected) in REQUESTS {
        let request = page.filled(request);
        let crowd: Vec<TcpStream> = (0..CROWD).map(|_| page.sent(&request)).collect();
        let waited = page.browser_waits();
        assert!(waited < SOON, "{name}: {waited:?}");
        if !expected.is_empty() {
            for one in crowd {
                let answer = answer(one);
                assert!(answer.starts_with(expected), "{name}: {answer}");
                assert!(!answer.contains("root:"), "{name}: {answer}");
            }
        }
    }
}

#[test]
fn requests_without_end_are_cut_and_keep_no_browser_waiting() {
    let page = Page::start();
    let long = [
        (
            "a long path",
            format!("GET /{} HTTP/1.1\r\n", "a".repeat(1 << 20)),
        ),
        (
            "a long header",
            format!("GET /TOKEN/ HTTP/1.1\r\nX: {}", "a".repeat(1 << 20)),
        ),
        (
            "many headers",
            format!("GET /TOKEN/ HTTP/1.1\r\n{}", "X: y\r\n".repeat(100_000)),
        ),
        ("a long word", "\r".repeat(1 << 20)),
        (
            "many requests",
            "GET /TOKEN/ HTTP/1.1\r\nHost: HOST\r\n\r\n".repeat(2_000),
        ),
        (
            "a long body",
            format!(
                "GET /TOKEN/ HTTP/1.1\r\nHost: HOST\r\n\r\n{}",
                "a".repeat(1 << 20)
            ),
        ),
    ];
    for (name, request) in long {
        let request = page.filled(&request);
        let crowd: Vec<TcpStream> = (0..3).map(|_| page.sent(&request)).collect();
        let waited = page.browser_waits();
        assert!(waited < SOON, "{name}: {waited:?}");
        drop(crowd);
    }
}

#[test]
fn connections_that_drip_break_or_flood_keep_no_browser_waiting() {
    let page = Page::start();
    let over = AtomicBool::new(false);
    let request = page.filled("GET /TOKEN/ HTTP/1.1\r\nHost: HOST\r\n");
    std::thread::scope(|scope| {
        for _ in 0..CROWD {
            let mut slow = page.connection();
            let (request, over) = (&request, &over);
            scope.spawn(move || {
                for byte in request.iter().cycle() {
                    let done = over.load(Ordering::SeqCst) || slow.write_all(&[*byte]).is_err();
                    if done {
                        return;
                    }
                    std::thread::sleep(Duration::from_millis(20));
                }
            });
        }
        let mut worst = page.browser_waits();
        // Gone at once, gone by half, and gone without having read.
        for _ in 0..50 {
            drop(page.connection());
            let half = page.connection();
            half.shutdown(Shutdown::Write).unwrap();
            drop(page.sent(&page.filled("GET /TOKEN/ HTTP/1.1\r\nHost: HOST\r\n\r\n")));
        }
        worst = worst.max(page.browser_waits());
        // As many as there may be files.
        let crowd: Vec<TcpStream> = (0..300).map(|_| page.connection()).collect();
        worst = worst.max(page.browser_waits());
        drop(crowd);
        for _ in 0..700 {
            drop(page.connection());
        }
        worst = worst.max(page.browser_waits());
        over.store(true, Ordering::SeqCst);
        assert!(worst < SOON, "{worst:?}");
    });
}
