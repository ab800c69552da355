//! Rules that scene files name.

use super::Cast;
use crate::caught::{caught, named};
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;
use throng::{Error, Rules, World};

/// Rules by name, for `rules = "name"`: those of the gallery's games, and what a program adds.
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
/// scene.rulebook.add("clock", |_| Ok(Clock));
/// let (mut world, _) = scene.build()?;
/// (0..10).for_each(|_| world.step());
/// assert_eq!(world.figure("ticks"), Some(10.0));
/// # Ok::<(), throng_scene::Error>(())
/// ```
#[derive(Clone)]
pub struct Rulebook(BTreeMap<String, Make>);

/// Rules that were made for a scene, or what they miss there.
type Made = Result<Arc<dyn Rules>, Error>;
/// Makes rules for a scene.
type Make = Arc<dyn Fn(&Cast<'_>) -> Made + Send + Sync>;

impl Default for Rulebook {
    /// The rules of the gallery's games.
    fn default() -> Self {
        let mut book = Self(BTreeMap::new());
        crate::games::rules(&mut book);
        book
    }
}

impl Rulebook {
    /// Adds rules, or takes the place of those of this name. `make` is told who and what is in the scene; what it misses
    /// there it says.
    pub fn add<R: Rules + 'static>(
        &mut self,
        name: impl Into<String>,
        make: impl Fn(&Cast<'_>) -> Result<R, Error> + Send + Sync + 'static,
    ) {
        let name = name.into();
        let of: Arc<str> = name.as_str().into();
        let make: Make = Arc::new(move |cast| {
            named("rules", &of, || {
                let rules = make(cast)?;
                let named: Arc<dyn Rules> = Arc::new(Named { name: of.clone(), figures: rules.figures(), rules });
                Ok(named)
            })
        });
        self.0.insert(name, make);
    }

    /// Adds those of another; they take the place of those of the same name.
    pub fn extend(&mut self, others: Self) {
        self.0.extend(others.0);
    }

    /// The names of all.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    /// The rules of this name, made for a scene; or what a panic of theirs says.
    pub(crate) fn make(&self, name: &str, cast: &Cast<'_>) -> Option<Result<Made, String>> {
        self.0.get(name).map(|make| caught(|| make(cast)))
    }
}

/// Rules that a program brings along: panics in them say whose they are.
#[derive(Debug)]
struct Named<R> {
    name: Arc<str>,
    figures: Vec<String>,
    rules: R,
}

impl<R: Rules> Rules for Named<R> {
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

impl PartialEq for Rulebook {
    /// Always: what a program brings along is not part of what the scene says.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl fmt::Debug for Rulebook {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.0.keys()).finish()
    }
}
