//! A case file is read, or refused in one line with a place in the file.

#![no_main]

use libfuzzer_sys::fuzz_target;
use volver::case::Description;

fuzz_target!(|text: &str| {
    match Description::read(text) {
        Ok(case) => {
            assert!(case.length > 0);
            assert!((1..=8).contains(&case.channels.len()));
        }
        Err(error) => {
            let message = error.to_string();
            assert!(!message.contains(char::is_control), "{message}");
            let line = text.split('\n').nth(error.line - 1);
            let width = line.map(|line| line.chars().count());
            assert!(
                width.is_some_and(|width| error.column <= width + 1),
                "{message}"
            );
            if let Some(caret) = error.caret() {
                assert_eq!(caret.lines().count(), 2, "{caret}");
            }
        }
    }
});
