//! Whether a report will find its place, asked before the work is done and not after.

use super::ReportError;
use std::fs;
use std::io;
use std::path::Path;

/// Makes `dir` where it does not exist and sees whether files can be made in it; leaves none.
///
/// # Errors
/// [`ReportError::Directory`] with the path and the system's reason.
pub fn prepare_directory(dir: &Path) -> Result<(), ReportError> {
    let probe = || -> io::Result<()> {
        fs::create_dir_all(dir)?;
        tempfile::tempfile_in(dir)?;
        Ok(())
    };
    probe().map_err(|reason| ReportError::Directory {
        path: dir.into(),
        reason,
    })
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_directory_is_made_and_left_empty() {
        let parent = tempfile::tempdir().unwrap();
        let dir = parent.path().join("a/b");
        prepare_directory(&dir).unwrap();
        assert_eq!(fs::read_dir(&dir).unwrap().count(), 0);
    }

    #[test]
    fn a_file_where_a_directory_should_be_is_named() {
        let parent = tempfile::tempdir().unwrap();
        let file = parent.path().join("file");
        fs::write(&file, "mine").unwrap();
        for path in [file.clone(), file.join("below")] {
            let error = prepare_directory(&path).unwrap_err();
            assert!(error.to_string().contains(&path.display().to_string()));
        }
        let below = file.join("report.json");
        let error = check_file(&below).unwrap_err();
        assert!(error.to_string().contains(&below.display().to_string()));
    }

    #[test]
    fn checking_a_file_neither_makes_nor_changes_it() {
        let parent = tempfile::tempdir().unwrap();
        let path = parent.path().join("x.json");
        check_file(&path).unwrap();
        assert!(!path.exists());
        fs::write(&path, "old").unwrap();
        check_file(&path).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        check_file(parent.path()).unwrap_err();
    }
}
