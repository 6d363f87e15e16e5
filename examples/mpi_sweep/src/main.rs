//! A sweep over two fields on any number of ranks, whose checksum does not depend on it.
//!
//! Each rank runs its shard of the ensemble and keeps a number and a hash of each body's end; the first rank puts them in the
//! order of their numbers. With a folder each rank writes its ends as it goes, and goes on after those that are there.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::time::Instant;

use affine_runtime::model::Owned;
use affine_runtime::prelude::*;
use affine_runtime::simulate::Format;
use mpi::datatype::PartitionMut;
use mpi::traits::{Communicator, CommunicatorCollectives, Root};

/// A planar body, stiff in its dilatation, soft in its shear.
#[affine_model(
    dim = 2,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(c),
    emit(lanes),
)]
#[derive(Clone)]
struct Body {
    kappa: f64,
    c: f64,
}

/// Values of the first field.
const COLUMNS: u64 = 100;

type Bodies = Ensemble<'static, 2, Owned<PreparedBody>>;

/// The shard of a rank: of each body the same start, and fields by its number.
fn shard(bodies: u64, (rank, ranks): (i32, i32)) -> affine_runtime::Result<Bodies> {
    let starts = (0..bodies).map(|number| {
        let (row, column) = (number / COLUMNS, number % COLUMNS);
        let model = Body { kappa: 5.0 + 0.1 * column as f64, c: 0.1 + 0.01 * row as f64 }.prepare()?;
        let start = model.at_velocity(Matrix::<2>::identity(), Matrix::<2>::new(0.3, 0.5, -0.1, -0.2))?;
        Ok((Owned(model), start))
    });
    // Before any of them runs, what is ill posed is told of.
    starts.clone().find_map(affine_runtime::Result::err).map_or(Ok(()), Err)?;
    let ensemble = Ensemble::of(starts.filter_map(affine_runtime::Result::ok)).until(20.0).tolerance(1e-9);
    Ok(ensemble.shard(rank as u64, ranks as u64))
}

/// A hash of all bits of an end, or of the reason why there is none.
fn hash<P>(end: &Result<P, affine_runtime::simulate::Stop>, numbers: impl Fn(&P) -> Vec<f64>) -> u64 {
    let mut hasher = DefaultHasher::new();
    match end {
        Ok(point) => numbers(point).iter().for_each(|number| number.to_bits().hash(&mut hasher)),
        Err(stop) => stop.to_string().hash(&mut hasher),
    }
    hasher.finish()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let universe = mpi::initialize().ok_or("no MPI")?;
    let world = universe.world();
    let place = (world.rank(), world.size());
    let mut arguments = std::env::args().skip(1);
    let bodies = arguments.next().map_or(Ok(20_000), |count| count.parse::<u64>())?;
    if let Some(folder) = arguments.next() {
        let folder = format!("{folder}/{}-of-{}", place.0, place.1);
        let fields =
            |number: u64| vec![5.0 + 0.1 * (number % COLUMNS) as f64, 0.1 + 0.01 * (number / COLUMNS) as f64];
        return Ok(shard(bodies, place)?.save(folder, (Format::Csv, 4096), &["kappa", "c"], fields)?);
    }
    let begin = Instant::now();
    let (mut found, one) = (Vec::new(), Body { kappa: 5.0, c: 0.1 }.prepare()?);
    shard(bodies, place)?.each(|body| {
        found.push(body.number);
        found.push(hash(&body.end, |point| one.flatten(point).as_ref().to_vec()));
    })?;
    let seconds = begin.elapsed().as_secs_f64();
    world.barrier();
    let root = world.process_at_rank(0);
    if place.0 != 0 {
        root.gather_into(&(found.len() as i32));
        root.gather_varcount_into(&found[..]);
        return Ok(());
    }
    let mut counts = vec![0_i32; place.1 as usize];
    root.gather_into_root(&(found.len() as i32), &mut counts[..]);
    let starts: Vec<i32> =
        counts.iter().scan(0, |sum, count| Some(std::mem::replace(sum, *sum + count))).collect();
    let mut all = vec![0_u64; counts.iter().sum::<i32>() as usize];
    root.gather_varcount_into_root(&found[..], &mut PartitionMut::new(&mut all[..], counts, &starts[..]));
    let mut pairs: Vec<&[u64]> = all.chunks(2).collect();
    pairs.sort_unstable();
    let is_whole =
        pairs.iter().enumerate().all(|(k, pair)| pair[0] == k as u64) && pairs.len() as u64 == bodies;
    let mut sum = DefaultHasher::new();
    pairs.hash(&mut sum);
    let gathered = begin.elapsed().as_secs_f64() - seconds;
    println!("{bodies} bodies on {} ranks: checksum {:016x}", place.1, sum.finish());
    println!(
        "{:.2} us a body and rank, {gathered:.4} s to gather",
        1e6 * seconds * f64::from(place.1) / bodies as f64
    );
    if is_whole { Ok(()) } else { Err("bodies are missing".into()) }
}
