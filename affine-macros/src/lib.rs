//! The attribute `#[affine_model(...)]`: kinetic energies of affinely-rigid bodies turned into Hamilton equations.

use proc_macro::TokenStream;

/// States the kinetic energy of an affinely-rigid body and derives everything else.
///
/// On a unit struct, or a struct with named fields: `f64`, or a matrix (other fields are left alone):
///
/// | key | value | meaning |
/// |---|---|---|
/// | `dim` | `2`, `3` | dimension; `n` in expressions |
/// | `kinetic(...)` | terms | the kinetic energy, a sum of the terms below |
/// | `group` | `unitary` | placements in U(n) instead of GL(n, R): `-A/2 tr Om^2 - B/2 (tr Om)^2`, emitted as its lattice on the circle |
/// | `hamiltonian(...)` | terms | instead of `kinetic(...)`: the same, stated through momenta, below |
/// | `metrics(space = g, body = eta)` | matrices | constant metrics other than the identity, below |
/// | `constraint` | `isochoric`, `rigid`, `conformal` | motion confined to SL(n), SO(n), R+ SO(n), below; without it GL+(n) |
/// | `potential` | expression | the potential energy, below |
/// | `dissipation(...)` | terms | Rayleigh's function `R`, a sum of the same terms, positive semidefinite |
/// | `forces` | sum of `custom(..)` | forces that fields compute, below |
/// | `symmetry(space = S, body = B)` | `affine`, `metric`, `none` | a claim: GL(n) or O(n) leaves `T` unchanged; proved or rejected |
/// | `require(...)` | `positive_definite` | a condition to enforce |
/// | `emit(...)` | `taylor`, `nystrom`, `splitting`, `tangent`, `two_polar`, `ratios`, `lanes`, `metric`, `acceleration`, `balance` | what is emitted beyond the default, below |
/// | `crate` | path | the runtime, where it has another name than `affine_runtime` |
///
/// | term | energy |
/// |---|---|
/// | `casimir2 = A` | `A/2 tr Om^2 = A/2 tr Oh^2` |
/// | `casimir1_squared = B` | `B/2 (tr Om)^2` |
/// | `body_inertia = I`, `diag(..)`, `[[..], ..]` | `1/2 tr(Oh J Oh^T)`, (4.14), (4.17) |
/// | `space_inertia = I`, `diag(..)`, `[[..], ..]` | `1/2 tr(Om J Om^T)`, (4.15) |
/// | `body_translation = m` | `m/2 \|phi^-1 x_dot\|^2`, (4.4) |
/// | `space_translation = m` | `m/2 \|x_dot\|^2`, (4.5) |
/// | `dalembert = I`, `diag(..)`, `[[..], ..]` | `1/2 tr(phi_dot J phi_dot^T)`, (2.1) |
/// | `body_tensor = [[..], ..]`, `space_tensor = [[..], ..]` | `1/2 K[nA+B][nC+D] O[A][B] O[C][D]`, (4.1), (4.2) |
/// | `flat_tensor = [[..], ..]` | the same over `phi_dot` |
///
/// `Oh = phi^-1 phi_dot`, `Om = phi_dot phi^-1`. A coefficient is an arithmetic expression over exact decimal literals,
/// fields and `n`; `^` binds tightest and to the right, above the sign: `-a^2` is `-(a^2)`.
///
/// Where a matrix may stand, a field of matrix type may, alone: `body_inertia = j` with `j: Matrix<3>`, `Matrix3<f64>`,
/// `SMatrix<f64, 3, 3>` or `[[f64; 3]; 3]`, the type written out with any path before it; `9 x 9` for a tensor of
/// `dim = 3`. `prepare()` takes its symmetric part, refuses it where the two triangles differ by more than rounding, and
/// inverts the energy once. Symmetries and conserved quantities are those for every such matrix, so that a claim that
/// only a special one keeps is refused. Of momenta that are not conserved as a whole the components that are stand in
/// the list of what is conserved, `Vort_12` or `S_12 + 2*S_13 - S_23`: sums over translations and rotations of space and of
/// the body, or over the entries of one affine momentum, with factors that depend on no field.
///
/// On the momentum side, `X = Sigma = phi Pi` or `Sigma_hat = Pi phi`, `|W|^2` the sum over `a < b` of `W_ab^2`:
///
/// | term of `hamiltonian(...)` | energy |
/// |---|---|
/// | `casimir2 = a` | `a/2 tr X^2` |
/// | `casimir1_squared = b` | `b/2 (tr X)^2` |
/// | `vorticity_squared = c`, or `spin_squared = c` | `c/2 \|Vort\|^2`, `c/2 \|S\|^2` |
/// | `body_translation = k` | `k/2 \|phi^T p\|^2`, `k = 1/m` |
/// | `space_translation = k` | `k/2 \|p\|^2`, `k = 1/m` |
/// | `casimir3 = d` | `d/3 tr X^3`, n = 3; no `at_velocity` and no kinetic energy of velocities, which do not determine the momentum |
///
/// `I + A = 1/a`, `I - A = 1/(2c - a)`, `I + A + n B = 1/(a + n b)` is the same model on the velocity side.
///
/// With `metrics(...)`, `g` and `eta` symmetric and positive definite, every transpose and norm is the metric one
/// (`g^-1 Y^T g` in space, `eta^-1 X^T eta` in the body), and `det phi`, `q` are those of orthonormal bases. Points have
/// the user's coordinates; equations, reduced states and plain arrays those of orthonormal bases. A matrix `J` has upper
/// indices, `1/2 eta_KL Oh^K_A Oh^L_B J^AB` (4.17) and `1/2 g_ij phi_dot^i_A phi_dot^j_B J^AB` (2.1), in space
/// `1/2 g_ij Om^i_k Om^j_l J^kl`, so that the scalar `I` is `J = I eta^-1`, in space `I g^-1`; a tensor `K` is contracted with
/// the components of the velocity and reads no metric. Both are carried to orthonormal bases when the program compiles, or
/// by `prepare()` where the metric is a field. Forces and potentials of fields are told placements and velocities in the
/// user's bases and answer there; `isotropic`, `green` and `finger` mean rotations of the metrics. Entries in potentials are
/// those of the user's bases, `G_AB = g_ij phi^i_A phi^j_B` and `Ct^ij = eta^AB phi^i_A phi^j_B`; `tr(phi)` and `tr(G*Ct)`,
/// which depend on the bases, are refused.
///
/// Terms of different frames add: the mass matrix then depends on `phi`, and is factorised in the equations. A sum that
/// is not positive definite at every placement is checked at each start, and a motion into a degenerate mass matrix ends
/// with `Reason::Degenerate`.
///
/// `emit(metric)` adds the methods `metric(&phi)` and `inverse_metric(&phi)`, the configuration metric over
/// `(x_dot, phi_dot)` with `phi_dot` row by row, and its inverse, under a constraint that on the velocities left free;
/// `emit(acceleration)` adds `acceleration(&point)`, the acceleration of the centre of mass, `acceleration(t, &point)` where
/// it depends on the time. `emit(balance)` adds, for `dalembert` models, `balance(t, &point)` and
/// `centre_balance(t, &point)`: the kinematical spin
/// `K = phi J phi_dot^T` and both sides of its balance in space and body, (3.6), (3.8), (3.9).
///
/// `emit(splitting)` adds the exact flows of pieces of `H`, for `Method::Splitting` and, by which `Method::Automatic` passes
/// over a stiff dilatation, `Method::AdaptiveSplitting`: the Casimirs and the norm of vorticity or
/// spin of an isotropic energy, the squares `d/2 <E, X>^2` that any other energy of affine velocities is a sum of
/// (`phi -> phi exp(t d <E, X> E)`), `T(Pi)`, translation and potential, and the dilatation of an isotropic energy along its
/// closed form under the stiffest summand `c q^2` or `c sinh(k q)^2` of the potential, whatever the others are. Constraints
/// go with it, but not `dalembert` under `isochoric`, with its multiplier, or `conformal`, with its weight `D^2`; nor do
/// terms of different frames.
///
/// `emit(two_polar)` is the lattice form `(q, p, M, N)` of doubly isotropic models. Beside it, `splitting` adds the exact flows
/// of the lattice's pieces (`lattice::LatticeSplitting`; with `group = unitary` it stands alone), and `ratios`, for affine
/// velocities without a potential, the same equations in `exp(q_b - q_a)`, `M + N` and `M - N`, where they are rational.
/// `emit(nystrom)` states the equations of `dalembert` and `flat_tensor` under a potential as `q'' = f(t, q)`, for
/// Runge-Kutta-Nystrom steps of orders 8 and 12; `emit(tangent)` adds the variational equations of motions without a
/// constraint, which `affine_runtime::variation::Variation` integrates.
///
/// A potential is an expression in `q = ln(det phi)/n`, `D = exp(q)`, `det`, the invariants `I1..In` of `G`, traces, the
/// entries of `G = phi^T phi`, `Ct = phi phi^T` and `phi`, such as `G[1,2]`, with translation `x[1]` and `norm(x)`, the time `t`,
/// and the functions `exp ln sqrt abs sin cos tan sinh cosh tanh`; `log(u)` is `ln(u)`, `log1p(u)` is `ln(1 + u)` and `expm1(u)`
/// is `exp(u) - 1`. Exponents are whole numbers, and fractions of `det`, `D`, `In` and single stretches, which are positive:
/// `tr(G)*det^(-2/3)`. It is differentiated symbolically.
///
/// A trace is taken of a polynomial in `G`, `Ct` and `phi`, where a number stands for that multiple of the identity, so that
/// `tr(1) = n`, and is expanded to traces of products:
///
/// | trace | the same |
/// |---|---|
/// | `tr(G^2)` | `tr(G*G)` |
/// | `tr((G - 1)*(G - 1))`, `tr((G - 1)^2)` | `tr(G*G) - 2*tr(G) + n` |
/// | `tr(2*G*G - 3*G + 1)` | `2*tr(G*G) - 3*tr(G) + n` |
/// | `tr((G - tr(G)/n)^2)` | `tr(G*G) - tr(G)^2/n` |
/// | `tr(G^-1)`, `tr(Ct^-1)` | `I1/I2 = tr(G)/det^2` for n = 2, `I2/I3` for n = 3 |
///
/// The log-stretches `q1..qn`, the stretches `Q1..Qn = exp(q1)..exp(qn)` (singular values of `phi`), and
/// `pairs(f(d))`, the sum of an even `f(q_a - q_b)` over `a < b`, make isotropic potentials. Exchanging two stretches must
/// change nothing, and no root, logarithm or quotient may vanish where two coincide; what is a function of `q`, `tr(G)` and
/// `tr(G*G)` is written through these. `abs` is for what keeps its sign, for fields, and inside even functions such as
/// `abs(q)^2`. With `t` the energy is not conserved.
///
/// Named potentials are written `name(coefficient, ..)`:
///
/// | name | formula |
/// |---|---|
/// | `hyperbolic_dilatation(kappa)` | `kappa/2 sinh(q)^2` |
/// | `dissociation(kappa)` | `-kappa/2 / cosh(q)^2` |
/// | `harmonic_dilatation(kappa)` | `kappa/2 q^2` |
/// | `neo_hookean(c)` | `c (tr(G) exp(-2q) - n)` |
/// | `saint_venant_kirchhoff(lambda, mu)` | `lambda/2 (tr E)^2 + mu tr E^2`, `E = (G - 1)/2` |
/// | `orthogonality(k)` | `k tr((G - 1)^2)` |
/// | `gas(k)` | `k exp(-2q)` |
///
/// A constraint confines `phi` to a group and affine velocities to its Lie algebra: traceless, skew, or skew plus multiples
/// of the identity. The energy is inverted there, the affine spin is the part of it that acts there (a matrix of the
/// same kind), and only the eigenvalues on the directions left free have to differ from zero: `I+A`, `I-A` (isochoric),
/// `I-A` (rigid), `I-A`, `I+A+nB` (conformal). `dalembert` is `body_inertia` under `rigid` and `D^2` times that under
/// `conformal`; under `isochoric` Hamilton's equations are those of `(phi, Pi)` without the force of the multiplier. Terms of
/// different frames, and `flat_tensor`, have a mass matrix on the Lie algebra that depends on `phi`, factorised as without the
/// constraint; what is the same on the group counts as one frame, as scalar inertias of body and space where `phi` is a rotation
/// up to scale. A Hamiltonian stands for the energy of its velocities, restricted to those that are left free. A term that
/// vanishes on the group and a potential that is constant there are mistakes; a symmetry is claimed of the energy
/// without the constraint. Starting points off the constraint by more than 32 roundings times the condition of `phi`
/// are refused with their defect.
///
/// A summand `custom(field, class)` is computed by a field whose type implements `affine_runtime::potential::Potential`;
/// the class is `isotropic`, `green` (a function of `G`), `finger` (of `Ct`) or `general`, with `position` after it where
/// it depends on `x`. What stays conserved follows from the class, which is compared with the one that the type declares.
///
/// `dissipation(...)` adds the forces `Q_hat = -(dR/dOh)^T`, `Q = -(dR/dOm)^T`, `N = -(dR/dphi_dot)^T`, `Q_tr = -dR/dx_dot`,
/// each in the frame of its term, whatever the frame of `T`; `dH/dt = -2 R`. `R >= 0` is proved, or checked by `prepare()`,
/// frame by frame; the Casimir terms count with those of the body, or else with those of space.
///
/// `forces = custom(field, form) + ..` calls fields whose types implement `affine_runtime::force::Force`; the form is
/// `spatial` (`Q`), `comoving` (`Q_hat`) or `translation` (`Q_tr`), with `gyroscopic` after it where the force has no power:
/// the energy then stays conserved.
///
/// Under a constraint the forces are projected to its group. Dissipation and fields are refused beside `casimir3`,
/// `group = unitary`, `emit(splitting)`, `emit(nystrom)` and `emit(two_polar)`, fields also beside `emit(taylor)`;
/// `constraint = isochoric` of `dalembert`, which a multiplier keeps, takes only potentials. The power `dU/dt` of a potential
/// that contains `t` is part of the balance of energy, with forces or alone, but beside `emit(splitting)`, `emit(nystrom)`
/// and that multiplier.
///
/// The struct becomes a model of the runtime, with `at_momentum` and `at_velocity` to make phase points. Where
/// coefficients depend on fields, `prepare()` checks their values and returns the model as `PreparedName`, else it returns
/// the model itself; the signature of its energy is `affine_runtime::signature::signature`.
///
/// A model is refused, with the condition, its numbers and the remedy, where the Legendre transformation is
/// degenerate, a claim is broken, a matrix is not what its term asks for, or a number of its equations is none that `f64`
/// holds.
#[proc_macro_attribute]
pub fn affine_model(args: TokenStream, item: TokenStream) -> TokenStream {
    affine_codegen::expand(args.into(), item.into()).into()
}
