//! The studio with this plug-in in its gallery.

fn main() -> std::process::ExitCode {
    throng_studio::main(my_plugin::plugins())
}
