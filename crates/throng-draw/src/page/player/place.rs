//! The place as data for the page's script.

use glam::DVec2;
use serde_json::{Value, json};
use throng::{Goal, Obstacle};
use throng_record::Setting;

/// Returns ground, obstacles and goals as JSON. `points` are the drawn point goals with their tolerances, `marked` the
/// areas and `counted` the lines of figures.
pub fn place(setting: &Setting, points: &[(DVec2, f64)], marked: &[Vec<DVec2>], counted: &[Vec<DVec2>]) -> Value {
    let (mut circles, mut polygons, mut walls) = (Vec::new(), Vec::new(), Vec::new());
    for obstacle in &setting.obstacles {
        match obstacle {
            Obstacle::Circle { center, radius } => circles.push(json!([center.x, center.y, radius])),
            Obstacle::Polygon { corners } => polygons.push(line(corners)),
            Obstacle::Wall { points } => walls.push(line(points)),
        }
    }
    let (mut areas, mut exits) = (Vec::new(), Vec::new());
    for goal in &setting.goals {
        match goal {
            Goal::Point { .. } | Goal::Air { .. } => {}
            Goal::Area { corners } => areas.push(line(corners)),
            Goal::Exit { corners } => exits.push(line(corners)),
        }
    }
    let rings = setting.walkable.iter().map(|area| std::iter::once(&area.outer).chain(&area.holes));
    let walkable: Vec<Value> = rings.map(|rings| Value::from_iter(rings.map(|ring| line(ring)))).collect();
    let points: Vec<Value> = points.iter().map(|(at, reach)| json!([short(at.x), short(at.y), reach])).collect();
    json!({
        "walkable": walkable, "circles": circles, "polygons": polygons, "walls": walls,
        "points": points, "areas": areas, "exits": exits,
        "marked": marked.iter().map(|ring| line(ring)).collect::<Vec<_>>(),
        "counted": counted.iter().map(|ends| line(ends)).collect::<Vec<_>>(),
    })
}

fn line(points: &[DVec2]) -> Value {
    points.iter().map(|point| json!([short(point.x), short(point.y)])).collect()
}

/// Rounds to millimetres, which are enough for a picture.
fn short(metres: f64) -> f64 {
    (metres * 1e3).round() / 1e3
}
