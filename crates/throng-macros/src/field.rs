//! Fields: from their attributes to descriptions and code.

use crate::declaration::local;
use crate::limit::{Limit, Number};
use proc_macro2::TokenStream;
use quote::quote;
use syn::punctuated::Punctuated;
use syn::{Attribute, Expr, Field, Ident, Lit, Meta, Token, Type, Visibility};

/// The keys of the attribute, for messages.
const KEYS: &str = "a parameter has: name, required, default, unit, above, least, most, infinite, from, absent";

/// A field with what its attribute gives.
pub struct Declared {
    attrs: Vec<Attribute>,
    vis: Visibility,
    pub ident: Ident,
    pub ty: Type,
    /// The name in files.
    name: String,
    default: Option<Expr>,
    pub is_required: bool,
    unit: String,
    limit: Limit,
    /// The type that files give, from which the value is made.
    pub from: Option<Type>,
    /// The text that files without this parameter stand for.
    absent: Option<String>,
}

impl Declared {
    /// Takes the attribute `#[parameter(..)]` off a field.
    fn of(mut field: Field) -> syn::Result<Self> {
        let Some(ident) = field.ident.clone() else {
            return Err(syn::Error::new_spanned(field, "parameters are named fields"));
        };
        let name = ident.to_string();
        let mut declared = Self::new(ident, &name, field.ty);
        declared.take(&mut field.attrs)?;
        Ok(Self { attrs: field.attrs, vis: field.vis, ..declared })
    }

    /// Takes the attribute `#[parameter(..)]` off a variant or field without a name.
    pub fn unnamed(attrs: &mut Vec<Attribute>, name: &str, field: &Field) -> syn::Result<Self> {
        let mut declared = Self::new(local("value"), name, field.ty.clone());
        declared.take(attrs)?;
        Ok(Self { attrs: attrs.clone(), is_required: true, ..declared })
    }

    fn new(ident: Ident, name: &str, ty: Type) -> Self {
        Self {
            attrs: vec![],
            vis: Visibility::Inherited,
            ident,
            ty,
            name: name.trim_start_matches("r#").to_owned(),
            default: None,
            is_required: false,
            unit: String::new(),
            limit: Limit::default(),
            from: None,
            absent: None,
        }
    }

    fn take(&mut self, attrs: &mut Vec<Attribute>) -> syn::Result<()> {
        let (own, kept): (Vec<_>, Vec<_>) =
            attrs.drain(..).partition(|attribute| attribute.path().is_ident("parameter"));
        *attrs = kept;
        for attribute in own {
            attribute.parse_nested_meta(|meta| {
                if meta.path.is_ident("required") {
                    self.is_required = true;
                    return Ok(());
                }
                if meta.path.is_ident("infinite") {
                    self.limit.is_infinite = true;
                    return Ok(());
                }
                if meta.path.is_ident("from") {
                    self.from = Some(meta.value()?.parse()?);
                    return Ok(());
                }
                let value: Expr = meta.value()?.parse()?;
                let number = || Number::of(&value).map(Some);
                match meta.path.require_ident()?.to_string().as_str() {
                    "default" => self.default = Some(value),
                    "name" => self.name = text(&value)?,
                    "unit" => self.unit = text(&value)?,
                    "absent" => self.absent = Some(text(&value)?),
                    "above" => self.limit.above = number()?,
                    "least" => self.limit.least = number()?,
                    "most" => self.limit.most = number()?,
                    _ => {
                        return Err(meta.error(KEYS));
                    }
                }
                Ok(())
            })?;
        }
        Ok(())
    }

