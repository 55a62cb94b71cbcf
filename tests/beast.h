/// Writes a four-legged beast as a .glb: boxes skinned to named bones, a tail, two ears and two clips. For tests of characters and
/// their chains.
#ifndef TESTS_BEAST_H
#define TESTS_BEAST_H

#include "gltf_builder.h"

enum { BEAST_TAIL = 8, BEAST_BONES = 17 + BEAST_TAIL };

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

/// Returns false if the file cannot be written. A soft one has the curved coordinate "belly", whose real part its Walk moves, and the shape "grin".
static inline bool beast_write_as(const char *path, bool soft)
{
    static struct builder b;
    static char members[1 << 13], glb[1 << 16];
    static float inverse[BEAST_BONES][16], position[8 * BEAST_BONES][3], weights[8 * BEAST_BONES][4];
    static uint8_t joints[8 * BEAST_BONES][4];
    static uint16_t index[36 * BEAST_BONES];
    struct beast_bone bones[BEAST_BONES];
    char *end = members, list[128] = "";
    b = (struct builder){0};
    beast_bones(bones);
    end += sprintf(end, "'scene':0,'scenes':[{'nodes':[0,%d]}],'nodes':[", BEAST_BONES);
    for (int n = 0; n < BEAST_BONES; n++) {
        const float *own = bones[n].at;
        int children = 0;
        float at[3];
        beast_place(bones, n, at);
        beast_box(bones, n, position + (ptrdiff_t)8 * n, index + (ptrdiff_t)36 * n);
        for (int k = 0; k < 4; k++) inverse[n][5 * k] = 1;
        for (int k = 0; k < 3; k++) inverse[n][12 + k] = -at[k];
        for (int c = 8 * n; c < 8 * n + 8; c++) joints[c][0] = (uint8_t)n, weights[c][0] = 1;
        end += sprintf(end, "{'name':'%s','translation':[%g,%g,%g]", bones[n].name, (double)own[0], (double)own[1],
                       (double)own[2]);
        for (int c = 0; c < BEAST_BONES; c++) {
            if (bones[c].parent == n) end += sprintf(end, "%s%d", children++ == 0 ? ",'children':[" : ",", c);
        }
        end += sprintf(end, "%s},", children > 0 ? "]" : "");
        sprintf(list + strlen(list), "%s%d", n == 0 ? "" : ",", n);
    }
    add_data(&b, FLOAT, "MAT4", BEAST_BONES, inverse, sizeof inverse);
    add_data(&b, FLOAT, "VEC3", 8 * BEAST_BONES, position, sizeof position);
    add_data(&b, UBYTE, "VEC4", 8 * BEAST_BONES, joints, sizeof joints);
    add_data(&b, FLOAT, "VEC4", 8 * BEAST_BONES, weights, sizeof weights);
    add_data(&b, USHORT, "SCALAR", 36 * BEAST_BONES, index, sizeof index);
    // The hips alternate about y and bob, the head alternates about x; for such small half angles the sine is the angle.
    ADD(&b, FLOAT, float, 1, 0, 0.25f, 0.5f, 0.75f, 1);
    ADD(&b, FLOAT, float, 4, 0, 0, 0, 1, 0, 0.12f, 0, 0.9928f, 0, 0, 0, 1, 0, -0.12f, 0, 0.9928f, 0, 0, 0, 1);
    ADD(&b, FLOAT, float, 4, 0, 0, 0, 1, 0.12f, 0, 0, 0.9928f, 0, 0, 0, 1, -0.12f, 0, 0, 0.9928f, 0, 0, 0, 1);
    ADD(&b, FLOAT, float, 3, 0, 0.55f, -0.3f, 0, 0.57f, -0.3f, 0, 0.55f, -0.3f, 0, 0.57f, -0.3f, 0, 0.55f, -0.3f);
    static const char *const more[] = {
        ",'targets':[{'POSITION':9},{'POSITION':10},{'POSITION':11},{'POSITION':12},{'POSITION':13},{'POSITION':14}]",
        ",'extras':{'targetNames':['belly.re','grin','belly.im','belly.sq','belly.re2','belly.im2'],'wiggly':"
        "{'coordinates':[{'name':'belly','frequency':2,'damping':0.1,'scale':2,'most':0.4}]}}",
        ",{'sampler':2,'target':{'node':25,'path':'weights'}}", ",{'input':5,'output':15}"};
    if (soft) {
        static float target[6][8 * BEAST_BONES][3], keys[5][6];
        for (int c = 0; c < 8 * BEAST_BONES; c++) { // what is low swings most, what is at the back later
            const float *p = position[c], low = 0.7f - p[1], turn = 2 * p[2];
            target[0][c][0] = 0.2f * low * cosf(turn), target[2][c][0] = -0.2f * low * sinf(turn);
            target[0][c][1] = 0.1f * low * sinf(turn), target[2][c][1] = 0.1f * low * cosf(turn);
            target[1][c][2] = c % 2 ? 0.05f : 0;
            target[3][c][1] = 0.03f * low, target[4][c][0] = 0.02f * low, target[5][c][2] = 0.02f * low;
        }
        for (int k = 0; k < 5; k++) keys[k][0] = 0.1f * (float)(k % 2), keys[k][1] = 0.25f * (float)(k % 4);
        for (int t = 0; t < 6; t++) add_data(&b, FLOAT, "VEC3", 8 * BEAST_BONES, target[t], sizeof target[t]);
        add_data(&b, FLOAT, "SCALAR", 30, keys, sizeof keys);
    }
#define MORE(n) (soft ? more[n] : "")
    sprintf(
        end,
        "{'name':'skin','mesh':0,'skin':0}],'skins':[{'inverseBindMatrices':0,'joints':[%s]}],"
        "'materials':[{'doubleSided':true,'pbrMetallicRoughness':{'baseColorFactor':[0.55,0.42,0.3,1]}}],"
        "'meshes':[{'primitives':[{'attributes':{'POSITION':1,'JOINTS_0':2,'WEIGHTS_0':3},'indices':4,"
        "'material':0%s}]%s}],'animations':[{'name':'Walk','channels':[{'sampler':0,'target':{'node':0,"
        "'path':'rotation'}},{'sampler':1,'target':{'node':0,'path':'translation'}}%s],'samplers':["
        "{'input':5,'output':6},{'input':5,'output':8}%s]},{'name':'Nod','channels':[{'sampler':0,'target':{'node':3,"
        "'path':'rotation'}}],'samplers':[{'input':5,'output':7}]}]",
        list, MORE(0), MORE(1), MORE(2), MORE(3));
    snprintf(b.json, sizeof b.json,
             "{'asset':{'version':'2.0'},'buffers':[{'byteLength':%zu}],'bufferViews':[%s],'accessors':[%s],%s}",
             b.size, b.views, b.accessors, members);
    const size_t size = put_glb(glb, b.json, b.bytes, b.size);
    FILE *out = fopen(path, "wb");
    const bool done = out && fwrite(glb, 1, size, out) == size;
    return out && fclose(out) == 0 && done;
}

static inline bool beast_write(const char *path) { return beast_write_as(path, false); }

#endif
