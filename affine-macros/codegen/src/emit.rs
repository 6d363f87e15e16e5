//! A derived model as Rust items; no algebra here.

mod body;
mod closed_form;
mod description;
mod domain;
mod dynamics;
mod forces;
mod kernel;
mod metrics;
mod mixed;
mod names;
mod packed;
mod points;
mod prepare;
mod quantities;
mod reduction;
mod second_order;
mod separated;
mod splitting;
mod tangent;
mod taylor;
mod two_polar;

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote, quote_spanned};

use crate::algebra::kernel::Callee;
use crate::derive::{ChangeOfBases, Equations, Model};
use crate::ir::Program;
use crate::mechanics::kinetic::Frame;
use crate::spec::{Custom, Role, Spec};

use body::{Body, Number, Scope, body, inputs};
use names::Names;

/// The user's item and everything that belongs to it.
pub fn emit(spec: &Spec, model: &Model) -> TokenStream {
    let bases_of_fields = matches!(model.metrics, Some(ChangeOfBases::Prepared(_)));
    let has_fields = !model.coefficients.outputs.is_empty() || bases_of_fields;
    let names = Names::new(spec, has_fields);
    let runtime = runtime(spec.runtime.as_ref());
    let context = Context { spec, model, names: &names, has_fields };
    let item = &spec.item.tokens;
    let rt = &names.rt;
    let prepared_type = prepare::prepared_type(&context);
    let prepare = prepare::method(&context);
    if spec.group.is_some() {
        let lattice = two_polar::lattice_of_circle(&context);
        return quote! {
            #item
            #prepared_type
            const _: () = {
                use #runtime::__private as #rt;
                #prepare
                #lattice
            };
        };
    }
    let constants = reduction::constants_type(&context);
    let implementation = model_impl(&context);
    let points = points::inherent(&context);
    let unprepared = points::unprepared(&context);
    let two_polar = two_polar::implementations(&context);
    let (bases, _) = metrics::bases(&context);
    let splitting = splitting::splitting_impl(&context);
    let second_order = second_order::implementation(&context);
    let tangent = tangent::implementation(&context);
    let taylor = taylor::taylor_impl(&context);
    let lanes = reduction::lanes::implementation(&context);
    let packed = packed::implementation(&context);
    let lints = metrics::lints(&context);
    quote! {
        #item
        #prepared_type
        #lints
        const _: () = {
            use #runtime::__private as #rt;
            #prepare
            #unprepared
            #bases
            #constants
            #implementation
            #points
            #splitting
            #second_order
            #two_polar
            #taylor
            #tangent
            #lanes
            #packed
        };
    }
}

/// The path of the runtime.
pub fn runtime(renamed: Option<&syn::Path>) -> TokenStream {
    match renamed {
        Some(path) => quote!(#path),
        None => quote!(::affine_runtime),
    }
}

/// What every emitter reads.
struct Context<'a> {
    spec: &'a Spec,
    model: &'a Model,
    names: &'a Names,
    /// Do coefficients depend on fields?
    has_fields: bool,
}

