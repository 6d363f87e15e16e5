//! The methods by which a trajectory can be computed.

/// How a trajectory is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Method {
    /// The closed form where model and start have one; else, where `emit(nystrom)` asked for it and unless there
    /// are events, which look at times within steps, [`Method::RungeKuttaNystrom12`], or at tolerances above
    /// 1e-3 [`Method::RungeKuttaNystrom8`]; else [`Method::Taylor`] where `emit(taylor)` asked
    /// for it, the tolerance is at most 1e-11 and the motion begins as a series, as it does not where a root vanishes; else
    /// [`Method::RungeKutta8`]. Before these two, and unless
    /// there are events, [`Method::AdaptiveSplitting`] where `emit(splitting)` gave a stiff dilatation a closed form within a
    /// piece and the tolerance lets steps pass over several turns of it. The motion of a body under a
    /// constraint is integrated in charts of its group, see [`Chart`](affine_integrators::lie::Chart), by Runge-Kutta
    /// steps and by Gauss collocation: the placement stays on the group up to rounding.
    #[default]
    Automatic,
    /// The closed form; an error where there is none.
    ClosedForm,
    /// Embedded explicit Runge-Kutta method of order 8, [`RungeKutta8`](affine_integrators::RungeKutta8).
    RungeKutta8,
    /// Embedded explicit Runge-Kutta method of order 5, [`RungeKutta5`](affine_integrators::RungeKutta5): the usual baseline. Its
    /// estimate is that of its fourth-order solution and its steps are many, so that more is left of a tolerance: the
    /// vibrating body errs by 8 to 75 tolerances at t = 50, from 1e-2 to 1e-12, where order 8 errs by 1 to 3, as
    /// `cargo run --release --example vibrating_body` prints. With its dilatation in the state it is 25 to 210 for 3 to 5
    /// (`cargo test -p affine-runtime --test simulation order_5 -- --nocapture`), and what adds up grows with the time.
    RungeKutta5,
    /// Taylor series, [`Taylor`](affine_integrators::Taylor), of a model with `emit(taylor)`; an error for others.
    /// Under a constraint the steps are in the space around the group and keep it within their error, about rounding at a tolerance
    /// of 1e-13; [`Method::Automatic`] does not take them there. Points of a looser run are too far off it for `at_momentum`, so
    /// that an event cannot change them by it.
    Taylor {
        /// The order, 2 to 32; `None`: the one that suits the tolerance.
        order: Option<usize>,
    },
    /// Runge-Kutta-Nystrom method of order 12, [`RungeKuttaNystrom`](affine_integrators::RungeKuttaNystrom), of a model
    /// with `emit(nystrom)`, whose equations are `q'' = f(t, q)`; an error for others. Output times between steps are
    /// reached by a shorter step from the one before.
    RungeKuttaNystrom12,
    /// The same of order 8.
    RungeKuttaNystrom8,
    /// Gauss collocation, [`Gauss`](affine_integrators::Gauss): implicit, symmetric, of order `2 stages`, in equal
    /// steps; the tolerance plays no part. Keeps every linear and quadratic first integral of the reduced equations
    /// up to rounding, and is symplectic where the reduced variables are canonical, `phi` and `Pi`. With affine spins
    /// the variables are Lie-Poisson: there the method is no Poisson map, and energy and cubic Casimir invariants
    /// are kept to its order, unless they are quadratic in the reduced variables. Output times between steps are
    /// reached by a shorter step from the one before, which leaves the sequence of steps as it is.
    /// [`Method::Automatic`] never takes it, for at equal errors it costs several times as much, however stiff the body:
    /// `cargo run --release --example work_precision -- symplectic` shows it. Four and six stages cost less than two and
    /// three where errors are below about 1e-6.
    Gauss {
        /// Number of stages, 2, 3, 4 or 6.
        stages: usize,
        /// Length of a step, positive; the interval is divided into equal steps that are not longer.
        #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
        step: f64,
    },
    /// Radau IIA collocation, [`Radau`](affine_integrators::Radau): implicit and L-stable, for friction that takes velocities away
    /// faster than the motion goes on. The number of steps does not depend on how strong the friction is. Steps run over
    /// affine velocities in the frame in which the friction does not depend on the placement: there the motions that are left
    /// lie in a plane, and long steps stay in it. [`Method::Automatic`] takes it where velocities die out
    /// 1600 times in a run.
    Radau {
        /// Number of stages, 3, 5 or 7, of orders 5, 9 and 13; `None`: 3 at tolerances from 1e-4 up, 5 from 1e-7 up, 7 below.
        stages: Option<usize>,
    },
    /// [`Rattle`](affine_integrators::Rattle), for isochoric bodies of masses, `kinetic(dalembert = ...)`, without forces that
    /// depend on velocities: explicit but for its multiplier, symmetric, in equal steps; the tolerance plays no part. Keeps
    /// both constraints, and spin and vorticity where they are conserved, up to rounding, and is symplectic on the constrained
    /// phase space. Output times between steps are reached by a shorter step from the one before.
    Rattle {
        /// Order of the composition, 2, 4, 6 or 8: of 1, 5, 9 or 17 steps.
        order: usize,
        /// Length of a step, positive; the interval is divided into equal steps that are not longer.
        #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
        step: f64,
    },
    /// Exact flows of pieces of the Hamiltonian in turn, [`Splitting`](affine_integrators::Splitting), of a model with
    /// `emit(splitting)`; an error for others. Explicit, symmetric, in equal steps; the tolerance plays no part. A step
    /// is a symplectic (Poisson) map, and keeps momentum maps and Casimirs up to rounding. Output times between steps are
    /// reached by a shorter step from the one before, which leaves the sequence of steps as it is.
    ///
    /// [`Method::Automatic`] never takes it: what it is for is what it keeps, over runs that are longer than the motion can
    /// be followed, and its steps know no tolerance, as those of [`Method::AdaptiveSplitting`] do. The stiff dilatation that
    /// a reduction separates is separated for every method alike. Where it stays in the state and the potential of an
    /// isotropic energy is `U_dil(q)`, quadratic or hyperbolic, and anything else, it moves along its closed form here, in
    /// one piece with the Casimirs, by elliptic functions: steps need not resolve it, as those of every other method do.
    /// (Forces `dW/dq` that change with it can move it by `t dW/dq/(m w)` where steps take whole swings of its frequency
    /// `w`.)
    ///
    /// Under strong friction order 2 is the one: higher orders go back in time on their way, and amplify what friction has taken. A
    /// motion by them ends where velocities die out more than 10 times, by order 8 more than 6 times, within a step,
    /// [`Reason::Friction`](super::Reason::Friction). That is looked at where it begins and after 1, 2, 4, 8 steps and so on; in
    /// [`Flows`](super::Flows) where a body begins.
    Splitting {
        /// The order, 2, 4, 6 or 8.
        order: usize,
        /// Length of a step, positive; the interval is divided into equal steps that are not longer.
        #[cfg_attr(feature = "serde", serde(with = "crate::inner::number"))]
        step: f64,
    },
    /// The same in steps by their error, [`AdaptiveSplitting`](affine_integrators::AdaptiveSplitting): for a stiff dilatation that
    /// a piece has in closed form. Momentum maps and Casimirs are kept up to rounding, but the motion as a whole is not
    /// symplectic: the energy is kept to the tolerance, and may drift. Output times between steps are reached by shorter
    /// steps from the one before; within a step that passes over many turns of the dilatation an event may be missed.
    AdaptiveSplitting {
        /// The order, 2, 4, 6 or 8; `None`: 4.
        order: Option<usize>,
    },
}

impl Method {
    /// Length of the equal steps, where that is what the method takes.
    pub(crate) fn step(self) -> Option<f64> {
        match self {
            Method::Gauss { step, .. } | Method::Rattle { step, .. } | Method::Splitting { step, .. } => {
                Some(step)
            }
            Method::Automatic
            | Method::ClosedForm
            | Method::RungeKutta8
            | Method::RungeKutta5
            | Method::RungeKuttaNystrom12
            | Method::RungeKuttaNystrom8
            | Method::AdaptiveSplitting { .. }
            | Method::Radau { .. }
            | Method::Taylor { .. } => None,
        }
    }
}
