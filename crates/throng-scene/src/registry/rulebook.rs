//! Rules that scene files refer to by name.

use crate::caught::{caught, named};
use crate::scene::SceneNames;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;
use throng::{Error, Rules, World};

/// Rules by name, for `rules = "name"`: those of the gallery's games, and those that a program adds.
///
/// ```
/// use throng::{Error, Rules, World};
/// use throng_scene::Scene;
///
/// /// Counts the steps.
/// #[derive(Debug)]
/// struct Clock;
///
/// impl Rules for Clock {
///     fn figures(&self) -> Vec<String> {
///         vec!["ticks".into()]
///     }
///
///     fn act(&self, _: &mut World, figures: &mut [f64]) -> Result<(), Error> {
///         figures[0] += 1.0;
///         Ok(())
///     }
/// }
///
/// let mut scene: Scene = r#"
///     rules = "clock"
///     [[group]]
///     place.point = [5, 0]
///     [expect]
///     figure = [{ of = "ticks", at_least = 10 }]
/// "#
/// .parse()?;
/// scene.plugins.rules.add("clock", |_| Ok(Clock));
/// let (mut world, _) = scene.build()?;
/// (0..10).for_each(|_| world.step());
/// assert_eq!(world.figure("ticks"), Some(10.0));
/// # Ok::<(), throng_scene::Error>(())
/// ```
#[derive(Clone)]
pub struct Rulebook(BTreeMap<String, Entry>);

/// Rules of a rulebook.
#[derive(Clone)]
struct Entry {
    /// What they do; empty for rules of a program.
    about: &'static str,
    make: MakeRules,
}

/// Rules that were made for a scene, or the error if the scene lacks what they need.
type MadeRules = Result<Arc<dyn Rules>, Error>;
/// Makes rules for a scene.
type MakeRules = Arc<dyn Fn(&SceneNames<'_>) -> MadeRules + Send + Sync>;

impl Default for Rulebook {
    /// Returns the rules of the gallery's games.
    fn default() -> Self {
        let mut book = Self(BTreeMap::new());
        crate::games::rules(&mut book);
        book
    }
}

impl Rulebook {
    /// Adds rules, or replaces the rules with the same name. `make` gets the names in the scene, and returns an error
    /// for anything that it needs and the scene lacks.
    pub fn add<R: Rules + 'static>(
        &mut self,
        name: impl Into<String>,
        make: impl Fn(&SceneNames<'_>) -> Result<R, Error> + Send + Sync + 'static,
    ) {
        self.insert(name.into(), "", make);
    }

    /// Adds rules of throng, and what they do, in one sentence.
    pub(crate) fn add_own<R: Rules + 'static>(
        &mut self,
        name: &str,
        about: &'static str,
        make: impl Fn(&SceneNames<'_>) -> Result<R, Error> + Send + Sync + 'static,
    ) {
        self.insert(name.to_owned(), about, make);
    }

    fn insert<R: Rules + 'static>(
        &mut self,
        name: String,
        about: &'static str,
        make: impl Fn(&SceneNames<'_>) -> Result<R, Error> + Send + Sync + 'static,
    ) {
        let of: Arc<str> = name.as_str().into();
        let make: MakeRules = Arc::new(move |cast| {
            named("rules", &of, || {
                let rules = make(cast)?;
                let named: Arc<dyn Rules> = Arc::new(NamedRules { name: of.clone(), figures: rules.figures(), rules });
                Ok(named)
            })
        });
        self.0.insert(name, Entry { about, make });
    }

    /// Adds the rules of another rulebook. They replace rules with the same names.
    pub fn extend(&mut self, others: Self) {
        self.0.extend(others.0);
    }

    /// Returns the names of all rules.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    /// Returns what the rules with this name do, in one sentence; empty for rules of a program. `None` if there are none.
    ///
    /// ```
    /// use throng_scene::Rulebook;
    /// let book = Rulebook::default();
    /// assert_eq!(book.about("soccer"), Some("Two teams kick the ball by touching it, and its goals count."));
    /// assert_eq!(book.about("chess"), None);
    /// ```
    pub fn about(&self, name: &str) -> Option<&str> {
        self.0.get(name).map(|entry| entry.about)
    }

    /// Returns the rules with this name, made for a scene; or the message of a panic in them.
    pub(crate) fn make(&self, name: &str, cast: &SceneNames<'_>) -> Option<Result<MadeRules, String>> {
        self.0.get(name).map(|entry| caught(|| (entry.make)(cast)))
    }
}

/// Rules of a plug-in: panics in them name them.
#[derive(Debug)]
struct NamedRules<R> {
    name: Arc<str>,
    figures: Vec<String>,
    rules: R,
}

impl<R: Rules> Rules for NamedRules<R> {
    fn figures(&self) -> Vec<String> {
        self.figures.clone()
    }

    fn begin(&self, world: &mut World, figures: &mut [f64]) -> Result<(), Error> {
        named("rules", &self.name, || self.rules.begin(world, figures))
    }

    fn act(&self, world: &mut World, figures: &mut [f64]) -> Result<(), Error> {
        named("rules", &self.name, || self.rules.act(world, figures))
    }

    fn standing(&self, world: &World, figures: &[f64]) -> String {
        named("rules", &self.name, || self.rules.standing(world, figures))
    }
}

impl fmt::Debug for Rulebook {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.0.keys()).finish()
    }
}
