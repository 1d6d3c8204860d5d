//! Hierarchies of bicubic patches and of cubic trim curves (Guthe, Balázs, Klein 2005), and the way through them that a view
//! takes.

use std::sync::{Mutex, MutexGuard, PoisonError};

use glam::{DVec2, DVec3};
use trimloop_gpu::{Cover, CurveTree, PatchTree};
use trimloop_trim::curves::Cubic;

use crate::surface_face::SurfaceFace;

/// The trees of a face. A view splits the patches that it finds too coarse, so they are behind a lock.
#[derive(Debug)]
pub(crate) struct Hierarchy {
    patches: Mutex<Patches>,
    /// One per trim loop.
    curves: Vec<CurveTree>,
}

#[derive(Debug)]
struct Patches {
    tree: PatchTree,
    /// By node: whether nothing of the face lies there.
    is_outside: Vec<bool>,
}

/// What a node is seen by.
pub(crate) trait Sight {
    /// Which planes of those set in `planes` a box crosses; `None` where it is outside of one.
    fn crossed(&self, low: DVec3, high: DVec3, planes: u8) -> Option<u8>;
    /// Millimetres that what is in a box may be off.
    fn allowed_mm(&self, low: DVec3, high: DVec3) -> f64;
}

/// A patch that is fine enough for a view, and how far off what is drawn of it may be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chosen {
    pub node: usize,
    pub allowed_mm: f64,
    pub center: DVec3,
    pub radius: f64,
}

/// All planes.
pub(crate) const PLANES: u8 = 0b1_1111;
/// Of what a surface may be off, the share for the distance between patch and surface; the rest is for triangles.
pub(crate) const APPROXIMATION: f64 = 0.5;
/// Patches that need more cells than this along a direction are split.
const MOST_CELLS: usize = 48;
/// Nodes of a face; levels of its tree.
const MOST_NODES: usize = 1 << 15;
const DEEPEST: u32 = 40;

impl Hierarchy {
    /// The roots; `None` for what has no NURBS form.
    pub fn new(face: &SurfaceFace) -> Option<Self> {
        let tree = PatchTree::new(&face.shape)?;
        let lengths = DVec2::from(face.bounds.lengths).max(DVec2::splat(1e-9));
        let share = |p: DVec2| face.share(p);
        let chain = |chain: &Vec<Cubic>| -> CurveTree {
            let cubics: Vec<Cubic> = chain.iter().map(|cubic| cubic.map(share)).collect();
            CurveTree::new(&cubics, lengths)
        };
        let curves = face.chains.iter().map(chain).collect();
        Some(Self { patches: Mutex::new(Patches { tree, is_outside: vec![false] }), curves })
    }

    /// The patches, which only grow in number.
    pub fn with_tree<T>(&self, work: impl FnOnce(&PatchTree) -> T) -> T {
        work(&self.lock().tree)
    }

    /// The coarsest trim curves within `off_mm`, loop by loop, in shares of the domain.
    pub fn trims(&self, off_mm: f64) -> Vec<Vec<Cubic>> {
        self.curves.iter().map(|tree| tree.cut(off_mm)).collect()
    }

    /// The coarsest patches that are near enough to the surface for a view, where that sees them.
    pub fn choose(&self, face: &SurfaceFace, sight: &impl Sight, longest: f64) -> Vec<Chosen> {
        let mut walk = Walk { patches: self.lock(), face, sight, longest, chosen: Vec::new() };
        walk.visit(0, PLANES, 0.0, 0);
        walk.chosen
    }

    fn lock(&self) -> MutexGuard<'_, Patches> {
        self.patches.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

struct Walk<'a, S> {
    patches: MutexGuard<'a, Patches>,
    face: &'a SurfaceFace,
    sight: &'a S,
    /// Lengths of cells at most, as a multiple of what they may be off.
    longest: f64,
    chosen: Vec<Chosen>,
}

impl<S: Sight> Walk<'_, S> {
    /// `parent_mm` is what the parent was allowed: a node's own box is never nearer, so it is allowed no less.
    fn visit(&mut self, index: usize, planes: u8, parent_mm: f64, depth: u32) {
        let node = *self.patches.tree.node(index);
        let (low, high) = (node.bounds.min, node.bounds.max);
        if self.patches.is_outside[index] {
            return;
        }
        let Some(planes) = self.sight.crossed(low, high, planes) else { return };
        let mut allowed_mm = parent_mm;
        let mut is_fine = self.fits(index, allowed_mm);
        if !is_fine {
            allowed_mm = self.sight.allowed_mm(low, high);
            is_fine = self.fits(index, allowed_mm);
        }
        if is_fine || depth >= DEEPEST || self.patches.tree.len() >= MOST_NODES {
            let center = node.bounds.center();
            self.chosen.push(Chosen {
                node: index,
                allowed_mm,
                center,
                radius: 0.5 * node.bounds.diagonal(),
            });
            return;
        }
        let first = node.first_child().unwrap_or_else(|| self.split(index));
        for child in [first, first + 1] {
            self.visit(child, planes, allowed_mm, depth + 1);
        }
    }

    fn fits(&self, index: usize, allowed_mm: f64) -> bool {
        // The root has no parent.
        let is_near = self.patches.tree.node(index).error_mm <= APPROXIMATION * allowed_mm;
        if !is_near || allowed_mm == 0.0 {
            return false;
        }
        let off_mm = (1.0 - APPROXIMATION) * allowed_mm;
        let [u, v] = self.patches.tree.patch(index).cells(off_mm, self.longest * allowed_mm);
        u.max(v) <= MOST_CELLS
    }

    fn split(&mut self, index: usize) -> usize {
        let patches = &mut *self.patches;
        let first = patches.tree.split(&self.face.shape, index);
        for child in [first, first + 1] {
            let [u, v] = patches.tree.patch(child).domain;
            let (low, high) = (DVec2::new(u.start, v.start), DVec2::new(u.end, v.end));
            let is_outside = !self.face.is_whole() && self.face.table.cover(low, high) == Cover::None;
            patches.is_outside.push(is_outside);
        }
        first
    }
}
