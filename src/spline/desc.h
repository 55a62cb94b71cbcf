/// The members of a description, listed once: who looks at all of them goes by this list. Private to the project.
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
