//! The studio with the model of the lab in its gallery.

mod half_plane;
mod orca;

fn main() -> std::process::ExitCode {
    let plugins = throng_studio::Plugins::new().model::<orca::MyOrca>().scene("ring", include_str!("ring.toml"));
    throng_studio::main(plugins)
}
