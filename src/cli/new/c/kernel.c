/* A kernel for volver: composite.h, asked over pipes.
 *
 *     make test      its own test, without volver
 *     make verify    its order, and what it computes
 *
 * If composite() is another rule, say so in HELLO: "order":1 in place of "method" claims no more than an order.
 * docs/protocol.md of volver lists what a kernel may declare. C99 and POSIX, no libraries. */

#define _POSIX_C_SOURCE 200809L

#include "composite.h"
#include "json_lines.h"

#define HELLO                                                                                                        \
  "{\"type\":\"hello\",\"protocol\":1,\"name\":\"my kernel\",\"form\":\"segments\",\"format\":\"f64\","                 \
  "\"method\":\"front-to-back/middle/subtraction\"}\n"

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
  fputs("{\"radiance\":[", out);
  const char *channel = json_first(json_member(middles, "emission"));
  for (int first = 1; channel; channel = json_next(channel), first = 0) {
    double radiance = NAN;
    if (json_read(channel, &emission) && emission.count == extinction.count) {
      radiance = composite(extinction.count, lambda.values, extinction.values, emission.values);
    }
    if (!first) {
      fputc(',', out);
    }
    json_write(out, radiance);
  }
  fputs("]}", out);
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
      fputs(HELLO, out);
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
