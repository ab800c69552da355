//! Tests of the studio without a screen.

mod direct;
mod filming;
mod fingers;
mod intervening;
mod keeping;
mod layout;
mod lessons;
mod look;
mod opensteerdemo;
mod panels;
mod people;
mod player;
mod plugins;
mod recording;
mod replay;
mod view;
