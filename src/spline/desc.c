/// Converts a caller's description to this version's, with a table of its members.
#include "spline/desc.h"
#include <math.h>
#include <string.h>

/// X(name, kind, filters), in the order of wiggly_desc.
#define SETTINGS(X)                                                                                                  \
    X(samples, COUNT, false)                                                                                         \
    X(step, NUMBER, true)                                                                                            \
    X(mode, CHOICE, true)                                                                                            \
    X(start, CHOICE, false)                                                                                          \
    X(passive, CHOICE, true)                                                                                         \
    X(frequency, PARAM, true)                                                                                        \
    X(damping, PARAM, true)                                                                                          \
    X(bandwidth, PARAM, true)                                                                                        \
    X(equilibrium, PARAM, false)                                                                                     \
    X(calm, NUMBER, false)                                                                                           \
    X(wind_up, NUMBER, false)                                                                                        \
    X(low, NUMBER, false)                                                                                            \
    X(high, NUMBER, false)                                                                                           \
    X(variation, NUMBER, false)                                                                                      \
    X(has_calm, CHOICE, false)                                                                                       \
    X(has_low, CHOICE, false)                                                                                        \
    X(has_high, CHOICE, false)                                                                                       \
    X(variation_seed, COUNT, false)

#define ROW(member, kind, filters)                                                                                   \
    {#member, DESC_##kind, filters, offsetof(wiggly_desc, member), sizeof(((wiggly_desc *)0)->member)},
#define VALUE(member, kind, filters) desc->member,

const desc_member desc_members[] = {SETTINGS(ROW){0}};

/// By position: a member of wiggly_desc missing from the list causes a warning (-Wmissing-field-initializers).
wiggly_desc desc_settings(const wiggly_desc *desc)
{
    return (wiggly_desc){sizeof(wiggly_desc), NULL, 0, SETTINGS(VALUE)};
}

/// A later version must not add a member where today's padding is.
_Static_assert(offsetof(wiggly_desc, variation_seed) + sizeof(int) == sizeof(wiggly_desc), "padding at the end");
_Static_assert(offsetof(wiggly_curve, knot) + sizeof(int) == sizeof(wiggly_curve), "padding at the end");

enum { WIDEST_SIZE = 4096 };

bool size_fits(const void *of, size_t own)
{
    const unsigned char *bytes = of;
    size_t size;
    memcpy(&size, of, sizeof size);
    if (size < own || size > WIDEST_SIZE) return false;
    for (size_t i = own; i < size; i++) {
        if (bytes[i]) return false;
    }
    return true;
}

bool desc_fits(const wiggly_desc *desc) { return size_fits(desc, sizeof *desc); }

bool curve_fits(const wiggly_curve *curve) { return curve->size >= sizeof *curve && curve->size <= WIDEST_SIZE; }

wiggly_status desc_read(const wiggly_desc *from, wiggly_desc *to)
{
    if (!from) return WIGGLY_ERROR_ARGUMENT;
    if (!desc_fits(from)) return WIGGLY_ERROR_SIZE;
    *to = *from;
    if ((to->has_low && !isfinite(to->low)) || (to->has_high && !isfinite(to->high))) return WIGGLY_ERROR_LIMITS;
    if (to->step == 0) to->step = 1.0 / 24;
    if (to->calm == 0 && !to->has_calm) to->calm = 1;
    if (!to->has_low) to->low = -INFINITY;
    if (!to->has_high) to->high = INFINITY;
    return WIGGLY_OK;
}

#define SAME_COUNT(member) (a->member == b->member)
#define SAME_CHOICE(member) (a->member == b->member)
#define SAME_NUMBER(member) (a->member == b->member)
#define SAME_PARAM(member) (a->member.value == b->member.value && a->member.track == b->member.track)
#define AND_SAME_FILTER(member, kind, filters) &&(!(filters) || SAME_##kind(member))

bool desc_same_filter(const wiggly_desc *a, const wiggly_desc *b) { return true SETTINGS(AND_SAME_FILTER); }
