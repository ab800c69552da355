//! Tests with processes that have closed forms.

use super::*;

/// A pseudorandom number generator: uniform in 0 to 1, and normal.
struct Draw(u64);

impl Draw {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        (-2.0 * self.unit().ln()).sqrt() * (std::f64::consts::TAU * self.unit()).cos()
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.normal(), self.normal(), self.normal())
    }
}

/// Returns a swarm with Ornstein-Uhlenbeck velocities of a time constant and a deviation along each axis. Velocities
/// are exact from step to step; positions are integrated with finer steps than those pushed.
fn langevin(count: u32, time: f64, deviation: f64, step: f64, steps: u32) -> Swarm {
    const FINE: u32 = 8;
    let mut draw = Draw(9);
    let keeps = (-step / f64::from(FINE) / time).exp();
    let kick = deviation * (1.0 - keeps * keeps).sqrt();
    let mut all: Vec<(DVec3, DVec3)> = (0..count).map(|_| (draw.vector(), draw.vector() * deviation)).collect();
    let mut swarm = Swarm::new(3.0 * time);
    for k in 0..steps {
        let places: Vec<(u32, DVec3)> = (0..).zip(&all).map(|(number, &(place, _))| (number, place)).collect();
        swarm.push(f64::from(k) * step, &places);
        for (place, velocity) in &mut all {
            for _ in 0..FINE {
                let next = *velocity * keeps + draw.vector() * kick;
                *place += (*velocity + next) * (0.5 * step / f64::from(FINE));
                *velocity = next;
            }
        }
    }
    swarm
}

#[test]
fn a_langevin_swarm_has_its_correlation_and_maxwellian_speeds() {
    let (time, deviation, step) = (0.5, 0.3, 0.01);
    let swarm = langevin(1500, time, deviation, step, 400);
    for (lag, value) in swarm.correlation().points() {
        // velocities are means over two steps, which decorrelate more slowly by a factor of 1 + 2 * step / (3 * time)
        assert!((value - (-lag / time).exp()).abs() < 0.03, "{lag}: {value}");
    }
    let found = swarm.correlation().time().unwrap();
    assert!((found / time - 1.0).abs() < 0.05, "{found}");
    let speed = swarm.speed();
    let mean = deviation * (8.0 / std::f64::consts::PI).sqrt();
    assert!((speed.mean() / mean - 1.0).abs() < 0.02, "{} of {mean}", speed.mean());
    assert!((speed.rms() / (deviation * 3f64.sqrt()) - 1.0).abs() < 0.02);
    // Maxwell: p(v) = sqrt(2/pi) v^2/s^3 exp(-v^2/(2 s^2))
    for (v, density) in speed.density(0.3) {
        let s = v / deviation;
        let want = (2.0 / std::f64::consts::PI).sqrt() * s * s * (-0.5 * s * s).exp() / deviation;
        assert!((density - want).abs() < 0.05 / deviation, "{v}: {density}, not {want}");
    }
    for axis in swarm.velocity() {
        assert!(axis.mean().abs() < 0.02 && (axis.kurtosis() - 3.0).abs() < 0.2, "{axis:?}");
        for (x, density) in axis.standardised(0.25) {
            let want = (-0.5 * x * x).exp() / std::f64::consts::TAU.sqrt();
            assert!((density - want).abs() < 0.04, "{x}: {density}, not {want}");
        }
    }
    let polarisation: Vec<f64> = swarm.moments()[1..399].iter().map(|moment| moment.polarisation).collect();
    let mean = polarisation.iter().sum::<f64>() / polarisation.len() as f64;
    // the mean length of the sum of N random directions over N is sqrt(8/(3 pi N))
    assert!((mean / (8.0 / (3.0 * std::f64::consts::PI * 1500.0)).sqrt() - 1.0).abs() < 0.35, "{mean}");
}

