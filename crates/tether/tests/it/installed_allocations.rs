//! A step of structure and tethers takes no memory.

use crate::installed_example as example;

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use windlass_model::ClassError;
use windlass_tether::compatibility::Compatibility;
use windlass_tether::installed::{Installation, InstalledObserver, Moment};

thread_local! {
    static TAKEN: Cell<usize> = const { Cell::new(0) };
}

/// Counts what this thread asks for.
struct Counting;

// SAFETY: every call goes on to the system's allocator as it came
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let _ = TAKEN.try_with(|taken| taken.set(taken.get() + 1));
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Remembers the count at the second and at the last state.
#[derive(Default)]
struct AllocationCounts([usize; 2]);

impl InstalledObserver for AllocationCounts {
    fn observe(&mut self, moment: &Moment) -> Result<(), ClassError> {
        let now = TAKEN.with(Cell::get);
        if moment.state == 1 {
            self.0[0] = now;
        }
        self.0[1] = now;
        Ok(())
    }
}

#[test]
fn tether_step_allocates_no_memory() {
    let (flow, mut platform) = (example::water(), example::platform(Compatibility::aqwa_5_4()));
    let mut counts = AllocationCounts::default();
    let mut installation =
        Installation::new(&mut platform, example::tethers(), &flow, Compatibility::aqwa_5_4()).unwrap();
    installation.run(&example::course(), &mut counts).unwrap();
    assert!(counts.0[0] > 0);
    assert_eq!(counts.0[1] - counts.0[0], 0);
}
