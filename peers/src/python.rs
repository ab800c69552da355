//! Simulators in Python: a script that receives commands on its standard input and answers with its times.

use crate::contest::{Contestant, Turn};
use std::error::Error;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::Duration;

/// A running script.
pub struct Python {
    name: String,
    child: Child,
    to: ChildStdin,
    from: BufReader<ChildStdout>,
}

impl Python {
    /// Starts a script, sends it lists of lines, each after its length, and waits until it is warmed up.
    ///
    /// # Errors
    /// The script cannot be started, or ends; it has reported the reason on standard error.
    pub fn start(
        python: &Path,
        name: &str,
        script: &str,
        arguments: &[String],
        lists: &[&[String]],
    ) -> Result<Self, Box<dyn Error>> {
        let mut child = Command::new(python)
            .args(["-c", script])
            .args(arguments)
            .env("OMP_NUM_THREADS", "1")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()?;
        let to = child.stdin.take().ok_or("no standard input")?;
        let from = BufReader::new(child.stdout.take().ok_or("no standard output")?);
        let mut script = Self { name: name.into(), child, to, from };
        for lines in lists {
            writeln!(script.to, "{}", lines.len())?;
            for line in *lines {
                writeln!(script.to, "{line}")?;
            }
        }
        // the answer is its name and version
        script.name = script.answer()?;
        Ok(script)
    }

    fn answer(&mut self) -> Result<String, Box<dyn Error>> {
        self.to.flush()?;
        let mut line = String::new();
        if self.from.read_line(&mut line)? == 0 {
            return Err(format!("{} ended", self.name).into());
        }
        Ok(line.trim().to_owned())
    }
}

impl Contestant for Python {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn restart(&mut self) -> Result<(), Box<dyn Error>> {
        writeln!(self.to, "restart")?;
        self.answer().map(|_| ())
    }

    fn steps(&mut self, count: u32) -> Result<Turn, Box<dyn Error>> {
        writeln!(self.to, "steps {count}")?;
        let answer = self.answer()?;
        let numbers: Vec<f64> = answer.split_whitespace().map(str::parse).collect::<Result<_, _>>()?;
        let [agent_steps, cpu, seconds] = numbers[..] else { return Err(format!("{}: {answer}", self.name).into()) };
        Ok(Turn { agent_steps: agent_steps as u64, cpu: Duration::from_secs_f64(cpu), seconds })
    }
}

impl Drop for Python {
    fn drop(&mut self) {
        // the process has no state to lose
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