impl Context<'_> {
    fn dim(&self) -> Literal {
        number(self.model.dim)
    }

    fn frame(&self) -> TokenStream {
        let rt = &self.names.rt;
        match self.model.frame {
            Frame::Body => quote!(#rt::Body),
            Frame::Space => quote!(#rt::Space),
            Frame::Flat => quote!(#rt::Canonical),
        }
    }

    /// The constraint, as an expression.
    fn constraint(&self) -> Option<TokenStream> {
        let rt = &self.names.rt;
        let group = self.model.constraint?;
        let group = format_ident!("{}", format!("{group:?}"));
        Some(quote!(#rt::Constraint::#group))
    }

    /// `let` statements for the entries of the affine momentum that are linear in components of an array.
    fn dependent(&self, equations: &Equations) -> TokenStream {
        let program = &equations.dependent;
        let Body { lets, results } = self.generic(program);
        let names = identifiers(&program.outputs.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>());
        // A result with a step of its own is bound to its name already.
        let lets_of =
            names.iter().zip(&results).filter(|(name, result)| name.to_string() != result.to_string());
        let rest = lets_of.map(|(name, result)| quote!(let #name = #result;));
        quote!(#lets #(#rest)*)
    }

    /// Type of the centre of mass over a scalar.
    fn centre(&self, scalar: &TokenStream) -> TokenStream {
        let (rt, n) = (&self.names.rt, self.dim());
        match self.model.translation {
            Some(_) => quote!(#rt::Centre<#n, #scalar>),
            None => quote!(#rt::Pinned),
        }
    }

    /// Type of phase points over a scalar.
    fn point(&self, scalar: &TokenStream) -> TokenStream {
        let (rt, n, frame, centre) = (&self.names.rt, self.dim(), self.frame(), self.centre(scalar));
        let basis = self.model.metrics.is_some().then(|| quote!(, #rt::Given));
        quote!(#rt::PhasePoint<#n, #frame, #centre, #scalar #basis>)
    }

    /// Generics of the type that implements the model.
    fn generics(&self) -> (TokenStream, TokenStream, TokenStream) {
        if self.has_fields && self.spec.customs.is_empty() {
            return (TokenStream::new(), TokenStream::new(), TokenStream::new());
        }
        let (implementation, ty, clause) = self.spec.item.generics.split_for_impl();
        (quote!(#implementation), quote!(#ty), quote!(#clause))
    }

    /// A field as what it computes. It stands where the specification names it, so that what its type lacks is said there,
    /// and once: the calls ask nothing of it any more.
    fn computing(&self, name: &Ident, custom: &Custom) -> TokenStream {
        let at = place(custom);
        let (n, rt) = (self.dim(), Ident::new(&self.names.rt.to_string(), at));
        let name = Ident::new(&name.to_string(), at);
        let field = if self.has_fields { &name } else { &custom.field };
        let force = |form| {
            let form = Ident::new(form, at);
            quote_spanned!(at=> as_force::<#n, #rt::force::#form, _>)
        };
        let function = match custom.role.value {
            Role::Spatial => force("Spatial"),
            Role::Comoving => force("Comoving"),
            Role::Translation => force("Translation"),
            Role::Isotropic | Role::Green | Role::Finger | Role::General => {
                quote_spanned!(at=> as_potential::<#n, _>)
            }
        };
        quote_spanned!(at=> let #name = #rt::#function(&self.#field);)
    }

    /// A program over the scalar type parameter.
    fn generic(&self, program: &Program) -> Body {
        self.body(program, Number::Generic(&self.names.scalar))
    }

    /// A program over doubles.
    fn double(&self, program: &Program) -> Body {
        self.body(program, Number::Double)
    }

    /// A program whose inputs are variables of the same name, and coefficients that are read first.
    fn body(&self, program: &Program, number: Number) -> Body {
        let input = |name: &str| {
            let name = format_ident!("{name}");
            quote!(#name)
        };
        let rebased = self.model.metrics.is_some();
        let places: Vec<Span> = self.spec.customs.iter().map(place).collect();
        let scope = Scope { number, input: &input, rebased, places: &places, rt: &self.names.rt };
        let Body { lets, results } = body(program, &scope);
        let coefficients = inputs(program).into_iter().filter_map(|name| {
            let (index, name) = (coefficient_index(name)?, format_ident!("{name}"));
            let value = number.of_double(quote!(self.coefficients[#index]));
            Some(quote!(let #name = #value;))
        });
        let fields = self.spec.customs.iter().enumerate().filter_map(|(k, custom)| {
            program
                .calls
                .iter()
                .find(|call| matches!(call.callee, Callee::Custom(place, _) if place == k + 1))?;
            let name = format_ident!("custom_{}", k + 1);
            Some(self.computing(&name, custom))
        });
        let change = self.change_for(program, number);
        Body { lets: coefficients.chain(change).chain(fields).chain([lets]).collect(), results }
    }
}

/// Where the specification names a field that is called; names there mean what they mean elsewhere.
fn place(custom: &Custom) -> Span {
    Span::call_site().located_at(custom.field.span())
}

/// Index of `c_1`, `c_2`, ... in the prepared model.
fn coefficient_index(name: &str) -> Option<Literal> {
    let index: usize = name.strip_prefix("c_")?.parse().ok()?;
    Some(number(index.checked_sub(1)?))
}

/// A count as people write it.
fn number(count: usize) -> Literal {
    Literal::usize_unsuffixed(count)
}

/// Pattern that binds the components that `used` reads, in order.
fn pattern(components: &[String], used: &[&str]) -> TokenStream {
    let bind = components.iter().map(|name| {
        if used.contains(&name.as_str()) {
            let name = format_ident!("{name}");
            quote!(#name)
        } else {
            quote!(_)
        }
    });
    quote!([#(#bind),*])
}

fn identifiers(names: &[String]) -> Vec<Ident> {
    names.iter().map(|name| format_ident!("{name}")).collect()
}

fn model_impl(context: &Context) -> TokenStream {
    let Names { prepared, rt, constants, scalar, .. } = context.names;
    let (generics, types, clause) = context.generics();
    let n = context.dim();
    let size =
        |equations: &Equations| number(equations.groups.iter().map(|(_, components)| components.len()).sum());
    let (full, reduced) = (size(&context.model.full), size(&context.model.reduced));
    let point = context.point(&quote!(#scalar));
    let docs = description::docs(context);
    let description = description::constant(context);
    let dynamics = dynamics::methods(context);
    let reduction = reduction::methods(context);
    let geodesic = closed_form::geodesic(context);
    let (_, bases) = metrics::bases(context);
    let splitting = splitting::capability(context);
    let second_order = second_order::capability(context);
    let taylor = taylor::capability(context);
    let packing = packed::capability(context);
    let (power, domain) = (forces::power(context), domain::values(context));
    quote! {
        #(#[doc = #docs])*
        impl #generics #rt::Model<#n> for #prepared #types #clause {
            const DESCRIPTION: #rt::Description = #description;
            type Point<#scalar: #rt::Real> = #point;
            type Full<#scalar: #rt::Scalar> = [#scalar; #full];
            type Reduced<#scalar: #rt::Scalar> = [#scalar; #reduced];
            type Constants<#scalar: #rt::Scalar> = #constants<#scalar>;
            #bases
            #dynamics
            #reduction
            #geodesic
            #splitting
            #second_order
            #taylor
            #packing
            #power
            #domain
        }
    }
}
