//! Whether a report will find its place, asked before the work is done and not after.

use super::ReportError;
use std::fs;
use std::io;
use std::path::Path;

/// Makes `dir` where it does not exist.
///
/// # Errors
/// [`ReportError::Directory`] with the path and the system's reason.
pub fn make_directory(dir: &Path) -> Result<(), ReportError> {
    fs::create_dir_all(dir).map_err(|reason| ReportError::Directory {
        path: dir.into(),
        reason,
    })
}

/// Sees whether `dir` can be made where it does not exist, and files in it; leaves all as it is.
///
/// # Errors
/// [`ReportError::Directory`] with the path and the system's reason.
pub fn check_directory(dir: &Path) -> Result<(), ReportError> {
    let missing = dir.ancestors().take_while(|dir| !dir.exists());
    let missing: Vec<&Path> = missing.filter(|dir| !dir.as_os_str().is_empty()).collect();
    make_directory(dir)?;
    let probe = tempfile::tempfile_in(dir);
    for made in missing {
        // What somebody else has put there meanwhile stays.
        let _ = fs::remove_dir(made);
    }
    match probe {
        Ok(_) => Ok(()),
        Err(reason) => Err(ReportError::Directory {
            path: dir.into(),
            reason,
        }),
    }
}

/// Sees whether `path` can be written; leaves it as it is.
///
/// # Errors
/// [`ReportError::File`] with the path and the system's reason.
pub fn check_file(path: &Path) -> Result<(), ReportError> {
    let probe = || -> io::Result<()> {
        match fs::metadata(path) {
            // Opening a pipe would wait for its reader.
            Ok(special) if !special.is_file() && !special.is_dir() => return Ok(()),
            Ok(_) => {
                fs::OpenOptions::new().append(true).open(path)?;
                return Ok(());
            }
            Err(_) => {}
        }
        match path.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => tempfile::tempfile_in(parent)?,
            _ => tempfile::tempfile_in(".")?,
        };
        Ok(())
    };
    probe().map_err(|reason| ReportError::File {
        path: path.into(),
        reason,
    })
}
