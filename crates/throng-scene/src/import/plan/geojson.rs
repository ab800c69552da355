//! GeoJSON (RFC 7946): features, by their properties. Has its own reader over `serde_json`: a plan needs the shapes of
//! seven geometries, and errors that name the feature.

use super::drawing::{Drawing, FilePosition, Item, PlanShape};
use super::layer::role;
use crate::error::{Error, Kind};
use crate::geometry::{DVec2, bounds};
use serde_json::Value;

/// Properties that may define the role of a feature, in order of precedence.
const KEYS: [&str; 6] = ["throng", "layer", "type", "kind", "indoor", "name"];
/// Properties that define the number of agents.
const PEOPLE: [&str; 3] = ["people", "count", "number"];

/// A plan narrower than this is not in metres: its coordinates are degrees.
const NARROW: f64 = 0.5;

const HINT: &str =
    "a plan in GeoJSON is a FeatureCollection of Polygons and LineStrings with a property `layer`, such as `walls`";

/// Reads the shapes of a GeoJSON text: in metres, in a unit, or in degrees, which are converted to metres about the
/// centre.
///
/// # Errors
/// The text is not GeoJSON, or a geometry is wrong. The error has the feature.
pub(super) fn read(text: &str, unit: Option<f64>) -> Result<Drawing, Error> {
    let value: Value = serde_json::from_str(text).map_err(|error| {
        let at = (error.line().max(1), error.column().max(1));
        let line = text.lines().nth(at.0 - 1).unwrap_or_default().to_owned();
        Error { at: Some(at), line: Some((line, 1)), ..Error::new(Kind::Syntax, format!("this is not JSON: {error}")) }
    })?;
    let mut drawing = Drawing::of_ground();
    let collection = value["features"].as_array();
    let one = std::slice::from_ref(&value);
    for (i, feature) in collection.map_or(one, Vec::as_slice).iter().enumerate() {
        let geometry = if feature["type"] == "Feature" { &feature["geometry"] } else { feature };
        let properties = &feature["properties"];
        let says = |key: &&str| properties[*key].as_str();
        let layer = KEYS
            .iter()
            .filter_map(says)
            .find(|name| role(name).is_some())
            .or(KEYS.iter().find_map(says))
            .unwrap_or_default();
        let people = PEOPLE.iter().find_map(|key| properties[*key].as_u64());
        let mut forms = vec![];
        shapes(geometry, &mut forms)
            .map_err(|what| Error::new(Kind::Geometry, format!("features[{i}]: {what}")).hint(HINT))?;
        let item =
            |form| Item { role: role(layer), layer: layer.to_owned(), form, place: FilePosition::Feature(i), people };
        drawing.items.extend(forms.into_iter().map(item));
    }
    if drawing.items.is_empty() {
        return Err(Error::new(Kind::Geometry, "this GeoJSON has no shapes").hint(HINT));
    }
    scale(&mut drawing, &value, unit);
    Ok(drawing)
}

/// Adds the shapes of a geometry, or returns what is wrong with it.
fn shapes(geometry: &Value, out: &mut Vec<PlanShape>) -> Result<(), String> {
    let coordinates = &geometry["coordinates"];
    let list = |value: &Value| value.as_array().cloned().ok_or_else(|| "its coordinates are no list".to_owned());
    match geometry["type"].as_str() {
        Some("Point") => out.push(PlanShape::Point(point(coordinates)?)),
        Some("MultiPoint") => out.extend(line(coordinates)?.into_iter().map(PlanShape::Point)),
        Some("LineString") => out.push(PlanShape::of_line(line(coordinates)?, false)),
        Some("MultiLineString") => {
            for value in list(coordinates)? {
                out.push(PlanShape::of_line(line(&value)?, false));
            }
        }
        Some("Polygon") => out.push(polygon(coordinates)?),
        Some("MultiPolygon") => {
            for value in list(coordinates)? {
                out.push(polygon(&value)?);
            }
        }
        Some("GeometryCollection") => {
            for geometry in list(&geometry["geometries"])? {
                shapes(&geometry, out)?;
            }
        }
        None if geometry.is_null() => {}
        Some(kind) => return Err(format!("`{kind}` is no kind of geometry")),
        None => return Err("it has no geometry with a `type`".into()),
    }
    Ok(())
}

fn polygon(value: &Value) -> Result<PlanShape, String> {
    let rings = value.as_array().ok_or("its coordinates are no list of rings")?;
    let mut rings = rings.iter().map(line).collect::<Result<Vec<_>, _>>()?.into_iter();
    let outer = rings.next().ok_or("a polygon without a ring")?;
    if outer.len() < 4 {
        return Err(format!("a ring of {} points: it needs four or more, the last as the first", outer.len()));
    }
    Ok(PlanShape::Area(outer, rings.collect()))
}

fn line(value: &Value) -> Result<Vec<DVec2>, String> {
    value.as_array().ok_or("its coordinates are no list of points")?.iter().map(point).collect()
}

fn point(value: &Value) -> Result<DVec2, String> {
    let number = |i: usize| value[i].as_f64().filter(|x| x.is_finite());
    number(0).zip(number(1)).map(DVec2::from).ok_or_else(|| {
        let mut shown = value.to_string();
        shown.truncate(shown.char_indices().nth(40).map_or(shown.len(), |(end, _)| end));
        format!("{shown} is no point [x, y]")
    })
}

/// Converts the coordinates to metres.
fn scale(drawing: &mut Drawing, value: &Value, unit: Option<f64>) {
    let Some([low, high]) = bounds(drawing.items.iter().flat_map(|item| item.form.points())) else { return };
    let wide = (high - low).max_element();
    let named =
        value["crs"]["properties"]["name"].as_str().map(|name| name.contains("CRS84") || name.ends_with(":4326"));
    let on_earth = low.x >= -180.0 && high.x <= 180.0 && low.y >= -90.0 && high.y <= 90.0;
    if unit.is_none() && on_earth && named.unwrap_or(wide < NARROW) {
        let middle = low.midpoint(high);
        drawing.notes.whole(format!(
            "degrees (WGS 84), in metres about the middle, longitude {:.6}, latitude {:.6}",
            middle.x, middle.y
        ));
        let per_degree = metres_per_degree(middle.y);
        drawing.map(|p| (p - middle) * per_degree);
    } else {
        drawing.map(|p| p * unit.unwrap_or(1.0));
    }
}

/// Returns the lengths of a degree of longitude and of latitude at a latitude, metres: from the radii of curvature of
/// the WGS 84 ellipsoid, across and along the meridian. Within a kilometre of the centre, positions are accurate to a
/// few centimetres.
fn metres_per_degree(latitude: f64) -> DVec2 {
    let (axis, flattening) = (6_378_137.0, 1.0 / 298.257_223_563);
    let e2 = flattening * (2.0 - flattening);
    let (sin, cos) = libm::sincos(latitude.to_radians());
    let w2 = 1.0 - e2 * sin * sin;
    let across = axis / w2.sqrt();
    let along = across * (1.0 - e2) / w2;
    DVec2::new(across * cos, along).map(f64::to_radians)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_are_as_long_as_in_the_tables() {
        // lengths of a degree on WGS 84: latitude 0, 45, 90
        for (latitude, long, lat) in [(0.0, 111_319.5, 110_574.3), (45.0, 78_846.8, 111_131.8), (90.0, 0.0, 111_693.9)]
        {
            let metres = metres_per_degree(latitude);
            assert!((metres.x - long).abs() < 0.1 && (metres.y - lat).abs() < 0.1, "{latitude}: {metres}");
        }
    }
}
