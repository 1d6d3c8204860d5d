//! Megabytes per second over a generated file of about ten megabytes that is made up as CAD systems' files are: a good
//! half points and directions, then edges, faces and splines.

#![allow(missing_docs, reason = "criterion's macros make undocumented items")]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::fmt::Write;
use std::hint::black_box;
use trimloop_part21::{Args, Exchange, Param};

fn generated(bytes: usize) -> Vec<u8> {
    let mut text =
        String::from("ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n");
    let mut id = 1;
    while text.len() < bytes {
        let x = f64::from(id) * 0.7390851332151607 % 100.;
        write!(
            text,
            "#{}=CARTESIAN_POINT('',({x:.12},{:.9},-1.5E-03));\n#{}=DIRECTION('',(0.,0.,1.));\n\
             #{}=VERTEX_POINT('',#{id});\n#{}=EDGE_CURVE('',#{},#{},#{},.T.);\n#{}=ORIENTED_EDGE('',*,*,#{},.F.);\n\
             #{}=B_SPLINE_CURVE_WITH_KNOTS('',3,(#{id},#{id},#{id},#{id}),.UNSPECIFIED.,.F.,.F.,(4,4),(0.,{x:.6}),.UNSPECIFIED.);\n\
             #{}=(GEOMETRIC_REPRESENTATION_CONTEXT(3)REPRESENTATION_CONTEXT('ID1','3D'));\n",
            id, x * 0.31, id + 1, id + 2, id + 3, id + 2, id + 2, id + 5, id + 4, id + 3, id + 5, id + 6
        )
        .expect("a string can be written to");
        id += 7;
    }
    text.push_str("ENDSEC;\nEND-ISO-10303-21;\n");
    text.into_bytes()
}

/// Every parameter is looked at, every number converted, every string decoded.
fn walk(args: Args) -> f64 {
    args.map(|param| match param {
        Param::Integer(value) => value as f64,
        Param::Real(value) => value,
        Param::Reference(id) => id as f64,
        Param::String(text) => text.decode().len() as f64,
        Param::List(list) | Param::Typed(_, list) => walk(list),
        _ => 0.,
    })
    .sum()
}

fn walk_all(exchange: &Exchange) -> f64 {
    exchange.instances().flat_map(|instance| instance.parts()).map(|(_, args)| walk(args)).sum()
}

fn parse(criterion: &mut Criterion) {
    let text = generated(10_000_000);
    let mut group = criterion.benchmark_group("part21");
    group.throughput(Throughput::Bytes(text.len() as u64)).sample_size(20);
    group.bench_function("parse", |bencher| {
        bencher.iter_with_large_drop(|| Exchange::parse(text.clone()).expect("an exchange file"));
    });
    let exchange = Exchange::parse(text.clone()).expect("an exchange file");
    assert_eq!(exchange.errors(), []);
    group.bench_function("walk all arguments", |bencher| bencher.iter(|| walk_all(black_box(&exchange))));
    group.bench_function("parse and walk all arguments", |bencher| {
        bencher.iter(|| walk_all(&Exchange::parse(text.clone()).expect("an exchange file")));
    });
    group.finish();
}

criterion_group!(benches, parse);
criterion_main!(benches);
