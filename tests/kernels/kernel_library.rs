//! Kernels in shared libraries: small C files, compiled here, that keep to `include/volver.h` or do not.

use rug::Float;
use std::fs;
use std::num::{NonZeroU64, NonZeroUsize};
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;
use volver::case::{catalogue, manufacture::manufacture};
use volver::kernel::library::LibraryKernel;
use volver::kernel::{
    BuiltIn, Cut, Data, Declaration, DepthWeights, FormKind, Kernel, KernelError, Quantity,
    Quantum, Rendering, Sampling, Segments, Source, Subject, Task, UlpBound,
};
use volver::method::Method;
use volver::real::FormatName;
use volver::symbolic::code::Language;

/// What most of the files begin with.
const HEAD: &str = "#include <math.h>\n#include <string.h>\n#include \"volver.h\"\n\
    uint32_t volver_abi_version(void) { return VOLVER_ABI; }\n";
const DECLARES_NOTHING: &str = "void volver_declare(volver_declaration *d) { (void)d; }\n";
const ANSWERS_NOTHING: &str =
    "int volver_render(const volver_task *t, volver_result *r) { (void)t; (void)r; return 0; }\n";
const WARNINGS: [&str; 5] = ["-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O1"];

/// A compiler of that name, or `None`, said aloud: no other test says that C works.
fn compiler(name: &str) -> Option<Command> {
    let works = Command::new(name).arg("--version").output().is_ok();
    if !works {
        eprintln!("skipped: there is no compiler {name} on the PATH");
    }
    works.then(|| {
        let mut compiler = Command::new(name);
        compiler.args(WARNINGS).arg("-I").arg(root("include"));
        compiler
    })
}

