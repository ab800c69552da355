//! Edits of the keys of the scene's camera (`view.camera.keys`).

use super::{Document, Edit};
use throng_scene::{Camera, CameraKey, Projection, Scene};
use toml_edit::{Array, InlineTable, Value};

/// The path of the keys.
const KEYS: &str = "view.camera.keys";

/// An edit of the keys of the camera. Keys are numbered in the order of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CameraEdit {
    /// Adds a key. It replaces the nearest key within some seconds.
    Add(CameraKey, f64),
    /// Gives a key the camera of another key, but not its time.
    Replace(usize, CameraKey),
    /// Moves a key to a time, seconds.
    Move(usize, f64),
    /// Makes the film cut to a key, or move to it.
    Cut(usize),
    /// Removes a key.
    Remove(usize),
}

impl Document {
    /// Returns the keys of the scene's camera.
    pub fn camera_keys(&self) -> &[CameraKey] {
        self.scene().ok().and_then(|scene| scene.view.camera.as_ref()).map_or(&[], |camera| &camera.keys)
    }

    /// Returns what keys of the camera replace: its motion, or a plan.
    pub fn replaced_by_camera_keys(&self) -> Option<&'static str> {
        self.scene().ok().and_then(|scene| replaced(scene)).map(|(_, name)| name)
    }

    /// Changes the keys of the scene's camera in one step that can be undone.
    ///
    /// # Errors
    /// As [`Document::change`].
    pub fn change_camera(&mut self, change: CameraEdit) -> Result<(), String> {
        let keys = self.camera_keys().to_vec();
        let other = self.scene().ok().and_then(|scene| replaced(scene)).map(|(path, _)| path);
        self.change(|edit| {
            match change {
                CameraEdit::Add(key, near) => {
                    other.into_iter().try_for_each(|path| edit.remove(path).map(drop))?;
                    let distance = |at: usize| rounded((keys[at].time - key.time).abs());
                    let nearest = (0..keys.len()).min_by(|&a, &b| distance(a).total_cmp(&distance(b)));
                    match nearest.filter(|&at| distance(at) <= near) {
                        Some(at) => {
                            edit.set(&format!("{KEYS}.{at}.time"), rounded(key.time))?;
                            set_sight(edit, at, &key)?;
                        }
                        None => _ = edit.push(KEYS, table(&key))?,
                    }
                }
                CameraEdit::Replace(at, key) => set_sight(edit, at, &key)?,
                CameraEdit::Move(at, time) => edit.set(&format!("{KEYS}.{at}.time"), rounded(time))?,
                CameraEdit::Cut(at) => {
                    let path = format!("{KEYS}.{at}.cut");
                    match keys.get(at).is_some_and(|key| key.cut) {
                        true => _ = edit.remove(&path)?,
                        false => edit.set(&path, true)?,
                    }
                }
                CameraEdit::Remove(_) if keys.len() == 1 => return edit.remove(KEYS).map(drop),
                CameraEdit::Remove(at) => _ = edit.remove(&format!("{KEYS}.{at}"))?,
            }
            edit.sort(KEYS, "time")
        })
    }
}

/// Returns the path and the name of what keys of the camera replace.
fn replaced(scene: &Scene) -> Option<(&'static str, &'static str)> {
    let usual = Camera::default();
    let camera = scene.view.camera.as_ref().unwrap_or(&usual);
    let all = [
        (camera.orbit.is_some(), "view.camera.orbit", "orbit"),
        (camera.follow.is_some(), "view.camera.follow", "camera that follows an agent"),
        (camera.crowd, "view.camera.crowd", "camera that follows the crowd"),
        (scene.view.projection == Some(Projection::Plan), "view.projection", "plan"),
    ];
    all.into_iter().find(|(given, ..)| *given).map(|(_, path, name)| (path, name))
}

fn set_sight(edit: &mut Edit, at: usize, key: &CameraKey) -> Result<(), String> {
    for (name, value) in sight(key) {
        edit.set(&format!("{KEYS}.{at}.{name}"), value)?;
    }
    Ok(())
}

fn table(key: &CameraKey) -> InlineTable {
    std::iter::once(("time", Value::from(rounded(key.time)))).chain(sight(key)).collect()
}