#[test]
fn agents_that_oscillate_have_the_acceleration_of_a_spring() {
    let (omega, step) = (3.0f64, 0.002);
    let mut swarm = Swarm::new(2.0);
    // several phases, whole periods
    let period = std::f64::consts::TAU / omega;
    let steps = (10.0 * period / step) as u32;
    for k in 0..steps {
        let time = f64::from(k) * step;
        let at = |number: u32| DVec3::new((omega * time + f64::from(number)).cos(), 10.0 * f64::from(number), 0.0);
        swarm.push(time, &[(3, at(3)), (8, at(8)), (9, at(9))]);
    }
    let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-3, "{a}, not {b}");
    near(swarm.acceleration()[0].rms(), omega * omega / 2f64.sqrt());
    near(swarm.velocity()[0].rms(), omega / 2f64.sqrt());
    // the arcsine distribution
    near(swarm.velocity()[0].kurtosis(), 1.5);
    assert!(swarm.acceleration()[1].most() < 1e-6);
    for (lag, value) in swarm.correlation().points() {
        assert!((value - (omega * lag).cos()).abs() < 0.03, "{lag}: {value}");
    }
}

#[test]
fn distances_on_a_lattice_and_of_all_pairs() {
    let mut swarm = Swarm::new(1.0);
    let side = |k: u32| DVec3::new(f64::from(k % 5), f64::from(k / 5 % 5), f64::from(k / 25)) * 0.3;
    let far = DVec3::new(-8_000.0, 3_000.0, 50.0);
    let lattice: Vec<(u32, DVec3)> = (0..125).map(|k| (k, far + side(k))).collect();
    swarm.push(0.0, &lattice);
    assert!((swarm.nearest().mean() - 0.3).abs() < 1e-6 && swarm.nearest().deviation() < 1e-6);
    // along each axis the positions are -2 to 2 cells from the middle: the mean square is 2 cells squared
    let size = swarm.moments()[0].size();
    assert!((size - 0.3 * 6f64.sqrt()).abs() < 1e-9, "{size}");
    let mut draw = Draw(3);
    for count in [0, 1, 2, 3, 50, 400] {
        let places: Vec<(u32, DVec3)> =
            (0..count).map(|k| (k * 2, draw.vector() * DVec3::new(1.0, 1.0, 3.0))).collect();
        let nearest = |&(number, at): &(u32, DVec3)| {
            let others = places.iter().filter(|other| other.0 != number);
            others.map(|other| other.1.distance(at)).fold(f64::INFINITY, f64::min)
        };
        let mut want = Distribution::default();
        places.iter().map(nearest).for_each(|distance| want.add(distance));
        let mut swarm = Swarm::new(1.0);
        swarm.push(0.0, &places);
        let found = swarm.nearest();
        assert_eq!(found.count(), want.count());
        assert!(count < 2 || (found.mean() - want.mean()).abs() < 1e-6 && (found.least() - want.least()).abs() < 1e-6);
    }
}

#[test]
fn agents_count_while_they_are_present() {
    let mut swarm = Swarm::new(1.0);
    for k in 0..30u32 {
        let time = f64::from(k) * 0.1;
        let mut places = vec![(1, DVec3::X * time)];
        // an agent that is present intermittently, but never in three consecutive frames, and an agent that leaves
        if k % 3 != 0 {
            places.push((5, DVec3::Y * 50.0 * time));
        }
        if k < 10 {
            places.push((7, DVec3::NEG_X * time));
        }
        swarm.push(time, &places);
    }
    assert!((swarm.speed().mean() - 1.0).abs() < 1e-9 && swarm.speed().deviation() < 1e-9, "{:?}", swarm.speed());
    assert_eq!(swarm.speed().count(), 28 + 8);
    assert!(swarm.moments()[4].polarisation < 1e-9 && (swarm.moments()[20].polarisation - 1.0).abs() < 1e-9);
    let before = swarm.moments().len();
    swarm.push(1.0, &[(1, DVec3::ZERO)]);
    swarm.push(f64::NAN, &[(1, DVec3::ZERO)]);
    swarm.push(9.0, &[(1, DVec3::NAN)]);
    assert_eq!((swarm.moments().len(), swarm.moments()[before].count), (before + 1, 0));
    // a gap in time gives no velocity
    assert!(swarm.correlation().points().iter().all(|&(_, value)| (value - 1.0).abs() < 1e-9));
}
