//! The program `throng-studio`: the studio in a window, or in a web page.

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    use clap::Parser;
    match throng_studio::window::open(throng_studio::window::Arguments::parse()) {
        Ok(()) => std::process::ExitCode::SUCCESS,
        Err(says) => {
            eprintln!("error: {says}");
            std::process::ExitCode::FAILURE
        }
    }
}

#[cfg(target_arch = "wasm32")]
fn main() {
    throng_studio::page::open();
}
