//! Strips of the plane, one above the other, with about as many balls in each.

use super::super::paths::Paths;
use super::super::piece::radius;
use crate::Balls;

/// Balls that are looked at to lay the strips out.
const SAMPLE: usize = 1024;
/// The slack, in lengths of a mean path.
const SLACK: f64 = 2.5;

/// From one height to another; what touches its bounds is not in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strip {
    bottom: f64,
    top: f64,
}

impl Default for Strip {
    fn default() -> Strip {
        Strip::ALL
    }
}

impl Strip {
    /// The whole plane.
    pub(super) const ALL: Strip = Strip {
        bottom: f64::NEG_INFINITY,
        top: f64::INFINITY,
    };

    /// Whether a disc lies in it.
    #[inline]
    pub(super) fn holds(&self, height: f64, reach: f64) -> bool {
        (height - reach > self.bottom) & (height + reach < self.top)
    }

    /// Whether centres between these heights may be in it.
    pub(super) fn meets(&self, low: f64, high: f64) -> bool {
        high >= self.bottom && low <= self.top
    }
}

/// How the plane is cut.
#[derive(Default)]
pub(super) struct Strips {
    lines: Vec<f64>,
    heights: Vec<f64>,
    /// How far beyond the disc of its first path a ball may get without being relocated.
    pub(super) slack: f64,
}

impl Strips {
    /// Cuts the plane into `count` strips.
    pub(super) fn lay_out(&mut self, paths: &Paths, balls: &Balls, count: usize) {
        let stride = balls.len().div_ceil(SAMPLE).max(1);
        self.heights.clear();
        let mut travel = 0.0;
        for index in (0..balls.len()).step_by(stride) {
            self.heights
                .extend(Some(paths.center[index].y).filter(|height| height.is_finite()));
            travel += 2.0 * (paths.reach[index] - radius(balls, index));
        }
        let length = self.heights.len();
        let slack = SLACK * travel / length.max(1) as f64;
        self.slack = if slack.is_finite() { slack } else { 0.0 };
        self.lines.clear();
        if count > 1 && length > 0 {
            self.heights.sort_unstable_by(f64::total_cmp);
            self.lines
                .extend((1..count).map(|number| self.heights[length * number / count]));
        }
    }

    /// The number of the strip that a centre is in.
    #[inline]
    pub(super) fn of(&self, height: f64) -> usize {
        self.lines.partition_point(|&line| line <= height)
    }

    /// A strip by its number.
    pub(super) fn strip(&self, number: usize) -> Strip {
        let line = |number: usize| self.lines.get(number).copied();
        Strip {
            bottom: number.checked_sub(1).and_then(line).unwrap_or(Strip::ALL.bottom),
            top: line(number).unwrap_or(Strip::ALL.top),
        }
    }
}
