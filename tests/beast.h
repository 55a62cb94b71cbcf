/// Writes a four-legged beast as a .glb: boxes skinned to named bones, a tail, two ears and two clips. For tests of imported characters and
/// their chains.
#ifndef TESTS_BEAST_H
#define TESTS_BEAST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { BEAST_TAIL = 8, BEAST_BONES = 17 + BEAST_TAIL, BEAST_KEYS = 5, BEAST_CLIPS = 2 };

struct beast_bone {
    char name[16];
    int parent;
    float at[3], end[3]; ///< at rest: from its parent, and from itself
    float half;          ///< half the width of its box
};

/// In the order of glTF's nodes; node BEAST_BONES shows the mesh.
static inline void beast_bones(struct beast_bone bones[BEAST_BONES])
{
    static const struct beast_bone body[17] = {
        {"hips", -1, {0, 0.55f, -0.3f}, {0, 0, 0.3f}, 0.11f},
        {"spine", 0, {0, 0, 0.3f}, {0, 0.02f, 0.3f}, 0.12f},
        {"neck", 1, {0, 0.02f, 0.3f}, {0, 0.17f, 0.12f}, 0.06f},
        {"head", 2, {0, 0.17f, 0.12f}, {0, 0, 0.22f}, 0.08f},
        {"ear_L_1", 3, {0.06f, 0.08f, 0}, {0.02f, 0.09f, 0}, 0.022f},
        {"ear_L_2", 4, {0.02f, 0.09f, 0}, {0.01f, 0.08f, 0}, 0.014f},
        {"ear_R_1", 3, {-0.06f, 0.08f, 0}, {-0.02f, 0.09f, 0}, 0.022f},
        {"ear_R_2", 6, {-0.02f, 0.09f, 0}, {-0.01f, 0.08f, 0}, 0.014f},
        {"leg_FL_1", 1, {0.09f, -0.05f, 0.24f}, {0, -0.26f, 0}, 0.04f},
        {"leg_FL_2", 8, {0, -0.26f, 0}, {0, -0.24f, 0.02f}, 0.03f},
        {"leg_FR_1", 1, {-0.09f, -0.05f, 0.24f}, {0, -0.26f, 0}, 0.04f},
        {"leg_FR_2", 10, {0, -0.26f, 0}, {0, -0.24f, 0.02f}, 0.03f},
        {"leg_BL_1", 0, {0.09f, -0.05f, 0}, {0, -0.26f, 0}, 0.04f},
        {"leg_BL_2", 12, {0, -0.26f, 0}, {0, -0.24f, 0.02f}, 0.03f},
        {"leg_BR_1", 0, {-0.09f, -0.05f, 0}, {0, -0.26f, 0}, 0.04f},
        {"leg_BR_2", 14, {0, -0.26f, 0}, {0, -0.24f, 0.02f}, 0.03f},
        {"jaw", 3, {0, -0.05f, 0.06f}, {0, -0.02f, 0.13f}, 0.03f},
    };
    memcpy(bones, body, sizeof body);
    for (int n = 0; n < BEAST_TAIL; n++) {
        struct beast_bone *bone = &bones[17 + n];
        *bone = (struct beast_bone){.parent = n == 0 ? 0 : 16 + n, .half = 0.035f - 0.003f * (float)n};
        snprintf(bone->name, sizeof bone->name, "tail_%u", (unsigned)(n + 1) % 100);
        memcpy(bone->at, (float[3]){0, n == 0 ? 0.08f : 0.03f, n == 0 ? -0.04f : -0.08f}, sizeof bone->at);
        memcpy(bone->end, (float[3]){0, 0.03f, -0.08f}, sizeof bone->end);
    }
}

static inline void beast_place(const struct beast_bone *bones, int bone, float at[3])
{
    memset(at, 0, 3 * sizeof *at);
    for (; bone >= 0; bone = bones[bone].parent) {
        for (int k = 0; k < 3; k++) at[k] += bones[bone].at[k];
    }
}

