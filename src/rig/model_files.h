/// The models that were read, kept by path and read again only when the file has changed. Private to src/rig.
#ifndef RIG_MODEL_FILES_H
#define RIG_MODEL_FILES_H

#include "model/figure.h"
#include "rig/imported.h"

enum model_kind { MODEL_FIGURE, MODEL_IMPORTED };

/// All zero is none.
struct model_files {
    struct model_file **files;
    int count;
};

void model_files_free(struct model_files *files);

/// The figure or imported character in a file; NULL with a sentence. What an earlier call for that path gave is stale if the file has
/// changed.
const struct figure *model_files_figure(struct model_files *files, const char *path, struct error *error);
const struct imported *model_files_imported(struct model_files *files, const char *path, struct error *error);

#endif
