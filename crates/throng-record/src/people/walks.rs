//! The walks of the people of a recording, planned with all of their ways known.

use crate::{Moments, Setting};
use std::collections::BTreeMap;
use throng::parallel;
use throng_figure::{Person, Sample, Walk};

/// The longest walks of a recording, all together, seconds. Ten hours take some seconds, and 200 MB of memory.
const LONGEST: f64 = 36_000.0;

/// The walks of the people of a recording, by agent number. Their feet are planned with all of their ways known, as those of
/// exported people are; without them, pictures show people that know only what has been.
#[derive(Clone, Debug, Default)]
pub struct Walks(BTreeMap<u32, Walk>);

impl Walks {
    /// Plans the walks of all people of a recording: of agents that are of the size of people and on the ground when they
    /// appear. Agents with positions that are not finite have none. Returns `None` if the recording is too long: all of its
    /// agents together are there for more than ten hours.
    ///
    /// ```
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("run.csv");
    /// use throng_record::people::Walks;
    /// use throng_record::{Moments, Trajectories};
    /// std::fs::write(&path, "time,number,x,y\n0,7,0,0\n1,7,1.3,0\n2,7,2.6,0\n")?;
    /// let walks = Walks::of(&Moments::of(Trajectories::read(&path)?)).expect("it is short");
    /// let walk = walks.get(7).expect("agent 7 is a person");
    /// assert!((walk.pose(1.0).hips.x - 1.3).abs() < 0.1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of(moments: &Moments) -> Option<Self> {
        let mut spans: BTreeMap<u32, [f64; 2]> = BTreeMap::new();
        for spot in moments.spots() {
            spans.entry(spot.number).or_insert([spot.time; 2])[1] = spot.time;
        }
        if spans.values().map(|[first, last]| last - first).sum::<f64>() > LONGEST {
            return None;
        }
        let mut tracks: BTreeMap<u32, Track> = BTreeMap::new();
        for spot in moments.spots() {
            let stands = spot.place.z == 0.0;
            let person = || person(&moments.setting, spot.group, spot.number, spot.radius).filter(|_| stands);
            let track = tracks.entry(spot.number).or_insert_with(|| Track { person: person(), ..Track::default() });
            if track.person.is_some() {
                let heading = f64::from(spot.heading);
                track.samples.push(Sample { time: spot.time, position: spot.place.truncate(), heading });
            }
        }
        let mut tracks: Vec<(u32, Track)> = tracks.into_iter().collect();
        parallel::ranges(&mut tracks[..], |_, tracks| {
            for (_, Track { person, samples, walk }) in tracks {
                *walk = person.as_ref().and_then(|person| Walk::recorded(person, samples).ok());
            }
        });
        Some(Self(tracks.into_iter().filter_map(|(number, track)| Some((number, track.walk?))).collect()))
    }

    /// Returns the walk of an agent; `None` if it is no person.
    pub fn get(&self, number: u32) -> Option<&Walk> {
        self.0.get(&number)
    }
}

/// The way of an agent.
#[derive(Default)]
struct Track {
    /// The person that it is.
    person: Option<Person>,
    samples: Vec<Sample>,
    walk: Option<Walk>,
}

/// Walks are the same if they are the same object: to compare the poses would take as long as to plan them.
impl PartialEq for Walks {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
    }
}

/// Returns the person that an agent is, with the body of its group; `None` if it is none.
fn person(setting: &Setting, group: u32, number: u32, radius: f32) -> Option<Person> {
    let person = Person::of_agent(number, radius)?;
    Some(setting.character(group).map_or(person, |character| character.person(person)))
}
