/// What the form of an imported character knows besides: its joints are the bones that chains bend. Private to src/export.
#ifndef EXPORT_MODEL_H
#define EXPORT_MODEL_H

#include "export/form.h"

/// In form.owned.
struct model_bones {
    const struct gltf *gltf;
    int *node;     ///< of each joint of the form
    bool *is_bone; ///< of each node: some chain bends it
};

#endif
