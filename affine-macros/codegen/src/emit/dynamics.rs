//! Energies, velocities and Hamilton's equations.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use crate::derive::VelocitySide;
use crate::ir::Program;
use crate::symbol::{Frame, Quantity, Symbol};

use super::body::Body;
use super::context::{Coefficients, Context};
use super::mixed;
use super::number::{Number, number};
use super::parametric::{Evaluation, Method};
use super::pattern::{components, entries, in_rows, list, pattern, table, time};
use super::point::{
    Moving, at_point, bind_components, by_distance, group_of_point, is_vector, moving, wrapper,
};

/// The methods that do not reduce.
pub(super) fn methods(context: &Context) -> Vec<Method> {
    let flat = flat(context);
    vec![
        Method::Evaluation(velocity(context)),
        Method::Evaluation(kinetic_energy(context)),
        Method::Evaluation(hamiltonian(context)),
        // The coefficients hold the bases, where these follow from fields.
        if context.has_prepared_bases() { Method::Evaluation(flat) } else { Method::Other(flat) },
        Method::Evaluation(hamilton_equations(context)),
        Method::Other(mixed::regularity(context)),
    ]
}

fn velocity(context: &Context) -> TokenStream {
    let (rt, t, n) = (&context.names.rt, &context.names.scalar, context.dim());
    let (Body { lets, results }, _) = at_point(context, &context.model.point.velocity, Number::Generic(t));
    let rows = match results.as_slice() {
        [rows] => rows.clone(),
        entries => in_rows(entries, context.model.dim),
    };
    let velocity = quote!(#rt::matrix(#rows));
    let phi_dot = match context.model.frame {
        Frame::Body => quote!(#rt::Phase::phi(point) * #velocity),
        Frame::Space => quote!(#velocity * #rt::Phase::phi(point)),
        Frame::Flat => velocity,
    };
    let (mass, x_dot) = match (&context.model.point.mass, context.model.translation) {
        (None, Some(_)) => mixed::velocity_of_centre(context),
        (Some(program), Some(frame)) => {
            let momentum = match frame {
                Frame::Body => quote!(#rt::Phase::phi(point) * #rt::Phase::p_hat(point).0.0),
                _ => quote!(#rt::Phase::p(point)),
            };
            context.times(momentum, (program, Quantity::InverseMass), Number::Generic(t))
        }
        _ => (TokenStream::new(), quote!(#rt::Vector::<#n, #t>::zeros())),
    };
    let inward = context.inward(Coefficients::Given);
    let velocity = quote!(#rt::Velocity { x_dot: #x_dot, phi_dot: #phi_dot });
    let bases = context.bases(Some(&quote!(#t)), Coefficients::Given);
    let velocity = match context.model.metrics {
        Some(_) => quote!(#bases.reversed().velocity(&#velocity)),
        None => velocity,
    };
    let masses = context.model.point.mixed_masses.as_ref().map(|masses| &masses.velocity);
    let factor = context.model.point.mass.as_ref().map(|mass| mass.only(&Quantity::InverseMass.into()));
    let programs = [&context.model.point.velocity].into_iter().chain(factor.as_ref().or(masses));
    let Evaluation { name, parameter } = Evaluation::of_points(context, "velocity", programs);
    quote! {
        fn #name<#t: #rt::Real>(&self, #parameter point: &Self::Point<#t>) -> #rt::Velocity<#n, #t> {
            #inward
            #lets
            #mass
            #velocity
        }
    }
}

fn kinetic_energy(context: &Context) -> TokenStream {
    let (rt, t, n) = (&context.names.rt, &context.names.scalar, context.dim());
    let Some(VelocitySide { kinetic_energy: program, .. }) = &context.model.point.velocity_side else {
        let Evaluation { name, parameter } = Evaluation::reading(context, "kinetic_energy", false);
        return quote! {
            fn #name<#t: #rt::Real>(
                &self,
                #parameter
                _phi: &#rt::Matrix<#n, #t>,
                _velocity: &#rt::Velocity<#n, #t>,
            ) -> #t {
                const { #rt::no_kinetic_energy_of_velocities() }
            }
        };
    };
    let Moving { lets: moving, reads_phi } =
        moving(context, &[program], &quote!(phi), &quote!(velocity.x_dot));
    let phi = if reads_phi { quote!(phi) } else { quote!(_phi) };
    let body = context.generic(program, Coefficients::Given);
    let (lets, energy) = (&body.lets, body.result());
    let Evaluation { name, parameter } = Evaluation::of_points(context, "kinetic_energy", [program]);
    let bases = context.bases(Some(&quote!(#t)), Coefficients::Given);
    let inward = context.with_metrics(quote! {
        let velocity = &#bases.velocity(velocity);
    });
    let phi_inward =
        (reads_phi && context.model.metrics.is_some()).then(|| quote!(let phi = &#bases.placement(phi);));
    let inward = quote!(#inward #phi_inward);
    quote! {
        fn #name<#t: #rt::Real>(
            &self,
            #parameter
            #phi: &#rt::Matrix<#n, #t>,
            velocity: &#rt::Velocity<#n, #t>,
        ) -> #t {
            #inward
            let phi_dot = velocity.phi_dot;
            #moving
            #lets
            #energy
        }
    }
}

fn hamiltonian(context: &Context) -> TokenStream {
    let (rt, t) = (&context.names.rt, &context.names.scalar);
    let program = &context.model.point.hamiltonian;
    let time = time(program);
    let energy = |program: &Program| {
        let (body, _) = at_point(context, program, Number::Generic(t));
        let (lets, energy) = (&body.lets, body.result());
        quote!(#lets #energy)
    };
    let near = energy(program);
    let inward = context.inward(Coefficients::Given);
    let programs = [program].into_iter().chain(&context.model.point.hamiltonian_far_away);
    let Evaluation { name, parameter } = Evaluation::of_points(context, "hamiltonian", programs);
    let far_away = context.model.point.hamiltonian_far_away.as_ref().map(energy);
    let value = by_distance(context, near, far_away);
    quote! {
        fn #name<#t: #rt::Real>(&self, #parameter #time: #t, point: &Self::Point<#t>) -> #t {
            #inward
            #value
        }
    }
}

/// `flatten` and `unflatten`.
fn flat(context: &Context) -> TokenStream {
    let (rt, t) = (&context.names.rt, &context.names.scalar);
    let (n, dim) = (context.model.dim, context.dim());
    let full = &context.model.dynamics.full;
    let all = full.symbols();
    // Where the entries of a matrix stand in the array, if all of them do.
    let place = |of: Quantity| {
        let entries = entries(of, n).concat();
        all.windows(entries.len()).position(|part| *part == entries).map(number)
    };
    let parts = full.groups.iter().map(|(of, symbols)| {
        let (value, entries) = (group_of_point(context, *of), list(symbols));
        match (is_vector(*of), place(*of)) {
            (true, _) => quote!(&#value),
            (false, Some(_)) => quote!(#value.as_flattened()),
            (false, None) => quote!(&#entries),
        }
    });
    let apart = |vectors: bool| -> Vec<Symbol> {
        let groups =
            full.groups.iter().filter(|(of, _)| place(*of).is_none() && (vectors || !is_vector(*of)));
        groups.flat_map(|(_, symbols)| symbols.clone()).collect()
    };
    let bound = bind_components(context, &apart(false), |_| false);
    let read = apart(true);
    let pattern = pattern(&all, &read);
    let read = (!read.is_empty()).then(|| quote!(let #pattern = *full;));
    let matrix = |of: Quantity| {
        let rows = match place(of) {
            Some(place) => quote!(#rt::square(full, #place)),
            None => table(&entries(of, n)),
        };
        quote!(#rt::matrix(#rows))
    };
    let vector = |of: Quantity| {
        let components = list(&components(of, n));
        quote!(#rt::vector(#components))
    };
    let own = matrix(context.model.frame.momentum());
    let (phi, wrap) = (matrix(Quantity::Placement), wrapper(context, context.model.frame));
    let dependent = context.dependent(full);
    let p = match full.has(Quantity::ComovingLinearMomentum) {
        false => vector(Quantity::LinearMomentum),
        true => {
            let p_hat = vector(Quantity::ComovingLinearMomentum);
            quote!(#rt::inverse(&phi).tr_mul(&#p_hat))
        }
    };
    let x = vector(Quantity::Position);
    let (centre, its_value) = match context.model.translation {
        None => (None, quote!(#rt::Pinned)),
        Some(_) => (Some(quote!(let centre = #rt::Centre { x: #x, p: #p };)), quote!(centre)),
    };
    let [(flatten, parameter), (unflatten, _)] = ["flatten", "unflatten"].map(|name| {
        if !context.has_prepared_bases() {
            return (format_ident!("{name}"), None);
        }
        let Evaluation { name, parameter } = Evaluation::reading(context, name, true);
        (name, parameter)
    });
    let inward = context.inward(Coefficients::Given);
    let point = quote!(#rt::point(phi, #wrap(#own), #its_value));
    let point = context.outward(&quote!(#t), point, Coefficients::Given);
    // Moves of numbers, which are cheapest as a part of what reads them.
    quote! {
        #[inline]
        fn #flatten<#t: #rt::Real>(&self, #parameter point: &Self::Point<#t>) -> Self::Full<#t> {
            #inward
            #bound
            #rt::joined([#(#parts),*])
        }

        #[inline]
        fn #unflatten<#t: #rt::Real>(&self, #parameter full: &Self::Full<#t>) -> Self::Point<#t> {
            #read
            #dependent
            let phi: #rt::Matrix<#dim, #t> = #phi;
            #centre
            #point
        }
    }
}

fn hamilton_equations(context: &Context) -> TokenStream {
    let (rt, t) = (&context.names.rt, &context.names.scalar);
    let program = &context.model.dynamics.full.program;
    let bound = pattern(&context.model.dynamics.full.symbols(), &program.inputs());
    let time = time(program);
    let Body { lets, results } = context.generic(program, Coefficients::Given);
    let inline = context.inline();
    let Evaluation { name, parameter } = Evaluation::of(context, "hamilton_equations", [program]);
    quote! {
        #inline
        fn #name<#t: #rt::Scalar>(&self, #parameter #time: #t, full: &Self::Full<#t>) -> Self::Full<#t> {
            let #bound = *full;
            #lets
            [#(#results),*]
        }
    }
}
