//! The world as files show it.

use throng::World;
use throng_record::{Frame, Setting};

/// The place and the names. The group every world has from the start is left out: no scene puts anybody into it.
pub fn setting(world: &World, title: &str) -> Setting {
    let mut setting = Setting::of(world, title);
    setting.groups.remove(0);
    setting
}

/// Makes `frame` show the world as it is now; groups are counted as in [`setting`].
pub fn capture(world: &World, frame: &mut Frame) {
    frame.capture(world);
    for body in &mut frame.bodies {
        body.group = body.group.saturating_sub(1);
    }
}
