//! Phase points as they are written and read: `phi` and the momentum of the model's own frame, row by row, then `x` and `p`
//! where there is a centre of mass. Numbers of text formats that are read exactly give the same bits. Points that a run has
//! come to are read whatever they are, also those that no run begins at.

use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};
use serde::ser::{Serialize, SerializeTuple, Serializer};

use super::{Centre, PhasePoint, Pinned};
use crate::frames::{Frame, Matrix, Vector};
use crate::interned::number::Number;
use crate::parts::{Basis, Translation};
use core::fmt;
use core::marker::PhantomData;

/// What is written of a centre of mass.
pub trait Written<const N: usize>: Translation<N, f64> {
    /// There is one.
    const MOVES: bool;
    /// It, from what was read; `None` of points that do not exist.
    fn read(x: Vector<N>, p: Vector<N>) -> Option<Self>;
}

impl<const N: usize> Written<N> for Pinned {
    const MOVES: bool = false;
    fn read(_x: Vector<N>, _p: Vector<N>) -> Option<Self> {
        Some(Self)
    }
}

impl<const N: usize> Written<N> for Centre<N> {
    const MOVES: bool = true;
    fn read(x: Vector<N>, p: Vector<N>) -> Option<Self> {
        Some(Self { x, p })
    }
}

impl<const N: usize, F: Frame, C: Written<N>, B: Basis> PhasePoint<N, F, C, f64, B> {
    /// Numbers of a point.
    const NUMBERS: usize = 2 * N * N + if C::MOVES { 2 * N } else { 0 };
}

impl<const N: usize, F: Frame, C: Written<N>, B: Basis> Serialize for PhasePoint<N, F, C, f64, B> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut numbers = serializer.serialize_tuple(Self::NUMBERS)?;
        for matrix in [&self.phi, &self.spin] {
            (0..N * N).try_for_each(|k| numbers.serialize_element(&Number(&matrix[(k / N, k % N)])))?;
        }
        if C::MOVES {
            let (x, p) = (self.centre.position(), self.centre.momentum());
            x.iter().chain(p.iter()).try_for_each(|number| numbers.serialize_element(&Number(number)))?;
        }
        numbers.end()
    }
}

impl<'de, const N: usize, F: Frame, C: Written<N>, B: Basis> Deserialize<'de>
    for PhasePoint<N, F, C, f64, B>
{
    /// Refuses what has not as many numbers.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_tuple(Self::NUMBERS, Numbers(PhantomData))
    }
}

struct Numbers<P>(PhantomData<P>);

impl<'de, const N: usize, F: Frame, C: Written<N>, B: Basis> Visitor<'de>
    for Numbers<PhasePoint<N, F, C, f64, B>>
{
    type Value = PhasePoint<N, F, C, f64, B>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the {} numbers of a phase point", Self::Value::NUMBERS)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut numbers: A) -> Result<Self::Value, A::Error> {
        let mut read = [0.0; 24];
        let expected = read.get_mut(..Self::Value::NUMBERS).into_iter().flatten();
        for (k, number) in expected.enumerate() {
            let next: Option<Number<f64>> = numbers.next_element()?;
            Number(*number) = next.ok_or_else(|| A::Error::invalid_length(k, &self))?;
        }
        let mut read = read.into_iter();
        let mut next = || read.next().unwrap_or_default();
        let [phi, spin] = [(); 2].map(|()| Matrix::<N>::from_fn(|_, _| next()).transpose());
        let [x, p] = [(); 2].map(|()| Vector::<N>::from_fn(|_, _| next()));
        let centre =
            C::read(x, p).ok_or_else(|| A::Error::custom("there are no phase points of this model"))?;
        Ok(PhasePoint::new(phi, spin, centre))
    }
}
