// Rays through a volume of samples, trilinear, four control points, composited from front to back with 1 - exp(-tau d): the loop
// that one writes. Pixel (x, y) has its ray from origin + x across + y down, in steps of `step`, all in places of samples.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace {

struct Point {
  float s, extinction, emission[3];
};

struct Volume {
  const float *samples;
  int width, height, depth;

  float at(float x, float y, float z) const {
    x = std::clamp(x, 0.0f, float(width - 1));
    y = std::clamp(y, 0.0f, float(height - 1));
    z = std::clamp(z, 0.0f, float(depth - 1));
    int i = std::min(int(x), width - 2), j = std::min(int(y), height - 2), k = std::min(int(z), depth - 2);
    float fx = x - i, fy = y - j, fz = z - k;
    size_t row = width, plane = row * height;
    const float *cell = samples + i + row * j + plane * k;
    float a = cell[0] + fx * (cell[1] - cell[0]);
    float b = cell[row] + fx * (cell[row + 1] - cell[row]);
    float c = cell[plane] + fx * (cell[plane + 1] - cell[plane]);
    float d = cell[plane + row] + fx * (cell[plane + row + 1] - cell[plane + row]);
    float near = a + fy * (b - a), far = c + fy * (d - c);
    return near + fz * (far - near);
  }
};

}  // namespace

extern "C" void raycast(const float *samples, const int *dimensions, const Point *points, int count, const float *origin,
                        const float *across, const float *down, const float *step, float length, int steps, int width,
                        int height, float *image) {
  std::vector<float> inverse;
  for (int i = 0; i + 1 < count; i++) inverse.push_back(1 / (points[i + 1].s - points[i].s));
  Volume volume{samples, dimensions[0], dimensions[1], dimensions[2]};
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++) {
      float start[3], radiance[3] = {0, 0, 0}, transmittance = 1;
      for (int a = 0; a < 3; a++) start[a] = origin[a] + x * across[a] + y * down[a];
      for (int k = 0; k < steps; k++) {
        float t = k + 0.5f;
        float s = volume.at(start[0] + t * step[0], start[1] + t * step[1], start[2] + t * step[2]);
        int i = 0;
        while (i < count - 2 && s >= points[i + 1].s) i++;
        const Point &near = points[i], &far = points[i + 1];
        float part = std::clamp((s - near.s) * inverse[i], 0.0f, 1.0f);
        float extinction = near.extinction + part * (far.extinction - near.extinction);
        float opacity = 1 - std::exp(-extinction * length);
        float weight = transmittance * opacity;
        for (int c = 0; c < 3; c++)
          radiance[c] += weight * (near.emission[c] + part * (far.emission[c] - near.emission[c]));
        transmittance *= 1 - opacity;
      }
      std::copy(radiance, radiance + 3, image + 3 * (size_t(y) * width + x));
    }
}
