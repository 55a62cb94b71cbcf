/// The sentences for the status codes of the library.
#include <wiggly/wiggly.h>

static const char *const status_text[WIGGLY_STATUS_COUNT] = {
    [WIGGLY_OK] = "solved",
    [WIGGLY_CALMED] = "with calm 0 the swing has no limit; solved with calm 0.05 instead",
    [WIGGLY_LEVELLED] = "the knots do not determine the curve; solved with slope 0 at the earliest knot",
    [WIGGLY_INEXACT] = "solved, but the estimated error exceeds the tolerance",
    [WIGGLY_SINGULAR] = "no curve could be found; straight lines join the knots",
    [WIGGLY_ERROR_ARGUMENT] = "a pointer is missing or a count is out of range",
    [WIGGLY_ERROR_SIZE] =
        "the size of a structure is not set, or it asks for more than this version of libwiggly has",
    [WIGGLY_ERROR_MEMORY] = "out of memory",
    [WIGGLY_ERROR_CAPACITY] = "more samples or knots than the solver has room for",
    [WIGGLY_ERROR_NUMBER] =
        "a number is not finite or out of range: step above 0, calm 0 to 1, variation from 0, a mode that there is",
    [WIGGLY_ERROR_LOOP] = "a loop needs more than one sample",
    [WIGGLY_ERROR_LIMITS] = "a limit is not finite, or the low limit is not below the high one",
    [WIGGLY_ERROR_KNOT_NUMBER] = "a knot's number is not finite or beyond 1e300, or its stiffness below 0",
    [WIGGLY_ERROR_KNOT_OUTSIDE] = "a knot is outside the samples (a loop's last one is its first)",
    [WIGGLY_ERROR_KNOT_TWICE] = "two knots share a sample",
    [WIGGLY_ERROR_KNOT_STILL] = "a still knot has a slope or a phase, or settles",
    [WIGGLY_ERROR_KNOT_LIMIT] = "a knot is beyond a limit",
    [WIGGLY_ERROR_PIN] =
        "a pin is outside the domain, or on a spline that has no motion of its own: cubic, calm 0 or frequency 0",
};

const char *wiggly_status_text(wiggly_status status)
{
    const char *text = (int)status >= 0 && status < WIGGLY_STATUS_COUNT ? status_text[status] : NULL;
    return text ? text : "unknown status";
}
