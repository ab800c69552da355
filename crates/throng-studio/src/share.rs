//! Links: a scene of the gallery or its compressed text, and the view of it.

use crate::document::Document;
use crate::settings::Settings;
use crate::view::Mode;
use base64::Engine;
use base64::prelude::BASE64_URL_SAFE_NO_PAD;
use serde_json::Value;
use throng_scene::gallery;

/// The prefix of a compressed text.
const PACKED: &str = "text=";
/// The largest text, bytes. A link with a larger text is rejected.
const MOST: usize = 8 << 20;
/// Settings that a scene gives: links hold them, even those with the usual value.
const GIVEN: [&str; 3] = ["trails", "layers.streams", "layers.stream_speed"];

/// What is seen of a scene.
#[derive(Clone, Debug)]
pub struct Seen<'a> {
    /// Number of steps.
    pub step: u64,
    /// The number of the selected agent.
    pub selected: Option<u32>,
    /// The camera, and its [pose](crate::view::Eye::pose).
    pub camera: (Mode, String),
    /// The settings: panels, layers, colours, the model beside.
    pub settings: &'a Settings,
}

/// Returns the part of the address after `#` that opens a document.
pub fn link(document: &Document) -> String {
    let (name, text) = (&*document.name, document.text());
    if gallery::text(name) == Some(text) {
        return name.to_owned();
    }
    let packed = miniz_oxide::deflate::compress_to_vec(format!("{name}\n{text}").as_bytes(), 9);
    format!("{PACKED}{}", BASE64_URL_SAFE_NO_PAD.encode(packed))
}

/// Returns the part of the address after `#` that opens exactly what is seen of a document
/// ([`Options::of_address`](crate::Options::of_address)).
pub fn link_of(document: &Document, seen: &Seen<'_>) -> String {
    let mut parts = vec![format!("{}@{}", link(document), seen.step)];
    parts.extend(seen.selected.map(|number| format!("select={number}")));
    let (mode, pose) = &seen.camera;
    parts.push(format!("camera={}", mode.label().replace(' ', "-")));
    parts.push(format!("eye={pose}"));
    parts.push("defaults".into());
    let [now, usual] = [seen.settings, &Settings::default()].map(serde_json::to_value);
    if let (Ok(now), Ok(usual)) = (now, usual) {
        differences("", &now, &usual, &mut parts);
    }
    parts.join("&")
}

/// Adds the settings that differ from the usual ones, as [`Settings::set`] reads them.
fn differences(path: &str, now: &Value, usual: &Value, parts: &mut Vec<String>) {
    match (now, usual) {
        (Value::Object(now), Value::Object(usual)) if now.keys().eq(usual.keys()) => {
            for (key, value) in now {
                let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                differences(&path, value, &usual[key], parts);
            }
        }
        _ if path == "scene" || (now == usual && !GIVEN.contains(&path)) => {}
        (Value::String(text), _) => parts.push(format!("{path}={text}")),
        _ => parts.push(format!("{path}={now}")),
    }
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
    use crate::Options;
    use crate::play::Speed;
    use crate::settings::Panels;
    use crate::view::{Coloring, FirstView, Heat, Layers};

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
    fn a_link_holds_the_whole_view() {
        let settings = Settings {
            coloring: Coloring::Speed,
            dark: true,
            kinds: vec!["flow".into(), "terms".into()],
            beside: "rvo".into(),
            speed: Speed::Fastest,
            panels: Panels { plots: true, gallery: false, ..Panels::default() },
            layers: Layers { heat: Heat::Density, field: Some(1), ..Layers::default() },
            ..Settings::default()
        };
        let camera = (Mode::PointOfView, "1,2,-0.5".to_owned());
        let seen = Seen { step: 120, selected: Some(7), camera, settings: &settings };
        for document in
            [Document::gallery("circle").unwrap(), Document::new("mine", "[[group]]\nplace.point = [0, 0]\n")]
        {
            let link = link_of(&document, &seen);
            let options = Options::of_address(&link).unwrap();
            assert_eq!((options.scene, options.at_step), (Some(super::link(&document)), Some(120)));
            let first = FirstView { selected: Some(7), mode: Some(Mode::PointOfView), pose: Some("1,2,-0.5".into()) };
            let options = Options::of_address(&link).unwrap();
            assert_eq!(options.first_view(), first);
            // the settings of the visitor have no effect
            let mut opened = Settings { trails: 9.0, grid: false, speed: Speed::Times(2.0), ..Settings::default() };
            options.adjust(&mut opened).unwrap();
            assert_eq!(opened, settings, "{link}");
        }
    }

    #[test]
    fn a_broken_link_is_no_document() {
        for link in ["text=", "text=!!", "text=AAAA", "text"] {
            assert!(open(link).is_none(), "{link}");
        }
    }
}
