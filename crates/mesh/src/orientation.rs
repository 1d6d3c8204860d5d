//! Which faces must be turned so that a shell's triangles all face the same way, outwards where it is closed.

use glam::DVec3;
use trimloop_brep::{BodyKind, EntityRef, Part, Shell};

use crate::draft::FaceDraft;

/// Per face of the part, whether its draft is to be turned over.
pub(crate) struct Orientation {
    pub turned: Vec<bool>,
    /// Faces that the file has the other way round.
    pub corrected: Vec<u32>,
}

/// How the two faces at an edge lie: run over by both the same way (one must be turned) or not.
struct Neighbour {
    face: usize,
    same_way: bool,
}

impl Orientation {
    /// Decides for all shells of the part.
    pub fn new(part: &Part, drafts: &[FaceDraft], shared: &[DVec3]) -> Self {
        let turned = part.faces.iter().map(|f| !f.same_sense).collect();
        let mut out = Self { turned, corrected: Vec::new() };
        for body in &part.bodies {
            for shell in &body.shells {
                out.settle(shell, body.kind == BodyKind::Solid, drafts, shared);
            }
        }
        out
    }

    fn settle(&mut self, shell: &Shell, solid: bool, drafts: &[FaceDraft], shared: &[DVec3]) {
        let faces: Vec<usize> = shell.faces.iter().map(|f| f.face as usize).collect();
        for f in &shell.faces {
            self.turned[f.face as usize] ^= f.reversed;
        }
        let (neighbours, closed) = neighbours(&faces, drafts);
        let before: Vec<bool> = faces.iter().map(|&f| self.turned[f]).collect();
        for component in self.align(&faces, &neighbours) {
            let changed = component.iter().filter(|&&k| self.turned[faces[k]] != before[k]).count();
            if changed * 2 > component.len() {
                component.iter().for_each(|&k| self.turned[faces[k]] ^= true);
            }
        }
        if solid && closed {
            let volume: f64 = faces.iter().map(|&f| self.volume(&drafts[f], f, shared)).sum();
            if (volume < 0.0) != shell.void && volume != 0.0 {
                faces.iter().for_each(|&f| self.turned[f] ^= true);
            }
        }
        // A shell that the file does not have says nothing of how its faces should lie.
        if shell.entity == EntityRef::None {
            return;
        }
        let changed = faces.iter().zip(&before).filter(|&(&f, &b)| self.turned[f] != b);
        self.corrected.extend(changed.map(|(&f, _)| f as u32));
    }

    /// Turns faces so that neighbours agree; the components of the shell, as indices into `faces`.
    fn align(&mut self, faces: &[usize], neighbours: &[Vec<Neighbour>]) -> Vec<Vec<usize>> {
        let mut seen = vec![false; faces.len()];
        let mut components = Vec::new();
        for first in 0..faces.len() {
            if std::mem::replace(&mut seen[first], true) {
                continue;
            }
            let mut component = vec![first];
            let mut done = 0;
            while done < component.len() {
                let k = component[done];
                done += 1;
                for n in &neighbours[k] {
                    if !std::mem::replace(&mut seen[n.face], true) {
                        self.turned[faces[n.face]] = self.turned[faces[k]] != n.same_way;
                        component.push(n.face);
                    }
                }
            }
            components.push(component);
        }
        components
    }

    fn volume(&self, draft: &FaceDraft, face: usize, shared: &[DVec3]) -> f64 {
        let origin = shared.first().copied().unwrap_or_default();
        let sum: f64 = draft
            .triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|i| draft.position(draft.vertices[i as usize].point, shared) - origin);
                a.dot(b.cross(c)) / 6.0
            })
            .sum();
        if self.turned[face] { -sum } else { sum }
    }
}

/// Per face of the shell its neighbours over edges that exactly two faces use, and whether every edge is such.
fn neighbours(faces: &[usize], drafts: &[FaceDraft]) -> (Vec<Vec<Neighbour>>, bool) {
    // (lower point, higher point, face, whether it is run over from the lower to the higher)
    let mut uses: Vec<(u32, u32, usize, bool)> = Vec::new();
    for (k, &face) in faces.iter().enumerate() {
        uses.extend(drafts[face].boundary.iter().map(|&[a, b]| (a.min(b), a.max(b), k, a < b)));
    }
    uses.sort_unstable();
    let mut out: Vec<Vec<Neighbour>> = faces.iter().map(|_| Vec::new()).collect();
    let mut closed = true;
    for list in uses.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)) {
        match list {
            &[(_, _, f, forward_f), (_, _, g, forward_g)] if f != g => {
                let same_way = forward_f == forward_g;
                out[f].push(Neighbour { face: g, same_way });
                out[g].push(Neighbour { face: f, same_way });
            }
            list => closed &= list.len() % 2 == 0,
        }
    }
    (out, closed)
}
