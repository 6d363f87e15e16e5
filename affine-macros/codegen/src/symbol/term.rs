//! The quadratic forms of kinetic energies, and the frames that make their coefficients constant.

use super::Quantity;

/// The quadratic forms that a specification can name; `Oh = phi^-1 phi_dot`, `Om = phi_dot phi^-1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TermKind {
    /// `A/2 tr O^2`, the same in both frames.
    Casimir2,
    /// `B/2 (tr O)^2`, the same in both frames.
    Casimir1Squared,
    /// `1/2 tr(Oh J Oh^T)`, (4.17); `J = I 1` is (4.14).
    BodyInertia,
    /// `1/2 tr(Om J Om^T)`, (4.17); `J = I 1` is (4.15).
    SpaceInertia,
    /// `1/2 K[nA+B][nC+D] Oh[A][B] Oh[C][D]`, (4.1).
    BodyTensor,
    /// `1/2 K[nA+B][nC+D] Om[A][B] Om[C][D]`, (4.2).
    SpaceTensor,
    /// `1/2 K[nA+B][nC+D] phi_dot[A][B] phi_dot[C][D]`, the flat form of section 4.
    FlatTensor,
    /// `1/2 tr(phi_dot J phi_dot^T)`, (2.1).
    Dalembert,
    /// `m/2 |phi^-1 x_dot|^2`, (4.4).
    BodyTranslation,
    /// `m/2 |x_dot|^2`, (4.5).
    SpaceTranslation,
}

/// The frame in which an energy has constant coefficients.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// Co-moving: `Oh`, `Sigma_hat`, `p_hat`.
    Body,
    /// Spatial: `Om`, `Sigma`, `p`.
    Space,
    /// Neither: `phi_dot`, `Pi`.
    Flat,
}

impl Frame {
    /// The affine velocity of the frame.
    pub fn velocity(self) -> Quantity {
        match self {
            Frame::Body => Quantity::ComovingAffineVelocity,
            Frame::Space => Quantity::AffineVelocity,
            Frame::Flat => Quantity::PlacementVelocity,
        }
    }

    /// The affine spin of the frame.
    pub fn momentum(self) -> Quantity {
        match self {
            Frame::Body => Quantity::ComovingAffineSpin,
            Frame::Space => Quantity::AffineSpin,
            Frame::Flat => Quantity::CanonicalMomentum,
        }
    }
}

/// How a quadratic form reads the velocity `O` of its frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// `c/2 tr O^2`.
    TraceOfSquare,
    /// `c/2 (tr O)^2`.
    SquareOfTrace,
    /// `1/2 tr(O J O^T)`, with `J` an n x n inertia or a multiple of the identity.
    Rows,
    /// `1/2 K[nA+B][nC+D] O[A][B] O[C][D]`, a form on pairs of indices.
    Pairs,
    /// `m/2 |v|^2` of the velocity `v` of the centre of mass, `x_dot` or `phi^-1 x_dot`.
    Centre,
}

impl Pattern {
    /// Rows of a matrix of coefficients in dimension `n`; `None` where the coefficient is one number.
    pub fn rows(self, n: usize) -> Option<usize> {
        match self {
            Pattern::TraceOfSquare | Pattern::SquareOfTrace | Pattern::Centre => None,
            Pattern::Rows => Some(n),
            Pattern::Pairs => Some(n * n),
        }
    }
}

/// What is known of a kind of term.
struct Row {
    /// Its name in a specification.
    name: &'static str,
    /// The frame that makes its coefficients constant; `None` where any of body and space does.
    frame: Option<Frame>,
    pattern: Pattern,
    /// A value that it may have, in messages.
    example: &'static str,
}

const UNIT_TENSOR: &str = "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]";

impl TermKind {
    /// All kinds, in the order in which messages list them.
    pub const ALL: [TermKind; 10] = [
        TermKind::Casimir2,
        TermKind::Casimir1Squared,
        TermKind::BodyInertia,
        TermKind::SpaceInertia,
        TermKind::BodyTranslation,
        TermKind::SpaceTranslation,
        TermKind::Dalembert,
        TermKind::BodyTensor,
        TermKind::SpaceTensor,
        TermKind::FlatTensor,
    ];

    /// The table of the kinds.
    fn row(self) -> Row {
        let row = |name, frame, pattern, example| Row { name, frame, pattern, example };
        let [body, space, flat] = [Frame::Body, Frame::Space, Frame::Flat].map(Some);
        match self {
            TermKind::Casimir2 => row("casimir2", None, Pattern::TraceOfSquare, "0.2"),
            TermKind::Casimir1Squared => row("casimir1_squared", None, Pattern::SquareOfTrace, "0.1"),
            TermKind::BodyInertia => row("body_inertia", body, Pattern::Rows, "1"),
            TermKind::SpaceInertia => row("space_inertia", space, Pattern::Rows, "1"),
            TermKind::Dalembert => row("dalembert", flat, Pattern::Rows, "diag(1, 2, 3)"),
            TermKind::BodyTensor => row("body_tensor", body, Pattern::Pairs, UNIT_TENSOR),
            TermKind::SpaceTensor => row("space_tensor", space, Pattern::Pairs, UNIT_TENSOR),
            TermKind::FlatTensor => row("flat_tensor", flat, Pattern::Pairs, UNIT_TENSOR),
            TermKind::BodyTranslation => row("body_translation", body, Pattern::Centre, "1"),
            TermKind::SpaceTranslation => row("space_translation", space, Pattern::Centre, "1"),
        }
    }

    /// Its name in a specification.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// A value that it may have, as written in a specification.
    pub fn example(self) -> &'static str {
        self.row().example
    }

    /// How it reads the velocity of its frame.
    pub fn pattern(self) -> Pattern {
        self.row().pattern
    }

    /// The frame that makes the coefficients of an internal term constant; `None` where any of body and space does.
    pub fn internal_frame(self) -> Option<Frame> {
        self.row().frame.filter(|_| !self.is_translation())
    }

    /// The frame of a translational term.
    pub fn translation_frame(self) -> Option<Frame> {
        self.row().frame.filter(|_| self.is_translation())
    }

    /// `1/2 K[(A,B),(C,D)] O[A,B] O[C,D]`, a form on pairs of indices?
    pub fn is_tensor(self) -> bool {
        self.pattern() == Pattern::Pairs
    }

    /// A kinetic energy of the centre of mass, in x_dot?
    pub fn is_translation(self) -> bool {
        self.pattern() == Pattern::Centre
    }

    /// `1/2 tr(O J O^T)` over `Oh`, `Om` or `phi_dot`, with `J` an n x n inertia or a multiple of the identity?
    pub fn is_inertia(self) -> bool {
        self.pattern() == Pattern::Rows
    }
}
