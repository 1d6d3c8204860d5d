//! Triangles that belong to no CAD file, or to one that has been meshed.

use std::ops::Range;

use glam::{DAffine3, DVec3};
use rustc_hash::FxHashMap;
use trimloop_geom::Aabb;

/// Triangles in one coordinate system.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangles {
    /// Points, each once where [`Triangles::welded`] has been called.
    pub points: Vec<DVec3>,
    /// Indices into `points`, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// What the file tells apart, in the order of the triangles.
    pub pieces: Vec<Piece>,
}

/// Triangles that a file gives a name of their own.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Piece {
    /// Its name, which may be empty.
    pub name: String,
    /// Its triangles.
    pub triangles: Range<usize>,
}

impl Triangles {
    /// The corners of a triangle.
    pub fn corners(&self, triangle: usize) -> [DVec3; 3] {
        self.triangles[triangle].map(|index| self.points[index as usize])
    }

    /// Half the cross product of two sides: as long as the triangle is large, towards the side that it faces.
    pub fn area_vector(&self, triangle: usize) -> DVec3 {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(c - a) * 0.5
    }

    /// The box of the triangles' corners.
    pub fn bounds(&self) -> Aabb {
        Aabb::from_points(self.triangles.iter().flatten().map(|&index| self.points[index as usize]))
    }

    /// The triangles moved; those of a mirror image face outwards again.
    pub fn transformed(mut self, map: &DAffine3) -> Self {
        self.points.iter_mut().for_each(|point| *point = map.transform_point3(*point));
        if map.matrix3.determinant() < 0.0 {
            self.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        self
    }

    /// Adds what another file or node holds, as pieces of its own.
    pub fn add(&mut self, other: Self) {
        let (points, triangles) = (self.points.len() as u32, self.triangles.len());
        self.points.extend(other.points);
        self.triangles.extend(other.triangles.iter().map(|t| t.map(|index| index + points)));
        self.pieces.extend(other.pieces.into_iter().map(|piece| Piece {
            name: piece.name,
            triangles: piece.triangles.start + triangles..piece.triangles.end + triangles,
        }));
    }

    /// The same with every place a single point, whatever normals and colours its vertices had.
    pub fn welded(self) -> Self {
        let mut place: FxHashMap<[u64; 3], u32> = FxHashMap::default();
        let mut points = Vec::new();
        // Adding zero turns -0 into 0.
        let key = |point: DVec3| point.to_array().map(|x| (x + 0.0).to_bits());
        let index: Vec<u32> = self
            .points
            .iter()
            .map(|&point| {
                *place.entry(key(point)).or_insert_with(|| {
                    points.push(point);
                    points.len() as u32 - 1
                })
            })
            .collect();
        let triangles = self.triangles.iter().map(|t| t.map(|old| index[old as usize])).collect();
        Self { points, triangles, pieces: self.pieces }
    }

    /// Takes out triangles with corners that are no places; gives how many.
    pub fn drop_unusable(&mut self) -> usize {
        // Squares and products of coordinates must stay finite.
        let usable = |index: u32| self.points[index as usize].to_array().iter().all(|x| x.abs() < 1e50);
        let good: Vec<bool> = self.triangles.iter().map(|t| t.iter().all(|&index| usable(index))).collect();
        let dropped = good.iter().filter(|good| !**good).count();
        if dropped > 0 {
            let mut before = vec![0; good.len() + 1];
            for (k, &good) in good.iter().enumerate() {
                before[k + 1] = before[k] + usize::from(good);
            }
            for piece in &mut self.pieces {
                piece.triangles = before[piece.triangles.start]..before[piece.triangles.end];
            }
            let mut good = good.into_iter();
            self.triangles.retain(|_| good.next().unwrap_or(false));
        }
        dropped
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_welded_and_unusable_triangles_dropped() {
        let points = vec![
            DVec3::ZERO,
            DVec3::X,
            DVec3::Y,
            DVec3::new(-0.0, 0.0, -0.0),
            DVec3::new(f64::NAN, 0.0, 0.0),
            DVec3::Z,
        ];
        let triangles = vec![[0, 1, 2], [3, 2, 4], [3, 5, 1]];
        let pieces =
            vec![Piece { name: "a".into(), triangles: 0..2 }, Piece { name: "b".into(), triangles: 2..3 }];
        let mut soup = Triangles { points, triangles, pieces };
        assert_eq!(soup.drop_unusable(), 1);
        assert_eq!((soup.pieces[0].triangles.clone(), soup.pieces[1].triangles.clone()), (0..1, 1..2));
        let welded = soup.welded();
        assert_eq!(welded.triangles[0][0], welded.triangles[1][0]);
    }

    #[test]
    fn a_mirror_image_faces_outwards() {
        let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        let triangle = Triangles { points, triangles: vec![[0, 1, 2]], pieces: Vec::new() };
        let mirrored = triangle.clone().transformed(&DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0)));
        assert_eq!(mirrored.area_vector(0), triangle.area_vector(0));
    }
}
