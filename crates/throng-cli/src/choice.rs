//! The part of a run that is written.

use crate::look::{parse_not_negative, parse_positive};
use clap::Args;
use std::ops::RangeInclusive;
use throng_record::people::FigureStyle;
use throng_record::{Choice, Column};

/// Options for the part of a run that is written.
#[derive(Args, Clone, Debug, Default)]
#[command(next_help_heading = "What is written")]
pub struct ChoiceArgs {
    /// Leaves out everything before this time, seconds
    #[arg(long, value_name = "SECONDS", value_parser = parse_not_negative)]
    pub from: Option<f64>,

    /// Leaves out everything after this time, seconds
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive)]
    pub to: Option<f64>,

    /// Moments per second in files of trajectories, interpolated linearly between steps [default: every step]
    #[arg(long, value_name = "N", value_parser = parse_positive)]
    pub rate: Option<f64>,

    /// Only the agents with these numbers, in files of trajectories
    #[arg(long, value_name = "N,N-M,...", value_delimiter = ',', value_parser = Choice::numbers)]
    pub agents: Vec<RangeInclusive<u32>>,

    /// Only these groups, in files of trajectories
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    pub groups: Vec<String>,

    /// The columns of tables (.csv, .parquet), in this order: number, group, time, x, y, z, vx, vy, vz, heading, radius, status
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    pub columns: Vec<Column>,

    /// People in .glb, .usda and .bvh: auto (skins, for up to 300 agents), skins, baked (.glb: poses in one buffer), none
    #[arg(long, value_name = "STYLE", default_value = "auto")]
    pub figures: FigureStyle,
}

impl ChoiceArgs {
    /// Returns the options as a [`Choice`].
    pub fn choice(&self) -> Choice {
        Choice {
            from: self.from.unwrap_or(f64::NEG_INFINITY),
            to: self.to.unwrap_or(f64::INFINITY),
            rate: self.rate,
            agents: self.agents.clone(),
            groups: self.groups.clone(),
            columns: self.columns.clone(),
            figures: self.figures,
        }
    }
}
