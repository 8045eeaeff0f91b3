//! Numbers side by side: what they have to offer, and the vectors that they are in.

use super::constants::Constants;
use super::{LaneFloat, elementary};
use fearless_simd::{Select, Simd, SimdFloat, SimdMask};
use std::marker::PhantomData;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Some numbers of one type side by side, each of which goes its own way: every operation rounds as it does on one of
/// them alone, so that results do not depend on how many there are. There is no fused multiply-add, which not every
/// processor has.
pub trait Lanes:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The numbers' type.
    type Element: LaneFloat;
    /// A yes or no for each of them.
    type Mask: Copy;
    /// How many there are.
    const WIDTH: usize;

    /// The number x in every lane.
    #[must_use]
    fn all(self, x: Self::Element) -> Self;
    /// The first [`WIDTH`](Lanes::WIDTH) numbers of a row.
    ///
    /// # Panics
    /// Where the row has fewer.
    #[must_use]
    fn load(self, row: &[Self::Element]) -> Self;
    /// Writes the numbers to the front of a row.
    ///
    /// # Panics
    /// Where the row has room for fewer.
    fn store(self, row: &mut [Self::Element]);

    /// Every second number of these and of those behind them, from the first on, and from the second on.
    #[must_use]
    fn unzipped(self, behind: Self) -> (Self, Self);

    /// The bits of each number, shifted towards the sign.
    #[must_use]
    fn shifted(self, places: u32) -> Self;
    /// −0 where that bit of a number is set, bit 0 being the last of its fraction; +0 elsewhere.
    #[must_use]
    fn bit(self, bit: u32) -> Self;
    /// The numbers, their signs turned where `sign` is −0, which is +0 elsewhere.
    #[must_use]
    fn turned(self, sign: Self) -> Self;

    /// The smaller one of two numbers; any of both where one is not a number, and of 0 and −0.
    #[must_use]
    fn least(self, other: Self) -> Self;
    /// The larger one, likewise.
    #[must_use]
    fn most(self, other: Self) -> Self;

    /// a < b.
    fn below(self, other: Self) -> Self::Mask;
    /// |a| ≤ b.
    fn within(self, bound: Self) -> Self::Mask;
    /// `yes` where the mask says so, `no` elsewhere; nothing is taken over from what is not chosen, NaN neither.
    #[must_use]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Whether the mask says yes of all numbers.
    fn is_all(mask: Self::Mask) -> bool;

    /// eˣ, within 1 unit in the last place.
    #[inline(always)]
    #[must_use]
    fn exp(self) -> Self {
        elementary::exp(self)
    }
    /// eˣ − 1, within 1 unit in the last place; thin segments have the opacities that they should.
    #[inline(always)]
    #[must_use]
    fn exp_m1(self) -> Self {
        elementary::exp_m1(self)
    }
    /// (sin x, cos x), each within 2 units in the last place.
    #[inline(always)]
    #[must_use]
    fn sin_cos(self) -> (Self, Self) {
        elementary::sin_cos(self)
    }
}

macro_rules! one {
    ($float:ty) => {
        impl Lanes for $float {
            type Element = $float;
            type Mask = bool;
            const WIDTH: usize = 1;

            #[inline(always)]
            fn all(self, x: $float) -> Self {
                x
            }
            #[inline(always)]
            fn load(self, row: &[$float]) -> Self {
                row[0]
            }
            #[inline(always)]
            fn store(self, row: &mut [$float]) {
                row[0] = self;
            }
            #[inline(always)]
            fn unzipped(self, behind: Self) -> (Self, Self) {
                (self, behind)
            }
            #[inline(always)]
            fn shifted(self, places: u32) -> Self {
                <$float>::from_bits(self.to_bits() << places)
            }
            #[inline(always)]
            fn bit(self, bit: u32) -> Self {
                let sign = (-0.0 as $float).to_bits();
                <$float>::from_bits(
                    (self.to_bits() << (<$float as Constants>::ENCODING_BITS - 1 - bit)) & sign,
                )
            }
            #[inline(always)]
            fn turned(self, sign: Self) -> Self {
                <$float>::from_bits(self.to_bits() ^ sign.to_bits())
            }
            #[inline(always)]
            fn least(self, other: Self) -> Self {
                if other < self { other } else { self }
            }
            #[inline(always)]
            fn most(self, other: Self) -> Self {
                if self < other { other } else { self }
            }
            #[inline(always)]
            fn below(self, other: Self) -> bool {
                self < other
            }
            #[inline(always)]
            fn within(self, bound: Self) -> bool {
                self.abs() <= bound
            }
            #[inline(always)]
            fn select(mask: bool, yes: Self, no: Self) -> Self {
                if mask { yes } else { no }
            }
            #[inline(always)]
            fn is_all(mask: bool) -> bool {
                mask
            }
        }
    };
}
one!(f32);
one!(f64);

/// A vector of an instruction set.
#[derive(Clone, Copy)]
pub(super) struct Vector<S, V>(V, PhantomData<S>);

impl<S: Simd, V: SimdFloat<S>> Vector<S, V> {
    #[inline(always)]
    pub(super) fn zero(simd: S) -> Self
    where
        V::Element: Default,
    {
        Vector(V::splat(simd, V::Element::default()), PhantomData)
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident) => {
        impl<S: Simd, V: SimdFloat<S>> $trait for Vector<S, V> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Vector($trait::$method(self.0, other.0), PhantomData)
            }
        }
    };
}
operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl<S: Simd, V: SimdFloat<S>> Neg for Vector<S, V> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Vector(-self.0, PhantomData)
    }
}