fn root(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// The library made of `code`, in a folder that goes with it; `None` where nothing can be compiled.
fn library(code: &str) -> Option<(TempDir, PathBuf)> {
    let folder = tempfile::tempdir().unwrap();
    let source = folder.path().join("kernel.c");
    fs::write(&source, code).unwrap();
    let path = compiled(&source, &[], folder.path())?;
    Some((folder, path))
}

/// The library made of `source` with those options, in `folder`.
fn compiled(source: &Path, options: &[&str], folder: &Path) -> Option<PathBuf> {
    let path = folder.join("kernel.so");
    let mut compiler = compiler("cc")?;
    compiler
        .args(["-std=c99", "-shared", "-fPIC"])
        .args(options);
    compiler.arg("-o").arg(&path).arg(source).arg("-lm");
    run(compiler);
    Some(path)
}

fn run(mut command: Command) {
    let output = command.output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {said}");
}

/// What comes of opening the library made of [`HEAD`] and `code`.
fn open(code: &str) -> Option<Result<LibraryKernel, KernelError>> {
    let (_folder, path) = library(&format!("{HEAD}{code}"))?;
    Some(LibraryKernel::open(&path))
}

fn subject(name: &str) -> Subject {
    let description = catalogue::find(name).unwrap().unwrap();
    let channels = manufacture(&description).unwrap();
    let channels = channels.into_iter().map(|c| (c.channel, c.case)).collect();
    Subject::new(name, channels).unwrap()
}

fn task<'a>(subject: &'a Subject, segments: &'a Segments) -> Task<'a> {
    let n = segments.count() as u64;
    Task {
        subject,
        step: subject.length().to_f64() / n as f64,
        segments: n,
        seed: 7,
        data: Data::Segments(segments),
    }
}

/// What a kernel answers to a case on 8 segments, as segments or as a function as it declares.
fn answer(kernel: &mut LibraryKernel, case: &str) -> Result<Rendering, KernelError> {
    let subject = subject(case);
    let segments = subject.segments(Cut::Segments(8)).unwrap();
    let mut task = task(&subject, &segments);
    if kernel.declaration().form == FormKind::Function {
        task.data = Data::Function;
    }
    kernel.render(&task)
}

fn numbers(rendering: &Rendering) -> Vec<f64> {
    rendering.radiance.iter().map(Float::to_f64).collect()
}

/// The example in the header, which must be what it says.
#[test]
fn the_example_in_the_header_is_a_kernel() {
    let header = fs::read_to_string(root("include/volver.h")).unwrap();
    let inside = header.lines().skip_while(|l| !l.contains("#include <math"));
    let lines = inside.take_while(|line| !line.starts_with(" * The library"));
    let code: Vec<&str> = lines.map(|line| line.trim_start_matches(" *")).collect();
    let Some((_folder, path)) = library(&code.join("\n")) else {
        return;
    };
    let mut kernel = LibraryKernel::open(&path).unwrap();
    let expected = Declaration {
        order: Some(1.0),
        ..Declaration::new("kernel")
    };
    assert_eq!(*kernel.declaration(), expected);
    let method: Method = "front-to-back/front/subtraction".parse().unwrap();
    let mut same = BuiltIn::new(method, FormatName::F64);
    let subject = subject("sine-squared");
    let segments = subject.segments(Cut::Segments(64)).unwrap();
    let task = task(&subject, &segments);
    let (got, wanted) = (kernel.render(&task).unwrap(), same.render(&task).unwrap());
    let error = Float::with_val(53, &got.radiance[0] - &wanted.radiance[0]).to_f64();
    assert!(error.abs() < 1e-15, "{got:?} {wanted:?}");
}

/// `examples/kernels/front_to_back.c` in both formats, on steps that divide the ray and on one that does not.
#[test]
fn front_to_back_is_the_method_that_it_declares() {
    let source = root("examples/kernels/front_to_back.c");
    for (options, format, tolerance) in [
        (&[][..], FormatName::F64, 1e-14),
        (&["-DREAL=float"][..], FormatName::F32, 1e-5),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let Some(path) = compiled(&source, options, folder.path()) else {
            return;
        };
        let mut kernel = LibraryKernel::open(&path).unwrap();
        let declaration = kernel.declaration().clone();
        assert_eq!(declaration.format, format);
        let mut same = BuiltIn::new(declaration.method.unwrap(), format);
        for case in ["sine-squared", "rgb-transfer", "homogeneous"] {
            let subject = subject(case);
            let segments = subject.segments(Cut::Segments(48)).unwrap();
            let task = task(&subject, &segments);
            let got = numbers(&kernel.render(&task).unwrap());
            let wanted = numbers(&same.render(&task).unwrap());
            assert_eq!(got.len(), wanted.len());
            for (got, wanted) in got.iter().zip(&wanted) {
                assert!((got - wanted).abs() < tolerance, "{case}: {got} {wanted}");
            }
        }
        // A homogeneous slab is exact on any segments, the short last one included.
        let subject = subject("homogeneous");
        let segments = subject.segments(Cut::Step(0.3)).unwrap();
        let mut task = task(&subject, &segments);
        task.step = 0.3;
        let (got, whole) = (kernel.render(&task).unwrap(), same.render(&task).unwrap());
        let (got, whole) = (numbers(&got)[0], numbers(&whole)[0]);
        assert!((got - whole).abs() < tolerance, "{got} {whole}");
    }
}

#[test]
fn everything_declared_arrives() {
    let code = "void volver_declare(volver_declaration *d) {\n\
        if (d->size != sizeof *d || d->name || !isnan(d->order)) return;\n\
        d->name = \"mine \\xc2\\xb5\"; d->form = \"function\";\n\
        d->method = \"front-to-back/back/expm1\"; d->format = \"f32\"; d->sampling = \"jittered\";\n\
        if (VOLVER_HAS(d, volver_declaration, far_wall)) d->far_wall = 1;\n\
        if (VOLVER_HAS(d, volver_declaration, multiple_of)) d->multiple_of = 2, d->step_divides = 1;\n\
        d->output = \"f16\"; d->quantum_is_relative = 1; d->exp_ulp[0] = 4; d->exp_ulp[1] = 1; d->pow_ulp[1] = 2;\n\
        d->subnormals_lost = 1; d->channels = 3; d->positive_emission = d->source_per_length = 1;\n\
        d->order = 1.5; d->quantum = 1 / 256.0; d->stochastic = 1; }\n";
    let Some(kernel) = open(&format!("{code}{ANSWERS_NOTHING}")) else {
        return;
    };
    let expected = Declaration {
        name: "mine µ".into(),
        form: FormKind::Function,
        method: Some("front-to-back/back/expm1".parse().unwrap()),
        order: Some(1.5),
        format: FormatName::F32,
        output: Some(FormatName::F16),
        quantum: Some(Quantum::Relative(1.0 / 256.0)),
        exp_ulp: Some(UlpBound::new(4.0, 1.0).unwrap()),
        pow_ulp: Some(UlpBound::new(0.0, 2.0).unwrap()),
        subnormals_lost: true,
        channels: NonZeroUsize::new(3),
        positive_emission: true,
        source: Source::Length,
        stochastic: true,
        sampling: Some(Sampling::Jittered),
        far_wall: true,
        step_divides: true,
        multiple_of: NonZeroU64::new(2).unwrap(),
        ..Declaration::new("mine µ")
    };
    assert_eq!(*kernel.unwrap().declaration(), expected);
}

/// What version 2 of the protocol has, by members at the end of the structs.
#[test]
fn a_library_answers_what_it_declares() {
    let declares = "void volver_declare(volver_declaration *d) {\n\
        d->answers = VOLVER_OPACITY | VOLVER_OPTICAL_DEPTH | VOLVER_EXPECTED_DEPTH; d->by_opacity = 1; }\n";
    let answers = "int volver_render(const volver_task *t, volver_result *r) {\n\
        if (t->background) return 1;\n\
        if (!isnan(r->optical_depth) || !isnan(r->expected_depth)) return 2;\n\
        r->optical_depth = 2; r->expected_depth = 0.75; return 0; }\n";
    let Some(kernel) = open(&format!("{declares}{answers}")) else {
        return;
    };
    let mut kernel = kernel.unwrap();
    let declared = kernel.declaration();
    assert_eq!(
        declared.answers,
        [
            Quantity::Opacity,
            Quantity::OpticalDepth,
            Quantity::ExpectedDepth
        ]
    );
    assert_eq!(declared.expected_depth, DepthWeights::ByOpacity);
    let rendering = answer(&mut kernel, "rgb-transfer").unwrap();
    assert!(rendering.radiance.is_empty());
    // It says that there is one, and that it is no number.
    assert!(rendering.opacity.unwrap().is_nan());
    assert_eq!(rendering.optical_depth.unwrap(), 2.0);
    assert_eq!(rendering.expected_depth.unwrap(), 0.75);
    let takes = "void volver_declare(volver_declaration *d) { d->background = 1; }\n\
        int volver_render(const volver_task *t, volver_result *r) {\n\
        for (int c = 0; c < 3; c++) { r->radiance[c] = t->background[c]; }\n\
        return 0; }\n";
    let mut kernel = open(takes).expect("a compiler").unwrap();
    // Nothing is behind this task.
    let rendering = answer(&mut kernel, "rgb-transfer").unwrap();
    assert_eq!(numbers(&rendering), [0.0, 0.0, 0.0]);
    let unknown = "void volver_declare(volver_declaration *d) { d->answers = 16; }\n";
    let refused = open(&format!("{unknown}{ANSWERS_NOTHING}")).expect("a compiler");
    let said = refused.unwrap_err().to_string();
    assert!(
        said.contains("it declares answers 0x10 (allowed: 0x1 to 0xf"),
        "{said}"
    );
}

/// The library sees all that a task has, and volver all that it writes.
#[test]
fn segments_arrive_and_the_answer_comes_back() {
    let code = "int volver_render(const volver_task *t, volver_result *r) {\n\
        if (t->size != sizeof *t || r->size != sizeof *r) return 1;\n\
        if (t->segments != 8 || t->seed != 7 || t->channels != 3) return 2;\n\
        if (strcmp(t->case_name, \"rgb-transfer\") || t->step * 8 != t->length) return 3;\n\
        if (t->edges.lambda[0] != 0 || t->edges.lambda[8] != t->length) return 4;\n\
        for (uint64_t i = 0; i < 8; i++) {\n\
          double e[3], tau = t->medium.at(t->medium.context, t->middles.lambda[i], e);\n\
          if (tau != t->middles.extinction[i] || e[2] != t->middles.emission[2][i]) return 5;\n\
          if (tau != t->medium.at(t->medium.context, t->middles.lambda[i], NULL)) return 6; }\n\
        if (!isnan(r->radiance[2]) || !isnan(r->standard_error[2]) || !isnan(r->opacity)) return 7;\n\
        for (int c = 0; c < 3; c++) { r->radiance[c] = c + 1; r->standard_error[c] = 0.5; }\n\
        r->opacity = 0.25; r->step = 2; r->segments = 9; return 0; }\n";
    let Some(kernel) = open(&format!("{DECLARES_NOTHING}{code}")) else {
        return;
    };
    let rendering = answer(&mut kernel.unwrap(), "rgb-transfer").unwrap();
    let float = |x: f64| Float::with_val(53, x);
    let expected = Rendering {
        radiance: [1.0, 2.0, 3.0].map(float).into(),
        opacity: Some(float(0.25)),
        step: Some(2.0),
        segments: Some(9),
        standard_error: Some(vec![0.5; 3]),
        ..Rendering::default()
    };
    assert_eq!(rendering, expected);
}

#[test]
fn the_medium_can_be_called_anywhere() {
    let code = "void volver_declare(volver_declaration *d) { d->form = \"function\"; }\n\
        int volver_render(const volver_task *t, volver_result *r) {\n\
        if (t->edges.lambda || t->middles.extinction || t->edges.emission) return 1;\n\
        if (!isnan(t->medium.at(NULL, 0, NULL))) return 2;\n\
        r->opacity = t->medium.at(t->medium.context, 0.3, r->radiance); return 0; }\n";
    let Some(kernel) = open(code) else {
        return;
    };
    let mut kernel = kernel.unwrap();
    let rendering = answer(&mut kernel, "rgb-transfer").unwrap();
    let mut emission = [0.0; 3];
    let extinction = subject("rgb-transfer").at(0.3, &mut emission);
    assert_eq!(numbers(&rendering), emission);
    assert_eq!(rendering.opacity, Some(Float::with_val(53, extinction)));
    // Segments are not what it asked for.
    let subject = subject("homogeneous");
    let segments = subject.segments(Cut::Segments(4)).unwrap();
    let (given, wanted) = (FormKind::Segments, FormKind::Function);
    let refused = kernel.render(&task(&subject, &segments));
    assert_eq!(refused, Err(KernelError::Form { given, wanted }));
}

#[test]
fn a_volume_arrives_with_its_tables() {
    let code = "void volver_declare(volver_declaration *d) { d->form = \"volume\"; }\n\
        int volver_render(const volver_task *t, volver_result *r) {\n\
        const volver_volume *v = &t->volume;\n\
        if (t->edges.lambda || t->middles.extinction || t->code) return 1;\n\
        if (v->points != 5 || v->entries != 7 || t->segments != 8) return 2;\n\
        r->radiance[0] = v->field[4] + v->first; r->radiance[1] = v->last + v->extinction[6];\n\
        r->radiance[2] = v->emission[2][5]; return 0; }\n";
    let Some(kernel) = open(code) else {
        return;
    };
    let mut kernel = kernel.unwrap();
    assert_eq!(kernel.declaration().form, FormKind::Volume);
    let subject = subject("rgb-transfer");
    let (segments, volume) = (
        subject.segments(Cut::Segments(8)).unwrap(),
        subject.volume(4, 7),
    );
    let task = Task {
        data: Data::Volume(&volume),
        ..task(&subject, &segments)
    };
    let table = &volume.table;
    let wanted = [
        volume.field[4] + table.first,
        table.last + table.extinction[6],
        table.emission[2][5],
    ];
    assert_eq!(numbers(&kernel.render(&task).unwrap()), wanted);
    // A grid of one point is none.
    let mut point = volume.clone();
    point.field.truncate(1);
    let data = Data::Volume(&point);
    let refused = kernel.render(&Task { data, ..task });
    assert!(matches!(refused, Err(KernelError::Library { .. })));
}

#[test]
fn a_formula_arrives_as_code() {
    let code = "void volver_declare(volver_declaration *d) {\n\
        d->form = \"formula\"; d->language = \"c\"; }\n\
        int volver_render(const volver_task *t, volver_result *r) {\n\
        if (t->edges.lambda || t->volume.points || !strstr(t->code, \"LENGTH\")) return 1;\n\
        r->radiance[0] = (double)strlen(t->code); return 0; }\n";
    let Some(kernel) = open(code) else {
        return;
    };
    let mut kernel = kernel.unwrap();
    let (subject, language) = (subject("cloud"), Language::C);
    assert_eq!(kernel.declaration().form, FormKind::Formula(language));
    let segments = subject.segments(Cut::Segments(8)).unwrap();
    let formula = subject.formula(language).unwrap();
    let task = Task {
        data: Data::Formula(&formula),
        ..task(&subject, &segments)
    };
    let radiance = numbers(&kernel.render(&task).unwrap());
    assert_eq!(radiance, [formula.code.len() as f64]);
}

#[test]
fn bad_libraries_are_refused_with_what_is_wrong() {
    let declares =
        |what: &str| format!("void volver_declare(volver_declaration *d) {{ d->{what}; }}\n");
    for (code, wanted) in [
        (String::new(), "it has no function volver_declare"),
        (DECLARES_NOTHING.into(), "it has no function volver_render"),
        (
            declares("form = \"grid\""),
            "it declares form 'grid' (allowed: segments, function, volume, formula)",
        ),
        (
            declares("form = \"formula\""),
            "it declares no language of the formula (allowed: c, python, rust)",
        ),
        (
            declares("form = \"formula\", d->language = \"lisp\""),
            "it declares a language: ",
        ),
        (
            declares("language = \"c\""),
            "it declares a language without need (allowed: with the form formula)",
        ),
        (
            declares("form = \"\\xff\""),
            "its form is no UTF-8 (allowed: UTF-8)",
        ),
        (
            declares("method = \"gauss\""),
            "in its declaration: method 'gauss': unknown",
        ),
        (declares("format = \"f33\""), "in its declaration: unknown"),
        (
            declares("sampling = \"far\""),
            "in its declaration: unknown sampling 'far' (allowed: front",
        ),
        (declares("order = -1"), "it declares order -1 (allowed:"),
        (
            declares("quantum = -0.5"),
            "it declares a quantum of -0.5 (allowed:",
        ),
        (
            declares("noise = NAN"),
            "it declares noise of NaN (allowed: finite, above 0, or 0 for none)",
        ),
        (
            declares("exp_ulp[0] = -1"),
            "it declares exp_ulp: -1 + 0 |x| units in the last place (allowed:",
        ),
        (declares("output = \"f33\""), "in its declaration: unknown"),
        (
            format!(
                "double elsewhere(void); {}",
                declares("order = elsewhere()")
            ),
            "undefined symbol: elsewhere",
        ),
    ] {
        let complete = code.contains("d->");
        let answers = if complete { ANSWERS_NOTHING } else { "" };
        let Some(opened) = open(&format!("{code}{answers}")) else {
            return;
        };
        let said = opened.unwrap_err().to_string();
        assert!(said.contains(wanted), "{said}");
        assert!(said.contains("kernel.so: "), "{said}");
    }
    // Nothing is compiled of these.
    let folder = tempfile::tempdir().unwrap();
    let text = folder.path().join("text.so");
    fs::write(&text, "no library").unwrap();
    for (path, wanted) in [
        (folder.path().join("missing.so"), "No such file"),
        (text, "too short"),
        // As a name alone, the system would find it.
        ("libc.so.6".into(), "No such file"),
    ] {
        let said = LibraryKernel::open(&path).unwrap_err().to_string();
        assert!(said.contains(wanted), "{said}");
    }
}

#[test]
fn another_version_of_the_interface_is_refused() {
    let code = "#include \"volver.h\"\n\
        uint32_t volver_abi_version(void) { return VOLVER_ABI + 1; }\n";
    let Some((_folder, path)) = library(&format!("{code}{DECLARES_NOTHING}{ANSWERS_NOTHING}"))
    else {
        return;
    };
    let said = LibraryKernel::open(&path).unwrap_err().to_string();
    let wanted = "it was compiled for version 2 of the interface (allowed: 1)";
    assert!(said.contains(wanted), "{said}");
}

#[test]
fn bad_answers_are_told_apart() {
    let refused = |reason: &str| {
        Err(KernelError::Refused {
            reason: reason.into(),
        })
    };
    let used = |value| {
        Err(KernelError::Used {
            what: "step",
            value,
        })
    };
    for (code, wanted) in [
        (
            "strcpy(r->message, \" a ray too long\\n\"); return 3;",
            refused("a ray too long"),
        ),
        (
            "r->radiance[0] = 1; return -4;",
            refused("volver_render returned -4 and no message"),
        ),
        // A message may fill its place.
        (
            "memset(r->message, 'a', sizeof r->message); return 1;",
            refused(&"a".repeat(256)),
        ),
        ("r->radiance[0] = 1; r->step = -0.5; return 0;", used(-0.5)),
        (
            "r->radiance[0] = 1; r->step = INFINITY; return 0;",
            used(f64::INFINITY),
        ),
    ] {
        let render = "int volver_render(const volver_task *t, volver_result *r) { (void)t;";
        let Some(kernel) = open(&format!("{DECLARES_NOTHING}{render} {code} }}\n")) else {
            return;
        };
        let mut kernel = kernel.unwrap();
        // Once more, after the failure.
        assert_eq!(answer(&mut kernel, "homogeneous"), wanted);
        assert_eq!(answer(&mut kernel, "homogeneous"), wanted);
    }
}

#[test]
fn what_is_not_written_is_no_number() {
    let Some(kernel) = open(&format!("{DECLARES_NOTHING}{ANSWERS_NOTHING}")) else {
        return;
    };
    let rendering = answer(&mut kernel.unwrap(), "rgb-transfer").unwrap();
    assert!(numbers(&rendering).iter().all(|value| value.is_nan()));
    assert_eq!(rendering.radiance.len(), 3);
    let told = (
        rendering.opacity,
        rendering.step,
        rendering.segments,
        rendering.standard_error,
    );
    assert_eq!(told, (None, None, None, None));
}

#[test]
fn three_colors_for_one_channel_are_noticed() {
    let code = "int volver_render(const volver_task *t, volver_result *r) {\n\
        (void)t; for (int c = 0; c < 3; c++) r->radiance[c] = 0.5; return 0; }\n";
    let Some(kernel) = open(&format!("{DECLARES_NOTHING}{code}")) else {
        return;
    };
    let mut kernel = kernel.unwrap();
    let said = answer(&mut kernel, "homogeneous").unwrap_err().to_string();
    let wanted = "it wrote more radiances than the case has channels";
    assert!(said.contains(wanted), "{said}");
    assert!(answer(&mut kernel, "rgb-transfer").is_ok());
}

#[test]
fn tasks_that_do_not_fit_together_never_reach_the_library() {
    let code = "int volver_render(const volver_task *t, volver_result *r) {\n\
        r->radiance[0] = t->middles.lambda[t->segments - 1]; return 0; }\n";
    let Some(kernel) = open(&format!("{DECLARES_NOTHING}{code}")) else {
        return;
    };
    let mut kernel = kernel.unwrap();
    let subject = subject("homogeneous");
    let whole = subject.segments(Cut::Segments(4)).unwrap();
    assert!(kernel.render(&task(&subject, &whole)).is_ok());
    let mut longer = task(&subject, &whole);
    longer.segments = 5;
    let mut short = whole.clone();
    short.edges.emission[0].pop();
    let mut colorless = whole.clone();
    colorless.middles.emission.clear();
    for task in [longer, task(&subject, &short), task(&subject, &colorless)] {
        let said = kernel.render(&task).unwrap_err().to_string();
        assert!(said.contains("arrays of other lengths"), "{said}");
    }
}

/// Warnings are errors here, and C++ has its own.
#[test]
fn the_header_is_c_and_cpp() {
    for (name, language, standard) in [
        ("cc", "c", "-std=c99"),
        ("cc", "c", "-std=c17"),
        ("c++", "c++", "-std=c++11"),
        ("c++", "c++", "-std=c++20"),
    ] {
        let Some(mut compiler) = compiler(name) else {
            continue;
        };
        compiler.args([standard, "-fsyntax-only", "-x", language]);
        run({
            compiler.arg(root("include/volver.h"));
            compiler
        });
    }
}
