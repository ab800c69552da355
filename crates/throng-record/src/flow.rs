//! Fields that lead groups, to be seen.

use std::fmt;
use std::sync::Arc;
use throng::field::{Anchor, Field};
use throng::{Group, World};

/// A field that leads one group or several, and what there is to tell of it.
///
/// ```
/// use glam::Vec3;
/// use std::sync::Arc;
/// use throng_record::{Flow, Setting};
/// let whirl = |place: Vec3, _: f64| Vec3::Z.cross(place);
/// let setting = Setting { flows: vec![Flow { still: true, ..Flow::of(Arc::new(whirl)) }], ..Setting::default() };
/// assert!(setting.flows[0].groups.is_empty());
/// ```
#[derive(Clone)]
pub struct Flow {
    /// The field; places are relative to [`Setting::origin`](crate::Setting::origin).
    pub field: Arc<dyn Field>,
    /// What it was sketched by, relative to the same origin.
    pub anchors: Vec<Anchor>,
    /// Whom it leads: indices into [`Setting::groups`](crate::Setting::groups).
    pub groups: Vec<u32>,
    /// Whether it is the same at all times: it need not be looked at again at every moment. Who does not know leaves it `false`.
    pub still: bool,
}

impl Flow {
    /// A field that nothing else is known of.
    pub fn of(field: Arc<dyn Field>) -> Self {
        Self { field, anchors: Vec::new(), groups: Vec::new(), still: false }
    }

    /// The fields that govern the groups of a world ([`Group::field`]), each once.
    pub fn all(world: &World) -> Vec<Self> {
        let mut flows: Vec<Self> = Vec::new();
        let governed = |(index, group): (u32, &Group)| Some((index, group.field.as_ref()?.field.clone()));
        for (group, field) in (0..).zip(world.groups()).filter_map(governed) {
            match flows.iter_mut().find(|flow| Arc::ptr_eq(&flow.field, &field)) {
                Some(flow) => flow.groups.push(group),
                None => flows.push(Self { groups: vec![group], ..Self::of(field) }),
            }
        }
        flows
    }
}

/// The same field, not one that is alike, and the same beside it.
impl PartialEq for Flow {
    fn eq(&self, other: &Self) -> bool {
        let beside = |flow: &Self| (flow.still, flow.groups.clone(), flow.anchors.clone());
        Arc::ptr_eq(&self.field, &other.field) && beside(self) == beside(other)
    }
}

impl fmt::Debug for Flow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { anchors, groups, still, .. } = self;
        let mut out = f.debug_struct("Flow");
        out.field("anchors", anchors).field("groups", groups).field("still", still).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use throng::Settings;
    use throng::field::Governed;

    #[test]
    fn a_field_that_leads_two_groups_is_one_flow() {
        let mut world = World::new(Settings::default()).unwrap();
        let (east, north) =
            (Governed::new(|_: Vec3, _: f64| Vec3::X, 1.0), Governed::new(|_: Vec3, _: f64| Vec3::Y, 0.5));
        for field in [Some(east.clone()), None, Some(north), Some(east)] {
            world.add_group(Group { field, ..Group::default() }).unwrap();
        }
        let flows = Flow::all(&world);
        // the first group is the one that every world has
        assert_eq!(flows.iter().map(|flow| flow.groups.clone()).collect::<Vec<_>>(), [vec![1, 4], vec![3]]);
        assert!(flows[0] == flows[0].clone() && flows[0] != flows[1]);
    }
}
