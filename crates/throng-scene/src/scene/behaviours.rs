//! Behaviours that a program adds to those of scene files.

use glam::DVec2;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;
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
/// scene.behaviours.add("climb", |_| Climb { height: 3.0 }.into());
/// let (mut world, _) = scene.build()?;
/// (0..100).for_each(|_| world.step());
/// assert!(world.agents().altitude[0] > 2.9);
/// # Ok::<(), throng_scene::Error>(())
/// ```
#[derive(Clone, Default)]
pub struct Behaviours(BTreeMap<String, Make>);

/// Makes a behaviour in a world of this origin.
type Make = Arc<dyn Fn(DVec2) -> Branch + Send + Sync>;

impl Behaviours {
    /// Adds a behaviour, or takes the place of the one of this name. `make` is told the world's origin, metres: what
    /// behaviours see is relative to it ([`throng::Settings::origin`]).
    pub fn add(&mut self, name: impl Into<String>, make: impl Fn(DVec2) -> Branch + Send + Sync + 'static) {
        self.0.insert(name.into(), Arc::new(make));
    }

    /// The names of all.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    /// The behaviour of this name in a world of this origin.
    pub(crate) fn make(&self, name: &str, origin: DVec2) -> Option<Branch> {
        self.0.get(name).map(|make| make(origin))
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
