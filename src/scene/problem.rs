//! What can be wrong with a scene.

/// What is wrong with a scene's file, and where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {line}: {problem}")]
pub struct SceneError {
    /// The line, counted from 1.
    pub line: usize,
    /// What is wrong.
    pub problem: SceneProblem,
}

/// What can be wrong with a scene's file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SceneProblem {
    /// No TOML, a key that means nothing, or a value of another type.
    #[error("{message}")]
    Content {
        /// What the reader said, and what is allowed.
        message: String,
    },
    /// No number, or one that is not finite.
    #[error("'{text}' is no finite number (allowed: integers, decimals, quotients in quotes)")]
    Number {
        /// As it stands there.
        text: String,
    },
    /// No expression.
    #[error("'{text}': {reason}")]
    Expression {
        /// As it stands there.
        text: String,
        /// What is wrong, and what is allowed.
        reason: String,
    },
    /// A key is missing.
    #[error("a medium of kind '{kind}' without '{key}' (allowed: {kind} media have {keys})")]
    Missing {
        /// The key.
        key: &'static str,
        /// The kind of medium.
        kind: &'static str,
        /// The keys that belong to it.
        keys: &'static str,
    },
    /// A key that belongs to another kind of medium.
    #[error("'{key}' in a medium of kind '{kind}' (allowed: {kind} media have {keys})")]
    Superfluous {
        /// The key.
        key: &'static str,
        /// The kind of medium.
        kind: &'static str,
        /// The keys that belong to it.
        keys: &'static str,
    },
    /// A medium of no length.
    #[error("a medium from {from} to {to} (allowed: ends that lie behind the beginning)")]
    Order {
        /// Where it begins.
        from: f64,
        /// Where it ends.
        to: f64,
    },
    /// Nothing is said of a part of the ray.
    #[error(
        "a gap from {end} to {from} (allowed: media that begin where the one before ends; an empty stretch has kind = \"vacuum\")"
    )]
    Gap {
        /// Where the medium before ends.
        end: f64,
        /// Where this one begins.
        from: f64,
    },
    /// Two media at one place.
    #[error(
        "it begins at {from}, before the medium in front of it ends at {end} (allowed: media that begin where the one before ends)"
    )]
    Overlap {
        /// Where the medium before ends.
        end: f64,
        /// Where this one begins.
        from: f64,
    },
    /// Something that the integral has not.
    #[error("'{feature}' is not in the model: {reason} (allowed: emission, absorption)")]
    Feature {
        /// What is declared.
        feature: String,
        /// Why it cannot be had.
        reason: &'static str,
    },
    /// A feature that is not declared, used.
    #[error(
        "emission where features has absorption alone (allowed: \"emission\" in features, or media without emission)"
    )]
    Undeclared,
    /// Another number of values than channels.
    #[error("{count} values for {channels} channels (allowed: one for all, or one each)")]
    Channels {
        /// How many values.
        count: usize,
        /// How many channels.
        channels: usize,
    },
    /// Names of channels that cannot be told apart, none, or too many.
    #[error("channels: {reason} (allowed: 1 to 8 different names of letters, digits and -)")]
    ChannelNames {
        /// What is wrong.
        reason: String,
    },
    /// C or τ is negative or has no value.
    #[error("{what} is {} near lambda = {at} (allowed: finite, 0 or more)", value.map_or("not defined".to_string(), |v| v.to_string()))]
    Value {
        /// extinction, emission or background.
        what: &'static str,
        /// Where.
        at: f64,
        /// What it is there; nothing where it has no value.
        value: Option<f64>,
    },
    /// The places where an expression is not analytic cannot be told.
    #[error("{reason} (allowed: expressions whose branches meet at places that can be told)")]
    Breaks {
        /// What is open.
        reason: String,
    },
    /// A file of samples or of a table.
    #[error("{path}: {problem}")]
    File {
        /// The file.
        path: String,
        /// What is wrong, where, and what is allowed.
        problem: String,
    },
    /// Samples that do not fill their medium.
    #[error(
        "{count} samples at a spacing of {spacing} are {spanned} long, in a medium of length {length} (allowed: length / (samples - 1), or no spacing)"
    )]
    Spacing {
        /// How many samples.
        count: usize,
        /// The spacing.
        spacing: f64,
        /// From the first to the last.
        spanned: f64,
        /// The medium's length.
        length: f64,
    },
    /// Single samples.
    #[error("{count} samples (allowed: 2 or more)")]
    Samples {
        /// How many.
        count: usize,
    },
    /// Data of too many kinks.
    #[error("more than {limit} pieces (allowed: fewer samples, or a table of fewer entries)")]
    TooManyPieces {
        /// The limit.
        limit: usize,
    },
    /// No media.
    #[error("no media (allowed: one [[media]] or more)")]
    Empty,
    /// A text that is too long.
    #[error("{bytes} bytes are too long a file (allowed: up to {allowed})")]
    TooLong {
        /// How many.
        bytes: usize,
        /// How many may be.
        allowed: usize,
    },
}
