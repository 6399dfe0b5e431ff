//! The C interface of windlass, declared in `include/windlass.h`.
//!
//! The exported functions are in `calls`, the only file with unsafe code: it turns pointers into slices, strings and handles, and nothing
//! else. What a handle holds is here, as types that Rust code can use and test. No panic leaves a call.
//!
//! # Example
//! ```
//! let mut session = windlass_capi::CSession::new("job");
//! assert!(session.run("&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100"));
//! assert!(!session.run("&ENV -DEPTH deep"));
//! assert_eq!(session.error_place(), Some((1, 13)));
//! ```

#![deny(unsafe_code)]
#![deny(missing_docs)]

mod calls;
mod session;

pub use session::{CColumn, CSession, CTable};
