/* Rays through C = sin s^2, tau = (s + o) cos s^2 + 1, o another for each ray, by the trapezoid rules; and given samples. */
#include <math.h>
#include <stddef.h>

/* One ray after the other. */
void rays64(const double *offsets, double *radiances, size_t rays, size_t n) {
  double d = 1.0 / n;
  for (size_t r = 0; r < rays; r++) {
    double depth = 0, before = 0, sum = 0;
    for (size_t i = 0; i <= n; i++) {
      double s = (double)i / n, q = s * s;
      double emission = sin(q), extinction = (s + offsets[r]) * cos(q) + 1;
      if (i > 0) depth += (0.5 * before + 0.5 * extinction) * d;
      before = extinction;
      double f = emission * extinction * exp(-depth);
      sum += i > 0 && i < n ? f : 0.5 * f;
    }
    radiances[r] = sum * d;
  }
}

void rays32(const float *offsets, float *radiances, size_t rays, size_t n) {
  float d = 1.0f / n;
  for (size_t r = 0; r < rays; r++) {
    float depth = 0, before = 0, sum = 0;
    for (size_t i = 0; i <= n; i++) {
      float s = (float)i / n, q = s * s;
      float emission = sinf(q), extinction = (s + offsets[r]) * cosf(q) + 1;
      if (i > 0) depth += (0.5f * before + 0.5f * extinction) * d;
      before = extinction;
      float f = emission * extinction * expf(-depth);
      sum += i > 0 && i < n ? f : 0.5f * f;
    }
    radiances[r] = sum * d;
  }
}

/* One ray through C = sin s^2, tau = s cos s^2. */
double ray64(size_t n) {
  double d = 1.0 / n, depth = 0, before = 0, sum = 0;
  for (size_t i = 0; i <= n; i++) {
    double s = (double)i / n, q = s * s;
    double emission = sin(q), extinction = s * cos(q);
    if (i > 0) depth += (0.5 * before + 0.5 * extinction) * d;
    before = extinction;
    double f = emission * extinction * exp(-depth);
    sum += i > 0 && i < n ? f : 0.5 * f;
  }
  return sum * d;
}

/* Samples (C, alpha) of eight rays side by side, n of them each. */
void given64(const double *colors, const double *opacities, double *radiances, size_t n) {
  double radiance[8] = {0}, transmittance[8] = {1, 1, 1, 1, 1, 1, 1, 1};
  for (size_t j = 0; j < n; j++)
    for (int k = 0; k < 8; k++) {
      double opacity = opacities[8 * j + k];
      radiance[k] += colors[8 * j + k] * opacity * transmittance[k];
      transmittance[k] *= 1 - opacity;
    }
  for (int k = 0; k < 8; k++) radiances[k] = radiance[k];
}

/* The same samples read and added up: what memory allows. */
double reading64(const double *colors, const double *opacities, size_t n) {
  double sums[8] = {0};
  for (size_t j = 0; j < n; j++)
    for (int k = 0; k < 8; k++) sums[k] += colors[8 * j + k] + opacities[8 * j + k];
  double sum = 0;
  for (int k = 0; k < 8; k++) sum += sums[k];
  return sum;
}
