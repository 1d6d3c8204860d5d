//! What a stage has to say about its input.

use std::borrow::Cow;

use crate::EntityRef;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Worth knowing; nothing was changed.
    Info,
    /// Something was repaired, guessed or left out that does not change the shape.
    Warning,
    /// Something is missing from the result.
    Error,
}

impl Severity {
    /// `info`, `warning`, `error`.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Info => "info",
            Self::Warning => "warning",
            Self::Error => "error",
        }
    }
}

/// One statement about the input, in a sentence that a CAD user understands.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// Stable kebab-case code, e.g. `edge-off-surface`.
    pub code: &'static str,
    /// The entity at fault.
    pub entity: EntityRef,
    /// The face it concerns, if any.
    pub face: Option<EntityRef>,
    /// One sentence.
    pub message: Cow<'static, str>,
}

impl Diagnostic {
    /// A diagnostic that concerns no face in particular.
    pub fn new(
        severity: Severity,
        code: &'static str,
        entity: EntityRef,
        message: impl Into<Cow<'static, str>>,
    ) -> Self {
        Self { severity, code, entity, face: None, message: message.into() }
    }

    /// The same, about `face`.
    pub fn on_face(mut self, face: EntityRef) -> Self {
        self.face = Some(face);
        self
    }
}

/// The diagnostics of a stage, in file order.
pub type Diagnostics = Vec<Diagnostic>;