    /// Returns the default.
    pub fn default(&self) -> TokenStream {
        match &self.default {
            Some(value) => quote!(#value),
            None => quote!(::core::default::Default::default()),
        }
    }

    /// Returns the value of a parameter that files leave out, if that does not depend on the scene.
    pub fn usual(&self) -> TokenStream {
        if self.is_required || self.absent.is_some() {
            return quote!(::core::option::Option::None);
        }
        let default = self.default();
        quote!(::core::option::Option::Some(#default))
    }

    /// Returns the doc line, with the limit.
    fn about(&self) -> String {
        first_paragraph(&self.attrs) + &self.limit.sentence()
    }

    /// Returns the value of type `throng::parameters::Parameter`.
    pub fn described(&self) -> TokenStream {
        let Self { name, ty, unit, is_required, .. } = self;
        let (about, limit) = (self.about(), self.limit.value());
        let in_files = self.from.as_ref().unwrap_or(ty);
        let default = match (&self.absent, &self.from, is_required) {
            (Some(text), ..) => quote!(::core::option::Option::Some(::throng::parameters::Written::Text(#text.into()))),
            (None, None, false) => {
                let default = self.default();
                quote!({
                    let default: #ty = #default;
                    ::throng::parameters::Value::write(&default)
                })
            }
            _ => quote!(::core::option::Option::None),
        };
        quote!(::throng::parameters::Parameter {
            name: #name,
            about: #about,
            unit: #unit,
            limit: #limit,
            kind: <#in_files as ::throng::parameters::Value>::KIND,
            is_required: #is_required,
            default: || #default,
        })
    }

    /// Returns the type that files give, and the expression for the value that is made of `read`, a result.
    pub fn in_files(&self, given: &Ident, read: &TokenStream) -> (&Type, TokenStream) {
        match &self.from {
            None => (&self.ty, quote!(#read?)),
            Some(from) => {
                let Self { ty, .. } = self;
                let made = quote!(<#ty as ::core::convert::TryFrom<#from>>::try_from(#read?)
                    .map_err(|error| #given.refused(error.into()))?);
                (from, made)
            }
        }
    }

    /// Returns the value of type `throng::parameters::Parameter` for a table.
    pub fn table(name: &str, about: &str, described: &TokenStream) -> TokenStream {
        let limit = Limit::default().value();
        quote!(::throng::parameters::Parameter {
            name: #name,
            about: #about,
            unit: "",
            limit: #limit,
            kind: ::throng::parameters::Kind::Table(|| #described),
            is_required: true,
            default: || ::core::option::Option::None,
        })
    }
}

/// The fields of a struct or of a variant.
pub struct Fields(pub Vec<Declared>);

impl Fields {
    pub const fn none() -> Self {
        Self(Vec::new())
    }

    pub fn of(fields: Punctuated<Field, Token![,]>) -> syn::Result<Self> {
        fields.into_iter().map(Declared::of).collect::<syn::Result<_>>().map(Self)
    }

    /// Returns the fields as written, each with its limit in its doc comment.
    pub fn written(&self) -> TokenStream {
        let written = self.0.iter().map(|Declared { attrs, vis, ident, ty, limit, .. }| {
            let sentence = (!limit.is_empty()).then(|| limit.sentence()).map(|sentence| quote!(#[doc = #sentence]));
            quote!(#(#attrs)* #sentence #vis #ident: #ty)
        });
        quote!(#(#written,)*)
    }

    /// Returns the slice of descriptions.
    pub fn parameters(&self) -> TokenStream {
        let described = self.0.iter().map(Declared::described);
        quote!(&[#(#described),*])
    }

    /// Returns the fields of a value that is read. For each field, a variable of its name has its usual value.
    pub fn read(&self, parameters: &TokenStream) -> TokenStream {
        self.read_from(&local("given"), parameters)
    }

    /// As [`read`](Self::read), from the variable `given`.
    pub fn read_from(&self, given: &Ident, parameters: &TokenStream) -> TokenStream {
        let read = self.0.iter().enumerate().map(|(k, Declared { ident, name, from, absent, .. })| {
            let read = match from {
                Some(from) => quote!(#given.made_from::<#from, _>(&#parameters[#k], #ident)?),
                None => quote!(#given.parameter(&#parameters[#k], #ident)?),
            };
            match absent {
                Some(text) => quote!(#ident: match (#given.get(#name), #ident) {
                    (::core::option::Option::None, ::core::option::Option::None) => ::throng::parameters::Value::read(
                        &#given.absent(#name, #text),
                        ::core::option::Option::None,
                    )?,
                    (_, #ident) => #read,
                }),
                None => quote!(#ident: #read),
            }
        });
        quote!(#(#read,)*)
    }

    /// Returns the expression for the table that files write. `places` are references to the values.
    pub fn write(&self, places: impl Iterator<Item = TokenStream>) -> TokenStream {
        let writes = self.0.iter().zip(places).map(|(Declared { name, from, is_required, .. }, place)| {
            let written = match from {
                Some(_) => quote!({
                    let _ = #place;
                    ::core::option::Option::None::<::throng::parameters::Written>
                }),
                None => quote!(::throng::parameters::Value::write(#place)),
            };
            match is_required {
                true => quote!(table.push((#name.into(), #written?));),
                false => quote!(table.extend(#written.map(|written| (#name.into(), written)));),
            }
        });
        quote!((|| {
            #[allow(unused_mut)]
            let mut table = ::std::vec::Vec::new();
            #(#writes)*
            ::core::option::Option::Some(::throng::parameters::Written::Table(table))
        })())
    }

    /// Returns the statements that check the limits. `places` are references to the values.
    pub fn check(&self, parameters: &TokenStream, places: impl Iterator<Item = TokenStream>) -> TokenStream {
        let checks = self.0.iter().zip(places).enumerate().map(|(k, (field, place))| match field.from {
            Some(_) => quote!(let _ = #place;),
            None => quote!(#parameters[#k].check(#place)?;),
        });
        quote!(#(#checks)*)
    }
}

/// Returns the first paragraph of a doc comment in one line.
pub fn first_paragraph(attributes: &[Attribute]) -> String {
    let lines = attributes.iter().filter(|attribute| attribute.path().is_ident("doc")).filter_map(|attribute| {
        let Meta::NameValue(pair) = &attribute.meta else { return None };
        text(&pair.value).ok()
    });
    let lines: Vec<String> = lines.collect();
    let lines = lines.iter().map(|line| line.trim()).take_while(|line| !line.is_empty());
    lines.collect::<Vec<_>>().join(" ")
}

/// Returns the text of a literal.
pub fn text(value: &Expr) -> syn::Result<String> {
    match value {
        Expr::Lit(found) => match &found.lit {
            Lit::Str(text) => Ok(text.value()),
            _ => Err(syn::Error::new_spanned(value, "a text in quotes is wanted here")),
        },
        _ => Err(syn::Error::new_spanned(value, "a text in quotes is wanted here")),
    }
}