/// Eight corners of a box from a bone's head to its end, and its twelve triangles.
static inline void beast_box(const struct beast_bone *bones, int bone, float corner[8][3], uint16_t index[36])
{
    static const uint16_t faces[36] = {0, 1, 2, 2, 1, 3, 4, 6, 5, 5, 6, 7, 0, 4, 1, 1, 4, 5,
                                       2, 3, 6, 6, 3, 7, 0, 2, 4, 4, 2, 6, 1, 5, 3, 3, 5, 7};
    const float *end = bones[bone].end, half = bones[bone].half;
    const float upright = end[1] * end[1] > end[2] * end[2];
    float at[3];
    beast_place(bones, bone, at);
    for (int c = 0; c < 8; c++) {
        const float across = c & 1 ? half : -half, over = c & 2 ? half : -half;
        for (int k = 0; k < 3; k++) corner[c][k] = at[k] + (c & 4 ? end[k] : 0);
        corner[c][0] += across;
        corner[c][1] += upright > 0 ? 0 : over;
        corner[c][2] += upright > 0 ? over : 0;
    }
    for (int i = 0; i < 36; i++) index[i] = (uint16_t)(faces[i] + 8 * bone);
}

/// The binary part, in the order of the buffer views.
struct beast_binary {
    float inverse_bind[BEAST_BONES][16];
    float position[8 * BEAST_BONES][3];
    uint8_t joints[8 * BEAST_BONES][4];
    float weights[8 * BEAST_BONES][4];
    uint16_t index[36 * BEAST_BONES];
    float times[BEAST_KEYS];
    float hips[BEAST_KEYS][4], head[BEAST_KEYS][4]; ///< rotations, alternating about y and x
    float bob[BEAST_KEYS][3];                       ///< translations of the hips
};

static inline void beast_fill(const struct beast_bone *bones, struct beast_binary *b)
{
    static const float swing[BEAST_KEYS] = {0, 0.12f, 0, -0.12f, 0}, lift[BEAST_KEYS] = {0, 0.02f, 0, 0.02f, 0};
    memset(b, 0, sizeof *b);
    for (int n = 0; n < BEAST_BONES; n++) {
        float at[3];
        beast_place(bones, n, at);
        beast_box(bones, n, b->position + (ptrdiff_t)8 * n, b->index + (ptrdiff_t)36 * n);
        for (int k = 0; k < 4; k++) b->inverse_bind[n][5 * k] = 1;
        for (int k = 0; k < 3; k++) b->inverse_bind[n][12 + k] = -at[k];
        for (int c = 0; c < 8; c++) b->joints[8 * n + c][0] = (uint8_t)n;
        for (int c = 0; c < 8; c++) b->weights[8 * n + c][0] = 1;
    }
    for (int k = 0; k < BEAST_KEYS; k++) { // for such small half angles the sine is the angle, up to normalisation
        const float w = 1 - swing[k] * swing[k] / 2;
        b->times[k] = 0.25f * (float)k;
        memcpy(b->hips[k], (float[4]){0, swing[k], 0, w}, sizeof b->hips[k]);
        memcpy(b->head[k], (float[4]){swing[k], 0, 0, w}, sizeof b->head[k]);
        memcpy(b->bob[k], (float[3]){0, bones[0].at[1] + lift[k], bones[0].at[2]}, sizeof b->bob[k]);
    }
}

static inline void beast_nodes(FILE *out, const struct beast_bone *bones)
{
    fprintf(out, "\"nodes\":[");
    for (int n = 0; n < BEAST_BONES; n++) {
        const float *at = bones[n].at;
        int children = 0;
        fprintf(out, "{\"name\":\"%s\",\"translation\":[%g,%g,%g]", bones[n].name, (double)at[0], (double)at[1],
                (double)at[2]);
        for (int c = 0; c < BEAST_BONES; c++) {
            if (bones[c].parent == n) fprintf(out, "%s%d", children++ == 0 ? ",\"children\":[" : ",", c);
        }
        fprintf(out, "%s},", children > 0 ? "]" : "");
    }
    fprintf(out, "{\"name\":\"skin\",\"mesh\":0,\"skin\":0}],\"skins\":[{\"inverseBindMatrices\":0,\"joints\":[");
    for (int n = 0; n < BEAST_BONES; n++) fprintf(out, "%s%d", n == 0 ? "" : ",", n);
    fprintf(out, "]}],");
}

