//! Writes USD.

use super::people;
use super::text::{code, indented, list, quoted, triple, turn};
use super::{CODES, TIMES};
use crate::formats::by_agent::by_agent;
use crate::formats::mesh::{self, Mesh};
use crate::formats::spill::{Spill, SpilledState, beside};
use crate::formats::{Writer, body, describe, keys};
use crate::people::{FigureStyle, People};
use crate::{Frame, Output, OutputError, Setting, color};
use std::fmt::Write as _;
use std::io::{self, Write as _};

/// Collects trajectories during a run and writes them at the end. The [module](super) describes the prims.
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
    style: FigureStyle,
}

/// Writes one agent's entry of a list.
type List = fn(&mut String, &SpilledState);

impl UsdaWriter {
    /// Starts to collect.
    ///
    /// # Errors
    /// A system error, such as a full disk.
    pub fn new(output: Output, setting: &Setting) -> Result<Self, OutputError> {
        let spill = Spill::new(&output, setting)?;
        Ok(Self { output, setting: setting.clone(), spill, style: FigureStyle::Auto })
    }

    /// Returns the writer, which writes people in this style; [`FigureStyle::Baked`] is as
    /// [`Skins`](FigureStyle::Skins).
    #[must_use]
    pub fn style(self, style: FigureStyle) -> Self {
        Self { style, ..self }
    }

    /// Writes everything before the agents.
    fn head(&mut self) -> io::Result<()> {
        let (setting, codes) = (&self.setting, self.codes());
        let moments = &self.spill.moments;
        let [first, last] =
            [moments.first(), moments.last()].map(|moment| code(moment.map_or(0.0, |&(time, _)| time), codes));
        let groups = list(setting.groups.iter(), |out, name| out.push_str(&quoted(name)));
        let said = describe::pairs(setting).into_iter().filter(|(key, _)| *key != keys::GROUPS);
        let said: String = said
            .map(|(key, value)| format!("    custom string {} = {}\n", key.replace('.', ":"), quoted(&value)))
            .collect();
        let times = list(moments.iter(), |out, (time, _)| out.push_str(&time.to_string()));
        let origin = setting.origin;
        let text = format!(
            "#usda 1.0\n(\n    defaultPrim = \"World\"\n    endTimeCode = {last}\n    framesPerSecond = {codes}\n    \
             metersPerUnit = 1\n    startTimeCode = {first}\n    timeCodesPerSecond = {codes}\n    upAxis = \"Z\"\n)\n\n\
             def Xform \"World\"\n{{\n{said}    custom string[] {} = {groups}\n    custom double[] {TIMES} = {times}\n    \
             double3 xformOp:translate = ({}, {}, 0)\n    uniform token[] xformOpOrder = [\"xformOp:translate\"]\n",
            keys::GROUPS.replace('.', ":"),
            origin.x,
            origin.y
        );
        let ground = mesh::ground(setting, self.spill.seen);
        let meshes = [("/World/Ground", ground, [0.6; 3]), ("/World/Obstacles", mesh::solids(setting), [0.1; 3])];
        let meshes = meshes.iter().filter(|(_, mesh, _)| !mesh.points.is_empty());
        let meshes: String = meshes.map(|(name, mesh, color)| self::mesh(name, mesh, *color, true, "    ")).collect();
        self.output.write_all(text.as_bytes())?;
        self.output.write_all(meshes.as_bytes())
    }

    fn codes(&self) -> f64 {
        self.spill.rate.even().unwrap_or(CODES)
    }

    /// Writes the agents' constant properties and their prototypes.
    fn agents(&mut self, people: &People) -> io::Result<()> {
        let agents = &self.spill.agents;
        let groups = agents.iter().map(|agent| agent.group as usize + 1).max().unwrap_or(0);
        let groups = groups.max(self.setting.groups.len());
        let prototype = |k: usize| format!("</World/Agents/Prototypes/Group_{k}>");
        let whole = |out: &mut String, value: u32| out.push_str(&value.to_string());
        let numbers = list(agents.iter().map(|agent| agent.number), whole);
        let of = list(agents.iter().map(|agent| agent.group), whole);
        let drawn = list(agents.iter().map(|agent| if people.has(agent) { groups as u32 } else { agent.group }), whole);
        let any = agents.iter().any(|agent| people.has(agent));
        let person = any.then(|| "</World/Agents/Prototypes/Person>".to_owned());
        let flies = self.setting.in_space;
        let scales = list(agents.iter(), |out, agent| triple(out, body::scale(agent.radius, flies), 4));
        let mut text = format!(
            "\n    def PointInstancer \"Agents\"\n    {{\n        int64[] ids = {numbers}\n        int[] protoIndices = {drawn}\n        \
             rel prototypes = {}\n        float3[] scales = {scales}\n        int[] primvars:group = {of} (\n            \
             interpolation = \"vertex\"\n        )\n",
            list((0..groups).map(prototype).chain(person), |out, path| out.push_str(&path))
        );
        text.push_str("\n        def Scope \"Prototypes\"\n        {");
        let body = body::mesh(flies);
        for group in 0..groups {
            let name = quoted(&self.setting.group_name(group as u32));
            let path = format!("/World/Agents/Prototypes/Group_{group}/Body");
            let mesh = mesh(&path, &body, color::linear(group), false, "                ");
            let _ = write!(
                text,
                "\n            def Xform \"Group_{group}\"\n            {{\n                custom string throng:name = {name}\n\
                 {mesh}            }}\n"
            );
        }
        if any {
            text.push_str("\n            def Xform \"Person\"\n            {\n            }\n");
        }
        text.push_str("        }\n");
        self.output.write_all(text.as_bytes())
    }

