//! What a kernel needs of JSON. Lines come from volver and are taken to be well formed.

/// A value.
pub enum Json {
    Number(f64),
    Text(String),
    Array(Vec<Json>),
    Object(Vec<(String, Json)>),
    /// true, false, null.
    Word,
}

impl Json {
    /// The value on a line.
    pub fn read(line: &str) -> Option<Json> {
        Reader { rest: line }.value()
    }

    /// The value of a member of an object.
    pub fn get(&self, key: &str) -> Option<&Json> {
        match self {
            Json::Object(members) => {
                let member = members.iter().find(|(own, _)| own == key);
                member.map(|(_, value)| value)
            }
            _ => None,
        }
    }

    pub fn items(&self) -> Option<&[Json]> {
        match self {
            Json::Array(items) => Some(items),
            _ => None,
        }
    }

    /// A number; infinities and NaN are texts.
    pub fn number(&self) -> Option<f64> {
        match self {
            Json::Number(number) => Some(*number),
            Json::Text(text) => text.parse().ok(),
            _ => None,
        }
    }

    /// An array of numbers.
    pub fn numbers(&self) -> Option<Vec<f64>> {
        self.items()?.iter().map(Json::number).collect()
    }
}

/// A number as JSON.
pub fn written(number: f64) -> String {
    if number.is_finite() {
        format!("{number:?}")
    } else {
        format!("\"{number}\"")
    }
}

struct Reader<'l> {
    rest: &'l str,
}

impl Reader<'_> {
    fn take(&mut self, token: char) -> bool {
        let rest = self.rest.trim_start();
        self.rest = rest.strip_prefix(token).unwrap_or(rest);
        self.rest.len() < rest.len()
    }

    fn value(&mut self) -> Option<Json> {
        if self.take('{') {
            let mut members = Vec::new();
            while !self.take('}') {
                self.take(',');
                let key = self.string()?;
                self.take(':');
                members.push((key, self.value()?));
            }
            return Some(Json::Object(members));
        }
        if self.take('[') {
            let mut items = Vec::new();
            while !self.take(']') {
                self.take(',');
                items.push(self.value()?);
            }
            return Some(Json::Array(items));
        }
        if self.rest.starts_with('"') {
            return self.string().map(Json::Text);
        }
        let is_behind = |c: char| matches!(c, ',' | ']' | '}') || c.is_whitespace();
        let end = self.rest.find(is_behind).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        match word {
            "true" | "false" | "null" => Some(Json::Word),
            number => number.parse().ok().map(Json::Number),
        }
    }

    /// No key that matters has escapes: they stay as they are.
    fn string(&mut self) -> Option<String> {
        if !self.take('"') {
            return None;
        }
        let mut escaped = false;
        let end = self.rest.find(|c| {
            let is_end = c == '"' && !escaped;
            escaped = c == '\\' && !escaped;
            is_end
        })?;
        let text = self.rest[..end].to_string();
        self.rest = &self.rest[end + 1..];
        Some(text)
    }
}
