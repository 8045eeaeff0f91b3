//! The C interface as `include/volver.h` has it, and all of this crate's unsafe code.
//!
//! # Contract
//!
//! Trusted, because nothing can check it: that a library's three functions have the header's signatures, write
//! to no memory but what they are given, keep no pointer after they return, return normally or end the process,
//! and that strings which they declare end in a null character.
//!
//! Kept on this side:
//! - structs have the header's layout, and outlive the call that they are passed to, with all they point to;
//! - arrays are as long as the header says ([`fits`]), and those written to are initialized before;
//! - one function of one library runs at a time, since few are written for more;
//! - no panic crosses C: [`at`] catches it, and it goes on when the library has returned. C++ exceptions
//!   that a library lets out are to end the process and no more, hence the ABI `C-unwind`;
//! - libraries are never unloaded, so that functions stay callable.
#![allow(unsafe_code)]

use super::declared::Declared;
use super::fits;
use super::tables::{RawVolume, Tables};
use crate::kernel::{Data, Medium as Asked, Samples, Task};
use libloading::os::unix::{Library, RTLD_LOCAL, RTLD_NOW};
use std::any::Any;
use std::error::Error;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::mem::{self, ManuallyDrop};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::{ptr, slice};

/// `VOLVER_ABI`.
const VERSION: u32 = 1;
/// Places behind the radiances that are watched: writing three colours to a case of one is easily done.
const MARGIN: usize = 4;

type VersionFunction = unsafe extern "C-unwind" fn() -> u32;
type DeclareFunction = unsafe extern "C-unwind" fn(*mut RawDeclaration);
type RenderFunction = unsafe extern "C-unwind" fn(*const RawTask, *mut RawResult) -> c_int;

/// `volver_declaration`.
#[repr(C)]
struct RawDeclaration {
    size: usize,
    name: *const c_char,
    form: *const c_char,
    method: *const c_char,
    format: *const c_char,
    sampling: *const c_char,
    order: f64,
    quantum: f64,
    stochastic: i32,
    far_wall: i32,
    step_divides: i32,
    multiple_of: u64,
    answers: u32,
    by_opacity: i32,
    background: i32,
    language: *const c_char,
    output: *const c_char,
    quantum_is_relative: i32,
    exp_ulp: [f64; 2],
    expm1_ulp: [f64; 2],
    pow_ulp: [f64; 2],
    subnormals_lost: i32,
    noise: f64,
    channels: u32,
    positive_emission: i32,
    source_per_length: i32,
}

/// `volver_medium`.
#[repr(C)]
struct RawMedium {
    at: extern "C" fn(*mut c_void, f64, *mut f64) -> f64,
    context: *mut c_void,
}

/// `volver_samples`.
#[repr(C)]
struct RawSamples {
    lambda: *const f64,
    extinction: *const f64,
    emission: *const *const f64,
}

/// `volver_task`.
#[repr(C)]
struct RawTask {
    size: usize,
    case_name: *const c_char,
    length: f64,
    step: f64,
    segments: u64,
    seed: u64,
    channels: u32,
    medium: RawMedium,
    edges: RawSamples,
    middles: RawSamples,
    background: *const f64,
    volume: RawVolume,
    code: *const c_char,
}

/// `volver_result`.
#[repr(C)]
struct RawResult {
    size: usize,
    radiance: *mut f64,
    standard_error: *mut f64,
    opacity: f64,
    step: f64,
    segments: u64,
    message: [c_char; 256],
    optical_depth: f64,
    expected_depth: f64,
}

/// The functions of a library.
#[derive(Clone, Copy, Debug)]
pub(super) struct Functions {
    declare: DeclareFunction,
    render: RenderFunction,
}

/// What a library wrote into `volver_result`.
#[derive(Debug)]
pub(super) struct Answer {
    pub(super) radiance: Vec<f64>,
    pub(super) standard_error: Vec<f64>,
    pub(super) opacity: f64,
    pub(super) step: f64,
    pub(super) segments: u64,
    pub(super) optical_depth: f64,
    pub(super) expected_depth: f64,
}

