//! Same input, same options, same bytes.

use rayon::ThreadPoolBuilder;
use trimloop_tests::conversion::{Conversion, default_deflection};

use crate::{DEFAULT, all_hold};

#[test]
fn one_thread_writes_the_same_bytes_as_many() {
    let alone = ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    all_hold(&DEFAULT, |_, conversion| {
        let again = alone.install(|| Conversion::of(&conversion.fixture, &default_deflection()));
        if again.is_ok_and(|again| again.glb == conversion.glb) {
            Vec::new()
        } else {
            vec!["other bytes".into()]
        }
    });
}
