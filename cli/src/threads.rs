//! The threads that share the work.

/// Starts them before there is work, with as many as the system grants: under a limit of memory a thread's stack may not
/// fit, and then the main thread does all of it. Results do not depend on their number.
pub fn install() {
    let threads = rayon::ThreadPoolBuilder::new();
    if threads.build_global().is_err() {
        let alone = rayon::ThreadPoolBuilder::new().num_threads(1);
        let _ = alone.use_current_thread().build_global();
    }
}
