//! Progress of a study: a bar on a terminal, nothing elsewhere.

use std::io::IsTerminal;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use pounding_study::Progress;

/// The bar.
pub struct Bar {
    bar: ProgressBar,
    begun: bool,
}

impl Bar {
    /// A bar that has not begun.
    pub fn new() -> Self {
        let bar = if std::io::stderr().is_terminal() {
            ProgressBar::new(0)
        } else {
            ProgressBar::hidden()
        };
        let template = "{elapsed:>4} {wide_bar} {pos}/{len} runs  {per_sec}  {eta} left{msg}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        Self { bar, begun: false }
    }

    /// Shows where the study stands.
    pub fn show(&mut self, now: &Progress) {
        if !self.begun {
            // Rate and remaining time are those of this call.
            self.bar.set_length((now.total - now.stored_before) as u64);
            self.bar.reset();
            self.bar.enable_steady_tick(Duration::from_millis(200));
            self.begun = true;
        }
        self.bar.set_position(now.made as u64);
        let mut message = String::new();
        for (count, what) in [(now.failed, "failed"), (now.collapsed, "collapsed")] {
            if count > 0 {
                message.push_str(&format!("  {count} {what}"));
            }
        }
        self.bar.set_message(message);
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}