/// Returns the values of a key but its time.
fn sight(key: &CameraKey) -> impl Iterator<Item = (&'static str, Value)> {
    let point = |point: [f64; 3]| Value::from(Array::from_iter(point.map(rounded)));
    let angle = key.field_of_view.map(|angle| ("field_of_view", Value::from(rounded(angle))));
    [("eye", point(key.eye)), ("target", point(key.target))].into_iter().chain(angle)
}

/// Rounds metres, seconds and degrees to thousandths.
fn rounded(number: f64) -> f64 {
    (number * 1000.0).round() / 1000.0 + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    const GROUP: &str = "[[group]]\ncount = 1\nplace.point = [0, 0]\ngoal.point = [9, 0]\n";

    fn key(time: f64) -> CameraKey {
        CameraKey { time, eye: [1.0, -9.12345, 4.0], target: [0.0, 0.0, 1.0], field_of_view: Some(40.0), cut: false }
    }

    fn times(document: &Document) -> Vec<f64> {
        document.camera_keys().iter().map(|key| key.time).collect()
    }

    #[test]
    fn keys_are_added_in_the_order_of_time_and_replace_near_keys() {
        let mut document = Document::new("shot", GROUP);
        for time in [2.0, 0.5, 4.0, 0.52] {
            document.change_camera(CameraEdit::Add(key(time), 0.02)).unwrap();
        }
        assert_eq!(times(&document), [0.52, 2.0, 4.0]);
        let lines = "view.camera.keys = [\n    { time = 0.52, eye = [1.0, -9.123, 4.0], target = [0.0, 0.0, 1.0], \
                     field_of_view = 40.0 },\n    { time = 2.0";
        assert!(document.text().starts_with(lines), "{}", document.text());
        document.change_camera(CameraEdit::Move(0, 3.0)).unwrap();
        document.change_camera(CameraEdit::Cut(1)).unwrap();
        assert_eq!((times(&document), document.camera_keys()[1].cut), (vec![2.0, 3.0, 4.0], true));
        document.change_camera(CameraEdit::Cut(1)).unwrap();
        document.change_camera(CameraEdit::Remove(0)).unwrap();
        assert_eq!((times(&document), document.camera_keys()[0].cut), (vec![3.0, 4.0], false));
        (0..2).for_each(|_| document.change_camera(CameraEdit::Remove(0)).unwrap());
        assert_eq!(document.text(), GROUP, "nothing is left");
        (0..10).for_each(|_| assert!(document.undo()));
        assert!(!document.undo(), "each edit is one step");
    }

    #[test]
    fn keys_replace_what_moved_the_camera_before() {
        for (view, name, left) in [
            ("projection = \"plan\"\n", "plan", ""),
            ("camera = { orbit = 6.0, field_of_view = 50 } # round\n", "orbit", "camera = { field_of_view = 50, "),
            ("camera.follow = 0\n", "camera that follows an agent", "camera.keys = ["),
        ] {
            let mut document = Document::new("shot", format!("{GROUP}[view]\n{view}"));
            assert_eq!(document.replaced_by_camera_keys(), Some(name));
            document.change_camera(CameraEdit::Add(key(1.0), 0.02)).unwrap();
            assert_eq!((document.replaced_by_camera_keys(), times(&document)), (None, vec![1.0]));
            assert!(document.text().contains(left), "{}", document.text());
        }
    }

    #[test]
    fn comments_go_with_their_keys() {
        let keys = "# first\n[[view.camera.keys]]\ntime = 1 # s\neye = [0, 9, 9]\ntarget = [0, 0, 0]\n\
                    \n# second\n[[view.camera.keys]]\ntime = 2\neye = [0, 9, 8]\ntarget = [0, 0, 0]\n\n[time]\nlimit = 9\n";
        let mut document = Document::new("shot", format!("{GROUP}\n{keys}"));
        document.change_camera(CameraEdit::Move(0, 3.0)).unwrap();
        document.change_camera(CameraEdit::Replace(0, key(7.0))).unwrap();
        let text = document.text();
        assert_eq!(times(&document), [2.0, 3.0]);
        assert!(text.contains("# second\n[[view.camera.keys]]\ntime = 2\neye = [1.0, -9.123, 4.0]"), "{text}");
        assert!(text.ends_with("# first\n[[view.camera.keys]]\ntime = 3.0 # s\neye = [0, 9, 9]\ntarget = [0, 0, 0]\n\n[time]\nlimit = 9\n"), "{text}");
    }
}
