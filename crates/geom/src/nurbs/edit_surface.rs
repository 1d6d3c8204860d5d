//! What can be done to a B-spline surface without changing its shape.

use glam::DVec4;

use super::blossom::{Spline, clamped_knots, elevated_knots, merged_knots, spans};
use super::edit_curve::{joined, reversed_knots};
use super::{BezierGrid, BezierPatch, NurbsCurve, NurbsError, NurbsSurface};
use crate::period::pieces;
use crate::{Direction, Interval};

/// The control net while it is worked on.
struct Net {
    degrees: [usize; 2],
    shape: [usize; 2],
    points: Vec<DVec4>,
    knots: [Vec<f64>; 2],
}

impl Net {
    fn of(surface: &NurbsSurface) -> Self {
        let knots = surface.knots().map(<[f64]>::to_vec);
        Self { degrees: surface.degrees(), shape: surface.shape(), points: surface.homogeneous(), knots }
    }

    /// Works on every line of control points along direction `d`; all results have one length.
    fn each_line(&mut self, d: usize, work: impl Fn(&[DVec4]) -> Vec<DVec4>) {
        let [rows, columns] = self.shape;
        if d == 1 {
            let lines: Vec<Vec<DVec4>> = self.points.chunks(columns).map(work).collect();
            self.shape[1] = lines.first().map_or(0, Vec::len);
            self.points = lines.concat();
            return;
        }
        let column = |j: usize| (0..rows).map(|i| self.points[i * columns + j]).collect::<Vec<_>>();
        let lines: Vec<Vec<DVec4>> = (0..columns).map(|j| work(&column(j))).collect();
        self.shape[0] = lines.first().map_or(0, Vec::len);
        self.points = (0..self.shape[0]).flat_map(|i| lines.iter().map(move |line| line[i])).collect();
    }

    /// The control points over other knots along `d` (see [`Spline::over`]).
    fn over(&mut self, d: usize, knots: Vec<f64>) {
        let (degree, own) = (self.degrees[d], std::mem::take(&mut self.knots[d]));
        self.each_line(d, |points| Spline { degree, knots: &own, points }.over(&knots));
        self.knots[d] = knots;
    }

    fn elevate(&mut self, d: usize) {
        let (degree, own) = (self.degrees[d], std::mem::take(&mut self.knots[d]));
        let raised = elevated_knots(&own);
        self.each_line(d, |points| Spline { degree, knots: &own, points }.elevated_over(&raised));
        self.knots[d] = raised;
        self.degrees[d] += 1;
    }

    fn restrict(&mut self, d: usize, parts: &[(Interval, f64)]) {
        let (degree, own) = (self.degrees[d], std::mem::take(&mut self.knots[d]));
        let knots: Vec<Vec<f64>> = parts.iter().map(|(part, _)| clamped_knots(&own, degree, *part)).collect();
        let pieces_of = |points: &[DVec4]| -> Vec<Vec<DVec4>> {
            knots.iter().map(|k| Spline { degree, knots: &own, points }.over(k)).collect()
        };
        let shifted = || knots.iter().zip(parts).map(|(k, (_, shift))| k.iter().map(|k| k + shift).collect());
        // A joint is shared only where every line agrees there.
        let agree = self.all_lines(d, |points| {
            let pieces = pieces_of(points);
            let whole: usize = pieces.iter().map(Vec::len).sum();
            joined(degree, shifted().zip(pieces)).1.len() + parts.len() - 1 == whole
        });
        let mut new_knots = Vec::new();
        if agree {
            let template = pieces_of(&self.line(d, 0));
            new_knots = joined(degree, shifted().zip(template)).0;
            self.each_line(d, |points| joined(degree, shifted().zip(pieces_of(points))).1);
        } else {
            for (i, part) in shifted().enumerate() {
                let part: Vec<f64> = part;
                new_knots.extend(&part[if i == 0 { 0 } else { degree + 1 }..]);
            }
            self.each_line(d, |points| pieces_of(points).concat());
        }
        self.knots[d] = new_knots;
    }

    fn line(&self, d: usize, index: usize) -> Vec<DVec4> {
        let [rows, columns] = self.shape;
        match d {
            0 => (0..rows).map(|i| self.points[i * columns + index]).collect(),
            _ => self.points[index * columns..][..columns].to_vec(),
        }
    }

    fn all_lines(&self, d: usize, test: impl Fn(&[DVec4]) -> bool) -> bool {
        (0..self.shape[1 - d]).all(|index| test(&self.line(d, index)))
    }

    fn build(self) -> Result<NurbsSurface, NurbsError> {
        NurbsSurface::from_homogeneous(self.degrees, self.shape[0], self.shape[1], &self.points, self.knots)
    }
}

