//! Which faces must be turned so that a shell's triangles all face the same way, outwards where it is closed.

use glam::DVec3;
use trimloop_brep::{Body, BodyKind, EntityRef, Part, Shell};
use trimloop_geom::Aabb;

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
        out.turn_cavities(part, drafts, shared);
        out
    }

    /// Closed shells that were put together from loose faces may be the walls of a cavity in another: those that lie
    /// within an odd number of others face inwards.
    fn turn_cavities(&mut self, part: &Part, drafts: &[FaceDraft], shared: &[DVec3]) {
        let is_made = |body: &&Body| body.kind == BodyKind::Solid && body.entity == EntityRef::None;
        let made: Vec<Vec<usize>> = part
            .bodies
            .iter()
            .filter(is_made)
            .map(|body| body.shells.iter().flat_map(|s| &s.faces).map(|f| f.face as usize).collect())
            .collect();
        let corners = |faces: &[usize]| -> Vec<DVec3> {
            let drafts = faces.iter().map(|&face| &drafts[face]);
            drafts
                .flat_map(|draft| draft.vertices.iter().map(|v| draft.position(v.position, shared)))
                .collect()
        };
        let boxes: Vec<Aabb> = made.iter().map(|faces| Aabb::from_points(corners(faces))).collect();
        for (k, faces) in made.iter().enumerate() {
            let holds =
                |other: &Aabb| other.min.cmplt(boxes[k].min).all() && other.max.cmpgt(boxes[k].max).all();
            let around: Vec<usize> =
                (0..made.len()).filter(|&other| other != k && holds(&boxes[other])).collect();
            let Some(point) = corners(faces).first().copied().filter(|_| !around.is_empty()) else {
                continue;
            };
            let within = around.iter().filter(|&&other| self.contains(&made[other], point, drafts, shared));
            if within.count() % 2 == 1 {
                faces.iter().for_each(|&face| self.turned[face] ^= true);
            }
        }
    }

    /// Whether a closed shell's triangles go round a point: by the solid angles that they are seen under (van Oosterom
    /// and Strackee 1983).
    fn contains(&self, faces: &[usize], point: DVec3, drafts: &[FaceDraft], shared: &[DVec3]) -> bool {
        let angle = |draft: &FaceDraft, t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| draft.position(draft.vertices[i as usize].position, shared) - point);
            let [la, lb, lc] = [a, b, c].map(DVec3::length);
            let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
            2.0 * a.dot(b.cross(c)).atan2(below)
        };
        let of_face = |&face: &usize| {
            let sum: f64 = drafts[face].triangles.iter().map(|t| angle(&drafts[face], t)).sum();
            if self.turned[face] { -sum } else { sum }
        };
        let sum: f64 = faces.iter().map(of_face).sum();
        sum.abs() > std::f64::consts::TAU
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
                let [a, b, c] =
                    t.map(|i| draft.position(draft.vertices[i as usize].position, shared) - origin);
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
