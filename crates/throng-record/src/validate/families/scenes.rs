//! The scenes of the families. Densities permit pedestrians to walk, and goals have room for their agents.

use super::pose::Pose;
use std::fmt::Write;
use throng_scene::Random;

/// Free speeds.
const SPEED: &str = "speed.preferred = { normal = { mean = 1.34, deviation = 0.2 } }";

/// Returns the time limit of a scene, seconds: several times what pedestrians need for the way and for a door.
fn limit(way: f64, agents: f64, width: f64) -> f64 {
    // the slowest pedestrian walks 0.74 m/s; the flow through a door is 1.6 per m and s
    60.0 + 3.0 * (way / 0.74 + agents / (1.6 * (width - 0.2)))
}

fn whole(random: &mut Random, least: f64, most: f64) -> f64 {
    random.between(least, most + 1.0).floor().min(most)
}

/// A ring of 25 to 80 m and 1.2 to 4 m of width, 0.3 to 1.5 agents per m².
pub fn circulation(random: &mut Random, pose: &Pose) -> String {
    let (length, width) = (random.between(25.0, 80.0), random.between(1.2, 4.0));
    let width = width.min(0.2 * length);
    let density = random.between(0.3, 1.5);
    let radius = length / std::f64::consts::TAU;
    let agents = (density * length * width).floor().min(150.0);
    let ring = format!(
        "center = {}, inner = {:.4}, outer = {:.4}",
        pose.point(0.0, 0.0),
        radius - 0.5 * width,
        radius + 0.5 * width
    );
    let clockwise = random.unit() < 0.5;
    format!(
        "time = {{ step = 0.04, until = \"limit\", limit = 90 }}\nwalkable.ring = {{ {ring} }}\n\n\
         [[group]]\ncount = {agents}\nplace.walkable = {{}}\ngoal.lap = {{ clockwise = {clockwise} }}\n{SPEED}\n"
    )
}

/// Four crowds in the corners of a square that walk around a pillar, all in the same direction.
pub fn compact_loop(random: &mut Random, pose: &Pose) -> String {
    let (radius, each) = (random.between(1.5, 4.0), whole(random, 5.0, 30.0));
    let corner = radius + 1.0;
    let mut out = format!(
        "time = {{ step = 0.05, until = \"limit\", limit = 90 }}\n\n[[obstacle]]\nshape.circle = {{ center = {}, radius = {radius:.3} }}\n",
        pose.point(0.0, 0.0)
    );
    let reach = radius + 6.0;
    let gates = [
        pose.rectangle([-0.3, radius], [0.3, reach]),
        pose.rectangle([-reach, -0.3], [-radius, 0.3]),
        pose.rectangle([-0.3, -reach], [0.3, -radius]),
        pose.rectangle([radius, -0.3], [reach, 0.3]),
    ];
    for (k, [x, y]) in [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].into_iter().enumerate() {
        let low = [(x * corner).min(x * (corner + 5.0)), (y * corner).min(y * (corner + 5.0))];
        let place = pose.rectangle(low, [low[0] + 5.0, low[1] + 5.0]);
        let stops: Vec<String> =
            (0..4).map(|stop| format!("{{ goal.area.rectangle = {} }}", gates[(k + stop) % 4])).collect();
        let _ = write!(
            out,
            "\n[[group]]\ncount = {each}\nplace.rectangle = {place}\ngoal.cycle = [{}]\n{SPEED}\n",
            stops.join(", ")
        );
    }
    out
}

/// A corridor with a bend, of the same width before and after it.
pub fn bend(random: &mut Random, pose: &Pose) -> String {
    let width = random.between(1.4, 5.0);
    let (before, behind) = (random.between(12.0, 26.0), random.between(8.0, 26.0));
    let density = random.between(0.5, 2.5);
    let agents = (density * (before - 1.0) * (width - 0.4)).floor().clamp(2.0, 160.0);
    let corners = [
        [0.0, 0.0],
        [before + width, 0.0],
        [before + width, width + behind],
        [before, width + behind],
        [before, width],
        [0.0, width],
    ];
    format!(
        "time = {{ step = 0.05, until = \"empty\", limit = {:.0} }}\n[walkable.polygon]\nouter = {}\n\n[[group]]\ncount = {agents}\nplace.rectangle = {}\n\
         goal.exit.rectangle = {}\n{SPEED}\n",
        limit(before + behind, agents, width),
        pose.points(&corners),
        pose.rectangle([0.2, 0.2], [before - 0.2, width - 0.2]),
        pose.rectangle([before, width + behind - 1.5], [before + width, width + behind]),
    )
}

/// A corridor; all agents walk to an area at its end that has room for them: at most 2.2 per m².
pub fn plug(random: &mut Random, pose: &Pose) -> String {
    let (width, length) = (random.between(1.6, 4.0), random.between(4.0, 10.0));
    let density = random.between(0.5, 2.2);
    let agents = (density * width * length).floor().clamp(2.0, 80.0);
    let start = agents / (1.5 * (width - 0.1)) + 1.0;
    let end = start + random.between(4.0, 15.0) + length;
    format!(
        "time = {{ step = 0.04, until = \"arrived\", limit = {:.0} }}\nwalkable.rectangle = {}\n\n[[group]]\ncount = {agents}\nplace.rectangle = {}\n\
         goal.area.rectangle = {}\n{SPEED}\n",
        limit(end, agents, width),
        pose.rectangle([0.0, 0.0], [end, width]),
        pose.rectangle([0.2, 0.05], [start, width - 0.05]),
        pose.rectangle([end - length, 0.0], [end, width]),
    )
}

