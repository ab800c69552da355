//! The fuzzing targets: one for each kind of input that users can pass to the programs or the library.

mod faulty;
mod fields;
mod places;
mod scenes;
mod scratch;
mod seal;
mod tracks;

use std::fmt;

/// A kind of input.
#[derive(Clone, Copy)]
pub struct Target {
    /// The name, also of its folder in `corpus`.
    pub name: &'static str,
    /// The group of the target.
    pub group: &'static str,
    /// A description of the inputs.
    pub about: &'static str,
    /// The ending of file names, without the dot.
    pub ending: &'static str,
    /// Folders of this repository, relative to this crate, with more seed files, and the endings of their names.
    pub elsewhere: &'static [(&'static str, &'static str)],
    /// Corrects the checksums of an input.
    pub seal: Option<fn(&mut [u8])>,
    /// Reads an input and uses its data. An error is a rejection with its message; a panic is a bug in a reader.
    pub run: fn(&[u8]) -> Result<(), String>,
}

impl fmt::Debug for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Target({})", self.name)
    }
}

/// Returns a target without checksums and other folders.
const fn plain(
    group: &'static str,
    name: &'static str,
    ending: &'static str,
    about: &'static str,
    run: fn(&[u8]) -> Result<(), String>,
) -> Target {
    Target { name, group, about, ending, elsewhere: &[], seal: None, run }
}

/// All targets, by group.
pub const TARGETS: &[Target] = &[
    plain("tables", "csv", "csv", "trajectories: a table", |bytes| tracks::read("csv", bytes)),
    plain("tables", "obsmat", "txt", "trajectories: UCY's obsmat", |bytes| tracks::read("txt", bytes)),
    plain("tables", "archive", "txt", "trajectories: text of the Pedestrian Dynamics Data Archive", |bytes| {
        tracks::read("txt", bytes)
    }),
    plain("tables", "vadere", "traj", "trajectories: Vadere's", |bytes| tracks::read("traj", bytes)),
    plain("tables", "usda", "usda", "trajectories: Universal Scene Description", |bytes| tracks::read("usda", bytes)),
    plain("tables", "bvh", "bvh", "people: Biovision hierarchy", |bytes| tracks::people("bvh", bytes)),
    plain("tables", "usda-people", "usda", "people: Universal Scene Description", |bytes| {
        tracks::people("usda", bytes)
    }),
    plain("tables", "map", "xml", "maps of data sets: OpenTraj's map.xml", places::map),
    plain("tables", "groups", "txt", "groups of data sets: groups.txt", places::groups),
    Target {
        seal: Some(seal::rec),
        ..plain(
            "binary",
            "rec",
            "rec",
            "trajectories: throng's own, read whole and in parts, and appended to",
            tracks::rec,
        )
    },
    plain("binary", "parquet", "parquet", "trajectories: Apache Parquet", |bytes| tracks::read("parquet", bytes)),
    plain("binary", "sqlite", "sqlite", "trajectories: JuPedSim's", |bytes| tracks::read("sqlite", bytes)),
    plain("binary", "glb", "glb", "trajectories: binary glTF", |bytes| tracks::read("glb", bytes)),
    plain("binary", "glb-people", "glb", "people: binary glTF", |bytes| tracks::people("glb", bytes)),
    plain("binary", "figure", "glb", "bodies of people: binary glTF with a skin", tracks::figure),
    plain("binary", "hdf5", "h5", "trajectories: HDF5 of the Pedestrian Dynamics Data Archive", |bytes| {
        tracks::read("h5", bytes)
    }),
    Target {
        elsewhere: &[("../../scenes", "toml")],
        ..plain(
            "scenes",
            "scene",
            "toml",
            "scene files: read, written, built, and advanced by some steps",
            scenes::scene,
        )
    },
    plain("scenes", "set", "txt", "changes: a gallery scene, then a line KEY=VALUE per change", scenes::set),
    plain("scenes", "sweep", "toml", "plans of sweeps: read, and the first run made for some steps", scenes::sweep),
    plain("plans", "wkt", "wkt", "floor plans: well-known text", |bytes| places::plan("input.wkt", bytes)),
    plain("plans", "geojson", "geojson", "floor plans: GeoJSON", |bytes| places::plan("input.geojson", bytes)),
    Target {
        elsewhere: &[("../throng-scene/tests/plans", "dxf")],
        ..plain("plans", "dxf", "dxf", "floor plans: DXF", |bytes| places::plan("input.dxf", bytes))
    },
    plain("plans", "svg", "svg", "floor plans: SVG", |bytes| places::plan("input.svg", bytes)),
    plain("plans", "obj", "obj", "triangle meshes: floor plans, and surfaces that behaviours steer by", places::obj),
    plain("projects", "jupedsim", "json", "JuPedSim scenarios in one file", |bytes| scenes::open("input.json", bytes)),
    plain("projects", "jupedsim-zip", "zip", "JuPedSim scenarios, zipped", |bytes| scenes::open("input.zip", bytes)),
    plain(
        "projects",
        "menge",
        "txt",
        "Menge's projects: their files after lines `--- NAME`, the first is opened",
        scenes::menge,
    ),
    Target {
        seal: Some(seal::png),
        ..plain("fields", "picture", "png", "PNG pictures as fields and maps", fields::picture)
    },
    plain("fields", "field-csv", "csv", "vector fields: tables", |bytes| fields::table("input.csv", bytes)),
    plain("fields", "field-txt", "txt", "vector fields: Menge's", |bytes| fields::table("input.txt", bytes)),
];

/// For the tests of the driver.
static FAULTY: [Target; 1] = [faulty::FAULTY];

impl Target {
    /// Returns the target of a name, including the target for the tests of the driver.
    pub fn named(name: &str) -> Option<&'static Self> {
        TARGETS.iter().chain(&FAULTY).find(|target| target.name == name)
    }
}

/// Returns the targets of these names or groups, each once, in the order of [`TARGETS`]; without names, all targets.
///
/// # Errors
/// A name is unknown.
pub(crate) fn chosen(names: &[String]) -> Result<Vec<&'static Target>, String> {
    if let [name] = names
        && name == FAULTY[0].name
    {
        return Ok(Target::named(name).into_iter().collect());
    }
    if let Some(name) = names.iter().find(|name| !TARGETS.iter().any(|target| is(target, name))) {
        let all: Vec<&str> = TARGETS.iter().map(|target| target.name).collect();
        return Err(format!("there is no target or group `{name}`\n  hint: the targets are: {}", all.join(", ")));
    }
    let wanted = |target: &&Target| names.is_empty() || names.iter().any(|name| is(target, name));
    Ok(TARGETS.iter().filter(wanted).collect())
}

fn is(target: &Target, name: &str) -> bool {
    target.name == name || target.group == name
}
