//! Timings of the engine: whole steps, and each stage alone. Figures and method: `docs/benches.md`.

mod avoid;
mod guard;
mod navigate;
mod perceive;
mod scenes;
mod step;

fn main() {
    divan::main();
}
