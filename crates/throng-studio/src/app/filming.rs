//! The keys of the scene's camera.

use super::App;
use crate::document::CameraEdit;
use crate::face::Face;
use crate::panels::CameraRequest;
use crate::play::{Command, RunMoment};
use throng_scene::CameraKey;

/// The rate of films without one in `[view]`, pictures per second.
const RATE: f64 = 25.0;

impl App {
    /// Returns the keys of the scene's camera, `None` where they cannot be edited: in replays and outside of the studio.
    pub(super) fn camera_keys(&self, shown: &RunMoment) -> Option<Vec<CameraKey>> {
        (self.face == Face::Studio && shown.reel.is_none()).then(|| self.document.camera_keys().to_vec())
    }

    /// Does what the user requests about the keys of the camera. The run goes on.
    pub(super) fn film(&mut self, request: CameraRequest, shown: &RunMoment) {
        let Some(keys) = self.camera_keys(shown) else { return };
        let time = shown.time();
        let edit = match (request, self.views[0].camera_key(time)) {
            (CameraRequest::Key, Some(key)) => {
                let replaced = self.document.replaced_by_camera_keys();
                let replaced = replaced.map(|name| format!("; keys replace the {name}")).unwrap_or_default();
                self.pass(format!("the camera has a key at {time:.2} s{replaced}"));
                CameraEdit::Add(key, 0.5 / shown.scene.view.fps.unwrap_or(RATE))
            }
            (CameraRequest::Replace(at), Some(key)) => CameraEdit::Replace(at, key),
            (CameraRequest::Key | CameraRequest::Replace(_), None) => {
                self.notice = Some("a plan cannot be a key of the camera: choose the camera *orbit* first".into());
                return;
            }
            (CameraRequest::Cut(at), _) => CameraEdit::Cut(at),
            (CameraRequest::Remove(at), _) => CameraEdit::Remove(at),
            (CameraRequest::Move(at, time), _) => CameraEdit::Move(at, time),
            (CameraRequest::Seek(at), _) => return self.seek_key(&keys[at], shown),
            (CameraRequest::Look(at), _) => {
                self.seek_key(&keys[at], shown);
                return self.views[0].film();
            }
        };
        match self.document.change_camera(edit) {
            Ok(()) => {
                if matches!(edit, CameraEdit::Add(..) | CameraEdit::Replace(..)) {
                    self.views[0].eye.stay();
                }
                self.notice = None;
                self.change();
            }
            Err(says) => (self.notice, self.passing) = (Some(says), None),
        }
    }

    /// Goes to the step at the time of a key; to the first step behind a cut.
    fn seek_key(&mut self, key: &CameraKey, shown: &RunMoment) {
        let steps = key.time / shown.scene.time.step;
        let step = if key.cut { (steps - 1e-6).ceil() } else { steps.round() };
        self.player.command(Command::Seek(step as u64));
    }
}
