/// Imported characters as glTF. Private to src/export.
#ifndef EXPORT_GLTF_MODEL_H
#define EXPORT_GLTF_MODEL_H

#include "export/format.h"

/// Writes the file that the shot's only rig came from, with a clip added or, where it has one of that name, replaced. All else stays byte
/// for byte; in the other container, .glb or .gltf, it says the same. Without a chain there is no new clip.
bool gltf_model_write(struct shot *shot, bool binary, FILE *out, char summary[FORMAT_SUMMARY], struct error *error);

#endif
