//! Deserialises the values of a scene file, each with its position in the text.
//!
//! Each method accepts only the kinds of values it can read; one function refuses all others. That keeps the code that
//! reads a scene small (it is part of the studio's web page).

use serde::de::value::StrDeserializer;
use serde::de::{
    self, DeserializeSeed, Deserializer, EnumAccess, Expected, IntoDeserializer, MapAccess, SeqAccess, Unexpected,
    VariantAccess, Visitor,
};
use std::fmt::{self, Display};
use std::ops::Range;
use std::vec::IntoIter;
use toml::Spanned;
use toml::de::{DeInteger, DeString, DeTable, DeValue};

/// What is wrong, and where, in bytes of the text.
#[derive(Debug)]
pub(crate) struct Misread {
    pub message: String,
    pub span: Option<Range<usize>>,
}

impl Misread {
    /// Sets the position, unless an inner value has set it.
    fn at(mut self, span: Range<usize>) -> Self {
        self.span.get_or_insert(span);
        self
    }
}

impl Display for Misread {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Misread {}

impl de::Error for Misread {
    fn custom<T: Display>(message: T) -> Self {
        Self { message: message.to_string(), span: None }
    }
}

/// A value.
pub(crate) struct Value<'de>(pub Spanned<DeValue<'de>>);

impl<'de> From<Spanned<DeTable<'de>>> for Value<'de> {
    fn from(tree: Spanned<DeTable<'de>>) -> Self {
        let span = tree.span();
        Self(Spanned::new(span, DeValue::Table(tree.into_inner())))
    }
}

/// A whole number: signed, or unsigned if it is too large for `i64`.
enum Whole {
    Signed(i64),
    Large(u64),
}

fn whole(value: &DeInteger<'_>) -> Result<Whole, Misread> {
    let (digits, radix) = (value.as_str(), value.radix());
    let signed = i64::from_str_radix(digits, radix).map(Whole::Signed);
    signed
        .or_else(|_| u64::from_str_radix(digits, radix).map(Whole::Large))
        .map_err(|_| de::Error::custom("integer number overflowed"))
}

fn real(value: &str) -> Result<f64, Misread> {
    let parsed: Option<f64> = value.parse().ok();
    let fits = |number: &f64| number.is_finite() || value.contains("inf") || value.contains("nan");
    parsed.filter(fits).ok_or_else(|| de::Error::custom("floating-point number overflowed"))
}

/// Returns the error for a value that is not what is expected.
fn refused(value: &DeValue<'_>, expected: &dyn Expected) -> Misread {
    let found = match value {
        DeValue::String(text) => Unexpected::Str(text),
        DeValue::Integer(value) => match whole(value) {
            Ok(Whole::Signed(value)) => Unexpected::Signed(value),
            Ok(Whole::Large(value)) => Unexpected::Unsigned(value),
            Err(error) => return error,
        },
        DeValue::Float(value) => match real(value.as_str()) {
            Ok(value) => Unexpected::Float(value),
            Err(error) => return error,
        },
        DeValue::Boolean(value) => Unexpected::Bool(*value),
        DeValue::Datetime(_) => Unexpected::Other("a date"),
        DeValue::Array(_) => Unexpected::Seq,
        DeValue::Table(_) => Unexpected::Map,
    };
    de::Error::invalid_type(found, expected)
}