/// Why there is no answer.
#[derive(Debug)]
pub(super) enum Failure {
    /// The library's own words.
    Refused(String),
    /// Somebody did not keep to the interface.
    Broken(&'static str),
}

/// Held while a function of a library runs.
fn turn() -> MutexGuard<'static, ()> {
    static TURN: Mutex<()> = Mutex::new(());
    TURN.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Functions {
    /// Loads the library of that path, which has a slash.
    pub(super) fn load(path: &Path) -> Result<Self, String> {
        let _turn = turn();
        // All symbols now: one that is missing is an error here, and the end of the process later.
        // SAFETY: the library's initializers are trusted like its functions.
        let library = unsafe { Library::open(Some(path), RTLD_NOW | RTLD_LOCAL) };
        let library = ManuallyDrop::new(library.map_err(|error| reason(&error, path))?);
        // SAFETY: the types are the header's.
        let (version, declare, render) = unsafe {
            (
                symbol::<VersionFunction>(&library, "volver_abi_version")?,
                symbol::<DeclareFunction>(&library, "volver_declare")?,
                symbol::<RenderFunction>(&library, "volver_render")?,
            )
        };
        // SAFETY: it takes nothing, and the library is never unloaded.
        let version = unsafe { version() };
        if version != VERSION {
            return Err(format!(
                "it was compiled for version {version} of the interface (allowed: {VERSION})"
            ));
        }
        Ok(Functions { declare, render })
    }

    /// What the library says of itself.
    pub(super) fn declare(&self) -> Result<Declared, String> {
        let _turn = turn();
        let mut raw = RawDeclaration {
            size: size_of::<RawDeclaration>(),
            name: ptr::null(),
            form: ptr::null(),
            method: ptr::null(),
            format: ptr::null(),
            sampling: ptr::null(),
            order: f64::NAN,
            quantum: 0.0,
            stochastic: 0,
            far_wall: 0,
            step_divides: 0,
            multiple_of: 0,
            answers: 0,
            by_opacity: 0,
            background: 0,
            language: ptr::null(),
            output: ptr::null(),
            quantum_is_relative: 0,
            exp_ulp: [0.0; 2],
            expm1_ulp: [0.0; 2],
            pow_ulp: [0.0; 2],
            subnormals_lost: 0,
            noise: 0.0,
            channels: 0,
            positive_emission: 0,
            source_per_length: 0,
        };
        // SAFETY: the struct has the header's layout and lives through the call.
        unsafe { (self.declare)(&raw mut raw) };
        // SAFETY: strings are null or end in a null character, and nothing of the library runs meanwhile.
        unsafe {
            Ok(Declared {
                name: string("name", raw.name)?,
                form: string("form", raw.form)?,
                method: string("method", raw.method)?,
                format: string("format", raw.format)?,
                sampling: string("sampling", raw.sampling)?,
                order: raw.order,
                quantum: raw.quantum,
                stochastic: raw.stochastic != 0,
                far_wall: raw.far_wall != 0,
                step_divides: raw.step_divides != 0,
                multiple_of: raw.multiple_of,
                answers: raw.answers,
                by_opacity: raw.by_opacity != 0,
                background: raw.background != 0,
                language: string("language", raw.language)?,
                output: string("output", raw.output)?,
                quantum_is_relative: raw.quantum_is_relative != 0,
                exp_ulp: raw.exp_ulp,
                expm1_ulp: raw.expm1_ulp,
                pow_ulp: raw.pow_ulp,
                subnormals_lost: raw.subnormals_lost != 0,
                noise: raw.noise,
                channels: raw.channels,
                positive_emission: raw.positive_emission != 0,
                source_per_length: raw.source_per_length != 0,
            })
        }
    }

    /// The library's answer to a task in a form that it takes, with a background where it takes one.
    pub(super) fn render(&self, task: &Task<'_>, background: bool) -> Result<Answer, Failure> {
        if !fits(task) {
            return Err(Failure::Broken(
                "it was to be given arrays of other lengths than its task says",
            ));
        }
        let channels = task.subject.channels().len();
        let name: Vec<u8> = task.subject.name().bytes().filter(|b| *b != 0).collect();
        let name = CString::new(name).unwrap_or_default();
        let medium = Medium {
            subject: task.subject,
            panic: Mutex::new(None),
        };
        let (edges, middles) = match task.data {
            Data::Segments(segments) => (Some(&segments.edges), Some(&segments.middles)),
            _ => (None, None),
        };
        let (edges, middles) = (Columns::new(edges), Columns::new(middles));
        let mut behind = task.subject.background().to_vec();
        behind.resize(channels, 0.0);
        let volume = match task.data {
            Data::Volume(volume) => Some(volume),
            _ => None,
        };
        let tables = Tables::new(volume);
        let code = match task.data {
            // Source code has no null character.
            Data::Formula(formula) => CString::new(formula.code.as_str()).ok(),
            _ => None,
        };
        let raw = RawTask {
            size: size_of::<RawTask>(),
            case_name: name.as_ptr(),
            length: task.subject.length().to_f64(),
            step: task.step,
            segments: task.segments,
            seed: task.seed,
            channels: u32::try_from(channels).map_err(|_| Failure::Broken("too many channels"))?,
            medium: RawMedium {
                at,
                context: (&raw const medium).cast_mut().cast(),
            },
            edges: edges.raw(),
            middles: middles.raw(),
            background: if background {
                behind.as_ptr()
            } else {
                ptr::null()
            },
            volume: tables.raw(),
            code: code.as_ref().map_or(ptr::null(), |code| code.as_ptr()),
        };
        let mut radiance = vec![f64::NAN; channels + MARGIN];
        let mut standard_error = vec![f64::NAN; channels + MARGIN];
        let mut result = RawResult {
            size: size_of::<RawResult>(),
            radiance: radiance.as_mut_ptr(),
            standard_error: standard_error.as_mut_ptr(),
            opacity: f64::NAN,
            step: 0.0,
            segments: 0,
            message: [0; 256],
            optical_depth: f64::NAN,
            expected_depth: f64::NAN,
        };
        let code = {
            let _turn = turn();
            // SAFETY: structs and arrays have the header's layout and lengths and outlive the call.
            unsafe { (self.render)(&raw const raw, &raw mut result) }
        };
        let panic = mem::take(&mut *medium.panic.lock().unwrap_or_else(PoisonError::into_inner));
        if let Some(panic) = panic {
            resume_unwind(panic);
        }
        if code != 0 {
            return Err(Failure::Refused(refusal(code, &result.message)));
        }
        for values in [&mut radiance, &mut standard_error] {
            if values.drain(channels..).any(|watched| !watched.is_nan()) {
                return Err(Failure::Broken(
                    "it wrote more radiances than the case has channels",
                ));
            }
        }
        Ok(Answer {
            radiance,
            standard_error,
            opacity: result.opacity,
            step: result.step,
            segments: result.segments,
            optical_depth: result.optical_depth,
            expected_depth: result.expected_depth,
        })
    }
}

/// What the system says, without the path that it begins with.
fn reason(error: &libloading::Error, path: &Path) -> String {
    let said = error
        .source()
        .map_or(error.to_string(), ToString::to_string);
    let path = format!("{}: ", path.display());
    said.strip_prefix(&path).unwrap_or(&said).into()
}

/// A function of the library.
///
/// # Safety
/// `F` must be the type of a function pointer with that function's signature, and the library must never be
/// unloaded.
unsafe fn symbol<F: Copy>(library: &Library, name: &str) -> Result<F, String> {
    // SAFETY: the caller's promise.
    let symbol = unsafe { library.get::<F>(name.as_bytes()) };
    // What the system says of it repeats the path.
    let symbol = symbol.map_err(|_| format!("it has no function {name}"))?;
    Ok(*symbol)
}

/// A string that a library declares.
///
/// # Safety
/// `text` must be null or end in a null character.
unsafe fn string(what: &str, text: *const c_char) -> Result<Option<String>, String> {
    if text.is_null() {
        return Ok(None);
    }
    // SAFETY: the caller's promise.
    let text = unsafe { CStr::from_ptr(text) }.to_str();
    text.map(|text| Some(text.into()))
        .map_err(|_| format!("its {what} is no UTF-8 (allowed: UTF-8)"))
}

/// What a library says, or its code where it says nothing.
fn refusal(code: c_int, message: &[c_char]) -> String {
    // Signed or not, by platform.
    let bytes = message.iter().map(|c| u8::from_ne_bytes(c.to_ne_bytes()));
    let bytes: Vec<u8> = bytes.take_while(|byte| *byte != 0).collect();
    let said = String::from_utf8_lossy(&bytes);
    match said.trim() {
        "" => format!("volver_render returned {code} and no message"),
        said => said.into(),
    }
}

/// What the callback knows.
struct Medium<'a> {
    subject: &'a dyn Asked,
    /// A panic on its way around the library.
    panic: Mutex<Option<Box<dyn Any + Send>>>,
}

