//! The contents of output files.

use super::common::{moment, read_png, setting, style};
use glam::DVec2;
use std::path::Path;
use throng_draw::record::{Files, Plan, Recorder};
use throng_draw::sink::{FolderSink, Kind, sink};
use throng_draw::{Color, Error, Film, Image, MotionBlur, Painter, Still, Style, palette};
use throng_record::{Choice, Frame, OutputError};

const FRAMES: usize = 60;

fn film(path: &Path, rate: f64, count: usize) -> Result<(), Error> {
    let mut film = Film::create(path, &setting(), &style(), rate)?;
    for k in 0..count {
        film.push(&moment(k))?;
    }
    film.finish()
}

fn picture(k: usize) -> Image {
    Painter::new(&setting(), &style(), &moment(0)).unwrap().paint(&moment(k)).clone()
}

/// Returns the similarity (PSNR, decibels) of a picture with three bytes per pixel to a painted one.
fn likeness(rgb: &[u8], image: &Image) -> f64 {
    let ours = image.data().chunks_exact(4).flat_map(|p| &p[..3]);
    assert_eq!(rgb.len(), image.data().len() / 4 * 3);
    let sum: f64 = rgb.iter().zip(ours).map(|(&a, &b)| (f64::from(a) - f64::from(b)).powi(2)).sum();
    10.0 * (255.0 * 255.0 * rgb.len() as f64 / sum.max(1e-9)).log10()
}

/// Returns the content of a box inside `bytes`.
fn find<'a>(bytes: &'a [u8], name: &[u8; 4]) -> Option<&'a [u8]> {
    let mut rest = bytes;
    while rest.len() >= 8 {
        let length = u32::from_be_bytes(rest[..4].try_into().unwrap()) as usize;
        assert!((8..=rest.len()).contains(&length), "a box of {length} bytes in {}", rest.len());
        if &rest[4..8] == name {
            return Some(&rest[8..length]);
        }
        rest = &rest[length..];
    }
    assert!(rest.is_empty(), "boxes fill the file");
    None
}

fn path_of<'a>(bytes: &'a [u8], names: &[&[u8; 4]]) -> &'a [u8] {
    names.iter().fold(bytes, |bytes, name| find(bytes, name).expect("the box is there"))
}

fn numbers(bytes: &[u8]) -> Vec<usize> {
    bytes.chunks_exact(4).map(|b| u32::from_be_bytes(b.try_into().unwrap()) as usize).collect()
}

#[test]
fn an_mp4_holds_every_picture_and_looks_like_them() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.mp4");
    film(&path, 25.0, FRAMES).unwrap();
    let bytes = std::fs::read(&path).unwrap();
    assert_eq!(&bytes[4..8], b"ftyp");

    let stbl = path_of(&bytes, &[b"moov", b"trak", b"mdia", b"minf", b"stbl"]);
    let sizes = numbers(path_of(stbl, &[b"stsz"]))[3..].to_vec();
    assert_eq!(sizes.len(), FRAMES);
    assert_eq!(numbers(path_of(stbl, &[b"stts"]))[1..], [1, FRAMES, 3600]);
    assert_eq!(numbers(path_of(stbl, &[b"stss"]))[2], 1, "the first picture is a key frame");
    let mdat = find(&bytes, b"mdat").unwrap();
    assert_eq!(mdat.len(), sizes.iter().sum::<usize>());
    let start = bytes.len() - mdat.len();
    assert_eq!(numbers(path_of(stbl, &[b"stco"]))[2], start);

    // A sample entry has 78 bytes before its boxes.
    let entry = &path_of(stbl, &[b"stsd"])[8..];
    let avc1 = &find(entry, b"avc1").unwrap()[78..];
    let colr = find(avc1, b"colr").unwrap();
    assert_eq!(colr, [b'n', b'c', b'l', b'x', 0, 1, 0, 1, 0, 1, 0]);
    let config = find(avc1, b"avcC").unwrap();
    let sps = u16::from_be_bytes([config[6], config[7]]) as usize;
    let pps = u16::from_be_bytes([config[9 + sps], config[10 + sps]]) as usize;
    assert_eq!(config.len(), 11 + sps + pps);

    let mut decoder = openh264::decoder::Decoder::new().unwrap();
    let start_code = [0, 0, 0, 1];
    let parameters = [&start_code, &config[8..8 + sps], &start_code, &config[11 + sps..]].concat();
    let (mut at, mut decoded) = (0, 0);
    for (k, size) in sizes.iter().enumerate() {
        let mut stream = if k == 0 { parameters.clone() } else { Vec::new() };
        let (mut sample, end) = (&mdat[at..at + size], at + size);
        while !sample.is_empty() {
            let length = numbers(&sample[..4])[0];
            stream.extend_from_slice(&start_code);
            stream.extend_from_slice(&sample[4..4 + length]);
            sample = &sample[4 + length..];
        }
        at = end;
        let yuv = decoder.decode(&stream).unwrap().expect("a picture for every sample");
        decoded += 1;
        let like = likeness(&bt709(&yuv), &picture(k));
        assert!(like > 30.0, "picture {k}: {like:.1} dB");
    }
    assert_eq!(decoded, FRAMES);
}

