//! Declared types: from the struct or enum as written to its implementations.

use crate::field::{Declared, Fields, first_paragraph, text};
use proc_macro2::{Span, TokenStream};
use quote::quote;
use syn::parse::{Parse, ParseStream};
use syn::{Expr, Ident, ItemEnum, ItemStruct, Token};

/// What the attribute of a type gives.
#[derive(Default)]
pub struct Given {
    /// The name in scene files.
    name: Option<String>,
    /// The field that files can write as a list instead of a table.
    list: Option<Ident>,
    /// The function that checks a value that has been read.
    check: Option<Expr>,
}

impl Parse for Given {
    fn parse(input: ParseStream) -> syn::Result<Self> {
        let mut given = Self::default();
        while !input.is_empty() {
            let key: Ident = input.parse()?;
            input.parse::<Token![=]>()?;
            match key.to_string().as_str() {
                "name" => given.name = Some(text(&input.parse::<Expr>()?)?),
                "list" => given.list = Some(input.parse()?),
                "check" => given.check = Some(input.parse()?),
                _ => return Err(syn::Error::new(key.span(), "the keys are `name`, `list` and `check`")),
            }
            if !input.is_empty() {
                input.parse::<Token![,]>()?;
            }
        }
        Ok(given)
    }
}

/// Returns a struct with its implementations.
pub fn of_struct(Given { name, list, check }: &Given, item: ItemStruct) -> syn::Result<TokenStream> {
    let ItemStruct { attrs, vis, ident, generics, fields, .. } = item;
    if !generics.params.is_empty() {
        return Err(syn::Error::new_spanned(generics, "parameters have no generics"));
    }
    let name = name.clone().unwrap_or_else(|| snake_case(&ident.to_string()));
    let about = first_paragraph(&attrs);
    let (item, parameters, value) = match fields {
        syn::Fields::Unnamed(mut fields) if fields.unnamed.len() == 1 => {
            let mut attributes = std::mem::take(&mut fields.unnamed[0].attrs);
            let declared = Declared::unnamed(&mut attributes, "", &fields.unnamed[0])?;
            let field = &fields.unnamed[0];
            let item = quote!(#(#attrs)* #vis struct #ident(#(#attributes)* #field););
            (item, quote!(&[]), transparent(&ident, &declared))
        }
        syn::Fields::Unnamed(_) => {
            return Err(syn::Error::new_spanned(ident, "parameters are named fields, or one field without a name"));
        }
        syn::Fields::Unit => {
            let fields = Fields::none();
            let (default, value) = (constructor(&ident, &fields), table(&ident, &about, &fields, None, check.as_ref()));
            (quote!(#(#attrs)* #vis struct #ident; #default), quote!(&[]), value)
        }
        syn::Fields::Named(named) => {
            let fields = Fields::of(named.named)?;
            let (written, default) = (fields.written(), constructor(&ident, &fields));
            let value = table(&ident, &about, &fields, list.as_ref(), check.as_ref());
            let item = quote!(#(#attrs)* #vis struct #ident { #written } #default);
            (item, fields.parameters(), value)
        }
    };
    Ok(quote! {
        #item

        #value

        impl ::throng::parameters::Parameters for #ident {
            const NAME: &'static str = #name;
            const ABOUT: &'static str = #about;
            const PARAMETERS: &'static [::throng::parameters::Parameter] = #parameters;
        }
    })
}

/// Returns the implementation of `Default`, or, if files must give some parameters, the constructor that takes them.
fn constructor(ident: &Ident, fields: &Fields) -> TokenStream {
    let values = fields.0.iter().map(|field| {
        let (name, default) = (&field.ident, field.default());
        if field.is_required { quote!(#name: #name.into()) } else { quote!(#name: #default) }
    });
    let values = quote!(Self { #(#values,)* });
    let required: Vec<&Declared> = fields.0.iter().filter(|field| field.is_required).collect();
    if required.is_empty() {
        return quote!(impl ::core::default::Default for #ident {
            fn default() -> Self {
                #values
            }
        });
    }
    let taken = required.iter().map(|field| {
        let (name, ty) = (&field.ident, &field.ty);
        quote!(#name: impl ::core::convert::Into<#ty>)
    });
    quote!(impl #ident {
        /// Returns the value with these parameters. The other parameters have their defaults.
        pub fn new(#(#taken),*) -> Self {
            #values
        }
    })
}

/// Returns the implementation of `Value` for a struct with one field without a name: files write the field.
fn transparent(ident: &Ident, field: &Declared) -> TokenStream {
    let given = local("given");
    let read = quote!(::throng::parameters::Value::read(#given, ::core::option::Option::None));
    let (in_files, made) = field.in_files(&given, &read);
    let (write, check) = match field.from {
        Some(_) => (quote!(::core::option::Option::None), quote!(::core::result::Result::Ok(()))),
        None => (
            quote!(::throng::parameters::Value::write(&self.0)),
            quote!(::throng::parameters::Value::check_limits(&self.0)),
        ),
    };
    quote! {
        impl ::throng::parameters::Value for #ident {
            const KIND: ::throng::parameters::Kind = <#in_files as ::throng::parameters::Value>::KIND;

            fn read<G: ::throng::parameters::Given>(
                #given: &G,
                _: ::core::option::Option<Self>,
            ) -> ::core::result::Result<Self, G::Error> {
                ::core::result::Result::Ok(Self(#made))
            }

            fn write(&self) -> ::core::option::Option<::throng::parameters::Written> {
                #write
            }

            fn check_limits(&self) -> ::core::result::Result<(), ::throng::Error> {
                #check
            }
        }
    }
}

/// Returns the implementation of `Value` for a struct: files write a table, or the field `list` alone.
fn table(ident: &Ident, about: &str, fields: &Fields, list: Option<&Ident>, check: Option<&Expr>) -> TokenStream {
    let (given, usual) = (local("given"), local("usual"));
    let names: Vec<&Ident> = fields.0.iter().map(|field| &field.ident).collect();
    let title = ident.to_string();
    let described = quote!(::throng::parameters::Table {
        name: #title,
        about: #about,
        parameters: <Self as ::throng::parameters::Parameters>::PARAMETERS,
    });
    let parameters = quote!(<Self as ::throng::parameters::Parameters>::PARAMETERS);
    let defaults = fields.0.iter().map(Declared::usual);
    let read = fields.read(&parameters);
    let made = if fields.0.is_empty() { quote!(Self) } else { quote!(Self { #read }) };
    let (kind, read_list) = match list.and_then(|list| fields.0.iter().find(|field| field.ident == *list)) {
        Some(Declared { ident: list, ty, .. }) => (
            quote!(ListOrTable(&<#ty as ::throng::parameters::Value>::KIND, || #described)),
            Some(quote! {
                if #given.is_list() {
                    let #list = ::throng::parameters::Value::read(#given, #list)?;
                    return ::core::result::Result::Ok(Self::new(#list));
                }
            }),
        ),
        None => (quote!(Table(|| #described)), None),
    };
    let usual_values = (!fields.0.is_empty()).then(|| {
        quote! {
            let (#(#names,)*) = match #usual {
                ::core::option::Option::Some(Self { #(#names),* }) => (#(::core::option::Option::Some(#names),)*),
                ::core::option::Option::None => (#(#defaults,)*),
            };
        }
    });
    let usual = if fields.0.is_empty() { quote!(_) } else { quote!(#usual) };
    let value = local("value");
    let checked = check.map(|check| quote!((#check)(&#value).map_err(|error| #given.refused(error))?;));
    let places = names.iter().map(|name| quote!(&self.#name));
    let (write, check) = (fields.write(places.clone()), fields.check(&parameters, places));
    quote! {
        impl ::throng::parameters::Value for #ident {
            const KIND: ::throng::parameters::Kind = ::throng::parameters::Kind::#kind;

            fn read<G: ::throng::parameters::Given>(
                #given: &G,
                #usual: ::core::option::Option<Self>,
            ) -> ::core::result::Result<Self, G::Error> {
                #usual_values
                #read_list
                #given.table(&#described)?;
                let #value = #made;
                #checked
                ::core::result::Result::Ok(#value)
            }

            fn write(&self) -> ::core::option::Option<::throng::parameters::Written> {
                #write
            }

            fn check_limits(&self) -> ::core::result::Result<(), ::throng::Error> {
                #check
                ::core::result::Result::Ok(())
            }
        }
    }
}

/// Returns an enum with its implementation of `Value`: a choice of names, or of tables and values by their names.
pub fn of_enum(item: ItemEnum) -> syn::Result<TokenStream> {
    if item.variants.iter().all(|variant| matches!(variant.fields, syn::Fields::Unit)) {
        Ok(names(&item))
    } else {
        choice(item)
    }
}

/// Returns an enum of names.
fn names(item: &ItemEnum) -> TokenStream {
    let (given, ident) = (local("given"), &item.ident);
    let variants: Vec<&Ident> = item.variants.iter().map(|variant| &variant.ident).collect();
    let names: Vec<String> = variants.iter().map(|variant| snake_case(&variant.to_string())).collect();
    let abouts = item.variants.iter().map(|variant| first_paragraph(&variant.attrs));
    let positions = 0..names.len().saturating_sub(1);
    let (title, about) = (ident.to_string(), first_paragraph(&item.attrs));
    let (last, first) = variants.split_last().map_or((None, &[][..]), |(last, first)| (Some(last), first));
    quote! {
        #item

        impl #ident {
            const NAMES: ::throng::parameters::Names = ::throng::parameters::Names {
                name: #title,
                about: #about,
                names: &[#(::throng::parameters::Name { name: #names, about: #abouts }),*],
            };
        }

        impl ::throng::parameters::Value for #ident {
            const KIND: ::throng::parameters::Kind = ::throng::parameters::Kind::Name(|| Self::NAMES);

            fn read<G: ::throng::parameters::Given>(
                #given: &G,
                _: ::core::option::Option<Self>,
            ) -> ::core::result::Result<Self, G::Error> {
                ::core::result::Result::Ok(match #given.name(&Self::NAMES)? {
                    #(#positions => Self::#first,)*
                    _ => Self::#last,
                })
            }

            fn write(&self) -> ::core::option::Option<::throng::parameters::Written> {
                let name = match self { #(Self::#variants => #names),* };
                ::core::option::Option::Some(::throng::parameters::Written::Text(name.into()))
            }
        }
    }
}

/// Returns an enum of choices: each variant is a table, or one value.
fn choice(mut item: ItemEnum) -> syn::Result<TokenStream> {
    let (given, inner) = (local("given"), local("inner"));
    let ident = item.ident.clone();
    let (title, about) = (ident.to_string(), first_paragraph(&item.attrs));
    let (mut parameters, mut reads, mut writes, mut checks) = (vec![], vec![], vec![], vec![]);
    for (k, variant) in item.variants.iter_mut().enumerate() {
        let name = &variant.ident;
        let key = snake_case(&name.to_string());
        let about = first_paragraph(&variant.attrs);
        let own = quote!(Self::CHOICES[#k]);
        match &mut variant.fields {
            syn::Fields::Unnamed(fields) if fields.unnamed.len() == 1 => {
                let field = Declared::unnamed(&mut variant.attrs, &key, &fields.unnamed[0])?;
                parameters.push(field.described());
                let value = local("value");
                reads.push(quote! {
                    let #value = ::throng::parameters::Value::read(&#inner, ::core::option::Option::None)?;
                    #inner.check(&#own, &#value)?;
                    Self::#name(#value)
                });
                writes.push(quote!(Self::#name(value) => (#key, ::throng::parameters::Value::write(value))));
                checks.push(quote!(Self::#name(value) => #own.check(value)));
            }
            syn::Fields::Unnamed(_) => {
                return Err(syn::Error::new_spanned(name, "a choice has named fields, or one field without a name"));
            }
            fields => {
                let named = match std::mem::replace(fields, syn::Fields::Unit) {
                    syn::Fields::Named(named) => named.named,
                    _ => syn::punctuated::Punctuated::new(),
                };
                let declared = Fields::of(named)?;
                let of = declared.parameters();
                let title = format!("{title}{name}");
                let described = quote!(::throng::parameters::Table {
                    name: #title,
                    about: #about,
                    parameters: {
                        const OF: &[::throng::parameters::Parameter] = #of;
                        OF
                    },
                });
                parameters.push(Declared::table(&key, &about, &described));
                let table = quote!((#described).parameters);
                let names: Vec<&Ident> = declared.0.iter().map(|field| &field.ident).collect();
                let defaults = declared.0.iter().map(Declared::usual);
                let read = declared.read_from(&inner, &quote!(parameters));
                let (pattern, made) = if declared.0.is_empty() {
                    (quote!(Self::#name), quote!(Self::#name))
                } else {
                    (quote!(Self::#name { #(#names),* }), quote!(Self::#name { #read }))
                };
                let parameters = (!declared.0.is_empty()).then(|| {
                    quote! {
                        let parameters = #table;
                        let (#(#names,)*) = (#(#defaults,)*);
                    }
                });
                reads.push(quote! {
                    #inner.table(&#described)?;
                    #parameters
                    #made
                });
                let places = names.iter().map(|name| quote!(#name));
                let (write, check) = (declared.write(places.clone()), declared.check(&quote!(parameters), places));
                writes.push(quote!(#pattern => (#key, #write)));
                let parameters = (!declared.0.is_empty()).then(|| quote!(let parameters = #table;));
                checks.push(quote!(#pattern => {
                    #parameters
                    #check
                    ::core::result::Result::Ok(())
                }));
                if !declared.0.is_empty() {
                    let written = declared.written();
                    *fields = syn::Fields::Named(syn::parse_quote!({ #written }));
                }
            }
        }
    }
    let described = quote!(::throng::parameters::Table { name: #title, about: #about, parameters: Self::CHOICES });
    let positions = 0..reads.len();
    let last = reads.pop();
    let positions = positions.take(reads.len());
    Ok(quote! {
        #item

        impl #ident {
            const CHOICES: &'static [::throng::parameters::Parameter] = &[#(#parameters),*];
        }

        impl ::throng::parameters::Value for #ident {
            const KIND: ::throng::parameters::Kind = ::throng::parameters::Kind::Choice(|| #described);

            fn read<G: ::throng::parameters::Given>(
                #given: &G,
                _: ::core::option::Option<Self>,
            ) -> ::core::result::Result<Self, G::Error> {
                let (choice, #inner) = #given.choice(&#described)?;
                ::core::result::Result::Ok(match choice {
                    #(#positions => { #reads })*
                    _ => { #last }
                })
            }

            fn write(&self) -> ::core::option::Option<::throng::parameters::Written> {
                let (name, value) = match self { #(#writes,)* };
                value.map(|value| ::throng::parameters::Written::Table([(name.into(), value)].into()))
            }

            fn check_limits(&self) -> ::core::result::Result<(), ::throng::Error> {
                match self { #(#checks,)* }
            }
        }
    })
}

/// Returns the name of a local variable that no field can hide.
pub fn local(name: &str) -> Ident {
    Ident::new(name, Span::mixed_site())
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
