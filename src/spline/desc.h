/// A description as the solver reads it, and its members, listed once for all code that visits each of them. Private to the
/// project.
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

/// All but the knots, to one without a name. One that is missing does not compile without a warning (desc.c).
extern const desc_member desc_members[];

/// A copy in which everything that is 0 by default is what it means: a step, calm, and without limits infinite ones. What is only
/// read by the solver is always such a copy. WIGGLY_ERROR_ARGUMENT, WIGGLY_ERROR_SIZE, WIGGLY_ERROR_LIMITS.
wiggly_status desc_read(const wiggly_desc *from, wiggly_desc *to);

/// Whether a structure that begins with its size has at least the members of version 1.0, and asks for nothing beyond its `own` size.
bool size_fits(const void *of, size_t first, size_t own);
bool desc_fits(const wiggly_desc *desc);
bool curve_fits(const wiggly_curve *curve);

/// Element i of a caller's array.
static inline const wiggly_desc *desc_at(const wiggly_desc *descs, int i)
{
    return (const wiggly_desc *)(const void *)((const char *)descs + (size_t)i * descs->size);
}

/// The size that they have is given, because a thread may be filling the first.
static inline wiggly_curve *curve_at(wiggly_curve *curves, size_t size, int i)
{
    return (wiggly_curve *)(void *)((char *)curves + (size_t)i * size);
}

/// A description without its knots.
wiggly_desc desc_settings(const wiggly_desc *desc);

/// Whether the same filter serves both, where no pole parameter is a track.
bool desc_same_filter(const wiggly_desc *a, const wiggly_desc *b);

/// A member that is a parameter.
static inline const wiggly_param *desc_param(const wiggly_desc *desc, const desc_member *member)
{
    return (const wiggly_param *)(const void *)((const char *)desc + member->offset);
}

#endif