// A library may call from several threads.
const _: () = {
    const fn shared<T: Sync>() {}
    shared::<Medium<'_>>();
};

/// `volver_medium.at`.
extern "C" fn at(context: *mut c_void, lambda: f64, emission: *mut f64) -> f64 {
    // SAFETY: the context that `render` gave, which lives as long as it may be used; or null, by mistake.
    let Some(medium) = (unsafe { context.cast::<Medium<'_>>().as_ref() }) else {
        return f64::NAN;
    };
    let evaluate = || {
        if emission.is_null() {
            return medium.subject.at(lambda, &mut [0.0]);
        }
        let channels = medium.subject.channels().len();
        // SAFETY: there is room for as many as the task has channels, which the library may have left
        // uninitialized.
        let emission = unsafe {
            for channel in 0..channels {
                emission.add(channel).write(f64::NAN);
            }
            slice::from_raw_parts_mut(emission, channels)
        };
        medium.subject.at(lambda, emission)
    };
    catch_unwind(AssertUnwindSafe(evaluate)).unwrap_or_else(|panic| {
        *medium.panic.lock().unwrap_or_else(PoisonError::into_inner) = Some(panic);
        f64::NAN
    })
}

/// Samples, and pointers to the columns of emission.
struct Columns<'a> {
    samples: Option<&'a Samples>,
    emission: Vec<*const f64>,
}

impl<'a> Columns<'a> {
    fn new(samples: Option<&'a Samples>) -> Self {
        let columns = samples.map_or(&[][..], |samples| &samples.emission);
        let emission = columns.iter().map(Vec::as_ptr).collect();
        Columns { samples, emission }
    }

    fn raw(&self) -> RawSamples {
        let Some(samples) = self.samples else {
            return RawSamples {
                lambda: ptr::null(),
                extinction: ptr::null(),
                emission: ptr::null(),
            };
        };
        RawSamples {
            lambda: samples.lambda.as_ptr(),
            extinction: samples.extinction.as_ptr(),
            emission: self.emission.as_ptr(),
        }
    }
}