/// Converts video colours to RGB, without interpolation of the chroma.
fn bt709(yuv: &openh264::decoder::DecodedYUV<'_>) -> Vec<u8> {
    use openh264::formats::YUVSource;
    let ((w, h), (sy, su, sv)) = (yuv.dimensions(), yuv.strides());
    let mut rgb = Vec::new();
    for (y, x) in (0..h).flat_map(|y| (0..w).map(move |x| (y, x))) {
        let luma = (f64::from(yuv.y()[y * sy + x]) - 16.0) / 219.0;
        let cb = (f64::from(yuv.u()[y / 2 * su + x / 2]) - 128.0) / 224.0;
        let cr = (f64::from(yuv.v()[y / 2 * sv + x / 2]) - 128.0) / 224.0;
        let (r, b) = (luma + 1.5748 * cr, luma + 1.8556 * cb);
        let g = (luma - 0.2126 * r - 0.0722 * b) / 0.7152;
        rgb.extend([r, g, b].map(|c| (c * 255.0).round().clamp(0.0, 255.0) as u8));
    }
    rgb
}

#[test]
fn the_same_film_is_the_same_file() {
    let folder = tempfile::tempdir().unwrap();
    for ending in ["mp4", "gif", "png", "svg"] {
        let paths = [0, 1].map(|k| folder.path().join(format!("{k}.{ending}")));
        paths.iter().for_each(|path| film(path, 25.0, 12).unwrap());
        let [a, b] = paths.map(|path| std::fs::read(path).unwrap());
        assert!(a == b, "{ending}");
    }
}

#[test]
fn a_gif_holds_every_picture_and_looks_like_them() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.gif");
    film(&path, 30.0, FRAMES).unwrap();
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(std::fs::File::open(&path).unwrap()).unwrap();
    assert_eq!(decoder.repeat(), gif::Repeat::Infinite);
    assert_eq!((decoder.width(), decoder.height()), (160, 120));
    let (mut screen, mut count, mut time) = (vec![0u8; 160 * 120 * 3], 0, 0);
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        for (k, pixel) in frame.buffer.chunks_exact(4).enumerate().filter(|(_, p)| p[3] > 0) {
            let (x, y) = (k % usize::from(frame.width), k / usize::from(frame.width));
            let at = ((y + usize::from(frame.top)) * 160 + x + usize::from(frame.left)) * 3;
            screen[at..at + 3].copy_from_slice(&pixel[..3]);
        }
        let like = likeness(&screen, &picture(count));
        assert!(like > 40.0, "picture {count}: {like:.1} dB");
        count += 1;
        time += u32::from(frame.delay);
    }
    assert_eq!(count, FRAMES);
    assert_eq!(time, 200, "60 pictures at 30 per second last two seconds, although GIF times are hundredths");
}

#[test]
fn a_gif_at_a_high_rate_keeps_its_time() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.gif");
    film(&path, 120.0, 120).unwrap();
    let mut decoder = gif::DecodeOptions::new().read_info(std::fs::File::open(&path).unwrap()).unwrap();
    let (mut count, mut time) = (0, 0);
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        assert!(frame.delay >= 2);
        count += 1;
        time += frame.delay;
    }
    assert!((99..=101).contains(&time) && count <= 50, "{count} pictures, {time} hundredths");
}

#[test]
fn a_folder_holds_one_file_per_picture_and_none_of_an_older_film() {
    let folder = tempfile::tempdir().unwrap();
    let frames = folder.path().join("frames/");
    film(&frames, 25.0, 9).unwrap();
    film(&frames, 25.0, 5).unwrap();
    let mut names: Vec<_> =
        std::fs::read_dir(&frames).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    let want: Vec<_> = (0..5).map(|k| format!("frame_{k:06}.png")).collect();
    assert_eq!(names, want);
    assert!(likeness(&read_png(&frames.join("frame_000003.png")), &picture(3)) > 90.0);
}

