//! throng-record
