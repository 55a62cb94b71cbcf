/// How somebody else's meshes look: an OBJ with a texture, two materials and quads becomes a soft character, is read back, drawn and exported;
/// and the textures of glTF files, which go on outside of their picture as the file says, and have edges or none.
#include "base/png.h"
#include "export_scene.h"
#include "gltf_builder.h"
#include "model/surface.h"
#include "model/vector.h"
#include "offscreen.h"
#include "puppet.h"

enum { SIDE = 240, TEXTURED = 0, GREEN = 1 };

static struct shot one = {.width = SIDE, .height = SIDE}, other = {.width = SIDE, .height = SIDE},
                   third = {.width = SIDE, .height = SIDE};

// --- a cube of 1 m of quads: the whole picture, red and blue, on each side but the one on top, which is green

static const char cube_text[] =
    "mtllib cube.mtl\nv -0.5 0 0.5\nv 0.5 0 0.5\nv 0.5 1 0.5\nv -0.5 1 0.5\nv -0.5 0 -0.5\nv 0.5 0 -0.5\n"
    "v 0.5 1 -0.5\nv -0.5 1 -0.5\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl sides\nf 1/1 2/2 3/3 4/4\n"
    "f 2/1 6/2 7/3 3/4\nf 6/1 5/2 8/3 7/4\nf 5/1 1/2 4/3 8/4\nf 5/1 6/2 2/3 1/4\nusemtl top\nf 4 3 7 8\n";
static const char material_text[] = "newmtl sides\nmap_Kd two.png\nnewmtl top\nKd 0 0.5 0\n";
static const char scene_text[] =
    "{\"wiggly\": 1, \"frames\": [0, 24], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"knots\": [{\"frame\": "
    "0, \"value\": 1}]}], \"rigs\": [{\"type\": \"character\", \"name\": \"cube\", \"model\": \"cube.glb\", "
    "\"coordinates\": [{\"name\": \"up\", \"spline\": \"s\"}]}]}";

/// The mesh as a file and as analyze makes a character of it.
static int open_all(void **state)
{
    unsigned char pixels[16][16][4];
    struct surface surface;
    struct character character;
    if (folder_make(state) != 0) return -1;
    for (int i = 0; i < 16 * 16; i++) memcpy(pixels[i / 16][i % 16], i % 16 < 8 ? "\xFF\0\0\xFF" : "\0\0\xFF\xFF", 4);
    assert_done(png_write(folder_path("two.png"), 16, 16, pixels[0][0], &error));
    folder_file("cube.mtl", material_text);
    folder_file("cube.obj", cube_text);
    folder_file("scene.json", scene_text);
    assert_done(surface_read(folder_path("cube.obj"), &surface, &error));
    assert_true(character_create(&character, &surface, 1));
    character.coordinates[0].name = strdup("up");
    for (int i = 0; i < character.vertex_count; i++)
        character.coordinates[0].re[i][1] = 0.2f * character.position[i][1];
    puppet_write(&character, folder_path("cube.glb"));
    return offscreen_open(SIDE, SIDE);
}

static int close_all(void **state)
{
    offscreen_close(state);
    return folder_remove(state);
}

static struct character read_character(const char *name)
{
    struct character character;
    assert_done(character_read(folder_path(name), &character, &error));
    return character;
}

static void assert_same_file(const char *name, const void *bytes, size_t size)
{
    size_t own_size;
    char *own = bytes_of(folder_path(name), &own_size);
    assert_int_equal(own_size, size);
    assert_memory_equal(own, bytes, size);
    free(own);
}

