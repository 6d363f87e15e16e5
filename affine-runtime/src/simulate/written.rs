//! What runs and tables consist of besides phase points, as it is written and read.

use serde::{Deserialize, Deserializer, Serialize};

use crate::inner::{number, word};

/// A text that is a constant of the program.
#[derive(Deserialize)]
#[serde(transparent)]
struct Text(#[serde(deserialize_with = "word")] super::event::Word);

/// Reads a text, where there is one.
pub(super) fn text<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<&'static str>, D::Error> {
    Option::deserialize(deserializer).map(|text: Option<Text>| text.map(|Text(text)| text))
}

/// Reads a number beside a text, where they are.
pub(super) fn named<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<(&'static str, f64)>, D::Error> {
    Option::deserialize(deserializer)
        .map(|named: Option<(Text, f64)>| named.map(|(Text(text), number)| (text, number)))
}

/// A number that may not be finite.
#[derive(Serialize, Deserialize)]
#[serde(transparent)]
struct Number(#[serde(with = "number")] f64);

/// Columns of numbers.
pub(super) mod columns {
    use super::{Deserialize, Deserializer, Number};
    use serde::Serializer;

    pub(in super::super) fn serialize<S: Serializer>(
        columns: &[Vec<f64>],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        let numbers = |column: &Vec<f64>| column.iter().copied().map(Number).collect::<Vec<_>>();
        serializer.collect_seq(columns.iter().map(numbers))
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Vec<Vec<f64>>, D::Error> {
        let columns: Vec<Vec<Number>> = Vec::deserialize(deserializer)?;
        let numbers = |column: Vec<Number>| column.into_iter().map(|Number(number)| number).collect();
        Ok(columns.into_iter().map(numbers).collect())
    }
}

/// Bases in which the metrics of a model are the identity: their matrices, column by column.
pub(super) mod bases {
    use super::{Deserialize, Deserializer, Serialize};
    use crate::frames::Matrix;
    use crate::metrics::Bases;
    use serde::Serializer;
    use serde::de::Error;

    pub(in super::super) fn serialize<S: Serializer, const N: usize>(
        bases: &Option<Box<Bases<N>>>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        let matrices = bases.as_deref().map(|bases| {
            let Bases { space, space_inverse, body, body_inverse } = bases;
            [space, space_inverse, body, body_inverse].map(|matrix| matrix.as_slice().to_vec())
        });
        matrices.serialize(serializer)
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>, const N: usize>(
        deserializer: D,
    ) -> Result<Option<Box<Bases<N>>>, D::Error> {
        let Some(matrices): Option<[Vec<f64>; 4]> = Option::deserialize(deserializer)? else {
            return Ok(None);
        };
        if matrices.iter().any(|matrix| matrix.len() != N * N) {
            return Err(D::Error::custom("a matrix of bases has not the numbers of its dimension"));
        }
        let [space, space_inverse, body, body_inverse] =
            matrices.map(|matrix| Matrix::<N>::from_column_slice(&matrix));
        Ok(Some(Box::new(Bases { space, space_inverse, body, body_inverse })))
    }
}
