//! Curves.

use std::sync::Arc;

use glam::{DAffine3, DVec3};
use trimloop_brep::Severity;
use trimloop_geom::{CompositeCurve, CompositeSegment, Curve, Interval, OffsetCurve, Polyline, Surface};
use trimloop_part21::Param;

use super::attributes::Attributes;
use super::fault::Outcome;
use super::keyword::Kind;
use super::reader::Reader;
use crate::run::turned;

/// An end of a trimmed curve as the file gives it: by parameter, by point, or both.
#[derive(Clone, Copy, Debug, Default)]
struct Trim {
    parameter: Option<f64>,
    point: Option<DVec3>,
}

impl<'t> Reader<'t> {
    /// Any curve that can be read.
    pub fn curve(&mut self, index: usize) -> Outcome<Curve> {
        self.nested(index, |reader| reader.curve_by_kind(index))
    }

    fn curve_by_kind(&mut self, index: usize) -> Outcome<Curve> {
        let mut attributes = self.table.attributes(index).after(1);
        match self.table.kind(index) {
            Kind::Line => {
                let origin = self.point(attributes.reference("point")?)?;
                let direction = self.vector(attributes.reference("direction")?)?;
                Ok(Curve::Line { origin, direction })
            }
            Kind::Circle => {
                let frame = self.frame(attributes.reference("position")?)?;
                Ok(Curve::Circle { frame, radius: self.length(index, &mut attributes, "radius")? })
            }
            Kind::Ellipse => self.ellipse(index, attributes),
            Kind::Parabola => {
                let frame = self.frame(attributes.reference("position")?)?;
                Ok(Curve::Parabola { frame, focal: self.length(index, &mut attributes, "focal distance")? })
            }
            Kind::Hyperbola => {
                let frame = self.frame(attributes.reference("position")?)?;
                let major = self.length(index, &mut attributes, "semi axis")?;
                let minor = self.length(index, &mut attributes, "semi imaginary axis")?;
                Ok(Curve::Hyperbola { frame, major, minor })
            }
            Kind::Polyline => self.polyline(index, attributes),
            Kind::TrimmedCurve => self.trimmed(index).map(whole_segment),
            Kind::CompositeCurve
            | Kind::CompositeCurveOnSurface
            | Kind::BoundaryCurve
            | Kind::OuterBoundaryCurve => self.composite(index, attributes),
            Kind::SurfaceCurve | Kind::SeamCurve | Kind::IntersectionCurve | Kind::BoundedSurfaceCurve => {
                self.surface_curve(attributes)
            }
            Kind::Pcurve | Kind::BoundedPcurve => {
                let surface = Arc::new(self.surface(attributes.reference("basis surface")?)?);
                let pcurve = Arc::new(self.pcurve(index, &surface)?);
                Ok(Curve::OnSurface { surface, pcurve })
            }
            Kind::OffsetCurve3d => {
                let basis = self.curve(attributes.reference("basis curve")?)?;
                // ISO 10303-42 offsets along reference direction x tangent, the curve here the other way round.
                let distance = -attributes.real("distance")? * self.units.length_mm;
                attributes.skip(1);
                let ref_direction = self.direction(attributes.reference("reference direction")?)?;
                Ok(Curve::Offset(Box::new(OffsetCurve { basis, distance, ref_direction })))
            }
            Kind::CurveReplica => {
                let parent = self.curve(attributes.reference("parent curve")?)?;
                let map = self.transformation_operator(attributes.reference("transformation")?)?;
                Ok(parent.transformed(&map))
            }
            Kind::BSplineCurveWithKnots
            | Kind::UniformCurve
            | Kind::QuasiUniformCurve
            | Kind::BezierCurve
            | Kind::RationalBSplineCurve
            | Kind::BSplineCurve => self.spline_curve(index).map(Curve::Nurbs),
            _ => Err(self.unexpected(index, "curve")),
        }
    }

    /// A bounded piece of a curve: trimmed curves with their ends, others over their whole domain.
    pub fn segment(&mut self, index: usize) -> Outcome<CompositeSegment> {
        self.nested(index, |reader| reader.segment_by_kind(index))
    }

