/// Writes an imported character's own file again, with the motion of its chains in it. Private to src/export.
#ifndef EXPORT_GLTF_SPLICE_H
#define EXPORT_GLTF_SPLICE_H

#include "export/format.h"

/// As .glb or .gltf. Everything that is not animation stays as it is, byte for byte; without chains, so does the file. The clip takes the
/// place of one of that name, or is added.
bool gltf_splice_write(struct take *take, int rig, bool binary, FILE *out, char summary[FORMAT_SUMMARY],
                       struct error *error);

#endif
