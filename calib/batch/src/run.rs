//! All devices of a shard: as many at a time as there are cores, each for itself.
//!
//! Every worker owns a pool of threads, so that a device that never ends takes one worker with it and nothing else: after the
//! budget its record says so, and another worker takes its place. Memory is that of the devices in work.

use std::collections::VecDeque;
use std::panic::AssertUnwindSafe;
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::device::{Computed, Options, empty, refused};
use findings::{Finding, Front, Kind};

use crate::error::Error;
use crate::manifest::{Device, Manifest};
use crate::record::{Record, Status, Timing};
use crate::shard::Shard;
use crate::store::Store;

/// Devices, options and resources of one run.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The devices.
    pub manifest: Manifest,
    /// Shard of the manifest to run.
    pub shard: Shard,
    /// Calibration options.
    pub options: Options,
    /// Keep what is complete and made from the same.
    pub resume: bool,
    /// Devices at a time.
    pub jobs: usize,
    /// Longest time for a device.
    pub budget: Duration,
}

/// One more device is done.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'a> {
    /// Its record.
    pub record: &'a Record,
    /// True if a complete result was found and kept.
    pub resumed: bool,
    /// Devices done.
    pub done: usize,
    /// Number of devices to do.
    pub of: usize,
}

/// Runs a shard: the records in the order of the manifest, and how long each took.
///
/// # Errors
/// [`Error::Output`] where the result of a device cannot be written. Everything else is in its record.
pub fn run(
    plan: &Plan,
    store: &Store,
    progress: impl Fn(Progress<'_>) + Sync,
) -> Result<Vec<(Record, Timing)>, Error> {
    let options = Arc::new(plan.options.clone());
    let compute =
        move |device: &Device, index: usize, key: String| options.compute(device, index, key);
    run_with(plan, store, Arc::new(compute), progress)
}

type Compute = dyn Fn(&Device, usize, String) -> Computed + Send + Sync;

pub(crate) fn run_with(
    plan: &Plan,
    store: &Store,
    compute: Arc<Compute>,
    progress: impl Fn(Progress<'_>) + Sync,
) -> Result<Vec<(Record, Timing)>, Error> {
    let own = plan.manifest.devices.iter().enumerate();
    let own: VecDeque<(usize, &Device)> = own.filter(|(k, _)| plan.shard.has(*k)).collect();
    let of = own.len();
    let jobs = plan.jobs.clamp(1, of.max(1));
    let threads = (plan.jobs / jobs).max(1);
    let waiting = Mutex::new(own);
    let found: Mutex<Vec<(Record, Timing)>> = Mutex::new(Vec::with_capacity(of));
    let failure: Mutex<Option<Error>> = Mutex::new(None);
    let work = || {
        let mut pool = None;
        loop {
            // In a statement of its own: the lock must not be held while the device is computed.
            let next = lock(&waiting).pop_front();
            let Some((index, device)) = next else { break };
            let begin = Instant::now();
            match one(plan, store, &compute, &mut pool, threads, (index, device)) {
                Ok((record, resumed)) => {
                    let seconds = if resumed {
                        0.0
                    } else {
                        begin.elapsed().as_secs_f64()
                    };
                    let mut found = lock(&found);
                    let done = found.len() + 1;
                    progress(Progress {
                        record: &record,
                        resumed,
                        done,
                        of,
                    });
                    let id = device.id.clone();
                    found.push((
                        record,
                        Timing {
                            index,
                            id,
                            seconds,
                            resumed,
                        },
                    ));
                }
                Err(error) => {
                    lock(&waiting).clear();
                    lock(&failure).get_or_insert(error);
                }
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..jobs {
            scope.spawn(work);
        }
        work();
    });
    if let Some(error) = lock(&failure).take() {
        return Err(error);
    }
    let mut found = found.into_inner().unwrap_or_else(PoisonError::into_inner);
    found.sort_by_key(|(record, _)| record.index);
    Ok(found)
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// One device, and whether it was found complete.
fn one(
    plan: &Plan,
    store: &Store,
    compute: &Arc<Compute>,
    pool: &mut Option<ThreadPool>,
    threads: usize,
    (index, device): (usize, &Device),
) -> Result<(Record, bool), Error> {
    let computed = match plan.options.key(device) {
        Ok(key) => {
            if plan.resume
                && let Some(record) = store.complete(&device.id, index, &key)
            {
                return Ok((record, true));
            }
            within_budget(plan, compute, pool, threads, (index, device, key))
        }
        Err(error) => {
            let reason = error.finding().text(Front::CommandLine);
            Computed {
                record: refused(empty(device, index, String::new()), Status::Input, reason),
                calibration: None,
            }
        }
    };
    // What an earlier run has found of a device that cannot be read now stays, and counts once it can be.
    let is_unread = computed.record.key.is_empty();
    if !(plan.resume && is_unread && store.holds(&device.id)) {
        store.write(&computed)?;
    }
    Ok((computed.record, false))
}

/// Computes a device on the worker's pool; a pool that does not come back in time is left to itself.
fn within_budget(
    plan: &Plan,
    compute: &Arc<Compute>,
    pool: &mut Option<ThreadPool>,
    threads: usize,
    (index, device, key): (usize, &Device, String),
) -> Computed {
    let without = |status: Status, found: Finding| Computed {
        record: refused(
            empty(device, index, key.clone()),
            status,
            found.text(Front::CommandLine),
        ),
        calibration: None,
    };
    let workers = match pool.take().map_or_else(|| new_pool(threads), Ok) {
        Ok(workers) => workers,
        Err(error) => {
            let found = Finding::of(Kind::NO_THREAD).detail("reason", error.to_string());
            return without(Status::Output, found);
        }
    };
    let (send, receive) = sync_channel(1);
    let (work, own, own_key) = (Arc::clone(compute), device.clone(), key.clone());
    workers.spawn(move || {
        let computed = std::panic::catch_unwind(AssertUnwindSafe(|| work(&own, index, own_key)));
        let _ = send.send(computed.map_err(|panic| words_of(panic.as_ref())));
    });
    match receive.recv_timeout(plan.budget) {
        Ok(Ok(computed)) => {
            *pool = Some(workers);
            computed
        }
        Ok(Err(words)) => {
            *pool = Some(workers);
            without(
                Status::Bug,
                Finding::of(Kind::BUG_OF_OURS).detail("reason", words),
            )
        }
        Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => {
            let found = Finding::of(Kind::OVER_BUDGET);
            let seconds = plan.budget.as_secs_f64();
            without(
                Status::Budget,
                found.detail("seconds", format!("{seconds} s")),
            )
        }
    }
}

fn new_pool(threads: usize) -> Result<ThreadPool, rayon::ThreadPoolBuildError> {
    ThreadPoolBuilder::new().num_threads(threads).build()
}

/// Returns the message of a panic.
fn words_of(panic: &(dyn std::any::Any + Send)) -> String {
    let words = panic.downcast_ref::<String>().map(String::as_str);
    let words = words.or_else(|| panic.downcast_ref::<&str>().copied());
    words.unwrap_or("a panic").to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::manifest::DeviceOptions;
    use calib::calibrate::Request;
    use calib::recording::ReadOptions;

    fn plan(folder: &std::path::Path, ids: &[&str]) -> Plan {
        let device = |id: &&str| {
            let path = folder.join(id);
            std::fs::write(&path, *id).unwrap();
            Device {
                id: (*id).into(),
                inputs: vec![path],
                lot: None,
                station: None,
                time: None,
                options: DeviceOptions::default(),
            }
        };
        Plan {
            manifest: Manifest {
                devices: ids.iter().map(device).collect(),
            },
            shard: Shard::default(),
            options: Options {
                request: Request::default(),
                read: ReadOptions::default(),
                discover: None,
                limits: None,
                prior: None,
                text: "test".into(),
            },
            resume: true,
            jobs: 2,
            // Printing a panic takes long on a busy machine.
            budget: Duration::from_secs(4),
        }
    }

    #[test]
    fn a_panic_and_an_endless_device_end_alone() {
        let dir = tempfile::tempdir().unwrap();
        let plan = plan(dir.path(), &["a", "panics", "b", "endless", "c"]);
        let store = Store::new(dir.path().join("out"));
        let compute = |device: &Device, index: usize, key: String| {
            match device.id.as_str() {
                "panics" => panic!("index {index}"),
                "endless" => loop {
                    std::thread::sleep(Duration::from_secs(1));
                },
                _ => {}
            }
            Computed {
                record: empty(device, index, key),
                calibration: None,
            }
        };
        let found = run_with(&plan, &store, Arc::new(compute), |_| {}).unwrap();
        let all: Vec<(&str, Status)> = found
            .iter()
            .map(|(r, _)| (r.id.as_str(), r.status))
            .collect();
        use Status::{Budget, Bug, Pass};
        let expected = [
            ("a", Pass),
            ("panics", Bug),
            ("b", Pass),
            ("endless", Budget),
            ("c", Pass),
        ];
        assert_eq!(all, expected);
        assert!(found[1].0.reasons[0].contains("index 1"));
    }

    /// A device whose calibration is `x`.
    fn calibrated(device: &Device, index: usize, key: String) -> Computed {
        Computed {
            record: Record {
                cal_sha256: Some(crate::hash::of_text("x")),
                ..empty(device, index, key)
            },
            calibration: Some("x".into()),
        }
    }

    #[test]
    fn what_is_complete_is_kept_and_what_changed_is_computed_again() {
        let dir = tempfile::tempdir().unwrap();
        let plan = plan(dir.path(), &["a", "b", "c"]);
        let store = Store::new(dir.path().join("out"));
        let resumed = || {
            let found = run_with(&plan, &store, Arc::new(calibrated), |_| {}).unwrap();
            found.iter().map(|(_, t)| t.resumed).collect::<Vec<_>>()
        };
        assert_eq!(resumed(), [false; 3]);
        assert_eq!(resumed(), [true; 3]);
        std::fs::write(dir.path().join("b"), "changed").unwrap();
        assert_eq!(resumed(), [true, false, true]);
        std::fs::write(store.device("c").join("cal.json"), "").unwrap();
        assert_eq!(
            resumed(),
            [true, true, false],
            "a file cut by a power failure"
        );
    }

    #[cfg(unix)]
    #[test]
    fn what_was_found_of_a_device_stays_while_the_device_cannot_be_read() {
        let dir = tempfile::tempdir().unwrap();
        let plan = plan(dir.path(), &["a"]);
        let store = Store::new(dir.path().join("out"));
        let run = || run_with(&plan, &store, Arc::new(calibrated), |_| {}).unwrap();
        run();
        let (input, aside) = (dir.path().join("a"), dir.path().join("aside"));
        std::fs::rename(&input, &aside).unwrap();
        // A circle of links fails as a broken disk does.
        std::os::unix::fs::symlink("a", &input).unwrap();
        assert_eq!(run()[0].0.status, Status::Input);
        assert!(store.device("a").join("cal.json").exists());
        std::fs::rename(&aside, &input).unwrap();
        assert!(run()[0].1.resumed);
    }
}
