/// Shared by the files that read glTF characters. Private to src/model/gltf_*.c.
#ifndef MODEL_GLTF_READ_H
#define MODEL_GLTF_READ_H

#include "model/glb.h"
#include "model/gltf.h"

/// Where the base colour of a material lies on its texture.
struct gltf_uv {
    int set; ///< TEXCOORD_n
    float offset[2], rotation, scale[2];
};

/// The state of reading a file. Functions set `error` when they fail; what was read so far is freed with `gltf`.
struct gltf_reader {
    struct glb file;
    struct gltf *gltf;
    struct error *error;
    bool stored;          ///< gltf_read_stored()
    char place[96];       ///< in the JSON, for messages
    struct gltf_uv *uvs;  ///< of each material
    int *joints_of;       ///< of each mesh: its joints' numbers are below
    int *image_of;        ///< gltf.images of each image of the file: −1 cannot be shown, −2 not tried yet
    size_t pixel_room;    ///< bytes of pixels that may still be decoded
    size_t not_shown_end; ///< length of gltf.not_shown
};

/// The part of the JSON that is being read.
void gltf_at(struct gltf_reader *r, const char *format, ...) __attribute__((format(printf, 2, 3)));

/// Fails with "file: place" and then the text, which begins with ".member: " or ": ".
bool gltf_bad(struct gltf_reader *r, const char *format, ...) __attribute__((format(printf, 2, 3)));

/// Zeroed memory that is freed with the character, if the file is large enough to justify so much; else NULL and an error.
void *gltf_make(struct gltf_reader *r, size_t count, size_t size);

/// A member that is an index into an array of `limit` things; −1 if it is missing.
bool gltf_index(struct gltf_reader *r, const json_t *object, const char *key, int limit, int *index);

/// A member that is an array of `count` numbers; unchanged if it is missing.
bool gltf_reals(struct gltf_reader *r, const json_t *object, const char *key, float *numbers, size_t count);

/// A copy that stays with the character. And the name of a thing, or "kind n".
char *gltf_text(struct gltf_reader *r, const char *text);
char *gltf_name(struct gltf_reader *r, const json_t *object, const char *kind, size_t n);

/// An array of the file's root; NULL if there is none.
const json_t *gltf_array(const struct gltf_reader *r, const char *key);

/// Adds a name to those not shown, once.
bool gltf_not_shown(struct gltf_reader *r, const char *format, ...) __attribute__((format(printf, 2, 3)));

bool gltf_read_materials(struct gltf_reader *r);

/// Finds out whether a clip loops (gltf_pose.c), how long after its last key, and what travels. False if memory is short.
bool gltf_judge_loop(const struct gltf *gltf, struct gltf_clip *clip);

#endif
