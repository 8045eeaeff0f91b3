/* Front-to-back compositing of one sample in the middle of every segment, alpha = 1 - exp(-tau d).
 *
 * As a shared library:
 *
 *     cc -O2 -shared -fPIC -Iinclude examples/kernels/front_to_back.c -o front_to_back.so -lm && volver verify ./front_to_back.so
 *
 * As a process:
 *
 *     cc -O2 -DVOLVER_PROCESS examples/kernels/front_to_back.c -o front_to_back -lm && volver verify -- ./front_to_back
 *
 * In binary64, or in binary32 by -DREAL=float. C99 and POSIX, no libraries.
 */

#ifndef REAL
#define REAL double
#endif

#ifdef VOLVER_PROCESS
#define _POSIX_C_SOURCE 200809L
#endif

#include <stddef.h>
#include <tgmath.h>

#define METHOD "front-to-back/middle/subtraction"
#define FORMAT (sizeof(REAL) == sizeof(float) ? "f32" : "f64")

/* The radiance on n segments of length `step`, the last of length `last`. */
static double composite(size_t n, double step, double last, const double *extinction, const double *emission,
                        double *opacity) {
  REAL radiance = 0, transmittance = 1;
  for (size_t i = 0; i < n; i++) {
    REAL depth = (REAL)extinction[i] * (REAL)(i + 1 < n ? step : last);
    REAL alpha = 1 - exp(-depth);
    radiance += (REAL)emission[i] * alpha * transmittance;
    transmittance *= 1 - alpha;
  }
  *opacity = 1 - transmittance;
  return radiance;
}

#ifndef VOLVER_PROCESS

#include "volver.h"

uint32_t volver_abi_version(void) {
  return VOLVER_ABI;
}

void volver_declare(volver_declaration *declaration) {
  declaration->name = "front-to-back";
  declaration->method = METHOD;
  declaration->format = FORMAT;
}

int volver_render(const volver_task *task, volver_result *result) {
  size_t n = (size_t)task->segments;
  double last = task->length - task->edges.lambda[n - 1];
  for (uint32_t channel = 0; channel < task->channels; channel++) {
    result->radiance[channel] = composite(n, task->step, last, task->middles.extinction,
                                          task->middles.emission[channel], &result->opacity);
  }
  return 0;
}

#else

#include "json_lines.h"

/* Writes the result of one task. */
static void answer(const char *task, FILE *out) {
  static json_numbers lambda, extinction, emission;
  const char *data = json_member(task, "data");
  const char *middles = json_member(data, "middles");
  if (!json_read(json_member(json_member(data, "edges"), "lambda"), &lambda) ||
      !json_read(json_member(middles, "extinction"), &extinction) || extinction.count + 1 != lambda.count) {
    fputs("{\"error\":\"no segments\"}", out);
    return;
  }
  size_t n = extinction.count;
  double step = json_number(json_member(task, "step"));
  double last = lambda.values[n] - lambda.values[n - 1];
  double opacity = NAN;
  fputs("{\"radiance\":[", out);
  const char *channel = json_first(json_member(middles, "emission"));
  for (int first = 1; channel; channel = json_next(channel), first = 0) {
    double radiance = NAN;
    if (json_read(channel, &emission) && emission.count == n) {
      radiance = composite(n, step, last, extinction.values, emission.values, &opacity);
    }
    if (!first) {
      fputc(',', out);
    }
    json_write(out, radiance);
  }
  fputs("],\"opacity\":", out);
  json_write(out, opacity);
  fputc('}', out);
}

int main(void) {
  /* Requests come on descriptor 3, answers go to 4: what is printed is nobody's answer. */
  FILE *in = fdopen(3, "r"), *out = fdopen(4, "w");
  if (!in || !out) {
    fputs("no requests on descriptor 3 (allowed: to be started by volver)\n", stderr);
    return 2;
  }
  char *line = NULL;
  size_t room = 0;
  while (getline(&line, &room, in) > 0) {
    const char *message = json_space(line);
    if (json_is(json_member(message, "type"), "hello")) {
      fprintf(out,
              "{\"type\":\"hello\",\"protocol\":1,\"name\":\"front-to-back\",\"form\":\"segments\","
              "\"method\":\"" METHOD "\",\"format\":\"%s\"}\n",
              FORMAT);
    } else {
      fprintf(out, "{\"type\":\"radiance\",\"id\":%.0f,\"results\":[", json_number(json_member(message, "id")));
      const char *task = json_first(json_member(message, "tasks"));
      for (int first = 1; task; task = json_next(task), first = 0) {
        if (!first) {
          fputc(',', out);
        }
        answer(task, out);
      }
      fputs("]}\n", out);
    }
    fflush(out);
  }
  free(line);
  return 0;
}

#endif
