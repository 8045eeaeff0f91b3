//! Reports as files: whole or not there, and asked for before the work is done.

use super::about;
use super::entries::{entry, replicated};
use std::fs;
use std::path::Path;
use volver::document::{Block, Cell, Column, Medium, Table};
use volver::render::{
    ReportError, check_directory, check_file, make_directory, svg, write_document, write_file,
};
use volver::report::reproduce::{document, write};
use volver::study::reproduce::Settings;

fn names(dir: &Path) -> Vec<String> {
    let entries = fs::read_dir(dir).unwrap();
    let mut names: Vec<String> = entries
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_directory_gets_report_json_and_page_and_the_same_once_more() {
    let parent = tempfile::tempdir().unwrap();
    let dir = parent.path().join("a/b");
    let entries = [
        entry("simpson", "boole"),
        replicated("monte-carlo", "boole"),
    ];
    let write = || write(&dir, &Settings::default(), &entries, &about()).unwrap();
    let contents = || {
        let read = |path| fs::read_to_string(path).unwrap();
        write().iter().map(read).collect::<Vec<String>>()
    };
    let paths = write();
    let figures = svg::files(&document(&Settings::default(), &entries, &about()));
    let mut expected = ["index.html", "report.json", "report.md"]
        .map(String::from)
        .to_vec();
    expected.extend(figures.into_iter().map(|(name, _)| name));
    expected.sort();
    assert_eq!(names(&dir), expected);
    assert_eq!(contents(), contents());
    assert_eq!(names(&dir), expected);
    assert_eq!(paths.last().unwrap().file_name().unwrap(), "index.html");
}

#[test]
fn tables_for_programs_and_papers_are_files_where_there_are_such() {
    let table = |caption: &str| {
        let table = Table::new(caption, [Column::text("a")]);
        Block::Table(table.with([vec![Cell::text(caption)]]).named(caption))
    };
    let written = |blocks: Vec<Block>| {
        let dir = tempfile::tempdir().unwrap();
        let data = [("x.json".to_string(), "{}".to_string())];
        write_document(dir.path(), &super::document(blocks), "trial", data).unwrap();
        names(dir.path())
    };
    let plain = ["index.html", "trial.md", "x.json"];
    assert_eq!(written(vec![table("all")]), plain);
    assert_eq!(
        written(vec![
            table("all"),
            table("runs").only(Medium::Csv),
            table("paper").only(Medium::Latex)
        ]),
        ["index.html", "runs.csv", "trial.md", "trial.tex", "x.json"]
    );
}

#[test]
fn a_file_in_the_way_is_named_and_nothing_is_left() {
    let parent = tempfile::tempdir().unwrap();
    let file = parent.path().join("file");
    fs::write(&file, "mine").unwrap();
    let dir = file.join("report");
    let error = write(&dir, &Settings::default(), &[], &about()).unwrap_err();
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

#[test]
fn checking_a_directory_leaves_all_as_it_is() {
    let parent = tempfile::tempdir().unwrap();
    let dir = parent.path().join("a/b");
    check_directory(&dir).unwrap();
    assert_eq!(fs::read_dir(parent.path()).unwrap().count(), 0);
    make_directory(&dir).unwrap();
    check_directory(&dir).unwrap();
    assert_eq!(fs::read_dir(&dir).unwrap().count(), 0);
}

#[test]
fn a_file_where_a_directory_should_be_is_named() {
    let parent = tempfile::tempdir().unwrap();
    let file = parent.path().join("file");
    fs::write(&file, "mine").unwrap();
    for path in [file.clone(), file.join("below")] {
        let error = check_directory(&path).unwrap_err();
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
