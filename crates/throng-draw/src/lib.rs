//! throng-draw
