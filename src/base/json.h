/// Parses and prints JSON, and knows when memory is short.
#ifndef BASE_JSON_H
#define BASE_JSON_H

#include <jansson.h>

/// As json_loadb(); but where memory ran short, which that takes for a mistake in the text, json_error_code() says so.
json_t *json_read(const char *text, size_t size, size_t flags, json_error_t *error);

/// As json_dumps(), but NULL wherever memory ran short: that forgets a key where there is none for it. The caller frees the text.
char *json_print(const json_t *json, size_t flags);

/// From now on the JSON library has its memory from `allocate` (NULL: malloc): so that a test can let it run short.
void json_read_with(void *(*allocate)(size_t size));

#endif
