/// The morph targets of a file, made from those of a form: as they are, or each in a positive and a negative one whose weights are
/// 0 … 1, because Blender clamps weights to that. Private to src/export.
#ifndef EXPORT_TARGETS_H
#define EXPORT_TARGETS_H

#include "export/keys.h"

/// A target of the file: `scale` times one of the form.
struct file_target {
    int source;
    float scale;          ///< negative for the negative ones
    char name[FORM_NAME]; ///< "up.re"; "up.-re" for the negative one
};

struct file_targets {
    struct file_target *list; ///< first all of the form's in their order, then the negative ones
    int count;
    bool clamped; ///< weights are 0 … 1
};

void targets_create(const struct export_range *range, const struct form *form, const struct keys *keys,
                    struct file_targets *targets);
void targets_free(struct file_targets *targets);

/// The weight of a target at a key, and how fast it changes by second.
float targets_weight(const struct file_targets *targets, int target, const struct keys *keys, int key);
float targets_slope(const struct file_targets *targets, int target, const struct keys *keys, int key);

#endif
