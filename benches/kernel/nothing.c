/* A kernel that computes nothing and reads no number: what is left is the way there and back. */

#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(void) {
  FILE *in = fdopen(3, "r"), *out = fdopen(4, "w");
  if (!in || !out) {
    return 2;
  }
  char *line = NULL;
  size_t room = 0;
  while (getline(&line, &room, in) > 0) {
    const char *id = strstr(line, "\"id\":");
    if (id) {
      fprintf(out, "{\"type\":\"radiance\",\"id\":%ld,\"results\":[{\"radiance\":[0]}]}\n", strtol(id + 5, NULL, 10));
    } else {
      fputs("{\"type\":\"hello\",\"protocol\":1,\"name\":\"nothing\",\"form\":\"segments\"}\n", out);
    }
    fflush(out);
  }
  free(line);
  return 0;
}
