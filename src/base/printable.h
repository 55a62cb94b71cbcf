/// Text from outside, fit for terminals and windows.
#ifndef BASE_PRINTABLE_H
#define BASE_PRINTABLE_H

#include <stddef.h>

/// Copies a text, with control characters and bytes that are no UTF-8 as \n or \x1b; what does not fit is cut at a whole character and
/// ends in "…".
void printable(const char *text, char *shown, size_t size);

#endif
