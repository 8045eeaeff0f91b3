/* What is known of composite() without volver. */

#include "composite.h"

#include <stdio.h>
#include <stdlib.h>

enum { MOST = 128 };

/* The radiance of a ray of length 1 with tau = 2 x and C = x^2 on n segments. */
static double ramp(size_t n) {
  double lambda[MOST + 1], extinction[MOST], emission[MOST];
  for (size_t i = 0; i <= n; i++) {
    lambda[i] = (double)i / (double)n;
  }
  for (size_t i = 0; i < n; i++) {
    double x = ((double)i + 0.5) / (double)n;
    extinction[i] = 2 * x;
    emission[i] = x * x;
  }
  return composite(n, lambda, extinction, emission);
}

static int failures;

static void near(const char *what, double got, double wanted, double tolerance) {
  if (!(fabs(got - wanted) <= tolerance)) {
    printf("%s: %.17g where %.17g is right\n", what, got, wanted);
    failures++;
  }
}

int main(void) {
  double lambda[] = {0, 0.5, 1.25, 2}, extinction[] = {0.75, 0.75, 0.75}, emission[] = {3, 3, 3};
  near("a homogeneous ray", composite(3, lambda, extinction, emission), 3 * (1 - exp(-1.5)), 1e-14);
  /* The depth is x^2, and the emission too: the integral of t e^(-t) up to 1. */
  double exact = 1 - 2 / exp(1);
  double order = log2(fabs(ramp(64) - exact) / fabs(ramp(128) - exact));
  near("the order of accuracy", order, 2, 0.05);
  puts(failures ? "failed" : "passed");
  return failures ? EXIT_FAILURE : EXIT_SUCCESS;
}
