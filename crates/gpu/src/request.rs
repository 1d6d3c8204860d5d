//! What is asked for, and what comes back.

use glam::{DVec2, DVec3, Vec4};
use trimloop_geom::Derivatives;

use crate::{GpuError, Shape};

/// Where a shape is evaluated.
#[derive(Clone, Debug)]
pub enum Places {
    /// At every pair of a value of u and a value of v: `us.len()` rows x `vs.len()` columns, row-major over u.
    Grid {
        /// Parameters along u.
        us: Vec<f64>,
        /// Parameters along v (of a curve: one, of any value).
        vs: Vec<f64>,
    },
    /// At each of these (u, v).
    List(Vec<DVec2>),
}

impl Places {
    /// A grid of `rows` x `columns` even steps over the shape's domain, its ends included (one line lies in the middle).
    pub fn even(shape: &Shape, rows: usize, columns: usize) -> Self {
        let [us, vs] = [(0, rows), (1, columns)].map(|(d, count)| {
            let domain = shape.domain()[d];
            let last = count.saturating_sub(1).max(1) as f64;
            let share = |k: usize| if count == 1 { 0.5 } else { k as f64 / last };
            (0..count).map(|k| domain.at(share(k))).collect()
        });
        Self::Grid { us, vs }
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        match self {
            Self::Grid { us, vs } => us.len() * vs.len(),
            Self::List(list) => list.len(),
        }
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The parameters of a point.
    pub fn uv(&self, index: usize) -> DVec2 {
        match self {
            Self::Grid { us, vs } => DVec2::new(us[index / vs.len()], vs[index % vs.len()]),
            Self::List(list) => list[index],
        }
    }
}

/// One shape and where it is evaluated.
#[derive(Clone, Debug)]
pub struct Request<'a> {
    /// The shape.
    pub shape: &'a Shape,
    /// Where.
    pub places: Places,
}

/// What is computed at each point; each includes those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Quantities {
    /// The point.
    Points,
    /// And the unit normal.
    Normals,
    /// And the first derivatives.
    First,
    /// And the second derivatives, and curvatures.
    Second,
}

impl Quantities {
    /// Vectors of four numbers per point in device buffers.
    pub fn stride(self) -> usize {
        match self {
            Self::Points => 1,
            Self::Normals => 2,
            Self::First => 4,
            Self::Second => 8,
        }
    }

    /// Orders of derivatives along one direction, plus one.
    pub(crate) fn kinds(self) -> usize {
        match self {
            Self::Points => 1,
            Self::Normals | Self::First => 2,
            Self::Second => 3,
        }
    }
}

/// The results for one request.
#[derive(Clone, Debug)]
pub struct Values {
    pub(crate) quantities: Quantities,
    pub(crate) data: Data,
}

#[derive(Clone, Debug)]
pub(crate) enum Data {
    /// As the device wrote it, relative to an origin.
    Single { origin: DVec3, vectors: Vec<Vec4> },
    Double {
        points: Vec<DVec3>,
        normals: Vec<DVec3>,
        derivatives: Vec<Derivatives>,
        curvatures: Vec<[f64; 4]>,
    },
}