impl<S: Simd, V: SimdFloat<S>> Lanes for Vector<S, V>
where
    V::Element: LaneFloat,
{
    type Element = V::Element;
    type Mask = V::Mask;
    const WIDTH: usize = V::LEN;

    #[inline(always)]
    fn all(self, x: V::Element) -> Self {
        Vector(V::splat(self.0.token(), x), PhantomData)
    }
    #[inline(always)]
    fn load(self, row: &[V::Element]) -> Self {
        Vector(V::from_slice(self.0.token(), &row[..V::LEN]), PhantomData)
    }
    #[inline(always)]
    fn store(self, row: &mut [V::Element]) {
        self.0.store_slice(&mut row[..V::LEN]);
    }
    #[inline(always)]
    fn unzipped(self, behind: Self) -> (Self, Self) {
        let (even, odd) = self.0.deinterleave(behind.0);
        (Vector(even, PhantomData), Vector(odd, PhantomData))
    }
    #[inline(always)]
    fn shifted(self, places: u32) -> Self {
        Vector(V::from_bits(self.0.to_bits() << places), PhantomData)
    }
    #[inline(always)]
    fn bit(self, bit: u32) -> Self {
        let sign = self.all(-V::Element::ZERO).0.to_bits();
        let up = self.0.to_bits() << (V::Element::ENCODING_BITS - 1 - bit);
        Vector(V::from_bits(up & sign), PhantomData)
    }
    #[inline(always)]
    fn turned(self, sign: Self) -> Self {
        Vector(
            V::from_bits(self.0.to_bits() ^ sign.0.to_bits()),
            PhantomData,
        )
    }
    #[inline(always)]
    fn least(self, other: Self) -> Self {
        Vector(self.0.min(other.0), PhantomData)
    }
    #[inline(always)]
    fn most(self, other: Self) -> Self {
        Vector(self.0.max(other.0), PhantomData)
    }
    #[inline(always)]
    fn below(self, other: Self) -> V::Mask {
        self.0.simd_lt(other.0)
    }
    #[inline(always)]
    fn within(self, bound: Self) -> V::Mask {
        self.0.abs().simd_le(bound.0)
    }
    #[inline(always)]
    fn select(mask: V::Mask, yes: Self, no: Self) -> Self {
        Vector(mask.select(yes.0, no.0), PhantomData)
    }
    #[inline(always)]
    fn is_all(mask: V::Mask) -> bool {
        mask.all_true()
    }
}

/// Twice as many.
#[derive(Clone, Copy)]
pub(super) struct Pair<L>(pub(super) L, pub(super) L);

macro_rules! operator_of_pair {
    ($trait:ident, $method:ident) => {
        impl<L: Lanes> $trait for Pair<L> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Pair(
                    $trait::$method(self.0, other.0),
                    $trait::$method(self.1, other.1),
                )
            }
        }
    };
}
operator_of_pair!(Add, add);
operator_of_pair!(Sub, sub);
operator_of_pair!(Mul, mul);
operator_of_pair!(Div, div);

impl<L: Lanes> Neg for Pair<L> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Pair(-self.0, -self.1)
    }
}

impl<L: Lanes> Lanes for Pair<L> {
    type Element = L::Element;
    type Mask = (L::Mask, L::Mask);
    const WIDTH: usize = 2 * L::WIDTH;

    #[inline(always)]
    fn all(self, x: L::Element) -> Self {
        Pair(self.0.all(x), self.1.all(x))
    }
    #[inline(always)]
    fn load(self, row: &[L::Element]) -> Self {
        Pair(self.0.load(row), self.1.load(&row[L::WIDTH..]))
    }
    #[inline(always)]
    fn store(self, row: &mut [L::Element]) {
        self.0.store(row);
        self.1.store(&mut row[L::WIDTH..]);
    }
    #[inline(always)]
    fn unzipped(self, behind: Self) -> (Self, Self) {
        let (even, odd) = self.0.unzipped(self.1);
        let (even_behind, odd_behind) = behind.0.unzipped(behind.1);
        (Pair(even, even_behind), Pair(odd, odd_behind))
    }
    #[inline(always)]
    fn shifted(self, places: u32) -> Self {
        Pair(self.0.shifted(places), self.1.shifted(places))
    }
    #[inline(always)]
    fn bit(self, bit: u32) -> Self {
        Pair(self.0.bit(bit), self.1.bit(bit))
    }
    #[inline(always)]
    fn turned(self, sign: Self) -> Self {
        Pair(self.0.turned(sign.0), self.1.turned(sign.1))
    }
    #[inline(always)]
    fn least(self, other: Self) -> Self {
        Pair(self.0.least(other.0), self.1.least(other.1))
    }
    #[inline(always)]
    fn most(self, other: Self) -> Self {
        Pair(self.0.most(other.0), self.1.most(other.1))
    }
    #[inline(always)]
    fn below(self, other: Self) -> Self::Mask {
        (self.0.below(other.0), self.1.below(other.1))
    }
    #[inline(always)]
    fn within(self, bound: Self) -> Self::Mask {
        (self.0.within(bound.0), self.1.within(bound.1))
    }
    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Pair(
            L::select(mask.0, yes.0, no.0),
            L::select(mask.1, yes.1, no.1),
        )
    }
    #[inline(always)]
    fn is_all(mask: Self::Mask) -> bool {
        L::is_all(mask.0) && L::is_all(mask.1)
    }
}
