//! USD written.

use crate::formats::mesh::{self, Mesh};
use crate::formats::spill::{Spill, State};
use crate::formats::{PROGRAM, Writer};
use crate::{Frame, Output, OutputError, Setting};
use glam::Vec3;
use std::fmt::Write;

/// Time codes a second where moments come unevenly.
const CODES: f64 = 24.0;
/// Height of a body that walks, metres.
const HEIGHT: f32 = 1.75;

/// Collects trajectories as they happen, and writes them at the end. See the [module](super) for the prims.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("run.usda");
/// use throng_record::formats::usda::UsdaWriter;
/// use throng_record::{Frame, Output, Setting, Writer};
/// let mut writer = UsdaWriter::new(Output::create(&path)?, &Setting::default())?;
/// writer.push(&Frame::default())?;
/// Box::new(writer).finish()?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct UsdaWriter {
    output: Output,
    setting: Setting,
    spill: Spill,
}

/// What is listed of everybody at a moment.
type List = fn(&mut String, &State);

impl UsdaWriter {
    /// Begins to collect.
    ///
    /// # Errors
    /// The system's, such as a full disk.
    pub fn new(output: Output, setting: &Setting) -> Result<Self, OutputError> {
        let spill = Spill::new(&output, setting)?;
        Ok(Self { output, setting: setting.clone(), spill })
    }

    /// What comes before the people.
    fn head(&mut self) -> Result<(), OutputError> {
        let (setting, codes) = (&self.setting, self.codes());
        let [first, last] = [self.spill.moments.first(), self.spill.moments.last()]
            .map(|moment| code(moment.map_or(0.0, |&(time, _)| time), codes));
        let (title, program) = (quoted(&setting.title), quoted(PROGRAM));
        let groups = list(setting.groups.iter(), |out, name| out.push_str(&quoted(name)));
        let origin = setting.origin;
        let text = format!(
            "#usda 1.0\n(\n    customLayerData = {{\n        string title = {title}\n        string program = {program}\n    }}\n    \
             defaultPrim = \"World\"\n    endTimeCode = {last}\n    framesPerSecond = {codes}\n    metersPerUnit = 1\n    \
             startTimeCode = {first}\n    timeCodesPerSecond = {codes}\n    upAxis = \"Z\"\n)\n\ndef Xform \"World\"\n{{\n    \
             custom string[] throng:groups = {groups}\n    double3 xformOp:translate = ({}, {}, 0)\n    \
             uniform token[] xformOpOrder = [\"xformOp:translate\"]\n",
            origin.x, origin.y
        );
        let ground = mesh::ground(setting, self.spill.seen);
        let meshes = [("Ground", ground, [0.8; 3]), ("Obstacles", mesh::solids(setting), [0.35; 3])];
        let meshes = meshes.iter().filter(|(_, mesh, _)| !mesh.points.is_empty());
        let meshes: String = meshes.map(|(name, mesh, color)| self::mesh(name, mesh, *color)).collect();
        self.output.put(text.as_bytes())?;
        self.output.put(meshes.as_bytes())
    }

    fn codes(&self) -> f64 {
        self.spill.rate.even().unwrap_or(CODES)
    }

    /// The people, and what they look like.
    fn people(&mut self) -> Result<(), OutputError> {
        let agents = &self.spill.agents;
        let groups = agents.iter().map(|agent| agent.group as usize + 1).max().unwrap_or(0);
        let groups = groups.max(self.setting.groups.len());
        let prototype = |k: usize| format!("</World/Agents/Prototypes/Group_{k}>");
        let whole = |out: &mut String, value: u32| out.push_str(&value.to_string());
        let numbers = list(agents.iter().map(|agent| agent.number), whole);
        let of = list(agents.iter().map(|agent| agent.group), whole);
        let flies = self.setting.in_space;
        let scales = list(agents.iter(), |out, agent| {
            let wide = Vec3::splat(agent.radius);
            triple(out, if flies { wide } else { wide.with_z(1.0) }, 4);
        });
        let mut text = format!(
            "\n    def PointInstancer \"Agents\"\n    {{\n        int64[] ids = {numbers}\n        int[] protoIndices = {of}\n        \
             rel prototypes = {}\n        float3[] scales = {scales}\n        int[] primvars:group = {of} (\n            \
             interpolation = \"vertex\"\n        )\n",
            list(0..groups, |out, k| out.push_str(&prototype(k)))
        );
        text.push_str("\n        def Scope \"Prototypes\"\n        {\n");
        (0..groups).for_each(|k| text.push_str(&self.prototype(k)));
        text.push_str("        }\n");
        self.output.put(text.as_bytes())
    }

