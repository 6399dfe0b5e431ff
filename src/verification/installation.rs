//! What stands at the head of a page of verification: program, commit, machine, date.

use std::thread::available_parallelism;

/// What was verified, where and when.
#[derive(Clone, Debug, PartialEq)]
pub struct Installation {
    /// Version of windlass.
    pub version: &'static str,
    /// Commit of its source.
    pub commit: &'static str,
    /// Whether the build is optimised.
    pub build: &'static str,
    /// Name, system and processor of the machine.
    pub machine: String,
    /// Date and time (UTC).
    pub date: String,
}

impl Installation {
    /// This program on this machine, now.
    pub fn here() -> Installation {
        let now = time::OffsetDateTime::now_utc();
        Installation {
            version: env!("CARGO_PKG_VERSION"),
            commit: env!("WINDLASS_COMMIT"),
            build: if cfg!(debug_assertions) { "debug build" } else { "release build" },
            machine: machine(),
            date: format!("{} {:02}:{:02} UTC", now.date(), now.hour(), now.minute()),
        }
    }

    /// The head of a page, a line each.
    pub fn lines(&self) -> [(&'static str, String); 4] {
        [
            ("Version", format!("windlass {}, {}", self.version, self.build)),
            ("Commit", self.commit.to_string()),
            ("Machine", self.machine.clone()),
            ("Date", self.date.clone()),
        ]
    }
}

/// Name, system, processor and its number of threads.
fn machine() -> String {
    let threads = available_parallelism().map_or(1, usize::from);
    let of = |name: &str| format!("{name} {}", std::env::consts::ARCH);
    let (system, name) = system_and_name().unwrap_or_else(|| (of(std::env::consts::OS), String::new()));
    let processor = processor().unwrap_or_else(|| std::env::consts::ARCH.to_string());
    let parts = [name, system, processor, format!("{threads} threads")];
    parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", ")
}

#[cfg(unix)]
fn system_and_name() -> Option<(String, String)> {
    let known = rustix::system::uname();
    let text = |part: &std::ffi::CStr| part.to_string_lossy().into_owned();
    let system = format!("{} {} {}", text(known.sysname()), text(known.release()), text(known.machine()));
    Some((system, text(known.nodename())))
}

#[cfg(not(unix))]
fn system_and_name() -> Option<(String, String)> {
    None
}

/// The name of the processor, where the system gives it in a file.
fn processor() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    line.split_once(':').map(|(_, name)| name.trim().to_string()).filter(|name| !name.is_empty())
}
