//! The threads that share the work.

use std::num::NonZero;
use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex};
use std::thread;

/// Starts them before there is work, as many as the system grants: under a limit of memory a thread's stack may not fit, and
/// without any the main thread does all of it. Results do not depend on their number.
///
/// A pool that has failed to start once cannot be started again. So its threads are started before it and wait for their part.
pub fn install() {
    let (to_threads, parts) = channel::<rayon::ThreadBuilder>();
    let parts = Arc::new(Mutex::new(parts));
    let start = |_: &usize| {
        let parts = parts.clone();
        let run = move || {
            let part = parts.lock().ok().and_then(|parts| parts.recv().ok());
            if let Some(part) = part {
                part.run();
            }
        };
        thread::Builder::new().spawn(run).is_ok()
    };
    let granted = (0..wanted()).take_while(start).count();
    let pool = rayon::ThreadPoolBuilder::new();
    let _ = match granted {
        0 => pool.num_threads(1).use_current_thread().build_global(),
        count => {
            let hand_over = move |part| {
                let sent = to_threads.send(part);
                sent.map_err(|_| std::io::Error::other("a thread has ended"))
            };
            pool.num_threads(count)
                .spawn_handler(hand_over)
                .build_global()
        }
    };
}

/// One for each processor, or as many as `RAYON_NUM_THREADS` says.
fn wanted() -> usize {
    let said = std::env::var("RAYON_NUM_THREADS").ok();
    let said = said
        .and_then(|text| text.parse().ok())
        .filter(|count| *count > 0);
    let count = said.unwrap_or_else(|| thread::available_parallelism().map_or(1, NonZero::get));
    count.min(rayon::max_num_threads())
}