    fn segment_by_kind(&mut self, index: usize) -> Outcome<CompositeSegment> {
        match self.table.kind(index) {
            Kind::TrimmedCurve => return self.trimmed(index),
            Kind::SurfaceCurve | Kind::SeamCurve | Kind::IntersectionCurve | Kind::BoundedSurfaceCurve => {
                let in_space = self.table.attributes(index).after(1).optional_reference();
                if let Some(Ok(segment)) = in_space.map(|curve| self.segment(curve)) {
                    return Ok(segment);
                }
            }
            Kind::Pcurve | Kind::BoundedPcurve => {
                let surface = self.table.attributes(index).after(1).reference("basis surface")?;
                let surface = Arc::new(self.surface(surface)?);
                let segment = self.pcurve_segment(index, &surface)?;
                let pcurve = Arc::new(segment.curve);
                return Ok(CompositeSegment { curve: Curve::OnSurface { surface, pcurve }, ..segment });
            }
            _ => {}
        }
        let curve = self.curve(index)?;
        let range = curve.domain();
        if range.is_finite() {
            Ok(CompositeSegment { curve, range, reversed: false })
        } else {
            Err(self.fault(index, "has no ends"))
        }
    }

    /// A length that must be positive, millimetres.
    pub fn length(&self, index: usize, attributes: &mut Attributes<'_>, what: &str) -> Outcome<f64> {
        let length = attributes.real(what)? * self.units.length_mm;
        if length > 0.0 { Ok(length) } else { Err(self.fault(index, &format!("its {what} is not positive"))) }
    }

    fn ellipse(&mut self, index: usize, mut attributes: Attributes<'t>) -> Outcome<Curve> {
        let frame = self.frame(attributes.reference("position")?)?;
        let major = self.length(index, &mut attributes, "first semi axis")?;
        let minor = self.length(index, &mut attributes, "second semi axis")?;
        Ok(Curve::Ellipse { frame, major, minor })
    }

    fn polyline(&mut self, index: usize, mut attributes: Attributes<'t>) -> Outcome<Curve> {
        let mut points = Vec::new();
        for point in attributes.references("points")? {
            points.push(self.point(point)?);
        }
        points.dedup();
        if points.len() < 2 {
            return Err(self.fault(index, "has fewer than two distinct points"));
        }
        Ok(Curve::Polyline(Polyline { points }))
    }

    fn composite(&mut self, index: usize, mut attributes: Attributes<'t>) -> Outcome<Curve> {
        let mut segments = Vec::new();
        for segment in attributes.references("segments")? {
            let segment = self.composite_segment(segment)?;
            if segment.range.length() > 0.0 {
                segments.push(segment);
            }
        }
        if segments.is_empty() {
            return Err(self.fault(index, "has no segments"));
        }
        turn_end_to_end(&mut segments);
        Ok(Curve::Composite(CompositeCurve { segments }))
    }

    /// `composite_curve_segment`.
    pub fn composite_segment(&mut self, index: usize) -> Outcome<CompositeSegment> {
        if !matches!(
            self.table.kind(index),
            Kind::CompositeCurveSegment | Kind::ReparametrisedCompositeCurveSegment
        ) {
            return Err(self.unexpected(index, "segment of a composite curve"));
        }
        let mut attributes = self.table.attributes(index).after(1);
        let same_sense = attributes.flag();
        let mut segment = self.segment(attributes.reference("parent curve")?)?;
        segment.reversed ^= !same_sense;
        Ok(segment)
    }

    /// `surface_curve` and its subtypes: the curve in space; where that cannot be read, the first pcurve's image.
    fn surface_curve(&mut self, mut attributes: Attributes<'t>) -> Outcome<Curve> {
        let in_space = attributes.reference("curve in space").and_then(|curve| self.curve(curve));
        let fault = match in_space {
            Ok(curve) => return Ok(curve),
            Err(fault) => fault,
        };
        for pcurve in attributes.found_references() {
            if matches!(self.table.kind(pcurve), Kind::Pcurve | Kind::BoundedPcurve)
                && let Ok(curve) = self.curve(pcurve)
            {
                let message = format!("{}; the curve on the surface was taken instead.", fault.message);
                self.note(Severity::Warning, "curve-from-pcurve", pcurve, message);
                return Ok(curve);
            }
        }
        Err(fault)
    }

