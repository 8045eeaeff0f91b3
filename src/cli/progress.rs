//! How far a run has come.

use indicatif::{ProgressBar, ProgressStyle};
use volver::study::Progress;

/// A bar on the terminal, none where standard error is something else.
pub(crate) struct Bar(ProgressBar);

impl Bar {
    pub(crate) fn new(units: u64) -> Self {
        let bar = ProgressBar::new(units);
        let template = "{wide_bar} {percent:>3} %, {eta} left";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        Bar(bar)
    }

    /// What an earlier run has done tells nothing of the time that is left.
    pub(crate) fn skip(&self, units: u64) {
        self.0.inc(units);
        self.0.reset_eta();
    }

    /// Lets `print` write where the bar stands.
    pub(crate) fn above(&self, print: impl FnOnce()) {
        self.0.suspend(print);
    }

    pub(crate) fn finish(&self) {
        self.0.finish_and_clear();
    }
}

impl Progress for Bar {
    fn advance(&self, units: u64) {
        self.0.inc(units);
    }
}
