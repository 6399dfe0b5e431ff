//! Files that are read: regular ones alone, opened without waiting for anybody, and up to a size.

use std::fs::File;
use std::io::{Error, Read, Result};
use std::path::Path;

/// Opens a regular file to be read. A pipe, a device or a file of the kernel (`/proc`, `/sys`) is refused, and never waited for.
///
/// # Errors
/// What the system refuses; a file that is not regular.
pub fn open_regular(path: &Path) -> Result<File> {
    let file = open_file(path)?;
    if !file.metadata()?.is_file() || is_of_kernel(&file) {
        return Err(Error::other("this is not a regular file"));
    }
    Ok(file)
}

/// The bytes of a regular file of at most so many.
///
/// # Errors
/// As [`open_regular`]; a file that is larger.
pub fn read_regular(path: &Path, largest: u64) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open_regular(path)?.take(largest + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > largest {
        return Err(Error::other(format!("it has more than {largest} bytes")));
    }
    Ok(bytes)
}

#[cfg(unix)]
fn open_file(path: &Path) -> Result<File> {
    use std::os::unix::fs::OpenOptionsExt;
    // a pipe that nobody writes to would be waited for
    let nonblock = i32::try_from(rustix::fs::OFlags::NONBLOCK.bits()).unwrap_or_default();
    std::fs::OpenOptions::new().read(true).custom_flags(nonblock).open(path)
}

#[cfg(not(unix))]
fn open_file(path: &Path) -> Result<File> {
    File::open(path)
}

/// Whether a file is made by the kernel as it is read: such a file has no size, and may wait for events.
#[cfg(target_os = "linux")]
fn is_of_kernel(file: &File) -> bool {
    // procfs, sysfs, debugfs, tracefs, as <linux/magic.h> has them
    const KERNEL: [u64; 4] = [0x9fa0, 0x6265_6572, 0x6462_6720, 0x7472_6163];
    rustix::fs::fstatfs(file).is_ok_and(|system| u64::try_from(system.f_type).is_ok_and(|kind| KERNEL.contains(&kind)))
}

#[cfg(not(target_os = "linux"))]
fn is_of_kernel(_: &File) -> bool {
    false
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn pipe_device_folder_and_kernel_file_are_refused_without_blocking() {
        let dir = tempfile::tempdir().unwrap();
        let fifo = dir.path().join("fifo");
        assert!(std::process::Command::new("mkfifo").arg(&fifo).status().unwrap().success());
        let mut refused = vec![fifo, dir.path().into(), "/dev/zero".into(), "/dev/null".into()];
        if cfg!(target_os = "linux") {
            refused.extend(["/proc/self/status".into(), "/proc/kmsg".into(), "/sys/kernel/notes".into()]);
        }
        for path in refused.iter().filter(|path| path.exists()) {
            assert!(read_regular(path, 10).is_err(), "{}", path.display());
        }
    }

    #[test]
    fn file_is_read_up_to_size_limit() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("file");
        std::fs::write(&file, "12345").unwrap();
        assert_eq!(read_regular(&file, 5).unwrap(), b"12345");
        assert!(read_regular(&file, 4).unwrap_err().to_string().contains("more than 4 bytes"));
    }
}
