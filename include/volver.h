/* volver.h: the interface between volver and a kernel in a shared library. C99 and later, C++11 and later.
 *
 * A kernel is somebody's implementation of the volume rendering integral
 *
 *     I = integral from 0 to D of C(lambda) tau(lambda) exp(-integral from 0 to lambda of tau) d lambda
 *
 * for one ray. volver gives it media whose radiance is known, and finds out how accurate it is. A library
 * defines the three functions at the end of this file, and volver verifies it:
 *
 *     cc -O2 -shared -fPIC -Iinclude mine.c -o mine.so -lm && volver verify ./mine.so
 *
 *     #include <math.h>
 *     #include "volver.h"
 *
 *     uint32_t volver_abi_version(void) { return VOLVER_ABI; }
 *
 *     void volver_declare(volver_declaration *declaration) { declaration->order = 1; }
 *
 *     int volver_render(const volver_task *task, volver_result *result) {
 *       double radiance = 0, transmittance = 1;
 *       for (uint64_t i = 0; i < task->segments; i++) {
 *         double d = task->edges.lambda[i + 1] - task->edges.lambda[i];
 *         double alpha = 1 - exp(-task->edges.extinction[i] * d);
 *         radiance += transmittance * alpha * task->edges.emission[0][i];
 *         transmittance *= 1 - alpha;
 *       }
 *       result->radiance[0] = radiance;
 *       return 0;
 *     }
 *
 * The library shares volver's process: if it crashes, loops for ever or writes where it must not, so does
 * volver, and everything measured is lost. It must let no C++ exception and no longjmp out of its functions.
 * Code that is not known to behave is safer in a process of its own, which volver restarts: docs/protocol.md.
 *
 * How the interface grows: structs get new members at their end alone, and say their size in their first.
 * A member of a later version than the first may be used where VOLVER_HAS says that it is there. VOLVER_ABI
 * changes where that does not suffice, and a library of another VOLVER_ABI is not loaded.
 */

#ifndef VOLVER_H
#define VOLVER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Version of the interface. */
#define VOLVER_ABI 1

/* Whether the struct that POINTER points to, of type TYPE, was made with MEMBER. */
#define VOLVER_HAS(pointer, type, member) \
  ((pointer)->size >= offsetof(type, member) + sizeof((pointer)->member))

/* What a kernel may answer of a ray, for volver_declaration.answers. */
#define VOLVER_RADIANCE 1u
#define VOLVER_OPACITY 2u
#define VOLVER_OPTICAL_DEPTH 4u
#define VOLVER_EXPECTED_DEPTH 8u

/* Makes a function visible outside of the library. */
#if defined(_WIN32)
#define VOLVER_EXPORT __declspec(dllexport)
#elif defined(__GNUC__)
#define VOLVER_EXPORT __attribute__((visibility("default")))
#else
#define VOLVER_EXPORT
#endif

/* What a kernel says of itself. volver fills it with what holds where the kernel says nothing, as noted.
 * Strings are UTF-8 and end in a null character. volver copies them when volver_declare has returned. */
typedef struct volver_declaration {
  /* The struct's size in bytes. */
  size_t size;
  /* For reports. Null: the library's file name. */
  const char *name;
  /* What volver_render is given: "segments" (values at the ends and in the middle of every segment), "function"
   * (the medium alone, to call wherever the kernel likes), "volume" (a grid and lookup tables) or "formula"
   * (source code). Null: "segments". The medium can be called in every case. */
  const char *form;
  /* The method of volver that the kernel means to be: its order is then expected on every case as theory has
   * it, and the values themselves are compared. "front-to-back/middle/subtraction" for instance. Null: none. */
  const char *method;
  /* What it computes in: "f32", "f64", "f16", "bf16" and others. Null: "f64". */
  const char *format;
  /* Where it samples segments, if the method does not say: "front" (nearer to the eye), "middle", "back", "ends"
   * or "jittered". Null: not said. */
  const char *sampling;
  /* The order of accuracy that it claims on smooth cases. NaN: none. */
  double order;
  /* What radiances are multiples of, where that is coarser than the format: 1/255.0 of an 8-bit image. 0: they
   * are not. */
  double quantum;
  /* Not 0: Monte Carlo; the answer depends on the seed, and scatters. 0. */
  int32_t stochastic;
  /* Not 0: the last segment is taken to be opaque, as with a length of 1e10. 0. */
  int32_t far_wall;
  /* Not 0: it works where the step divides the ray, and is asked nothing else. 0. A later member than the first. */
  int32_t step_divides;
  /* It works on numbers of segments that are multiples of this, and is asked nothing else. 0: on any. A later
   * member than the first. */
  uint64_t multiple_of;
  /* What it answers of every ray: VOLVER_RADIANCE | VOLVER_OPACITY for instance. 0: the radiance, and an opacity where it
   * writes one. A later member than the first. */
  uint32_t answers;
  /* Not 0: its expected depth is divided by the opacity. 0. A later member than the first. */
  int32_t by_opacity;
  /* Not 0: it takes the background of its tasks. 0. A later member than the first. */
  int32_t background;
  /* Of the code of the form "formula": "c", "python" or "rust". Null: none, as with every other form. A later
   * member than the first. */
  const char *language;
  /* The format that its answers are rounded to at the end, as "f16", where it computes in another one. Null: none. A
   * later member than the first, like all that follow. */
  const char *output;
  /* Not 0: the quantum is a part of the largest |C| of the ray. 0. */
  int32_t quantum_is_relative;
  /* exp(x) is off by at most exp_ulp[0] + exp_ulp[1] |x| units in the last place, where that is more than rounding; the
   * same of expm1(x), and of pow(b, d) with x = d log2 b. 0, 0: rounded right, or nearly so. */
  double exp_ulp[2], expm1_ulp[2], pow_ulp[2];
  /* Not 0: numbers below the smallest normal one of the format may be 0 to it. 0. */
  int32_t subnormals_lost;
  /* Its answers may be off by so much by chance, in the units of the answer: sums in no fixed order. 0. */
  double noise;
  /* So many channels every task is to have; channels of other cases are asked in pieces. 0: any number. */
  uint32_t channels;
  /* Not 0: it takes no emission below 0, and is asked none. 0. */
  int32_t positive_emission;
  /* Not 0, with the form "segments": the emission that it is given is the source term C tau, per unit of length. It is
   * then asked rays that emit and do not absorb, too. 0. */
  int32_t source_per_length;
} volver_declaration;

