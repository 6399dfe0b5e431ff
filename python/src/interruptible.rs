//! Work beside the interpreter: on a thread of its own, so that Ctrl-C is seen while it goes on.

use crate::errors::{detached, of_panic};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread::{Builder, scope};
use std::time::{Duration, Instant};

/// How often signals are looked for.
const SIGNAL_INTERVAL: Duration = Duration::from_millis(50);
/// Stack of the thread (bytes): as much as the main thread of a program usually has, twice over.
const STACK: usize = 16 << 20;

/// Of how many things the first part of a batch is; a batch that is no larger runs on the thread of its caller.
const FIRST_PART: usize = 1 << 12;
/// How long a part of a batch is to take: between two of them Ctrl-C is looked for.
const PART_TIME: Duration = Duration::from_millis(100);

/// What is made of each of so many things, in their order: by `make` on one core, or on all where there are enough for tasks of `task` things. At
/// Ctrl-C what is left is not made.
///
/// # Errors
/// What a signal handler raised; a panic of `make`; no thread to be had.
pub fn make_each<T: Send>(
    py: Python<'_>,
    count: usize,
    (threads, task): (usize, usize),
    make: impl Fn(usize) -> T + Sync + Send,
) -> PyResult<Vec<T>> {
    let mut made = Vec::new();
    let add = |made: &mut Vec<T>, range: Range<usize>| {
        if threads == 1 || range.len() <= task {
            made.extend(range.map(&make));
        } else {
            made.par_extend(range.into_par_iter().with_min_len(task).map(&make));
        }
    };
    if count <= FIRST_PART {
        return detached(py, || {
            add(&mut made, 0..count);
            made
        });
    }
    let stop = AtomicBool::new(false);
    run(py, &stop, || {
        made.reserve_exact(count);
        let mut part = FIRST_PART;
        while made.len() < count && !stop.load(Ordering::Relaxed) {
            let (begun, from) = (Instant::now(), made.len());
            add(&mut made, from..count.min(from + part));
            // parts are as large as time allows, for less is spent between them
            let took = begun.elapsed();
            if took < PART_TIME / 2 {
                part *= 2;
            } else if took > PART_TIME {
                part = (part / 2).max(task);
            }
        }
        made
    })
}

/// What `work` returns. It runs without the interpreter; at Ctrl-C `stop` is set, `work` is waited for, and `KeyboardInterrupt` is raised.
///
/// # Errors
/// What a signal handler raised; a panic of `work`; no thread to be had.
pub fn run<T: Send>(py: Python<'_>, stop: &AtomicBool, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    let (ended, raised) = py.detach(|| {
        scope(|scope| {
            let (done, waited) = channel::<()>();
            let thread = Builder::new().name("windlass".into()).stack_size(STACK).spawn_scoped(scope, move || {
                // dropped when the work ends, by a panic too
                let _done = done;
                work()
            });
            let thread = match thread {
                Ok(thread) => thread,
                Err(error) => return (Err(error), None),
            };
            let mut raised = None;
            while let Err(RecvTimeoutError::Timeout) = waited.recv_timeout(SIGNAL_INTERVAL) {
                if raised.is_none()
                    && let Err(error) = Python::attach(|py| py.check_signals())
                {
                    stop.store(true, Ordering::Relaxed);
                    raised = Some(error);
                }
            }
            (Ok(thread.join()), raised)
        })
    });
    let ended = ended.map_err(|error| PyRuntimeError::new_err(format!("no thread to work on: {error}")))?;
    match (ended, raised) {
        (_, Some(error)) => Err(error),
        (Ok(value), None) => Ok(value),
        (Err(panic), None) => Err(of_panic(py, panic)),
    }
}
