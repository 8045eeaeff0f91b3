//! A scene from its file.

use super::file::{KindName, MediumFile, Number, Numbers, SamplesFile, Value};
use super::keys::{Keys, kind};
use super::medium::nearest;
use super::sampled::{self, OfField};
use super::top::{SCATTERING, channels, features, line};
use super::{Medium, Piece, Scene, SceneError, SceneFile, SceneProblem, Values};
use super::{expression, samples, table};
use crate::case::Transfer;
use crate::symbolic::{Expr, parse_number};
use rug::Rational;
use std::path::Path;
use toml::Spanned;

/// The largest file that is read, in bytes.
const MAX_FILE: usize = 1 << 20;

/// Reads the text of a `scene.toml`; files that it names are sought in `directory`.
///
/// # Errors
/// [`SceneError`] with the line, the problem and what is allowed.
pub fn read(text: &str, directory: &Path) -> Result<Scene, SceneError> {
    let at = |at: usize, problem| SceneError {
        line: line(text, at),
        problem,
    };
    if text.len() > MAX_FILE {
        let bytes = text.len();
        let allowed = MAX_FILE;
        return Err(at(0, SceneProblem::TooLong { bytes, allowed }));
    }
    if let Some(dot) = crate::case::file::deepest_dot(text) {
        let message = "too many parts of a key (allowed: keys without dots)".into();
        return Err(at(dot, SceneProblem::Content { message }));
    }
    let file: SceneFile = toml::from_str(text).map_err(|error| {
        let span = error.span().unwrap_or_default();
        let message = crate::case::file::said(
            error.message(),
            "TOML with the keys of 'volver schema scene'",
        );
        at(span.start, SceneProblem::Content { message })
    })?;
    let reader = Reader {
        text,
        directory,
        channels: channels(text, &file)?,
        has_emission: features(text, &file)?,
    };
    let background = match &file.background {
        None => vec![Rational::new(); reader.channels.len()],
        Some(value) => reader.background(value)?,
    };
    if file.media.is_empty() {
        return Err(at(0, SceneProblem::Empty));
    }
    let mut media: Vec<Medium> = Vec::with_capacity(file.media.len());
    for (i, of_one) in file.media.iter().enumerate() {
        let medium = reader.medium(i, of_one, media.last())?;
        media.push(medium);
    }
    let name = file.name.clone().unwrap_or_else(|| "scene".into());
    Ok(Scene::new(name, reader.channels, background, media))
}

/// What all media of a file have in common.
struct Reader<'f> {
    text: &'f str,
    directory: &'f Path,
    channels: Vec<String>,
    has_emission: bool,
}

/// A value at its place.
struct At<'f, T> {
    value: &'f T,
    start: usize,
}

impl<'f, T> At<'f, T> {
    fn new(spanned: &'f Spanned<T>) -> Self {
        At {
            value: spanned.get_ref(),
            start: spanned.span().start,
        }
    }
}

