//! Levels between those asked for.

use volver::study::sweep::between;

#[test]
fn levels_lie_between_and_are_no_powers_of_two() {
    assert_eq!(between(&[8, 16, 32, 64]), [12, 20, 24, 40, 52]);
    assert_eq!(between(&[2048, 4096, 8192]), [2580, 3252]);
    // 4·3^(1/3) and 4·3^(2/3) round to 4 and 8.
    for none in [&[4, 12][..], &[100], &[]] {
        assert_eq!(between(none), [0_u64; 0]);
    }
}
