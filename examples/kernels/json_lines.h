/* json_lines.h: what a kernel in C needs of JSON, without a library. C99.
 *
 * A value is a pointer to its first character in a line that ends in a null character; nothing is copied, and
 * only numbers that are asked for are read. Lines come from volver and are taken to be well formed; no key that
 * matters has escapes. */

#ifndef JSON_LINES_H
#define JSON_LINES_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static inline const char *json_space(const char *at) {
  return at + strspn(at, " \t\r\n");
}

/* What follows a value. */
static inline const char *json_behind(const char *value) {
  int depth = 0;
  for (const char *at = value; *at; at++) {
    switch (*at) {
    case '"':
      for (at++; *at && *at != '"'; at++) {
        if (*at == '\\' && at[1]) {
          at++;
        }
      }
      if (!*at) {
        return at;
      }
      break;
    case '[':
    case '{':
      depth++;
      continue;
    case ']':
    case '}':
      if (depth == 0) {
        return at;
      }
      depth--;
      break;
    case ',':
      if (depth == 0) {
        return at;
      }
      continue;
    default:
      continue;
    }
    if (depth == 0) {
      return at + 1;
    }
  }
  return value + strlen(value);
}

/* The first item of an array, or null. */
static inline const char *json_first(const char *array) {
  if (!array || *array != '[') {
    return NULL;
  }
  const char *item = json_space(array + 1);
  return *item == ']' ? NULL : item;
}

/* The item after an item, or null. */
static inline const char *json_next(const char *item) {
  const char *comma = json_space(json_behind(item));
  return *comma == ',' ? json_space(comma + 1) : NULL;
}

/* The value of a member of an object, or null. */
static inline const char *json_member(const char *object, const char *key) {
  if (!object || *object != '{') {
    return NULL;
  }
  size_t length = strlen(key);
  for (const char *at = json_space(object + 1); *at == '"';) {
    const char *colon = json_space(json_behind(at));
    if (*colon != ':') {
      return NULL;
    }
    const char *value = json_space(colon + 1);
    if (strncmp(at + 1, key, length) == 0 && at[1 + length] == '"') {
      return value;
    }
    const char *comma = json_space(json_behind(value));
    if (*comma != ',') {
      return NULL;
    }
    at = json_space(comma + 1);
  }
  return NULL;
}

/* Whether a value is that string. */
static inline int json_is(const char *value, const char *text) {
  size_t length = strlen(text);
  return value && *value == '"' && strncmp(value + 1, text, length) == 0 && value[1 + length] == '"';
}

/* A number; NaN where there is none. Infinities, NaN and hexadecimal numbers are strings. */
static inline double json_number(const char *value) {
  return value ? strtod(value + (*value == '"'), NULL) : NAN;
}

/* Numbers, in memory that grows. */
typedef struct json_numbers {
  double *values;
  size_t count, room;
} json_numbers;

/* Reads an array of numbers. Returns 0 where there is none, or no memory. */
static inline int json_read(const char *array, json_numbers *numbers) {
  numbers->count = 0;
  for (const char *item = json_first(array); item;) {
    if (numbers->count == numbers->room) {
      size_t room = numbers->room ? 2 * numbers->room : 256;
      double *values = (double *)realloc(numbers->values, room * sizeof *values);
      if (!values) {
        return 0;
      }
      numbers->values = values;
      numbers->room = room;
    }
    char *behind;
    numbers->values[numbers->count++] = strtod(item + (*item == '"'), &behind);
    const char *comma = json_space(behind + (*behind == '"'));
    item = *comma == ',' ? json_space(comma + 1) : NULL;
  }
  return numbers->count > 0;
}

/* Writes a number so that it reads back as it is. */
static inline void json_write(FILE *out, double value) {
  if (isnan(value)) {
    fputs("\"nan\"", out);
  } else if (isinf(value)) {
    fputs(value > 0 ? "\"inf\"" : "\"-inf\"", out);
  } else {
    fprintf(out, "%.17g", value);
  }
}

#endif
