//! What figures were measured on.

use crate::report::number;
use serde_json::{Value, json};
use throng::perceive::Instructions;

/// The machine.
pub struct Machine {
    /// The processor's name.
    pub cpu: String,
    /// How many threads it runs at a time.
    pub cores: usize,
    /// The vectors that steps are made with.
    pub instructions: &'static str,
    /// Programs running at the moment, a mean over a minute; not a number where the system does not tell.
    pub load: f64,
}

impl Machine {
    /// This one, as it is now.
    pub fn here() -> Self {
        let read = |path: &str| std::fs::read_to_string(path).unwrap_or_default();
        let cpu = read("/proc/cpuinfo");
        let cpu = cpu.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
        let load = read("/proc/loadavg");
        Self {
            cpu: cpu.map_or(std::env::consts::ARCH, |(_, name)| name).to_owned(),
            cores: std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
            instructions: Instructions::default().found().unwrap_or("none"),
            load: load.split_whitespace().next().and_then(|load| load.parse().ok()).unwrap_or(f64::NAN),
        }
    }

    /// It as one line, with this program.
    pub fn line(&self) -> String {
        let load = if self.load.is_nan() { String::new() } else { format!(", load {}", self.load) };
        let (version, profile) = (env!("CARGO_PKG_VERSION"), profile());
        format!("{}, {} cores, {}{load}; throng {version}, {profile}", self.cpu, self.cores, self.instructions)
    }

    /// It for programs.
    pub fn json(&self) -> Value {
        json!({
            "cpu": self.cpu,
            "cores": self.cores,
            "instructions": self.instructions,
            "system": format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
            "load": number(self.load),
        })
    }
}

/// How this program was built.
pub fn profile() -> &'static str {
    if cfg!(debug_assertions) { "dev" } else { "release" }
}

/// Bytes of memory that programs can still have, where the system tells.
pub fn free_memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    Some(line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()? * 1024)
}
