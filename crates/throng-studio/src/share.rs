//! Scenes as links: a name of the gallery, or the compressed text.

use crate::document::Document;
use base64::Engine;
use base64::prelude::BASE64_URL_SAFE_NO_PAD;
use throng_scene::gallery;

/// The prefix of a compressed text.
const PACKED: &str = "text=";
/// The largest text, bytes. A link with a larger text is rejected.
const MOST: usize = 8 << 20;

/// Returns the part of the address after `#` that opens a document.
pub fn link(document: &Document) -> String {
    let (name, text) = (&*document.name, document.text());
    if gallery::text(name) == Some(text) {
        return name.to_owned();
    }
    let packed = miniz_oxide::deflate::compress_to_vec(format!("{name}\n{text}").as_bytes(), 9);
    format!("{PACKED}{}", BASE64_URL_SAFE_NO_PAD.encode(packed))
}

/// Returns the document of a link that holds its text, `None` for any other or invalid link.
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
