/* One ray through C = sin s^2, tau = s cos s^2 on [0, 1], s = lambda, by trapezoid rules in MPFR: all numbers in place. */
#include <mpfr.h>

void mpfr_trapezoid(mpfr_t radiance, unsigned long n, long bits) {
  mpfr_t s, q, emission, extinction, before, depth, step, half, part, transmittance;
  mpfr_inits2(bits, s, q, emission, extinction, before, depth, step, half, part, transmittance, (mpfr_ptr)0);
  mpfr_set_ui(step, 1, MPFR_RNDN);
  mpfr_div_ui(step, step, n, MPFR_RNDN);
  mpfr_set_d(half, 0.5, MPFR_RNDN);
  mpfr_set_ui(depth, 0, MPFR_RNDN);
  mpfr_set_ui(radiance, 0, MPFR_RNDN);
  for (unsigned long i = 0; i <= n; i++) {
    mpfr_set_ui(s, i, MPFR_RNDN);
    mpfr_div_ui(s, s, n, MPFR_RNDN);
    mpfr_sqr(q, s, MPFR_RNDN);
    mpfr_sin_cos(emission, extinction, q, MPFR_RNDN);
    mpfr_mul(extinction, extinction, s, MPFR_RNDN);
    if (i > 0) {
      mpfr_mul(before, before, half, MPFR_RNDN);
      mpfr_mul(part, extinction, half, MPFR_RNDN);
      mpfr_add(part, part, before, MPFR_RNDN);
      mpfr_mul(part, part, step, MPFR_RNDN);
      mpfr_add(depth, depth, part, MPFR_RNDN);
    }
    mpfr_neg(part, depth, MPFR_RNDN);
    mpfr_exp(transmittance, part, MPFR_RNDN);
    mpfr_mul(emission, emission, extinction, MPFR_RNDN);
    mpfr_mul(emission, emission, transmittance, MPFR_RNDN);
    if (i == 0 || i == n)
      mpfr_mul(emission, emission, half, MPFR_RNDN);
    mpfr_add(radiance, radiance, emission, MPFR_RNDN);
    mpfr_swap(before, extinction);
  }
  mpfr_mul(radiance, radiance, step, MPFR_RNDN);
  mpfr_clears(s, q, emission, extinction, before, depth, step, half, part, transmittance, (mpfr_ptr)0);
}
