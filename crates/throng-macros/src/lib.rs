//! The attribute `#[parameters]`: it declares each parameter of a model, a behaviour or a field once, with its unit, its
//! limit, its default and its doc line. Scene files, options, sliders, the JSON schema, checks and reference pages read
//! that declaration. The crate `throng` documents it as `throng::parameters`.

mod declaration;
mod field;
mod limit;

use proc_macro::TokenStream;
use syn::{Item, parse_macro_input};

/// Declares the parameters of a type, or the names of a choice.
///
/// Implements `throng::parameters::Value`, and for a struct `throng::parameters::Parameters`. Each field is a parameter. Its
/// doc comment is its doc line. Its attribute `#[parameter(..)]` has some of these keys:
///
/// | key | meaning |
/// |---|---|
/// | `name = "of"` | the key in files. Without it, the name of the field |
/// | `default = 1.0` | the default. Without it, that of the field's type |
/// | `required` | there is no default: files must give a value |
/// | `unit = "s"` | the unit |
/// | `above = 0` | the limit: greater than this |
/// | `least = 0`, `most = 10` | the limit: at least, and at most this |
/// | `infinite` | values in code may be infinite |
/// | `from = SpacePlace` | files give a value of this type, from which the field is made (`TryFrom`) |
/// | `absent = "everything"` | files that leave the parameter out stand for this text |
///
/// A struct without required parameters has `Default`, other structs have a constructor `new` that takes the required
/// parameters. A struct with one field without a name is written as its field. The name in scene files is that of the
/// type in snake case, or `name` of `#[parameters(name = "orca_3d")]`. With `#[parameters(list = parts)]`, files can write
/// the field `parts` alone instead of a table. With `#[parameters(check = Self::check)]`, this function checks each value
/// that is read: the error is at its place in the file.
///
/// On an enum without fields: its variants are names that a parameter can have, in snake case. On another enum: each
/// variant is a table of its fields, or its one field, under its name.
///
/// ```ignore
/// /// Stops in front of walls.
/// #[parameters]
/// #[derive(Clone, Copy, Debug, PartialEq)]
/// pub struct Brake {
///     /// The distance at which it begins to brake, metres.
///     #[parameter(default = 2.0, unit = "m", above = 0)]
///     pub distance: f32,
/// }
/// ```
#[proc_macro_attribute]
pub fn parameters(attribute: TokenStream, item: TokenStream) -> TokenStream {
    let given = parse_macro_input!(attribute as declaration::Given);
    let declared = match parse_macro_input!(item as Item) {
        Item::Struct(item) => declaration::of_struct(&given, item),
        Item::Enum(item) => declaration::of_enum(item),
        other => Err(syn::Error::new_spanned(other, "parameters are the fields of a struct, or the names of an enum")),
    };
    declared.unwrap_or_else(|error| error.to_compile_error()).into()
}