impl<'de> Value<'de> {
    /// Reads a value. An error without a position gets the position of this value.
    fn read<T>(self, read: impl FnOnce(DeValue<'de>, Range<usize>) -> Result<T, Misread>) -> Result<T, Misread> {
        let span = self.0.span();
        read(self.0.into_inner(), span.clone()).map_err(|error| error.at(span))
    }
}

fn boolean<'de, V: Visitor<'de>>(value: DeValue<'de>, visitor: V) -> Result<V::Value, Misread> {
    match value {
        DeValue::Boolean(value) => visitor.visit_bool(value),
        other => Err(refused(&other, &visitor)),
    }
}

fn integer<'de, V: Visitor<'de>>(value: DeValue<'de>, visitor: V) -> Result<V::Value, Misread> {
    match value {
        DeValue::Integer(value) => match whole(&value)? {
            Whole::Signed(value) => visitor.visit_i64(value),
            Whole::Large(value) => visitor.visit_u64(value),
        },
        other => Err(refused(&other, &visitor)),
    }
}

fn number<'de, V: Visitor<'de>>(value: DeValue<'de>, visitor: V) -> Result<V::Value, Misread> {
    match value {
        DeValue::Float(value) => visitor.visit_f64(real(value.as_str())?),
        other => integer(other, visitor),
    }
}

fn text<'de, V: Visitor<'de>>(value: DeValue<'de>, visitor: V) -> Result<V::Value, Misread> {
    match value {
        DeValue::String(DeString::Borrowed(text)) => visitor.visit_borrowed_str(text),
        DeValue::String(DeString::Owned(text)) => visitor.visit_string(text),
        other => Err(refused(&other, &visitor)),
    }
}

fn list<'de, V: Visitor<'de>>(value: DeValue<'de>, visitor: V) -> Result<V::Value, Misread> {
    match value {
        DeValue::Array(items) => visitor.visit_seq(Items(items.into_iter())),
        other => Err(refused(&other, &visitor)),
    }
}

fn table<'de, V: Visitor<'de>>(value: DeValue<'de>, visitor: V) -> Result<V::Value, Misread> {
    match value {
        DeValue::Table(entries) => visitor.visit_map(Entries { entries: entries.into_iter(), value: None }),
        other => Err(refused(&other, &visitor)),
    }
}

fn nothing<'de, V: Visitor<'de>>(value: DeValue<'de>, visitor: V) -> Result<V::Value, Misread> {
    Err(refused(&value, &visitor))
}

/// Defines methods that read values of one kind.
macro_rules! read_as {
    ($($method:ident)* => $read:ident) => {$(
        fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misread> {
            self.read(|value, _| $read(value, visitor))
        }
    )*};
}

impl<'de> Deserializer<'de> for Value<'de> {
    type Error = Misread;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misread> {
        self.read(|value, _| match &value {
            DeValue::String(_) => text(value, visitor),
            DeValue::Integer(_) | DeValue::Float(_) => number(value, visitor),
            DeValue::Boolean(_) => boolean(value, visitor),
            DeValue::Array(_) => list(value, visitor),
            DeValue::Table(_) => table(value, visitor),
            DeValue::Datetime(_) => nothing(value, visitor),
        })
    }

    read_as!(deserialize_bool => boolean);
    read_as!(deserialize_i8 deserialize_i16 deserialize_i32 deserialize_i64 => integer);
    read_as!(deserialize_u8 deserialize_u16 deserialize_u32 deserialize_u64 => integer);
    read_as!(deserialize_f32 deserialize_f64 => number);
    read_as!(deserialize_char deserialize_str deserialize_string deserialize_identifier => text);
    read_as!(deserialize_seq => list);
    read_as!(deserialize_map => table);
    read_as!(deserialize_unit deserialize_bytes deserialize_byte_buf => nothing);

