//! A flow, or many, allocates where it is made, and never again: frames, new points, new fields, and what goes wrong.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use affine_runtime::model::Owned;
use affine_runtime::prelude::*;

/// The system's allocator, which counts for each thread.
struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: all that is asked is handed on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: of the caller.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        // SAFETY: of the caller.
        unsafe { System.dealloc(block, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

fn allocated<R>(work: impl FnOnce() -> R) -> (usize, R) {
    let before = ALLOCATIONS.get();
    let done = work();
    (ALLOCATIONS.get() - before, done)
}

/// A block that falls.
#[affine_model(
    dim = 3,
    kinetic(dalembert = 0.25, space_translation = 1),
    potential = orthogonality(100) + g*x[3],
    emit(splitting, lanes, nystrom, taylor),
)]
#[derive(Clone, Copy, Debug)]
struct Block {
    g: f64,
}

const METHODS: [Method; 10] = [
    Method::Radau { stages: None },
    Method::Automatic,
    Method::RungeKutta8,
    Method::RungeKutta5,
    Method::RungeKuttaNystrom12,
    Method::RungeKuttaNystrom8,
    Method::Taylor { order: None },
    Method::Splitting { order: 4, step: 0.005 },
    Method::AdaptiveSplitting { order: None },
    Method::Gauss { stages: 2, step: 0.005 },
];

#[test]
fn nothing_is_allocated_after_the_construction() -> affine_runtime::Result<()> {
    let block = |g: f64| Block { g }.prepare();
    let spinning = Matrix::<3>::new(0.2, -1.0, 0.3, 1.1, 0.0, -0.5, -0.2, 0.4, 0.1);
    let velocity = Vector::<3>::new(1.0, 0.0, 3.0);
    let start = block(9.81)?.at_velocity(Vector::zeros(), Matrix::identity(), velocity, spinning)?;
    for method in METHODS {
        let falling = Owned(block(9.81)?);
        let (made, flow) = allocated(|| Flow::by(method, falling, (0.0, start)));
        assert!(made > 0, "{method:?}: the allocator counts");
        let mut flow = flow?;
        let other = Owned(block(3.0)?);
        let (frames, done) = allocated(|| -> affine_runtime::Result<()> {
            for frame in 1..=100 {
                flow.advance_to(f64::from(frame) / 60.0)?;
                let _ = (flow.point(), flow.statistics(), flow.interpolate(flow.t() - 1e-4)?);
                if frame == 40 {
                    flow.set_model(other);
                }
                if frame == 70 {
                    flow.set_point(start)?;
                }
            }
            let _ = flow.advance(f64::NAN);
            Ok(())
        });
        done?;
        assert_eq!(frames, 0, "{method:?}");
    }
    Ok(())
}

#[test]
fn nothing_is_allocated_for_many_bodies_after_the_construction() -> affine_runtime::Result<()> {
    let block = |g: f64| Block { g }.prepare();
    let spinning = Matrix::<3>::new(0.2, -1.0, 0.3, 1.1, 0.0, -0.5, -0.2, 0.4, 0.1);
    let start =
        block(9.81)?.at_velocity(Vector::zeros(), Matrix::identity(), Vector::<3>::zeros(), spinning)?;
    let (falling, other) = (Owned(block(9.81)?), Owned(block(3.0)?));
    for is_splitting in [true, false] {
        let bodies = [(falling, start); 19];
        let (made, flows) = allocated(|| match is_splitting {
            true => Flows::by_splitting((4, 0.005), 0.0, bodies),
            false => Flows::by_runge_kutta(1e-9, 0.0, bodies),
        });
        assert!(made > 0, "the allocator counts");
        let mut flows = flows?;
        let (frames, done) = allocated(|| -> affine_runtime::Result<()> {
            for frame in 1..=100 {
                flows.advance_to(f64::from(frame) / 60.0)?;
                assert!(flows.points().count() == 19 && flows.stopped().count() == 0);
                flows.set_model(frame as usize % 19, other)?;
                flows.set_point(frame as usize % 7, start)?;
            }
            let _ = flows.advance(f64::NAN);
            Ok(())
        });
        done?;
        assert_eq!(frames, 0, "{is_splitting}");
    }
    Ok(())
}
