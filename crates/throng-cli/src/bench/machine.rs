//! The machine that figures were measured on.

use crate::report::number;
use serde_json::{Value, json};
use throng::perceive::SimdLevel;

/// The properties of a machine.
pub struct Machine {
    /// The processor's name.
    pub cpu: String,
    /// How many threads it runs at the same time.
    pub cores: usize,
    /// The SIMD instruction set that steps use.
    pub instructions: &'static str,
    /// The mean number of running programs over one minute; NaN where the system does not report it.
    pub load: f64,
}

impl Machine {
    /// Returns the properties of this machine, with its current load.
    pub fn here() -> Self {
        let read = |path: &str| std::fs::read_to_string(path).unwrap_or_default();
        let cpu = read("/proc/cpuinfo");
        let cpu = cpu.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
        let load = read("/proc/loadavg");
        Self {
            cpu: cpu.map_or(std::env::consts::ARCH, |(_, name)| name).to_owned(),
            cores: std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
            instructions: SimdLevel::default().found().unwrap_or("none"),
            load: load.split_whitespace().next().and_then(|load| load.parse().ok()).unwrap_or(f64::NAN),
        }
    }

    /// Returns the machine and this program as one line of text.
    pub fn line(&self) -> String {
        let load = if self.load.is_nan() { String::new() } else { format!(", load {}", self.load) };
        let (version, profile) = (env!("CARGO_PKG_VERSION"), profile());
        format!("{}, {} cores, {}{load}; throng {version}, {profile}", self.cpu, self.cores, self.instructions)
    }

    /// Returns the machine as JSON.
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

/// Returns the build profile of this program: `dev` or `release`.
pub fn profile() -> &'static str {
    if cfg!(debug_assertions) { "dev" } else { "release" }
}

/// Returns the free memory in bytes, where the system reports it.
pub fn free_memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    Some(line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()? * 1024)
}