    fn deserialize_tuple<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Misread> {
        self.read(|value, _| match &value {
            // a visitor ignores surplus entries
            DeValue::Array(items) if items.len() > length => Err(de::Error::invalid_length(items.len(), &visitor)),
            _ => list(value, visitor),
        })
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        length: usize,
        visitor: V,
    ) -> Result<V::Value, Misread> {
        self.deserialize_tuple(length, visitor)
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Misread> {
        self.deserialize_map(visitor)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Misread> {
        self.read(|value, span| match value {
            DeValue::String(name) => visitor.visit_enum(Choice { name: Spanned::new(span, name), value: None }),
            DeValue::Table(entries) => {
                let mut entries = entries.into_iter();
                match (entries.next(), entries.next()) {
                    (Some((name, value)), None) => visitor.visit_enum(Choice { name, value: Some(value) }),
                    (None, _) => Err(de::Error::custom("wanted exactly 1 element, found 0 elements")),
                    _ => Err(de::Error::custom("wanted exactly 1 element, more than 1 element")),
                }
            }
            _ => Err(de::Error::custom("wanted string or table")),
        })
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misread> {
        self.read(|value, span| visitor.visit_some(Self(Spanned::new(span, value))))
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Misread> {
        self.read(|value, span| visitor.visit_newtype_struct(Self(Spanned::new(span, value))))
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Misread> {
        visitor.visit_unit()
    }

    fn deserialize_unit_struct<V: Visitor<'de>>(self, _: &'static str, visitor: V) -> Result<V::Value, Misread> {
        self.deserialize_unit(visitor)
    }
}

struct Items<'de>(IntoIter<Spanned<DeValue<'de>>>);

impl<'de> SeqAccess<'de> for Items<'de> {
    type Error = Misread;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Misread> {
        let Some(item) = self.0.next() else { return Ok(None) };
        let span = item.span();
        seed.deserialize(Value(item)).map(Some).map_err(|error| error.at(span))
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.0.len())
    }
}

struct Entries<'de, I> {
    entries: I,
    value: Option<Spanned<DeValue<'de>>>,
}

impl<'de, I: Iterator<Item = (Spanned<DeString<'de>>, Spanned<DeValue<'de>>)>> MapAccess<'de> for Entries<'de, I> {
    type Error = Misread;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Misread> {
        let Some((key, value)) = self.entries.next() else { return Ok(None) };
        self.value = Some(value);
        let name: StrDeserializer<'_, Misread> = key.get_ref().as_ref().into_deserializer();
        seed.deserialize(name).map(Some).map_err(|error| error.at(key.span()))
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Misread> {
        let value =
            self.value.take().ok_or_else(|| <Misread as de::Error>::custom("a value was asked for before its key"))?;
        let span = value.span();
        seed.deserialize(Value(value)).map_err(|error| error.at(span))
    }
}

/// A choice: its name and its value.
struct Choice<'de> {
    name: Spanned<DeString<'de>>,
    value: Option<Spanned<DeValue<'de>>>,
}

impl<'de> EnumAccess<'de> for Choice<'de> {
    type Error = Misread;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), Misread> {
        let name: StrDeserializer<'_, Misread> = self.name.get_ref().as_ref().into_deserializer();
        match seed.deserialize(name) {
            Ok(chosen) => Ok((chosen, self)),
            Err(error) => Err(error.at(self.name.span())),
        }
    }
}

impl<'de> Choice<'de> {
    fn content(self, expected: &'static str) -> Result<Value<'de>, Misread> {
        let nothing = || de::Error::invalid_type(Unexpected::UnitVariant, &expected);
        self.value.map(Value).ok_or_else(nothing)
    }
}

impl<'de> VariantAccess<'de> for Choice<'de> {
    type Error = Misread;

    fn unit_variant(self) -> Result<(), Misread> {
        let Some(value) = self.value else { return Ok(()) };
        let span = value.span();
        match value.get_ref() {
            DeValue::Table(entries) if entries.is_empty() => Ok(()),
            DeValue::Table(_) => Err(<Misread as de::Error>::custom("expected empty table").at(span)),
            other => {
                Err(<Misread as de::Error>::custom(format_args!("expected table, found {}", other.type_str())).at(span))
            }
        }
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Misread> {
        seed.deserialize(self.content("newtype variant")?)
    }

    fn tuple_variant<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Misread> {
        self.content("tuple variant")?.deserialize_tuple(length, visitor)
    }

    fn struct_variant<V: Visitor<'de>>(self, _: &'static [&'static str], visitor: V) -> Result<V::Value, Misread> {
        self.content("struct variant")?.deserialize_map(visitor)
    }
}