/// As it was made, as it is written again, and as it is exported in either container.
TEST(characters_are_read_back)
{
    static const char *const names[] = {"cube.glb", "again.glb", "out.glb", "out.gltf"};
    struct opened scene = open_scene(folder_path("scene.json"));
    for (int n = 0; n < 4; n++) {
        if (n > 1) export_opened(&scene, names[n], (struct export_options){0});
        struct character c = read_character(names[n]);
        assert_int_equal(c.looks.material_count, 2);
        assert_string_equal(c.looks.materials[TEXTURED].name, "sides");
        assert_same_file("two.png", c.looks.materials[TEXTURED].image, c.looks.materials[TEXTURED].image_size);
        assert_near(c.looks.materials[GREEN].color[1], 0.5, 0);
        assert_int_equal(c.index_count, 36);
        assert_non_null(c.looks.joined);
        for (int t = 0; t < 12; t++) {
            assert_int_equal(c.looks.joined[t], t % 2);
            assert_int_equal(c.looks.material[t], t < 10 ? TEXTURED : GREEN);
        }
        for (int i = 0; i < 6; i++) { // the first side: (0, 1) is its lower left
            const float *uv = c.looks.uv[c.indices[i]], *p = c.position[c.indices[i]];
            assert_near(uv[0], p[0] + 0.5f, 1e-6);
            assert_near(uv[1], 1 - p[1], 1e-6);
        }
        if (n == 0) assert_done(character_write(folder_path("again.glb"), &c, true, &error));
        character_free(&c);
        if (n < 2) continue;
        struct gltf gltf;
        assert_done(gltf_read(folder_path(names[n]), &gltf, &error));
        const struct gltf_part *parts = gltf.meshes[0].parts;
        assert_null(gltf.not_shown);
        assert_int_equal(gltf.meshes[0].part_count, 2);
        assert_int_equal(gltf.materials[TEXTURED].image, 0);
        assert_int_equal(gltf.images[0].width, 16);
        assert_near(gltf.materials[GREEN].color[1], 0.5, 0);
        assert_int_equal(parts[1].material, GREEN);
        assert_non_null(parts[0].uv);
        assert_ptr_equal(parts[0].position, parts[1].position); // vertices that both have are there once
        assert_ptr_equal(parts[0].uv, parts[1].uv);
        gltf_free(&gltf);
    }
    close_scene(&scene);
    struct surface surface; // and it can be a mesh again: simulate and analyze take it, with its quads
    assert_done(surface_read(folder_path("cube.glb"), &surface, &error));
    assert_int_equal(surface.index_count, 36);
    assert_non_null(surface.looks.joined);
    for (int t = 0; t < 12; t++) assert_int_equal(surface.looks.joined[t], t % 2);
    surface_free(&surface);
}

TEST(they_are_exported_as_usd_with_quads)
{
    static const char *const expected[] = {
        "int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]",
        "asset inputs:file = @./out_textures/sides_0.png@",
        "rel material:binding = </scene/cube/materials/sides>",
        "color3f inputs:diffuseColor = (0, 0.5, 0)",
        "texCoord2f[] primvars:st = [",
    };
    size_t size;
    struct opened scene = open_scene(folder_path("scene.json"));
    char *text = bytes_of(export_opened(&scene, "out.usda", (struct export_options){0}), &size);
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        if (!strstr(text, expected[i])) fail_msg("the .usda lacks %s", expected[i]);
    free(text);
    close_scene(&scene);
    char *picture = bytes_of(folder_path("two.png"), &size);
    assert_same_file("out_textures/sides_0.png", picture, size);
    free(picture);
}

/// A cube from the front and a little from above, which the character is freed with.
static void draw_cube(struct character *c, int map_coordinate, struct shot *shot)
{
    static struct stage_view view;
    const float lo[3] = {-0.7f, 0, -0.7f}, hi[3] = {0.7f, 1.2f, 0.7f};
    struct imported cube = puppet_imported(c);
    if (!platform) skip();
    look_at(&view, lo, hi, shot);
    view.models[view.model_count++] =
        (struct stage_model){.posed = puppet_pose(&cube, (const float[3]){0}), .map_coordinate = map_coordinate};
    shoot(&view, shot);
    imported_free(&cube);
}

/// Whether channel k is more than twice the others.
static bool is_of(const unsigned char *p, int k)
{
    const int a = p[(k + 1) % 3], b = p[(k + 2) % 3];
    return p[k] > 2 * (a > b ? a : b) + 30;
}

static int pixels_of(const struct shot *shot, int k)
{
    int count = 0;
    for (int i = 0; i < SIDE * SIDE; i++) count += is_of(shot->pixel[i], k);
    return count;
}

/// Red, green and blue; but on the phase map, which has colours of its own. Through a top of half an alpha the background is seen, on which it
/// lies as on glass; the sides stay as they were.
TEST(they_are_seen_on_the_stage)
{
    struct shot *const shots[] = {&one, &other, &third};
    for (int i = 0; i < 3; i++) {
        struct character c = read_character("cube.glb");
        if (i > 0) c.looks.materials[GREEN].color[3] = i == 1 ? 0.5f : 0;
        draw_cube(&c, -1, shots[i]);
    }
    int between = 0, green = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int full = one.pixel[i][1], half = other.pixel[i][1], none = third.pixel[i][1];
        green += is_of(one.pixel[i], 1);
        between += is_of(one.pixel[i], 1) && half < full - 5 && half > none + 5;
    }
    if (green < 100 || between < 2 * green / 3) fail_msg("of %d green pixels %d are seen through", green, between);
    for (int k = 0; k < 3; k++) {
        if (pixels_of(&one, k) < 300) fail_msg("channel %d: %d pixels", k, pixels_of(&one, k));
        if (k != 1) assert_near(pixels_of(&other, k), pixels_of(&one, k), 180); // but at the top's edges
    }
    struct character c = read_character("cube.glb");
    draw_cube(&c, 0, &other);
    assert_true(pixels_of(&other, 1) < 30 && pixels_of(&other, 0) < 30);
}

