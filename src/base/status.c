/// The sentences for the status codes of the library.
#include <wiggly/wiggly.h>

static const char *const status_text[WIGGLY_STATUS_COUNT] = {
    [WIGGLY_OK] = "solved",
    [WIGGLY_CALMED] = "the start could swing without limit; solved with calm 0.05 instead of 0",
    [WIGGLY_LEVELLED] = "the knots do not determine the curve; solved with slope 0 at the earliest knot",
    [WIGGLY_INEXACT] = "solved, but the estimated error exceeds the tolerance",
    [WIGGLY_SINGULAR] = "singular in every way tried; straight lines join the knots",
    [WIGGLY_ERROR_ARGUMENT] = "a pointer is missing or a count is out of range",
    [WIGGLY_ERROR_CAPACITY] = "more samples or knots than the solver has room for",
    [WIGGLY_ERROR_NUMBER] =
        "a number is not finite, a value beyond 1e300, a stiffness not above 0, or calm outside 0 to 1",
    [WIGGLY_ERROR_KNOT] = "two knots share a sample, or a knot is outside the domain",
    [WIGGLY_ERROR_LOOP] = "a loop needs more than one sample",
    [WIGGLY_ERROR_MEMORY] = "out of memory",
    [WIGGLY_ERROR_PIN] =
        "a pin is outside the domain, or on a spline that has no motion of its own: cubic, calm 0 or frequency 0",
    [WIGGLY_ERROR_LIMIT] = "a knot is beyond a limit, or the low limit is not below the high one",
};

const char *wiggly_status_text(wiggly_status status)
{
    if ((int)status < 0 || status >= WIGGLY_STATUS_COUNT) return "unknown status";
    return status_text[status];
}