#[test]
fn a_png_shows_the_requested_moment() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("still.png");
    for (still, want) in [(Still::Last, 19), (Still::Index(7), 7), (Still::Time(0.41), 11), (Still::Index(100), 19)] {
        let mut film = Film::create(&path, &setting(), &style(), 25.0).unwrap().still(still);
        (0..20).for_each(|k| film.push(&moment(k)).unwrap());
        film.finish().unwrap();
        assert!(likeness(&read_png(&path), &picture(want)) > 90.0, "{still:?}");
    }
}

#[test]
fn odd_sizes_grow_to_even_ones() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.mp4");
    let mut film = sink(&path, 10.0).unwrap();
    film.push(&Image::new(33, 47, Color::rgb(0x336699))).unwrap();
    film.finish().unwrap();
    let bytes = std::fs::read(&path).unwrap();
    let tkhd = path_of(&bytes, &[b"moov", b"trak", b"tkhd"]);
    assert_eq!(numbers(tkhd)[19..21], [34 << 16, 48 << 16]);
}

#[test]
fn names_say_the_kind() {
    let kind = |name: &str| Kind::of(Path::new(name));
    assert_eq!(kind("a.MP4").unwrap(), Kind::Mp4);
    assert_eq!(kind("frames/").unwrap(), Kind::Folder);
    assert_eq!(kind(".").unwrap(), Kind::Folder);
    assert_eq!(kind("a.webm").unwrap(), Kind::Pipe);
    for name in ["a", "a.docx", ".mp4x"] {
        let error = kind(name).unwrap_err().to_string();
        assert!(error.contains(name) && error.contains(".mp4"), "{error}");
    }
}

#[test]
fn errors_come_before_the_work_and_leave_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let create = |name: &str, rate| Film::create(folder.path().join(name), &setting(), &style(), rate).err().unwrap();
    for name in ["no/film.mp4", "no/film.gif", "no/still.png", "no/still.svg", "no/frames/"] {
        let error = create(name, 25.0);
        assert!(matches!(error, Error::Output(OutputError::FolderMissing { .. })), "{name}: {error}");
    }
    for rate in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(create("film.mp4", rate), Error::Rate(_)));
    }
    for name in ["film.mp4", "film.gif", "still.png"] {
        let film = Film::create(folder.path().join(name), &setting(), &style(), 25.0).unwrap();
        assert!(matches!(film.finish().unwrap_err(), Error::Empty { .. }));
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_film_that_is_dropped_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["film.mp4", "film.gif", "still.png", "still.svg"] {
        let mut film = Film::create(folder.path().join(name), &setting(), &style(), 25.0).unwrap();
        (0..5).for_each(|k| film.push(&moment(k)).unwrap());
        drop(film);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "{name}");
    }
}

#[test]
fn a_picture_of_another_size_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["film.mp4", "film.gif", "frames/"] {
        let mut film = sink(folder.path().join(name), 25.0).unwrap();
        film.push(&Image::new(32, 32, palette(0))).unwrap();
        assert!(matches!(film.push(&Image::new(64, 32, palette(0))), Err(Error::SizeChanged { .. })), "{name}");
    }
    let large = Style { width: 4000, height: 3000, ..style() };
    let mut film = Film::create(folder.path().join("large.mp4"), &setting(), &large, 25.0).unwrap();
    let error = film.push(&moment(0)).and_then(|()| film.finish()).unwrap_err();
    assert!(error.to_string().contains("3840 by 2160"), "{error}");
}

