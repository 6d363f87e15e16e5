//! What every emitter reads of a model, and programs over its fields and coefficients.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote, quote_spanned};

use crate::derive::{ChangeOfBases, Equations, Model};
use crate::ir::{Op, Program};
use crate::spec::{Capability, Custom, Role, Spec};
use crate::symbol::{Frame, Quantity, Symbol};

use super::body::{Body, body};
use super::common::Function;
use super::names::{Names, variant};
use super::number::{Number, number};
use super::pattern::{ident, named};
use super::scope::Scope;

/// Where a method has its coefficients from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Coefficients {
    /// They are given to it.
    Given,
    /// The model has them.
    Own,
}

impl Coefficients {
    /// Those of a method at one point: what is generic is given them.
    pub(super) fn of(number: Number) -> Self {
        match number {
            Number::Generic(_) => Self::Given,
            Number::Double => Self::Own,
        }
    }
}

/// What every emitter reads.
pub(super) struct Context<'a> {
    pub(super) spec: &'a Spec,
    pub(super) model: &'a Model,
    pub(super) names: &'a Names,
    /// Do coefficients depend on fields?
    pub(super) has_fields: bool,
    /// What several programs call.
    pub(super) common: Option<Function>,
}

impl Context<'_> {
    pub(super) fn dim(&self) -> Literal {
        number(self.model.dim)
    }

    pub(super) fn frame(&self) -> TokenStream {
        let rt = &self.names.rt;
        match self.model.frame {
            Frame::Body => quote!(#rt::Body),
            Frame::Space => quote!(#rt::Space),
            Frame::Flat => quote!(#rt::Canonical),
        }
    }

    /// How right-hand sides are inlined: lanes become vectors of the processor only inside of a function that is compiled for
    /// it.
    pub(super) fn inline(&self) -> TokenStream {
        match self.spec.asked().has(Capability::Lanes) {
            true => quote!(#[inline(always)]),
            false => quote!(#[inline]),
        }
    }

    /// The constraint, as an expression.
    pub(super) fn constraint(&self) -> Option<TokenStream> {
        let rt = &self.names.rt;
        let group = variant(self.model.constraint?);
        Some(quote!(#rt::Constraint::#group))
    }

    /// `let` statements for the entries of the affine momentum that are linear in components of an array.
    pub(super) fn dependent(&self, equations: &Equations) -> TokenStream {
        let program = &equations.dependent;
        let Body { lets, results } = self.generic(program, Coefficients::Given);
        let names: Vec<Ident> = program.results().map(ident).collect();
        // A result with a step of its own is bound to its name already.
        let is_bound = |name: &Ident, result: &TokenStream| {
            syn::parse2::<Ident>(result.clone()).is_ok_and(|result| result == *name)
        };
        let others = names.iter().zip(&results).filter(|(name, result)| !is_bound(name, result));
        let rest = others.map(|(name, result)| quote!(let #name = #result;));
        quote!(#lets #(#rest)*)
    }

    /// Type of the centre of mass over a scalar.
    pub(super) fn centre(&self, scalar: &TokenStream) -> TokenStream {
        let (rt, n) = (&self.names.rt, self.dim());
        match self.model.translation {
            Some(_) => quote!(#rt::Centre<#n, #scalar>),
            None => quote!(#rt::Pinned),
        }
    }

    /// Type of phase points over a scalar.
    pub(super) fn point(&self, scalar: &TokenStream) -> TokenStream {
        let (rt, n, frame, centre) = (&self.names.rt, self.dim(), self.frame(), self.centre(scalar));
        let basis = self.model.metrics.is_some().then(|| quote!(, #rt::Given));
        quote!(#rt::PhasePoint<#n, #frame, #centre, #scalar #basis>)
    }

    /// Generics of the type that implements the model.
    pub(super) fn generics(&self) -> (TokenStream, TokenStream, TokenStream) {
        if self.has_fields && self.spec.customs.is_empty() {
            return (TokenStream::new(), TokenStream::new(), TokenStream::new());
        }
        let (implementation, ty, clause) = self.spec.item.generics.split_for_impl();
        (quote!(#implementation), quote!(#ty), quote!(#clause))
    }

    /// The implementation of a trait of the runtime for what implements the model.
    pub(super) fn implementation(&self, of: &str, items: &TokenStream) -> TokenStream {
        let (of, prepared) = (format_ident!("{of}"), &self.names.prepared);
        let ((generics, types, clause), rt, n) = (self.generics(), &self.names.rt, self.dim());
        quote!(impl #generics #rt::#of<#n> for #prepared #types #clause { #items })
    }

    /// A field as what it computes. It stands where the specification names it, so that what its type lacks is said there,
    /// and once: the calls ask nothing of it any more.
    pub(super) fn computing(&self, name: &Ident, custom: &Custom) -> TokenStream {
        let at = place(custom);
        let (n, rt) = (self.dim(), Ident::new(&self.names.rt.to_string(), at));
        let name = Ident::new(&name.to_string(), at);
        let field = if self.has_fields { &name } else { &custom.field };
        let force = |form: TokenStream| quote_spanned!(at=> as_force::<#n, #form, _>);
        let function = match custom.role.value {
            Role::Spatial => force(quote_spanned!(at=> #rt::Space)),
            Role::Comoving => force(quote_spanned!(at=> #rt::Body)),
            Role::Translation => force(quote_spanned!(at=> #rt::force::Translation)),
            Role::Isotropic | Role::Green | Role::Finger | Role::General => {
                quote_spanned!(at=> as_potential::<#n, _>)
            }
        };
        quote_spanned!(at=> let #name = #rt::#function(&self.#field);)
    }

    /// A program over the scalar type parameter.
    pub(super) fn generic(&self, program: &Program, coefficients: Coefficients) -> Body {
        self.body(program, Number::Generic(&self.names.scalar), coefficients)
    }

    /// A program over doubles.
    pub(super) fn double(&self, program: &Program) -> Body {
        self.body(program, Number::Double, Coefficients::Own)
    }

    /// A program over a number, whose inputs are variables of the same name.
    pub(super) fn written(&self, program: &Program, number: Number) -> Body {
        let input = |symbol: &Symbol| named(symbol);
        let rebased = self.model.metrics.is_some();
        let places: Vec<Span> = self.spec.customs.iter().map(place).collect();
        body(program, &Scope { number, input: &input, rebased, places: &places, rt: &self.names.rt })
    }

    /// The same with coefficients that are read first, and what several programs compute called.
    pub(super) fn body(&self, program: &Program, number: Number, coefficients: Coefficients) -> Body {
        let called = self.common.as_ref().and_then(|function| function.called_by(program, false));
        self.calling(program, called, number, coefficients)
    }

    /// The same with this call, and what it leaves of the program.
    pub(super) fn calling(
        &self,
        program: &Program,
        called: Option<(TokenStream, Program)>,
        number: Number,
        coefficients: Coefficients,
    ) -> Body {
        let (call, rest) = called.unzip();
        let Body { lets, results } = self.written(rest.as_ref().unwrap_or(program), number);
        let read = program.symbols().filter_map(|symbol| {
            let (index, name) = (coefficient_index(symbol)?, ident(symbol));
            let value = match coefficients {
                Coefficients::Given => quote!(coefficients[#index]),
                Coefficients::Own => number.of_double(quote!(self.coefficients[#index])),
            };
            Some(quote!(let #name = #value;))
        });
        let fields = self.spec.customs.iter().enumerate().filter_map(|(k, custom)| {
            program.calls.iter().find(|call| call.field() == Some(k + 1))?;
            let name = format_ident!("custom_{}", k + 1);
            Some(self.computing(&name, custom))
        });
        let change = self.change_for(program, number, coefficients);
        Body { lets: read.chain(change).chain(fields).chain(call).chain([lets]).collect(), results }
    }

    /// What several programs call, as an item.
    pub(super) fn function(&self) -> Option<TokenStream> {
        let number = Number::Generic(&self.names.scalar);
        let item = |function: &Function| function.item(&self.written(function.program(), number), self.names);
        self.common.as_ref().map(item)
    }

    /// A value times a result of a program: statements, and the product; no factor 1.
    pub(super) fn times(
        &self,
        value: TokenStream,
        (program, factor): (&Program, Quantity),
        number: Number,
    ) -> (TokenStream, TokenStream) {
        let factor = factor.into();
        let program = program.only(&factor);
        if let [Op::Constant(one)] = program.steps.as_slice()
            && one.is_one()
        {
            return (TokenStream::new(), value);
        }
        let body = self.body(&program, number, Coefficients::of(number));
        let (lets, name, result) = (&body.lets, ident(&factor), body.result());
        (quote!(#lets let #name = #result;), quote!(#value * #name))
    }

    /// The bases over a scalar, or over the one that is asked for where they stand.
    pub(super) fn bases(&self, scalar: Option<&TokenStream>, coefficients: Coefficients) -> TokenStream {
        let (rt, n) = (&self.names.rt, self.dim());
        let of = scalar.map(|scalar| quote!(::<#scalar>));
        match (self.has_prepared_bases(), coefficients) {
            (false, _) => quote!(bases #of ()),
            (true, Coefficients::Given) => quote!(#rt::bases_beside::<#n, _, _>(coefficients)),
            (true, Coefficients::Own) => {
                quote!(#rt::bases_beside::<#n, _, _>(&self.coefficients).over #of ())
            }
        }
    }

    /// Number of coefficients of the prepared model, with the entries of its bases.
    pub(super) fn coefficients(&self) -> usize {
        let entries = if self.has_prepared_bases() { 4 * self.model.dim.pow(2) } else { 0 };
        self.model.prepared.coefficients.outputs.len() + entries
    }

    /// Do the bases of equations follow from fields?
    pub(super) fn has_prepared_bases(&self) -> bool {
        matches!(self.model.metrics, Some(ChangeOfBases::Prepared))
    }

    /// The change of bases for the fields that a program calls.
    fn change_for(
        &self,
        program: &Program,
        number: Number,
        coefficients: Coefficients,
    ) -> Option<TokenStream> {
        let calls = program.calls.iter().any(|call| call.field().is_some());
        let rt = &self.names.rt;
        let scalar = match number {
            Number::Generic(scalar) => quote!(#scalar),
            Number::Double => quote!(#rt::f64),
        };
        let bases = self.bases(Some(&scalar), coefficients);
        (calls && self.model.metrics.is_some()).then(|| quote!(let change = &#bases;))
    }

    /// Puts `point`, a reference, in orthonormal bases.
    pub(super) fn inward(&self, coefficients: Coefficients) -> TokenStream {
        let rt = &self.names.rt;
        if self.has_prepared_bases() && coefficients == Coefficients::Given {
            let bases = self.bases(None, coefficients);
            return quote! {
                let point = &#rt::Phase::in_orthonormal(point, ::core::option::Option::Some(&#bases));
            };
        }
        self.with_metrics(quote!(let point = &#rt::Model::orthonormal(self, point);))
    }

    /// A point in the user's bases.
    pub(super) fn outward(
        &self,
        scalar: &TokenStream,
        point: TokenStream,
        coefficients: Coefficients,
    ) -> TokenStream {
        let (rt, bases) = (&self.names.rt, self.bases(Some(scalar), coefficients));
        match self.model.metrics {
            Some(_) => quote!(#rt::Phase::from_orthonormal(&#point, &#bases)),
            None => point,
        }
    }

    /// Statements for a model with metrics.
    pub(super) fn with_metrics(&self, statements: TokenStream) -> TokenStream {
        if self.model.metrics.is_some() { statements } else { TokenStream::new() }
    }
}

/// Where the specification names a field that is called; names there mean what they mean elsewhere.
fn place(custom: &Custom) -> Span {
    Span::call_site().located_at(custom.field.span())
}

/// Index of `c_1`, `c_2`, ... in the prepared model.
pub(super) fn coefficient_index(symbol: &Symbol) -> Option<Literal> {
    match symbol {
        Symbol::Component(Quantity::Coefficient, index) => Some(number(index.first()?.checked_sub(1)?)),
        _ => None,
    }
}
