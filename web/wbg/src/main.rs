//! `wbg IN.wasm OUT_DIR`: writes a wasm module, the JavaScript that loads it, and the fonts of the page.

use epaint_default_fonts::{HACK_REGULAR, UBUNTU_LIGHT};
use std::fs;
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [input, output] = arguments.as_slice() else {
        eprintln!("usage: wbg IN.wasm OUT_DIR");
        return ExitCode::FAILURE;
    };
    let mut bindgen = wasm_bindgen_cli_support::Bindgen::new();
    bindgen.input_path(input).out_name("throng-studio").typescript(false).omit_default_module_path(false);
    let done = bindgen.web(true).and_then(|bindgen| bindgen.generate(output));
    match done.and_then(|()| Ok(fonts(&Path::new(output).join("fonts"))?)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// Writes the fonts of panels and code under the names that the page fetches.
fn fonts(folder: &Path) -> std::io::Result<()> {
    fs::create_dir_all(folder)?;
    fs::write(folder.join("ubuntu-light.ttf"), UBUNTU_LIGHT)?;
    fs::write(folder.join("hack-regular.ttf"), HACK_REGULAR)
}
