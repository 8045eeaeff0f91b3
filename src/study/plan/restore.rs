//! A plan from what was kept of it.

use super::layout::Stretch;
use super::run::Task;
use super::stored::{Step, StoredPlan, VERSION};
use super::{Model, Plan, PlanError};
use crate::real::FormatError;
use crate::scene::{Form, Medium, Scene};
use crate::symbolic::parse_number;

impl Plan {
    /// A stored plan for its scene.
    ///
    /// # Errors
    /// [`PlanError::OtherScene`] and [`PlanError::Step`] where it is for another one, or damaged.
    pub fn from_stored(scene: &Scene, stored: StoredPlan) -> Result<Plan, PlanError> {
        if stored.plan != VERSION {
            return Err(PlanError::Step {
                step: 1,
                reason: format!("a plan of version {}, not {VERSION}", stored.plan),
            });
        }
        if stored.scene != scene.fingerprint() {
            return Err(PlanError::OtherScene {
                plan: stored.scene.escape_debug().to_string(),
                scene: scene.fingerprint().into(),
            });
        }
        let wrong = |step: usize, reason: String| PlanError::Step { step, reason };
        let format = stored
            .format
            .parse()
            .map_err(|error: FormatError| wrong(1, error.to_string()))?;
        let mut tasks = Vec::with_capacity(stored.steps.len());
        let mut place = None;
        for (i, step) in stored.steps.iter().enumerate() {
            let task = task(scene, step).map_err(|reason| wrong(i + 1, reason))?;
            let begin = place.unwrap_or_else(|| scene.media()[0].from());
            if task.stretch.from != begin {
                let reason = format!("it begins at {}, not at {begin}", step.from);
                return Err(wrong(i + 1, reason));
            }
            place = Some(task.stretch.to.clone());
            tasks.push(task);
        }
        let end = scene.media().last().map(Medium::to);
        if place != end && stored.stop.is_none() {
            let reason = "the steps end before the ray does".into();
            return Err(wrong(stored.steps.len(), reason));
        }
        Ok(Plan {
            scene: scene.clone(),
            background: stored.stop.is_none(),
            stored,
            tasks,
            format,
        })
    }
}

/// What a stored step says, made sure of.
fn task(scene: &Scene, step: &Step) -> Result<Task, String> {
    let number = |text: &str| {
        let shown = text.escape_debug();
        parse_number(text).map_err(|_| format!("'{shown}' is no number"))
    };
    let (from, to) = (number(&step.from)?, number(&step.to)?);
    let index = step.medium.checked_sub(1);
    let medium = index.and_then(|index| Some((index, scene.media().get(index)?)));
    let Some((index, medium)) = medium else {
        return Err(format!("there is no medium {}", step.medium));
    };
    if from >= to || from < medium.from() || to > medium.to() {
        return Err(format!(
            "from {} to {} is no part of medium {}",
            step.from, step.to, medium.name
        ));
    }
    let first = medium.pieces.partition_point(|piece| piece.to <= from);
    let end = medium.pieces.partition_point(|piece| piece.from < to);
    let task = Task {
        stretch: Stretch {
            medium: index,
            pieces: first..end,
            from,
            to,
        },
        model: step.model,
    };
    let piece = task.stretch.only_piece(scene);
    let fits = match step.model {
        Model::Constant => piece.is_some_and(|p| matches!(p.form, Form::Constant(_))),
        Model::Linear => piece.is_some_and(|p| {
            matches!(p.form, Form::Linear { .. })
                && p.from == task.stretch.from
                && p.to == task.stretch.to
        }),
        model => model.points().is_none_or(|p| (1..=1000).contains(&p)),
    };
    if !fits {
        return Err(format!("{} does not fit the medium there", step.model));
    }
    Ok(task)
}
