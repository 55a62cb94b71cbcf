/// Textures of imported characters by what a person sees: outside of its picture, a texture goes on as the file says, like a larger picture
/// that is made so; and its pixels have edges or none.
#include "base/png.h"
#include "gltf_builder.h"
#include "model/vector.h"
#include "offscreen.h"

enum { WIDTH = 240, HEIGHT = 240 };

typedef unsigned char picture[HEIGHT][WIDTH][4];

static picture one, other;

/// Draws a character of a node or more that lies from −1 to 1, on the ground.
static void draw_built(struct builder *b, const char *members, picture drawn)
{
    static struct stage_view view;
    const float lo[3] = {-1, 0, -1}, hi[3] = {1, 2, 1};
    struct gltf gltf;
    struct gltf_pose pose;
    read_text(builder_json(b, members), &gltf);
    assert_true(gltf_pose_create(&gltf, &pose));
    gltf_pose_world(&gltf, &pose);
    struct camera camera = camera_default();
    memset(&view, 0, sizeof view);
    view.viewport = (struct rect){0, 0, WIDTH, HEIGHT};
    view.colors = theme()->stage;
    camera_fit(&camera, lo, hi, 1, 0);
    camera_matrices(&camera, 1, view.view, view.projection, view.eye);
    camera_lamp(&camera, view.key_from);
    view.models[0] = (struct stage_model){.gltf = &gltf, .pose = &pose, .lo = {-1, 0, 0}, .hi = {1, 2, 0}};
    for (int k = 0; k < 4; k++) view.models[0].root[5 * k] = 1;
    view.model_count = 1;
    offscreen_draw(&view, WIDTH, HEIGHT, drawn);
    gltf_pose_free(&pose);
    gltf_free(&gltf);
}

/// A square that shows u and v from `from` to `to` of a picture, which a sampler reads.
static void draw(const char *sampler, float from, float to, const unsigned char *pixels, int side, picture drawn)
{
    const float position[4][3] = {{-1, 0, 0}, {1, 0, 0}, {-1, 2, 0}, {1, 2, 0}};
    const float uv[4][2] = {{from, to}, {to, to}, {from, from}, {to, from}};
    const uint16_t indices[6] = {0, 1, 2, 2, 1, 3};
    static const char path[] = "square.png";
    char members[1024];
    struct builder b = {0};
    assert_done(png_write(temporary_path(path), side, side, pixels, &error));
    add_data(&b, FLOAT, "VEC3", 4, position, sizeof position);
    add_data(&b, FLOAT, "VEC2", 4, uv, sizeof uv);
    add_data(&b, USHORT, "SCALAR", 6, indices, sizeof indices);
    snprintf(members, sizeof members,
             "'images':[{'uri':'%s'}],'samplers':[{}, "
             "%s],'textures':[{'source':0,'sampler':1}],'materials':[{'doubleSided':true,'pbrMetallicRoughness':{"
             "'baseColorTexture':{'index':0}}}],'meshes':[{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_0':1},"
             "'indices':2,'material':0}]}],'nodes':[{'mesh':0}],'scenes':[{'nodes':[0]}]",
             path, sampler);
    draw_built(&b, members, drawn);
}

static int differing(const picture a, const picture b)
{
    int count = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        count += memcmp(a[i / WIDTH][i % WIDTH], b[i / WIDTH][i % WIDTH], 4) != 0;
    return count;
}

#define NEAREST "'minFilter': 9728, 'magFilter': 9728"

static const unsigned char red_blue[2][2][4] = {{{230, 40, 30, 255}, {30, 60, 220, 255}},
                                                {{240, 220, 60, 255}, {60, 200, 90, 255}}};

/// A picture of four by four, of which texel (x, y) is one of red_blue's.
static void spread(const int column[4], const int row[4], unsigned char out[4][4][4])
{
    for (int i = 0; i < 16; i++) memcpy(out[i / 4][i % 4], red_blue[row[i / 4]][column[i % 4]], 4);
}

