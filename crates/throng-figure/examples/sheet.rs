//! Draws people from the side over a cycle: `cargo run --release -p throng-figure --example sheet -- FOLDER` writes SVG
//! files.

#![allow(clippy::print_stdout)]

use glam::{DVec2, DVec3};
use std::fmt::Write;
use throng_figure::{Build, Joint, Level, Look, Mesh, Person, Pose, Sample, Skeleton, Walk};

const SCALE: f64 = 130.0;

/// Returns samples of a body with constant forward speed (m/s), sideways speed (m/s) and angular speed (rad/s).
fn driven(forward: f64, left: f64, turning: f64) -> Vec<Sample> {
    let (mut position, mut heading) = (DVec2::ZERO, 0.0_f64);
    let mut samples = Vec::new();
    for moment in 0..=800 {
        samples.push(Sample { time: f64::from(moment) / 100.0, position, heading });
        let ahead = DVec2::new(heading.cos(), heading.sin());
        position += (ahead * forward + ahead.perp() * left) / 100.0;
        heading += turning / 100.0;
    }
    samples
}

/// Draws the bones of a pose, seen from the right or from the front: the left limbs in another colour.
fn bones(svg: &mut String, skeleton: &Skeleton, pose: &Pose, origin: DVec2, view: impl Fn(DVec3) -> DVec2) {
    let joints = skeleton.world(pose);
    for joint in Joint::ALL {
        let Some(parent) = joint.parent() else { continue };
        let mut line = |a: DVec3, b: DVec3| {
            let (a, b) = (origin + view(a) * SCALE, origin + view(b) * SCALE);
            let colour = match joint.name() {
                name if name.starts_with("Left") => "#c33",
                name if name.starts_with("Right") => "#25c",
                _ => "#222",
            };
            let _ = writeln!(
                svg,
                r#"<line x1="{:.1}" y1="{:.1}" x2="{:.1}" y2="{:.1}" stroke="{colour}" stroke-width="3"/>"#,
                a.x, a.y, b.x, b.y
            );
        };
        let placed = joints[joint.index()];
        line(joints[parent.index()].position, placed.position);
        match joint {
            Joint::Head => line(placed.position, placed.position + placed.rotation * DVec3::new(0.0, 0.0, 0.2)),
            Joint::LeftToeBase | Joint::RightToeBase => {
                line(placed.position, placed.position + placed.rotation * DVec3::new(0.08, 0.0, 0.0));
            }
            Joint::LeftHand | Joint::RightHand => {
                let sign = if joint == Joint::LeftHand { 1.0 } else { -1.0 };
                line(placed.position, placed.position + placed.rotation * DVec3::new(0.0, 0.1 * sign, -0.1));
            }
            Joint::LeftFoot | Joint::RightFoot => {
                line(placed.position, placed.position + placed.rotation * DVec3::new(-0.05, 0.0, -0.065));
            }
            _ => {}
        }
    }
}

