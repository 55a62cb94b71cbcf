/// A glTF file in its other container. Private to src/export.
#ifndef EXPORT_GLTF_GATHER_H
#define EXPORT_GLTF_GATHER_H

#include "model/glb.h"

/// Changes the JSON so that all bytes are in one buffer of no address, pictures too, wherever they were: in a chunk, in files, in data
/// URIs. Nothing else changes. `bytes` are the caller's. False with a sentence.
bool gltf_gather(struct glb *file, struct glb_buffer *bytes, struct error *error);

#endif
