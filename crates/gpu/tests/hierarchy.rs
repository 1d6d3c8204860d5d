//! Trees of bicubic patches: they approximate as well as they say, and the device evaluates them.

mod specimens;

use glam::{DVec2, DVec3, Vec4};
use specimens::{gpu, sheet, whole};
use trimloop_geom::{Frame, Interval, Surface};
use trimloop_gpu::{PatchGrid, PatchTree, Shape, evaluate_patches};

fn shapes() -> Vec<(&'static str, Shape)> {
    let torus = Surface::Torus { frame: Frame::WORLD, major: 20.0, minor: 7.0, v_range: None };
    let domain = [Interval::new(0.3, 5.0), Interval::new(-1.0, 4.0)];
    vec![
        ("cubic", whole(sheet([3, 3], 4, 1.0))),
        ("rational", whole(sheet([3, 2], 3, 2.0))),
        ("degree 9 x 5", whole(sheet([9, 5], 2, 1.5))),
        ("degree 1", whole(sheet([1, 1], 6, 1.0))),
        ("torus", Shape::surface(&torus, domain).expect("finite")),
    ]
}

/// The coarsest nodes within `off_mm`, and the leaves' depth.
fn cut(tree: &mut PatchTree, shape: &Shape, off_mm: f64) -> Vec<usize> {
    let (mut open, mut out) = (vec![0], Vec::new());
    while let Some(index) = open.pop() {
        if tree.node(index).error_mm <= off_mm {
            out.push(index);
        } else {
            let first = tree.split(shape, index);
            assert_eq!(tree.node(index).first_child(), Some(first));
            open.extend([first, first + 1]);
        }
    }
    out
}

#[test]
fn a_cut_covers_the_domain_within_its_error_and_inside_of_its_boxes() {
    for (name, shape) in shapes() {
        let mut tree = PatchTree::new(&shape).expect("NURBS");
        let mut before = 0;
        for share in [1e-2, 1e-4, 1e-6] {
            let off_mm = share * shape.size();
            let cut = cut(&mut tree, &shape, off_mm);
            assert!(cut.len() >= before, "{name}");
            before = cut.len();
            let area = |d: [Interval; 2]| d[0].length() * d[1].length();
            let whole = area(shape.domain());
            let sum: f64 = cut.iter().map(|k| area(tree.patch(*k).domain)).sum();
            assert!((sum / whole - 1.0).abs() < 1e-9, "{name}: {sum} of {whole}");
            for &node in &cut {
                let patch = tree.patch(node);
                for k in 0..49 {
                    let at = |d: usize, k: usize| patch.domain[d].at(k as f64 / 6.0);
                    let exact = shape.derivatives(DVec2::new(at(0, k / 7), at(1, k % 7))).point;
                    let bounds = tree.node(node).bounds;
                    let slack = DVec3::splat(1e-9 * shape.size());
                    assert!(exact.cmpge(bounds.min - slack).all() && exact.cmple(bounds.max + slack).all());
                }
            }
        }
        assert!(before < 3000, "{name}: {before} patches");
    }
}

#[test]
fn what_is_at_most_cubic_is_exact_between_its_knots() {
    let shape = whole(sheet([3, 3], 4, 1.0));
    let mut tree = PatchTree::new(&shape).expect("NURBS");
    let exact = cut(&mut tree, &shape, 0.0);
    let mut originals: Vec<usize> = exact.iter().filter_map(|k| tree.node(*k).original()).collect();
    originals.sort_unstable();
    assert_eq!(originals, (0..16).collect::<Vec<_>>());
    // Splits follow the bend, so a patch may be cut where its neighbours are not yet apart.
    let shape = whole(sheet([3, 2], 3, 2.0));
    let mut tree = PatchTree::new(&shape).expect("NURBS");
    assert!((9..=12).contains(&cut(&mut tree, &shape, 0.0).len()));
}

#[test]
fn the_device_evaluates_what_the_tree_promises() {
    let Some(gpu) = gpu() else { return };
    for (name, shape) in shapes() {
        let mut tree = PatchTree::new(&shape).expect("NURBS");
        let off_mm = 1e-4 * shape.size();
        let nodes = cut(&mut tree, &shape, off_mm);
        let cells = [7, 5];
        let each = (8 * 6_usize).next_multiple_of(64);
        let grid = |node: usize| PatchGrid { shape: &shape, tree: &tree, node, cells };
        let requests: Vec<_> =
            nodes.iter().enumerate().map(|(k, &n)| grid(n).request(shape.origin(), k * each)).collect();
        let bytes = (nodes.len() * each * 2 * size_of::<Vec4>()) as u64;
        let vertices = gpu.device().create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: bytes,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        evaluate_patches(gpu, &requests, &vertices).expect("evaluated");
        let found: Vec<Vec4> = gpu.download("vertices", &vertices, bytes).expect("read back");
        let [u, v] = shape.domain();
        let (mut farthest, mut widest): (f64, f64) = (0.0, 0.0);
        for (k, &node) in nodes.iter().enumerate() {
            let shares = [grid(node).shares(0), grid(node).shares(1)];
            for vertex in 0..48 {
                let [a, b] = [0, 1].map(|n| found[2 * (k * each + vertex) + n]);
                let share = DVec2::new(shares[0][vertex / 6], shares[1][vertex % 6]);
                assert!((share - DVec2::new(f64::from(a.w), f64::from(b.w))).abs().max_element() < 1e-6);
                let uv = DVec2::new(u.at(share.x), v.at(share.y));
                let point = a.truncate().as_dvec3() + shape.origin();
                farthest = farthest.max(point.distance(shape.derivatives(uv).point));
                widest = widest.max(b.truncate().as_dvec3().angle_between(shape.normal(uv)));
            }
        }
        println!(
            "{name:14} {:>5} patches {:>10.1e} off {widest:.4} rad",
            nodes.len(),
            farthest / shape.size()
        );
        assert!(farthest <= off_mm + 2e-6 * shape.size(), "{name}: {farthest}");
        assert!(name == "degree 1" || widest < 0.06, "{name}: {widest}");
    }
}