    /// What everybody of a group looks like: of radius 1 across, and as high as they are.
    fn prototype(&self, group: usize) -> String {
        let name = self.setting.group_name(group as u32);
        let (body, lift, front) = if self.setting.in_space {
            ("def Sphere \"Body\"".to_owned(), 0.0, 0.0)
        } else {
            ("def Cylinder \"Body\"".to_owned(), HEIGHT * 0.5, HEIGHT * 0.9)
        };
        let size = if self.setting.in_space {
            "double radius = 1".to_owned()
        } else {
            format!(
                "uniform token axis = \"Z\"\n                    double height = {HEIGHT}\n                    double radius = 1"
            )
        };
        let color = list(std::iter::once(color(group)), |out, [r, g, b]| triple(out, Vec3::new(r, g, b), 3));
        let placed = |x: f32, z: f32| {
            format!(
                "color3f[] primvars:displayColor = {color}\n                    double3 xformOp:translate = ({x}, 0, {z})\n                    \
                 uniform token[] xformOpOrder = [\"xformOp:translate\"]"
            )
        };
        format!(
            "            def Xform \"Group_{group}\"\n            {{\n                custom string throng:name = {}\n                \
             {body}\n                {{\n                    {size}\n                    {}\n                }}\n                \
             def Cone \"Front\"\n                {{\n                    uniform token axis = \"X\"\n                    \
             double height = 0.6\n                    double radius = 0.3\n                    {}\n                }}\n            }}\n",
            quoted(&name),
            placed(0.0, lift),
            placed(1.2, front)
        )
    }

    /// An attribute of everybody, moment by moment.
    fn samples(&mut self, name: &str, one: List) -> Result<(), OutputError> {
        self.moments(name, |_, states, _| list(states.iter(), one))
    }

    /// An attribute at every moment: of the numbers of everybody, their states, and whether they are there.
    fn moments(&mut self, name: &str, text: impl Fn(&[u32], &[State], &[bool]) -> String) -> Result<(), OutputError> {
        let codes = self.codes();
        let numbers: Vec<u32> = self.spill.agents.iter().map(|agent| agent.number).collect();
        let Self { output, spill, .. } = self;
        output.put(format!("        {name}.timeSamples = {{\n").as_bytes())?;
        let path = output.path().to_path_buf();
        spill.replay(
            |error| OutputError::new(&path, error),
            |_, time, states, there| {
                let value = text(&numbers, states, there);
                output.put(format!("            {}: {value},\n", code(time, codes)).as_bytes())
            },
        )?;
        output.put(b"        }\n")
    }
}

impl Writer for UsdaWriter {
    fn push(&mut self, frame: &Frame) -> Result<(), OutputError> {
        self.spill.push(frame).map_err(|error| self.output.error(error))
    }

    fn finish(mut self: Box<Self>) -> Result<(), OutputError> {
        self.head()?;
        self.people()?;
        self.samples("point3f[] positions", |out, state| triple(out, state.place, 4))?;
        self.samples("vector3f[] velocities", |out, state| triple(out, state.velocity, 3))?;
        self.samples("quath[] orientations", |out, state| {
            let (sin, cos) = (0.5 * state.heading).sin_cos();
            let _ = write!(out, "({cos:.5}, 0, 0, {sin:.5})");
        })?;
        self.output.put(b"        float[] primvars:speed (\n            interpolation = \"vertex\"\n        )\n")?;
        self.samples("float[] primvars:speed", |out, state| out.push_str(&format!("{:.3}", state.velocity.length())))?;
        self.moments("int64[] invisibleIds", |numbers, _, there| {
            let gone = numbers.iter().zip(there).filter(|(_, there)| !**there);
            list(gone, |out, (number, _)| out.push_str(&number.to_string()))
        })?;
        self.output.put(b"    }\n}\n")?;
        self.output.finish()
    }
}

/// A time as a time code, to a millionth.
fn code(time: f64, codes: f64) -> f64 {
    (time * codes * 1e6).round() / 1e6
}

/// A list of values.
fn list<T>(values: impl Iterator<Item = T>, mut one: impl FnMut(&mut String, T)) -> String {
    let mut out = String::from("[");
    for (k, value) in values.enumerate() {
        if k > 0 {
            out.push_str(", ");
        }
        one(&mut out, value);
    }
    out.push(']');
    out
}

fn triple(out: &mut String, value: Vec3, decimals: usize) {
    let _ = write!(out, "({:.decimals$}, {:.decimals$}, {:.decimals$})", value.x, value.y, value.z);
}

/// A text in quotes.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => out.extend(['\\', letter]),
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            other => out.push(other),
        }
    }
    out.push('"');
    out
}

/// Colours that go round the wheel by the golden section, so that those of few groups are far apart.
fn color(group: usize) -> [f32; 3] {
    let turn = (0.58 + 0.618_034 * group as f32).fract();
    [0.0, 1.0 / 3.0, 2.0 / 3.0].map(|shift| 0.5 + 0.35 * (std::f32::consts::TAU * (turn + shift)).cos())
}

fn mesh(name: &str, mesh: &Mesh, color: [f32; 3]) -> String {
    let counts = list(mesh.triangles.iter(), |out, _| out.push('3'));
    let indices = list(mesh.triangles.iter().flatten(), |out, at| out.push_str(&at.to_string()));
    let points = list(mesh.points.iter(), |out, &point| triple(out, point, 4));
    let color = list(std::iter::once(color), |out, [r, g, b]| triple(out, Vec3::new(r, g, b), 3));
    format!(
        "\n    def Mesh \"{name}\"\n    {{\n        uniform bool doubleSided = 1\n        int[] faceVertexCounts = {counts}\n        \
         int[] faceVertexIndices = {indices}\n        point3f[] points = {points}\n        \
         color3f[] primvars:displayColor = {color}\n        uniform token subdivisionScheme = \"none\"\n    }}\n"
    )
}
