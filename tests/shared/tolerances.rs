//! Every tolerance of these tests, with its reason. All are relative, in the Frobenius norm of one quantity.

/// Generated code against exact values, per condition of the mass matrix: some hundred roundings of 1.1e-16 each in
/// the Legendre transformation, in conversions between the frames and in brackets. The largest error seen is 6e-16.
pub const CANONICAL: f64 = 1e-14;

/// Generated code with a potential against exact kinetic parts and gradients by forward differentiation in `f64`, per
/// condition of the mass matrix: the roundings of [`CANONICAL`], of `ln det phi` and of the gradient's own arithmetic. All
/// errors seen are below 1e-15.
pub const UNDER_POTENTIAL: f64 = 1e-14;

/// Brackets that vanish but for rounding errors of gradients in `f64`, in numbers of order 1 to 100.
pub const BRACKET_ZERO: f64 = 1e-10;
/// A bracket that does not vanish, for data of order 1, is at least this in one of several samples.
pub const BRACKET_VISIBLE: f64 = 1e-4;

/// Generated code with a dissipation against exact values, per condition of the mass matrix: the roundings of
/// [`CANONICAL`] and of one more product with `phi^-1` on each side.
pub const DAMPED: f64 = 2e-14;

/// The balance of energy and work over a run at tolerance 1e-12: the errors of some hundred steps.
pub const POWER_BALANCE: f64 = 1e-11;

/// The same where the power depends on the time alone: the steps are those of the motion, which does not see it. Of order 8
/// in steps of some hundredths.
pub const UNSEEN_POWER: f64 = 1e-9;

/// A closed form against integration, over a time in which the body turns or stretches by 1.5: errors of the
/// integrator are eps per step, of the closed form eps times the norm of the exponents, of either times the growth of
/// the motion. The largest error seen is 2e-13.
pub const GEODESIC: f64 = 1e-12;

/// Two closed forms of one motion, each a product of two exponentials of matrices of norm up to 1.5, the velocity
/// between them known to eps times the condition of the form. The largest error seen is 2e-13.
pub const MARTIN_NEFF: f64 = 1e-12;

/// The drunk missile to t = 10 against 25 digits, x included: the rounding errors of some hundred steps, grown by the
/// motion. The largest error seen is 8e-15.
pub const REFERENCE_SOLUTION: f64 = 1e-13;

/// Conserved quantities of the same motion, which are taken from the state by conversions between the frames. The
/// largest error seen is 2e-15.
pub const CONSERVED: f64 = 3e-14;

/// Vibrating bodies against reference solutions: the errors of some thousand steps of 1e-15 each, and rounding errors
/// grown by the motion. A plain form of the equations, integrated likewise, has at most 1e-13 in `phi` and, where the
/// vibration is stiff, 3e-12 in the momentum.
pub const VIBRATION: f64 = 1e-11;

/// The same per radian of the fastest vibration: ten units of rounding of its phase.
pub const VIBRATION_PER_RADIAN: f64 = 10.0 * f64::EPSILON;

/// A closed form that stays on a group, per condition of the placement: the rounding errors of two exponentials of
/// norm up to 20 and their products.
pub const ON_THE_GROUP: f64 = 1e-13;

/// A driven motion whose solution is known, absolute in numbers of order 1: a hundred steps of 1e-13 at most.
pub const DRIVEN: f64 = 1e-11;

/// How far a measured order may be from the order of the method, between steps that are not small beside the time in
/// which the driving force turns.
pub const ORDER: f64 = 0.3;
/// Sums of terms of different frames against exact values, per condition of the mass matrix: the roundings of
/// [`CANONICAL`], and those of a factorisation without exchange of rows, whose pivots are smaller than the eigenvalues
/// where the mass matrix is indefinite.
pub const MIXED: f64 = 1e-12;

/// An explicit and an implicit method over four units of time, some hundred steps at 1e-13 each, and a thousand of equal
/// length 0.004 of order 6.
pub const TWO_METHODS: f64 = 1e-11;

/// The time at which a mass matrix degenerates: velocities grow without bound before it, and steps of relative accuracy
/// 1e-12 add up to it from one side.
pub const DEGENERATION: f64 = 1e-9;

/// Exact laws along motions of a few periods: some hundred steps at tolerance 1e-15.
pub const LAWS: f64 = 1e-12;

/// The dilatation of a free conformal body against its closed form: some hundred steps at tolerance 1e-13.
pub const FREE_DILATATION: f64 = 1e-11;
