//! A sink that encodes on its own thread while the next picture is painted.

use super::FrameSink;
use crate::{Error, Image};
use std::sync::Arc;
use throng_record::{BackgroundWriter, Pool};

/// Passes pictures to another sink on a separate thread. The result is the same; an error is returned by one of the
/// following calls.
#[derive(Debug)]
pub struct Ahead {
    /// `None` after an error.
    sink: Option<BackgroundWriter<Box<dyn FrameSink>, Arc<Image>, Error>>,
    pictures: Pool<Image>,
}

impl Ahead {
    /// Moves `sink` to a separate thread.
    pub fn start(sink: Box<dyn FrameSink>) -> Self {
        let sink = BackgroundWriter::start("throng-encode", sink, |sink, image: Arc<Image>| sink.push(&image));
        Self { sink: Some(sink), pictures: Pool::default() }
    }
}

impl FrameSink for Ahead {
    fn push(&mut self, image: &Image) -> Result<(), Error> {
        let sink = self.sink.as_mut().ok_or(Error::Ended)?;
        let copy = self.pictures.make(|copy| copy.copy_from(image));
        if sink.push(copy) { Ok(()) } else { self.sink.take().ok_or(Error::Ended)?.finish().map(|_| ()) }
    }

    fn finish(self: Box<Self>) -> Result<(), Error> {
        self.sink.ok_or(Error::Ended)?.finish()?.finish()
    }
}