impl Reader<'_> {
    fn error(&self, at: usize, problem: SceneProblem) -> SceneError {
        SceneError {
            line: line(self.text, at),
            problem,
        }
    }

    fn number(&self, number: &Number, at: usize) -> Result<Rational, SceneError> {
        let text = written(number);
        parse_number(&text).map_err(|_| {
            let text = text.escape_debug().to_string();
            self.error(at, SceneProblem::Number { text })
        })
    }

    fn background(&self, value: &Spanned<Value>) -> Result<Vec<Rational>, SceneError> {
        let At { value, start } = At::new(value);
        let numbers = match value {
            Value::One(number) => Numbers::One(number.clone()),
            Value::Each(numbers) => Numbers::Each(numbers.clone()),
            Value::Ends { .. } => {
                let message =
                    "a background has no front and back (allowed: a number, or a list of them)"
                        .into();
                return Err(self.error(start, SceneProblem::Content { message }));
            }
        };
        self.numbers(&numbers, start, "background", f64::INFINITY)
    }

    /// Numbers that are not negative, by channel.
    fn numbers(
        &self,
        numbers: &Numbers,
        at: usize,
        what: &'static str,
        place: f64,
    ) -> Result<Vec<Rational>, SceneError> {
        let list = match numbers {
            Numbers::One(number) => vec![self.number(number, at)?; self.channels.len()],
            Numbers::Each(list) => {
                self.check_count(list.len(), at)?;
                let list = list.iter().map(|number| self.number(number, at));
                list.collect::<Result<_, _>>()?
            }
        };
        if let Some(negative) = list.iter().find(|value| **value < 0) {
            let problem = SceneProblem::Value {
                what,
                at: place,
                value: Some(nearest(negative)),
            };
            return Err(self.error(at, problem));
        }
        Ok(list)
    }

    fn check_count(&self, count: usize, at: usize) -> Result<(), SceneError> {
        let channels = self.channels.len();
        if count == channels {
            return Ok(());
        }
        Err(self.error(at, SceneProblem::Channels { count, channels }))
    }

    fn medium(
        &self,
        index: usize,
        file: &Spanned<MediumFile>,
        before: Option<&Medium>,
    ) -> Result<Medium, SceneError> {
        let start = file.span().start;
        let file = file.get_ref();
        self.refuse_scattering(file)?;
        let from = self.number(file.from.get_ref(), file.from.span().start)?;
        let to = self.number(file.to.get_ref(), file.to.span().start)?;
        self.check_ends(&from, &to, file, before)?;
        let keys = Keys::of(file.kind);
        keys.check(file)
            .map_err(|problem| self.error(start, problem))?;
        let at_start = |problem| self.error(start, problem);
        let cut = match file.kind {
            KindName::Vacuum => whole(&from, &to, super::Form::Vacuum),
            KindName::Constant | KindName::Linear => {
                let ends = |value: &Option<Spanned<Value>>, what| {
                    if let Some(value) = value {
                        return self.ends(value, what, file.kind, &from);
                    }
                    let none = vec![Rational::new(); self.channels.len()];
                    Ok((none.clone(), none))
                };
                let extinction = ends(&file.extinction, "extinction")?;
                let emission = ends(&file.emission, "emission")?;
                let front = values(emission.0, extinction.0);
                let back = values(emission.1, extinction.1);
                whole(&from, &to, sampled::between(front, back))
            }
            KindName::Expression => {
                let formulas = self.formulas(file)?;
                expression::cut(&formulas, &from, &to).map_err(at_start)?
            }
            KindName::Sampled => self.sampled(file, &from, &to, start)?,
        };
        let emits = |piece: &Piece| piece.form.emits();
        if !self.has_emission && cut.pieces.iter().any(emits) {
            return Err(at_start(SceneProblem::Undeclared));
        }
        Ok(Medium {
            name: file.name.clone().unwrap_or_else(|| (index + 1).to_string()),
            kind: kind(file.kind),
            pieces: cut.pieces,
            blur: cut.blur,
            unproved: cut.unproved,
        })
    }

    fn refuse_scattering(&self, file: &MediumFile) -> Result<(), SceneError> {
        let keys = [
            ("scattering", &file.scattering),
            ("albedo", &file.albedo),
            ("phase", &file.phase),
        ];
        for (key, value) in keys {
            if let Some(value) = value {
                let problem = SceneProblem::Feature {
                    feature: key.into(),
                    reason: SCATTERING,
                };
                return Err(self.error(value.span().start, problem));
            }
        }
        Ok(())
    }

    fn check_ends(
        &self,
        from: &Rational,
        to: &Rational,
        file: &MediumFile,
        before: Option<&Medium>,
    ) -> Result<(), SceneError> {
        if from >= to {
            let problem = SceneProblem::Order {
                from: nearest(from),
                to: nearest(to),
            };
            return Err(self.error(file.to.span().start, problem));
        }
        let Some(before) = before else {
            return Ok(());
        };
        let end = before.to();
        let places = |end: &Rational, from: &Rational| (nearest(end), nearest(from));
        let at = file.from.span().start;
        match from.cmp(&end) {
            std::cmp::Ordering::Equal => Ok(()),
            std::cmp::Ordering::Greater => {
                let (end, from) = places(&end, from);
                Err(self.error(at, SceneProblem::Gap { end, from }))
            }
            std::cmp::Ordering::Less => {
                let (end, from) = places(&end, from);
                Err(self.error(at, SceneProblem::Overlap { end, from }))
            }
        }
    }

    /// Values at the front and at the back.
    fn ends(
        &self,
        value: &Spanned<Value>,
        what: &'static str,
        kind: KindName,
        from: &Rational,
    ) -> Result<(Vec<Rational>, Vec<Rational>), SceneError> {
        let At { value, start } = At::new(value);
        let numbers = |numbers: &Numbers| self.numbers(numbers, start, what, nearest(from));
        let same = |of_one: Numbers| {
            let values = numbers(&of_one)?;
            Ok((values.clone(), values))
        };
        match value {
            Value::One(number) => same(Numbers::One(number.clone())),
            Value::Each(list) => same(Numbers::Each(list.clone())),
            Value::Ends { front, back } if kind == KindName::Linear => {
                Ok((numbers(front)?, numbers(back)?))
            }
            Value::Ends { .. } => {
                let message =
                    "front and back in a constant medium (allowed: kind = \"linear\", or one value)"
                        .into();
                Err(self.error(start, SceneProblem::Content { message }))
            }
        }
    }

    /// C and τ as expressions of lambda, by channel.
    fn formulas(&self, file: &MediumFile) -> Result<Vec<Transfer<Expr>>, SceneError> {
        let symbol = if file.field.is_some() { "s" } else { "lambda" };
        let formulas = self.transfer(file, symbol)?;
        let Some(field) = &file.field else {
            return Ok(formulas);
        };
        let At { value, start } = At::new(field);
        let field = self.expression(value, "lambda", start)?;
        let along = |expr: &Expr| expr.substitute("s", &field);
        Ok(formulas
            .iter()
            .map(|of_one| Transfer {
                emission: along(&of_one.emission),
                extinction: along(&of_one.extinction),
            })
            .collect())
    }

    fn transfer(&self, file: &MediumFile, symbol: &str) -> Result<Vec<Transfer<Expr>>, SceneError> {
        let all = |value: &Option<Spanned<Value>>| match value {
            Some(value) => self.expressions(value, symbol),
            None => Ok(vec![Expr::number(0); self.channels.len()]),
        };
        let (extinction, emission) = (all(&file.extinction)?, all(&file.emission)?);
        let both = emission.into_iter().zip(extinction);
        Ok(both
            .map(|(emission, extinction)| Transfer {
                emission,
                extinction,
            })
            .collect())
    }

    fn expressions(&self, value: &Spanned<Value>, symbol: &str) -> Result<Vec<Expr>, SceneError> {
        let At { value, start } = At::new(value);
        match value {
            Value::One(number) => {
                let expr = self.expression(&written(number), symbol, start)?;
                Ok(vec![expr; self.channels.len()])
            }
            Value::Each(list) => {
                self.check_count(list.len(), start)?;
                list.iter()
                    .map(|number| self.expression(&written(number), symbol, start))
                    .collect()
            }
            Value::Ends { .. } => {
                let message = "front and back beside expressions (allowed: kind = \"linear\", or an expression in quotes)".into();
                Err(self.error(start, SceneProblem::Content { message }))
            }
        }
    }

    fn expression(&self, text: &str, symbol: &str, at: usize) -> Result<Expr, SceneError> {
        let refused = |reason: String| {
            let text = text.escape_debug().to_string();
            self.error(at, SceneProblem::Expression { text, reason })
        };
        let expr: Expr = text.parse().map_err(|error: crate::symbolic::ParseError| {
            let said = error.to_string();
            refused(if said.contains("(allowed: ") {
                said
            } else {
                format!("{said} (allowed: an expression of {symbol})")
            })
        })?;
        match expr.symbols().iter().find(|name| ***name != *symbol) {
            Some(name) => Err(refused(format!(
                "'{name}' has no value (allowed: {symbol})"
            ))),
            None => Ok(expr),
        }
    }

    fn sampled(
        &self,
        file: &MediumFile,
        from: &Rational,
        to: &Rational,
        start: usize,
    ) -> Result<expression::Cut, SceneError> {
        let Some(given) = &file.samples else {
            // The keys of its kind are checked already.
            return Ok(whole(from, to, super::Form::Vacuum));
        };
        let At { value, start: at } = At::new(given);
        let field = match value {
            SamplesFile::Path(path) => {
                samples::read(&self.directory.join(path)).map_err(|p| self.error(at, p))?
            }
            SamplesFile::List(list) => {
                let list = list.iter().map(|number| self.number(number, at));
                list.collect::<Result<Vec<_>, _>>()?
            }
        };
        if field.len() < 2 {
            let count = field.len();
            return Err(self.error(at, SceneProblem::Samples { count }));
        }
        if let Some(spacing) = &file.spacing {
            let At { value, start } = At::new(spacing);
            let spacing = self.number(value, start)?;
            let spanned = Rational::from(&spacing * (field.len() as u64 - 1));
            let length = Rational::from(to - from);
            if spanned != length {
                let problem = SceneProblem::Spacing {
                    count: field.len(),
                    spacing: nearest(&spacing),
                    spanned: nearest(&spanned),
                    length: nearest(&length),
                };
                return Err(self.error(start, problem));
            }
        }
        let of_field = match &file.table {
            Some(path) => {
                let At { value, start } = At::new(path);
                let path = self.directory.join(value);
                let table = table::read(&path, &self.channels).map_err(|p| self.error(start, p))?;
                OfField::Table(table, file.table_interpolation.unwrap_or_default())
            }
            None => OfField::Formulas(self.transfer(file, "s")?),
        };
        let between = file.interpolation.unwrap_or_default();
        sampled::cut(&field, between, &of_field, from, to).map_err(|p| self.error(start, p))
    }
}

/// What was written, exactly: of a float its shortest decimal.
fn written(number: &Number) -> String {
    match number {
        Number::Integer(n) => n.to_string(),
        Number::Float(x) => x.to_string(),
        Number::Text(text) => text.clone(),
    }
}

fn values(emission: Vec<Rational>, extinction: Vec<Rational>) -> Vec<Values> {
    let both = emission.into_iter().zip(extinction);
    both.map(|(emission, extinction)| Transfer {
        emission,
        extinction,
    })
    .collect()
}

fn whole(from: &Rational, to: &Rational, form: super::Form) -> expression::Cut {
    expression::Cut {
        pieces: vec![Piece {
            from: from.clone(),
            to: to.clone(),
            form,
        }],
        blur: 0.0,
        unproved: Vec::new(),
    }
}
