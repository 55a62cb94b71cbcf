/// Two ears by one spline move as mirror images, wherever they point and whichever way the character looks.
#include "gltf_builder.h"
#include "rig/import.h"

enum { BONES = 3 };

struct pair {
    struct opened opened;
    bool looks_along_x; ///< the left is −z then, else x
    int rig[2];
};

/// Of the left ear; the right one points as its mirror image does, but for `crooked` of the way up.
struct ear {
    float way[3], crooked;
};

static void set_way(const struct pair *pair, const struct ear *ear, int side, float scale, float out[3])
{
    const float x = (side ? -scale : scale) * ear->way[0], z = scale * ear->way[2];
    out[0] = pair->looks_along_x ? z : x;
    out[1] = scale * (ear->way[1] + (side ? ear->crooked : 0.0f));
    out[2] = pair->looks_along_x ? -x : z;
}

/// Three bones to each ear. Their frames are alike, x up, y along z, not mirrored.
static int print_ear(const struct pair *pair, const struct ear *ear, int side, char *out)
{
    const struct ear root = {{0.07f, 1, 0}, 0};
    float at[3], turned[3];
    char *end = out;
    set_way(pair, &root, side, 1, at);
    for (int n = 0; n < BONES; n++) {
        end += sprintf(end, ",{'name':'Ear%d.%c','translation':[%.9g,%.9g,%.9g]", n + 1, "LR"[side], (double)at[0],
                       (double)at[1], (double)at[2]);
        if (n == 0) end += sprintf(end, ",'rotation':[0.5,0.5,0.5,0.5]");
        end += sprintf(end, n + 1 < BONES ? ",'children':[%d]}" : "}", 2 + BONES * side + n + 1);
        set_way(pair, ear, side, 0.1f, turned);
        for (int k = 0; k < 3; k++) at[k] = turned[(k + 1) % 3];
    }
    return (int)(end - out);
}

static void open_pair(struct pair *pair, const struct ear *ear, bool follows)
{
    static char text[8192];
    struct builder b = {0};
    ADD(&b, FLOAT, float, 3, 0, 0, 0, 0.1f, 0, 0, 0, 1, 0);
    char *end = text + sprintf(text,
                               "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],'scenes':[{'nodes':[0,1]}],"
                               "'nodes':[{'mesh':0},{'name':'head','children':[2,%d]}",
                               2 + BONES);
    for (int side = 0; side < 2; side++) end += print_ear(pair, ear, side, end);
    sprintf(end, "]");
    assert_done(opened_read(&pair->opened, write_built(&b, "ears.gltf", text), &error));
    for (int side = 0; side < 2; side++) {
        const struct chain_wish wish = {.from = side ? "Ear1.R" : "Ear1.L", .follows = follows};
        assert_done(chain_make(pair->opened.document, pair->opened.models, &wish, &pair->rig[side], &error));
    }
}

/// How far the tip of an ear is from where it rests, by that much of each of its splines.
static void tip_moves(const struct pair *pair, int side, double side_bend, double up, double moved[3])
{
    const struct posing posing = {.document = pair->opened.document, .models = pair->opened.models};
    const struct by_hand hand = {.input = {{.re = side_bend}, {.re = up}}};
    struct rig_pose rest, bent;
    assert_true(rig_pose(&posing, pair->rig[side], 0, NULL, &rest));
    assert_true(rig_pose(&posing, pair->rig[side], 0, &hand, &bent));
    for (int k = 0; k < 3; k++)
        moved[k] = (double)(bent.strand.matrix[BONES][12 + k] - rest.strand.matrix[BONES][12 + k]);
}

static void check_mirrored(const struct pair *pair, double side, double up, double tolerance)
{
    double left[3], right[3];
    tip_moves(pair, 0, side, up, left);
    tip_moves(pair, 1, side, up, right);
    const int across = pair->looks_along_x ? 2 : 0;
    assert_true(fabs(left[0]) + fabs(left[1]) + fabs(left[2]) > 0.02);
    for (int k = 0; k < 3; k++) assert_near(right[k], k == across ? -left[k] : left[k], tolerance);
}

TEST(test_ears_that_share_a_spline_mirror)
{
    static const struct ear ears[] = {
        {{0.1f, 1, 0}, 0},        // they stand
        {{0.5f, 0.7f, -0.4f}, 0}, // out, up and back
        {{1, 0, 0}, 0},           // out
        {{0.3f, -1, 0.1f}, 0},    // they droop
        {{0.1f, 0, -1}, 0},       // back
        {{0.2031f, 1, 0},
         0.002f}, // nearly the same: one of them stands less than what counts as upright, the other more
    };
    for (size_t e = 0; e < sizeof ears / sizeof *ears; e++) {
        for (int way = 0; way < 4; way++) {
            struct pair pair = {.looks_along_x = way & 1};
            open_pair(&pair, &ears[e], way & 2);
            const double unit = way & 2 ? 0.05 : 1, tolerance = ears[e].crooked > 0 ? 1e-3 : 1e-6; // metres, or 1
            check_mirrored(&pair, unit, 0, tolerance);
            check_mirrored(&pair, 0, unit, tolerance);
            check_mirrored(&pair, unit, -unit, tolerance);
            opened_free(&pair.opened);
        }
    }
}
