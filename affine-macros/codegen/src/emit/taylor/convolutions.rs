//! The convolutions of one order: vectors of factors, loops over the orders before, the terms at both ends.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::writer::Writer;
use crate::emit::number::number;
use crate::ir::taylor::{Factor, Pass, Place, sums};

/// Sums that are formed in one loop: with the factors from both rows they fill the registers of AVX-512, and with half as
/// many registers two loops that load everything twice are no faster.
const SUMS_PER_LOOP: usize = 9;

impl Writer<'_> {
    pub(super) fn vector(&self, slot: usize) -> Ident {
        format_ident!("lanes_{}", slot / self.recurrence.lanes + 1)
    }

    /// All convolutions: the full ones over the rows `0..=k`, the inner ones over those between. Their terms come in pairs,
    /// `j` and `k - j`. The pair that has the newest row comes last: no other waits for it.
    pub(super) fn convolutions(&self) -> TokenStream {
        let rt = &self.context.names.rt;
        let rows = [
            ("full", &self.recurrence.full, quote!(let (low, centre, high) = #rt::halves(rows);)),
            (
                "inner",
                &self.recurrence.inner,
                quote!(let (low, centre, high) = #rt::halves(#rt::between(rows));),
            ),
        ];
        let convolutions = rows.into_iter().filter(|(_, passes, _)| !passes.is_empty());
        convolutions
            .map(|(stem, passes, halves)| {
                let loops = self.loops(stem, passes);
                let doubled = self.doubled(stem, passes);
                quote!(#halves #loops #doubled)
            })
            .collect()
    }

    fn loops(&self, stem: &str, passes: &[Pass]) -> TokenStream {
        let t = &self.context.names.scalar;
        let lanes = number(self.recurrence.lanes);
        let all: Vec<usize> = (0..sums(passes)).collect();
        let blocks = all.chunks(SUMS_PER_LOOP).map(|block| {
            let names = block.iter().map(|sum| self.sum(stem, *sum));
            let own = || passes.iter().filter(|pass| block.contains(&pass.sum));
            let centres = own().map(|pass| self.centre(stem, pass));
            let pairs = own().map(|pass| {
                let [left, right] = [quote!(left), quote!(right)].map(|row| self.factors(pass, &row));
                self.pair(stem, pass, left, right)
            });
            quote! {
                #(let mut #names = [#t::zero(); #lanes];)*
                if let ::core::option::Option::Some(centre) = centre {
                    #(#centres)*
                }
                for (left, right) in ::core::iter::Iterator::zip(::core::iter::Iterator::rev(low.iter()), high) {
                    #(#pairs)*
                }
            }
        });
        blocks.collect()
    }

    /// The factors of a multiplication, both from one row.
    fn factors(&self, pass: &Pass, row: &TokenStream) -> [TokenStream; 2] {
        let rt = &self.context.names.rt;
        let vector = |slot: usize| {
            let slot = number(slot);
            quote!(#rt::lanes(#row, #slot))
        };
        let right = match pass.right {
            Factor::Vector(slot) => vector(slot),
            Factor::Slot(slot) => {
                let slot = number(slot);
                self.in_all_lanes(&quote!(#row[#slot]))
            }
        };
        [vector(pass.left), right]
    }

    fn in_all_lanes(&self, entry: &TokenStream) -> TokenStream {
        let lanes = number(self.recurrence.lanes);
        quote!([#entry; #lanes])
    }

    /// The terms `j` and `k - j` from the factors of two rows; of a square, one of two that are equal.
    fn pair(&self, stem: &str, pass: &Pass, one: [TokenStream; 2], other: [TokenStream; 2]) -> TokenStream {
        let rt = &self.context.names.rt;
        let (sum, [a, b], [c, d]) = (self.sum(stem, pass.sum), one, other);
        if pass.is_square() {
            return self.product(pass, &sum, &a, &c);
        }
        let function = if pass.negative { quote!(subtract_pair) } else { quote!(add_pair) };
        quote!(#rt::#function(vectors, &mut #sum, [#a, #d], [#c, #b]);)
    }

    /// The term `j = k/2`; of a square, half of it.
    fn centre(&self, stem: &str, pass: &Pass) -> TokenStream {
        let rt = &self.context.names.rt;
        let [left, right] = self.factors(pass, &quote!(centre));
        let left = if pass.is_square() { quote!(#rt::halved(vectors, #left)) } else { left };
        self.product(pass, &self.sum(stem, pass.sum), &left, &right)
    }

    fn product(&self, pass: &Pass, sum: &Ident, left: &TokenStream, right: &TokenStream) -> TokenStream {
        let rt = &self.context.names.rt;
        let function = if pass.negative { quote!(subtract_products) } else { quote!(add_products) };
        quote!(#rt::#function(vectors, &mut #sum, #left, #right);)
    }

    /// Squares from their halves.
    fn doubled(&self, stem: &str, passes: &[Pass]) -> TokenStream {
        let rt = &self.context.names.rt;
        let mut squares: Vec<usize> = passes.iter().filter(|p| p.is_square()).map(|p| p.sum).collect();
        squares.dedup();
        let squares = squares.into_iter().map(|sum| self.sum(stem, sum));
        quote!(#(let #squares = #rt::doubled(vectors, #squares);)*)
    }

    pub(super) fn sum(&self, stem: &str, sum: usize) -> Ident {
        format_ident!("{stem}_{}", sum + 1)
    }

    /// A convolution that has been formed.
    pub(super) fn place(&self, place: Place) -> TokenStream {
        let sum = self.sum(if place.full { "full" } else { "inner" }, place.sum);
        let lane = number(place.lane);
        quote!(#sum[#lane])
    }
}