/// A buffer view and an accessor for each member of the binary part.
static inline void beast_accessors(FILE *out)
{
#define BEAST_PART(member) offsetof(struct beast_binary, member), sizeof((struct beast_binary *)0)->member
    static const struct {
        size_t from, bytes;
        int component, count;
        const char *type, *more;
    } parts[] = {
        {BEAST_PART(inverse_bind), 5126, BEAST_BONES, "MAT4", ""},
        {BEAST_PART(position), 5126, 8 * BEAST_BONES, "VEC3", ",\"min\":[-1,0,-2],\"max\":[1,2,2]"},
        {BEAST_PART(joints), 5121, 8 * BEAST_BONES, "VEC4", ""},
        {BEAST_PART(weights), 5126, 8 * BEAST_BONES, "VEC4", ""},
        {BEAST_PART(index), 5123, 36 * BEAST_BONES, "SCALAR", ""},
        {BEAST_PART(times), 5126, BEAST_KEYS, "SCALAR", ",\"min\":[0],\"max\":[1]"},
        {BEAST_PART(hips), 5126, BEAST_KEYS, "VEC4", ""},
        {BEAST_PART(head), 5126, BEAST_KEYS, "VEC4", ""},
        {BEAST_PART(bob), 5126, BEAST_KEYS, "VEC3", ""},
    };
#undef BEAST_PART
    const size_t count = sizeof parts / sizeof parts[0];
    fprintf(out, "\"bufferViews\":[");
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}", i == 0 ? "" : ",", parts[i].from,
                parts[i].bytes);
    fprintf(out, "],\"accessors\":[");
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%s{\"bufferView\":%zu,\"componentType\":%d,\"count\":%d,\"type\":\"%s\"%s}", i == 0 ? "" : ",",
                i, parts[i].component, parts[i].count, parts[i].type, parts[i].more);
    fprintf(out, "],");
}

static inline void beast_json(FILE *out, const struct beast_bone *bones)
{
    fprintf(out, "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,%d]}],", BEAST_BONES);
    beast_nodes(out, bones);
    beast_accessors(out);
    fprintf(out,
            "\"materials\":[{\"doubleSided\":true,\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.55,0.42,0.3,1]}}],"
            "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":1,\"JOINTS_0\":2,\"WEIGHTS_0\":3},"
            "\"indices\":4,\"material\":0}]}],"
            "\"animations\":[{\"name\":\"Walk\",\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":"
            "\"rotation\"}},{\"sampler\":1,\"target\":{\"node\":0,\"path\":\"translation\"}}],\"samplers\":["
            "{\"input\":5,\"output\":6},{\"input\":5,\"output\":8}]},"
            "{\"name\":\"Nod\",\"channels\":[{\"sampler\":0,\"target\":{\"node\":3,\"path\":\"rotation\"}}],"
            "\"samplers\":[{\"input\":5,\"output\":7}]}],"
            "\"buffers\":[{\"byteLength\":%zu}]}",
            sizeof(struct beast_binary));
}

static inline void beast_word(FILE *out, size_t word)
{
    for (int i = 0; i < 4; i++) fputc((int)(word >> (8 * i) & 0xFF), out);
}

/// Returns false if the file cannot be written.
static inline bool beast_write(const char *path)
{
    static struct beast_binary binary;
    static char json[1 << 15];
    struct beast_bone bones[BEAST_BONES];
    beast_bones(bones);
    beast_fill(bones, &binary);
    memset(json, ' ', sizeof json);
    FILE *text = fmemopen(json, sizeof json, "w"), *out = fopen(path, "wb");
    if (!text || !out) return false;
    beast_json(text, bones);
    const size_t used = (size_t)ftell(text), length = (used + 3) / 4 * 4;
    fclose(text);
    memset(json + used, ' ', length - used);
    fwrite("glTF", 1, 4, out);
    beast_word(out, 2);
    beast_word(out, 12 + 8 + length + 8 + sizeof binary);
    beast_word(out, length);
    fwrite("JSON", 1, 4, out);
    fwrite(json, 1, length, out);
    beast_word(out, sizeof binary);
    fwrite("BIN", 1, 4, out);
    fwrite(&binary, 1, sizeof binary, out);
    return fclose(out) == 0;
}

#endif
