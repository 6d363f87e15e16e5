//! The models whose expansions are reviewed: one for each family of kinetic energies in each dimension, and one for what each
//! option adds.

/// A model, by what the attribute is given.
#[derive(Clone, Copy, Debug)]
pub struct Specimen {
    /// The name of its snapshot.
    pub name: &'static str,
    /// The arguments of the attribute.
    pub args: &'static str,
    /// The struct; a unit struct that is named after the snapshot where it says nothing of its own.
    item: Option<&'static str>,
}

impl Specimen {
    /// The struct.
    #[must_use]
    pub fn item(&self) -> String {
        let unit = || format!("/// A body.\npub struct {};", camel_case(self.name));
        self.item.map_or_else(unit, str::to_owned)
    }
}

/// `left_drift_3` to `LeftDrift3`.
fn camel_case(name: &str) -> String {
    let capital = |word: &str| {
        let (first, rest) = word.split_at(1);
        first.to_uppercase() + rest
    };
    name.split('_').map(capital).collect()
}

macro_rules! specimens {
    ($($name:ident: $args:literal $(, $item:literal)?;)*) => {
        &[$(Specimen { name: stringify!($name), args: $args, item: specimens!(@ $($item)?) }),*]
    };
    (@) => { None };
    (@ $item:literal) => { Some($item) };
}

/// Models whose expansions are reviewed line by line: every item that any model is given stands in one of them.
pub const IN_FULL: &[Specimen] = specimens! {
    metrics_dalembert_3: "dim = 3, metrics(body = diag(1, 2, 4)), kinetic(dalembert = 3)";
    fields_dalembert_2: "dim = 2, kinetic(dalembert = [[a, b], [b, c]], space_translation = a + c)",
        "/// A body.
        pub struct DAlembert { a: f64, b: f64, c: f64 }";
    lanes_missile_2: "dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 1), emit(lanes)";
    isochoric_dalembert_2: "dim = 2, constraint = isochoric, kinetic(dalembert = diag(1, 1.5), space_translation = 2), \
        potential = tr(G)/2";
    taylor_vibrating_2: "dim = 2, emit(taylor), kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1), \
        potential = hyperbolic_dilatation(10) + neo_hookean(0.5)";
    mixed_flat_affine_2: "dim = 2, kinetic(dalembert = 2, casimir2 = 0.2, space_translation = 1)";
    mixed_masses_2: "dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 1, space_translation = 2), \
        emit(metric, acceleration)";
    nystrom_anchored_2: "dim = 2, emit(nystrom), kinetic(dalembert = diag(1, 2), space_translation = 2), \
        potential = hyperbolic_dilatation(10) + tr(G)/2 + cos(t)*x[1]^2/2 + x[1]*phi[1,2]";
    tangent_missile_2: "dim = 2, emit(tangent), kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 1), \
        potential = tr(G)/2 - ln(det)";
    balance_2: "dim = 2, kinetic(dalembert = diag(1, 2), space_translation = 2), potential = tr(G)/2 + x[1], \
        emit(balance)";
    splitting_missile_2: "dim = 2, emit(splitting), kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 1), \
        potential = hyperbolic_dilatation(10) + neo_hookean(0.5)";
    fields_left_missile_3: "dim = 3, require(positive_definite), \
         kinetic(casimir2 = a, casimir1_squared = b, body_inertia = i, body_translation = m)",
        "/// A missile with parameters.
        #[derive(Clone, Debug)]
        pub struct Missile { a: f64, b: f64, i: f64, m: f64 }";
    fields_damped_2: "dim = 2, kinetic(casimir2 = 0.2, space_inertia = i), \
         dissipation(space_inertia = [[a, b], [b, c]], casimir2 = a)",
        "/// A body.
        pub struct Damped { i: f64, a: f64, b: f64, c: f64 }";
    custom_potential_2: "dim = 2, kinetic(casimir2 = 0.2, body_inertia = i), potential = q^2 + custom(gravity, isotropic)",
        "/// A body.
        pub struct Heavy<U: affine_runtime::potential::Potential<2> + Clone> {
            /// The inertia.
            pub i: f64,
            /// What attracts.
            pub gravity: U,
        }";
    generics_2: "dim = 2, kinetic(casimir2 = a, casimir1_squared = 0.1)",
        "/// A body with a label.
        pub struct Labelled<'l, T: Clone, const N: usize> where T: Sync {
            a: f64,
            /// The label.
            pub label: &'l str,
            /// Earlier labels.
            pub history: [T; N],
        }";
    two_polar_fields_2: "dim = 2, kinetic(casimir2 = a, body_inertia = i), potential = neo_hookean(c), emit(two_polar)",
        "/// A lattice of two stretches.
        pub struct Lattice { a: f64, i: f64, c: f64 }";
    fields_metrics_2: "dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), metrics(space = g)",
        "/// A body.
        pub struct Field { g: [[f64; 2]; 2] }";
    two_polar_pieces_2: "dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), potential = q1^2 + q2^2, emit(two_polar, splitting)",
        "/// Two stretches on springs.
        pub struct Lattice;";
    two_polar_ratios_2: "dim = 2, crate = crate::renamed::runtime, kinetic(casimir2 = 1.2, casimir1_squared = 0.1), emit(two_polar, ratios)",
        "/// A lattice of two stretches.
        pub struct Lattice;";
    fields_splitting_squares_2: "dim = 2, kinetic(body_inertia = j), potential = tr(G)/2 - ln(det), emit(splitting)",
        "/// A body whose principal axes are not known.
        pub struct Body { j: affine_runtime::frames::Matrix<2> }";
    unitary_pieces_2: "dim = 2, group = unitary, kinetic(casimir2 = 0.9, casimir1_squared = 0.3), emit(splitting, latex)",
        "/// A lattice of two angles.
        pub struct Lattice;";
    fields_metrics_inertia_2: "dim = 2, metrics(body = eta), kinetic(dalembert = j, space_translation = 1), \
         dissipation(space_tensor = k), forces = custom(wind, translation)",
        "/// A body in axes of its own.
        pub struct Oblique<W: Clone + affine_runtime::force::Force<2, Form = affine_runtime::force::Translation>> {
            /// Lengths in the body.
            pub eta: affine_runtime::frames::Matrix<2>,
            /// Inertia.
            pub j: [[f64; 2]; 2],
            /// Friction.
            pub k: [[f64; 4]; 4],
            /// What blows.
            pub wind: W,
        }";
};

