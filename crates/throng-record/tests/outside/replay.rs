//! A replay of recorded pedestrians.

use super::shared::{replayed, stage};
use super::trajectories;
use throng_record::Trajectories;
use throng_record::pedestrian::People;
use throng_record::pedestrian::replay::{Pace, RecordedPeople, ReplayScene, from_entry};

/// Recorded pedestrians: all of them enter, and the displacement stays below the width of a street.
pub fn recorded_pedestrians_are_replayed() {
    let path = trajectories("ucy/zara01/obsmat.txt");
    let people = People::of(&Trajectories::read(path).unwrap(), |spot| spot.time < 60.0);
    let cast = RecordedPeople::new(&people, Pace::Quantile(0.5), 0.4);
    let again = replayed(&ReplayScene { near: 0.3, ..stage() }, &cast);
    assert_eq!((again.entered + again.refused, again.refused), (cast.people.walks.len(), 0));
    let samples = from_entry(&cast, &again, Some(4.0));
    assert!(samples.len() > 10 && samples.iter().all(|sample| sample.last[0] < 6.0), "{samples:?}");
    let path = trajectories("ucy/zara01/map.xml");
    assert_eq!(throng_record::map(&std::fs::read(path).unwrap()).unwrap().len(), 2);
    for (name, count) in [("zara01", 45), ("students03", 103)] {
        let path = trajectories(&format!("ucy/{name}/groups.txt"));
        assert_eq!(throng_record::pedestrian::groups(&std::fs::read(path).unwrap()).unwrap().len(), count);
    }
}
