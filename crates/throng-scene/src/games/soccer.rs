//! Two teams, a ball and two goals (OpenSteer's "Michael's Simple Soccer").

use crate::scene::SceneNames;
use glam::{DVec2, DVec3, Vec2, Vec3};
use throng::motion::Steering;
use throng::steer::{Behaviour, BoxedBehaviour, SteeringInput, SteeringReason, Target, TraceRecorder};
use throng::{Agent, AgentId, AgentRef, Error, Rules, World};
use throng_steer::Arrive;

/// Players of the groups `red` and `blue` kick the only agent of the group `ball` by touching it. The ball bounces off
/// the lines, except in the goals at both ends: red scores on the left, at negative x, and blue on the right. After a
/// goal the ball is back in the middle.
#[derive(Clone, Copy, Debug)]
pub struct Soccer {
    /// Half the length of the field along x, and half its width, metres.
    pub field: DVec2,
    /// Half the width of the goals, metres.
    pub goal: f64,
    /// The speed of the ball after a kick, m/s.
    pub kick: f32,
}

impl Default for Soccer {
    fn default() -> Self {
        Self { field: DVec2::new(20.0, 10.0), goal: 7.0, kick: 9.0 }
    }
}

/// The indices of the figures.
const RED: usize = 0;
const BLUE: usize = 1;
const GOALS: usize = 2;
const KICKS: usize = 3;

/// How near a player must be to kick, beyond contact, as a part of the sum of the radii: the guard keeps bodies from
/// touching.
const REACH: f64 = 0.05;

impl Rules for Soccer {
    fn figures(&self) -> Vec<String> {
        ["red", "blue", "goals", "kicks"].map(String::from).into()
    }

    fn begin(&self, world: &mut World, _: &mut [f64]) -> Result<(), Error> {
        ["red", "blue", "ball"].into_iter().try_for_each(|name| world.group_named(name).map(drop))
    }

    fn act(&self, world: &mut World, figures: &mut [f64]) -> Result<(), Error> {
        for ball in world.members(world.group_named("ball")?) {
            if let Some(push) = self.kicked(world, ball)? {
                world.set_velocity(ball, push)?;
                figures[KICKS] += 1.0;
            }
            let Some(agent) = world.agent(ball).map(AgentRef::to_agent) else { continue };
            if agent.position.x.abs() > self.field.x + f64::from(agent.radius) {
                figures[if agent.position.x < 0.0 { RED } else { BLUE }] += 1.0;
                figures[GOALS] += 1.0;
                world.replace(ball, Agent { position: DVec3::ZERO, velocity: Vec2::ZERO, ..agent })?;
            } else {
                let velocity = self.bounced(&agent, world.settings().step);
                world.set_velocity(ball, velocity.extend(0.0))?;
            }
        }
        Ok(())
    }

    fn standing(&self, _: &World, figures: &[f64]) -> String {
        format!("red {} : {} blue", figures[RED], figures[BLUE])
    }
}

impl Soccer {
    /// Returns the velocity that a player gives the ball it touches: away from the player, and towards the goal if
    /// that lies on that side. If several players touch it, a random one kicks.
    fn kicked(&self, world: &World, ball: AgentId) -> Result<Option<Vec3>, Error> {
        let Some(ball) = world.agent(ball).map(AgentRef::to_agent) else { return Ok(None) };
        let mut kickers = Vec::new();
        for (team, goal) in [("red", -self.field.x), ("blue", self.field.x)] {
            let players = world.members(world.group_named(team)?);
            let near = |player: &Agent| {
                let reach = f64::from(player.radius + ball.radius) * (1.0 + REACH);
                player.position.distance(ball.position) <= reach
            };
            kickers.extend(
                players
                    .into_iter()
                    .filter_map(|id| world.agent(id).map(AgentRef::to_agent))
                    .filter(near)
                    .map(|player| (player, goal)),
            );
        }
        let Some((kicker, goal)) = kickers.get((world.draw(0) * kickers.len() as f32) as usize) else {
            return Ok(None);
        };
        let (ball_at, kicker_at) = (ball.position.truncate(), kicker.position.truncate());
        let away = (ball_at - kicker_at).normalize_or_zero();
        // to the nearest point of the goal
        let room = self.goal - f64::from(2.0 * ball.radius);
        let to_goal = (DVec2::new(*goal, ball_at.y.clamp(-room, room)) - ball_at).normalize_or_zero();
        let direction = if away.dot(to_goal) > 0.0 { away + to_goal } else { away };
        let Some(direction) = direction.as_vec2().try_normalize() else { return Ok(None) };
        // a kicked ball that already leaves the player is not kicked again
        let leaves = ball.velocity.dot(direction) > 0.5 * self.kick;
        Ok((!leaves).then(|| (direction * self.kick).extend(0.0)))
    }

