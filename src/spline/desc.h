/// A description as the solver reads it, and a list of its members for all code that visits each. Private to the project.
#ifndef SPLINE_DESC_H
#define SPLINE_DESC_H

#include <wiggly/more.h>

/// What a member is.
typedef enum desc_kind {
    DESC_COUNT,  ///< int
    DESC_CHOICE, ///< an enum or a bool
    DESC_NUMBER, ///< double
    DESC_PARAM,  ///< wiggly_param
} desc_kind;

typedef struct desc_member {
    const char *name;
    desc_kind kind;
    bool filters; ///< the filter of constant parameters depends on it
    size_t offset, size;
} desc_member;

/// Copies all members except the knots and those without a name. A missing member causes a warning (desc.c).
extern const desc_member desc_members[];

/// A copy with the defaults in place of 0: a step, calm, and infinite limits if there are none. The solver reads only such copies.
/// WIGGLY_ERROR_ARGUMENT, WIGGLY_ERROR_SIZE, WIGGLY_ERROR_LIMITS.
wiggly_status desc_read(const wiggly_desc *from, wiggly_desc *to);

/// Whether a structure that begins with its size has all members, and no value beyond its `own` size. A version that adds members must still
/// take those of version 1.0, which end here.
bool size_fits(const void *of, size_t own);
bool desc_fits(const wiggly_desc *desc);
bool curve_fits(const wiggly_curve *curve);

/// Element i of a caller's array.
static inline const wiggly_desc *desc_at(const wiggly_desc *descs, int i)
{
    return (const wiggly_desc *)(const void *)((const char *)descs + (size_t)i * descs->size);
}

/// Their size is a parameter, because a thread may be filling the first.
static inline wiggly_curve *curve_at(wiggly_curve *curves, size_t size, int i)
{
    return (wiggly_curve *)(void *)((char *)curves + (size_t)i * size);
}

/// A description without its knots.
wiggly_desc desc_settings(const wiggly_desc *desc);

/// Whether both have the same filter, if no pole parameter has a track.
bool desc_same_filter(const wiggly_desc *a, const wiggly_desc *b);

#endif