/// Models that differ from those by what their equations are, and are reviewed by these.
// `missile`: translation measured in the body, `drift`: in space.
pub const BY_EQUATIONS: &[Specimen] = specimens! {
    vibrating_2: "dim = 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1), \
        potential = hyperbolic_dilatation(10) + neo_hookean(0.5)";
    vibrating_3: "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1), \
        potential = hyperbolic_dilatation(10) + neo_hookean(0.5)";
    vibrating_missile_3: "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, \
        body_translation = 1), potential = hyperbolic_dilatation(10000) + neo_hookean(0.5)";
    elastic_dalembert_3: "dim = 3, kinetic(dalembert = diag(1, 1.5, 2)), \
        potential = hyperbolic_dilatation(10) + neo_hookean(0.5)";
    orthogonality_2: "dim = 2, kinetic(dalembert = 3, space_translation = 2), potential = orthogonality(5) + x[2]";
    fibre_2: "dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), potential = (G[1,1] - 1)^2 + Ct[1,2]^2 + q^2/2";
    left_2: "dim = 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1)";
    left_3: "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1)";
    left_missile_2: "dim = 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1)";
    left_missile_3: "dim = 3, symmetry(space = affine, body = metric), \
        kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1)";
    left_drift_2: "dim = 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, space_translation = 2)";
    left_drift_3: "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, space_translation = 2)";
    right_2: "dim = 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1)";
    right_3: "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1)";
    right_missile_2: "dim = 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1, body_translation = 2)";
    right_missile_3: "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1, body_translation = 2)";
    right_drift_2: "dim = 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1, space_translation = 2)";
    right_drift_3: "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1, space_translation = 2)";
    affine_2: "dim = 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1)";
    affine_3: "dim = 3, symmetry(space = affine, body = affine), kinetic(casimir2 = 0.2, casimir1_squared = 0.1)";
    affine_missile_2: "dim = 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_translation = 2)";
    affine_missile_3: "dim = 3, kinetic(casimir2 = 0.2, body_translation = 2)";
    affine_drift_2: "dim = 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_translation = 2)";
    affine_drift_3: "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_translation = 2)";
    dalembert_scalar_2: "dim = 2, kinetic(dalembert = 3)";
    dalembert_scalar_3: "dim = 3, kinetic(dalembert = 3)";
    dalembert_scalar_missile_2: "dim = 2, kinetic(dalembert = 3, body_translation = 2)";
    dalembert_scalar_drift_3: "dim = 3, kinetic(dalembert = 3, space_translation = 2)";
    dalembert_diagonal_2: "dim = 2, kinetic(dalembert = diag(1, 1.5))";
    dalembert_diagonal_3: "dim = 3, kinetic(dalembert = diag(1, 1.5, 2))";
    dalembert_diagonal_drift_2: "dim = 2, kinetic(dalembert = diag(1, 1.5), space_translation = 2)";
    dalembert_diagonal_missile_3: "dim = 3, kinetic(dalembert = diag(1, 1.5, 2), body_translation = 2)";
    dalembert_matrix_2: "dim = 2, kinetic(dalembert = [[2, 1], [1, 3]])";
    dalembert_matrix_3: "dim = 3, kinetic(dalembert = [[2, 1, 0], [1, 3, 1], [0, 1, 4]])";
    dalembert_matrix_missile_2: "dim = 2, kinetic(dalembert = [[2, 1], [1, 3]], body_translation = 2)";
    dalembert_matrix_drift_3: "dim = 3, kinetic(dalembert = [[2, 1, 0], [1, 3, 1], [0, 1, 4]], space_translation = 2)";
    body_tensor_2: "dim = 2, kinetic(casimir2 = 0.2, \
        body_tensor = [[2, 0.5, 0, 1], [0.5, 3, 0.25, 0], [0, 0.25, -1, 0.5], [1, 0, 0.5, 4]])";
    body_tensor_missile_2: "dim = 2, kinetic(body_translation = 2, \
        body_tensor = [[2, 0.5, 0, 1], [0.5, 3, 0.25, 0], [0, 0.25, -1, 0.5], [1, 0, 0.5, 4]])";
    body_tensor_3: "dim = 3, kinetic(body_inertia = 1, body_tensor = [\
        [2, 0, 0, 0, 1, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0, 0, 0, 0], \
        [0, 0, 0, 1, 0, 0, 0, 0, 0], [1, 0, 0, 0, 3, 0, 0, 0, 0], [0, 0, 0, 0, 0, 1, 0, 0.5, 0], \
        [0, 0, 0, 0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 0, 0.5, 0, 1, 0], [0, 0, 0, 0, 0, 0, 0, 0, 1]])";
    space_tensor_2: "dim = 2, kinetic(casimir2 = 0.2, \
        space_tensor = [[2, 0.5, 0, 1], [0.5, 3, 0.25, 0], [0, 0.25, -1, 0.5], [1, 0, 0.5, 4]])";
    space_tensor_drift_2: "dim = 2, kinetic(space_translation = 2, \
        space_tensor = [[2, 0.5, 0, 1], [0.5, 3, 0.25, 0], [0, 0.25, -1, 0.5], [1, 0, 0.5, 4]])";
    space_tensor_3: "dim = 3, kinetic(space_inertia = 1, space_tensor = [\
        [2, 0, 0, 0, 1, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0, 0, 0, 0], \
        [0, 0, 0, 1, 0, 0, 0, 0, 0], [1, 0, 0, 0, 3, 0, 0, 0, 0], [0, 0, 0, 0, 0, 1, 0, 0.5, 0], \
        [0, 0, 0, 0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 0, 0.5, 0, 1, 0], [0, 0, 0, 0, 0, 0, 0, 0, 1]])";
    body_inertia_diagonal_2: "dim = 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = diag(1, 2))";
    body_inertia_diagonal_missile_3: "dim = 3, \
        kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = diag(1, 1.5, 2), body_translation = 1)";
    body_inertia_matrix_2: "dim = 2, kinetic(casimir2 = 0.2, body_inertia = [[1, 0.5], [0.5, -2]])";
    space_inertia_diagonal_3: "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = diag(1, 1.5, 2))";
    space_inertia_matrix_drift_2: "dim = 2, kinetic(space_inertia = [[1, 0.5], [0.5, 2]], space_translation = 2)";
    flat_tensor_2: "dim = 2, kinetic(\
        flat_tensor = [[2, 0.5, 0, 1], [0.5, 3, 0.25, 0], [0, 0.25, -1, 0.5], [1, 0, 0.5, 4]])";
    hamiltonian_vorticity_missile_2: "dim = 2, hamiltonian(casimir2 = 5/6, casimir1_squared = -1/18, \
        vorticity_squared = 25/24, body_translation = 1/2)";
    hamiltonian_spin_3: "dim = 3, symmetry(space = metric, body = affine), \
        hamiltonian(casimir2 = 5/6, casimir1_squared = -1/18, spin_squared = 25/24)";
    hamiltonian_cubic_3: "dim = 3, hamiltonian(casimir3 = 0.1)";
    hamiltonian_cubic_missile_3: "dim = 3, symmetry(space = affine, body = metric), \
        hamiltonian(casimir2 = 5/6, vorticity_squared = 25/24, casimir3 = 0.1, body_translation = 1/2)";
    metrics_left_missile_2: "dim = 2, metrics(space = [[2, 0.5], [0.5, 1.5]], body = diag(4, 1)), \
        kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 2)";
    flat_tensor_drift_2: "dim = 2, kinetic(dalembert = diag(1, 2), space_translation = 2, \
        flat_tensor = [[2, 0.5, 0, 1], [0.5, 3, 0.25, 0], [0, 0.25, -1, 0.5], [1, 0, 0.5, 4]])";
    hencky_3: "dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1), potential = q1^2 + q2^2 + q3^2";
    biot_driven_2: "dim = 2, kinetic(casimir2 = 0.2, space_inertia = 1), potential = cos(t)*(Q1 + Q2)";
    wells_dalembert_2: "dim = 2, kinetic(dalembert = 1), potential = pairs(cos(d))";
    isochoric_dalembert_3: "dim = 3, constraint = isochoric, kinetic(dalembert = diag(1, 1.5, 2)), potential = tr(G)/2";
    isochoric_left_3: "dim = 3, constraint = isochoric, kinetic(casimir2 = 0.2, body_inertia = 1)";
    isochoric_missile_2: "dim = 2, constraint = isochoric, kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 1), \
        potential = neo_hookean(0.5)";
    rigid_left_3: "dim = 3, constraint = rigid, kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 2)";
    rigid_top_3: "dim = 3, constraint = rigid, kinetic(dalembert = diag(1, 1.5, 2)), potential = 0.7*phi[3,3]";
    conformal_right_2: "dim = 2, constraint = conformal, \
        kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1, body_translation = 2)";
    conformal_body_inertia_3: "dim = 3, constraint = conformal, kinetic(casimir2 = 0.2, body_inertia = diag(1, 1.5, 2)), \
        potential = hyperbolic_dilatation(10) + 0.5*phi[3,3]";
    taylor_missile_3: "dim = 3, emit(taylor), \
        kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1)";
    taylor_functions_2: "dim = 2, emit(taylor), kinetic(dalembert = 1), \
        potential = exp(tr(G)/4) + ln(1 + det^2) + sin(phi[1,2])*tan(det/4) + 1/sqrt(1 + tr(G))";
    taylor_straight_2: "dim = 2, emit(taylor), kinetic(dalembert = 3)";
    splitting_vibrating_3: "dim = 3, emit(splitting), kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1), \
        potential = hyperbolic_dilatation(10) + neo_hookean(0.5)";
    splitting_fibred_2: "dim = 2, emit(splitting), kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 1), \
        potential = tr(G)/2 - ln(det) + G[1,2]*cos(t) + norm(x)^2/2";
    splitting_elastic_2: "dim = 2, emit(splitting), kinetic(dalembert = diag(1, 2)), \
        potential = hyperbolic_dilatation(10) + neo_hookean(0.5)";
    mixed_body_space_3: "dim = 3, kinetic(body_inertia = 1, space_inertia = diag(1, 1.5, 2))";
    damped_bulk_missile_3: "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, \
        body_translation = 1), potential = hyperbolic_dilatation(10) + neo_hookean(0.5), \
        dissipation(casimir1_squared = 0.3)";
    damped_shear_2: "dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), dissipation(body_inertia = 0.5, casimir2 = 0.5)";
    damped_across_frames_2: "dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1, space_translation = 2), \
        dissipation(space_inertia = 0.5, dalembert = diag(1, 2), body_translation = 0.25)";
    damped_dalembert_3: "dim = 3, kinetic(dalembert = diag(1, 1.5, 2), space_translation = 2), \
        dissipation(dalembert = diag(1, 2, 3), space_translation = 3)";
    rigid_hamiltonian_3: "dim = 3, constraint = rigid, \
        hamiltonian(casimir2 = 5/6, vorticity_squared = 25/24, space_translation = 1/2), potential = 0.7*phi[3,3]";
    mixed_damped_2: "dim = 2, kinetic(dalembert = 2, casimir2 = 0.2, body_translation = 1, space_translation = 2), \
        potential = tr(G)/2, dissipation(space_inertia = 0.5, dalembert = diag(1, 2), body_translation = 0.25)";
    driven_2: "dim = 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1), \
        potential = hyperbolic_dilatation(10) + (2 + cos(3*t))*neo_hookean(0.5)";
    rigid_sum_3: "dim = 3, constraint = rigid, kinetic(dalembert = diag(1, 1.5, 2), space_inertia = diag(2, 1, 1)), \
        potential = 0.7*phi[3,3]";
    conformal_sum_2: "dim = 2, constraint = conformal, kinetic(dalembert = diag(1, 2), body_inertia = diag(2, 1), \
        body_translation = 2)";
    splitting_squares_2: "dim = 2, emit(splitting), kinetic(casimir2 = 0.2, body_inertia = diag(1, 2)), \
        potential = tr(G)/2 - ln(det)";
    fields_right_2: "dim = 2, kinetic(casimir2 = a/2, casimir1_squared = 0.1, space_inertia = i^2, space_translation = 1)",
        "/// A body.
        pub struct Right { a: f64, i: f64 }";
    fields_affine_3: "dim = 3, kinetic(casimir2 = a, casimir1_squared = b)",
        "/// A body.
        pub struct Affine { a: f64, b: f64 }";
    fields_body_tensor_2: "dim = 2, kinetic(casimir2 = a, \
         body_tensor = [[2, 0.5, 0, 1], [0.5, 3, 0.25, 0], [0, 0.25, -1, 0.5], [1, 0, 0.5, 4]])",
        "/// A body.
        pub struct BodyTensor { a: f64 }";
    fields_body_inertia_2: "dim = 2, kinetic(casimir2 = a, body_inertia = diag(i, 2*i), body_translation = 1)",
        "/// A body.
        pub struct BodyInertia { a: f64, i: f64 }";
    fields_hamiltonian_2: "dim = 2, hamiltonian(casimir2 = a, casimir1_squared = b, spin_squared = 2*c, space_translation = k)",
        "/// A body.
        pub struct Hamiltonian { a: f64, b: f64, c: f64, k: f64 }";
    fields_hamiltonian_cubic_3: "dim = 3, hamiltonian(casimir2 = a, casimir3 = d, vorticity_squared = 1, space_translation = k)",
        "/// A body.
        pub struct Cubic { a: f64, d: f64, k: f64 }";
    custom_force_2: "dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 2), forces = custom(wind, spatial)",
        "/// A body.
        pub struct Custom<F: affine_runtime::force::Force<2, Form = affine_runtime::frames::Space>> {
            /// What blows.
            pub wind: F,
        }";
    gyroscopic_force_2: "dim = 2, kinetic(dalembert = 1, space_translation = 2), forces = custom(magnet, translation, gyroscopic)",
        "/// A body.
        pub struct Charged<F: affine_runtime::force::Force<2, Form = affine_runtime::force::Translation>> {
            /// What turns.
            pub magnet: F,
        }";
    custom_potential_3: "dim = 3, kinetic(casimir2 = 0.2, body_inertia = i), potential = q^2 + custom(gravity, isotropic)",
        "/// A body.
        pub struct Heavy<U: affine_runtime::potential::Potential<3> + Clone> {
            /// The inertia.
            pub i: f64,
            /// What attracts.
            pub gravity: U,
        }";
    self_gravity_3: "dim = 3, constraint = isochoric, kinetic(dalembert = 0.2), potential = self_gravity(1)";
    self_gravity_gas_3: "dim = 3, kinetic(dalembert = 0.2, space_translation = 1), potential = gas(2) + self_gravity(k)",
        "/// A star.
        pub struct Star {
            /// `G m^2/r`.
            pub k: f64,
        }";
    generics_without_coefficients_2: "dim = 2, kinetic(casimir2 = 0.2)",
        "/// A body with a tag.
        pub struct Tagged<T> where T: Copy {
            /// The tag.
            pub tag: T,
        }";
    runtime_path_2: "dim = 2, crate = crate::renamed::runtime, kinetic(casimir2 = 0.2)",
        "/// A body.
        pub struct Renamed;";
    two_polar_3: "dim = 3, kinetic(casimir2 = 1.2, casimir1_squared = 0.1), emit(two_polar)",
        "/// A lattice of three stretches.
        pub struct Lattice;";
    two_polar_dalembert_2: "dim = 2, kinetic(dalembert = 1.5), potential = hyperbolic_dilatation(2), emit(two_polar)",
        "/// A lattice of two stretches.
        pub struct Lattice;";
    fields_matrix_inertia_2: "dim = 2, kinetic(body_inertia = j)",
        "/// A body.
        pub struct Field { j: affine_runtime::frames::Matrix<2> }";
    two_polar_pieces_3: "dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1), potential = q1^2 + q2^2 + q3^2, emit(two_polar, splitting)",
        "/// Three stretches on springs.
        pub struct Lattice;";
    two_polar_ratios_3: "dim = 3, kinetic(casimir2 = 1.2, casimir1_squared = 0.1), emit(two_polar, ratios)",
        "/// A lattice of three stretches.
        pub struct Lattice;";
    metrics_inertia_2: "dim = 2, metrics(space = [[2, 0.5], [0.5, 1.5]], body = [[1, -0.4], [-0.4, 3]]), \
         kinetic(casimir2 = 0.2, body_inertia = [[1.5, 0.25], [0.25, 2]])",
        "/// A body in oblique axes.
        pub struct Oblique;";
    isochoric_sum_2: "dim = 2, constraint = isochoric, kinetic(dalembert = diag(1, 2), casimir2 = 0.2)";
    unitary_fields_3: "dim = 3, kinetic(casimir2 = a, casimir1_squared = 0.3), group = unitary",
        "/// A lattice of three angles.
        pub struct Lattice { a: f64 }";
    driven_by_time_alone_2: "dim = 2, kinetic(dalembert = 1), potential = cos(t)";
};
