//! throng-scene
