//! What a handler of Ctrl-C calls.

use super::fixture::{Fixture, patient, segments, subject, task};
use std::process::Command;
use volver::kernel::process::stop_all;
use volver::kernel::{Kernel, KernelError};

/// Says to a process that it is the one in which all is stopped.
const INNER: &str = "VOLVER_TEST_STOP";

#[test]
fn stopping_all_leaves_none_and_lets_none_start() {
    // All is all: in this process the other tests' kernels as well.
    if std::env::var_os(INNER).is_none() {
        let test = std::env::current_exe().unwrap();
        let name = "kernel_process::stop::stopping_all_leaves_none_and_lets_none_start";
        let mut inner = Command::new(test);
        let inner = inner
            .args(["--exact", name])
            .env(INNER, "1")
            .output()
            .unwrap();
        let output = String::from_utf8_lossy(&inner.stdout);
        assert!(inner.status.success(), "{output}");
        assert!(output.contains("1 passed"), "{output}");
        return;
    }
    let fixture = Fixture::new();
    let mut kernels = ["leaves-descendant", "npy"].map(|mode| {
        let kernel = fixture.start(mode, patient());
        kernel.unwrap()
    });
    let subject = subject("homogeneous");
    let cut = segments(&subject, 8);
    kernels[1].render(&task(&subject, &cut)).unwrap();
    let told = fixture.start("told", patient()).unwrap();
    let mut printed = String::new();
    super::fixture::eventually(|| {
        printed = kernels[1].output();
        printed.ends_with('\n')
    });
    assert!(std::path::Path::new(printed.trim()).exists());
    stop_all();
    assert_eq!(fixture.told(), "terminated\n");
    drop(told);
    fixture.assert_gone();
    assert!(!std::path::Path::new(printed.trim()).exists());
    let results = kernels[0].render(&task(&subject, &cut));
    assert!(
        matches!(results, Err(KernelError::Exited { .. })),
        "{results:?}"
    );
    let results = kernels[0].render(&task(&subject, &cut));
    assert!(
        matches!(&results, Err(KernelError::Start { reason, .. }) if reason == "all kernels are being stopped"),
        "{results:?}"
    );
}
