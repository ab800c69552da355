//! Behaviours that a program adds to those of scene files.

use super::Cast;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;
use throng::Error;
use throng::steer::Branch;

/// Behaviours by name, for `steer.custom = "name"`: how a scene uses a behaviour that a program brings along.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, View, Why};
/// use throng::motion::Steering;
/// use throng_scene::Scene;
///
/// /// Goes up, but not above a height.
/// #[derive(Debug)]
/// struct Climb {
///     height: f32,
/// }
///
/// impl Behaviour for Climb {
///     fn steer(&self, view: &View<'_>, _: &mut [f32], _: &mut Why<'_>) -> Option<Steering> {
///         (view.position().z < self.height).then(|| view.reach(Vec3::Z * view.vehicle.max_speed))
///     }
/// }
///
/// let mut scene: Scene = r#"
///     [[group]]
///     place.point = [5, 0]
///     vehicle = { kind = "level", max_speed = 2.0 }
///     steer.priority = [{ custom = "climb" }, { wander = {} }]
/// "#
/// .parse()?;
/// scene.behaviours.add("climb", |_| Ok(Climb { height: 3.0 }.into()));
/// let (mut world, _) = scene.build()?;
/// (0..100).for_each(|_| world.step());
/// assert!(world.agents().altitude[0] > 2.9);
/// # Ok::<(), throng_scene::Error>(())
/// ```
#[derive(Clone, Default)]
pub struct Behaviours(BTreeMap<String, Make>);

/// Makes a behaviour for a scene.
type Make = Arc<dyn Fn(&Cast<'_>) -> Result<Branch, Error> + Send + Sync>;

impl Behaviours {
    /// Adds a behaviour, or takes the place of the one of this name. `make` is told who and what is in the
    /// scene; what it misses there it says.
    pub fn add(
        &mut self,
        name: impl Into<String>,
        make: impl Fn(&Cast<'_>) -> Result<Branch, Error> + Send + Sync + 'static,
    ) {
        self.0.insert(name.into(), Arc::new(make));
    }

    /// The names of all.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    /// The behaviour of this name, made for a scene.
    pub(crate) fn make(&self, name: &str, cast: &Cast<'_>) -> Option<Result<Branch, Error>> {
        self.0.get(name).map(|make| make(cast))
    }
}

impl PartialEq for Behaviours {
    /// Always: what a program brings along is not part of what the scene says.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl fmt::Debug for Behaviours {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.0.keys()).finish()
    }
}