    /// `trimmed_curve`: the basis curve, the part that is used, and whether it runs backwards.
    fn trimmed(&mut self, index: usize) -> Outcome<CompositeSegment> {
        let mut attributes = self.table.attributes(index).after(1);
        let basis = attributes.reference("basis curve")?;
        let curve = self.curve(basis)?;
        let ends = [self.trim(&mut attributes)?, self.trim(&mut attributes)?];
        let sense = attributes.flag();
        let by_point = attributes.enumeration() == Some("CARTESIAN");
        let t1 = self.trim_parameter(index, &curve, ends[0], by_point)?;
        let t2 = self.trim_parameter(index, &curve, ends[1], by_point)?;
        let (range, reversed) = trim_range(&curve, t1, t2, sense);
        Ok(CompositeSegment { curve, range, reversed })
    }

    fn trim(&self, attributes: &mut Attributes<'t>) -> Outcome<Trim> {
        let mut trim = Trim::default();
        for param in attributes.list("trim")? {
            match param {
                Param::Reference(id) => {
                    trim.point = self.table.find(id).and_then(|point| self.point(point).ok());
                }
                other => trim.parameter = attributes.number(Some(other), "trim parameter").ok(),
            }
        }
        Ok(trim)
    }

    /// The parameter of a trim. Where parameter and point disagree the point is taken: angles written in the
    /// wrong unit are common, wrong points are not.
    fn trim_parameter(&mut self, index: usize, curve: &Curve, trim: Trim, by_point: bool) -> Outcome<f64> {
        let given = trim.parameter.map(|t| t * parameter_scale(curve, self.units.angle_rad));
        match (given, trim.point) {
            (Some(t), None) => Ok(t),
            (given, Some(point)) => {
                let foot = curve.project(point, None);
                let tolerance = (1e-4 * foot.point.length()).max(10.0 * self.units.uncertainty_mm).max(1e-6);
                match given {
                    Some(t) if !by_point && curve.point(t).distance(point) <= foot.distance + tolerance => {
                        Ok(t)
                    }
                    Some(_) if !by_point => {
                        let message = format!(
                            "The ends of #{} disagree with its parameters; the points were taken.",
                            self.table.id(index)
                        );
                        self.note(Severity::Warning, "trim-mismatch", index, message);
                        Ok(foot.t)
                    }
                    _ => Ok(foot.t),
                }
            }
            (None, None) => Err(self.fault(index, "has no usable end")),
        }
    }

    /// The curve of a `pcurve` in the parameters of `surface`, whose unit are millimetres and radians.
    pub fn pcurve(&mut self, index: usize, surface: &Surface) -> Outcome<Curve> {
        let item = self.pcurve_item(index)?;
        let curve = self.in_parameters(|reader| reader.curve(item));
        self.scaled(index, curve?, surface)
    }

    /// The same with its ends.
    fn pcurve_segment(&mut self, index: usize, surface: &Surface) -> Outcome<CompositeSegment> {
        let item = self.pcurve_item(index)?;
        let segment = self.in_parameters(|reader| reader.segment(item))?;
        Ok(CompositeSegment { curve: self.scaled(index, segment.curve, surface)?, ..segment })
    }

    fn pcurve_item(&self, index: usize) -> Outcome<usize> {
        let representation = self.table.attributes(index).after(2).reference("reference to curve")?;
        let items = self.table.attributes(representation).after(1).references("items")?;
        items.first().copied().ok_or_else(|| self.fault(index, "has no curve"))
    }

    /// Reads in a parameter plane, where lengths are not lengths.
    fn in_parameters<T>(&mut self, read: impl FnOnce(&mut Self) -> T) -> T {
        let length_mm = std::mem::replace(&mut self.units.length_mm, 1.0);
        let result = read(self);
        self.units.length_mm = length_mm;
        result
    }

    fn scaled(&self, index: usize, curve: Curve, surface: &Surface) -> Outcome<Curve> {
        let scale = surface_parameter_scale(surface, self.units.length_mm, self.units.angle_rad);
        scaled_pcurve(curve, scale).ok_or_else(|| self.fault(index, "mixes units that cannot be converted"))
    }
}

