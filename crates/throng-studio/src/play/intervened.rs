//! The interventions of the user in a running scene, and what the pointer holds.

use std::sync::Arc;
use throng::World;
use throng_scene::{Built, Change, Intervention, Interventions, Led, Point, Push, Scene};

/// What the user does to a running scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Act {
    /// Makes a change now.
    Make(Change),
    /// Opens the obstacle at a point, or closes it if it is open. The second number is the reach, metres.
    Door(Point, f64),
    /// Holds the pointer at a point from now on, or moves it there.
    Hold(Held, Point),
    /// Lets go of what the pointer holds.
    LetGo,
}

/// What a held pointer does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Held {
    /// Moves the agent with this number.
    Grab(u32),
    /// Leads the agent with this number.
    Lead(u32),
    /// Drives agents away within this radius, metres.
    Push(f64),
}

impl Held {
    fn change(self, path: Vec<Point>) -> Change {
        match self {
            Self::Grab(agent) => Change::Grab(Led { agent, path }),
            Self::Lead(agent) => Change::Lead(Led { agent, path }),
            Self::Push(radius) => Change::Push(Push { path, radius }),
        }
    }
}

/// A pointer that holds something.
#[derive(Clone, Debug)]
struct Holding {
    what: Held,
    at: Point,
    /// The state of the world without it, until the first step.
    before: Option<Vec<u8>>,
}

/// The interventions of the user so far, beyond those of the scene.
#[derive(Clone, Debug)]
pub(super) struct Intervened {
    /// Those of the scene.
    of_scene: Interventions,
    ready: Interventions,
    holding: Option<Holding>,
}

impl Intervened {
    /// Creates an empty record for a built scene.
    pub fn new(built: &Built) -> Self {
        Self { of_scene: built.interventions.clone(), ready: Interventions::default(), holding: None }
    }

    /// Returns the interventions so far.
    pub fn made(&self) -> &Arc<[Intervention]> {
        self.ready.made()
    }

    /// Does what the user asks for, after the current step. What was recorded after this step is forgotten: the future is
    /// another one.
    ///
    /// # Errors
    /// It is invalid, or the world refuses it. Then it is not recorded.
    pub fn act(&mut self, act: &Act, world: &mut World, scene: &Scene) -> Result<(), String> {
        match act {
            Act::Make(change) => self.make(change.clone(), world, scene),
            Act::Door(at, reach) => {
                let change = self.known().door(world, *at, *reach);
                self.make(change.ok_or("there is no obstacle: click a wall or a block")?, world, scene)
            }
            Act::Hold(what, at) => self.hold(*what, *at, world, scene),
            Act::LetGo => {
                self.holding = None;
                Ok(())
            }
        }
    }

    /// Makes what is due after a step: what was recorded, and the next point of what is held.
    pub fn step(&mut self, world: &mut World, scene: &Scene) {
        if let Some(holding) = &mut self.holding {
            holding.before = None;
            let (at, mut made) = (holding.at, self.made().to_vec());
            made.last_mut().and_then(path_of).into_iter().for_each(|path| path.push(at));
            // a path with another finite point is valid
            self.ready = self.of_scene.with(scene, made).unwrap_or_default();
        }
        // what the world refuses was refused before
        let _ = self.ready.act(world);
    }

    /// Lets go. The record stays, and is repeated.
    pub fn back(&mut self) {
        self.holding = None;
    }

    /// Whether a scene differs from another one only by these interventions at its end.
    pub fn explains(&self, new: &Scene, old: &Scene) -> bool {
        let all = old.interventions.iter().chain(self.made().iter());
        !self.made().is_empty()
            && new.interventions.iter().eq(all)
            && Scene { interventions: old.interventions.clone(), ..new.clone() } == *old
    }

    /// Returns what is known of obstacles.
    fn known(&self) -> &Interventions {
        if self.made().is_empty() { &self.of_scene } else { &self.ready }
    }

    fn make(&mut self, change: Change, world: &mut World, scene: &Scene) -> Result<(), String> {
        let step = world.steps();
        let kept = self.made().iter().filter_map(|made| until(step, made, scene.time.step));
        let now = Intervention { time: micros(world.time()), change };
        let made = kept.chain([now]).collect();
        let ready = self.of_scene.with(scene, made).map_err(|error| error.message)?;
        ready.act_last(world).map_err(|error| error.to_string())?;
        (self.ready, self.holding) = (ready, None);
        Ok(())
    }

    fn hold(&mut self, what: Held, at: Point, world: &mut World, scene: &Scene) -> Result<(), String> {
        let before = match &mut self.holding {
            // from the next step on
            Some(holding) if holding.what == what && holding.before.is_none() => {
                holding.at = at;
                return Ok(());
            }
            // no step was made: the first point is another one
            Some(Holding { what: held, before: Some(before), .. }) if *held == what => {
                world.load(before).map_err(|error| error.to_string())?;
                let mut made = self.made().to_vec();
                made.pop();
                self.ready = self.of_scene.with(scene, made).map_err(|error| error.message)?;
                self.holding.take().and_then(|holding| holding.before)
            }
            _ => None,
        };
        let before = before.unwrap_or_else(|| world.save());
        self.make(what.change(vec![at]), world, scene)?;
        self.holding = Some(Holding { what, at, before: Some(before) });
        Ok(())
    }
}

/// Returns the path of an intervention that has one.
fn path_of(made: &mut Intervention) -> Option<&mut Vec<Point>> {
    match &mut made.change {
        Change::Grab(Led { path, .. }) | Change::Lead(Led { path, .. }) | Change::Push(Push { path, .. }) => Some(path),
        _ => None,
    }
}

/// Returns the part of an intervention up to a step; `None` if it begins later.
fn until(step: u64, made: &Intervention, seconds: f64) -> Option<Intervention> {
    let points = step.checked_sub(made.begins(seconds))? + 1;
    let mut made = made.clone();
    path_of(&mut made).into_iter().for_each(|path| path.truncate(points as usize));
    Some(made)
}

/// Rounds a time to whole microseconds, for short texts.
fn micros(time: f64) -> f64 {
    (time * 1e6).round() / 1e6
}
