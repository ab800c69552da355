//! Nested viewports: the position of a view box in its viewport.

use crate::geometry::DVec2;
use glam::DAffine2;
use svgtypes::{Align, AspectRatio, ViewBox};

/// Returns the transform from a view box to a viewport of a size at the origin.
pub(super) fn fitted(view: &ViewBox, room: DVec2, ratio: AspectRatio) -> DAffine2 {
    let size = DVec2::new(view.w, view.h);
    let scale = room / size;
    let scale = match (ratio.align, ratio.slice) {
        (Align::None, _) => scale,
        (_, false) => DVec2::splat(scale.min_element()),
        (_, true) => DVec2::splat(scale.max_element()),
    };
    let left = room - size * scale;
    let part = match ratio.align {
        Align::None | Align::XMinYMin => DVec2::ZERO,
        Align::XMidYMin => DVec2::new(0.5, 0.0),
        Align::XMaxYMin => DVec2::new(1.0, 0.0),
        Align::XMinYMid => DVec2::new(0.0, 0.5),
        Align::XMidYMid => DVec2::splat(0.5),
        Align::XMaxYMid => DVec2::new(1.0, 0.5),
        Align::XMinYMax => DVec2::new(0.0, 1.0),
        Align::XMidYMax => DVec2::new(0.5, 1.0),
        Align::XMaxYMax => DVec2::ONE,
    };
    DAffine2::from_translation(left * part)
        * DAffine2::from_scale(scale)
        * DAffine2::from_translation(-DVec2::new(view.x, view.y))
}
