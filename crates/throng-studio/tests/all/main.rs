//! Tests of the studio without a screen.

mod direct;
mod fingers;
mod keeping;
mod opensteerdemo;
mod panels;
mod player;
mod plugins;
mod recording;
mod replay;
