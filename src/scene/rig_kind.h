/// What the scene layer knows of each kind of rig. Private to src/scene.
#ifndef SCENE_RIG_KIND_H
#define SCENE_RIG_KIND_H

#include "scene/members.h"
#include "scene/reader.h"
#include "scene/reference.h"

struct rig_functions {
    const char *word; ///< in the file
    /// Reads all but the type.
    void (*load)(struct reader *reader, const struct value *object, struct rig *rig);
    /// Looks up what it names among the rigs, all of which are read; NULL: nothing.
    void (*resolve)(struct reader *reader, const struct value *object, struct rig *rig);
    /// Writes all but type, name and unknown keys. `folder` is that of the file that the text is for.
    void (*print)(struct members *members, const struct document *document, const struct rig *rig,
                  const char *folder);
    holds_tracks *has_tracks; ///< which keys of its extra object belong to tracks; NULL: none
    const char *pin_key;      ///< what a point that can be pinned is called; NULL: none can
    /// By channels: these are copied, counted and freed for all such kinds in one place, and the functions below leave them alone.
    bool is_bent;
    /// The splines that drive it; NULL: none.
    int (*input_count)(const struct rig *rig);
    int (*input)(const struct rig *rig, int input);
    /// Visits the splines that the rig at `index` in the list names; NULL: it names none.
    void (*references)(const struct rig *rig, int index, reference_visitor *visit, void *context);
    void (*set_reference)(struct rig *rig, const struct reference *reference, int spline);
    /// Gives a shallow copy memory of its own; NULL, as the next two: it owns none.
    void (*copy)(struct rig *copy);
    void (*release)(struct rig *rig);
    size_t (*bytes)(const struct rig *rig, const struct rig *other); ///< that it owns and another (or NULL) does not
    /// What to call it where it has no name; NULL: it always has one.
    const char *(*title)(const struct rig *rig);
};

#define RIG_FUNCTIONS(constant, name) extern const struct rig_functions name##_functions;
RIG_KIND_LIST(RIG_FUNCTIONS)
#undef RIG_FUNCTIONS

/// Gives a shallow copy texts of its own; NULL stays NULL.
void rig_own_texts(char **const *texts, int count);

#endif
