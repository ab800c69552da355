//! The goals, by name.

use super::choice::{Catalogue, Choice, Described};
use super::entries::{Entries, Entry};
use super::given::{FileGiven, made_by_plugin, read_value};
use super::goal_rule::GoalRule;
use super::goal_tree::{GoalOfEach, GoalTree, SharedGoal};
use super::schema::of_parameters;
use crate::file::{Path, Problem};
use crate::scene::Annulus;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::Value as Json;
use std::cell::Cell;
use std::sync::Arc;
use throng::parameters::Parameters;
use toml::Value;

/// Where the agents of a group go: the name of a goal, and what its table says.
///
/// ```
/// use throng_scene::{Goal, PointGoal};
/// let goal: Goal = PointGoal::from([5.0, 0.0]).into();
/// assert_eq!((goal.name.as_str(), goal.read::<PointGoal>().map(|goal| goal.at)), ("point", Some([5.0, 0.0])));
/// ```
pub type Goal = Choice<Goals>;

/// The goals that scene files can name: those of throng, then those that a program adds.
#[derive(Clone, Debug)]
pub struct Goals(Entries<GoalKind>);

/// A kind of goals.
#[derive(Clone, Copy)]
struct GoalKind {
    make: fn(&Value, &GoalContext<'_>) -> Result<GoalTree, Problem>,
    /// Checks the keys and the kinds of values, without those of goals in it.
    check_keys: fn(&Value, &Path) -> Result<(), Problem>,
    /// Returns the goals in what the scene says, each with its path.
    parts: fn(&Value) -> Vec<(Path, Goal)>,
}

/// What goals are made from, besides their parameters.
#[derive(Clone)]
pub(crate) struct GoalContext<'a> {
    /// The goals that the scene can name.
    pub goals: &'a Goals,
    /// The walkable ground, if it is a ring.
    pub ring: Option<Annulus>,
    /// The number of agents.
    pub n: usize,
    /// The number of rules so far that give each agent its goal.
    pub rules: &'a Cell<u64>,
    /// Whether the goal is a stop of a journey.
    pub is_stop: bool,
    /// The path to the goal in the scene.
    pub path: Path,
}

/// A description from which a goal is made.
pub(crate) trait BuildGoal {
    fn make(self, at: &GoalContext) -> Result<GoalTree, Problem>;

    /// Returns the goals of which it is made, each with its path.
    fn parts(&self) -> Vec<(Path, &Goal)> {
        vec![]
    }
}

impl GoalContext<'_> {
    /// Returns the goal that the scene chooses at a path.
    pub fn make(&self, goal: &Goal, path: Path) -> Result<GoalTree, Problem> {
        self.goals.make(goal, &Self { path, ..self.clone() })
    }

    /// Returns a goal of all agents. `what` is its name in messages.
    pub fn same(&self, goal: throng::Goal, what: &'static str) -> GoalTree {
        GoalTree::Same(self.shared(goal, what))
    }

    /// Returns a goal that agents share. `what` is its name in messages.
    pub fn shared(&self, goal: throng::Goal, what: &'static str) -> SharedGoal {
        SharedGoal { goal, path: self.path.clone(), what }
    }

    /// Returns a goal for each agent. `shared` are the goals among them that agents share. `name` is that of the rule.
    pub fn each(&self, rule: impl GoalRule + 'static, name: &str, shared: Vec<SharedGoal>) -> GoalTree {
        let (path, what) = (self.path.clone(), what(name));
        let number = self.rules.replace(self.rules.get() + 1);
        GoalTree::Each(GoalOfEach { rule: Arc::new(rule), path, what, is_stop: self.is_stop, number }, shared)
    }
}