    /// Writes an attribute of all agents, frame by frame.
    fn samples(&mut self, name: &str, entry: List) -> io::Result<()> {
        self.moments(name, |_, states, _| list(states.iter(), entry))
    }

    /// Writes an attribute at every frame. `text` receives the numbers of all agents, their states (the nearest known
    /// state of absent agents), and whether they are present.
    fn moments(&mut self, name: &str, text: impl Fn(&[u32], &[SpilledState], &[bool]) -> String) -> io::Result<()> {
        let codes = self.codes();
        let numbers: Vec<u32> = self.spill.agents.iter().map(|agent| agent.number).collect();
        let mut states: Vec<SpilledState> = self.spill.agents.iter().map(|agent| agent.first).collect();
        let mut there = vec![false; states.len()];
        let Self { output, spill, .. } = self;
        writeln!(output, "        {name}.timeSamples = {{")?;
        let mut last = f64::NEG_INFINITY;
        spill.replay(|_, time, rows| {
            there.fill(false);
            for &(at, state) in rows {
                (states[at as usize], there[at as usize]) = (state, true);
            }
            // frames that round to the same code get distinct codes
            last = code(time, codes).max(last.next_up());
            writeln!(output, "            {last}: {},", text(&numbers, &states, &there))
        })?;
        output.write_all(b"        }\n")
    }

    fn write(&mut self) -> io::Result<()> {
        let people =
            People::of(self.style, &self.setting, &mut self.spill, &self.output)?.with_characters(&self.setting);
        self.head()?;
        self.agents(&people)?;
        self.samples("point3f[] positions", |out, state| triple(out, state.place, 4))?;
        self.samples("vector3f[] velocities", |out, state| triple(out, state.velocity, 3))?;
        self.samples("quath[] orientations", |out, state| turn(out, state.rotation))?;
        self.output
            .write_all(b"        float[] primvars:speed (\n            interpolation = \"vertex\"\n        )\n")?;
        self.samples("float[] primvars:speed", |out, state| out.push_str(&format!("{:.3}", state.velocity.length())))?;
        self.moments("int64[] invisibleIds", |numbers, _, there| {
            let gone = numbers.iter().zip(there).filter(|(_, there)| !**there);
            list(gone, |out, (number, _)| out.push_str(&number.to_string()))
        })?;
        self.output.write_all(b"    }\n")?;
        self.people(&people)?;
        // without a final line break, a file that is cut off lacks a brace
        self.output.write_all(b"}")
    }

    /// Writes the people.
    fn people(&mut self, crowd: &People) -> io::Result<()> {
        let agents = &self.spill.agents;
        if !agents.iter().any(|agent| crowd.has(agent)) {
            return Ok(());
        }
        let worn = agents.iter().filter_map(|agent| Some(crowd.body(agent, &crowd.person(agent)?)));
        let bodies = people::bodies(worn);
        let codes = self.codes();
        let mut last = f64::NEG_INFINITY;
        let mut grow = |&(time, _): &(f64, u32)| {
            last = code(time, codes).max(last.next_up());
            last
        };
        let (times, codes): (Vec<f64>, Vec<f64>) = self.spill.moments.iter().map(|at| (at.0, grow(at))).unzip();
        self.output.write_all(bodies.as_bytes())?;
        let (scratch, output) = (beside(&self.output)?, &mut self.output);
        by_agent(&mut self.spill, scratch, |agent, track| {
            let Some(walk) = crowd.walk(agent, track)? else { return Ok(()) };
            let body = crowd.body(agent, walk.person());
            let text = people::person(agent.number, (&walk, body), track, (&codes, &times));
            output.write_all(indented(&text, "        ").as_bytes())
        })?;
        self.output.write_all(b"    }\n")
    }
}

impl Writer for UsdaWriter {
    fn push(&mut self, frame: &Frame) -> Result<(), OutputError> {
        self.spill.push(frame).map_err(|error| self.output.error(error))
    }

    fn finish(mut self: Box<Self>) -> Result<(), OutputError> {
        self.write().map_err(|error| self.output.error(error))?;
        self.output.finish()
    }
}

/// Returns a mesh with its path, indented. Its colour is written twice: for programs that draw without materials, and
/// for programs that use them.
fn mesh(path: &str, mesh: &Mesh, color: [f32; 3], both_sides: bool, indent: &str) -> String {
    let name = path.rsplit('/').next().unwrap_or(path);
    let mut rgb = String::new();
    triple(&mut rgb, color.into(), 3);
    let counts = list(mesh.triangles.iter(), |out, _| out.push('3'));
    let indices = list(mesh.triangles.iter().flatten(), |out, at| out.push_str(&at.to_string()));
    let points = list(mesh.points.iter(), |out, &point| triple(out, point, 4));
    let both_sides = u8::from(both_sides);
    let text = format!(
        "
def Mesh \"{name}\" (
    prepend apiSchemas = [\"MaterialBindingAPI\"]
)
{{
    uniform bool doubleSided = {both_sides}
    int[] faceVertexCounts = {counts}
    int[] faceVertexIndices = {indices}
    rel material:binding = <{path}/Look>
    point3f[] points = {points}
    color3f[] primvars:displayColor = [{rgb}]
    uniform token subdivisionScheme = \"none\"

    def Material \"Look\"
    {{
        token outputs:surface.connect = <{path}/Look/Surface.outputs:surface>

        def Shader \"Surface\"
        {{
            uniform token info:id = \"UsdPreviewSurface\"
            color3f inputs:diffuseColor = {rgb}
            float inputs:roughness = 0.8
            token outputs:surface
        }}
    }}
}}
"
    );
    indented(&text, indent)
}
