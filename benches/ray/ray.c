/* One ray through C = sin s^2, tau = s cos s^2 on [0, 1], s = lambda, by four methods written by hand. */
#include <math.h>
#include <stddef.h>

static void medium(double s, double *emission, double *extinction) {
  double q = s * s;
  *emission = sin(q);
  *extinction = s * cos(q);
}

/* Trapezoid rules for depth and radiance. */
double trapezoid(size_t n) {
  double d = 1.0 / n, depth = 0, emission, extinction, before;
  medium(0, &emission, &extinction);
  before = extinction;
  double sum = 0.5 * emission * extinction;
  for (size_t i = 1; i <= n; i++) {
    medium((double)i / n, &emission, &extinction);
    depth += 0.5 * (before + extinction) * d;
    before = extinction;
    double f = emission * extinction * exp(-depth);
    sum += i < n ? f : 0.5 * f;
  }
  return sum * d;
}

/* Compositing of samples in the middle of segments, alpha = 1 - exp(-tau d). */
double front_to_back(size_t n) {
  double d = 1.0 / n, radiance = 0, transmittance = 1, emission, extinction;
  for (size_t i = 0; i < n; i++) {
    medium((2.0 * i + 1.0) / (2.0 * n), &emission, &extinction);
    double alpha = -expm1(-extinction * d);
    radiance += transmittance * alpha * emission;
    transmittance *= 1 - alpha;
  }
  return radiance;
}

double back_to_front(size_t n) {
  double d = 1.0 / n, radiance = 0, emission, extinction;
  for (size_t i = n; i-- > 0;) {
    medium((2.0 * i + 1.0) / (2.0 * n), &emission, &extinction);
    double alpha = -expm1(-extinction * d);
    radiance = alpha * emission + (1 - alpha) * radiance;
  }
  return radiance;
}

/* Gauss's rule of three points inside segments for the depth, Boole's over four segments at a time for the radiance. */
double gauss_boole(size_t n) {
  static const double nodes[3] = {0.1127016653792583, 0.5, 0.8872983346207417};
  static const double weights[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  double d = 1.0 / n, depth = 0, emission, extinction;
  medium(0, &emission, &extinction);
  double sum = 7 * emission * extinction;
  for (size_t i = 1; i <= n; i++) {
    double part = 0;
    for (int k = 0; k < 3; k++) {
      medium((i - 1 + nodes[k]) / n, &emission, &extinction);
      part += weights[k] * extinction;
    }
    depth += part * d;
    medium((double)i / n, &emission, &extinction);
    double weight = i == n ? 7 : i % 4 == 0 ? 14 : i % 2 == 0 ? 12 : 32;
    sum += weight * emission * extinction * exp(-depth);
  }
  return sum * d * 2 / 45;
}
