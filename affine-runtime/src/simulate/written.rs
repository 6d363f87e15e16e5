//! How bases in which the metrics of a model are the identity are written and read: their matrices, column by column.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::frames::Matrix;
use crate::inner::number::Number;
use crate::metrics::Bases;

pub(super) fn serialize<S: Serializer, const N: usize>(
    bases: &Option<Box<Bases<N>>>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let matrices = bases.as_deref().map(|bases| {
        let Bases { space, space_inverse, body, body_inverse } = bases;
        [space, space_inverse, body, body_inverse].map(|matrix| matrix.as_slice().to_vec())
    });
    matrices.as_ref().map(|matrices| matrices.each_ref().map(Number)).serialize(serializer)
}

pub(super) fn deserialize<'de, D: Deserializer<'de>, const N: usize>(
    deserializer: D,
) -> Result<Option<Box<Bases<N>>>, D::Error> {
    let Some(matrices): Option<[Number<Vec<f64>>; 4]> = Option::deserialize(deserializer)? else {
        return Ok(None);
    };
    if matrices.iter().any(|Number(matrix)| matrix.len() != N * N) {
        return Err(D::Error::custom("a matrix of bases has not the numbers of its dimension"));
    }
    let [space, space_inverse, body, body_inverse] =
        matrices.map(|Number(matrix)| Matrix::<N>::from_column_slice(&matrix));
    Ok(Some(Box::new(Bases { space, space_inverse, body, body_inverse })))
}
