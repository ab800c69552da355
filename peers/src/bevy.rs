//! bevy_orca's `Crowd`, with its own grid.

use crate::contest::{Contestant, Turn};
use crate::crossing::{WARM_UP, goal};
use bevy_math::Vec2;
use bevy_orca::{CrowdMember, CrowdParams};
use std::error::Error;
use throng_bench::Crowd;

/// A crowd of bevy_orca's members.
pub struct BevyOrca {
    step: f32,
    goals: Vec<(Vec2, f32)>,
    warm: Vec<CrowdMember>,
    members: Vec<CrowdMember>,
    crowd: bevy_orca::Crowd,
}

impl BevyOrca {
    /// Creates the crowd and warms it up.
    pub fn new(crowd: &Crowd) -> Self {
        let vec = |p: glam::DVec2| Vec2::new(p.x as f32, p.y as f32);
        let member = |(key, pos)| CrowdMember {
            key,
            pos,
            vel: Vec2::ZERO,
            radius: crowd.radius as f32,
            max_speed: Crowd::MAX_SPEED as f32,
            pref_vel: None,
        };
        let places = crowd.people.iter().map(|person| vec(person.position));
        let mut all = Self {
            step: crowd.step as f32,
            goals: crowd
                .people
                .iter()
                .map(|person| (vec(goal(crowd, person.way)), person.preferred_speed as f32))
                .collect(),
            warm: vec![],
            members: (0..).zip(places).map(member).collect(),
            crowd: bevy_orca::Crowd::default(),
        };
        for _ in 0..WARM_UP {
            all.step();
        }
        all.warm = all.members.clone();
        all
    }

    fn step(&mut self) {
        // without the nudge, which the other simulators do not have
        let params = CrowdParams {
            time_horizon: Crowd::TIME_HORIZON as f32,
            neighbour_range: Crowd::NEIGHBOUR_DISTANCE as f32,
            max_neighbours: Crowd::NEIGHBOURS,
            nudge: 0.0,
        };
        for (member, (goal, speed)) in self.members.iter_mut().zip(&self.goals) {
            member.pref_vel = Some((goal - member.pos).normalize_or_zero() * *speed);
        }
        let solved = self.crowd.solve(&self.members, &params, self.step, |_, _| true, |_, _| ());
        for (member, velocity) in self.members.iter_mut().zip(solved) {
            member.vel = velocity.unwrap_or(Vec2::ZERO);
            member.pos += member.vel * self.step;
        }
    }
}

impl Contestant for BevyOrca {
    fn name(&self) -> String {
        "bevy_orca 0.2.1, Crowd".into()
    }

    fn restart(&mut self) -> Result<(), Box<dyn Error>> {
        self.members.clone_from(&self.warm);
        Ok(())
    }

    fn steps(&mut self, count: u32) -> Result<Turn, Box<dyn Error>> {
        Ok(Turn::of(count, self.members.len(), self.step, || self.step()))
    }
}