/// A bounded segment as a curve that ends where the segment does.
pub(crate) fn bounded_segment(segment: CompositeSegment) -> Curve {
    let domain = segment.curve.domain();
    if !segment.reversed && domain.start >= segment.range.start && domain.end <= segment.range.end {
        segment.curve
    } else {
        Curve::Composite(CompositeCurve { segments: vec![segment] })
    }
}

/// A bounded segment as a curve of its own; only a reversed one changes its parameter.
pub(crate) fn whole_segment(segment: CompositeSegment) -> Curve {
    if segment.reversed {
        Curve::Composite(CompositeCurve { segments: vec![segment] })
    } else {
        segment.curve
    }
}

/// Turns segments over that run against those before them: their senses, and those of the trimmed curves in them, cannot
/// be relied on; how they meet can.
pub(crate) fn turn_end_to_end(segments: &mut [CompositeSegment]) {
    let runs: Vec<[DVec3; 3]> = segments
        .iter()
        .map(|segment| [0.0, 0.5, 1.0].map(|share| segment.curve.point(segment.parameter(share))))
        .collect();
    segments.iter_mut().zip(turned(&runs)).for_each(|(segment, turned)| segment.reversed ^= turned);
}

/// Range and direction of a curve that runs from `t1` to `t2`, in the curve's sense or against it.
fn trim_range(curve: &Curve, t1: f64, t2: f64, sense: bool) -> (Interval, bool) {
    let (mut low, mut high) = if sense { (t1, t2) } else { (t2, t1) };
    if let Some(period) = curve.period() {
        // Ends that coincide mean the whole closed curve.
        while high <= low + 1e-12 * period {
            high += period;
        }
        if high - low > period {
            high = low + period;
        }
        (Interval::new(low, high), !sense)
    } else {
        let backwards = low > high;
        if backwards {
            std::mem::swap(&mut low, &mut high);
        }
        let domain = curve.domain();
        (Interval::new(domain.clamp(low), domain.clamp(high)), sense == backwards)
    }
}

/// What one parameter unit of the file is in the curve's own parameter: angles are in the file's angle unit.
fn parameter_scale(curve: &Curve, angle_rad: f64) -> f64 {
    match curve {
        Curve::Circle { .. } | Curve::Ellipse { .. } => angle_rad,
        _ => 1.0,
    }
}

/// The same for both parameters of a surface.
pub(crate) fn surface_parameter_scale(surface: &Surface, length_mm: f64, angle_rad: f64) -> [f64; 2] {
    match surface {
        Surface::Plane { .. } => [length_mm, length_mm],
        Surface::Cylinder { .. } | Surface::Cone { .. } => [angle_rad, length_mm],
        Surface::Sphere { .. } | Surface::Torus { .. } => [angle_rad, angle_rad],
        Surface::Extrusion { profile, .. } => [parameter_scale(profile, angle_rad), 1.0],
        Surface::Revolution { profile, .. } => [angle_rad, parameter_scale(profile, angle_rad)],
        Surface::Nurbs(_) => [1.0, 1.0],
        Surface::Offset { basis, .. } => surface_parameter_scale(basis, length_mm, angle_rad),
    }
}

/// A pcurve scaled by different factors along u and v; conics stand only one factor.
fn scaled_pcurve(curve: Curve, scale: [f64; 2]) -> Option<Curve> {
    if scale == [1.0, 1.0] {
        return Some(curve);
    }
    match curve {
        Curve::Line { .. } | Curve::Polyline(_) | Curve::Nurbs(_) => {
            Some(curve.transformed(&DAffine3::from_scale(DVec3::new(scale[0], scale[1], 1.0))))
        }
        Curve::Composite(composite) => {
            let segments = composite.segments.into_iter().map(|segment| {
                Some(CompositeSegment { curve: scaled_pcurve(segment.curve, scale)?, ..segment })
            });
            Some(Curve::Composite(CompositeCurve { segments: segments.collect::<Option<_>>()? }))
        }
        other if scale[0] == scale[1] => {
            Some(other.transformed(&DAffine3::from_scale(DVec3::splat(scale[0]))))
        }
        _ => None,
    }
}
