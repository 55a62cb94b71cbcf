/// Parses JSON. The library's memory is need()'s: what builds JSON does not look for NULL.
#ifndef BASE_JSON_H
#define BASE_JSON_H

#include <jansson.h>

/// As json_loadb(), for a text of somebody else's: where there is not the memory for it, NULL, and json_error_code() says so.
json_t *json_read(const char *text, size_t size, size_t flags, json_error_t *error);

#endif
