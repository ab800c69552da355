//! Assignment of agents to places at the least total cost, by the Hungarian method (Kuhn 1955; Munkres 1957), with
//! shortest augmenting paths (Jonker and Volgenant 1987).

use glam::Vec3;

/// Returns the index of the place of each agent, so that the sum of the squared distances is least; then the straight
/// lines to the places do not cross. The time is proportional to `agents² places`. Deterministic: equal sums are
/// resolved by the order of the agents.
///
/// # Panics
/// If there are fewer places than agents.
///
/// ```
/// use glam::Vec3;
/// use throng_steer::assign;
/// assert_eq!(assign(&[Vec3::X * 3.0, Vec3::X], &[Vec3::ZERO, Vec3::X * 4.0]), [1, 0]);
/// ```
pub fn assign(agents: &[Vec3], places: &[Vec3]) -> Vec<usize> {
    assert!(agents.len() <= places.len(), "fewer places than agents");
    let cost = |agent: usize, place: usize| f64::from(agents[agent].distance_squared(places[place]));
    // potentials of agents and places, and the agent of each place
    let mut agent_price = vec![0.0; agents.len()];
    let mut place_price = vec![0.0; places.len()];
    let mut owner: Vec<Option<usize>> = vec![None; places.len()];
    for newcomer in 0..agents.len() {
        let mut least = vec![f64::INFINITY; places.len()];
        let mut from: Vec<Option<usize>> = vec![None; places.len()];
        let mut settled = vec![false; places.len()];
        // the cheapest chain of moves that ends at a free place
        let (mut agent, mut last) = (newcomer, None);
        let free = loop {
            let mut next = None;
            for place in (0..places.len()).filter(|&place| !settled[place]) {
                let slack = cost(agent, place) - agent_price[agent] - place_price[place];
                if slack < least[place] {
                    (least[place], from[place]) = (slack, last);
                }
                if next.is_none_or(|next: usize| least[place] < least[next]) {
                    next = Some(place);
                }
            }
            let next = next.expect("no fewer places than agents");
            let step = least[next];
            agent_price[newcomer] += step;
            for place in 0..places.len() {
                match owner[place] {
                    Some(owner) if settled[place] => {
                        agent_price[owner] += step;
                        place_price[place] -= step;
                    }
                    _ => least[place] -= step,
                }
            }
            settled[next] = true;
            match owner[next] {
                Some(owner) => (agent, last) = (owner, Some(next)),
                None => break next,
            }
        };
        let mut place = free;
        while let Some(before) = from[place] {
            owner[place] = owner[before];
            place = before;
        }
        owner[place] = Some(newcomer);
    }
    let mut place_of = vec![0; agents.len()];
    for (place, owner) in owner.iter().enumerate() {
        if let Some(owner) = *owner {
            place_of[owner] = place;
        }
    }
    place_of
}
