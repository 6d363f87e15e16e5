//! Constructors of phase points: inherent methods, so that a model without translation has no `x` to give.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use crate::derive::VelocitySide;
use crate::ir::Program;
use crate::symbol::{Frame, Quantity, Symbol};

use super::body::Body;
use super::context::{Coefficients, Context};
use super::number::Number;
use super::pattern::{ident, in_rows};
use super::point::{Moving, moving, phase_point, wrapper};
use super::{mixed, quantities, refused};

/// `at_momentum` and `at_velocity`.
pub(super) fn inherent(context: &Context) -> TokenStream {
    let (prepared, rt, n) = (&context.names.prepared, &context.names.rt, context.dim());
    let visibility = &context.spec.item.visibility;
    let (generics, types, clause) = context.generics();
    let point = context.point(&quote!(#rt::f64));
    let moving = context.model.translation.is_some();
    let (x, p, x_dot, centre) = match moving {
        false => (quote!(), quote!(), quote!(), quote!(#rt::Pinned)),
        true => (
            quote!(x: impl #rt::OfCentre<#n>,),
            quote!(p: impl #rt::OfCentre<#n>,),
            quote!(x_dot: impl #rt::OfCentre<#n>,),
            quote!(#rt::Centre { x, p }),
        ),
    };
    let (q, v, m) = match moving {
        false => ("`phi`", "`phi_dot`", "the affine spin"),
        true => ("`(x, phi)`", "`(x_dot, phi_dot)`", "`p` and the affine spin"),
    };
    let Confinement { off, tangent, point: checked } = confinement(context, &centre);
    let at_momentum = format!(
        " The phase point at the placement {q} with {m}: `Spatial(sigma)`, `Comoving(sigma_hat)` or `TwoPoint(pi)`."
    );
    let refusal = mixed::refusal(context);
    let quantities = quantities::inherent(context);
    let vectors = of_centre(context, "p");
    let errors = |of: &str| {
        format!(
            " `Placement` unless `phi` is finite with a positive determinant, `NotFinite` for a {of}{refusal}."
        )
    };
    let (momentum_errors, velocity_errors) = (errors("momentum"), errors("velocity"));
    let at_velocity = match &context.model.point.velocity_side {
        None => refused::without_velocity(context, &point),
        Some(VelocitySide { legendre: program, .. }) => {
            let legendre = legendre(context, program);
            let momentum_of_centre = momentum_of_centre(context);
            let vectors = of_centre(context, "x_dot");
            let inward_centre =
                moving.then(|| quote!(let (x, x_dot) = (bases.space * x, bases.space * x_dot);));
            let bases = context.bases(Some(&quote!(#rt::f64)), Coefficients::Own);
            let inward = context.with_metrics(quote! {
                let bases = #bases;
                #inward_centre
                let (phi, phi_dot) = (bases.placement(&phi), bases.placement(&phi_dot));
            });
            let outward =
                context.with_metrics(quote!(.map(|point| #rt::Phase::from_orthonormal(&point, &bases))));
            let doc = format!(
                " The phase point at the placement {q} with the velocity {v}: the Legendre transformation \
                 `X = (dT/dO)^T` (4.6), (4.8)."
            );
            quote! {
                #[doc = #doc]
                ///
                /// # Errors
                #[doc = #velocity_errors]
                #off
                #visibility fn at_velocity(
                    &self,
                    #x
                    phi: #rt::Matrix<#n>,
                    #x_dot
                    phi_dot: #rt::Matrix<#n>,
                ) -> #rt::Result<#point> {
                    #vectors
                    #inward
                    #tangent
                    #legendre
                    #momentum_of_centre
                    #checked #outward
                }
            }
        }
    };
    quote! {
        impl #generics #prepared #types #clause {
            #[doc = #at_momentum]
            ///
            /// # Errors
            #[doc = #momentum_errors]
            #off
            #visibility fn at_momentum(
                &self,
                #x
                phi: #rt::Matrix<#n>,
                #p
                spin: impl #rt::Momentum<#n, #rt::f64>,
            ) -> #rt::Result<#point> {
                #vectors
                #checked
            }

            #at_velocity

            #quantities
        }
    }
}

/// The vectors of the centre of mass that a constructor is given.
fn of_centre(context: &Context, other: &str) -> Option<TokenStream> {
    let (rt, other) = (&context.names.rt, format_ident!("{other}"));
    let moves = context.model.translation.is_some();
    moves.then(|| quote!(let (x, #other) = (#rt::OfCentre::vector(x), #rt::OfCentre::vector(#other));))
}

/// How points are made and what a constraint asks of them.
struct Confinement {
    /// A line of documentation.
    off: TokenStream,
    /// What has to hold before a velocity is looked at.
    tangent: TokenStream,
    /// The point with the momentum `spin`.
    point: TokenStream,
}

fn confinement(context: &Context, centre: &TokenStream) -> Confinement {
    let rt = &context.names.rt;
    let point = mixed::regular(context, phase_point(context, &quote!(spin), centre));
    let Some(group) = context.constraint() else {
        return Confinement { off: TokenStream::new(), tangent: TokenStream::new(), point };
    };
    let tangent = quote! {
        #rt::on_the_group(#group, &phi)?;
        #rt::in_the_algebra(#group, &phi, &phi_dot)?;
    };
    let off = quote! {
        ///
        /// `OffConstraint` where placement, velocity or momentum violates the constraint by more than rounding.
    };
    Confinement { off, tangent, point }
}

/// `O -> X` in the model's frame.
fn legendre(context: &Context, program: &Program) -> TokenStream {
    let rt = &context.names.rt;
    let masses = context.model.point.mixed_masses.as_ref().map(|masses| &masses.momentum);
    let programs: Vec<&Program> = [program].into_iter().chain(masses).collect();
    let Moving { lets: moving, .. } = moving(context, &programs, &quote!(&phi), &quote!(x_dot));
    let Body { lets, results } = context.double(program);
    let n = context.model.dim;
    let names = program.results().step_by(n * n).filter_map(Symbol::quantity);
    let (mut momenta, mut sum) = (TokenStream::new(), TokenStream::new());
    for (of, entries) in names.zip(results.chunks(n * n)) {
        let (name, rows) = (ident(&of.into()), in_rows(entries, n));
        momenta.extend(quote!(let #name = #rt::matrix(#rows);));
        // `Pi = Sigma_hat phi^-1 + phi^-1 Sigma` of a sum of energies on all placements.
        let summand = match of {
            _ if of == context.model.frame.momentum() => quote!(#name),
            Quantity::ComovingAffineSpin => quote!(#name * phi_inverse),
            _ => quote!(phi_inverse * #name),
        };
        sum = if sum.is_empty() { summand } else { quote!(#sum + #summand) };
    }
    let wrapper = wrapper(context, context.model.frame);
    quote!(#moving #lets #momenta let spin = #wrapper(#sum);)
}

/// `p = m x_dot` or `p = m C x_dot`, (4.7).
fn momentum_of_centre(context: &Context) -> TokenStream {
    let Some(program) = &context.model.point.mass else { return mixed::momentum_of_centre(context) };
    let velocity = match context.model.translation {
        Some(Frame::Body) => quote!(phi_inverse.tr_mul(&(phi_inverse * x_dot))),
        _ => quote!(x_dot),
    };
    let (lets, p) = context.times(velocity, (program, Quantity::Mass), Number::Double);
    quote!(#lets let p = #p;)
}
