/// The table of the members of a description.
#include "spline/desc.h"

/// X(name, kind, filters), in the order of wiggly_desc.
#define SETTINGS(X)                                                                                                  \
    X(samples, COUNT, false)                                                                                         \
    X(step, NUMBER, true)                                                                                            \
    X(mode, CHOICE, true)                                                                                            \
    X(start, CHOICE, false)                                                                                          \
    X(frequency, PARAM, true)                                                                                        \
    X(damping, PARAM, true)                                                                                          \
    X(bandwidth, PARAM, true)                                                                                        \
    X(equilibrium, PARAM, false)                                                                                     \
    X(calm, NUMBER, false)                                                                                           \
    X(passive, CHOICE, true)                                                                                         \
    X(low, NUMBER, false)                                                                                            \
    X(high, NUMBER, false)                                                                                           \
    X(variation, NUMBER, false)                                                                                      \
    X(variation_seed, COUNT, false)

#define ROW(member, kind, filters)                                                                                   \
    {#member, DESC_##kind, filters, offsetof(wiggly_desc, member), sizeof(((wiggly_desc *)0)->member)},
#define VALUE(member, kind, filters) desc->member,

const desc_member desc_members[] = {SETTINGS(ROW){0}};

/// By position: a member of wiggly_desc that the list lacks is a warning here (-Wmissing-field-initializers).
wiggly_desc desc_settings(const wiggly_desc *desc) { return (wiggly_desc){SETTINGS(VALUE) NULL, 0}; }

#define SAME_COUNT(member) (a->member == b->member)
#define SAME_CHOICE(member) (a->member == b->member)
#define SAME_NUMBER(member) (a->member == b->member)
#define SAME_PARAM(member) (a->member.value == b->member.value && a->member.track == b->member.track)
#define AND_SAME_FILTER(member, kind, filters) &&(!(filters) || SAME_##kind(member))

bool desc_same_filter(const wiggly_desc *a, const wiggly_desc *b) { return true SETTINGS(AND_SAME_FILTER); }
