//! Scenes as links: a name of the gallery, or the whole text, packed.

use crate::document::Document;
use base64::Engine;
use base64::prelude::BASE64_URL_SAFE_NO_PAD;
use throng_scene::gallery;

/// What a packed text begins with.
const PACKED: &str = "text=";
/// Bytes of a text at most: a link that says more is not one of ours.
const MOST: usize = 8 << 20;

/// What stands behind `#` in the address of a document.
pub fn link(document: &Document) -> String {
    let (name, text) = (&*document.name, document.text());
    if gallery::text(name) == Some(text) {
        return name.to_owned();
    }
    let packed = miniz_oxide::deflate::compress_to_vec(format!("{name}\n{text}").as_bytes(), 9);
    format!("{PACKED}{}", BASE64_URL_SAFE_NO_PAD.encode(packed))
}

/// The document of a link that holds its text; `None` if it is no such link, or a broken one.
pub fn open(link: &str) -> Option<Document> {
    let packed = BASE64_URL_SAFE_NO_PAD.decode(link.strip_prefix(PACKED)?).ok()?;
    let bytes = miniz_oxide::inflate::decompress_to_vec_with_limit(&packed, MOST).ok()?;
    let all = String::from_utf8(bytes).ok()?;
    let (name, text) = all.split_once('\n')?;
    Some(Document::new(name, text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_link_opens_what_was_shared() {
        let mut document = Document::gallery("circle").unwrap();
        assert_eq!(link(&document), "circle");
        assert!(open("circle").is_none());
        document.edit(format!("# für alle\n{}", document.text()));
        let link = link(&document);
        assert!(link.len() < document.text().len(), "{link}");
        assert!(link.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"-_=".contains(&byte)), "{link}");
        let shared = open(&link).unwrap();
        assert_eq!((&shared.name, shared.text()), (&document.name, document.text()));
    }

    #[test]
    fn a_broken_link_is_no_document() {
        for link in ["text=", "text=!!", "text=AAAA", "text"] {
            assert!(open(link).is_none(), "{link}");
        }
    }
}
