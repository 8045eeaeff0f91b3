//! Base64 as VTK writes it: a header and its data may be two texts, each with its own padding, one right after the other.

use std::io::{self, Read};

/// The bytes that a text in base64 stands for. Padding ends a group of four characters and not the text; white space is
/// nothing; the text ends where its source does, or at the first `<`.
pub(crate) struct Base64<S> {
    text: S,
    ready: [u8; 3],
    left: usize,
}

impl<S: Read> Base64<S> {
    pub(crate) fn new(text: S) -> Base64<S> {
        Base64 {
            text,
            ready: [0; 3],
            left: 0,
        }
    }

    /// The bytes of the next group are `ready[3 - left..]`.
    fn group(&mut self) -> io::Result<()> {
        let mut bits = 0_u32;
        let mut padding = 0;
        let mut have = 0;
        let mut byte = [0];
        while have < 4 {
            if self.text.read(&mut byte)? == 0 || byte[0] == b'<' {
                if have == 0 {
                    return Ok(());
                }
                return Err(invalid(
                    "base64 that ends within a group of four characters",
                ));
            }
            let digit = match byte[0] {
                letter @ b'A'..=b'Z' => letter - b'A',
                letter @ b'a'..=b'z' => letter - b'a' + 26,
                digit @ b'0'..=b'9' => digit - b'0' + 52,
                b'+' => 62,
                b'/' => 63,
                b'=' if have >= 2 => {
                    padding += 1;
                    0
                }
                space if space.is_ascii_whitespace() => continue,
                _ => return Err(invalid("a character that base64 has not")),
            };
            if padding > 0 && byte[0] != b'=' {
                return Err(invalid("a character behind the padding of base64"));
            }
            bits = bits << 6 | u32::from(digit);
            have += 1;
        }
        let [_, a, b, c] = bits.to_be_bytes();
        self.left = 3 - padding;
        self.ready = match padding {
            0 => [a, b, c],
            1 => [0, a, b],
            _ => [0, 0, a],
        };
        Ok(())
    }
}

impl<S: Read> Read for Base64<S> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let mut read = 0;
        while read < buffer.len() {
            if self.left == 0 {
                self.group()?;
                if self.left == 0 {
                    break;
                }
            }
            buffer[read] = self.ready[3 - self.left];
            self.left -= 1;
            read += 1;
        }
        Ok(read)
    }
}

fn invalid(what: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, what)
}
