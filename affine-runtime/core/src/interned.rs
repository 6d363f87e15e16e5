//! What a program has as constants and reads from a file: texts, lists, descriptions. Each is kept once until the program ends, so that
//! what is read has the type of what is written.

#[cfg(feature = "serde")]
pub use reading::{constant, number, optional_word, word};
#[cfg(feature = "serde")]
pub(crate) use reading::{list, words};

#[cfg(feature = "serde")]
mod reading {
    use core::any::Any;
    use core::fmt;
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
    pub fn optional_word<'de, D: Deserializer<'de>>(
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

    /// Numbers that may not be finite, for which text formats have no number of their own: `"NaN"`, `"inf"`, `"-inf"`, and a NaN of
    /// other bits than [`f64::NAN`] with its bits, `"NaN(0xfff8000000000000)"`. Lists of them likewise, and pairs with something else.
    pub mod number {
        use super::{Deserializer, Error, Visitor, fmt, word};
        use crate::quantity::Word;
        use serde::{Deserialize, Serialize, Serializer};

        /// What is written as its numbers are.
        pub trait Write {
            /// Writes a value, each number in it likewise.
            ///
            /// # Errors
            /// Those of the serializer.
            fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error>;
        }

        /// What is read as its numbers are.
        pub trait Read<'de>: Sized {
            /// Reads it.
            ///
            /// # Errors
            /// Those of the deserializer; where what stands there is no number.
            fn read<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error>;
        }

        /// A number, or some, in what is written and read.
        pub struct Number<T>(pub T);

        impl<T: Write> Serialize for Number<&T> {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                self.0.write(serializer)
            }
        }

        impl<'de, T: Read<'de>> Deserialize<'de> for Number<T> {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                T::read(deserializer).map(Self)
            }
        }

        /// Writes a number, or some.
        ///
        /// # Errors
        /// Those of the serializer.
        pub fn serialize<T: Write, S: Serializer>(numbers: &T, serializer: S) -> Result<S::Ok, S::Error> {
            numbers.write(serializer)
        }

        /// Reads a number, or some.
        ///
        /// # Errors
        /// Those of the deserializer; where what stands there is no number.
        pub fn deserialize<'de, T: Read<'de>, D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
            T::read(deserializer)
        }

        impl Write for f64 {
            fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let bits = self.to_bits();
                if self.is_finite() || !serializer.is_human_readable() {
                    serializer.serialize_f64(*self)
                } else if self.is_nan() && bits != Self::NAN.to_bits() {
                    serializer.collect_str(&format_args!("NaN({bits:#x})"))
                } else {
                    serializer.collect_str(&format_args!("{self}"))
                }
            }
        }

        impl<'de> Read<'de> for f64 {
            fn read<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                match deserializer.is_human_readable() {
                    true => deserializer.deserialize_any(OneNumber),
                    false => deserializer.deserialize_f64(OneNumber),
                }
            }
        }

        impl<T: Write> Write for Option<T> {
            fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                self.as_ref().map(Number).serialize(serializer)
            }
        }

        impl<'de, T: Read<'de>> Read<'de> for Option<T> {
            fn read<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                Option::deserialize(deserializer)
                    .map(|number: Option<Number<T>>| number.map(|Number(own)| own))
            }
        }

        impl<T: Write> Write for Vec<T> {
            fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.collect_seq(self.iter().map(Number))
            }
        }

        impl<'de, T: Read<'de>> Read<'de> for Vec<T> {
            fn read<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let numbers: Vec<Number<T>> = Vec::deserialize(deserializer)?;
                Ok(numbers.into_iter().map(|Number(own)| own).collect())
            }
        }

        /// A time with what is there.
        impl<P: Serialize> Write for (f64, P) {
            fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                (Number(&self.0), &self.1).serialize(serializer)
            }
        }

        impl<'de, P: Deserialize<'de>> Read<'de> for (f64, P) {
            fn read<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                Deserialize::deserialize(deserializer).map(|(Number(t), there)| (t, there))
            }
        }

        /// A text with its number.
        impl Write for (Word, f64) {
            fn write<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                (self.0, Number(&self.1)).serialize(serializer)
            }
        }

        impl<'de> Read<'de> for (Word, f64) {
            fn read<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                #[derive(Deserialize)]
                struct Text(#[serde(deserialize_with = "word")] Word);
                Deserialize::deserialize(deserializer).map(|(Text(text), Number(number))| (text, number))
            }
        }

        struct OneNumber;

        impl Visitor<'_> for OneNumber {
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
                match text.strip_prefix("NaN(0x").and_then(|bits| bits.strip_suffix(')')) {
                    Some(bits) => u64::from_str_radix(bits, 16).map(f64::from_bits).map_err(E::custom),
                    None => text.parse().map_err(E::custom),
                }
            }
        }
    }
}
