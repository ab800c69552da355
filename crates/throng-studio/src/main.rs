//! The program `throng-studio`: the studio in a window, or in a web page.

fn main() -> std::process::ExitCode {
    throng_studio::main(throng_studio::Plugins::new())
}