impl Values {
    /// The vector of its points, to be filled anew.
    pub(crate) fn into_room(self) -> Vec<DVec3> {
        match self.data {
            Data::Single { .. } => Vec::new(),
            Data::Double { points, .. } => points,
        }
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        match &self.data {
            Data::Single { vectors, .. } => vectors.len() / self.quantities.stride(),
            Data::Double { points, .. } => points.len(),
        }
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// What was computed.
    pub fn quantities(&self) -> Quantities {
        self.quantities
    }

    fn vector(&self, index: usize, which: usize) -> Option<Vec4> {
        match &self.data {
            Data::Single { vectors, .. } if which < self.quantities.stride() => {
                vectors.get(index * self.quantities.stride() + which).copied()
            }
            _ => None,
        }
    }

    /// The point, millimetres.
    pub fn point(&self, index: usize) -> DVec3 {
        match &self.data {
            Data::Single { origin, .. } => {
                *origin + self.vector(index, 0).unwrap_or(Vec4::NAN).truncate().as_dvec3()
            }
            Data::Double { points, .. } => points[index],
        }
    }

    /// The unit normal dS/du x dS/dv; at a singular point what it tends to, or some unit vector; of a curve zero.
    /// `None` unless asked for.
    pub fn normal(&self, index: usize) -> Option<DVec3> {
        match &self.data {
            Data::Single { .. } => Some(self.vector(index, 1)?.truncate().as_dvec3()),
            Data::Double { normals, .. } => normals.get(index).copied(),
        }
    }

    /// Point and derivatives, the second ones zero unless asked for. `None` unless at least the first ones were.
    pub fn derivatives(&self, index: usize) -> Option<Derivatives> {
        let Data::Double { derivatives, .. } = &self.data else {
            let at = |which| self.vector(index, which).map(|v| v.truncate().as_dvec3());
            let second = |which| at(which).unwrap_or(DVec3::ZERO);
            return Some(Derivatives {
                point: self.point(index),
                du: at(2)?,
                dv: at(3)?,
                duu: second(4),
                duv: second(5),
                dvv: second(6),
            });
        };
        derivatives.get(index).copied()
    }

    /// Gaussian, mean, largest and smallest principal curvature, 1/mm² and 1/mm, positive where the surface bends towards
    /// its normal; of a curve its curvature and zeros. `None` unless asked for.
    pub fn curvatures(&self, index: usize) -> Option<[f64; 4]> {
        match &self.data {
            Data::Single { .. } => Some(self.vector(index, 7)?.to_array().map(f64::from)),
            Data::Double { curvatures, .. } => curvatures.get(index).copied(),
        }
    }

    pub(crate) fn append(&mut self, other: Self) {
        match (&mut self.data, other.data) {
            (Data::Single { vectors, .. }, Data::Single { vectors: more, .. }) => vectors.extend(more),
            (
                Data::Double { points, normals, derivatives, curvatures },
                Data::Double { points: p, normals: n, derivatives: d, curvatures: c },
            ) => {
                points.extend(p);
                normals.extend(n);
                derivatives.extend(d);
                curvatures.extend(c);
            }
            // One request is one kind of data.
            _ => {}
        }
    }
}

/// An evaluator's name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Backend {
    /// f64 on all cores.
    Cpu,
    /// Krishnamurthy et al. 2009, a row of knots for each line.
    KrishnamurthyUnpacked,
    /// The same with four lines in a vector.
    KrishnamurthyPacked,
    /// The same with indices into shared knot vectors.
    KrishnamurthyIndexed,
    /// Tan, Zhao, Lu 2012: de Boor's algorithm, rows then columns.
    Tan,
    /// Bézier facets in workgroup memory.
    #[default]
    Bezier,
}

impl Backend {
    /// All of them; the default is [`Backend::Bezier`].
    pub const ALL: [Self; 6] = [
        Self::Cpu,
        Self::KrishnamurthyUnpacked,
        Self::KrishnamurthyPacked,
        Self::KrishnamurthyIndexed,
        Self::Tan,
        Self::Bezier,
    ];

    /// `cpu`, `krishnamurthy-unpacked`, `krishnamurthy-packed`, `krishnamurthy-indexed`, `tan`, `bezier`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cpu => "cpu",
            Self::KrishnamurthyUnpacked => "krishnamurthy-unpacked",
            Self::KrishnamurthyPacked => "krishnamurthy-packed",
            Self::KrishnamurthyIndexed => "krishnamurthy-indexed",
            Self::Tan => "tan",
            Self::Bezier => "bezier",
        }
    }
}

impl std::str::FromStr for Backend {
    type Err = GpuError;

    fn from_str(name: &str) -> Result<Self, GpuError> {
        Self::ALL.into_iter().find(|backend| backend.name() == name).ok_or_else(|| {
            let names = Self::ALL.map(Self::name).join(", ");
            GpuError::Request(format!("`{name}` is no backend; there are {names}"))
        })
    }
}
