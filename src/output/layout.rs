//! The layout of a type that is kept in a file which does not describe itself: names and types of all that it holds, as a hash.
//!
//! A checkpoint is numbers one after the other. What they are is known from the types of the program that reads them, and where a
//! field has changed and nobody has counted up the format's version, they would be taken for something else. So each file says
//! with what layout it was written. The layout is asked of `Deserialize` itself: a deserializer that has no data answers whatever
//! is asked for with something of that type, and notes the question. Thus it is made of all types that are there, and changes with
//! no more than them: neither with the compiler, the platform, nor code that does other things. What a field *means* it does not
//! know; that is what the version is for.

use std::collections::BTreeMap;
use std::fmt::{self, Display, Write};

use serde::de::value::U32Deserializer;
use serde::de::{
    self, DeserializeOwned, DeserializeSeed, Deserializer, EnumAccess, IntoDeserializer, MapAccess,
    SeqAccess, VariantAccess, Visitor,
};
use sha2::{Digest, Sha256};

/// Times that the questions are asked: each time enums answer with their next variant.
const MOST_PASSES: usize = 32;

/// A type within a type within a type: deeper than that it would hold itself.
const DEEPEST: usize = 64;

/// SHA-256 of the [`description`].
#[must_use]
pub fn layout<T: DeserializeOwned>() -> [u8; 32] {
    Sha256::digest(description::<T>()).into()
}

/// All names and types in the order in which they are asked for.
#[must_use]
pub fn description<T: DeserializeOwned>() -> String {
    let mut asked = Asked::default();
    for _ in 0..MOST_PASSES {
        if let Err(Refused(reason)) = T::deserialize(&mut asked) {
            // A type that does not take what is made up: what comes after it is not known.
            asked.note(&format!("refused: {reason}"));
        }
        asked.text.push('\n');
        if asked.variants.values().all(|(next, variants)| next >= variants) {
            break;
        }
    }
    asked.text
}

/// What has been asked for.
#[derive(Default)]
struct Asked {
    text: String,
    depth: usize,
    /// By name and variants of an enum: the one to answer with next, and how many there are.
    variants: BTreeMap<String, (usize, usize)>,
}

impl Asked {
    fn note(&mut self, what: &str) {
        self.text.push_str(what);
        self.text.push(' ');
    }

    /// Notes a kind with what is in it.
    fn within<R>(
        &mut self,
        what: &str,
        ask: impl FnOnce(&mut Self) -> Result<R, Refused>,
    ) -> Result<R, Refused> {
        self.open(what)?;
        let result = ask(self);
        self.close();
        result
    }

    // The halves of `within` that are compiled once, and not for each type that is asked for.
    fn open(&mut self, what: &str) -> Result<(), Refused> {
        if self.depth == DEEPEST {
            return Err(Refused("it holds itself".to_owned()));
        }
        let _ = write!(self.text, "{what}( ");
        self.depth += 1;
        Ok(())
    }

    fn close(&mut self) {
        self.depth -= 1;
        self.note(")");
    }
}

/// Why a type does not take what is made up.
#[derive(Debug)]
struct Refused(String);

impl Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Refused {}

impl de::Error for Refused {
    fn custom<M: Display>(message: M) -> Self {
        Self(message.to_string())
    }
}

/// Answers for types that are one value.
macro_rules! plain {
    ($($method:ident $visit:ident $name:literal $value:expr;)*) => {
        $(fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
            self.note($name);
            visitor.$visit($value)
        })*
    };
}

/// What cannot be asked for in a format that does not describe itself.
macro_rules! unanswered {
    ($($method:ident)*) => {
        $(fn $method<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Refused> {
            Err(Refused(concat!(stringify!($method), " needs data that describe themselves").to_owned()))
        })*
    };
}

impl<'de> Deserializer<'de> for &mut Asked {
    type Error = Refused;

