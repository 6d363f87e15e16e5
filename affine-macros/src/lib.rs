//! The attribute `#[affine_model(...)]`: kinetic energies of affinely-rigid bodies turned into Hamilton equations.

use proc_macro::TokenStream;

/// Turns the energies of an affinely-rigid body, stated on a struct, into a model of it.
///
/// # A short lesson
///
/// A body has the placement `x, phi`: its point `a` is at `x + phi a`. Say how many dimensions there are and which kinetic
/// energy, and add what else there is. Everything else follows.
///
/// ```
/// use affine_runtime::prelude::*;
///
/// #[affine_model(
///     dim = 3,                                              // n, 2 or 3
///     kinetic(dalembert = i, space_translation = 2),        // i/2 tr(phi_dot phi_dot^T) + 2/2 |x_dot|^2
///     potential = neo_hookean(0.5) + 3*(det - 1)^2 + x[3],  // entries count from one; ^ is the power
///     dissipation(dalembert = r),                           // friction: the same terms
/// )]
/// struct Jelly { i: f64, r: f64 }                           // parameters that vary are fields
///
/// let jelly = Jelly { i: 1.0, r: 0.1 }.prepare()?;          // checks them; a struct without fields needs no prepare()
/// let (x, v) = (Vector::<3>::zeros(), Vector::<3>::new(1.0, 0.0, 4.0));
/// let start = jelly.at_velocity(x, Matrix::<3>::identity() * 1.1, v, Matrix::<3>::zeros())?;
/// let velocity = jelly.velocity(&start);                    // the Legendre transformation and back
/// assert!((velocity.x_dot - v).norm() < 1e-14);
/// let run = Simulation::new(&jelly, start).until(1.0).run()?;
/// println!("{}\n{}", run.conservation(), run.why());
/// # Ok::<(), affine_runtime::Error>(())
/// ```
///
/// The struct becomes a model of the runtime, with `at_momentum` and `at_velocity` to make phase points. Where coefficients
/// depend on fields, `prepare()` checks their values and returns the model as `PreparedName`, else it returns the model
/// itself. Energies, equations, conserved quantities and operation counts stand in its documentation. The signature of the
/// energy is `affine_runtime::signature::signature`.
///
/// A model is refused, with the condition, its numbers and the remedy, where the Legendre transformation is degenerate, a
/// claim is broken, a matrix is not what its term asks for, or a number of its equations is none that `f64` holds.
///
/// Below, `Oh = phi^-1 phi_dot` is the co-moving and `Om = phi_dot phi^-1` the spatial affine velocity. The guide of
/// `affine_runtime` has a page with examples on every subject, and a table from papers to attributes.
///
/// # Keys
///
/// | key | value | meaning |
/// |---|---|---|
/// | `dim` | `2`, `3` | dimension; `n` in expressions |
/// | `kinetic(...)` | terms | the kinetic energy, a sum |
/// | `hamiltonian(...)` | terms | instead of `kinetic(...)`: the same, stated through momenta |
/// | `potential` | expression | the potential energy |
/// | `constraint` | `isochoric`, `rigid`, `conformal` | motion confined to SL(n), SO(n), R+ SO(n); without it GL+(n) |
/// | `dissipation(...)` | terms | Rayleigh's function `R`, a sum of kinetic terms, positive semidefinite |
/// | `forces` | sum of `custom(..)` | forces that fields compute |
/// | `metrics(space = g, body = eta)` | matrices | constant metrics other than the identity |
/// | `symmetry(space = S, body = B)` | `affine`, `metric`, `none` | a claim: GL(n) or O(n) leaves `T` unchanged; proved or rejected |
/// | `require(...)` | `positive_definite` | a condition to enforce |
/// | `emit(...)` | names | what is emitted beyond the default |
/// | `group` | `unitary` | placements in U(n) instead of GL(n, R): `-A/2 tr Om^2 - B/2 (tr Om)^2`, emitted as its lattice on the circle; a potential is a function of the angles `q1`, .., `qn` |
/// | `crate` | path | the runtime, where it has another name than `affine_runtime` |
///
/// # Kinetic terms
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
/// Terms of different frames add: the mass matrix then depends on `phi`, and is factorised in the equations. A sum that
/// is not positive definite at every placement is checked at each start, and a motion into a degenerate mass matrix ends
/// with `Reason::Degenerate`.
///
/// # Hamiltonian terms
///
/// `X = Sigma = phi Pi` or `Sigma_hat = Pi phi`, `|W|^2` the sum over `a < b` of `W_ab^2`:
///
/// | term | energy |
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
/// # Coefficients and fields
///
/// | coefficient | may be |
/// |---|---|
/// | number | an arithmetic expression over exact decimal literals, fields of type `f64`, and `n`; `0.2` is 1/5 |
/// | power | `^`, which binds tightest and to the right, above the sign: `-a^2` is `-(a^2)` |
/// | matrix | `diag(..)`, `[[..], ..]`, or a field alone: `body_inertia = j` |
/// | field of a matrix | `Matrix<3>`, `Matrix3<f64>`, `SMatrix<f64, 3, 3>`, `[[f64; 3]; 3]`, with any path before it; `9 x 9` for a tensor of `dim = 3` |
/// | other fields | are left alone |
///
/// `prepare()` takes the symmetric part of a matrix field, refuses it where the two triangles differ by more than rounding,
/// and inverts the energy once. Symmetries and conserved quantities are those for every such matrix, so that a claim that
/// only a special one keeps is refused. Of momenta that are not conserved as a whole the components that are stand in
/// the list of what is conserved, `Vort_12` or `S_12 + 2*S_13 - S_23`: sums over translations and rotations of space and of
/// the body, or over the entries of one affine momentum, with factors that depend on no field.
///
/// # Potentials
///
/// An expression, differentiated symbolically, in these:
///
/// | written | is |
/// |---|---|
/// | `q`, `D`, `det` | `ln(det phi)/n`, `exp(q)`, `det phi` |
/// | `I1..In` | the invariants of `G` |
/// | `G[1,2]`, `Ct[1,2]`, `phi[1,2]` | entries of `G = phi^T phi`, `Ct = phi phi^T`, `phi` |
/// | `tr(..)` | the trace of a polynomial in `G`, `Ct`, `phi`; a number in it is that multiple of the identity |
/// | `q1..qn`, `Q1..Qn` | log-stretches, and stretches `exp(q1)..exp(qn)`, the singular values of `phi` |
/// | `pairs(f(d))` | the sum of an even `f(q_a - q_b)` over `a < b` |
/// | `x[1]`, `norm(x)` | the centre of mass, with translation |
/// | `t` | the time; the energy then is not conserved |
/// | `exp ln sqrt abs sin cos tan sinh cosh tanh` | functions; `log(u)` is `ln(u)`, `log1p(u)` is `ln(1 + u)`, `expm1(u)` is `exp(u) - 1` |
/// | `custom(field, class)` | computed by a field whose type implements `affine_runtime::potential::Potential` |
///
/// Exponents are whole numbers, and fractions of `det`, `D`, `In` and single stretches, which are positive: `tr(G)*det^(-2/3)`.
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
/// | `self_gravity(k)`, n = 3 | `-3/5 k R_F(Q1^2, Q2^2, Q3^2)` with Carlson's integral: a homogeneous ellipsoid in its own gravity, `k = G m^2/r`; a summand by itself |
///
/// A trace is expanded to traces of products:
///
/// | trace | the same |
/// |---|---|
/// | `tr(1)` | `n` |
/// | `tr(G^2)` | `tr(G*G)` |
/// | `tr((G - 1)*(G - 1))`, `tr((G - 1)^2)` | `tr(G*G) - 2*tr(G) + n` |
/// | `tr(2*G*G - 3*G + 1)` | `2*tr(G*G) - 3*tr(G) + n` |
/// | `tr((G - tr(G)/n)^2)` | `tr(G*G) - tr(G)^2/n` |
/// | `tr(G^-1)`, `tr(Ct^-1)` | `I1/I2 = tr(G)/det^2` for n = 2, `I2/I3` for n = 3 |
///
/// Potentials of single stretches are isotropic: exchanging two stretches must change nothing, and no root, logarithm or
/// quotient may vanish where two coincide. What is a function of `q`, `tr(G)` and `tr(G*G)` is written through these. `abs` is
/// for what keeps its sign, for fields, and inside even functions such as `abs(q)^2`.
///
/// The class of `custom(field, class)` is one of these, with `position` after it where the potential depends on `x`. What stays
/// conserved follows from the class, which is compared with the one that the type declares.
///
/// | class | a function of |
/// |---|---|
/// | `isotropic` | stretches |
/// | `green` | `G` |
/// | `finger` | `Ct` |
/// | `general` | `phi` |
///
/// # Constraints
///
/// A constraint confines `phi` to a group and affine velocities to its Lie algebra. The energy is inverted there, the affine
/// spin is the part of it that acts there (a matrix of the same kind), and only the eigenvalues on the directions left free
/// have to differ from zero:
///
/// | constraint | velocities | eigenvalues | `dalembert` is |
/// |---|---|---|---|
/// | `isochoric` | traceless | `I+A`, `I-A` | an energy whose mass matrix depends on `phi` |
/// | `rigid` | skew | `I-A` | `body_inertia` |
/// | `conformal` | skew plus multiples of the identity | `I-A`, `I+A+nB` | `D^2` times `body_inertia` |
///
/// Terms of different frames, `flat_tensor`, and `dalembert` of an isochoric body have a mass matrix on the Lie algebra that
/// depends on `phi`, factorised as without the constraint; what is the same on the group counts as one frame, as scalar
/// inertias of body and space where `phi` is a rotation up to scale. A Hamiltonian stands for the energy of its velocities, restricted to those that are left
/// free. A term that vanishes on the group and a potential that is constant there are mistakes; a symmetry is claimed of the
/// energy without the constraint. Starting points off the constraint by more than 32 roundings times the condition of `phi`
/// are refused with their defect.
///
/// # Friction and forces
///
/// | key | force | power |
/// |---|---|---|
/// | `dissipation(...)` | `Q_hat = -(dR/dOh)^T`, `Q = -(dR/dOm)^T`, `N = -(dR/dphi_dot)^T`, `Q_tr = -dR/dx_dot`, each in the frame of its term, whatever the frame of `T` | `dH/dt = -2 R` |
/// | `forces = custom(field, spatial)` | `Q` | `tr(Q Om)` |
/// | `forces = custom(field, comoving)` | `Q_hat` | `tr(Q_hat Oh)` |
/// | `forces = custom(field, translation)` | `Q_tr` | `Q_tr . x_dot` |
/// | `gyroscopic` after the form | likewise | none: the energy stays conserved |
/// | `position` after the form | likewise; told of velocities that they are zero | as above |
///
/// The type of a field implements `affine_runtime::force::Force`. `R >= 0` is proved, or checked by `prepare()`, frame by frame;
/// the Casimir terms count with those of the body, or else with those of space. Under a constraint the forces are projected to
/// its group.
///
/// The power `dU/dt` of a potential that contains `t` is part of the balance of energy, with forces or alone, but beside
/// `emit(splitting)` and `emit(nystrom)`.
///
/// # Metrics
///
/// With `metrics(...)`, `g` and `eta` symmetric and positive definite, every transpose and norm is the metric one
/// (`g^-1 Y^T g` in space, `eta^-1 X^T eta` in the body), and `det phi`, `q` are those of orthonormal bases.
///
/// | what | stands in |
/// |---|---|
/// | points | the user's coordinates |
/// | equations, reduced states, plain arrays | orthonormal bases |
/// | a matrix `J` | upper indices: `1/2 eta_KL Oh^K_A Oh^L_B J^AB` (4.17), `1/2 g_ij phi_dot^i_A phi_dot^j_B J^AB` (2.1), in space `1/2 g_ij Om^i_k Om^j_l J^kl` |
/// | a scalar `I` | `J = I eta^-1`, in space `I g^-1` |
/// | a tensor `K` | contracted with the components of the velocity; reads no metric |
/// | entries in potentials | the user's bases, `G_AB = g_ij phi^i_A phi^j_B`, `Ct^ij = eta^AB phi^i_A phi^j_B` |
/// | forces and potentials of fields | are told placements and velocities in the user's bases and answer there |
/// | `isotropic`, `green`, `finger` | rotations of the metrics |
///
/// Matrices and tensors are carried to orthonormal bases when the program compiles, or by `prepare()` where the metric is a
/// field. `tr(phi)` and `tr(G*Ct)`, which depend on the bases, are refused.
///
/// # What `emit(...)` adds
///
/// | name | adds | for |
/// |---|---|---|
/// | `taylor` | Taylor coefficients of the motion | `Method::Taylor`, cheaper at tolerances up to 1e-12 |
/// | `nystrom` | the equations as `q'' = f(t, q)` | `dalembert` and `flat_tensor` under a potential: Runge-Kutta-Nystrom steps of orders 8 and 12 |
/// | `splitting` | exact flows of pieces of `H` | `Method::Splitting`; `Method::AdaptiveSplitting`, by which `Method::Automatic` passes over a stiff dilatation |
/// | `tangent` | the variational equations, tangent to the group under a constraint | `affine_runtime::variation::Variation` |
/// | `two_polar` | the lattice form `(q, p, M, N)` | doubly isotropic models |
/// | `ratios`, beside `two_polar` | the same in `exp(q_b - q_a)`, `M + N`, `M - N`, where it is rational | affine velocities without a potential |
/// | `lanes` | the equations over vectors | `Ensemble` |
/// | `metric` | `metric(&phi)` and `inverse_metric(&phi)`, over `(x_dot, phi_dot)` with `phi_dot` row by row | under a constraint that on the velocities left free |
/// | `acceleration` | `acceleration(&point)`, of the centre of mass | `acceleration(t, &point)` where it depends on the time |
/// | `latex` | the formulas of the description in LaTeX | every model has them where `affine_runtime` has the feature `report` |
/// | `balance` | `balance(t, &point)`, `centre_balance(t, &point)`: `K = phi Pi`, `phi J phi_dot^T` of `dalembert`, and both sides of its balance in space and body, (3.6), (3.8), (3.9) | energies with a term in `phi_dot`, sums of frames |
///
/// The pieces of `splitting`:
///
/// | piece | where |
/// |---|---|
/// | the Casimirs and the norm of vorticity or spin | isotropic energies |
/// | squares `d/2 <E, X>^2`, which move `phi -> phi exp(t d <E, X> E)` | any other energy of affine velocities, a sum of them |
/// | `T(Pi)` | `dalembert`, `flat_tensor` |
/// | translation and potential | always |
/// | the dilatation, along its closed form under the stiffest summand `c q^2` or `c sinh(k q)^2` of the potential, whatever the others are | isotropic energies |
/// | those of the lattice (`lattice::LatticeSplitting`) | beside `two_polar`; with `group = unitary` alone |
///
/// # What goes together
///
/// Everything but these pairs; a test tries every one.
///
/// | refused | beside | why |
/// |---|---|---|
/// | `emit(taylor)` | a potential of single stretches | stretches are found by an iteration, and what follows from the operations of a formula does not follow from it |
/// | `emit(taylor)` | `custom(field, form)` in `forces`, `custom(field, form, position)` in `forces`, `custom(field, class)` in `potential` | what a field computes is not known operation by operation |
/// | `emit(taylor)` | `self_gravity(k)` | its integral is found by an iteration, and not known operation by operation |
/// | `emit(splitting)` | `constraint = conformal` of `dalembert` | the energy has the weight D^2, and no piece of it is quadratic in momenta with constant coefficients |
/// | `emit(splitting)` | a mass matrix that depends on `phi` | the mass matrix depends on phi: the flow of the kinetic energy is not known |
/// | `emit(splitting)` | `custom(field, form)` in `forces` | a force is a piece of its own where it depends on positions alone, and is said to: `custom(field, form, position)` |
/// | `emit(nystrom)` | a constraint | Nystrom methods integrate q'' = f(t, q); a constraint acts by forces that depend on velocities |
/// | `emit(nystrom)` | a kinetic energy of affine velocities, a mass matrix that depends on `phi` | Nystrom methods integrate q'' = f(t, q); the mass matrix of phi_dot depends on phi here, and phi'' on phi_dot |
/// | `emit(nystrom)` | `body_translation` | Nystrom methods integrate q'' = f(t, q); the weight of the centre depends on phi here, and x'' on phi_dot |
/// | `emit(nystrom)` | a motion without a potential | a body that nothing acts on moves in a straight line, phi = phi0 + t phi_dot0, known in closed form |
/// | `emit(nystrom)` | `dissipation(...)`, `custom(field, form)` in `forces`, `custom(field, form, position)` in `forces` | Nystrom methods integrate q'' = f(t, q); friction and the work of a force depend on velocities |
/// | `emit(two_polar)` | `metrics(...)` | (q, p, M, N) of (6.2) to (6.5) describe the internal motion on GL(n) alone, in orthonormal coordinates |
/// | `emit(two_polar)` | `constraint = rigid` or `conformal` | all stretches are equal there, and nothing of the lattice moves |
/// | `emit(two_polar)` | a potential of the time, a potential of `x` | (q, p, M, N) of (6.2) to (6.5) describe the internal motion on GL(n) alone, in orthonormal coordinates |
/// | `emit(two_polar)` | `body_translation` | the weight of the centre depends on the stretches, and moves them |
/// | `emit(two_polar)` | `casimir3`, a mass matrix that depends on `phi` | the lattice is that of one quadratic energy of velocities (6.2) to (6.5) |
/// | `emit(two_polar)` | `dissipation(...)`, `custom(field, form)` in `forces`, `custom(field, form, position)` in `forces`, `custom(field, class)` in `potential`, `self_gravity(k)` | its equations follow from T and potentials that are formulas |
/// | `emit(ratios)` | a potential, a kinetic energy of `phi_dot` | in exp(q_b - q_a), M + N and M - N the lattice of the Casimirs is rational, (6.2) to (6.4); forces of a potential and (6.5) are not |
/// | `emit(balance)` | a kinetic energy of affine velocities, a constraint, `metrics(...)` | K = phi Pi, phi J phi_dot^T of (2.1), is balanced against phi_dot and Pi (3.6): for energies with a term in phi_dot, or terms of space and body, of a motion on all of GL(n) in orthonormal coordinates |
/// | `emit(metric)` | `casimir3` | the velocity is quadratic in the momentum, and the kinetic energy no quadratic form of velocities |
/// | `dissipation(...)`, `custom(field, form)` in `forces`, `custom(field, form, position)` in `forces`, `custom(field, class)` in `potential`, `self_gravity(k)` | `casimir3` | what it leaves conserved is decided for velocities that are linear in the momenta |
/// | `dissipation(...)`, `custom(field, form)` in `forces`, `custom(field, form, position)` in `forces`, `custom(field, class)` in `potential`, `self_gravity(k)` | `group = unitary` | the lattice of U(n) is that of the Casimir terms alone |
/// | a constraint | `metrics(...)` | the group of a constraint is that of orthonormal bases, and points stand in others |
/// | a constraint | `casimir3` | the velocity is quadratic in the momentum: the momenta whose velocities the group leaves free form no linear space |
#[proc_macro_attribute]
pub fn affine_model(args: TokenStream, item: TokenStream) -> TokenStream {
    let expand = match cfg!(feature = "latex") {
        true => affine_codegen::expand_for_reports,
        false => affine_codegen::expand,
    };
    expand(args.into(), item.into()).into()
}
