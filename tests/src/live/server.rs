//! The phone's server on 127.0.0.1.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::phone::Phone;

/// A phone that answers over HTTP until it is dropped.
#[derive(Debug)]
pub struct Server {
    phone: Arc<Mutex<Phone>>,
    /// `http://127.0.0.1:PORT`.
    pub address: String,
    over: Arc<AtomicBool>,
}

impl Server {
    /// Begins to answer.
    ///
    /// # Errors
    /// No free port.
    pub fn start(phone: Phone) -> std::io::Result<Self> {
        let listener = TcpListener::bind("127.0.0.1:0")?;
        let address = format!("http://{}", listener.local_addr()?);
        let phone = Arc::new(Mutex::new(phone));
        let over = Arc::new(AtomicBool::new(false));
        let (shared, ends) = (Arc::clone(&phone), Arc::clone(&over));
        std::thread::spawn(move || {
            for stream in listener.incoming().flatten() {
                if ends.load(Ordering::SeqCst) {
                    return;
                }
                // A connection that breaks is the client's to report.
                let _ = serve(stream, &shared);
            }
        });
        Ok(Self {
            phone,
            address,
            over,
        })
    }

    /// The phone.
    pub fn phone(&self) -> MutexGuard<'_, Phone> {
        lock(&self.phone)
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.over.store(true, Ordering::SeqCst);
        let _ = TcpStream::connect(self.address.trim_start_matches("http://"));
    }
}

fn lock(phone: &Mutex<Phone>) -> MutexGuard<'_, Phone> {
    phone.lock().unwrap_or_else(PoisonError::into_inner)
}

fn serve(mut stream: TcpStream, phone: &Mutex<Phone>) -> std::io::Result<()> {
    let mut request = Vec::new();
    let mut chunk = [0; 2048];
    while !request.windows(4).any(|w| w == b"\r\n\r\n") {
        let count = stream.read(&mut chunk)?;
        if count == 0 {
            return Ok(());
        }
        request.extend(&chunk[..count]);
    }
    let request = String::from_utf8_lossy(&request).into_owned();
    let path = request.split(' ').nth(1).unwrap_or("/");
    let Some(body) = lock(phone).answer(path) else {
        return Ok(());
    };
    let head = format!(
        "HTTP/1.1 200 OK\r\nContent-Type: application/json\r\nContent-Length: {}\r\nAccess-Control-Allow-Origin: *\r\nConnection: close\r\n\r\n",
        body.len()
    );
    stream.write_all(&[head.as_bytes(), &body].concat())
}
