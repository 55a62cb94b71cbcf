/// Parses JSON. The library allocates with need(), so that code that builds JSON need not check for NULL. And bytes in JSON.
#ifndef BASE_JSON_H
#define BASE_JSON_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

/// Like json_loadb(), for other people's text: NULL if there is not enough memory for it, and json_error_code() says so.
json_t *json_read(const char *text, size_t size, size_t flags, json_error_t *error);

// Bytes in JSON: base64 (RFC 4648, section 4).

/// Characters for so many bytes, the final NUL aside.
static inline size_t base64_length(size_t size) { return (size + 2) / 3 * 4; }

/// Bytes that so many characters hold at most.
static inline size_t base64_capacity(size_t length) { return length / 4 * 3 + 3; }

/// Writes base64_length(size) characters and a NUL.
void base64_encode(const void *bytes, size_t size, char *text);

/// Reads a text, with or without padding, into base64_capacity() bytes, of which it sets `*size`. false if it is no base64.
bool base64_decode(const char *text, void *bytes, size_t *size);

#endif
