//! Tests of measures of pedestrians against independent results.

use super::shared::{near, points, speed_at};
use glam::DVec2;
use throng_record::pedestrian::{Area, Ground, People};
use throng_record::{Reading, Trajectories};

/// Medians of published measurements, in steps of 0.5 of the density.
#[test]
fn published_speeds_are_those_known() {
    let known: [(&str, &str, &[f64]); 3] = [
        ("3test_UO", "uo", &[1.45, 1.24, 1.11, 0.84, 0.44, 0.31, 0.17, 0.13]),
        ("7test_BO", "bot", &[1.43, 1.17, 0.85, 0.68, 0.51, 0.43]),
        ("1test_1D", "n", &[0.91, 0.82, 0.31, 0.12, 0.05]),
    ];
    for (folder, begins, speeds) in known {
        let points = points(folder, begins);
        for (k, speed) in speeds.iter().enumerate() {
            // to the number of digits given
            assert!((speed_at(&points, 0.5 + 0.5 * k as f64) - speed).abs() <= 0.0055, "{folder}: {k}");
        }
    }
}

#[test]
fn cells_cover_the_area() {
    // without a cut-off, the cells cover any area, and each point of it belongs to the nearest pedestrian
    let mut draw = 5u64;
    let mut next = || {
        draw = draw.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (draw >> 11) as f64 / (1u64 << 53) as f64
    };
    for count in [1, 2, 3, 10, 60] {
        let text: String = (0..count).map(|k| format!("{k},0,{},{}\n", 10.0 * next(), 10.0 * next())).collect();
        let tracks =
            Trajectories::of_file("a.csv", format!("number,time,x,y\n{text}").as_bytes(), &Reading::default()).unwrap();
        let people = People::of(&tracks, |_| true);
        let area = Area::rectangle([2.0, 3.0, 4.0, 5.0]).unwrap();
        let moment = &people.moments[0];
        let cells = throng_record::pedestrian::voronoi::cells(&people, moment, &Ground::default(), &area);
        near(cells.iter().map(|cell| cell.inside).sum(), 20.0, 1e-6);
        // compared with random points
        let mut hits = vec![0u32; count];
        for _ in 0..20000 {
            let place = DVec2::new(2.0 + 4.0 * next(), 3.0 + 5.0 * next());
            let nearest = (0..count).min_by(|&a, &b| {
                let away = |k: usize| people.walks[k].places[0].distance(place);
                away(a).total_cmp(&away(b))
            });
            hits[nearest.unwrap()] += 1;
        }
        for (walk, &hits) in hits.iter().enumerate() {
            let inside = cells.iter().find(|cell| cell.here.walk == walk).map_or(0.0, |cell| cell.inside);
            assert!((inside - f64::from(hits) / 1000.0).abs() < 0.3, "{count}: {inside}, not {hits} of 20000");
        }
    }
}
