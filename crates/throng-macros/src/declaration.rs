//! Declared types: from the struct or enum as written to its implementations.

use crate::limit::{Limit, Number};
use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Attribute, Expr, Field, Fields, Ident, ItemEnum, ItemStruct, Lit, LitStr, Meta, Token, Type};

/// The name in scene files that the attribute of a type gives.
pub struct Name(Option<String>);

impl Parse for Name {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        if input.is_empty() {
            return Ok(Self(None));
        }
        let key: Ident = input.parse()?;
        if key != "name" {
            return Err(syn::Error::new(key.span(), "the only key is `name`: #[parameters(name = \"orca_3d\")]"));
        }
        input.parse::<Token![=]>()?;
        Ok(Self(Some(input.parse::<LitStr>()?.value())))
    }
}

/// A field with what its attribute gives.
struct Declared {
    field: Field,
    default: Option<Expr>,
    is_required: bool,
    unit: Option<String>,
    limit: Limit,
}

impl Declared {
    /// Takes the attribute `#[parameter(..)]` off a field.
    fn of(mut field: Field) -> syn::Result<Self> {
        let (own, kept): (Vec<_>, Vec<_>) =
            field.attrs.into_iter().partition(|attribute| attribute.path().is_ident("parameter"));
        field.attrs = kept;
        let mut declared = Self { field, default: None, is_required: false, unit: None, limit: Limit::default() };
        for attribute in own {
            attribute.parse_nested_meta(|meta| {
                if meta.path.is_ident("required") {
                    declared.is_required = true;
                    return Ok(());
                }
                let value: Expr = meta.value()?.parse()?;
                let number = || Number::of(&value).map(Some);
                match meta.path.require_ident()?.to_string().as_str() {
                    "default" => declared.default = Some(value),
                    "unit" => declared.unit = Some(text(&value)?),
                    "above" => declared.limit.above = number()?,
                    "least" => declared.limit.least = number()?,
                    "most" => declared.limit.most = number()?,
                    _ => return Err(meta.error("a parameter has: required, default, unit, above, least, most")),
                }
                Ok(())
            })?;
        }
        Ok(declared)
    }

    /// Whether its values are numbers that are checked.
    fn is_number(&self) -> bool {
        let is_float = match &self.field.ty {
            Type::Path(found) => found
                .path
                .segments
                .last()
                .is_some_and(|last| ["f32", "f64", "Angle"].iter().any(|name| last.ident == name)),
            _ => false,
        };
        is_float || !self.limit.is_empty()
    }

