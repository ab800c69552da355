//! How long the engine takes: whole steps, and each stage alone. Figures and how they are made: `docs/benches.md`.

mod avoid;
mod guard;
mod navigate;
mod perceive;
mod scenes;
mod step;

fn main() {
    divan::main();
}
