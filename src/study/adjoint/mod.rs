//! Whether a projector and its backprojector are adjoint to each other.
//!
//! A line integral is linear in the extinction, t = A x, and a backprojector is meant to be Aᵀ: ⟨A x, y⟩ = ⟨x, Aᵀ y⟩ for all
//! x and y, in the inner products that are declared. Entries tell: A eᵢ beside (Aᵀ 1)ᵢ, one by one. Sums over a whole ray
//! hide what single entries show, so that products of vectors come beside them, not in their place.

mod asked;
mod faults;
mod rays;

pub use faults::Fault;

use super::gradient::{Places, PlacesError};
use crate::kernel::{Declaration, DeclarationError, InnerProduct, Kernel, KernelError, Quantity};
use asked::Asked;
use faults::named;
use rays::rays;
use rug::Float;

/// Bits of sums beyond those of the answers.
const GUARD: u32 = 64;
/// Roundings of a line integral, or of an entry.
const ROUNDINGS: f64 = 64.0;

/// With what vectors ⟨A x, y⟩ = ⟨x, Aᵀ y⟩ was asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Vectors {
    /// Numbers from 0 to 1, on both sides.
    Positive,
    /// Numbers whose mean is 0, on both sides: what is added to every entry does not hide behind what is right.
    ZeroMean,
    /// y = A x of other numbers: an image, as a reconstruction has it.
    Image,
}

impl Vectors {
    /// All.
    pub const ALL: [Vectors; 3] = [Vectors::Positive, Vectors::ZeroMean, Vectors::Image];

    /// Its name, as in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Vectors::Positive => "positive",
            Vectors::ZeroMean => "zero-mean",
            Vectors::Image => "image",
        }
    }
}

/// Both sides of ⟨A x, y⟩ = ⟨x, Aᵀ y⟩, over all rays.
#[derive(Clone, Debug, PartialEq)]
pub struct Product {
    /// What x and y were.
    pub vectors: Vectors,
    /// ⟨A x, y⟩.
    pub forward: Float,
    /// ⟨x, Aᵀ y⟩, in the inner product declared.
    pub back: Float,
    /// Whether rounding may be what they differ by.
    pub agrees: bool,
}

impl Product {
    /// |⟨A x, y⟩ − ⟨x, Aᵀ y⟩| as a part of the larger of both.
    #[must_use]
    pub fn mismatch(&self) -> f64 {
        let most = self.forward.clone().abs().max(&self.back.clone().abs());
        if most.is_zero() {
            return 0.0;
        }
        (Float::with_val(most.prec(), &self.forward - &self.back).abs() / most).to_f64()
    }
}

/// The entries of one ray.
#[derive(Clone, Debug, PartialEq)]
pub struct OfRay {
    /// n.
    pub segments: usize,
    /// A eᵢ.
    pub forward: Vec<Float>,
    /// (Aᵀ 1)ᵢ times the weight of the inner product, which is A eᵢ where both match.
    pub back: Vec<Float>,
    /// The places of entries that rounding does not explain.
    pub differ: Vec<usize>,
    /// Faults are found on the others.
    pub held_out: bool,
}

/// What a projector is not, whatever its entries are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Broken {
    /// A x is not Σ xᵢ A eᵢ.
    Forward,
    /// The same, where some xᵢ are below 0 and nowhere else.
    Signed,
    /// Aᵀ y is not y Aᵀ 1, or depends on x.
    Back,
    /// An answer is NaN or infinite.
    NotFinite,
}

impl Broken {
    /// Its name, as in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Broken::Forward => "not-linear",
            Broken::Signed => "not-linear-below-0",
            Broken::Back => "back-not-linear",
            Broken::NotFinite => "not-finite",
        }
    }
}

/// What came out.
#[derive(Clone, Debug, PartialEq)]
pub struct Adjoint {
    /// What the kernel says of itself.
    pub declaration: Declaration,
    /// Which values it projects.
    pub places: Places,
    /// The inner product of these, as declared.
    pub product: InnerProduct,
    /// Ray by ray.
    pub rays: Vec<OfRay>,
    /// Both sides of the identity.
    pub products: Vec<Product>,
    /// What is not linear.
    pub broken: Vec<Broken>,
    /// What is wrong with the entries, where it has a name.
    pub fault: Option<Fault>,
}

impl Adjoint {
    /// Whether the pair is matched: everything is linear, and all entries and products agree.
    #[must_use]
    pub fn is_matched(&self) -> bool {
        self.broken.is_empty()
            && self.rays.iter().all(|ray| ray.differ.is_empty())
            && self.products.iter().all(|product| product.agrees)
    }
}

/// Why there is nothing to compare.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AdjointError {
    /// No adjoint is declared.
    #[error(
        "no adjoint is declared (allowed: \"adjoint\": \"plain\" or \"lengths\" in the greeting, beside \"gradient\" and an optical_depth)"
    )]
    NoAdjoint,
    /// Random numbers.
    #[error(
        "a projector that draws random numbers (allowed: one whose answers do not depend on seeds)"
    )]
    Stochastic,
    /// What is declared cannot all be.
    #[error(transparent)]
    Declaration(#[from] DeclarationError),
    /// It samples elsewhere than where its values lie.
    #[error(transparent)]
    Places(#[from] PlacesError),
    /// It does not answer.
    #[error(transparent)]
    Kernel(#[from] KernelError),
}

/// Asks for the entries of A and Aᵀ on rays of several lengths, and for both sides of the identity.
///
/// # Errors
/// [`AdjointError`] where the kernel declares no adjoint or does not answer. What it does wrong is no error.
pub fn adjoint(kernel: &mut dyn Kernel) -> Result<Adjoint, AdjointError> {
    let declaration = kernel.declaration().clone();
    declaration.check()?;
    let (Some(product), Some(at)) = (declaration.adjoint, declaration.gradient) else {
        return Err(AdjointError::NoAdjoint);
    };
    if !declaration.has(Quantity::OpticalDepth) {
        return Err(AdjointError::NoAdjoint);
    }
    if declaration.stochastic {
        return Err(AdjointError::Stochastic);
    }
    let places = Places::of(&declaration, at)?;
    kernel.renew();
    let mut asked = Asked {
        kernel,
        places,
        product,
        bits: declaration.format.bits().max(f64::MANTISSA_DIGITS) + GUARD,
        unit: Float::with_val(64, 1) >> declaration.format.bits(),
        broken: Vec::new(),
    };
    let projected = rays(&declaration, places);
    let mut found = Vec::new();
    for ray in &projected {
        found.push(asked.entries(ray)?);
    }
    let products = asked.products(&projected)?;
    let mut broken = asked.broken;
    broken.dedup();
    let fault = named(&projected, &found, product, &asked.unit);
    Ok(Adjoint {
        declaration,
        places,
        product,
        rays: found,
        products,
        broken,
        fault,
    })
}
