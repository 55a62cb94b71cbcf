#include <wiggly/wiggly.h>

static const char *const status_text[WIGGLY_STATUS_COUNT] = {
    [WIGGLY_OK] = "solved",
    [WIGGLY_CALMED] = "the knots leave the start free to swing without limit; solved with calm 0.05 in place of 0",
    [WIGGLY_LEVELLED] = "the knots leave the curve undetermined; solved with a level slope at the earliest knot",
    [WIGGLY_INEXACT] = "solved, but the estimated error is above the tolerance: the span between knots is too long",
    [WIGGLY_SINGULAR] = "singular whatever was tried; the knots are joined by straight lines",
    [WIGGLY_ERROR_ARGUMENT] = "a pointer is missing or a count is out of range",
    [WIGGLY_ERROR_CAPACITY] = "more samples or knots than the solver was created for",
    [WIGGLY_ERROR_NUMBER] =
        "a number is not finite or a value beyond 1e300, a stiffness is not above 0, or calm is outside 0 to 1",
    [WIGGLY_ERROR_KNOT] = "two knots lie on one sample, or a knot lies outside the domain",
    [WIGGLY_ERROR_LOOP] = "a loop needs more than one sample",
    [WIGGLY_ERROR_SPRING] = "spring and friction belong to real mode, not to complex mode",
    [WIGGLY_ERROR_MEMORY] = "out of memory",
};

const char *wiggly_status_text(wiggly_status status)
{
    if ((int)status < 0 || status >= WIGGLY_STATUS_COUNT) return "unknown status";
    return status_text[status];
}
