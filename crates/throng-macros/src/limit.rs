//! The limit of a parameter: as tokens, as text in its doc line, and as words in messages.

use proc_macro2::TokenStream;
use quote::quote;
use syn::{Expr, ExprUnary, Lit, UnOp};

/// A number in an attribute, and its text.
pub struct Number {
    tokens: TokenStream,
    text: String,
}

impl Number {
    /// Reads a number, which may be negative.
    pub fn of(expression: &Expr) -> syn::Result<Self> {
        let (sign, literal) = match expression {
            Expr::Unary(ExprUnary { op: UnOp::Neg(_), expr, .. }) => ("-", &**expr),
            other => ("", other),
        };
        let text = match literal {
            Expr::Lit(found) => match &found.lit {
                Lit::Int(whole) => whole.base10_digits().to_owned(),
                Lit::Float(number) => number.base10_digits().to_owned(),
                _ => return Err(syn::Error::new_spanned(expression, "a limit is a number")),
            },
            _ => return Err(syn::Error::new_spanned(expression, "a limit is a number")),
        };
        let text = format!("{sign}{text}");
        let number: f64 = text.parse().map_err(|_| syn::Error::new_spanned(expression, "a limit is a number"))?;
        Ok(Self { tokens: quote!(#expression), text: readable(number) })
    }
}

/// Returns the shortest text of a number, without the point of a whole number and with commas between its thousands
/// from 10,000 on.
fn readable(number: f64) -> String {
    let text = number.to_string();
    let whole = text.trim_start_matches('-');
    if whole.len() < 5 || whole.contains('.') {
        return text;
    }
    let mut with_commas = text[..text.len() - whole.len()].to_owned();
    for (k, digit) in whole.chars().enumerate() {
        if k > 0 && (whole.len() - k).is_multiple_of(3) {
            with_commas.push(',');
        }
        with_commas.push(digit);
    }
    with_commas
}

/// The limit of a parameter.
#[derive(Default)]
pub struct Limit {
    pub above: Option<Number>,
    pub least: Option<Number>,
    pub most: Option<Number>,
    /// Whether values may be infinite.
    pub is_infinite: bool,
}

impl Limit {
    pub fn is_empty(&self) -> bool {
        self.above.is_none() && self.least.is_none() && self.most.is_none()
    }

    /// Returns the sentence of a doc line: `Limit: > 0.`
    pub fn sentence(&self) -> String {
        let text = |number: &Option<Number>| number.as_ref().map(|number| number.text.clone());
        let limit = match (text(&self.above), text(&self.least), text(&self.most)) {
            (Some(above), _, Some(most)) => format!("> {above}, at most {most}"),
            (Some(above), _, None) => format!("> {above}"),
            (None, Some(least), Some(most)) => format!("{least} to {most}"),
            (None, Some(least), None) => format!(">= {least}"),
            (None, None, Some(most)) => format!("at most {most}"),
            (None, None, None) => return String::new(),
        };
        format!(" Limit: {limit}.")
    }

    /// Returns the words of messages: `more than 0`.
    fn words(&self) -> String {
        let text = |number: &Option<Number>| number.as_ref().map(|number| number.text.clone());
        match (text(&self.above), text(&self.least), text(&self.most)) {
            (Some(above), _, Some(most)) => format!("more than {above} and at most {most}"),
            (Some(above), _, None) => format!("more than {above}"),
            (None, Some(least), Some(most)) => format!("from {least} to {most}"),
            (None, Some(least), None) => format!("{least} or more"),
            (None, None, Some(most)) => format!("at most {most}"),
            (None, None, None) => "a finite number".into(),
        }
    }

    /// Returns the value of type `throng::parameters::Limit`.
    pub fn value(&self) -> TokenStream {
        let option = |number: &Option<Number>| match number {
            Some(Number { tokens, .. }) => quote!(::core::option::Option::Some(#tokens as f64)),
            None => quote!(::core::option::Option::None),
        };
        let (above, least, most, words) = (option(&self.above), option(&self.least), option(&self.most), self.words());
        let is_infinite = self.is_infinite;
        quote!(::throng::parameters::Limit {
            above: #above,
            least: #least,
            most: #most,
            is_infinite: #is_infinite,
            words: #words,
        })
    }
}
