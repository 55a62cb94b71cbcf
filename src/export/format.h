/// The file formats, each a row. Private to src/export.
#ifndef EXPORT_FORMAT_H
#define EXPORT_FORMAT_H

#include "export/form.h"
#include <stdio.h>

enum { FORMAT_SUMMARY = 96 };

struct format {
    const char *ending;
    bool without_rigs; ///< it makes sense without one
    unsigned holds;    ///< of what a kind of rig gives (form.h); 0: any kind
    bool one_rig;      ///< it holds one rig
    /// Writes all of it to a stream, whose errors the caller sees, and says in a few words what it wrote.
    bool (*write)(struct shot *shot, FILE *out, char summary[FORMAT_SUMMARY], struct error *error);
};

bool csv_write(struct shot *shot, FILE *out, char summary[FORMAT_SUMMARY], struct error *error);
bool pc2_write(struct shot *shot, FILE *out, char summary[FORMAT_SUMMARY], struct error *error);
bool mdd_write(struct shot *shot, FILE *out, char summary[FORMAT_SUMMARY], struct error *error);
bool npy_write(struct shot *shot, FILE *out, char summary[FORMAT_SUMMARY], struct error *error);
bool glb_write(struct shot *shot, FILE *out, char summary[FORMAT_SUMMARY], struct error *error);
bool gltf_write(struct shot *shot, FILE *out, char summary[FORMAT_SUMMARY], struct error *error);
/// Writes the file that the shot's only rig came from, with a clip added or, where it has one of that name, replaced. All else stays as it
/// was; in the other container, .glb or .gltf, it says the same. Without a chain there is no new clip.
bool gltf_model_write(struct shot *shot, bool binary, FILE *out, char summary[FORMAT_SUMMARY], struct error *error);

/// Writes a rig that is no imported character as a .glb of its own.
bool gltf_write_rig(struct shot *shot, int rig, FILE *out, struct error *error);

bool bvh_write(struct shot *shot, FILE *out, char summary[FORMAT_SUMMARY], struct error *error);
bool usda_write(struct shot *shot, FILE *out, char summary[FORMAT_SUMMARY], struct error *error);

#endif