/// Draws a body, seen from the side or from the front: triangles from far to near, shaded by their direction.
fn body(
    svg: &mut String,
    mesh: &Mesh,
    look: &Look,
    skeleton: &Skeleton,
    person: &Person,
    pose: &Pose,
    place: (DVec2, f64),
) {
    let (origin, turned) = place;
    let positions = mesh.posed(skeleton, person.height, &skeleton.world(pose));
    let colours = mesh.colours(look);
    let (sin, cos) = turned.sin_cos();
    // right, up, towards the eye
    let view = |p: DVec3| {
        let p = p - pose.hips.truncate().extend(0.0);
        DVec3::new(p.x * cos + p.y * sin, p.z, p.x * sin - p.y * cos)
    };
    let mut faces: Vec<(f64, String)> = Vec::new();
    for triangle in &mesh.triangles_of(look) {
        let [a, b, c] = triangle.map(|vertex| view(positions[vertex as usize]));
        let normal = (b - a).cross(c - a).normalize_or_zero();
        if normal.z <= 0.0 {
            continue;
        }
        let light = 0.45 + 0.55 * normal.dot(DVec3::new(-0.35, 0.6, 0.72).normalize()).max(0.0);
        let [r, g, b_] = [0, 1, 2].map(|channel| {
            let sum: f64 = triangle.iter().map(|&vertex| f64::from(colours[vertex as usize][channel])).sum();
            (sum / 3.0 * light) as u8
        });
        let point = |p: DVec3| format!("{:.1},{:.1}", origin.x + p.x * SCALE, origin.y - p.y * SCALE);
        let fill = format!("#{r:02x}{g:02x}{b_:02x}");
        faces.push((
            a.z + b.z + c.z,
            format!(
                r#"<polygon points="{} {} {}" fill="{fill}" stroke="{fill}" stroke-width="0.6"/>"#,
                point(a),
                point(b),
                point(c)
            ),
        ));
    }
    faces.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, face) in faces {
        svg.push_str(&face);
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| ".".into());
    let person = Person { arms: 1.0, ..Person::new(3, 4) }.with_build(Build::Man).with_height(1.78);
    let skeleton = Skeleton::new(&person);
    let rows = [
        ("0.5 m/s", 0.5, 0.0, 0.0, 1.6),
        ("1.3 m/s", 1.3, 0.0, 0.0, 1.1),
        ("1.8 m/s", 1.8, 0.0, 0.0, 0.95),
        ("3 m/s", 3.0, 0.0, 0.0, 0.78),
        ("turning", 0.0, 0.0, 1.2, 1.4),
        ("backwards", -0.6, 0.0, 0.0, 1.1),
        ("standing", 0.0, 0.0, 0.0, 6.0),
    ];
    let columns = 13;
    let mut svg = format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="{}" height="{}"><rect width="100%" height="100%" fill="#fff"/>"##,
        170 * columns,
        290 * rows.len() * 2
    );
    for (row, &(name, forward, left, turning, cycle)) in rows.iter().enumerate() {
        let walk = Walk::recorded(&person, &driven(forward, left, turning))?;
        for front in [false, true] {
            let ground = 270.0 + 290.0 * (2 * row + usize::from(front)) as f64;
            let _ = writeln!(svg, r##"<text x="8" y="{}" font-size="14">{name}</text>"##, ground - 240.0);
            let _ = writeln!(svg, r##"<line x1="0" x2="2400" y1="{ground}" y2="{ground}" stroke="#999"/>"##);
            for column in 0..columns {
                let time = 1.5 + cycle * column as f64 / (columns - 1) as f64;
                let pose = walk.pose(time);
                let origin = DVec2::new(85.0 + 170.0 * column as f64, ground);
                let hips = pose.hips;
                bones(&mut svg, &skeleton, &pose, origin, |point| {
                    let away = point - hips;
                    DVec2::new(if front { away.y } else { away.x }, -point.z)
                });
            }
        }
    }
    svg.push_str("</svg>\n");
    let path = std::path::Path::new(&folder).join("bones.svg");
    std::fs::write(&path, svg)?;
    println!("{}", path.display());

    let mut svg = format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="{}" height="{}"><rect width="100%" height="100%" fill="#dde3e8"/>"##,
        150 * 10,
        270 * 6
    );
    for (row, &(_, forward, left, turning, cycle)) in rows[..4].iter().chain(&rows[6..]).enumerate() {
        let build = [Build::Man, Build::Woman, Build::Man, Build::Woman, Build::Child][row];
        let person = person.with_build(build).with_height([1.78, 1.66, 1.78, 1.66, 1.2][row]);
        let skeleton = Skeleton::new(&person);
        let walk = Walk::recorded(&person, &driven(forward, left, turning))?;
        for column in 0..10 {
            let level = Level::ALL[if row == 4 { column / 2 % 4 } else { 0 }];
            let pose = walk.pose(1.5 + cycle * column as f64 / 9.0);
            let turned = if row == 4 { 0.7 * column as f64 } else { [0.0, 0.5, 0.9, 0.0][row] };
            let origin = DVec2::new(75.0 + 150.0 * column as f64, 262.0 + 270.0 * row as f64);
            let look = Look::new((row * 3 + column / 5) as u8);
            body(&mut svg, &Mesh::new(build, level), &look, &skeleton, &person, &pose, (origin, turned));
        }
    }
    for column in 0..10 {
        let build = if column % 2 == 0 { Build::Man } else { Build::Woman };
        let person = person.with_build(build);
        let skeleton = Skeleton::new(&person);
        let walk = Walk::recorded(&person, &driven(0.0, 0.0, 0.0))?;
        let pose = if column < 2 { skeleton.rest() } else { walk.pose(2.0) };
        let mesh =
            Mesh::new(build, [Level::Fine, Level::Fine, Level::Medium, Level::Coarse, Level::Blocks][column / 2]);
        let origin = DVec2::new(75.0 + 150.0 * column as f64, 262.0 + 270.0 * 5.0);
        body(
            &mut svg,
            &mesh,
            &Look::new(column as u8 + 3),
            &skeleton,
            &person,
            &pose,
            (origin, 1.57 - 0.3 * (column / 2) as f64),
        );
    }
    svg.push_str("</svg>\n");
    let path = std::path::Path::new(&folder).join("bodies.svg");
    std::fs::write(&path, svg)?;
    println!("{}", path.display());
    Ok(())
}