/* The medium along the ray, as a function. */
typedef struct volver_medium {
  /* Returns tau(lambda) per unit of length, and writes C(lambda) of every channel to `emission`, unless that is
   * null. To be called during volver_render alone, with `context` as given here; from several threads if need
   * be. */
  double (*at)(void *context, double lambda, double *emission);
  void *context;
} volver_medium;

/* Values at a row of places. All null where the kernel did not ask for "segments". */
typedef struct volver_samples {
  /* lambda of every place. */
  const double *lambda;
  /* tau of every place. */
  const double *extinction;
  /* emission[channel][place] is C. */
  const double *const *emission;
} volver_samples;

/* A ray through a grid, and transfer functions as tables. All 0 where the kernel did not ask for "volume". */
typedef struct volver_volume {
  /* How many places the grid has, from 0 to D at the same distance of each other: two or more. */
  uint64_t points;
  /* The field s at these places; it is linear between them. */
  const double *field;
  /* How many entries the tables have, at evenly spaced s; they are linear between them. */
  uint64_t entries;
  /* s of the first entry and of the last; the same where the field is constant. */
  double first, last;
  /* tau by entry. */
  const double *extinction;
  /* emission[channel][entry] is C. */
  const double *const *emission;
} volver_volume;

/* One ray to render. It and all that it points to are valid until volver_render returns. */
typedef struct volver_task {
  /* The struct's size in bytes. */
  size_t size;
  /* Name of the case, for messages. */
  const char *case_name;
  /* D. */
  double length;
  /* The step d asked for. */
  double step;
  /* n, how many segments that makes: D/d rounded up. The last one is shorter where d does not divide D. */
  uint64_t segments;
  /* For kernels that draw random numbers: the same seed, the same answer. */
  uint64_t seed;
  /* How many radiances are wanted, at least 1. */
  uint32_t channels;
  volver_medium medium;
  /* The n + 1 ends of the segments, from 0 to D. */
  volver_samples edges;
  /* The n middles. */
  volver_samples middles;
  /* What comes from behind the end of the ray, a radiance of every channel; null unless the kernel takes one. A later member
   * than the first. */
  const double *background;
  /* A later member than the first. */
  volver_volume volume;
  /* Source code that defines LENGTH (D), field(lambda) (s), extinction(s) (tau) and for every channel
   * emission_CHANNEL(s) (C), in the language declared; null where the kernel did not ask for "formula". A later
   * member than the first. */
  const char *code;
} volver_task;

/* The answer. volver fills it with what holds where the kernel writes nothing, as noted. */
typedef struct volver_result {
  /* The struct's size in bytes. */
  size_t size;
  /* The radiance of every channel. NaN, which is also what a kernel may answer: a wrong answer. */
  double *const radiance;
  /* Of every channel: what a stochastic kernel estimates of itself. NaN: nothing. */
  double *const standard_error;
  /* 1 - exp(-integral of tau). NaN: not told. */
  double opacity;
  /* The step really used. 0: the one asked for. */
  double step;
  /* The number of segments really used. 0: those asked for. */
  uint64_t segments;
  /* Why nothing came of the task, where volver_render does not return 0; UTF-8. Empty. */
  char message[256];
  /* The integral of tau over the whole ray. NaN. A later member than the first. */
  double optical_depth;
  /* The sum of w lambda with the weights w of the samples, divided by the opacity where that was declared. NaN. A later
   * member than the first. */
  double expected_depth;
} volver_result;

/* The three functions of a kernel. volver calls one function of one library at a time, on any thread. */

/* VOLVER_ABI, as this file had it when the library was compiled. */
VOLVER_EXPORT uint32_t volver_abi_version(void);

/* Says what the kernel is. Called once, first. */
VOLVER_EXPORT void volver_declare(volver_declaration *declaration);

/* Renders one ray. Returns 0, or anything else where it cannot, and why in the result's message. */
VOLVER_EXPORT int volver_render(const volver_task *task, volver_result *result);

#ifdef __cplusplus
}
#endif

#endif
