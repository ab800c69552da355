//! Tests of the studio without a screen.

mod direct;
mod fingers;
mod keeping;
mod opensteerdemo;
mod panels;
mod people;
mod player;
mod plugins;
mod recording;
mod replay;
mod view;
