/* The light of one ray through a volume: put your renderer's loop in place of composite(). */

#ifndef COMPOSITE_H
#define COMPOSITE_H

#include <math.h>
#include <stddef.h>

/* Front to back over one sample a segment, `lambda` being the n + 1 ends of the segments: the radiance of one channel. */
static inline double composite(size_t n, const double *lambda, const double *extinction, const double *emission) {
  double radiance = 0, transmittance = 1;
  for (size_t i = 0; i < n; i++) {
    double passes = exp(-extinction[i] * (lambda[i + 1] - lambda[i]));
    radiance += transmittance * (1 - passes) * emission[i];
    transmittance *= passes;
  }
  return radiance;
}

#endif
