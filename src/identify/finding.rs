//! What was found, and what was not.

/// A part that could not be read off, with what was measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NotIdentified {
    /// Why not.
    pub reason: String,
    /// What stands in the columns of `rows`.
    pub columns: Vec<String>,
    /// What was measured.
    pub rows: Vec<Vec<f64>>,
}

impl NotIdentified {
    pub(super) fn new(reason: impl Into<String>) -> Self {
        NotIdentified {
            reason: reason.into(),
            ..NotIdentified::default()
        }
    }

    pub(super) fn with_rows(mut self, columns: &[&str], rows: Vec<Vec<f64>>) -> Self {
        self.columns = columns.iter().map(ToString::to_string).collect();
        self.rows = rows;
        self
    }

    /// One row an answer, one column a channel.
    pub(super) fn with_answers(self, answers: &[Vec<f64>]) -> Self {
        let most = answers.iter().map(Vec::len).max().unwrap_or(0);
        let columns: Vec<String> = (0..most).map(|k| format!("channel {k}")).collect();
        NotIdentified {
            columns,
            rows: answers.to_vec(),
            ..self
        }
    }

    /// Answers by emission, not too many of them.
    pub(super) fn with_curve(self, c: &[f64], y: &[f64]) -> Self {
        let every = (c.len() / 12).max(1);
        let rows = c.iter().zip(y).step_by(every);
        let rows = rows.map(|(c, y)| vec![*c, *y]).collect();
        self.with_rows(&["C everywhere", "answer"], rows)
    }
}