/// A bus of 10 m at a stop: some agents get off, some get on, through a door of 0.9 to 1.6 m.
pub fn bus(random: &mut Random, pose: &Pose) -> String {
    let (off, on) = (whole(random, 3.0, 18.0), whole(random, 3.0, 18.0));
    let half = 0.5 * random.between(0.9, 1.6);
    let outer = [
        [-6.0, -4.0],
        [6.0, -4.0],
        [6.0, -0.1],
        [half, -0.1],
        [half, 0.1],
        [5.0, 0.1],
        [5.0, 2.4],
        [-5.0, 2.4],
        [-5.0, 0.1],
        [-half, 0.1],
        [-half, -0.1],
        [-6.0, -0.1],
    ];
    format!(
        "time = {{ step = 0.04, until = \"arrived\", limit = {:.0} }}\n[walkable.polygon]\nouter = {}\n\n\
         [[group]]\nname = \"off\"\ncount = {off}\nplace.rectangle = {}\ngoal.exit.rectangle = {}\n{SPEED}\n\n\
         [[group]]\nname = \"on\"\ncount = {on}\nplace.rectangle = {}\ngoal.area.rectangle = {}\n{SPEED}\n",
        limit(15.0, off + on, 2.0 * half),
        pose.points(&outer),
        pose.rectangle([-4.8, 0.3], [4.8, 2.2]),
        pose.rectangle([-6.0, -4.0], [6.0, -3.0]),
        pose.rectangle([-4.5, -2.5], [4.5, -0.4]),
        pose.rectangle([-5.0, 0.1], [5.0, 2.4]),
    )
}

/// Two crowds of 0.4 to 1.9 per m² each, with bodies of 0.13 to 0.2 m, that walk through each other in a corridor of
/// 1.5 to 6 m.
pub fn counterflow(random: &mut Random, pose: &Pose) -> String {
    let (width, density) = (random.between(1.5, 6.0), random.between(0.4, 1.9));
    let radius = random.between(0.13, 0.2);
    let each = whole(random, 5.0, 80.0);
    let length = each / (density * width);
    let end = length + 8.0;
    let half = 0.5 * width;
    let place = |from: f64, to: f64| pose.rectangle([from, 0.05 - half], [to, half - 0.05]);
    let exit = |from: f64, to: f64| pose.rectangle([from, -half], [to, half]);
    format!(
        "time = {{ step = 0.04, until = \"empty\", limit = {:.0} }}\nwalkable.rectangle = {}\n\n\
         [[group]]\nname = \"east\"\ncount = {each}\nplace.rectangle = {}\ngoal.exit.rectangle = {}\nbody.radius = {radius:.3}\n{SPEED}\n\n\
         [[group]]\nname = \"west\"\ncount = {each}\nplace.rectangle = {}\ngoal.exit.rectangle = {}\nbody.radius = {radius:.3}\n{SPEED}\n",
        limit(2.0 * end, 2.0 * each, width),
        exit(-end, end),
        place(-2.0 - length, -2.0),
        exit(end - 3.0, end),
        place(2.0, 2.0 + length),
        exit(-end, 3.0 - end),
    )
}

/// A crowd in a square room with a gate of 1 to 6 m in its middle wall.
pub fn gate(random: &mut Random, pose: &Pose) -> String {
    let (half, side) = (0.5 * random.between(1.0, 6.0), random.between(14.0, 30.0));
    let agents = whole(random, 20.0, 180.0).min((0.5 * side * side * 0.5).floor());
    let reach = 0.5 * side;
    format!(
        "time = {{ step = 0.05, until = \"empty\", limit = {:.0} }}\nwalkable.rectangle = {}\n\n[[obstacle]]\nshape.wall = {}\n\n[[obstacle]]\nshape.wall = {}\n\n\
         [[group]]\ncount = {agents}\nplace.rectangle = {}\ngoal.exit.rectangle = {}\n{SPEED}\n",
        limit(side, agents, 2.0 * half),
        pose.rectangle([-reach, -reach], [reach, reach]),
        pose.points(&[[0.0, -reach], [0.0, -half]]),
        pose.points(&[[0.0, half], [0.0, reach]]),
        pose.rectangle_with([-reach + 0.5, -reach + 0.5], [-0.8, reach - 0.5], "gap = 0.05"),
        pose.rectangle([reach - 3.0, -0.4 * side], [reach, 0.4 * side]),
    )
}

/// Long bodies on up to a sixth of the ground that walk to the opposite place. The bodies of every second crowd have a
/// turn rate, so they move only in the direction they face.
pub fn planks(random: &mut Random, pose: &Pose) -> String {
    let (side, length, width) = (random.between(12.0, 20.0), random.between(0.8, 1.6), random.between(0.4, 0.6));
    let share = random.between(0.03, 0.17);
    let count = (share * side * side / (length * width)).floor().clamp(2.0, 60.0);
    let turns = if random.between(0.0, 1.0) < 0.5 {
        format!("turn_rate = {:.0}\n", random.between(90.0, 720.0))
    } else {
        String::new()
    };
    let half = 0.5 * side;
    let room = half - 0.5 * length - 0.2;
    let place = pose.rectangle([-room, -room], [room, room]);
    format!(
        "time = {{ step = 0.05, until = \"arrived\", limit = {:.0} }}\nwalkable.rectangle = {}\n\n[[group]]\ncount = {count}\nplace.rectangle = {place}\n\
         goal.opposite = {{ center = {}, tolerance = 0.5 }}\nbody.rectangle = {{ length = {length:.3}, width = {width:.3} }}\nheading = {:.3}\n{turns}{SPEED}\n",
        limit(side, count, 2.0),
        pose.rectangle([-half, -half], [half, half]),
        pose.point(0.0, 0.0),
        pose.degrees() + random.between(-180.0, 180.0),
    )
}
