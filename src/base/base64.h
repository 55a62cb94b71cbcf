/// Bytes as text: base64 (RFC 4648, section 4).
#ifndef BASE_BASE64_H
#define BASE_BASE64_H

#include <stdbool.h>
#include <stddef.h>

/// Characters for so many bytes, the final NUL aside.
static inline size_t base64_length(size_t size) { return (size + 2) / 3 * 4; }

/// Bytes that so many characters hold at most.
static inline size_t base64_capacity(size_t length) { return length / 4 * 3 + 3; }

/// Writes base64_length(size) characters and a NUL.
void base64_encode(const void *bytes, size_t size, char *text);

/// Reads a text, with or without padding, into base64_capacity() bytes, of which it sets `*size`. false if it is no base64.
bool base64_decode(const char *text, void *bytes, size_t *size);

#endif
