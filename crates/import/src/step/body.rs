//! Solids, shells and surface models: which faces belong together.

use rustc_hash::FxHashSet;
use trimloop_brep::{Body, BodyKind, Diagnostic, Severity, Shell, ShellFace};

use super::context::Context;
use super::fault::Outcome;
use super::keyword::Kind;
use super::look::Look;
use super::part_builder::PartBuilder;

/// How many oriented shells may be wrapped around each other.
const MAX_WRAPPING: usize = 16;

impl PartBuilder<'_> {
    /// `manifold_solid_brep`, `faceted_brep` and `brep_with_voids`.
    pub fn solid(&mut self, index: usize, look: Look, context: Context) {
        let mut attributes = self.table.attributes(index);
        let name = attributes.text().into_owned();
        let mut shells = Vec::new();
        let outer = attributes.reference("outer shell").and_then(|outer| self.shell(outer, look, context));
        self.keep(&mut shells, outer);
        if self.table.kind(index) == Kind::BrepWithVoids {
            for void in attributes.found_references() {
                let void = self.shell(void, look, context).map(|shell| Shell { void: true, ..shell });
                self.keep(&mut shells, void);
            }
        }
        self.add_body(index, name, BodyKind::Solid, shells);
    }

    /// `shell_based_surface_model` and `face_based_surface_model`.
    pub fn surface_model(&mut self, index: usize, look: Look, context: Context) {
        let mut attributes = self.table.attributes(index);
        let name = attributes.text().into_owned();
        let mut shells = Vec::new();
        for shell in attributes.found_references() {
            let shell = self.shell(shell, look, context);
            self.keep(&mut shells, shell);
        }
        self.add_body(index, name, BodyKind::Sheet, shells);
    }

    /// A shell or a face that stands on its own.
    pub fn lone_sheet(&mut self, index: usize, look: Look, context: Context) {
        let name = self.table.attributes(index).text().into_owned();
        let mut shells = Vec::new();
        if is_face(self.table.kind(index)) {
            let (face, reversed) = self.face(index, look, context);
            let faces = vec![ShellFace { face, reversed }];
            shells.push(Shell { entity: self.table.entity(index), closed: false, void: false, faces });
        } else {
            let shell = self.shell(index, look, context);
            self.keep(&mut shells, shell);
        }
        self.add_body(index, name, BodyKind::Sheet, shells);
    }

    /// Adds a body, unless it has no face at all.
    pub fn add_body(&mut self, index: usize, name: String, kind: BodyKind, shells: Vec<Shell>) {
        if shells.iter().any(|shell| !shell.faces.is_empty()) {
            let layers = self.layers.of(index).to_vec();
            self.seeds.bodies.push(Body { name, entity: self.table.entity(index), kind, shells, layers });
        }
    }

    fn keep(&mut self, shells: &mut Vec<Shell>, shell: Outcome<Shell>) {
        match shell {
            Ok(shell) => shells.push(shell),
            Err(fault) => self.seeds.diagnostics.push(fault.diagnostic("shell-unreadable")),
        }
    }

    fn shell(&mut self, index: usize, look: Look, context: Context) -> Outcome<Shell> {
        let mut index = index;
        let mut look = self.looks.of(index).over(look);
        let mut reversed = false;
        let mut depth = 0;
        while matches!(self.table.kind(index), Kind::OrientedClosedShell | Kind::OrientedOpenShell) {
            let mut attributes = self.table.attributes(index).after(2);
            index = attributes.reference("shell element")?;
            reversed ^= !attributes.flag();
            look = self.looks.of(index).over(look);
            depth += 1;
            if depth > MAX_WRAPPING {
                return Err(self.reader(context).fault(index, "is wrapped in too many oriented shells"));
            }
        }
        let closed = match self.table.kind(index) {
            Kind::ClosedShell => true,
            Kind::OpenShell
            | Kind::SurfacedOpenShell
            | Kind::ConnectedFaceSet
            | Kind::ConnectedFaceSubSet => false,
            _ => return Err(self.reader(context).unexpected(index, "shell")),
        };
        let ids = self.table.attributes(index).after(1).ids("faces")?;
        let mut faces = Vec::with_capacity(ids.len());
        for id in ids {
            let (face, turned) = match self.table.find(id) {
                Some(face) => self.face(face, look, context),
                None => (self.missing_face(index, id), false),
            };
            faces.push(ShellFace { face, reversed: turned != reversed });
        }
        self.drop_repeated(index, &mut faces);
        Ok(Shell { entity: self.table.entity(index), closed, void: false, faces })
    }
}

impl PartBuilder<'_> {
    /// Drops what a shell lists twice in the same direction, and reports it.
    fn drop_repeated(&mut self, shell: usize, faces: &mut Vec<ShellFace>) {
        let mut met = FxHashSet::default();
        let listed = faces.len();
        faces.retain(|used| met.insert((used.face, used.reversed)));
        if faces.len() < listed {
            let entity = self.table.entity(shell);
            let message = format!("Shell {entity} lists {} faces twice.", listed - faces.len());
            self.seeds.diagnostics.push(Diagnostic::new(Severity::Warning, "face-repeated", entity, message));
        }
    }
}

/// Whether an entity is a face.
pub(crate) fn is_face(kind: Kind) -> bool {
    matches!(kind, Kind::OrientedFace | Kind::AdvancedFace | Kind::FaceSurface | Kind::Subface | Kind::Face)
}

/// Whether an entity is a shell.
pub(crate) fn is_shell(kind: Kind) -> bool {
    matches!(
        kind,
        Kind::OrientedClosedShell
            | Kind::OrientedOpenShell
            | Kind::ClosedShell
            | Kind::OpenShell
            | Kind::SurfacedOpenShell
            | Kind::ConnectedFaceSet
            | Kind::ConnectedFaceSubSet
    )
}
