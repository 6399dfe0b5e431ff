//! Work beside the interpreter: on a thread of its own, so that Ctrl-C is seen while it goes on.

use crate::errors::of_panic;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread::{Builder, scope};
use std::time::Duration;

/// How often signals are looked for.
const SIGNAL_INTERVAL: Duration = Duration::from_millis(50);
/// Stack of the thread (bytes): as much as the main thread of a program usually has, twice over.
const STACK: usize = 16 << 20;

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
