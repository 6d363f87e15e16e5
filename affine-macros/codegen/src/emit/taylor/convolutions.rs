//! The convolutions of one order: vectors of factors, loops over the orders before, the terms at both ends.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::super::number;
use super::Writer;
use crate::ir::taylor::{Factor, Pass, Place, Recurrence, Series, sums};

/// Accumulators of one sum. A sum of several products would wait for its own last addition in every turn of the loop.
const CHAINS: usize = 3;
/// Accumulators in one loop: with what is multiplied, the sixteen registers of AVX2.
const ACCUMULATORS: usize = 9;

/// Passes of one kind and the stem of the names of their sums.
type Kind<'a> = (&'static str, &'a [Pass]);

impl Writer<'_> {
    /// The vectors of ready series, or the others: all lanes of a row that begin at `slot`.
    pub(super) fn vectors(&self, ready: bool) -> TokenStream {
        let t = &self.context.names.scalar;
        let is_ready =
            |series: &Option<Series>| series.is_none_or(|s| self.recurrence.ready[s.value] && !s.rate);
        let vectors =
            self.recurrence.row[..self.recurrence.vectors].chunks(self.recurrence.lanes).enumerate();
        vectors
            .filter(|(_, vector)| vector.iter().all(is_ready) == ready)
            .map(|(index, vector)| {
                let name = self.vector(index * self.recurrence.lanes);
                let entries = vector.iter().map(|series| match series {
                    Some(series) => self.current(*series),
                    None => quote!(#t::zero()),
                });
                quote!(let #name = [#(#entries),*];)
            })
            .collect()
    }

    fn vector(&self, slot: usize) -> Ident {
        format_ident!("lanes_{}", slot / self.recurrence.lanes + 1)
    }

    /// Fills the row of order `k`.
    pub(super) fn stored(&self) -> TokenStream {
        let Recurrence { row, vectors, lanes, .. } = self.recurrence;
        if row.is_empty() {
            return TokenStream::new();
        }
        let names = (0..*vectors).step_by(*lanes).map(|slot| self.vector(slot));
        let singles = row[*vectors..].iter().flatten().map(|series| self.current(*series));
        let entries = names
            .flat_map(|name| {
                (0..*lanes).map(move |lane| {
                    let lane = number(lane);
                    quote!(#name[#lane])
                })
            })
            .chain(singles);
        quote!(*row = [#(#entries),*];)
    }

    fn kinds(&self) -> [Kind<'_>; 2] {
        [("full", &self.recurrence.full), ("inner", &self.recurrence.inner)]
    }

    /// The terms `j = 1..k` of all convolutions.
    pub(super) fn loops(&self) -> TokenStream {
        let t = &self.context.names.scalar;
        let lanes = number(self.recurrence.lanes);
        let blocks = self.blocks().into_iter().map(|block| {
            let names = block.iter().flat_map(|((stem, passes), sum)| {
                (0..chains(passes, *sum)).map(|chain| accumulator(stem, *sum, chain))
            });
            let statements = block.iter().flat_map(|((stem, passes), sum)| {
                in_chains(passes).filter(|(pass, _)| pass.sum == *sum).map(|(pass, chain)| {
                    let (left, right) = self.factors(pass, &quote!(left), &quote!(right));
                    self.pass(&accumulator(stem, *sum, chain), pass, &left, &right)
                })
            });
            quote! {
                #(let mut #names = [#t::zero(); #lanes];)*
                for (left, right) in middle.iter().zip(middle.iter().rev()) {
                    #(#statements)*
                }
            }
        });
        let inner = self.gathered("inner", &self.recurrence.inner);
        quote!(#(#blocks)* #inner)
    }

    /// All sums, by the loops that form them.
    fn blocks(&self) -> Vec<Vec<(Kind<'_>, usize)>> {
        let mut blocks: Vec<Vec<(Kind<'_>, usize)>> = Vec::new();
        let mut open = 0;
        for kind in self.kinds() {
            for sum in 0..sums(kind.1) {
                let own = chains(kind.1, sum);
                match blocks.last_mut() {
                    Some(block) if open + own <= ACCUMULATORS => {
                        block.push((kind, sum));
                        open += own;
                    }
                    _ => {
                        blocks.push(vec![(kind, sum)]);
                        open = own;
                    }
                }
            }
        }
        blocks
    }

    /// The accumulators of every sum, added up.
    fn gathered(&self, stem: &str, passes: &[Pass]) -> TokenStream {
        let rt = &self.context.names.rt;
        let additions = (0..sums(passes)).flat_map(|sum| {
            let whole = accumulator(stem, sum, 0);
            (1..chains(passes, sum)).map(move |chain| {
                let part = accumulator(stem, sum, chain);
                quote!(#rt::add_lanes(vectors, &mut #whole, #part);)
            })
        });
        additions.collect()
    }

    /// The terms `j = 0` and `j = k` of all full convolutions.
    pub(super) fn ends(&self) -> TokenStream {
        let passes = &self.recurrence.full;
        let ends = in_chains(passes).map(|(pass, chain)| self.ends_of(pass, chain));
        let gathered = self.gathered("full", passes);
        quote!(#(#ends)* #gathered)
    }

    fn ends_of(&self, pass: &Pass, chain: usize) -> TokenStream {
        let (first_left, first_right) = self.factors(pass, &quote!(first), &quote!(first));
        let left = self.vector(pass.left);
        let right = match pass.right {
            Factor::Vector(slot) => {
                let right = self.vector(slot);
                quote!(#right)
            }
            Factor::Slot(slot) => {
                self.recurrence.row[slot].map(|series| self.current(series)).unwrap_or_default()
            }
        };
        let sum = accumulator("full", pass.sum, chain);
        let one = self.pass(&sum, pass, &first_left, &right);
        let other = self.pass(&sum, pass, &quote!(#left), &first_right);
        quote!(#one #other)
    }

    /// The factors of a multiplication from two rows.
    fn factors(&self, pass: &Pass, left: &TokenStream, right: &TokenStream) -> (TokenStream, TokenStream) {
        let rt = &self.context.names.rt;
        let vector = |row: &TokenStream, slot: usize| {
            let slot = number(slot);
            quote!(#rt::lanes(#row, #slot))
        };
        let right = match pass.right {
            Factor::Vector(slot) => vector(right, slot),
            Factor::Slot(slot) => {
                let slot = number(slot);
                quote!(#right[#slot])
            }
        };
        (vector(left, pass.left), right)
    }

    fn pass(&self, sum: &Ident, pass: &Pass, left: &TokenStream, right: &TokenStream) -> TokenStream {
        let rt = &self.context.names.rt;
        let name = match (pass.negative, pass.right) {
            (false, Factor::Vector(_)) => "add_products",
            (true, Factor::Vector(_)) => "subtract_products",
            (false, Factor::Slot(_)) => "add_multiple",
            (true, Factor::Slot(_)) => "subtract_multiple",
        };
        let function = format_ident!("{name}");
        quote!(#rt::#function(vectors, &mut #sum, #left, #right);)
    }

    /// A convolution that has been formed.
    pub(super) fn place(&self, place: Place) -> TokenStream {
        let sum = accumulator(if place.full { "full" } else { "inner" }, place.sum, 0);
        let lane = number(place.lane);
        quote!(#sum[#lane])
    }
}

/// Number of accumulators of a sum.
fn chains(passes: &[Pass], sum: usize) -> usize {
    passes.iter().filter(|pass| pass.sum == sum).count().min(CHAINS)
}

/// The passes with the accumulator of its sum that each goes to.
fn in_chains(passes: &[Pass]) -> impl Iterator<Item = (&Pass, usize)> {
    passes.iter().enumerate().map(|(index, pass)| {
        let before = passes[..index].iter().filter(|other| other.sum == pass.sum).count();
        (pass, before % CHAINS)
    })
}

/// The sum itself, to which the others are added.
fn accumulator(stem: &str, sum: usize, chain: usize) -> Ident {
    match chain {
        0 => format_ident!("{stem}_{}", sum + 1),
        _ => format_ident!("{stem}_{}_{}", sum + 1, chain + 1),
    }
}
