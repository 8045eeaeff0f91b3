#!/usr/bin/env bash
# twofloat 0.8.4 (crate, numbers as sums of two f64, some 106 bits): exp of a negative number, as every transmittance is, has
# fewer right digits than plain f64.
# Expected: exp(-d) as good as exp(d), at least f64's 1e-16: both are reduced to |r| <= ln(2)/2 before the polynomial.
# Seen (2026-12-01), against f64's exp(-d): d = 0.96: exp(-d) off by 4.7e-12, 1/exp(d) equal; 2000 depths 0.01 ... 60: worst
#   1.7e-11 and 2.2e-16; more than 1e-15 off: 726 of them and 0, all with |r| > 0.7 ln(2); exp_m1(-0.96) off by 2.9e-12.
# Does: negative numbers go to the next multiple of ln(2) towards 0, not the nearest, so that r lies in [-1.5 ln(2),
#   -0.5 ln(2)], outside the polynomial's interval, for every d > 0.35. Worst where d/ln(2) is just below a half-integer (0.96,
#   1.72, 5.19), where it jumps; within f64's just above it (1.05, 5.21). The high word itself is wrong; exp_m1 inherits it.
# So: transmittances as 1/exp(d); exp(-d) of this crate is no oracle for binary64.
# Needs cargo. Exits 0 while this is so, 1 once it changes. Date: 2026-12-01
set -euo pipefail
tmp=$(mktemp -d)
trap 'rm -rf "$tmp"' EXIT
mkdir "$tmp/src"
cat > "$tmp/Cargo.toml" <<'TOML'
[package]
name = "probe"
version = "0.0.0"
edition = "2021"
[dependencies]
twofloat = "=0.8.4"
[workspace]
TOML
cat > "$tmp/src/main.rs" <<'RS'
use twofloat::TwoFloat;

/// Relative differences from f64's own exponential: of exp(-d) and of 1/exp(d), high words alone.
fn off(d: f64) -> (f64, f64) {
    let plain = (-d).exp();
    let direct = TwoFloat::from(-d).exp();
    let inverse = TwoFloat::from(1.0) / TwoFloat::from(d).exp();
    ((direct.hi() / plain - 1.0).abs(), (inverse.hi() / plain - 1.0).abs())
}

fn main() {
    for d in [0.30, 0.96, 1.05, 1.72, 5.19, 5.21] {
        let (direct, inverse) = off(d);
        println!("d = {d:5}: exp(-d) off by {direct:.2e}, 1/exp(d) off by {inverse:.2e}");
    }
    let (mut worst, mut worst_inverse, mut bad, mut bad_inverse, mut far) = (0.0f64, 0.0f64, 0, 0, 0);
    let n = 2000;
    for i in 0..n {
        let d = 0.01 * 6000f64.powf(i as f64 / (n - 1) as f64);
        let (direct, inverse) = off(d);
        worst = worst.max(direct);
        worst_inverse = worst_inverse.max(inverse);
        bad += (direct > 1e-15) as i32;
        bad_inverse += (inverse > 1e-15) as i32;
        // |r| over ln(2) if the multiple taken is the next one towards 0 of d/ln(2) - 1/2.
        let r = (d / std::f64::consts::LN_2 - 0.5).max(0.0).fract() + 0.5;
        far += (direct > 1e-15 && d > 0.35 && r > 0.7) as i32;
    }
    println!("{n} depths 0.01 ... 60: worst exp(-d) {worst:.2e}, 1/exp(d) {worst_inverse:.2e}");
    println!("more than 1e-15 off: exp(-d) {bad}, 1/exp(d) {bad_inverse}; of the former with |r| > 0.7 ln(2): {far}");
    let m = TwoFloat::from(-0.96).exp_m1();
    let off_m = (m.hi() / (-0.96f64).exp_m1() - 1.0).abs();
    println!("exp_m1(-0.96) off by {off_m:.2e}");
    let same = worst > 1e-12 && worst_inverse < 4e-16 && bad > n / 5 && bad_inverse == 0 && far == bad
        && off_m > 1e-13;
    std::process::exit(!same as i32);
}
RS
export CARGO_TARGET_DIR="$tmp/target"
if cargo run --quiet --release --manifest-path "$tmp/Cargo.toml"; then
    echo "as described"
else
    echo "changed"
    exit 1
fi
