//! Any bytes as an exchange file: nothing may panic, hang or take memory out of proportion, and what the table gives
//! must be consistent.

#![no_main]

use libfuzzer_sys::fuzz_target;
use trimloop_part21::{Args, Exchange, Param, ReadOptions};

fuzz_target!(|bytes: &[u8]| {
    let options = ReadOptions { max_bytes: 1 << 24, ..ReadOptions::default() };
    if let Ok(exchange) = Exchange::parse_with(bytes.to_vec(), &options) {
        check(&exchange);
    }
});

fn check(exchange: &Exchange) {
    for instance in exchange.instances() {
        assert!(exchange.get(instance.id()).is_some_and(|found| found.offset() == instance.offset()));
        assert!(!instance.keyword().is_empty());
        let walked: usize = instance.parts().map(|(_, args)| walk(args)).sum();
        assert_eq!(walked, instance.references().count());
    }
    exchange.anchors().for_each(|anchor| assert!(!anchor.name.contains('>')));
    assert_eq!(exchange.references().len(), exchange.references().count());
    let lines: Vec<_> = exchange.errors().iter().map(|error| error.position.line).collect();
    assert!(lines.is_sorted());
    let counted: usize = exchange.sections().iter().map(|section| section.instances.len()).sum();
    assert!(counted <= exchange.len());
}

/// Converts and decodes everything; gives the number of references.
fn walk(args: Args) -> usize {
    assert_eq!(args.count(), args.map(drop).count());
    let inside = |param| match param {
        Param::List(list) | Param::Typed(_, list) => walk(list),
        Param::String(text) => {
            text.decode();
            0
        }
        Param::Real(value) => {
            assert!(!value.is_nan());
            0
        }
        Param::Reference(_) => 1,
        _ => 0,
    };
    args.map(inside).sum()
}
