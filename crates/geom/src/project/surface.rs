//! The nearest point of a surface.

use std::borrow::Cow;

use glam::{DVec2, DVec3};

use super::surface_search::SurfaceSearch;
use super::{SampleGrid, elementary, swept};
use crate::period::{near, wrap};
use crate::{Derivatives, Direction, Interval, Surface, SurfacePoint};

impl Surface {
    /// The parameters of the point of the surface nearest to `point`: closed form for elementary surfaces; for the
    /// rest Newton from `hint`, checked, with a global search where it fails or where no hint is given. `uv` lies in
    /// `domain()`; on a closed direction within half a period of the hint when one is given (so it may leave the domain).
    ///
    /// Where a whole line of parameters gives the same point (a pole, an apex, a point on the axis of a cylinder), the
    /// hint's are kept.
    pub fn project(&self, point: DVec3, hint: Option<DVec2>) -> SurfacePoint {
        self.project_with_value(point, hint, 0.0).0
    }

    /// [`Surface::project`], and the unit normal at the foot as [`Surface::normal`] gives it. On splines, where the hint
    /// leads to a foot that is no farther off than `enough`, none that is nearer is looked for elsewhere: points that
    /// follow one another on a surface stay on the same side of a fold.
    pub fn project_with_normal(
        &self,
        point: DVec3,
        hint: Option<DVec2>,
        enough: f64,
    ) -> (SurfacePoint, Option<DVec3>) {
        let (foot, value) = self.project_with_value(point, hint, if hint.is_some() { enough } else { 0.0 });
        let normal = match value {
            Some(value) => self.normal_of(value, foot.uv),
            None => self.normal(foot.uv),
        };
        (foot, normal)
    }

    /// The foot, and the surface's derivatives there where the search has come by them.
    fn project_with_value(
        &self,
        point: DVec3,
        hint: Option<DVec2>,
        enough: f64,
    ) -> (SurfacePoint, Option<Derivatives>) {
        let hint = hint.filter(|h| h.is_finite());
        let uv = match self {
            Self::Extrusion { profile, direction } => {
                swept::project_extrusion(profile, *direction, point, hint)
            }
            Self::Revolution { profile, origin, axis } => {
                swept::project_revolution(profile, *origin, *axis, point, hint)
            }
            Self::Nurbs(nurbs) => {
                // Mostly the point lies on the surface, and the control points lead there without any sample.
                let start = hint.unwrap_or_else(|| nurbs.near_control_point(point));
                let samples = || Cow::Borrowed(nurbs.samples());
                let foot = SurfaceSearch::new(self).content_with(enough).nearest(point, Some(start), samples);
                let uv = self.settle(foot.uv, hint);
                let Some(value) = foot.value else { return (self.foot(uv, point), None) };
                let distance = value.point.distance(point);
                return (SurfacePoint { uv, point: value.point, distance }, Some(value));
            }
            Self::Offset { basis, distance } => self.project_offset(basis, *distance, point, hint),
            _ => elementary::project(self, point, hint).unwrap_or_default(),
        };
        (self.foot(uv, point), None)
    }

    fn foot(&self, uv: DVec2, target: DVec3) -> SurfacePoint {
        let point = self.point(uv);
        SurfacePoint { uv, point, distance: point.distance(target) }
    }

    /// The feet on an offset and on its basis share their parameters, if not always the same one is nearest: without a
    /// hint start from the basis' foot, and look around where that may not be the nearest.
    fn project_offset(&self, basis: &Self, distance: f64, point: DVec3, hint: Option<DVec2>) -> DVec2 {
        let search = SurfaceSearch::new(self);
        let foot = match basis {
            Self::Nurbs(nurbs) => {
                let start = hint.unwrap_or_else(|| basis.project(point, None).uv);
                let samples = || Cow::Borrowed(nurbs.samples());
                search.with_margin(distance.abs()).nearest(point, Some(start), samples)
            }
            _ => {
                let start = basis.project(point, hint).uv;
                let foot = search.descend(point, start);
                let samples = || Cow::Owned(self.fresh_samples(start));
                if foot.proper { foot } else { search.nearest(point, Some(start), samples) }
            }
        };
        self.settle(foot.uv, hint)
    }

    fn settle(&self, uv: DVec2, hint: Option<DVec2>) -> DVec2 {
        let (domain, periods) = (self.domain(), self.periods());
        let along = |d: usize| match (periods[d], hint) {
            (Some(period), Some(hint)) => near(uv[d], hint[d], period),
            (Some(_), None) => wrap(uv[d], domain[d]),
            (None, _) => uv[d],
        };
        DVec2::new(along(0), along(1))
    }

    /// A modest grid over the domain, or around `center` where it is infinite.
    fn fresh_samples(&self, center: DVec2) -> SampleGrid {
        let domain = self.domain();
        let parameters = |d: usize, direction: Direction| {
            let range = if domain[d].is_finite() {
                domain[d]
            } else {
                Interval::new(domain[d].clamp(center[d] - 10.0), domain[d].clamp(center[d] + 10.0))
            };
            let breakpoints = self.breakpoints(direction, range);
            crate::nurbs::sample_parameters(&breakpoints, 24_usize.div_ceil(breakpoints.len()), 64)
        };
        let (us, vs) = (parameters(0, Direction::U), parameters(1, Direction::V));
        let points = self.grid(&us, &vs);
        SampleGrid::new(us, vs, points)
    }
}
