//! Tests of textures: pictures of 16 by 8 pixels, red on the left and blue on the right. Pillow 13 wrote them, and its
//! decoder is the oracle of their colours.

use super::*;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

const BASELINE: &str = "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAAMCAgMCAgMDAwMEAwMEBQgFBQQEBQoHBwYIDAoMDAsKCwsNDhIQDQ4RDgsLEBYQERMUFRUV \
     DA8XGBYUGBIUFRT/2wBDAQMEBAUEBQkFBQkUDQsNFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQU \
     FBT/wAARCAAIABADAREAAhEBAxEB/8QAFQABAQAAAAAAAAAAAAAAAAAABgj/xAAUEAEAAAAAAAAAAAAAAAAAAAAA/8QAFQEBAQAAAAAA \
     AAAAAAAAAAAACQf/xAAUEQEAAAAAAAAAAAAAAAAAAAAA/9oADAMBAAIRAxEAPwCdEMKmQEbCi//Z";
const PROGRESSIVE: &str = "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAAMCAgMCAgMDAwMEAwMEBQgFBQQEBQoHBwYIDAoMDAsKCwsNDhIQDQ4RDgsLEBYQERMUFRUV \
     DA8XGBYUGBIUFRT/2wBDAQMEBAUEBQkFBQkUDQsNFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQU \
     FBT/wgARCAAIABADASIAAhEBAxEB/8QAFgABAQEAAAAAAAAAAAAAAAAAAAUH/8QAFQEBAQAAAAAAAAAAAAAAAAAABAb/2gAMAwEAAhAD \
     EAAAAc5oDb7/xAAUEAEAAAAAAAAAAAAAAAAAAAAQ/9oACAEBAAEFAj//xAAYEQACAwAAAAAAAAAAAAAAAAAAB0SCwv/aAAgBAwEBPwFk \
     xL4P/8QAGBEAAgMAAAAAAAAAAAAAAAAAAAZDgsL/2gAIAQIBAT8BT566P//EABQQAQAAAAAAAAAAAAAAAAAAABD/2gAIAQEABj8CP//E \
     ABQQAQAAAAAAAAAAAAAAAAAAABD/2gAIAQEAAT8hP//aAAwDAQACAAMAAAAQ+//EABQRAQAAAAAAAAAAAAAAAAAAAAD/2gAIAQMBAT8Q \
     N//EABQRAQAAAAAAAAAAAAAAAAAAAAD/2gAIAQIBAT8QN//EABQQAQAAAAAAAAAAAAAAAAAAABD/2gAIAQEAAT8QP//Z";
const GREY: &str = "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAAMCAgMCAgMDAwMEAwMEBQgFBQQEBQoHBwYIDAoMDAsKCwsNDhIQDQ4RDgsLEBYQERMUFRUV \
     DA8XGBYUGBIUFRT/wAALCAAIABABAREA/8QAFQABAQAAAAAAAAAAAAAAAAAABgj/xAAUEAEAAAAAAAAAAAAAAAAAAAAA/9oACAEBAAA/ \
     AJ0IH//Z";
const LOSSLESS: &str = "UklGRigAAABXRUJQVlA4TBsAAAAvD8ABAA8wWk/5H+T5Dy2IBZP5S3emENH/0AEA";
const LOSSY: &str =
    "UklGRkIAAABXRUJQVlA4IDYAAAAQAgCdASoQAAgAAMASJaACdLoB+AH4gAPIAP75Jz/Bf//d5v6FDfn/0KH/+tG5L/q6L8bwAAA=";
const ALPHA: &str = "UklGRigAAABXRUJQVlA4TBsAAAAvD8ABEA8wWk/5H+QBDC2IBZP5S3emENH/0AEA";

fn bytes(text: &str) -> Vec<u8> {
    STANDARD.decode(text.replace(' ', "")).unwrap()
}

fn read(bytes: &[u8]) -> Result<Option<Texture>, String> {
    Texture::decoded(bytes, 128)
}

#[test]
fn pictures_have_the_colours_of_another_decoder() {
    let (red, blue) = ([255, 0, 0], [40, 90, 200]);
    for (name, text, left, right) in [
        ("baseline JPEG", BASELINE, red, blue),
        ("progressive JPEG", PROGRESSIVE, red, blue),
        ("grey JPEG", GREY, [76; 3], [88; 3]),
        ("lossless WebP", LOSSLESS, red, blue),
        ("lossy WebP", LOSSY, red, blue),
        ("WebP with opacity", ALPHA, red, blue),
    ] {
        let texture = read(&bytes(text)).unwrap().unwrap();
        assert_eq!((texture.width, texture.height, texture.pixels()), (16, 8, 128), "{name}");
        for (place, want) in [([0.15, 0.4], left), ([0.85, 0.4], right), ([-0.85, 7.4], left)] {
            let found = texture.at(place);
            let apart = found.iter().zip(want).map(|(a, b)| a.abs_diff(b)).max();
            assert!(apart <= Some(3), "{name} at {place:?}: {found:?}, not {want:?}");
        }
    }
}

#[test]
fn damaged_pictures_are_errors_with_the_reason() {
    for (name, text) in [("JPEG", BASELINE), ("JPEG", PROGRESSIVE), ("WebP", LOSSLESS), ("WebP", LOSSY)] {
        let whole = bytes(text);
        let why = read(&whole[..30]).unwrap_err();
        assert!(why.starts_with(&format!("the {name} is damaged: ")), "{why}");
        // whatever is wrong, it is no panic
        for at in 0..whole.len() {
            let mut changed = whole.clone();
            changed[at] ^= 0x55;
            _ = read(&changed);
            _ = read(&whole[..at]);
        }
    }
}

#[test]
fn pictures_beyond_the_limit_are_refused_before_they_are_decoded() {
    for text in [BASELINE, LOSSLESS] {
        let why = Texture::decoded(&bytes(text), 127).unwrap_err();
        assert_eq!(why, "the textures have more than 64 million pixels; export smaller ones");
    }
}

#[test]
fn other_formats_are_left_out() {
    assert!(read(b"\xabKTX 20\xbb\r\n\x1a\n").unwrap().is_none());
    assert!(read(b"RIFF\0\0\0\0WAVEfmt ").unwrap().is_none());
    assert!(read(b"").unwrap().is_none());
}
