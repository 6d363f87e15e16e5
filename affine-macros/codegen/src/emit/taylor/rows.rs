//! Rows: what of an order later convolutions read.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::reads;
use super::writer::Writer;
use crate::emit::number::number;
use crate::ir::Value;
use crate::ir::taylor::Series;

impl Writer<'_> {
    /// `ready`: the slots of an order that follow from its coefficient alone. They are written as soon as it is known, a
    /// vector at a time, and read from there.
    pub(super) fn ready(&mut self) -> TokenStream {
        let (rt, t) = (&self.context.names.rt, &self.context.names.scalar);
        let wanted: Vec<Value> = self.ready_slots().map(|(_, series)| series.value).collect();
        let rules = self.ready_rules(&wanted);
        let states = self.states_among(&wanted, &rules);
        let columns = self.recurrence.columns.iter().map(|column| self.vector(column.slot));
        let columns: Vec<Ident> = columns.collect();
        let (fixed, constants) = self.fix(&rules);
        let (bind, coefficient) = self.bind(&states, "coefficient");
        let statements = rules.iter().map(|(value, rule)| self.statement(*value, rule));
        let vectors = self.filled_vectors(true);
        let vectors_read = if vectors.is_empty() { quote!(_vectors) } else { quote!(vectors) };
        let singles = self.filled(self.ready_slots().filter(|(slot, _)| !self.is_in_ready_vector(*slot)));
        let stores = quote!(#vectors #singles);
        let row = if stores.is_empty() { quote!(_row) } else { quote!(row) };
        let columns = if columns.is_empty() { quote!(_) } else { quote!([#(#columns),*]) };
        quote! {
            #[inline(always)]
            fn ready<#t: #rt::Scalar>(
                &self,
                #vectors_read: impl #rt::Vectors,
                #constants: &Self::Constants<#t>,
                (#coefficient, #columns): (&Self::Reduced<#t>, Self::Columns<#t>),
                #row: &mut Self::Row<#t>,
            ) {
                #fixed
                #bind
                #(#statements)*
                #stores
            }
        }
    }

    /// Fills the slots of order `k` that `ready` left.
    pub(super) fn stored(&self) -> TokenStream {
        let singles = self.late_slots().filter(|(slot, _)| *slot >= self.recurrence.vectors);
        let (vectors, singles) = (self.filled_vectors(false), self.filled(singles));
        quote!(#vectors #singles)
    }

    /// Stores of the vectors all of which is ready, or of the others.
    fn filled_vectors(&self, ready: bool) -> TokenStream {
        let rt = &self.context.names.rt;
        let all = (0..self.recurrence.vectors).step_by(self.recurrence.lanes);
        all.filter(|slot| self.is_in_ready_vector(*slot) == ready)
            .map(|slot| {
                let (vector, slot) = (self.newest_vector(slot), number(slot));
                quote!(#rt::set_lanes(vectors, row, #slot, #vector);)
            })
            .collect()
    }

    /// Stores of single slots.
    fn filled(&self, slots: impl Iterator<Item = (usize, Series)>) -> TokenStream {
        let store = |(slot, series): (usize, Series)| {
            let (slot, entry) = (number(slot), self.current(series));
            quote!(row[#slot] = #entry;)
        };
        slots.map(store).collect()
    }

    /// What `stored` writes: slots that are not ready, and all of a vector that has one of them.
    pub(super) fn late_slots(&self) -> impl Iterator<Item = (usize, Series)> {
        self.slots().filter(|(slot, series)| {
            if *slot < self.recurrence.vectors {
                !self.is_in_ready_vector(*slot)
            } else {
                !self.is_ready(*series)
            }
        })
    }

    /// Slots that the coefficient alone fills, but for those of columns.
    fn ready_slots(&self) -> impl Iterator<Item = (usize, Series)> {
        self.slots().filter(|(slot, series)| self.is_ready(*series) && !self.is_in_column(*slot))
    }

    fn slots(&self) -> impl Iterator<Item = (usize, Series)> {
        self.recurrence.row.iter().enumerate().filter_map(|(slot, series)| Some((slot, (*series)?)))
    }

    fn is_ready(&self, series: Series) -> bool {
        self.recurrence.ready[series.value] && !series.rate
    }

    /// Is a slot part of a vector, and all of this ready?
    fn is_in_ready_vector(&self, slot: usize) -> bool {
        let lanes = self.recurrence.lanes;
        let vector = &self.recurrence.row[slot / lanes * lanes..];
        slot < self.recurrence.vectors
            && vector.iter().take(lanes).flatten().all(|series| self.is_ready(*series))
    }

    /// The lanes that begin at a slot, from the values of order `k`; a column is a vector already.
    fn newest_vector(&self, slot: usize) -> TokenStream {
        if self.is_in_column(slot) {
            let column = self.vector(slot);
            return quote!(#column);
        }
        let t = &self.context.names.scalar;
        let entries =
            self.recurrence.row[slot..][..self.recurrence.lanes].iter().map(|series| match series {
                Some(series) => self.current(*series),
                None => quote!(#t::zero()),
            });
        quote!([#(#entries),*])
    }

    /// Does `next` name the first row, and the last?
    pub(super) fn row_names(&self) -> (bool, bool) {
        let late = self.recurrence.rules.iter().filter(|(v, _)| !self.recurrence.ready[*v]);
        (late.into_iter().any(|(_, rule)| reads::first(rule)), self.late_slots().next().is_some())
    }
}