/// Slopes of a picture that is drawn smaller than it is stay even, so that nothing glitters when it moves.
TEST(a_far_picture_is_smooth)
{
    enum { PICTURE = 128 };
    static unsigned char waves[PICTURE][PICTURE][4];
    for (int i = 0; i < PICTURE * PICTURE; i++) {
        memset(waves[i / PICTURE][i % PICTURE], 32 + 6 * abs(i % 64 - 32), 3);
        waves[i / PICTURE][i % PICTURE][3] = 255;
    }
    assert_done(png_write(folder_path("waves.png"), PICTURE, PICTURE, waves[0][0], &error));
    struct character c = read_character("cube.glb");
    struct looks_material *sides = &c.looks.materials[TEXTURED];
    free(sides->image);
    sides->image = (unsigned char *)bytes_of(folder_path("waves.png"), &sides->image_size);
    struct shot *const shot = &third;
    shot->width = 200;
    shot->height = 160;
    draw_cube(&c, -1, shot);
    int uneven = 0;
    for (int x = shot->width / 2 - 20; x < shot->width / 2 + 20; x++) {
        const unsigned char *before = pixel_at(shot, x - 1, shot->height / 2);
        uneven += abs(before[0] - 2 * before[4] + before[8]) > 4;
    }
    shot->width = shot->height = SIDE;
    if (uneven > 8) fail_msg("the slope changes at %d of 40 pixels", uneven);
}

// --- textures and normals of glTF files

/// Draws the nodes of a file that lie from −1 to 1, on the ground.
static void draw_built(struct builder *b, const char *members, struct shot *shot)
{
    static struct stage_view view;
    const float lo[3] = {-1, 0, -1}, hi[3] = {1, 2, 1};
    struct gltf gltf;
    struct gltf_pose pose;
    if (!platform) skip();
    read_text(builder_json(b, members), &gltf);
    assert_true(gltf_pose_create(&gltf, &pose));
    gltf_pose_world(&gltf, &pose);
    look_at(&view, lo, hi, shot);
    view.models[view.model_count++] =
        (struct stage_model){.posed = {.gltf = &gltf, .pose = &pose, .root = {[0] = 1, [5] = 1, [10] = 1, [15] = 1}},
                             .lo = {-1, 0, 0},
                             .hi = {1, 2, 0}};
    shoot(&view, shot);
    gltf_pose_free(&pose);
    gltf_free(&gltf);
}

/// A square that shows u and v from `from` to `to` of a picture, which a sampler reads.
static void draw_square(const char *sampler, float from, float to, const void *pixels, int side, struct shot *shot)
{
    char members[1024];
    struct builder b = {0};
    assert_done(png_write(temporary_path("square.png"), side, side, pixels, &error));
    ADD(&b, FLOAT, float, 3, -1, 0, 0, 1, 0, 0, -1, 2, 0, 1, 2, 0);
    ADD(&b, FLOAT, float, 2, from, to, to, to, from, from, to, from);
    ADD(&b, USHORT, uint16_t, 1, 0, 1, 2, 2, 1, 3);
    snprintf(
        members, sizeof members,
        "'images':[{'uri':'square.png'}],'samplers':[{},{%s}],'textures':[{'source':0,'sampler':1}],'materials':[{"
        "'doubleSided':true,'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}],'meshes':[{'primitives':[{"
        "'attributes':{'POSITION':0,'TEXCOORD_0':1},'indices':2,'material':0}]}],'nodes':[{'mesh':0}],'scenes':[{"
        "'nodes':[0]}]",
        sampler);
    draw_built(&b, members, shot);
}

#define NEAREST "'minFilter': 9728, 'magFilter': 9728"

static const unsigned char texels[2][2][4] = {{{230, 40, 30, 255}, {30, 60, 220, 255}},
                                              {{240, 220, 60, 255}, {60, 200, 90, 255}}};

