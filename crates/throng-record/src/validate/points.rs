//! Measured points of experiments with pedestrians, for plots.
//!
//! `points.csv` is a thinned selection of published measurements, as the validation of JuPedSim collects them: every
//! 14th of the single file points, every 4th of the one-way corridor, every 3rd of the two-way corridor, and all flows
//! through doors. Sources: A. Seyfried and others, J. Stat. Mech. P10002 (2005) and *Pedestrian and Evacuation Dynamics
//! 2008* (single file); J. Zhang and others, J. Stat. Mech. P06004 (2011) and P02002 (2012) (corridors); Müller (1981);
//! Kretz and others (2006); Nagai and others (2006); Seyfried and others (2009); Liao and others (experiments AO, EG);
//! Daamen and Hoogendoorn (2010) (doors).

/// A measured point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredPoint {
    /// The run or the study.
    pub study: &'static str,
    /// Density (1/m in single file, else 1/m²), or the width of a door (m).
    pub x: f64,
    /// Speed (m/s), or the flow through a door (1/s).
    pub y: f64,
}

/// Returns the points of an experiment, by its name; empty for experiments without points.
///
/// ```
/// use throng_record::validate::points;
/// let slow = points::of("single-file").filter(|point| point.x > 2.0);
/// assert!(slow.clone().count() > 10 && slow.clone().all(|point| point.y < 0.4));
/// ```
pub fn of(experiment: &str) -> impl Iterator<Item = MeasuredPoint> + Clone {
    include_str!("points.csv").lines().skip(1).filter_map(move |line| {
        let mut cells = line.split(',');
        let kind = cells.next()?;
        let point =
            MeasuredPoint { study: cells.next()?, x: cells.next()?.parse().ok()?, y: cells.next()?.parse().ok()? };
        (kind == experiment).then_some(point)
    })
}
