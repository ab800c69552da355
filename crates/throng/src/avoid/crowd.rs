//! Models that choose the velocities of all of their agents together.

use super::AvoidanceInput;
use super::avoidance::{Avoiding, Visibility};
use crate::agent::AgentId;
use crate::intend::{Velocities, set};
use crate::parallel;
use glam::{DVec3, Vec2, Vec3};

/// A local model that chooses the velocities of all of its agents together, once a sub-step: for models that work on
/// arrays, or that are called from another language. A model says so with
/// [`LocalModel::together`](super::LocalModel::together).
///
/// ```
/// use std::sync::Arc;
/// use throng::avoid::{AvoidanceInput, Crowd, CrowdModel, LocalModel, Workspace};
/// use throng::{Agent, Group, Settings, World};
///
/// /// All agents move with the mean of their preferred velocities.
/// #[derive(Debug)]
/// struct March;
///
/// impl CrowdModel for March {
///     fn choose(&self, crowd: &mut Crowd<'_>) {
///         let sum: glam::Vec2 = (0..crowd.len()).map(|k| crowd.input(k).preferred).sum();
///         let mean = sum / crowd.len() as f32;
///         (0..crowd.len()).for_each(|k| crowd.set(k, mean.extend(0.0)));
///     }
/// }
///
/// impl LocalModel for March {
///     fn velocity(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> glam::Vec2 {
///         view.preferred
///     }
///
///     fn together(&self) -> Option<&dyn CrowdModel> {
///         Some(self)
///     }
///
///     fn wall_range(&self, radius: f32, _: f32) -> f32 {
///         radius
///     }
/// }
///
/// let mut world = World::new(Settings::default())?;
/// let group = world.add_group(Group { model: Arc::new(March), ..Group::default() })?;
/// let to = |goal: [f64; 2]| Agent { group, ..Agent::at([0.0, goal[1]]).goal(goal) };
/// world.add_agent(to([9.0, 0.0]))?;
/// world.add_agent(to([9.0, 5.0]))?;
/// (0..60).for_each(|_| world.step());
/// let speeds: Vec<_> = world.agents().map(|agent| agent.velocity()).collect();
/// assert!(speeds[0].x > 0.5 && (speeds[0] - speeds[1]).length() < 1e-3);
/// # Ok::<(), throng::Error>(())
/// ```
pub trait CrowdModel {
    /// Chooses the velocities with [`Crowd::set`]. An agent without one gets its preferred velocity. Must be a function of
    /// the crowd alone: the same crowd gives the same bits.
    fn choose(&self, crowd: &mut Crowd<'_>);
}

/// The agents of a local model, in the order of their numbers, as they are at the start of a sub-step.
pub struct Crowd<'a> {
    avoiding: Avoiding<'a>,
    rows: &'a [u32],
    /// What each agent sees.
    seen: &'a [Visibility],
    chosen: &'a mut [Vec3],
}

impl std::fmt::Debug for Crowd<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Crowd").field("agents", &self.rows.len()).finish_non_exhaustive()
    }
}

impl Crowd<'_> {
    /// Returns the number of agents.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are no agents. A model is not called for an empty crowd.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Returns the time at the start of the step, seconds.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.avoiding.state.time()
    }

    /// Returns the duration of the sub-step, seconds.
    #[must_use]
    pub fn seconds(&self) -> f32 {
        self.avoiding.shared.step
    }

    /// Returns the id of agent `k`, from 0.
    ///
    /// # Panics
    /// As the other methods with `k`: if `k` is not less than [`len`](Self::len).
    #[must_use]
    pub fn id(&self, k: usize) -> AgentId {
        self.avoiding.state.id(self.rows[k] as usize)
    }

    /// Returns the number of agent `k` ([`Agent::number`](crate::Agent::number)). Numbers rise with `k`.
    #[must_use]
    pub fn number(&self, k: usize) -> u32 {
        self.avoiding.state.agents.number[self.rows[k] as usize]
    }

    /// Returns the centre of agent `k`, world coordinates.
    #[must_use]
    pub fn position(&self, k: usize) -> DVec3 {
        self.avoiding.state.world_place(self.rows[k] as usize)
    }

    /// Returns the input that a model for single agents would get for agent `k`.
    #[must_use]
    pub fn input(&self, k: usize) -> AvoidanceInput<'_> {
        self.avoiding.view_of(self.rows[k] as usize, self.seconds(), &self.seen[k])
    }

    /// Returns the numbers of the neighbours of agent `k`, in the order of [`AvoidanceInput::neighbours`]. They can belong
    /// to other crowds.
    pub fn neighbour_numbers(&self, k: usize) -> impl ExactSizeIterator<Item = u32> + '_ {
        self.seen[k].rows.iter().map(|&row| self.avoiding.state.agents.number[row as usize])
    }

    /// Sets the velocity of agent `k`, m/s. The limits of its motor apply afterwards, and then the guard. Agents that
    /// do not fly ignore z.
    pub fn set(&mut self, k: usize, velocity: Vec3) {
        self.chosen[k] = velocity;
    }

    /// Sets the horizontal velocity of agent `k`, m/s; its vertical velocity is the one it prefers.
    pub fn set_horizontal(&mut self, k: usize, velocity: Vec2) {
        self.chosen[k] = velocity.extend(self.input(k).preferred_vertical_velocity);
    }
}

/// Memory for a crowd.
#[derive(Clone, Debug, Default)]
pub(super) struct CrowdScratch {
    rows: Vec<u32>,
    seen: Vec<Visibility>,
    chosen: Vec<Vec3>,
}

impl Avoiding<'_> {
    /// Chooses the velocities of the agents of all models that choose for their agents together.
    pub(super) fn choose_together(&self, scratch: &mut CrowdScratch, velocities: &mut Velocities) {
        let groups = &self.state.local_groups;
        for (index, group) in groups.iter().enumerate() {
            let Some(model) = group.model.together() else { continue };
            self.choose_for_crowd(model, index as u32, scratch, velocities);
        }
    }

    /// Chooses the velocities of the agents with the model of this group, if it is the first group with the model.
    fn choose_for_crowd(
        &self,
        model: &dyn CrowdModel,
        group: u32,
        CrowdScratch { rows, seen, chosen }: &mut CrowdScratch,
        velocities: &mut Velocities,
    ) {
        let agents = &self.state.agents;
        rows.clear();
        rows.extend((0..agents.len() as u32).filter(|&row| self.model_of(row) == Some(group)));
        if rows.is_empty() {
            return;
        }
        rows.sort_unstable_by_key(|&row| agents.number[row as usize]);
        seen.resize_with(rows.len().max(seen.len()), Visibility::default);
        let (rows, seen) = (&rows[..], &mut seen[..rows.len()]);
        parallel::rows(seen, |_: &mut (), k, sight| self.see(rows[k] as usize, self.shared.step, sight));
        chosen.clear();
        chosen.extend(rows.iter().map(|&row| self.preferred.at(row as usize)));
        model.choose(&mut Crowd { avoiding: *self, rows, seen, chosen });
        let mut velocities = velocities.rows();
        for (&row, &chosen) in rows.iter().zip(&*chosen) {
            let row = row as usize;
            let chosen = self.stays_down(row, chosen);
            set(&mut velocities, row, self.state.limited_velocity(row, chosen, self.shared.step));
        }
    }
}