impl NurbsSurface {
    /// The same surface with the knots `new` inserted along `direction` (Piegl & Tiller A5.5); see
    /// [`NurbsCurve::refined`].
    pub fn refined(&self, direction: Direction, new: &[f64]) -> Self {
        let d = direction as usize;
        let knots = merged_knots(self.knots()[d], self.degrees()[d], self.domain()[d], new);
        let mut net = Net::of(self);
        net.over(d, knots);
        net.build().unwrap_or_else(|_| self.clone())
    }

    /// The same surface with the degree along `direction` higher by `times` (Piegl & Tiller A5.10), clamped there; not
    /// beyond [`super::MAX_DEGREE`].
    pub fn elevated(&self, direction: Direction, times: usize) -> Self {
        let d = direction as usize;
        let mut net = Net::of(self);
        net.over(d, clamped_knots(self.knots()[d], self.degrees()[d], self.domain()[d]));
        for _ in 0..times.min(super::MAX_DEGREE - self.degrees()[d]) {
            net.elevate(d);
        }
        net.build().unwrap_or_else(|_| self.clone())
    }

    /// The part over `domain` with the same parametrization and clamped ends. In a closed direction the range may
    /// leave the domain (by one period at most); in an open one only what lies inside counts.
    ///
    /// # Errors
    /// When nothing is left.
    pub fn restricted(&self, domain: [Interval; 2]) -> Result<Self, NurbsError> {
        let mut net = Net::of(self);
        for (d, range) in domain.into_iter().enumerate() {
            let own = self.domain()[d];
            let parts = match self.periods()[d] {
                Some(_) if range.start < own.start || range.end > own.end => pieces(range, own),
                _ => vec![(Interval::new(own.clamp(range.start), own.clamp(range.end)), 0.0)],
            };
            if parts.iter().any(|(part, _)| part.is_empty()) {
                let [start, end] = [range.start, range.end];
                return Err(NurbsError(format!("nothing of the surface lies between {start} and {end}")));
            }
            net.restrict(d, &parts);
        }
        net.build()
    }

    /// The same points with the parameter of `direction` running the other way over the same domain; turns the
    /// normal over.
    pub fn reversed(&self, direction: Direction) -> Self {
        let d = direction as usize;
        let mut net = Net::of(self);
        net.each_line(d, |points| points.iter().rev().copied().collect());
        net.knots[d] = reversed_knots(&net.knots[d], self.domain()[d]);
        net.build().unwrap_or_else(|_| self.clone())
    }

    /// The same points with u and v exchanged; turns the normal over.
    pub fn transposed(&self) -> Self {
        let [rows, columns] = self.shape();
        let own = self.homogeneous();
        let points: Vec<DVec4> = (0..columns)
            .flat_map(|j| (0..rows).map(move |i| (i, j)))
            .map(|(i, j)| own[i * columns + j])
            .collect();
        let ([pu, pv], [ku, kv]) = (self.degrees(), self.knots().map(<[f64]>::to_vec));
        Self::from_homogeneous([pv, pu], columns, rows, &points, [kv, ku]).unwrap_or_else(|_| self.clone())
    }

    /// The isoparametric curve at the value `at` of the parameter `constant`.
    ///
    /// # Errors
    /// When its control points are not finite.
    pub fn isocurve(&self, constant: Direction, at: f64) -> Result<NurbsCurve, NurbsError> {
        let d = constant as usize;
        let at = self.domain()[d].clamp(at);
        let (degree, knots) = (self.degrees()[d], self.knots()[d]);
        let mut net = Net::of(self);
        net.each_line(d, |points| {
            let spline = Spline { degree, knots, points };
            spline.bezier(Interval::new(at, at))[..1].to_vec()
        });
        NurbsCurve::from_homogeneous(self.degrees()[1 - d], &net.points, self.knots()[1 - d].to_vec())
    }

    /// The Bézier patches, one per pair of non-empty knot spans (Piegl & Tiller A5.7).
    pub fn bezier_patches(&self) -> BezierGrid {
        let spans = [0, 1].map(|d| spans(self.knots()[d], self.domain()[d]));
        let mut patches = Vec::with_capacity(spans[0].len() * spans[1].len());
        for &u in &spans[0] {
            let strip = self.strip(u);
            patches.extend(spans[1].iter().map(|&v| {
                let rows = strip.iter().flat_map(|row| {
                    Spline { degree: self.degrees()[1], knots: self.knots()[1], points: row }.bezier(v)
                });
                BezierPatch { degrees: self.degrees(), domain: [u, v], points: rows.collect() }
            }));
        }
        BezierGrid { rows: spans[0].len(), columns: spans[1].len(), patches }
    }

    /// The Bézier rows over one knot span along u, still splines along v.
    fn strip(&self, u: Interval) -> Vec<Vec<DVec4>> {
        let mut net = Net::of(self);
        let (degree, knots) = (self.degrees()[0], self.knots()[0]);
        net.each_line(0, |points| Spline { degree, knots, points }.bezier(u));
        net.points.chunks(net.shape[1]).map(<[DVec4]>::to_vec).collect()
    }
}
