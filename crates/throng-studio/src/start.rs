//! Start options, from the command line or from the address of a page.

use crate::Face;
use crate::settings::Settings;
use crate::view::{FirstView, Mode};
use std::path::PathBuf;
use throng_draw::Typeface;
use throng_scene::Plugins;

/// Start options of the studio.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// A name of the gallery or a file. Without it, the scene opened last.
    pub scene: Option<String>,
    /// The step at which the scene is shown, paused. Without it, the scene runs.
    pub at_step: Option<u64>,
    /// Whether the scene is opened without playing it, because it stopped the studio the last time.
    pub rest: bool,
    /// The agent selected at first.
    pub select: Option<u32>,
    /// The first camera. Without it, the plan view.
    pub camera: Option<Mode>,
    /// The pose of the first camera ([`Eye::pose`](crate::view::Eye::pose)).
    pub eye: Option<String>,
    /// Whether the stored settings are not used.
    pub defaults: bool,
    /// What is around the view. Without it, the studio, or the start page at the first start.
    pub face: Option<Face>,
    /// Whether the scene waits for the user to play it.
    pub paused: bool,
    /// Settings that differ from the stored ones: `key=value`, as in [`Settings::set`].
    pub with: Vec<String>,
    /// The file that the [`State`](crate::state::State) is written to.
    pub state: Option<PathBuf>,
    /// The file that a screenshot is written to. The studio closes afterwards.
    pub screenshot: Option<PathBuf>,
    /// The typeface of recorded pictures.
    pub typeface: Typeface,
    /// Behaviours, rules and scenes of plug-ins.
    pub plugins: Plugins,
}

impl Options {
    /// Parses the part of an address after `#`: `circle`, or `circle@500` for the state after 500 steps, followed by
    /// `select=3`, `camera=orbit`, `eye=` with the pose of the camera, `defaults` for no stored settings, a
    /// [face](Face::named), and [settings](Settings::set) such as `panels.plots=true`, each after a `&`.
    ///
    /// # Errors
    /// A step, a number or a camera is invalid.
    ///
    /// ```
    /// use throng_studio::{Options, view::Mode};
    ///
    /// let options = Options::of_address("boids@120&camera=orbit&dark=true")?;
    /// assert_eq!((options.scene.as_deref(), options.at_step), (Some("boids"), Some(120)));
    /// assert_eq!((options.camera, options.with), (Some(Mode::Orbit), vec!["dark=true".to_owned()]));
    /// # Ok::<(), String>(())
    /// ```
    pub fn of_address(hash: &str) -> Result<Self, String> {
        let mut parts = hash.split('&');
        let first = parts.next().unwrap_or_default();
        let (scene, step) = first.split_once('@').map_or((first, None), |(scene, step)| (scene, Some(step)));
        let mut options = Self { scene: Some(scene.to_owned()).filter(|scene| !scene.is_empty()), ..Self::default() };
        options.at_step = step.map(|step| step.parse().map_err(|_| format!("`@{step}` is no step"))).transpose()?;
        for part in parts.filter(|part| !part.is_empty()) {
            match part.split_once('=') {
                Some(("select", number)) => {
                    let number = number.parse().map_err(|_| format!("`{part}`: an agent's number is expected"))?;
                    options.select = Some(number);
                }
                Some(("camera", mode)) => options.camera = Some(mode.parse()?),
                Some(("eye", pose)) => options.eye = Some(pose.to_owned()),
                None if part == "defaults" => options.defaults = true,
                None if Face::named(part).is_some() => options.face = Face::named(part),
                _ => options.with.push(part.to_owned()),
            }
        }
        Ok(options)
    }

    /// Applies the settings of the options.
    ///
    /// # Errors
    /// There is no such setting, or the value is invalid.
    pub fn adjust(&self, settings: &mut Settings) -> Result<(), String> {
        if self.defaults {
            *settings = Settings { scene: std::mem::take(&mut settings.scene), ..Settings::default() };
        }
        self.with.iter().try_for_each(|said| settings.set(said))
    }

    /// Returns what the view begins with.
    pub fn first_view(&self) -> FirstView {
        FirstView { selected: self.select, mode: self.camera, pose: self.eye.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_address_says_what_to_show() {
        assert_eq!(Options::of_address("").unwrap().scene, None);
        let packed = Options::of_address("text=eJwr-_&select=7").unwrap();
        assert_eq!((packed.scene.as_deref(), packed.select), (Some("text=eJwr-_"), Some(7)));
        for wrong in ["circle@x", "circle&select=-1", "circle&camera=sideways"] {
            assert!(Options::of_address(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn settings_are_adjusted_by_name() {
        let mut settings = Settings::default();
        let with = ["dark=true", "panels.plots=true", "trails=0.5", "coloring=Speed", "beside=rvo"];
        let options = Options { with: with.map(str::to_owned).into(), ..Options::default() };
        options.adjust(&mut settings).unwrap();
        assert!(settings.dark && settings.panels.plots && settings.trails == 0.5 && settings.beside == "rvo");
        let before = settings.clone();
        for wrong in ["night=true", "panels.plots=7", "panels.none=true", "dark", "coloring=Loud", "panels=true"] {
            let says = settings.set(wrong).unwrap_err();
            assert!(says.contains(wrong.split('=').next().unwrap()), "{says}");
        }
        assert_eq!(settings, before);
    }

    #[test]
    fn choices_have_the_labels_of_the_panels() {
        use crate::play::Speed;
        use crate::view::{Coloring, Heat, Marks};
        let mut settings = Settings::default();
        for with in ["coloring=time to goal", "marks=Discs", "speed=2x", "layers.heat=DENSITY"] {
            settings.set(with).unwrap();
        }
        assert_eq!((settings.coloring, settings.marks), (Coloring::TimeToGoal, Marks::Discs));
        assert_eq!((settings.speed, settings.layers.heat), (Speed::Times(2.0), Heat::Density));
        for (with, coloring) in [("coloring=time-to-goal", Coloring::TimeToGoal), ("coloring=Speed", Coloring::Speed)] {
            settings.set("coloring=group").unwrap();
            settings.set(with).unwrap();
            assert_eq!(settings.coloring, coloring, "{with}");
        }
        settings.set(r#"speed={"Times":0.5}"#).unwrap();
        assert_eq!(settings.speed, Speed::Times(0.5));
        let says = settings.set("coloring=loud").unwrap_err();
        assert!(
            says.ends_with("coloring is one of: group, speed, goal, altitude, density, model, time to goal"),
            "{says}"
        );
    }
}
