//! What elementary functions are made of in each precision.
//!
//! The polynomials are minimax by Remez's exchange; their coefficients are numbers of the format, each rounded before the
//! next ones are fitted.

use super::circle::{self, Angle};

/// Numbers of one precision that functions need.
pub trait Constants: Sized + 'static {
    /// Bits of an encoding.
    const ENCODING_BITS: u32;
    /// Those of them that are the fraction's.
    const FRACTION_BITS: u32;
    /// Added, it leaves small integers in the last bits.
    const INTEGER: Self;
    /// The same, with the exponent's bias in the last bits.
    const EXPONENT: Self;
    /// 1/ln 2.
    const INVERSE_LN_2: Self;
    /// ln 2 in so few bits that n times it is exact.
    const LN_2_HIGH: Self;
    /// The rest of ln 2.
    const LN_2_LOW: Self;
    /// (eʳ − 1 − r − r²/2)/r³ for |r| ≤ ½ ln 2.
    const EXPONENTIAL: &'static [Self];
    /// An x at which eˣ is 0.
    const EXP_IS_ZERO: Self;
    /// An x at which eˣ is infinite.
    const EXP_IS_INFINITE: Self;
    /// An x at which eˣ − 1 is −1.
    const EXP_M1_IS_MINUS_ONE: Self;
    /// |x| up to which eˣ − 1 is x.
    const EXP_M1_IS_X: Self;
    /// 2/π.
    const TWO_OVER_PI: Self;
    /// π/2 in parts of so few bits that n times one is exact for |n| < 2/π [`NEAR`](Constants::NEAR).
    const QUARTER_TURN: [Self; 3];
    /// The rest of π/2, in parts.
    const QUARTER_TURN_LAST: &'static [Self];
    /// |x| up to which those parts are enough.
    const NEAR: Self;
    /// |x| up to which sin x is x.
    const SIN_IS_X: Self;
    /// (sin r / r − 1)/r² as a polynomial in r² for |r| ≤ π/4.
    const SINE: &'static [Self];
    /// (cos r − 1 + r²/2)/r⁴ as a polynomial in r² for |r| ≤ π/4.
    const COSINE: &'static [Self];

    /// x modulo π/2 where it is beyond [`NEAR`](Constants::NEAR): the number of quarter turns, what is left and what that has
    /// been rounded by.
    fn angle(self) -> (u32, Self, Self);
}

impl Constants for f32 {
    const ENCODING_BITS: u32 = 32;
    const FRACTION_BITS: u32 = f32::MANTISSA_DIGITS - 1;
    const INTEGER: f32 = 12_582_912.0;
    const EXPONENT: f32 = Self::INTEGER + 127.0;
    const INVERSE_LN_2: f32 = std::f32::consts::LOG2_E;
    // 15 bits, and |n| < 2⁹.
    const LN_2_HIGH: f32 = 0.693_145_75;
    const LN_2_LOW: f32 = 1.428_606_8e-6;
    // eʳ is within 2⁻³⁰·⁹ of itself.
    const EXPONENTIAL: &'static [f32] = &[
        0.166_666_48,
        0.041_666_48,
        0.008_337_88,
        0.001_393_398,
        0.000_173_481_97,
    ];
    const EXP_IS_ZERO: f32 = -104.0;
    const EXP_IS_INFINITE: f32 = 89.0;
    const EXP_M1_IS_MINUS_ONE: f32 = -26.0;
    const EXP_M1_IS_X: f32 = 1e-8;
    const TWO_OVER_PI: f32 = std::f32::consts::FRAC_2_PI;
    // 11 bits, and |n| < 2¹³.
    const QUARTER_TURN: [f32; 3] = [1.570_312_5, 0.000_483_751_3, 7.549_533_6e-8];
    const QUARTER_TURN_LAST: &'static [f32] = &[2.563_283e-12, 6.123_234e-17];
    const NEAR: f32 = 8192.0;
    const SIN_IS_X: f32 = 1e-4;
    // sin r is within 2⁻²⁸ of itself, cos r within 2⁻³³.
    const SINE: &'static [f32] = &[-0.166_666_55, 0.008_332_191, -0.000_195_186_05];
    const COSINE: &'static [f32] = &[0.041_666_646, -0.001_388_730_1, 2.443_066_8e-5];

    fn angle(self) -> (u32, f32, f32) {
        let Angle {
            quarters,
            high,
            low,
        } = circle::reduced(f64::from(self));
        let near = circle::narrow(high);
        (quarters, near, circle::narrow(high - f64::from(near) + low))
    }
}

impl Constants for f64 {
    const ENCODING_BITS: u32 = 64;
    const FRACTION_BITS: u32 = f64::MANTISSA_DIGITS - 1;
    const INTEGER: f64 = 6_755_399_441_055_744.0;
    const EXPONENT: f64 = Self::INTEGER + 1023.0;
    const INVERSE_LN_2: f64 = std::f64::consts::LOG2_E;
    // 41 bits, and |n| < 2¹².
    const LN_2_HIGH: f64 = 0.693_147_180_560_117_7;
    const LN_2_LOW: f64 = -1.723_944_452_561_483_5e-13;
    // eʳ is within 2⁻⁶⁴·⁷ of itself.
    const EXPONENTIAL: &'static [f64] = &[
        0.166_666_666_666_666_69,
        0.041_666_666_666_666_685,
        0.008_333_333_333_331_69,
        0.001_388_888_888_887_241,
        0.000_198_412_698_463_367_54,
        2.480_158_735_263_605_6e-5,
        2.755_731_215_738_449e-6,
        2.755_724_759_570_754e-7,
        2.505_665_981_903_544_6e-8,
        2.092_332_674_723_348e-9,
        1.496_636_906_316_125_5e-10,
    ];
    const EXP_IS_ZERO: f64 = -746.0;
    const EXP_IS_INFINITE: f64 = 710.0;
    const EXP_M1_IS_MINUS_ONE: f64 = -40.0;
    const EXP_M1_IS_X: f64 = 1e-17;
    const TWO_OVER_PI: f64 = std::f64::consts::FRAC_2_PI;
    // 32 bits, and |n| < 2²¹.
    const QUARTER_TURN: [f64; 3] = [
        1.570_796_326_734_125_6,
        6.077_100_506_303_966e-11,
        2.022_266_248_711_166_5e-21,
    ];
    const QUARTER_TURN_LAST: &'static [f64] = &[8.478_427_660_368_9e-32];
    const NEAR: f64 = 1_048_576.0;
    const SIN_IS_X: f64 = 1e-9;
    // sin r is within 2⁻⁵⁸ of itself, cos r within 2⁻⁶⁴.
    const SINE: &'static [f64] = &[
        -0.166_666_666_666_666_32,
        0.008_333_333_333_322_486,
        -0.000_198_412_698_298_533_9,
        2.755_731_370_507_975e-6,
        -2.505_075_989_282_79e-8,
        1.589_688_673_918_697_5e-10,
    ];
    const COSINE: &'static [f64] = &[
        0.041_666_666_666_666_6,
        -0.001_388_888_888_887_447,
        2.480_158_728_966_691e-5,
        -2.755_731_439_926_783_5e-7,
        2.087_572_899_468_288_5e-9,
        -1.135_991_735_567_988_7e-11,
    ];

    fn angle(self) -> (u32, f64, f64) {
        let Angle {
            quarters,
            high,
            low,
        } = circle::reduced(self);
        (quarters, high, low)
    }
}
