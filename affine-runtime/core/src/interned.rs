//! What a program has as constants and reads from a file: texts, lists, descriptions. Each is kept once until the program ends, so that
//! what is read has the type of what is written.

#[cfg(feature = "serde")]
pub use reading::{constant, number, word};
#[cfg(feature = "serde")]
pub(crate) use reading::{list, optional_word, words};

#[cfg(feature = "serde")]
mod reading {
    use core::any::Any;
    use core::fmt::{self, Display};
    use std::sync::{Mutex, PoisonError};

    use serde::de::{DeserializeOwned, Error, Visitor};
    use serde::{Deserialize, Deserializer};

    static KEPT: Mutex<Vec<Box<dyn Any + Send>>> = Mutex::new(Vec::new());

    /// The constant that equals a value: one that is known, or the value from now on.
    fn kept<T: ?Sized + PartialEq + Sync + 'static>(value: Box<T>) -> &'static T {
        let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
        let mut known = kept.iter().filter_map(|known| known.downcast_ref::<&'static T>().copied());
        if let Some(known) = known.find(|known| **known == *value) {
            return known;
        }
        let value: &'static T = Box::leak(value);
        kept.push(Box::new(value));
        value
    }

    /// Reads a text.
    ///
    /// # Errors
    /// Those of the deserializer.
    pub fn word<'de, D: Deserializer<'de>>(deserializer: D) -> Result<&'static str, D::Error> {
        String::deserialize(deserializer).map(|text| kept(text.into_boxed_str()))
    }

    /// Reads a text that may be missing.
    ///
    /// # Errors
    /// Those of the deserializer.
    pub(crate) fn optional_word<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<&'static str>, D::Error> {
        let text: Option<String> = Option::deserialize(deserializer)?;
        Ok(text.map(|text| kept(text.into_boxed_str())))
    }

    /// Reads a list of texts.
    ///
    /// # Errors
    /// Those of the deserializer.
    pub(crate) fn words<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<&'static [&'static str], D::Error> {
        let texts: Vec<String> = Vec::deserialize(deserializer)?;
        let words: Vec<&'static str> = texts.into_iter().map(|text| kept(text.into_boxed_str())).collect();
        Ok(kept(words.into_boxed_slice()))
    }

    /// Reads a list.
    ///
    /// # Errors
    /// Those of the deserializer.
    pub(crate) fn list<'de, D: Deserializer<'de>, T: DeserializeOwned + PartialEq + Sync + 'static>(
        deserializer: D,
    ) -> Result<&'static [T], D::Error> {
        Vec::deserialize(deserializer).map(|list| kept(list.into_boxed_slice()))
    }

    /// Reads a value.
    ///
    /// # Errors
    /// Those of the deserializer.
    pub fn constant<'de, D: Deserializer<'de>, T: DeserializeOwned + PartialEq + Sync + 'static>(
        deserializer: D,
    ) -> Result<&'static T, D::Error> {
        T::deserialize(deserializer).map(|value| kept(Box::new(value)))
    }

    /// Numbers that may not be finite, for which text formats have no number of their own: `"NaN"`, `"inf"`, `"-inf"`.
    pub mod number {
        use super::{Deserializer, Display, Error, Visitor, fmt};
        use serde::Serializer;

        /// Writes a number.
        ///
        /// # Errors
        /// Those of the serializer.
        pub fn serialize<S: Serializer>(number: &f64, serializer: S) -> Result<S::Ok, S::Error> {
            match number.is_finite() || !serializer.is_human_readable() {
                true => serializer.serialize_f64(*number),
                false => serializer.collect_str(number as &dyn Display),
            }
        }

        /// Reads a number.
        ///
        /// # Errors
        /// Those of the deserializer; where what stands there is no number.
        pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
            match deserializer.is_human_readable() {
                true => deserializer.deserialize_any(Number),
                false => deserializer.deserialize_f64(Number),
            }
        }

        struct Number;

        impl Visitor<'_> for Number {
            type Value = f64;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number, \"NaN\", \"inf\" or \"-inf\"")
            }
            fn visit_f64<E: Error>(self, number: f64) -> Result<f64, E> {
                Ok(number)
            }
            fn visit_i64<E: Error>(self, number: i64) -> Result<f64, E> {
                Ok(number as f64)
            }
            fn visit_u64<E: Error>(self, number: u64) -> Result<f64, E> {
                Ok(number as f64)
            }
            fn visit_str<E: Error>(self, text: &str) -> Result<f64, E> {
                text.parse().map_err(E::custom)
            }
        }
    }
}
