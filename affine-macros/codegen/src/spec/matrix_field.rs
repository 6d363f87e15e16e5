//! Fields of matrix type: a name where a matrix belongs stands for all entries of the field.

use proc_macro2::Ident;
use syn::{GenericArgument, PathArguments, PathSegment, Type};

use super::item::{is_f64, written};
use super::{Expression, ExpressionKind, Field, Metric, Spec, Symbol, Term, Value};

/// How the entries of a field are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// `j[(0, 1)]`, as nalgebra's matrices.
    Matrix,
    /// `j[0][1]`, as arrays of rows.
    Rows,
}

impl Field {
    /// The number of rows of a square matrix of doubles whose type is written out: `Matrix3<f64>`, `SMatrix<f64, 9, 9>`,
    /// `Matrix<3>` or `[[f64; 3]; 3]`, with any path before it. An alias cannot be seen through.
    pub fn matrix(&self) -> Option<(usize, Storage)> {
        match written(&self.ty) {
            Type::Array(rows) => {
                let Type::Array(row) = written(&rows.elem) else { return None };
                let size = length(&rows.len)?;
                (is_double(&row.elem) && length(&row.len)? == size).then_some((size, Storage::Rows))
            }
            Type::Path(path) if path.qself.is_none() => {
                Some((size_of(path.path.segments.last()?)?, Storage::Matrix))
            }
            _ => None,
        }
    }
}

/// nalgebra's `Matrix1<T>` to `Matrix6<T>` and `SMatrix<T, R, C>`, and the runtime's `Matrix<N, T = f64>`.
fn size_of(segment: &PathSegment) -> Option<usize> {
    let PathArguments::AngleBracketed(list) = &segment.arguments else { return None };
    let arguments: Vec<&GenericArgument> = list.args.iter().collect();
    let double = |argument: &GenericArgument| matches!(argument, GenericArgument::Type(ty) if is_double(ty));
    let number = |argument: &GenericArgument| match argument {
        GenericArgument::Const(value) => length(value),
        _ => None,
    };
    match (segment.ident.to_string().as_str(), arguments.as_slice()) {
        ("Matrix", [size]) => number(size),
        ("Matrix", [size, entry]) if double(entry) => number(size),
        ("SMatrix", [entry, rows, columns]) if double(entry) => {
            number(rows).filter(|rows| number(columns) == Some(*rows))
        }
        (name, [entry]) if double(entry) => {
            let size = name.strip_prefix("Matrix")?.parse().ok()?;
            (1..=6).contains(&size).then_some(size)
        }
        _ => None,
    }
}

fn is_double(ty: &Type) -> bool {
    matches!(written(ty), Type::Path(path) if path.qself.is_none() && is_f64(&path.path))
}

/// A literal length.
fn length(value: &syn::Expr) -> Option<usize> {
    match value {
        syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Int(number), .. }) => number.base10_parse().ok(),
        syn::Expr::Group(group) => length(&group.expr),
        _ => None,
    }
}

impl Spec {
    /// Writes the entries of a field of matrix type where it stands alone as the value of a term or a metric. Anywhere
    /// else its name is left to be refused, since an expression is a number.
    pub(super) fn with_entries(mut self) -> Self {
        let entries = |spec: &Self, value: &mut Value| {
            if let Value::Scalar(Expression { kind: ExpressionKind::Symbol(name), span }) = value
                && let Some(Symbol::Field(field)) = spec.resolve(name)
                && let Some((size, _)) = field.matrix()
            {
                *value = matrix(name, size, |kind| Expression { kind, span: *span });
            }
        };
        let [mut kinetic, mut dissipation] = [&mut self.kinetic, &mut self.dissipation].map(std::mem::take);
        let mut metrics = std::mem::take(&mut self.metrics);
        for Term { value, .. } in kinetic.iter_mut().chain(&mut dissipation) {
            entries(&self, value);
        }
        for Metric { value, .. } in metrics.iter_mut().flatten() {
            entries(&self, value);
        }
        Self { kinetic, dissipation, metrics, ..self }
    }

    /// The fields of matrix type that stand in coefficients, in the order of the struct.
    pub fn matrix_fields(&self) -> impl Iterator<Item = (&Field, usize, Storage)> {
        self.item.fields.iter().filter_map(|field| {
            let stands = |e: &Expression| matches!(&e.kind, ExpressionKind::FieldEntry(name, ..) if *name == field.ident);
            let (size, storage) = field.matrix()?;
            self.coefficients().any(stands).then_some((field, size, storage))
        })
    }
}

fn matrix(name: &Ident, size: usize, at: impl Fn(ExpressionKind) -> Expression) -> Value {
    let entry = |row, column| at(ExpressionKind::FieldEntry(name.clone(), row, column));
    Value::Matrix((1..=size).map(|row| (1..=size).map(|column| entry(row, column)).collect()).collect())
}