impl Goals {
    /// Adds a goal of a plug-in, or replaces the goal with the same name. A panic in it names it.
    pub(super) fn add_plugin<G: GoalRule + Parameters + 'static>(&mut self) {
        let make = GoalKind {
            make: |given, at| {
                let rule: G = made_by_plugin(&at.path, &what(G::NAME), || {
                    let rule: G = FileGiven::new(given, &at.path).parameters()?;
                    rule.check()?;
                    Ok(rule)
                })?;
                Ok(at.each(rule, G::NAME, vec![]))
            },
            check_keys: |given, at| FileGiven::new(given, at).without_limits().parameters::<G>().map(drop),
            parts: |_| vec![],
        };
        self.0.add(Entry { name: G::NAME.into(), about: G::ABOUT, is_plugin: true, schema: of_parameters::<G>, make });
    }

    /// Adds a goal of throng, which a scene describes as a `D`.
    pub(crate) fn add_own<D: Described + JsonSchema + BuildGoal>(&mut self, about: &'static str) {
        let make = GoalKind {
            make: |given, at| read_value::<D>(given, &at.path)?.make(at),
            check_keys: |given, at| read_value::<D>(given, at).map(drop),
            parts: |given| {
                let described: Option<D> = given.clone().try_into().ok();
                let parts = described.iter().flat_map(BuildGoal::parts);
                parts.map(|(path, goal)| (path, goal.clone())).collect()
            },
        };
        let schema = |generator: &mut SchemaGenerator| generator.subschema_for::<D>();
        self.0.add(Entry { name: D::NAME.into(), about, is_plugin: false, schema, make });
    }

    /// Returns the names of all goals.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.names()
    }

    /// Makes the goal that a scene chooses. The path of the context is that of the choice.
    pub(crate) fn make(&self, goal: &Goal, at: &GoalContext<'_>) -> Result<GoalTree, Problem> {
        let path = at.path.name(&goal.name);
        let entry = self.0.find(&goal.name, &path)?;
        (entry.make.make)(&goal.parameters, &GoalContext { path, ..at.clone() })
    }

    /// Checks that the goal of a choice, and the goals in it, as far as they are known, have the given parameters and can
    /// read them.
    pub(crate) fn check_keys(&self, goal: &Goal, at: &Path) -> Result<(), Problem> {
        let at = at.name(&goal.name);
        let Some(entry) = self.0.get(&goal.name) else { return Ok(()) };
        (entry.make.check_keys)(&goal.parameters, &at)?;
        let parts = (entry.make.parts)(&goal.parameters);
        parts.iter().try_for_each(|(path, part)| self.check_keys(part, &at.join(path)))
    }

    /// Returns the goals of which a goal is made, each with its path below the goal.
    ///
    /// ```
    /// use throng_scene::{Goal, Plugins};
    /// let goal: Goal = toml::from_str("journey = [{ goal.point = [5, 0] }, { goal.nearest = [{ point = [9, 9] }] }]")?;
    /// let goals = Plugins::new().goals;
    /// let parts = goals.parts(&goal);
    /// assert_eq!(parts[0], ("journey.0.goal".to_owned(), toml::from_str("point = [5, 0]")?));
    /// assert_eq!(goals.parts(&parts[1].1)[0].0, "nearest.0");
    /// # Ok::<(), toml::de::Error>(())
    /// ```
    pub fn parts(&self, goal: &Goal) -> Vec<(String, Goal)> {
        let Some(entry) = self.0.get(&goal.name) else { return vec![] };
        let at = Path::default().name(&goal.name);
        let parts = (entry.make.parts)(&goal.parameters);
        parts.into_iter().map(|(path, part)| (at.join(&path).dotted(), part)).collect()
    }

    /// Returns the name of each goal of a plug-in, and the schema of its choice.
    pub(super) fn plugin_schemas(&self, generator: &mut SchemaGenerator) -> Vec<(&str, Json)> {
        self.0.plugin_schemas(generator)
    }
}

impl Default for Goals {
    /// Returns the goals of throng.
    fn default() -> Self {
        let mut goals = Self(Entries::default());
        crate::scene::goal::register(&mut goals);
        goals
    }
}

impl Catalogue for Goals {
    const NAME: &'static str = "Goal";
    const EXAMPLE: &'static str = "goal.point = [5, 0]";

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        Self::default().0.schema("Where the agents of a group go.", generator)
    }
}

/// Returns the kind and name of a goal, for messages.
fn what(name: &str) -> String {
    format!("goal `{name}`")
}