    /// Returns the velocity of the ball, reflected if the next step would take it beyond a line outside a goal.
    fn bounced(&self, ball: &Agent, seconds: f64) -> Vec2 {
        let next = ball.position.truncate() + ball.velocity.as_dvec2() * seconds;
        let room = self.field - f64::from(ball.radius);
        let Vec2 { mut x, mut y } = ball.velocity;
        let in_goal = next.y.abs() < self.goal - f64::from(ball.radius);
        if next.x.abs() > room.x && !in_goal && next.x * f64::from(x) > 0.0 {
            x = -x;
        }
        let beyond = ball.position.x.abs() > room.x;
        let room_across = if beyond { self.goal - f64::from(ball.radius) } else { room.y };
        if next.y.abs() > room_across && next.y * f64::from(y) > 0.0 {
            y = -y;
        }
        Vec2::new(x, y)
    }
}

/// A player. It goes for the ball while the ball is near its home, the place where the player was at first. From behind
/// the ball, it kicks the ball towards the other goal. From before the ball, it goes around to behind it. Else it goes
/// home.
#[derive(Clone, Copy, Debug)]
struct Player {
    ball: Target,
    /// The middle of the field.
    middle: Vec3,
    /// Half the length of the field, metres.
    half: f32,
}

/// How near a player's home the ball must be, metres.
const NEAR_HOME: f32 = 12.0;
/// How far behind and beside the ball a player goes if it is before the ball, metres.
const BEHIND: Vec2 = Vec2::new(2.0, 1.0);

/// Makes a player for a scene with a ball.
pub fn player(cast: &SceneNames<'_>) -> Result<BoxedBehaviour, Error> {
    let half = Soccer::default().field.x as f32;
    Ok(Player { ball: cast.agent("ball", 0)?, middle: cast.place(0.0, 0.0), half }.into())
}

impl Behaviour for Player {
    /// Whether the home is known, and its position.
    fn memory(&self) -> usize {
        3
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let [known, x, y] = memory else { return None };
        if *known == 0.0 {
            (*known, *x, *y) = (1.0, view.position().x, view.position().y);
        }
        let home = Vec3::new(*x, *y, 0.0);
        let ball = self.ball.find(view)?;
        if ball.position.distance(home) > NEAR_HOME {
            return Arrive { slowing_distance: 3.0, ..Arrive::new(Target::Point(home)) }.steer(view, &mut [], why);
        }
        // a player's own side is the side of its home
        let own = (home.x - self.middle.x).signum();
        let goal = self.middle - Vec3::X * (own * self.half);
        let aside = view.position().y - ball.position.y;
        let aim = if (view.position().x - ball.position.x) * own > 0.0 {
            // a kick goes from the middle of the player to the middle of the ball
            ball.position + (ball.position - goal).normalize_or_zero() * ball.radius
        } else {
            ball.position + Vec3::new(own * BEHIND.x, BEHIND.y.copysign(aside), 0.0)
        };
        why.note(|| SteeringReason::Aim(aim));
        view.go(view.to(aim))
    }
}
