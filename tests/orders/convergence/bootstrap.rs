//! Quantiles and draws, by hand and by count.

use volver::inside::convergence::{Resampler, quantile};

#[test]
fn quantiles_interpolate_and_stay_inside() {
    let sorted = [1.0, 2.0, 4.0];
    assert_eq!(quantile(&sorted, 0.0), Some(1.0));
    assert_eq!(quantile(&sorted, 0.25), Some(1.5));
    assert_eq!(quantile(&sorted, 0.5), Some(2.0));
    assert_eq!(quantile(&sorted, 1.0), Some(4.0));
    assert_eq!(quantile(&[], 0.5), None);
}

#[test]
fn draws_are_uniform_and_the_same_for_the_same_seed() {
    let mut counts = [0_u32; 8];
    let (mut first, mut second) = (Resampler::new(7), Resampler::new(7));
    let (mut a, mut b) = ([0; 8], [0; 8]);
    for _ in 0..4000 {
        first.draw(&mut a);
        second.draw(&mut b);
        assert_eq!(a, b);
        for index in a {
            counts[index] += 1;
        }
    }
    // 4000 expected each, standard deviation 59.
    assert!(counts.iter().all(|c| c.abs_diff(4000) < 300), "{counts:?}");
    let mut other = [0; 8];
    Resampler::new(8).draw(&mut other);
    Resampler::new(7).draw(&mut a);
    assert_ne!(a, other);
}