TEST(textures_go_on_as_the_file_says)
{
    static const struct {
        const char *wrap;
        int column[4], row[4]; ///< from one before the picture to one behind it, half a picture each
    } rows[] = {
        {"'wrapS': 10497, 'wrapT': 10497, " NEAREST, {1, 0, 1, 0}, {1, 0, 1, 0}},
        {"'wrapS': 33071, 'wrapT': 33071, " NEAREST, {0, 0, 1, 1}, {0, 0, 1, 1}},
        {"'wrapS': 33648, 'wrapT': 33071, " NEAREST, {0, 0, 1, 1}, {0, 0, 1, 1}},
        {"'wrapS': 33071, 'wrapT': 10497, " NEAREST, {0, 0, 1, 1}, {1, 0, 1, 0}},
        {"'wrapS': 10497, 'wrapT': 33648, " NEAREST, {1, 0, 1, 0}, {0, 0, 1, 1}},
    };
    draw_square(NEAREST, -0.5f, 1.5f, texels, 2, &third);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        unsigned char made[4][4][4]; // of which texel (x, y) is one of the picture's
        for (int t = 0; t < 16; t++) memcpy(made[t / 4][t % 4], texels[rows[i].row[t / 4]][rows[i].column[t % 4]], 4);
        draw_square(rows[i].wrap, -0.5f, 1.5f, texels, 2, &one);
        draw_square(NEAREST, 0, 1, made, 4, &other);
        if (differing(&one, &other, 0) >= 40) fail_msg("%s", rows[i].wrap); // rounding, on the edges of texels
        if ((differing(&one, &third, 0) > 1000) != (i > 0)) fail_msg("%s is as if it was not there", rows[i].wrap);
    }
    // Further out mirroring and clamping are not the same.
    draw_square("'wrapS': 33648, " NEAREST, 0, 3, texels, 2, &one);
    draw_square("'wrapS': 33071, " NEAREST, 0, 3, texels, 2, &other);
    assert_true(differing(&one, &other, 0) > 1000);
}

/// Pixels that differ from their left neighbour, half-way up.
static int changes(const struct shot *shot)
{
    int count = 0;
    for (int x = 1; x < SIDE; x++)
        count += memcmp(pixel_at(shot, x, SIDE / 2), pixel_at(shot, x - 1, SIDE / 2), 4) != 0;
    return count;
}

TEST(a_near_texture_has_edges_or_none)
{
    draw_square("'magFilter': 9728", 0, 1, texels, 2, &one);
    draw_square("'magFilter': 9729", 0, 1, texels, 2, &other);
    assert_true(differing(&one, &other, 0) > 1000);
    assert_true(changes(&one) < changes(&other));
    draw_square("'magFilter': 7, 'wrapS': 'none'", 0, 1, texels, 2, &one); // what glTF does not know
    assert_int_equal(differing(&one, &other, 0), 0);
}

/// A tent of four vertices without normals looks as with six and the normals of its sides.
TEST(a_mesh_without_normals_is_flat)
{
    static const float corner[4][3] = {{-1, 0, 0}, {0, 2, 0.5f}, {0, 0, 1}, {1, 0, 0}};
    static const uint16_t indices[6] = {0, 2, 1, 2, 3, 1};
    struct builder with = {0}, without = {0};
    float position[6][3], normal[6][3];
    for (int i = 0; i < 6; i++) {
        const uint16_t *side = indices + i / 3 * 3;
        const vec3s across = triangle_normal(corner[side[0]], corner[side[1]], corner[side[2]]);
        memcpy(position[i], corner[indices[i]], sizeof position[i]);
        memcpy(normal[i], glms_vec3_normalize(across).raw, sizeof normal[i]);
    }
    add_data(&with, FLOAT, "VEC3", 6, position, sizeof position);
    add_data(&with, FLOAT, "VEC3", 6, normal, sizeof normal);
    add_data(&without, FLOAT, "VEC3", 4, corner, sizeof corner);
    add_data(&without, USHORT, "SCALAR", 6, indices, sizeof indices);
#define TENT(attributes) "'meshes':[{'primitives':[{'attributes':{" attributes "}]}],'nodes':[{'mesh':0}]"
    draw_built(&with, TENT("'POSITION':0,'NORMAL':1}"), &one);
    draw_built(&without, TENT("'POSITION':0},'indices':1"), &other);
    assert_int_equal(differing(&one, &other, 2), 0);
    assert_true(memcmp(pixel_at(&one, SIDE * 2 / 5, SIDE / 2), pixel_at(&one, SIDE * 3 / 5, SIDE / 2), 3) !=
                0); // lit from one side
}

TESTS_BETWEEN(open_all, close_all)
