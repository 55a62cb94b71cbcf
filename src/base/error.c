/// Builds the sentence of an error.
#include "base/error.h"
#include "base/printable.h"
#include <stdio.h>

bool fail(struct error *error, enum error_kind kind, const char *format, ...)
{
    if (!error) return false;
    char text[4 * sizeof error->text]; // arguments may lie in error->text itself
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    printable(text, error->text, sizeof error->text);
    error->kind = kind;
    return false;
}

bool fail_no_memory(struct error *error, const char *what)
{
    return fail(error, ERROR_ENVIRONMENT, "%s: not enough memory", what);
}
