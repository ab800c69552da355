//! Obstacles and the edges of walkable areas as barriers: upright surfaces without upper or lower end.

use super::{Barrier, Cuboid, Cylinder, Moved, Pose, Prism, SeenFrom, Surface, Union};
use crate::error::Error;
use crate::space::{Obstacle, Walkable};
use glam::{DVec2, Quat, Vec2};
use std::sync::Arc;

/// Half height of cylinders and thin walls, metres: twice the greatest altitude of agents.
const END: f32 = 4e4;

impl Barrier<Arc<dyn Surface>> {
    /// Returns an obstacle of the plan as a barrier, with coordinates relative to `origin`.
    ///
    /// # Errors
    /// [`Error::Limit`] or [`Error::Shape`] if the obstacle is not valid.
    ///
    /// ```
    /// use glam::{DVec2, Vec3};
    /// use throng::Obstacle;
    /// use throng::space::surface::{Barrier, Surface};
    ///
    /// let pillar = Obstacle::Circle { center: DVec2::new(103.0, 0.0), radius: 1.0 };
    /// let barrier = Barrier::of_obstacle(&pillar, DVec2::new(100.0, 0.0))?;
    /// assert_eq!(barrier.surface.query(Vec3::Z * 9.0).distance, 2.0);
    /// # Ok::<(), throng::Error>(())
    /// ```
    pub fn of_obstacle(obstacle: &Obstacle, origin: DVec2) -> Result<Self, Error> {
        let local = |p: &DVec2| (*p - origin).as_vec2();
        let surface: Arc<dyn Surface> = match obstacle {
            Obstacle::Circle { center, radius } => {
                let center = local(center);
                Arc::new(Cylinder::new(center.extend(-END), center.extend(END), *radius as f32)?)
            }
            Obstacle::Polygon { corners } => Arc::new(ground(corners, origin)?),
            Obstacle::Wall { points } => {
                let walls = points.windows(2).filter(|ends| ends[0] != ends[1]);
                let walls = walls.map(|ends| Ok(Arc::new(wall(local(&ends[0]), local(&ends[1]))?) as Arc<dyn Surface>));
                Arc::new(Union::new(walls.collect::<Result<_, Error>>()?)?)
            }
        };
        Ok(Self::new(surface, SeenFrom::Outside))
    }

    /// Returns the edges of walkable areas as barriers, with coordinates relative to `origin`: agents stay inside one
    /// of the areas and out of the holes. The areas must not overlap. The result is empty if there are no areas, which
    /// means that agents can walk everywhere.
    ///
    /// # Errors
    /// [`Error::Shape`] if an outline encloses nothing or crosses itself.
    pub fn of_ground(areas: &[Walkable], origin: DVec2) -> Result<Vec<Self>, Error> {
        if areas.is_empty() {
            return Ok(Vec::new());
        }
        let outer = areas.iter().map(|area| Ok(Arc::new(ground(&area.outer, origin)?) as Arc<dyn Surface>));
        let outer = Union::new(outer.collect::<Result<_, Error>>()?)?;
        let mut all = vec![Self::new(Arc::new(outer), SeenFrom::Inside)];
        for hole in areas.iter().flat_map(|area| &area.holes) {
            all.push(Self::new(Arc::new(ground(hole, origin)?), SeenFrom::Outside));
        }
        Ok(all)
    }
}

fn ground(corners: &[DVec2], origin: DVec2) -> Result<Prism, Error> {
    Prism::ground(&corners.iter().map(|corner| (*corner - origin).as_vec2()).collect::<Vec<_>>())
}

/// Returns a thin wall from one point to another.
fn wall(from: Vec2, to: Vec2) -> Result<Moved<Cuboid>, Error> {
    let along = (to - from).normalize_or_zero();
    // sine and cosine of half the angle from +x
    let cos = (0.5 * (1.0 + along.x)).max(0.0).sqrt();
    let sin = (0.5 * (1.0 - along.x)).max(0.0).sqrt() * if along.y < 0.0 { -1.0 } else { 1.0 };
    let upright = std::f32::consts::FRAC_1_SQRT_2;
    // the rectangle's y axis is turned upwards, then the rectangle is turned about the vertical
    let turned = Quat::from_xyzw(upright * cos, upright * sin, upright * sin, upright * cos);
    Ok(Moved::new(
        Cuboid::rectangle(Vec2::new(from.distance(to), 2.0 * END))?,
        Pose::new(from.midpoint(to).extend(0.0), turned)?,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::{NearWalls, Walls, nearest_on_segment};

    #[test]
    fn walls_stand_where_their_points_are() {
        for (k, to) in
            [(2.0, 0.0), (0.0, 2.0), (-2.0, 0.0), (0.0, -2.0), (1.5, 1.0), (-3.0, 0.5), (-1.0, -2.0)].iter().enumerate()
        {
            let (from, to) = (DVec2::new(1.0, -2.0), DVec2::new(1.0 + to.0, -2.0 + to.1));
            let made = Barrier::of_obstacle(&Obstacle::Wall { points: vec![from, to] }, DVec2::ZERO).unwrap();
            for i in 0..40 {
                let p = DVec2::from_angle(f64::from(i)) * (0.1 * f64::from(i));
                let distance = f64::from(made.surface.query(p.as_vec2().extend(3.0)).distance);
                let expected = nearest_on_segment(from, to, p).distance(p);
                assert!((distance - expected).abs() < 1e-4, "wall {k}, {p}: {distance} and not {expected}");
            }
        }
    }

    #[test]
    fn barriers_are_as_far_as_walls() {
        let square = |low: f64, high: f64| {
            vec![DVec2::splat(low), DVec2::new(high, low), DVec2::splat(high), DVec2::new(low, high)]
        };
        let origin = DVec2::new(20.0, -7.0);
        let moved = |corners: Vec<DVec2>| corners.into_iter().map(|corner| corner + origin).collect::<Vec<_>>();
        let areas = [Walkable { outer: moved(square(-8.0, 8.0)), holes: vec![moved(square(2.0, 4.0))] }];
        let obstacles = [
            Obstacle::Circle { center: origin + DVec2::new(-4.0, 1.0), radius: 1.5 },
            Obstacle::Polygon { corners: moved(square(-3.0, -2.0)) },
            Obstacle::Wall { points: moved(vec![DVec2::new(-1.0, 5.0), DVec2::new(1.0, 5.0), DVec2::new(1.0, 6.0)]) },
        ];
        let walls = Walls::new(&areas, &obstacles, origin);
        let mut barriers = Barrier::of_ground(&areas, origin).unwrap();
        barriers.extend(obstacles.iter().map(|obstacle| Barrier::of_obstacle(obstacle, origin).unwrap()));
        for i in 0..300 {
            let p = DVec2::from_angle(f64::from(i)) * (0.025 * f64::from(i));
            let near =
                |barrier: &Barrier<Arc<dyn Surface>>| barrier.surface.query(p.as_vec2().extend(0.0)).distance.abs();
            let distance = f64::from(barriers.iter().map(near).fold(f32::INFINITY, f32::min));
            let expected = walls.distance(p, 20.0, &mut NearWalls::default());
            if expected > 0.0 {
                assert!((distance - expected).abs() < 1e-4, "{p}: {distance} and not {expected}");
            }
        }
    }
}