    plain! {
        deserialize_bool visit_bool "bool" false;
        deserialize_i8 visit_i8 "i8" 0;
        deserialize_i16 visit_i16 "i16" 0;
        deserialize_i32 visit_i32 "i32" 0;
        deserialize_i64 visit_i64 "i64" 0;
        deserialize_i128 visit_i128 "i128" 0;
        deserialize_u8 visit_u8 "u8" 0;
        deserialize_u16 visit_u16 "u16" 0;
        deserialize_u32 visit_u32 "u32" 0;
        deserialize_u64 visit_u64 "u64" 0;
        deserialize_u128 visit_u128 "u128" 0;
        deserialize_f32 visit_f32 "f32" 0.0;
        deserialize_f64 visit_f64 "f64" 0.0;
        deserialize_char visit_char "char" 'a';
        deserialize_str visit_str "str" "";
        deserialize_string visit_str "string" "";
        deserialize_bytes visit_bytes "bytes" &[];
        deserialize_byte_buf visit_bytes "bytes" &[];
    }

    unanswered! { deserialize_any deserialize_identifier deserialize_ignored_any }

    fn is_human_readable(&self) -> bool {
        false
    }

    fn deserialize_unit<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
        self.note("unit");
        visitor.visit_unit()
    }

    fn deserialize_unit_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Refused> {
        self.note(name);
        visitor.visit_unit()
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
        self.within("option", |asked| visitor.visit_some(asked))
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Refused> {
        self.within(name, |asked| visitor.visit_newtype_struct(asked))
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
        self.within("seq", |asked| visitor.visit_seq(Parts::unnamed(asked, 1)))
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, len: usize, visitor: V) -> Result<V::Value, Refused> {
        self.within("tuple", |asked| visitor.visit_seq(Parts::unnamed(asked, len)))
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        len: usize,
        visitor: V,
    ) -> Result<V::Value, Refused> {
        self.within(name, |asked| visitor.visit_seq(Parts::unnamed(asked, len)))
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Refused> {
        self.within("map", |asked| visitor.visit_map(Parts::unnamed(asked, 1)))
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Refused> {
        self.within(name, |asked| visitor.visit_seq(Parts { asked, names: fields, left: fields.len() }))
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Refused> {
        let all = format!("{name}[{}]", variants.join("|"));
        let (next, _) = self.variants.entry(all.clone()).or_insert((0, variants.len()));
        let variant = *next % variants.len().max(1);
        *next += 1;
        self.within(&all, |asked| visitor.visit_enum(Variant { asked, number: variant as u32 }))
    }
}

/// The parts of a type, one after the other.
struct Parts<'a> {
    asked: &'a mut Asked,
    names: &'static [&'static str],
    left: usize,
}

impl<'a> Parts<'a> {
    fn unnamed(asked: &'a mut Asked, left: usize) -> Self {
        Self { asked, names: &[], left }
    }

    /// Notes the next part's name; whether there is one.
    fn begins_next(&mut self) -> bool {
        let Some(left) = self.left.checked_sub(1) else { return false };
        if let Some(name) = self.names.len().checked_sub(self.left).and_then(|k| self.names.get(k)) {
            let _ = write!(self.asked.text, "{name}:");
        }
        self.left = left;
        true
    }
}

impl<'de> SeqAccess<'de> for Parts<'_> {
    type Error = Refused;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Refused> {
        if !self.begins_next() {
            return Ok(None);
        }
        seed.deserialize(&mut *self.asked).map(Some)
    }
}

impl<'de> MapAccess<'de> for Parts<'_> {
    type Error = Refused;

    fn next_key_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Refused> {
        self.next_element_seed(seed)
    }

    fn next_value_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<T::Value, Refused> {
        seed.deserialize(&mut *self.asked)
    }
}

/// One variant of an enum.
struct Variant<'a> {
    asked: &'a mut Asked,
    number: u32,
}

impl<'de> EnumAccess<'de> for Variant<'_> {
    type Error = Refused;
    type Variant = Self;

    fn variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<(T::Value, Self), Refused> {
        let _ = write!(self.asked.text, "{}:", self.number);
        let number: U32Deserializer<Refused> = self.number.into_deserializer();
        Ok((seed.deserialize(number)?, self))
    }
}

impl<'de> VariantAccess<'de> for Variant<'_> {
    type Error = Refused;

    fn unit_variant(self) -> Result<(), Refused> {
        Ok(())
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Refused> {
        seed.deserialize(self.asked)
    }

    fn tuple_variant<V: Visitor<'de>>(self, len: usize, visitor: V) -> Result<V::Value, Refused> {
        visitor.visit_seq(Parts::unnamed(self.asked, len))
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Refused> {
        visitor.visit_seq(Parts { asked: self.asked, names: fields, left: fields.len() })
    }
}

#[cfg(test)]
#[allow(dead_code)]
mod tests;
