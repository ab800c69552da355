//! Which panels are open beside the view, so that the view keeps its place.

use crate::settings::Panels;

/// The width below which panels are sheets below the view, points.
pub const NARROW: f32 = 700.0;
/// The least width of the view beside panels, points, and its least share of the window.
const VIEW: f32 = 400.0;
const SHARE: f32 = 0.4;
/// The least height of a sheet, points.
const SHEET: f32 = 140.0;

/// A panel beside the view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PanelKind {
    /// The results of the run.
    Summary,
    /// The gallery of scenes.
    Gallery,
    /// The plots against time.
    Plots,
    /// The sliders.
    Tuning,
    /// The look of pictures and films.
    Look,
    /// The text of the scene.
    Text,
}

impl PanelKind {
    /// All panels. Of panels that open together, the first ones close first.
    pub const ALL: [Self; 6] = [Self::Summary, Self::Gallery, Self::Plots, Self::Look, Self::Tuning, Self::Text];

    /// Returns the label.
    pub fn label(self) -> &'static str {
        match self {
            Self::Summary => "Summary",
            Self::Gallery => "Gallery",
            Self::Plots => "Plots",
            Self::Tuning => "Tune",
            Self::Look => "Look",
            Self::Text => "Text",
        }
    }

    /// Returns what the panel is for, and its key.
    pub fn says(self) -> &'static str {
        match self {
            Self::Summary => "results of the run and cost of its steps (I)",
            Self::Gallery => "scenes to open (G)",
            Self::Plots => "figures against time; meters (H)",
            Self::Tuning => "sliders for the parameters of the groups (U)",
            Self::Look => "what pictures and films look like: light, colours, shapes",
            Self::Text => "the text of the scene (E)",
        }
    }

    /// Returns the first width, points.
    pub fn width(self) -> f32 {
        match self {
            Self::Summary => 250.0,
            Self::Gallery => 250.0,
            Self::Plots => 320.0,
            Self::Tuning => 340.0,
            Self::Look => 340.0,
            Self::Text => 440.0,
        }
    }

    /// Returns whether the panel is open.
    pub fn open(self, panels: &mut Panels) -> &mut bool {
        match self {
            Self::Summary => &mut panels.summary,
            Self::Gallery => &mut panels.gallery,
            Self::Plots => &mut panels.plots,
            Self::Tuning => &mut panels.tuning,
            Self::Look => &mut panels.look,
            Self::Text => &mut panels.text,
        }
    }
}

/// The open panels, in the order in which they were opened.
#[derive(Clone, Debug, Default)]
pub struct Arrangement {
    opened: Vec<PanelKind>,
    /// The panels that were closed for lack of room, the last one last.
    hidden: Vec<PanelKind>,
    /// The width of the window at the last call, points.
    width: f32,
}

impl Arrangement {
    /// Closes the panels opened first until the view has its place in a window of this width. Opens them again when the
    /// window has become wide enough.
    pub fn fit(&mut self, panels: &mut Panels, width: f32) {
        self.opened.retain(|kind| *kind.open(panels));
        let new = PanelKind::ALL.into_iter().filter(|kind| *kind.open(panels) && !self.opened.contains(kind));
        self.opened.extend(new.collect::<Vec<_>>());
        let room = if width < NARROW { 0.0 } else { room(width) };
        let wide = |opened: &[PanelKind]| opened.iter().map(|kind| kind.width()).sum::<f32>();
        while self.opened.len() > 1 && wide(&self.opened) > room {
            let kind = self.opened.remove(0);
            *kind.open(panels) = false;
            self.hidden.push(kind);
        }
        self.hidden.retain(|kind| !*kind.open(panels));
        let grown = width > std::mem::replace(&mut self.width, width);
        while let Some(kind) =
            self.hidden.last().copied().filter(|kind| grown && wide(&self.opened) + kind.width() <= room)
        {
            self.hidden.pop();
            *kind.open(panels) = true;
            self.opened.insert(0, kind);
        }
    }
}

/// Returns the width that panels beside the view share, in a window of this width.
pub fn room(width: f32) -> f32 {
    width - (SHARE * width).max(VIEW)
}

/// Returns the greatest height of a sheet, so that the view keeps half of the window.
pub fn sheet(whole: f32, free: f32) -> f32 {
    (free - 0.5 * whole).max(SHEET.min(0.5 * free))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn open(panels: &mut Panels) -> Vec<PanelKind> {
        PanelKind::ALL.into_iter().filter(|kind| *kind.open(panels)).collect()
    }

    #[test]
    fn the_panel_opened_last_stays() {
        let (mut panels, mut arrangement) = (Panels::default(), Arrangement::default());
        arrangement.fit(&mut panels, 1440.0);
        assert_eq!(open(&mut panels), [PanelKind::Summary, PanelKind::Gallery]);
        panels.text = true;
        arrangement.fit(&mut panels, 1280.0);
        assert_eq!(open(&mut panels), [PanelKind::Gallery, PanelKind::Text]);
        panels.summary = true;
        arrangement.fit(&mut panels, 390.0);
        assert_eq!(open(&mut panels), [PanelKind::Summary]);
        arrangement.fit(&mut panels, 2560.0);
        assert_eq!(open(&mut panels), [PanelKind::Summary, PanelKind::Gallery, PanelKind::Text], "there is room again");
        // what the user closes stays closed
        panels.gallery = false;
        arrangement.fit(&mut panels, 800.0);
        arrangement.fit(&mut panels, 2560.0);
        assert!(!panels.gallery);
    }

    #[test]
    fn the_view_keeps_its_half() {
        assert_eq!(sheet(844.0, 690.0), 268.0);
        assert!(sheet(360.0, 200.0) <= 100.0, "a low window has a low sheet");
    }
}
