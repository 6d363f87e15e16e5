//! Parts of an ensemble, and bodies that are run again.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use affine_runtime::model::Owned;
use affine_runtime::prelude::*;
use affine_runtime::simulate::{Format, Member};

use crate::models::{Elastic, PreparedVibrating, Sampled, Vibrating, vibrating};
use crate::saved::Folder;

type Seen = Vec<Member<<PreparedVibrating as Model<3>>::Point<f64>, f64>>;

const BODIES: usize = 43;

/// Bodies with a model each, and the sum of what they pass through.
fn seen(
    part: impl FnOnce(
        Ensemble<'static, 3, Owned<PreparedVibrating>>,
    ) -> Ensemble<'static, 3, Owned<PreparedVibrating>>,
) -> Seen {
    let starts = vibrating().samples(BODIES, 61);
    let bodies = starts.into_iter().enumerate().map(|(k, start)| {
        (Owned(Vibrating { kappa: 10.0, c1: 0.2 + 0.05 * k as f64 }.prepare().unwrap()), start)
    });
    let mut seen = Vec::new();
    part(Ensemble::of(bodies).until(1.0).tolerance(1e-9).every(0.1))
        .fold(|_, _| 0.0, |sum: &mut f64, t, point| *sum += t * point.phi().norm(), |body| seen.push(body))
        .unwrap();
    seen
}

#[test]
fn shards_put_together_are_the_ensemble() {
    let whole = seen(|ensemble| ensemble);
    assert_eq!(
        whole.iter().map(|body| body.number).collect::<Vec<_>>(),
        (0..BODIES as u64).collect::<Vec<_>>()
    );
    for of in [1, 2, 3, 7, 50] {
        let mut merged: Seen = (0..of).flat_map(|k| seen(|ensemble| ensemble.shard(k, of))).collect();
        merged.sort_by_key(|body| body.number);
        assert_eq!(merged, whole, "{of} shards");
    }
}

#[test]
fn a_body_is_run_again_from_its_number() {
    let whole = seen(|ensemble| ensemble);
    for number in [0, 17, BODIES as u64 - 1] {
        let again = seen(|ensemble| ensemble.numbers(number..number + 1));
        assert_eq!(again, whole[number as usize..=number as usize]);
    }
    let rest = seen(|ensemble| ensemble.shard(1, 2).numbers(20..u64::MAX));
    let expected: Seen = whole.into_iter().filter(|body| body.number % 2 == 1 && body.number >= 20).collect();
    assert_eq!(rest, expected, "what a shard had left");
    let sixths = seen(|ensemble| ensemble.shard(1, 2).shard(2, 3));
    assert!(sixths.iter().map(|body| body.number).eq((0..BODIES as u64).filter(|k| k % 6 == 5)));
}

/// Starts without an end, of which no more are taken than numbers ask for.
#[test]
fn endless_starts_end_at_the_last_number() {
    let start = Elastic.samples(7, 62);
    let taken = Arc::new(AtomicU64::new(0));
    let ensemble = || {
        let taken = Arc::clone(&taken);
        let starts = start.clone().into_iter().cycle().inspect(move |_| {
            // A panic is better than an ensemble that never comes to an end.
            assert!(taken.fetch_add(1, Ordering::Relaxed) < 10, "a start that no number asks for");
        });
        Ensemble::new(&Elastic, starts).until(0.05).tolerance(1e-6)
    };
    assert_eq!(ensemble().numbers(3..10).run().unwrap().len(), 7);
    assert_eq!(taken.swap(0, Ordering::Relaxed), 10);
    assert_eq!(ensemble().shard(1, 2).numbers(0..u64::MAX).numbers(2..10).run().unwrap().len(), 4);
    taken.store(0, Ordering::Relaxed);
    let folder = Folder::new("endless");
    for _ in 0..2 {
        ensemble().numbers(0..10).save(&folder.0, (Format::Csv, 4), &[], |_| Vec::new()).unwrap();
        assert_eq!(folder.files().len(), 1 + 3);
        taken.store(0, Ordering::Relaxed);
    }
}

/// Neither chunks nor threads: more bodies than are there at once, in pools of one thread and of three.
#[test]
fn bits_do_not_depend_on_threads_or_chunks() {
    let start = Elastic.samples(7, 62);
    let sums = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let (mut sum, mut ends) = (0.0_f64, Vec::new());
            Ensemble::new(&Elastic, (0..5000).map(|k| start[k % 7]))
                .until(0.05)
                .tolerance(1e-6)
                .every(0.02)
                .fold(
                    |_, _| 0.0,
                    |sum: &mut f64, t, point| *sum += t * point.phi().norm(),
                    |body| {
                        sum += body.folded;
                        ends.push(body.end.unwrap().phi().norm().to_bits());
                    },
                )
                .unwrap();
            (sum.to_bits(), ends)
        })
    };
    let one = sums(1);
    assert_eq!(one.1.len(), 5000);
    assert_eq!(sums(3), one);
}
