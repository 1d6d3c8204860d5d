//! Surfaces.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

use trimloop_brep::Severity;
use trimloop_geom::{Curve, Frame, Interval, Surface};

use super::attributes::Attributes;
use super::curve::bounded_segment;
use super::fault::Outcome;
use super::keyword::Kind;
use super::reader::Reader;

impl<'t> Reader<'t> {
    /// Any surface that can be read. Trimmed and bounded ones give their basis: as the geometry of a face they
    /// are bounded by the face's loops.
    pub fn surface(&mut self, index: usize) -> Outcome<Surface> {
        self.nested(index, |reader| reader.surface_by_kind(index))
    }

    fn surface_by_kind(&mut self, index: usize) -> Outcome<Surface> {
        let mut attributes = self.table.attributes(index).after(1);
        match self.table.kind(index) {
            Kind::Plane => Ok(Surface::Plane { frame: self.position(&mut attributes)? }),
            Kind::CylindricalSurface => {
                let frame = self.position(&mut attributes)?;
                Ok(Surface::Cylinder { frame, radius: self.length(index, &mut attributes, "radius")? })
            }
            Kind::ConicalSurface => self.cone(index, attributes),
            Kind::SphericalSurface => {
                let frame = self.position(&mut attributes)?;
                Ok(Surface::Sphere { frame, radius: self.length(index, &mut attributes, "radius")? })
            }
            Kind::ToroidalSurface | Kind::DegenerateToroidalSurface => self.torus(index, attributes),
            Kind::SurfaceOfLinearExtrusion => {
                let profile = self.profile(&mut attributes)?;
                let direction = self.vector(attributes.reference("extrusion axis")?)?;
                Ok(Surface::Extrusion { profile, direction })
            }
            Kind::SurfaceOfRevolution => {
                let profile = self.profile(&mut attributes)?;
                let (origin, axis) = self.axis(attributes.reference("axis position")?)?;
                Ok(Surface::Revolution { profile, origin, axis })
            }
            Kind::OffsetSurface => {
                let basis = Arc::new(self.surface(attributes.reference("basis surface")?)?);
                let distance = attributes.real("distance")? * self.units.length_mm;
                Ok(if distance == 0.0 {
                    Arc::unwrap_or_clone(basis)
                } else {
                    Surface::Offset { basis, distance }
                })
            }
            Kind::RectangularTrimmedSurface | Kind::CurveBoundedSurface => {
                self.surface(attributes.reference("basis surface")?)
            }
            Kind::SurfaceReplica => {
                let parent = self.surface(attributes.reference("parent surface")?)?;
                let map = self.transformation_operator(attributes.reference("transformation")?)?;
                Ok(parent.transformed(&map).0)
            }
            Kind::BSplineSurfaceWithKnots
            | Kind::UniformSurface
            | Kind::QuasiUniformSurface
            | Kind::BezierSurface
            | Kind::RationalBSplineSurface
            | Kind::BSplineSurface => self.spline_surface(index).map(Surface::Nurbs),
            _ => Err(self.unexpected(index, "surface")),
        }
    }

    /// The curve that is swept. A trimmed one matters only where no loop bounds the face; elsewhere its basis gives
    /// the parameters that the file means.
    fn profile(&mut self, attributes: &mut Attributes<'t>) -> Outcome<Arc<Curve>> {
        let curve = attributes.reference("swept curve")?;
        if self.whole_surface && self.table.kind(curve) == Kind::TrimmedCurve {
            return self.segment(curve).map(|segment| Arc::new(bounded_segment(segment)));
        }
        self.curve(curve).map(Arc::new)
    }

    fn position(&self, attributes: &mut Attributes<'_>) -> Outcome<Frame> {
        self.frame(attributes.reference("position")?)
    }

    /// `conical_surface`. A half angle past a right angle cannot be radians; exporters that forget to declare
    /// degrees exist.
    fn cone(&mut self, index: usize, mut attributes: Attributes<'t>) -> Outcome<Surface> {
        let frame = self.position(&mut attributes)?;
        let radius = attributes.real("radius")? * self.units.length_mm;
        let written = attributes.real("half angle")?;
        let mut half_angle_rad = written * self.units.angle_rad;
        if half_angle_rad.abs() >= FRAC_PI_2 {
            half_angle_rad = written.to_radians();
            let message = format!(
                "The half angle of cone #{} is no angle in radians; degrees were assumed.",
                self.table.id(index)
            );
            self.note(Severity::Warning, "angle-in-degrees", index, message);
        }
        if half_angle_rad.abs() >= FRAC_PI_2 || radius < 0.0 {
            return Err(self.fault(index, "its radius or half angle is impossible"));
        }
        if half_angle_rad.abs() > 1e-12 {
            Ok(Surface::Cone { frame, radius, half_angle_rad })
        } else if radius > 0.0 {
            Ok(Surface::Cylinder { frame, radius })
        } else {
            Err(self.fault(index, "has neither radius nor angle"))
        }
    }

    /// `toroidal_surface` and `degenerate_toroidal_surface`, of which the outer part (apple) or the inner part
    /// (lemon) is used (ISO 10303-42 §4.5.35). Some systems write a lemon as the outer part about a circle of negative
    /// radius, whose normal points the other way than that of the inner part.
    fn torus(&mut self, index: usize, mut attributes: Attributes<'t>) -> Outcome<Surface> {
        let frame = self.position(&mut attributes)?;
        let major = attributes.real("major radius")? * self.units.length_mm;
        let minor = self.length(index, &mut attributes, "minor radius")?;
        let outer = attributes.flag();
        let v_range = (major.abs() < minor).then(|| {
            let crossing = (-major / minor).acos();
            if outer { Interval::new(-crossing, crossing) } else { Interval::new(crossing, TAU - crossing) }
        });
        Ok(Surface::Torus { frame, major, minor, v_range })
    }
}