#[test]
fn after_an_error_a_film_cannot_be_finished() {
    let folder = tempfile::tempdir().unwrap();
    let large = Style { width: 4000, height: 3000, ..style() };
    let mut film = Film::create(folder.path().join("large.mp4"), &setting(), &large, 25.0).unwrap();
    // The encoder runs on another thread: its error is returned for a later moment.
    let error = (0..20).find_map(|k| film.push(&moment(k)).err()).unwrap();
    assert!(matches!(error, Error::Size { .. }), "{error}");
    assert!(matches!(film.push(&moment(20)), Err(Error::Ended)));
    assert!(matches!(film.finish(), Err(Error::Ended)));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

/// Writes a picture of an agent on a circle after 2 s, with pictures at a rate and steps of 0.04 s.
fn circling(path: &Path, rate: f64) {
    let step = 0.04;
    let at = |k: usize| {
        let mut frame = moment(0);
        frame.time = k as f64 * step;
        frame.bodies.truncate(1);
        frame.bodies[0].position = 3.0 * DVec2::from_angle(3.0 * frame.time);
        frame
    };
    let (setting, style, choice) = (setting(), Style { trails: 1.5, ..style() }, Choice::default());
    let plan = Plan {
        setting: &setting,
        sheet: None,
        style: &style,
        rate,
        speed_up: 1.0,
        still: Still::Last,
        from: 0.0,
        choice: &choice,
        stop: || false,
    };
    let mut files = Files::new(vec![Recorder::create(path, &plan).unwrap()], plan.pace(), &choice);
    for k in 0..=50 {
        files.push(at(k).time, step, |frame| *frame = at(k)).unwrap();
    }
    files.finish(2.0, |frame| *frame = at(50)).unwrap();
}

#[test]
fn trails_do_not_depend_on_the_rate_of_pictures() {
    let folder = tempfile::tempdir().unwrap();
    let picture = |name: &str, rate: f64| {
        let path = folder.path().join(name);
        circling(&path, rate);
        read_png(&path)
    };
    let usual = picture("usual.png", 25.0);
    assert!(picture("rare.png", 0.5) == usual && picture("often.png", 100.0) == usual);
}

#[test]
fn a_film_with_motion_blur_is_exposed_for_half_of_the_time_between_pictures() {
    let folder = tempfile::tempdir().unwrap();
    let film = |name: &str, samples: u32| {
        let path = folder.path().join(name);
        let style = Style { blur: Some(MotionBlur { interval: 0.5, samples: Some(samples) }), ..style() };
        let sink = Box::new(FolderSink::create(&path).unwrap());
        let mut film = Film::new(&path, sink, &setting(), &style).unwrap();
        film.push(&moment(0)).unwrap();
        (1..=50).for_each(|k| film.follow_all(&[&moment(k)]).unwrap());
        film.finish().unwrap();
        let mut names: Vec<_> = std::fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()).collect();
        names.sort();
        names.iter().map(|name| read_png(name)).collect::<Vec<_>>()
    };
    let pictures = film("blurred/", 16);
    assert_eq!(pictures.len(), 4, "2 s, two pictures a second");
    assert!(pictures == film("again/", 16), "the same film again");
    // agent 0 goes to the east at 1 m/s from x = -5, y = 1; a picture has 10 pixels a metre, and the origin in its middle
    let bare = {
        let mut painter = Painter::new(&setting(), &style(), &moment(0)).unwrap();
        painter.paint(&Frame { bodies: Vec::new(), ..moment(0) }).clone()
    };
    let ink = |picture: &[u8], x: usize| {
        let at = (50 * 160 + x) * 3;
        let ground = bare.pixel(x as u32, 50);
        let [r, g, b] = [ground.r, ground.g, ground.b];
        picture[at..at + 3].iter().zip([r, g, b]).map(|(&a, b)| i32::from(a.abs_diff(b))).sum::<i32>()
    };
    for (k, picture) in pictures.iter().enumerate() {
        let x = 30.0 + 10.0 * (0.5 * k as f64);
        let at = |offset: f64| ink(picture, (x + offset) as usize);
        assert_eq!(
            (at(-7.0), at(9.0)),
            (0, 0),
            "picture {k}: beyond the body, which is 5 pixels in radius and moves 2.5"
        );
        assert!(at(1.5) > 100, "picture {k}: in the body all the time, {}", at(1.5));
        assert!(at(6.3) > 10 && at(6.3) < at(1.5), "picture {k}: in the body for a part of the time, {}", at(6.3));
    }
    // one sample is a sharp picture of the middle of the exposure
    let sharp = film("sharp/", 1);
    let mut frame = moment(0);
    frame.time = 0.125;
    frame.bodies[0].position.x += 0.125;
    frame.bodies[1].position.x -= 0.125;
    let mut painter = Painter::new(&setting(), &style(), &moment(0)).unwrap();
    let wanted: Vec<u8> = painter.paint(&frame).data().chunks_exact(4).flat_map(|p| p[..3].to_vec()).collect();
    assert!(sharp[0] == wanted);
}
