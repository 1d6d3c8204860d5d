use super::*;

/// A full grid over `knots`, wavy, with some weights.
fn grid(knots: [Vec<f64>; 2]) -> TMesh {
    let counts = knots.each_ref().map(|k| k.len() - 4);
    let mut vertices = Vec::new();
    for i in 0..counts[0] {
        for j in 0..counts[1] {
            let (x, y) = (i as f64, j as f64);
            let z = (x * 1.3).sin() + (y * 0.7).cos() * 0.5;
            let weight = 1.0 + 0.3 * ((i * 3 + j) % 4) as f64;
            vertices.push(MeshVertex { lines: [i + 2, j + 2], position: DVec3::new(x, y, z), weight });
        }
    }
    TMesh { knots, vertices, edges: Vec::new() }
}

fn clamped(inner: &[f64], end: f64) -> Vec<f64> {
    [0.0; 4].into_iter().chain(inner.iter().copied()).chain([end; 4]).collect()
}

/// A grid with a column of vertices taken out over half of its height: T-junctions at its end.
fn with_junctions() -> TMesh {
    let mut mesh = grid([clamped(&[1.0, 2.0, 2.5, 3.0], 4.0), clamped(&[1.0, 2.0, 2.5, 4.0], 5.0)]);
    let is_out = |[i, j]: [usize; 2]| (i == 6 && j < 6) || (j == 6 && i > 7);
    mesh.vertices.retain(|v| !is_out(v.lines));
    mesh
}

fn places(domain: [Interval; 2]) -> Vec<DVec2> {
    let at = |k: usize, n: usize, d: usize| domain[d].at(k as f64 / n as f64);
    (0..=23).flat_map(|i| (0..=17).map(move |j| DVec2::new(at(i, 23, 0), at(j, 17, 1)))).collect()
}

fn evaluated(patch: &BezierPatch, uv: DVec2) -> DVec3 {
    let bernstein = |d: usize| {
        let t = (uv[d] - patch.domain[d].start) / patch.domain[d].length();
        let s = 1.0 - t;
        [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
    };
    let (bu, bv) = (bernstein(0), bernstein(1));
    let sum: DVec4 = (0..16).map(|k| patch.points[k] * (bu[k / 4] * bv[k % 4])).sum();
    sum.truncate() / sum.w
}

#[test]
fn a_grid_without_junctions_is_the_nurbs_surface() {
    let mesh = grid([clamped(&[1.0, 1.0, 2.0], 3.0), clamped(&[0.5], 2.0)]);
    let lifted: Vec<DVec4> = mesh.vertices.iter().map(|v| (v.position * v.weight).extend(v.weight)).collect();
    let nurbs = NurbsSurface::from_homogeneous([3, 3], 7, 5, &lifted, mesh.knots.clone()).expect("valid");
    let spline = TSpline::new(mesh).expect("valid");
    for uv in places(spline.domain()) {
        let (a, b) = (spline.derivatives(uv), nurbs.derivatives(uv));
        assert!(a.point.distance(b.point) < 1e-12, "{uv}");
        assert!(a.du.distance(b.du) < 1e-10 && a.duv.distance(b.duv) < 1e-9 && a.dvv.distance(b.dvv) < 1e-9);
    }
}

#[test]
fn patches_are_the_surface_and_fewer_than_a_grid_needs() {
    let spline = TSpline::new(with_junctions()).expect("valid");
    let patches = spline.convert_to_bezier();
    let area: f64 = patches.iter().map(|p| p.domain[0].length() * p.domain[1].length()).sum();
    assert!((area - 20.0).abs() < 1e-12);
    assert!(patches.len() < spline.to_nurbs().expect("finite").bezier_patches().patches.len());
    for uv in places(spline.domain()) {
        let holds = |p: &&BezierPatch| (0..2).all(|d| p.domain[d].contains(uv[d]));
        let own = patches.iter().find(holds).expect("covered");
        assert!(evaluated(own, uv).distance(spline.point(uv)) < 1e-12, "{uv}");
    }
}

#[test]
fn one_nurbs_surface_is_the_same() {
    let spline = TSpline::new(with_junctions()).expect("valid");
    let nurbs = spline.to_nurbs().expect("finite");
    for uv in places(spline.domain()) {
        assert!(nurbs.point(uv).distance(spline.point(uv)) < 1e-12, "{uv}");
    }
}

#[test]
fn junctions_change_the_knots_of_their_neighbours() {
    let spline = TSpline::new(with_junctions()).expect("valid");
    let of = |lines: [usize; 2]| {
        let k = spline.mesh().vertices.iter().position(|v| v.lines == lines).expect("a vertex");
        spline.points()[k].knots[0]
    };
    // Line 6 (u = 2.5) is not there below line 6 of v.
    assert_eq!(of([5, 4]), [0.0, 1.0, 2.0, 3.0, 4.0]);
    assert_eq!(of([5, 7]), [0.0, 1.0, 2.0, 2.5, 3.0]);
}

#[test]
fn derivatives_are_those_of_differences() {
    let spline = TSpline::new(with_junctions()).expect("valid");
    let h = 1e-5;
    for uv in [DVec2::new(0.3, 0.4), DVec2::new(2.2, 2.7), DVec2::new(3.7, 4.6)] {
        let d = spline.derivatives(uv);
        let (du, dv) = (DVec2::new(h, 0.0), DVec2::new(0.0, h));
        let slope = |step: DVec2| (spline.point(uv + step) - spline.point(uv - step)) / (2.0 * h);
        assert!(slope(du).distance(d.du) < 1e-8 && slope(dv).distance(d.dv) < 1e-8);
        let twist = (spline.derivatives(uv + dv).du - spline.derivatives(uv - dv).du) / (2.0 * h);
        let bend = (spline.derivatives(uv + du).du - spline.derivatives(uv - du).du) / (2.0 * h);
        assert!(twist.distance(d.duv) < 1e-6 && bend.distance(d.duu) < 1e-6);
    }
}

#[test]
fn text_goes_round() {
    let spline = TSpline::new(with_junctions()).expect("valid");
    assert_eq!(TSpline::parse(&spline.to_text()), Ok(spline));
}

#[test]
fn what_makes_no_sense_is_told_with_its_line() {
    let told = |text: &str| TSpline::parse(text).expect_err("refused").to_string();
    assert!(told("").contains("line 1"));
    assert!(told("tspline 2\n").contains("tspline 1"));
    assert!(told("tspline 1\n\nq 1 2").contains("line 3"));
    assert!(told("tspline 1\np 1 2 3").contains("line 2"));
    assert!(told("tspline 1\nu 0 0 1 x").contains("line 2"));
    assert!(told("tspline 1\nu 0 0 0 0 1 1 1\nv 0 0 0 0 1 1 1 1").contains("along u"));
    let knots = "tspline 1\nu 0 0 0 0 1 1 1 1\nv 0 0 0 0 1 1 1 1\n";
    assert!(told(knots).contains("hole"));
    assert!(told(&format!("{knots}p 1 2 0 0 0")).contains("lines 1, 2"));
    assert!(told(&format!("{knots}p 2 2 0 0 0 -1")).contains("weight"));
    assert!(told(&format!("{knots}p 2 2 0 0 0\np 2 2 0 0 0")).contains("two vertices"));
    assert!(told(&format!("{knots}e 2 2 3 3")).contains("edge 0"));
}
