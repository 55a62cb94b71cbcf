/// Textures of imported characters by what a person sees: outside of its picture, a texture goes on as the file says, like a larger picture
/// that is made so; and its pixels have edges or none.
#include "base/png.h"
#include "gltf_builder.h"
#include "offscreen.h"

enum { WIDTH = 240, HEIGHT = 240 };

typedef unsigned char picture[HEIGHT][WIDTH][4];

static picture one, other;

/// A square that shows u and v from `from` to `to` of a picture, which a sampler reads.
static void draw(const char *sampler, float from, float to, const unsigned char *pixels, int side, picture drawn)
{
    static struct stage_view view;
    const float position[4][3] = {{-1, 0, 0}, {1, 0, 0}, {-1, 2, 0}, {1, 2, 0}};
    const float uv[4][2] = {{from, to}, {to, to}, {from, from}, {to, from}};
    const float lo[3] = {-1, 0, -1}, hi[3] = {1, 2, 1};
    const uint16_t indices[6] = {0, 1, 2, 2, 1, 3};
    static const char path[] = "square.png";
    char members[1024];
    struct builder b = {0};
    struct gltf gltf;
    struct gltf_pose pose;
    assert_done(png_write(temporary_path(path), side, side, pixels, &error));
    add_data(&b, FLOAT, "VEC3", 4, position, sizeof position);
    add_data(&b, FLOAT, "VEC2", 4, uv, sizeof uv);
    add_data(&b, USHORT, "SCALAR", 6, indices, sizeof indices);
    snprintf(members, sizeof members,
             "\"images\":[{\"uri\":\"%s\"}],\"samplers\":[{}, %s],\"textures\":[{\"source\":0,\"sampler\":1}],"
             "\"materials\":[{\"doubleSided\":true,\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],"
             "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1},\"indices\":2,"
             "\"material\":0}]}],\"nodes\":[{\"mesh\":0}],\"scenes\":[{\"nodes\":[0]}]",
             path, sampler);
    read_text(builder_json(&b, members), &gltf);
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

static int differing(const picture a, const picture b)
{
    int count = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        count += memcmp(a[i / WIDTH][i % WIDTH], b[i / WIDTH][i % WIDTH], 4) != 0;
    return count;
}

#define NEAREST "\"minFilter\": 9728, \"magFilter\": 9728"

static const unsigned char red_blue[2][2][4] = {{{230, 40, 30, 255}, {30, 60, 220, 255}},
                                                {{240, 220, 60, 255}, {60, 200, 90, 255}}};

/// A picture of four by four, of which texel (x, y) is one of red_blue's.
static void spread(const int column[4], const int row[4], unsigned char out[4][4][4])
{
    for (int i = 0; i < 16; i++) memcpy(out[i / 4][i % 4], red_blue[row[i / 4]][column[i % 4]], 4);
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
        snprintf(sampler, sizeof sampler, "{\"wrapS\": %s, \"wrapT\": %s, " NEAREST "}", cases[i].across,
                 cases[i].down);
        spread(cases[i].column, cases[i].row, made);
        draw(sampler, -0.5f, 1.5f, red_blue[0][0], 2, one);
        draw("{" NEAREST "}", 0, 1, made[0][0], 4, other);
        assert_true(differing(one, other) < 40); // rounding, on the edges of texels
        draw("{" NEAREST "}", -0.5f, 1.5f, red_blue[0][0], 2, other);
        assert_int_equal(differing(one, other) > 1000, i > 0);
    }
    // Further out mirroring and clamping are not the same.
    draw("{\"wrapS\": 33648, " NEAREST "}", 0, 3, red_blue[0][0], 2, one);
    draw("{\"wrapS\": 33071, " NEAREST "}", 0, 3, red_blue[0][0], 2, other);
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
    draw("{\"magFilter\": 9728}", 0, 1, red_blue[0][0], 2, one);
    draw("{\"magFilter\": 9729}", 0, 1, red_blue[0][0], 2, other);
    assert_true(differing(one, other) > 1000);
    assert_true(changes(one) < changes(other));
    draw("{\"magFilter\": 7, \"wrapS\": \"none\"}", 0, 1, red_blue[0][0], 2, one); // what glTF does not know
    assert_int_equal(differing(one, other), 0);
}

OFFSCREEN_MAIN(WIDTH, HEIGHT)