    /// Returns the default.
    fn default(&self) -> TokenStream {
        match &self.default {
            Some(value) => quote!(#value),
            None => quote!(::core::default::Default::default()),
        }
    }

    /// Returns the function that returns the default, and its name, for a type of which another field is required.
    fn default_function(&self, of: &Ident) -> Option<(TokenStream, String)> {
        let Field { ident, ty, .. } = &self.field;
        let name = format_ident!("default_of_{}", ident.as_ref()?);
        let default = self.default();
        let function = quote!(fn #name() -> #ty { #default });
        (!self.is_required).then(|| (function, format!("{of}::{name}")))
    }

    /// Returns the field with the attributes of the schema, and with its limit in its doc line. `default` is the path of
    /// the function that returns its default.
    fn written(&self, default: Option<&str>) -> TokenStream {
        let Self { field, unit, limit, .. } = self;
        let default = default.filter(|_| cfg!(feature = "schema")).map(|path| quote!(#[serde(default = #path)]));
        let sentence = (!limit.is_empty()).then(|| limit.sentence()).map(|sentence| quote!(#[doc = #sentence]));
        let mut keys = limit.schema();
        keys.extend(unit.as_ref().map(|unit| quote!("unit" = #unit)));
        let about = self.about();
        let extended = (!keys.is_empty()).then(|| quote!(, extend(#(#keys),*)));
        let schema = cfg!(feature = "schema").then(|| quote!(#[schemars(description = #about #extended)]));
        let Field { attrs, vis, ident, ty, .. } = field;
        quote!(#(#attrs)* #sentence #default #schema #vis #ident: #ty)
    }

    /// Returns the doc line, with the limit.
    fn about(&self) -> String {
        first_paragraph(&self.field.attrs) + &self.limit.sentence()
    }

    /// Returns the value of type `throng::parameters::Parameter`.
    fn described(&self) -> TokenStream {
        let name = self.field.ident.as_ref().map(ToString::to_string).unwrap_or_default();
        let about = self.about();
        let unit = self.unit.as_deref().unwrap_or_default();
        let limit = self.limit.value();
        quote!(::throng::parameters::Parameter { name: #name, about: #about, unit: #unit, limit: #limit })
    }
}

/// Returns a struct with the implementations of `Default` and `Parameters`.
pub fn of_struct(Name(name): Name, item: ItemStruct) -> syn::Result<TokenStream> {
    let ItemStruct { attrs, vis, ident, generics, fields, .. } = item;
    let (fields, is_unit) = match fields {
        Fields::Named(fields) => (fields.named, false),
        Fields::Unit => (Punctuated::new(), true),
        Fields::Unnamed(_) => return Err(syn::Error::new_spanned(ident, "parameters are named fields")),
    };
    if !generics.params.is_empty() {
        return Err(syn::Error::new_spanned(generics, "parameters have no generics"));
    }
    let declared = fields.into_iter().map(Declared::of).collect::<syn::Result<Vec<_>>>()?;
    let name = name.unwrap_or_else(|| snake_case(&ident.to_string()));
    let about = first_paragraph(&attrs);
    let is_required = declared.iter().any(|declared| declared.is_required);
    let functions: Vec<_> =
        declared.iter().map(|field| field.default_function(&ident).filter(|_| is_required)).collect();
    let paths = functions.iter().map(|function| function.as_ref().map(|(_, path)| path.as_str()));
    let written = declared.iter().zip(paths).map(|(declared, path)| declared.written(path));
    let described = declared.iter().map(Declared::described);
    let defaults = declared.iter().map(|declared| {
        let (ident, value) = (&declared.field.ident, declared.default());
        quote!(#ident: #value)
    });
    let default = if is_required {
        let functions = functions.iter().flatten().map(|(function, _)| function);
        cfg!(feature = "schema").then(|| quote!(impl #ident { #(#functions)* }))
    } else {
        Some(quote!(impl ::core::default::Default for #ident {
            fn default() -> Self {
                Self { #(#defaults,)* }
            }
        }))
    };
    let checks = declared.iter().enumerate().filter(|(_, declared)| declared.is_number()).map(|(k, declared)| {
        let ident = &declared.field.ident;
        quote!(Self::PARAMETERS[#k].check(&self.#ident)?;)
    });
    let keys = if is_required { quote!(deny_unknown_fields) } else { quote!(default, deny_unknown_fields) };
    let readable = readable(&about, &keys);
    let item = if is_unit {
        let read_as_table = readable.map(|readable| as_empty_table(&ident, &readable));
        quote!(#(#attrs)* #vis struct #ident; #read_as_table)
    } else {
        quote!(#(#attrs)* #readable #vis struct #ident { #(#written,)* })
    };
    Ok(quote! {
        #item

        #default

        impl ::throng::parameters::Parameters for #ident {
            const NAME: &'static str = #name;
            const ABOUT: &'static str = #about;
            const PARAMETERS: &'static [::throng::parameters::Parameter] = &[#(#described,)*];

            fn check_limits(&self) -> ::core::result::Result<(), ::throng::Error> {
                #(#checks)*
                ::core::result::Result::Ok(())
            }
        }
    })
}

/// Returns the implementations for a struct without fields, which files write as an empty table.
fn as_empty_table(ident: &Ident, readable: &TokenStream) -> TokenStream {
    let name = ident.to_string();
    quote! {
        const _: () = {
            use ::std::borrow::Cow;
            use ::throng::parameters::schemars::{JsonSchema, Schema, SchemaGenerator};
            use ::throng::parameters::serde::{Deserialize, Deserializer, Serialize, Serializer};

            #readable
            #[derive(Default)]
            struct Empty {}

            impl Serialize for #ident {
                fn serialize<S: Serializer>(&self, serializer: S) -> ::core::result::Result<S::Ok, S::Error> {
                    Empty {}.serialize(serializer)
                }
            }

            impl<'de> Deserialize<'de> for #ident {
                fn deserialize<D: Deserializer<'de>>(deserializer: D) -> ::core::result::Result<Self, D::Error> {
                    Empty::deserialize(deserializer).map(|_| Self)
                }
            }

            impl JsonSchema for #ident {
                fn schema_name() -> Cow<'static, str> {
                    Cow::Borrowed(#name)
                }

                fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                    Empty::json_schema(generator)
                }
            }
        };
    }
}

/// Returns an enum of names in files.
pub fn of_enum(item: &ItemEnum) -> TokenStream {
    let readable = readable(&first_paragraph(&item.attrs), &quote!(rename_all = "snake_case"));
    quote!(#readable #item)
}

/// Returns the attributes of a type that is read and written and has a schema, if the feature is on.
fn readable(about: &str, keys: &TokenStream) -> Option<TokenStream> {
    cfg!(feature = "schema").then(|| {
        let [serde, schemars] = ["::throng::parameters::serde", "::throng::parameters::schemars"];
        quote! {
            #[derive(
                ::throng::parameters::serde::Serialize,
                ::throng::parameters::serde::Deserialize,
                ::throng::parameters::schemars::JsonSchema,
            )]
            #[serde(crate = #serde, #keys)]
            #[schemars(crate = #schemars, description = #about)]
        }
    })
}

/// Returns the first paragraph of a doc comment in one line.
fn first_paragraph(attributes: &[Attribute]) -> String {
    let lines = attributes.iter().filter(|attribute| attribute.path().is_ident("doc")).filter_map(|attribute| {
        let Meta::NameValue(pair) = &attribute.meta else { return None };
        text(&pair.value).ok()
    });
    let lines: Vec<String> = lines.collect();
    let lines = lines.iter().map(|line| line.trim()).take_while(|line| !line.is_empty());
    lines.collect::<Vec<_>>().join(" ")
}

/// Returns the text of a literal.
fn text(value: &Expr) -> syn::Result<String> {
    match value {
        Expr::Lit(found) => match &found.lit {
            Lit::Str(text) => Ok(text.value()),
            _ => Err(syn::Error::new_spanned(value, "a text in quotes is wanted here")),
        },
        _ => Err(syn::Error::new_spanned(value, "a text in quotes is wanted here")),
    }
}

/// Returns a name in camel case in snake case.
fn snake_case(name: &str) -> String {
    let mut snake = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() && !snake.is_empty() {
            snake.push('_');
        }
        snake.extend(letter.to_lowercase());
    }
    snake
}
