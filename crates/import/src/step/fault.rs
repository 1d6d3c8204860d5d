//! Why an entity could not be understood.

use trimloop_brep::{Diagnostic, EntityRef, Severity};

/// Why an entity could not be understood, in words that follow "the face is lost because".
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Fault {
    /// The entity at fault.
    pub entity: EntityRef,
    /// One sentence that names it.
    pub message: String,
}

impl Fault {
    /// The entity `#id` has this fault; the message is prefixed with its name.
    pub fn new(id: u64, message: impl AsRef<str>) -> Self {
        Self { entity: EntityRef::Step(id), message: format!("#{id} {}", message.as_ref()) }
    }

    /// The fault as a warning: no face is the worse for it.
    pub fn warning(&self, code: &'static str) -> Diagnostic {
        Diagnostic::new(Severity::Warning, code, self.entity, self.message.clone())
    }

    /// The fault as an error diagnostic.
    pub fn diagnostic(&self, code: &'static str) -> Diagnostic {
        Diagnostic::new(Severity::Error, code, self.entity, self.message.clone())
    }
}

/// A value, or why there is none.
pub(crate) type Outcome<T> = Result<T, Fault>;
