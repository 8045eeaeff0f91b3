//! The memory that a file takes, before it is taken.

use super::{Trouble, refused};

/// How many bytes may be taken.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Memory {
    most: u64,
}

impl Memory {
    /// What is asked for, and no more than is free where the system tells.
    pub(crate) fn up_to(asked: Option<u64>) -> Memory {
        let free = free().unwrap_or(1 << 47);
        Memory {
            most: asked.map_or(free, |asked| asked.min(free)),
        }
    }

    /// The bytes that are left.
    pub(crate) fn most(self) -> u64 {
        self.most
    }

    /// Whether so many numbers of so many bytes fit.
    pub(crate) fn check(self, count: usize, bytes: usize) -> Result<(), Trouble> {
        let need = (count as u64).saturating_mul(bytes as u64);
        if need <= self.most {
            return Ok(());
        }
        Err(Trouble::Memory {
            need,
            most: self.most,
        })
    }

    /// An empty array with room for so many.
    pub(crate) fn array<T>(self, count: usize) -> Result<Vec<T>, Trouble> {
        self.check(count, size_of::<T>())?;
        let mut array = Vec::new();
        array
            .try_reserve_exact(count)
            .map_err(|_| Trouble::Memory {
                need: (count as u64).saturating_mul(size_of::<T>() as u64),
                most: self.most,
            })?;
        Ok(array)
    }
}

/// Bytes that can be had without swapping, where the system tells.
fn free() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = (text.lines()).find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kib: u64 = line.split_whitespace().next()?.parse().ok()?;
    kib.checked_mul(1024)
}

/// How many samples or values: at least one along every axis.
pub(crate) fn product(sizes: &[usize]) -> Result<usize, Trouble> {
    let all = (sizes.iter()).try_fold(1_usize, |all, &size| all.checked_mul(size));
    match all.filter(|all| all.checked_mul(8).is_some()) {
        Some(0) | None => Err(refused(
            format!("sizes {sizes:?}"),
            "1 or more along every axis, and no more in all than a machine can address",
        )),
        Some(all) => Ok(all),
    }
}
