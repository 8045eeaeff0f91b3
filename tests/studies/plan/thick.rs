//! Media that nobody sees to the end of.

use super::{plan, read};
use rug::Float;
use rug::float::Constant;
use volver::study::plan::scene_radiance;

struct Linear {
    extinction: (f64, f64),
    emission: (f64, f64),
}

impl Linear {
    fn text(&self) -> String {
        let ends =
            |(front, back): (f64, f64)| format!("{{front = \"{front:e}\", back = \"{back:e}\"}}");
        format!(
            "[[media]]\nfrom = 0\nto = 1\nkind = \"linear\"\nextinction = {}\nemission = {}\n",
            ends(self.extinction),
            ends(self.emission)
        )
    }

    /// C(0) + (C(1) − C(0)) ∫ e^(−t), what comes from the far end being nothing. Where τ does not fall the integral is
    /// √(π/2b) e^(u²) erfc(u) with u = a/√(2b) for t = a λ + b λ²/2, and 1/a for b = 0.
    fn radiance(&self) -> f64 {
        let number = |x: f64| Float::with_val(400, x);
        let (a, b) = (
            number(self.extinction.0),
            number(self.extinction.1 - self.extinction.0),
        );
        let integral = if b.is_zero() {
            a.recip()
        } else {
            let twice = Float::with_val(400, &b * 2_u32);
            let u = Float::with_val(400, &a / twice.clone().sqrt());
            let pi = Float::with_val(400, Constant::Pi);
            (pi / twice).sqrt() * u.clone().square().exp() * u.erfc()
        };
        let rise = number(self.emission.1) - self.emission.0;
        (rise * integral + self.emission.0).to_f64()
    }
}

/// Any depth, where τ does not fall: that has a closed form in MPFR.
#[test]
fn linear_media_of_any_depth_are_planned_and_right() {
    let emission = (0.25, 1.0);
    for extinction in [
        (1400.0, 1913.0),
        (900.0, 1100.0),
        (0.0, 4000.0),
        (7e4, 9e4),
        (2e5, 2e5),
        (1e6, 1.5e9),
        (0.0, 1e12),
        (1e20, 1e20),
        (0.0, 1e300),
    ] {
        let medium = Linear {
            extinction,
            emission,
        };
        let text = medium.text();
        let scene = read(&text);
        let exact = medium.radiance();
        for tolerance in [1e-2, 1e-6, 1e-12] {
            let plan = plan(&scene, tolerance, &text);
            assert!(plan.evaluations() <= 2, "{:?}", plan.stored());
            let found = plan.run::<f64>().unwrap().radiance[0];
            assert!(
                (found - exact).abs() <= tolerance,
                "{found} for {exact}:\n{text}"
            );
        }
    }
}

/// τ falls, to nothing too: 1/a + |b|/a³ + … of the integral of e^(−t), which the bounds hold between.
#[test]
fn thick_media_that_thin_out_are_planned_and_right() {
    for (front, back) in [
        (1913.0, 1400.0),
        (3000.0, 0.0),
        (1e5, 1e3),
        (1e9, 0.0),
        (1e15, 1e14),
    ] {
        let medium = Linear {
            extinction: (front, back),
            emission: (0.5, 0.0),
        };
        let text = medium.text();
        let scene = read(&text);
        let least = 0.5 - 0.5 / front * (1.0 + 1.1 / front);
        let most = 0.5 - 0.5 / front;
        for tolerance in [1e-2, 1e-6, 1e-12] {
            let plan = plan(&scene, tolerance, &text);
            assert!(plan.evaluations() <= 2, "{:?}", plan.stored());
            let found = plan.run::<f64>().unwrap().radiance[0];
            assert!(
                (least - tolerance..=most + tolerance).contains(&found),
                "{found} in {least} … {most}:\n{text}"
            );
        }
    }
}

/// In front of light that is not to be seen, behind it, and of several channels.
#[test]
fn thick_media_hide_what_is_behind_them() {
    let text = "background = 1e6\nchannels = [\"r\", \"g\"]\n\
        [[media]]\nfrom = 0\nto = 1\nkind = \"expression\"\nextinction = \"1 + lambda^2\"\nemission = [\"lambda\", 1]\n\
        [[media]]\nfrom = 1\nto = 2\nkind = \"linear\"\nextinction = {front = 5000, back = 90000}\nemission = [0.5, {front = 0, back = 8}]\n";
    let text = text.replace(
        "[0.5, {front = 0, back = 8}]",
        "{front = [0.5, 0], back = [0.5, 8]}",
    );
    let scene = read(&text);
    let exact = scene_radiance(&scene, 80).unwrap();
    for tolerance in [1e-2, 1e-6, 1e-10] {
        let plan = plan(&scene, tolerance, &text);
        let found = plan.run::<f64>().unwrap().radiance;
        for (found, exact) in found.iter().zip(&exact) {
            assert!(
                (found - exact.to_f64()).abs() <= tolerance,
                "{found} for {exact}"
            );
        }
    }
}

/// Smooth media of the same kind, which are halved until they are dark.
#[test]
fn thick_smooth_media_are_planned_and_right() {
    for scale in [1e3, 1e5, 1e8] {
        let text = format!(
            "[[media]]\nfrom = 0\nto = 1\nkind = \"expression\"\nextinction = \"{scale:e}*(1 + lambda^2)\"\nemission = \"(2 - lambda)/4\"\n"
        );
        let scene = read(&text);
        for tolerance in [1e-2, 1e-6] {
            let plan = plan(&scene, tolerance, &text);
            let found = plan.run::<f64>().unwrap().radiance[0];
            // C(0) + C′(0)/τ(0) and less.
            let exact = 0.5 - 0.25 / scale;
            assert!(
                (found - exact).abs() <= tolerance + 2.0 / scale / scale,
                "{found}:\n{text}"
            );
        }
    }
}
