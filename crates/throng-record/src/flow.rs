//! Fields that guide groups, for display.

use std::fmt;
use std::sync::Arc;
use throng::World;
use throng::field::Field;
use throng_field::Anchor;

/// A field that guides groups, with its anchors.
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
    /// The field; positions are relative to [`Setting::origin`](crate::Setting::origin).
    pub field: Arc<dyn Field>,
    /// The anchors of a sketched field, relative to the same origin.
    pub anchors: Vec<Anchor>,
    /// The groups that the field guides: indices into [`Setting::groups`](crate::Setting::groups).
    pub groups: Vec<u32>,
    /// Whether the field governs its groups and adapts to the positions of the agents if it is [`Adaptive`](throng::field::Adaptive). `false`: behaviours
    /// of its groups follow it.
    pub governs: bool,
    /// Whether the field is constant in time, so that a viewer need not sample it again at every frame. `false` if
    /// unknown.
    pub still: bool,
}

impl Flow {
    /// Returns a field without groups and anchors.
    pub fn of(field: Arc<dyn Field>) -> Self {
        Self { field, anchors: Vec::new(), groups: Vec::new(), governs: false, still: false }
    }

    /// Returns the fields that govern the groups of a world ([`Guidance::field`](throng::agent::Guidance::field)), and those that their behaviours follow
    /// ([`Behaviour::fields`](throng::steer::Behaviour::fields)), each once.
    pub fn all(world: &World) -> Vec<Self> {
        let mut flows: Vec<Self> = Vec::new();
        let mut add = |group: u32, field: &Arc<dyn Field>, governs: bool| match flows
            .iter_mut()
            .find(|flow| flow.governs == governs && Arc::ptr_eq(&flow.field, field))
        {
            Some(flow) if flow.groups.contains(&group) => {}
            Some(flow) => flow.groups.push(group),
            None => flows.push(Self { groups: vec![group], governs, ..Self::of(field.clone()) }),
        };
        for (index, group) in (0..).zip(world.groups()) {
            if let Some(governed) = &group.guidance.field {
                add(index, &governed.field, true);
            }
            if let Some(behaviour) = &group.guidance.behaviour {
                behaviour.fields(&mut |field| add(index, field, false));
            }
        }
        flows
    }
}

/// Equal flows share the same field object, not an equal one; all else is compared by value.
impl PartialEq for Flow {
    fn eq(&self, other: &Self) -> bool {
        let beside = |flow: &Self| (flow.still, flow.governs, flow.groups.clone(), flow.anchors.clone());
        Arc::ptr_eq(&self.field, &other.field) && beside(self) == beside(other)
    }
}

impl fmt::Debug for Flow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { anchors, groups, governs, still, .. } = self;
        let mut out = f.debug_struct("Flow");
        out.field("anchors", anchors)
            .field("groups", groups)
            .field("governs", governs)
            .field("still", still)
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use throng::Group;
    use throng::Settings;
    use throng::agent::Guidance;
    use throng::field::Governed;

    #[test]
    fn a_field_that_leads_two_groups_is_one_flow() {
        let mut world = World::new(Settings::default()).unwrap();
        let (east, north) =
            (Governed::new(|_: Vec3, _: f64| Vec3::X, 1.0), Governed::new(|_: Vec3, _: f64| Vec3::Y, 0.5));
        for field in [Some(east.clone()), None, Some(north), Some(east)] {
            let guidance = Guidance { field, ..Guidance::JOURNEY };
            world.add_group(Group { guidance, ..Group::default() }).unwrap();
        }
        let flows = Flow::all(&world);
        // every world has a first group
        assert_eq!(flows.iter().map(|flow| flow.groups.clone()).collect::<Vec<_>>(), [vec![1, 4], vec![3]]);
        assert!(flows[0] == flows[0].clone() && flows[0] != flows[1]);
    }
}
