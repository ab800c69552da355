//! Several recordings side by side.

use super::common::{moment, read_png, setting, style};
use throng_draw::{Color, Film, Painter, Sheet, Still, Style};
use throng_record::Setting;

#[test]
fn each_panel_equals_a_picture_of_its_recording() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sheet.png");
    let titled = |title: &str| Setting { title: title.into(), ..setting() };
    let sheet = Sheet { title: String::new(), panels: vec![titled("one"), titled("two"), titled("three")], columns: 2 };
    let style = Style { width: 322, height: 242, legend: true, ..style() };
    let mut film = Film::create(&path, sheet.clone(), &style, 25.0).unwrap().still(Still::Index(1));
    // The second recording has ended.
    let moments = [[0, 0, 0], [1, 0, 1], [2, 0, 2]].map(|panel| panel.map(moment));
    for frames in &moments {
        film.push_all(&frames.each_ref()).unwrap();
    }
    film.finish().unwrap();
    let (width, rgb) = (322, read_png(&path));
    assert_eq!(rgb.len(), 322 * 242 * 3);
    let cell = Style { width: 160, height: 120, ..style.clone() };
    for (k, corner) in [(0, 0), (162, 0), (0, 122)].into_iter().enumerate() {
        let first = &moments[0][k];
        let mut painter = Painter::new(&sheet.panels[k], &cell, first).unwrap();
        painter.follow(first);
        let want = painter.paint(&moments[1][k]);
        for y in 0..120 {
            for x in 0..160 {
                let at = ((corner.1 + y) * width + corner.0 + x) as usize * 3;
                let Color { r, g, b, .. } = want.pixel(x, y);
                assert_eq!(rgb[at..at + 3], [r, g, b], "panel {k}, ({x}, {y})");
            }
        }
    }
    let svg = folder.path().join("sheet.svg");
    let mut film = Film::create(&svg, Sheet { title: "A & B".into(), ..sheet }, &style, 25.0).unwrap();
    film.push_all(&moments[0].each_ref()).unwrap();
    film.finish().unwrap();
    let text = std::fs::read_to_string(&svg).unwrap();
    assert_eq!((text.matches("<svg").count(), text.matches("</svg>").count()), (4, 4));
    assert!(text.contains("A &amp; B") && text.contains("agents-3") && text.contains(">three<"));
}