/// A tent of four vertices without normals, or with six and the normals of its sides.
static void draw_tent(bool has_normals, picture drawn)
{
    const float corner[4][3] = {{-1, 0, 0}, {0, 2, 0.5f}, {0, 0, 1}, {1, 0, 0}};
    const uint16_t indices[6] = {0, 2, 1, 2, 3, 1};
    struct builder b = {0};
    if (has_normals) {
        float position[6][3], normal[6][3];
        for (int i = 0; i < 6; i++) {
            const uint16_t *side = indices + i / 3 * 3;
            const vec3s across = triangle_normal(corner[side[0]], corner[side[1]], corner[side[2]]);
            memcpy(position[i], corner[indices[i]], sizeof position[i]);
            memcpy(normal[i], glms_vec3_normalize(across).raw, sizeof normal[i]);
        }
        add_data(&b, FLOAT, "VEC3", 6, position, sizeof position);
        add_data(&b, FLOAT, "VEC3", 6, normal, sizeof normal);
    } else {
        add_data(&b, FLOAT, "VEC3", 4, corner, sizeof corner);
        add_data(&b, USHORT, "SCALAR", 6, indices, sizeof indices);
    }
    draw_built(&b,
               has_normals ? "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1}}]}],'nodes':[{'mesh':"
                             "0}],'scenes':[{'nodes':[0]}]"
                           : "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'indices':1}]}],'nodes':[{'mesh':"
                             "0}],'scenes':[{'nodes':[0]}]",
               drawn);
}

TEST(a_mesh_without_normals_is_flat)
{
    if (!platform) skip();
    draw_tent(true, one);
    draw_tent(false, other);
    int far = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        for (int k = 0; k < 3; k++) far += abs(one[i / WIDTH][i % WIDTH][k] - other[i / WIDTH][i % WIDTH][k]) > 2;
    }
    assert_int_equal(far, 0);
    assert_true(memcmp(one[HEIGHT / 2][WIDTH * 2 / 5], one[HEIGHT / 2][WIDTH * 3 / 5], 3) != 0); // lit from one side
}

TEST(textures_go_on_as_the_file_says)
{
    static const struct {
        const char *across, *down; ///< of the sampler
        int column[4], row[4];     ///< from one before the picture to one behind it, half a picture each
    } cases[] = {
        {"10497", "10497", {1, 0, 1, 0}, {1, 0, 1, 0}}, {"33071", "33071", {0, 0, 1, 1}, {0, 0, 1, 1}},
        {"33648", "33071", {0, 0, 1, 1}, {0, 0, 1, 1}}, {"33071", "10497", {0, 0, 1, 1}, {1, 0, 1, 0}},
        {"10497", "33648", {1, 0, 1, 0}, {0, 0, 1, 1}},
    };
    if (!platform) skip();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char sampler[128];
        unsigned char made[4][4][4];
        snprintf(sampler, sizeof sampler, "{'wrapS': %s, 'wrapT': %s, " NEAREST "}", cases[i].across, cases[i].down);
        spread(cases[i].column, cases[i].row, made);
        draw(sampler, -0.5f, 1.5f, red_blue[0][0], 2, one);
        draw("{" NEAREST "}", 0, 1, made[0][0], 4, other);
        assert_true(differing(one, other) < 40); // rounding, on the edges of texels
        draw("{" NEAREST "}", -0.5f, 1.5f, red_blue[0][0], 2, other);
        assert_int_equal(differing(one, other) > 1000, i > 0);
    }
    // Further out mirroring and clamping are not the same.
    draw("{'wrapS': 33648, " NEAREST "}", 0, 3, red_blue[0][0], 2, one);
    draw("{'wrapS': 33071, " NEAREST "}", 0, 3, red_blue[0][0], 2, other);
    assert_true(differing(one, other) > 1000);
}

/// How many colours the square has, of those that differ from their left neighbour.
static int changes(const picture drawn)
{
    int count = 0;
    for (int i = 1; i < WIDTH; i++) count += memcmp(drawn[HEIGHT / 2][i], drawn[HEIGHT / 2][i - 1], 4) != 0;
    return count;
}

TEST(a_near_texture_has_edges_or_none)
{
    if (!platform) skip();
    draw("{'magFilter': 9728}", 0, 1, red_blue[0][0], 2, one);
    draw("{'magFilter': 9729}", 0, 1, red_blue[0][0], 2, other);
    assert_true(differing(one, other) > 1000);
    assert_true(changes(one) < changes(other));
    draw("{'magFilter': 7, 'wrapS': 'none'}", 0, 1, red_blue[0][0], 2, one); // what glTF does not know
    assert_int_equal(differing(one, other), 0);
}

OFFSCREEN(WIDTH, HEIGHT)
