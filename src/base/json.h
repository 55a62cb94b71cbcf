/// Parses JSON. The library allocates with need(), so that code that builds JSON need not check for NULL.
#ifndef BASE_JSON_H
#define BASE_JSON_H

#include <jansson.h>

/// Like json_loadb(), for other people's text: NULL if there is not enough memory for it, and json_error_code() says so.
json_t *json_read(const char *text, size_t size, size_t flags, json_error_t *error);

#endif
