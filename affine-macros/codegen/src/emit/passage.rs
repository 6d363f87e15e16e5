//! The way from a phase point to the reduced state and back, as statements.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::algebra::fault::never_missing;
use crate::algebra::passage::{DilatationalMotion, MatrixFunction, Statement, Tensor, Word};
use crate::ir::Program;
use crate::symbol::{Frame, Quantity, Symbol};

use super::body::Body;
use super::context::{Coefficients, Context};
use super::number::Number;
use super::pattern::{ident, identifiers, pattern, reads, table};
use super::point::{bind_matrix, projected, spin};

/// Statements that bind what is read of them.
pub(super) fn statements(context: &Context, statements: &[Statement], used: &[Symbol]) -> TokenStream {
    statements.iter().map(|one| statement(context, one, used)).collect()
}

fn statement(context: &Context, statement: &Statement, used: &[Symbol]) -> TokenStream {
    let rt = &context.names.rt;
    let mut writer = Writer { context, lets: TokenStream::new() };
    let bound = match statement {
        Statement::Named(word, value) => {
            let (name, value) = (variable(*word), writer.value(value));
            quote!(let #name = #value;)
        }
        Statement::Pair(words, value) => {
            let ([a, b], value) = (words.map(variable), writer.value(value));
            quote!(let (#a, #b) = #value;)
        }
        Statement::Symbol(symbol, value) => {
            let (name, value) = (ident(symbol), writer.value(value));
            quote!(let #name = #value;)
        }
        Statement::Listed(symbols, value) => {
            let (names, value) = (identifiers(symbols), writer.value(value));
            quote!(let [#(#names),*] = #value;)
        }
        Statement::Components(symbols, value) if reads(used, symbols) => {
            let (names, value) = (pattern(symbols, used), writer.reference(value));
            quote!(let #names = #rt::components(#value);)
        }
        Statement::Components(..) => TokenStream::new(),
        Statement::Entries(rows, value) => {
            bind_matrix(context, rows, used, &writer.reference(value)).unwrap_or_default()
        }
        Statement::Dependent => context.dependent(&context.model.dynamics.reduced),
    };
    let lets = writer.lets;
    quote!(#lets #bound)
}

/// A value that no statement has to stand before.
pub(super) fn value(context: &Context, value: &Tensor) -> TokenStream {
    Writer { context, lets: TokenStream::new() }.value(value)
}

/// The programs that some statements evaluate.
pub(super) fn programs(context: &Context, statements: &[Statement]) -> Vec<Program> {
    let mut list = Vec::new();
    for value in statements.iter().filter_map(Statement::value) {
        value.any(&mut |part| {
            match part {
                Tensor::Factor(factor) | Tensor::Scaled(_, factor) => {
                    list.extend(giving(context, *factor).map(|program| program.only(&(*factor).into())));
                }
                Tensor::OfDilatation => list.extend(context.model.dynamics.dilatation.clone()),
                _ => {}
            }
            false
        });
    }
    list
}

/// Does anything of some statements hold?
pub(super) fn any(statements: &[Statement], is_it: impl Fn(&Tensor) -> bool) -> bool {
    statements.iter().filter_map(Statement::value).any(|value| value.any(&mut |part| is_it(part)))
}

/// The program of the model that gives a quantity.
fn giving<'a>(context: &Context<'a>, factor: Quantity) -> Option<&'a Program> {
    let point = &context.model.point;
    let programs = [&point.isotropic, &point.mass].into_iter().flatten();
    programs.into_iter().find(|program| program.results().any(|symbol| *symbol == factor.into()))
}

pub(super) fn variable(word: Word) -> Ident {
    format_ident!("{}", word.name())
}

/// The constructor of a motion of the dilatation.
pub(super) fn closed_form(motion: DilatationalMotion) -> TokenStream {
    match motion {
        DilatationalMotion::Free => quote!(free),
        DilatationalMotion::Harmonic => quote!(harmonic),
        DilatationalMotion::Hyperbolic => quote!(hyperbolic),
    }
}

/// Writes values, and before them what the model computes for them.
struct Writer<'a> {
    context: &'a Context<'a>,
    lets: TokenStream,
}

impl Writer<'_> {
    fn value(&mut self, value: &Tensor) -> TokenStream {
        let rt = &self.context.names.rt;
        match value {
            Tensor::OfPoint(quantity) => self.of_point(*quantity),
            Tensor::Variable(word) => {
                let name = variable(*word);
                quote!(#name)
            }
            Tensor::Constant(word) => {
                let name = variable(*word);
                quote!(constants.#name)
            }
            Tensor::Time => quote!(t),
            Tensor::Factor(factor) => self.factor(*factor),
            // More than one number, which the function around it takes.
            Tensor::OfDilatation => self.of_dilatation(),
            Tensor::List(symbols) => {
                let names = identifiers(symbols);
                quote!([#(#names),*])
            }
            Tensor::Vector(symbols) => {
                let names = identifiers(symbols);
                quote!(#rt::vector([#(#names),*]))
            }
            Tensor::Matrix(rows) => {
                let rows = table(rows);
                quote!(#rt::matrix(#rows))
            }
            Tensor::NegativeSum(symbols) => {
                let names = identifiers(symbols);
                quote!(-(#(#names)+*))
            }
            Tensor::Plus(both) => {
                let [a, b] = both.each_ref().map(|one| self.value(one));
                quote!(#a + #b)
            }
            Tensor::Minus(both) => {
                let [a, b] = both.each_ref().map(|one| self.value(one));
                quote!(#a - #b)
            }
            Tensor::Times(both) => {
                let (a, b) = (self.value(&both[0]), self.atom(&both[1]));
                quote!(#a * #b)
            }
            Tensor::TransposedTimes(both) => {
                let (a, b) = (self.atom(&both[0]), self.reference(&both[1]));
                quote!(#a.tr_mul(#b))
            }
            Tensor::Transpose(of) => {
                let of = self.atom(of);
                quote!(#of.transpose())
            }
            Tensor::Scaled(of, factor) => self.scaled(of, *factor),
            Tensor::Applied(function, arguments) => self.applied(*function, arguments),
        }
    }

    /// The same as a factor or before a method.
    fn atom(&mut self, value: &Tensor) -> TokenStream {
        let tokens = self.value(value);
        match value {
            Tensor::Plus(_) | Tensor::Minus(_) | Tensor::Times(_) => quote!((#tokens)),
            _ => tokens,
        }
    }

    /// The same as a reference.
    fn reference(&mut self, value: &Tensor) -> TokenStream {
        let tokens = self.atom(value);
        match value {
            Tensor::OfPoint(Quantity::Placement) => tokens,
            _ => quote!(&#tokens),
        }
    }

    fn of_point(&self, quantity: Quantity) -> TokenStream {
        let rt = &self.context.names.rt;
        match quantity {
            Quantity::Placement => quote!(#rt::Phase::phi(point)),
            Quantity::Position => quote!(#rt::Phase::x(point)),
            Quantity::LinearMomentum => quote!(#rt::Phase::p(point)),
            Quantity::ComovingLinearMomentum => quote!(#rt::Phase::p_hat(point).0.0),
            Quantity::TotalAffineMomentum => quote!(#rt::total_affine_momentum(point)),
            spin_of => spin(self.context, frame_of(spin_of)),
        }
    }

    fn factor(&mut self, factor: Quantity) -> TokenStream {
        let Some(program) = giving(self.context, factor) else { return TokenStream::new() };
        let body = self.context.generic(&program.only(&factor.into()), Coefficients::Given);
        let result = body.result();
        self.lets.extend(body.lets);
        result
    }

    fn scaled(&mut self, of: &Tensor, factor: Quantity) -> TokenStream {
        let of = self.atom(of);
        let Some(program) = giving(self.context, factor) else { return of };
        let number = Number::Generic(&self.context.names.scalar);
        let (lets, product) = self.context.times(of, (program, factor), number);
        self.lets.extend(lets);
        product
    }

    fn of_dilatation(&mut self) -> TokenStream {
        let Some(program) = &self.context.model.dynamics.dilatation else { return TokenStream::new() };
        let Body { lets, results } = self.context.generic(program, Coefficients::Given);
        self.lets.extend(lets);
        quote!(#(#results),*)
    }

    fn applied(&mut self, function: MatrixFunction, arguments: &[Tensor]) -> TokenStream {
        let (rt, t) = (&self.context.names.rt, &self.context.names.scalar);
        match (function, arguments) {
            (MatrixFunction::Turn, [p]) => {
                let p = self.reference(p);
                quote!(#rt::turn(#p, ::core::option::Option::None))
            }
            (MatrixFunction::TurnOfBoth, [p, total]) => {
                let (p, total) = (self.reference(p), self.reference(total));
                quote!(#rt::turn(#p, ::core::option::Option::Some(#total)))
            }
            (MatrixFunction::Projected, [of]) => projected(self.context, self.value(of)),
            (MatrixFunction::MeanLogStretch, [phi]) => self.call("mean_log_stretch", phi),
            (MatrixFunction::InverseDilatation, [phi]) => {
                let dilatation = self.call("dilatation", phi);
                quote!(#t::one() / #dilatation)
            }
            (MatrixFunction::Isochoric, [phi]) => self.call("isochoric_part", phi),
            (MatrixFunction::Exponential, [skew]) => self.call("skew_exponential", skew),
            (MatrixFunction::Inverse, [of]) => self.call("inverse", of),
            (MatrixFunction::ShearAndTurn, [spin, factor]) => {
                let (spin, factor) = (self.reference(spin), self.value(factor));
                quote!(#rt::shear_and_turn(#spin, #factor))
            }
            (MatrixFunction::FromShearAndTurn, [parts, factor, trace]) => {
                let [parts, factor, trace] = [parts, factor, trace].map(|one| self.value(one));
                quote!(#rt::from_shear_and_turn(&#parts, #factor, #trace))
            }
            (MatrixFunction::Trace, [of]) => {
                let of = self.atom(of);
                quote!(#of.trace())
            }
            (MatrixFunction::Exp, [of]) => {
                let of = self.value(of);
                quote!(#rt::Scalar::exp(#of))
            }
            (MatrixFunction::DilatationAt, [motion, time]) => {
                let [motion, time] = [motion, time].map(|one| self.value(one));
                quote!(#motion.at(#time))
            }
            (MatrixFunction::Dilatation(motion), arguments) => {
                let path = closed_form(motion);
                let arguments: Vec<TokenStream> = arguments.iter().map(|one| self.value(one)).collect();
                quote!(#rt::Breathing::#path(#(#arguments),*))
            }
            _ => never_missing(None, "functions of matrices have their arguments", TokenStream::new()),
        }
    }

    /// A function of the runtime of one matrix.
    fn call(&mut self, function: &str, of: &Tensor) -> TokenStream {
        let (rt, name, of) = (&self.context.names.rt, format_ident!("{function}"), self.reference(of));
        quote!(#rt::#name(#of))
    }
}

/// The frame whose affine spin it is.
pub(super) fn frame_of(spin: Quantity) -> Frame {
    match spin {
        Quantity::ComovingAffineSpin => Frame::Body,
        Quantity::CanonicalMomentum => Frame::Flat,
        _ => Frame::Space,
    }
}
