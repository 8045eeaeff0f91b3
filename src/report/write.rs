//! Reports as files: each is complete or not there at all.

use super::html::{About, place};
use super::{ReportError, groups, json, markdown, page, svg};
use crate::study::reproduce::{Entry, Settings};
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Writes `report.md`, `report.json`, one plot a table (`table-1-exact.svg` …) and a page, `index.html`, into `dir`,
/// which is made where it does not exist. Returns the paths written.
///
/// Each file appears whole (see [`write_file`]), the report behind its plots, so that it never links to a plot that
/// is missing, and the page last. Other files in `dir` stay; [`place`] says what the page is called beside other pages.
///
/// # Errors
///
/// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
pub fn write_directory(
    dir: &Path,
    settings: &Settings,
    entries: &[Entry],
    about: &About,
) -> Result<Vec<PathBuf>, ReportError> {
    let mut files = Vec::new();
    for group in groups(entries) {
        let name = format!("{}.svg", group.file_stem());
        files.push((dir.join(name), svg::table_plot(&group)?));
    }
    files.push((
        dir.join("report.json"),
        json::reproduction(settings, entries)?,
    ));
    files.push((
        dir.join("report.md"),
        markdown::reproduction(settings, entries),
    ));
    let mut paths = write_files(dir, files)?;
    paths.push(place(dir, &page::reproduction(settings, entries, about))?);
    Ok(paths)
}

/// Writes contents, made before, into `dir` in their order; `dir` is made where it does not exist. Returns the
/// paths written.
pub(super) fn write_files(
    dir: &Path,
    files: impl IntoIterator<Item = (PathBuf, String)>,
) -> Result<Vec<PathBuf>, ReportError> {
    fs::create_dir_all(dir).map_err(|reason| ReportError::Directory {
        path: dir.into(),
        reason,
    })?;
    let written = files.into_iter().map(|(path, contents)| {
        write_file(&path, &contents)?;
        Ok(path)
    });
    written.collect()
}

/// Writes a file whole: into a temporary file beside it, which then takes its name.
///
/// A reader sees the old contents or the new ones; after a failure the old ones stay and nothing
/// else is left behind. A new file is readable by everybody that the directory lets in, an old one
/// keeps its permissions. Special files (`/dev/stdout`, a pipe) cannot be replaced: they are
/// written to directly.
///
/// # Errors
///
/// [`ReportError::File`] with the path and the system's reason.
pub fn write_file(path: &Path, contents: &str) -> Result<(), ReportError> {
    replace(path, contents).map_err(|reason| ReportError::File {
        path: path.into(),
        reason,
    })
}

fn replace(path: &Path, contents: &str) -> io::Result<()> {
    // A link stays a link: what it leads to is replaced.
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let old = fs::metadata(&target).ok();
    if old.as_ref().is_some_and(|m| !m.is_file() && !m.is_dir()) {
        return fs::write(&target, contents);
    }
    let parent = match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".volver-");
    // Temporary files are private otherwise; the process's mask still applies.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(parent)?;
    file.write_all(contents.as_bytes())?;
    if let Some(old) = old {
        file.as_file().set_permissions(old.permissions())?;
    }
    file.as_file().sync_all()?;
    file.persist(&target)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{entry, replicated};
    use super::*;

    fn names(dir: &Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(dir)
            .unwrap()
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_directory_gets_report_json_and_plots() {
        let parent = tempfile::tempdir().unwrap();
        let dir = parent.path().join("a/b");
        let about = About::new(["volver"]);
        let entries = [
            entry("simpson", "boole"),
            replicated("monte-carlo", "boole"),
        ];
        let paths = write_directory(&dir, &Settings::default(), &entries, &about).unwrap();
        assert_eq!(
            names(&dir),
            [
                "index.html",
                "report.json",
                "report.md",
                "table-1-exact.svg"
            ]
        );
        assert_eq!(paths.len(), 4);
        let before: Vec<String> = paths
            .iter()
            .map(|p| fs::read_to_string(p).unwrap())
            .collect();
        write_directory(&dir, &Settings::default(), &entries, &about).unwrap();
        let after: Vec<String> = paths
            .iter()
            .map(|p| fs::read_to_string(p).unwrap())
            .collect();
        assert_eq!(before, after);
        assert_eq!(names(&dir).len(), 4);
    }

    #[test]
    fn a_file_in_the_way_is_named_and_nothing_is_left() {
        let parent = tempfile::tempdir().unwrap();
        let file = parent.path().join("file");
        fs::write(&file, "mine").unwrap();
        let dir = file.join("report");
        let about = About::new(["volver"]);
        let error = write_directory(&dir, &Settings::default(), &[], &about).unwrap_err();
        assert!(matches!(&error, ReportError::Directory { path, .. } if *path == dir));
        assert!(error.to_string().contains(&dir.display().to_string()));
        let error = write_file(&dir, "x").unwrap_err();
        assert!(matches!(&error, ReportError::File { path, .. } if *path == dir));
        assert_eq!(names(parent.path()), ["file"]);
        assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
    }

    #[test]
    fn a_target_that_cannot_be_replaced_leaves_no_temporary_file() {
        let parent = tempfile::tempdir().unwrap();
        let target = parent.path().join("taken");
        fs::create_dir(&target).unwrap();
        write_file(&target, "x").unwrap_err();
        assert_eq!(names(parent.path()), ["taken"]);
    }

    #[cfg(unix)]
    #[test]
    fn permissions_and_links_survive() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let parent = tempfile::tempdir().unwrap();
        let file = parent.path().join("file");
        fs::write(&file, "old").unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
        let link = parent.path().join("link");
        symlink(&file, &link).unwrap();
        write_file(&link, "new").unwrap();
        assert_eq!(fs::read_to_string(&file).unwrap(), "new");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        let mode = fs::metadata(&file).unwrap().permissions().mode();
        assert_eq!(mode & 0o777, 0o640);
    }

    #[test]
    fn special_files_are_written_to() {
        write_file(Path::new("/dev/null"), "x").unwrap();
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
    }
}
