/* Front to back, samples in the middles of segments: order 2. */
#include <math.h>

#include "volver.h"

VOLVER_EXPORT uint32_t volver_abi_version(void) { return VOLVER_ABI; }

VOLVER_EXPORT void volver_declare(volver_declaration *declaration) {
  declaration->name = "marcher";
  declaration->order = 2;
}

VOLVER_EXPORT int volver_render(const volver_task *task, volver_result *result) {
  double depth = 0;
  for (uint32_t channel = 0; channel < task->channels; channel++) result->radiance[channel] = 0;
  for (uint64_t i = 0; i < task->segments; i++) {
    double step = task->middles.extinction[i] * (task->edges.lambda[i + 1] - task->edges.lambda[i]);
    double weight = exp(-depth) * -expm1(-step);
    for (uint32_t channel = 0; channel < task->channels; channel++)
      result->radiance[channel] += weight * task->middles.emission[channel][i];
    depth += step;
  }
  return 0;
}
