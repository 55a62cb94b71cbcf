/// How a mesh of somebody else's looks, all the way: an OBJ with a texture, two materials and quads becomes a soft character, is read
/// back, drawn and exported.
#include "base/png.h"
#include "export_scene.h"
#include "model/surface.h"
#include "offscreen.h"
#include "puppet.h"

enum { WIDTH = 200, HEIGHT = 160, TEXTURED = 0, GREEN = 1 };

/// A cube of 1 m of quads, which has the whole picture on each side but the one on top, which is green. Left half red, right half blue.
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
static int make_cube(void **state)
{
    unsigned char pixels[16][16][4];
    struct surface surface;
    struct character character;
    if (folder_make(state) != 0) return -1;
    for (int i = 0; i < 16 * 16; i++) {
        const unsigned char red[4] = {255, 0, 0, 255}, blue[4] = {0, 0, 255, 255};
        memcpy(pixels[i / 16][i % 16], i % 16 < 8 ? red : blue, 4);
    }
    assert_done(png_write(folder_path("two.png"), 16, 16, pixels[0][0], &error));
    folder_file("cube.mtl", material_text);
    folder_file("cube.obj", cube_text);
    folder_file("scene.json", scene_text);
    assert_done(surface_read(folder_path("cube.obj"), &surface, &error));
    assert_true(character_create(&character, &surface, 1));
    character.coordinates[0].name = strdup("up");
    for (int i = 0; i < character.vertex_count; i++)
        character.coordinates[0].re[i][1] = 0.2f * character.position[i][1];
    assert_done(character_write(folder_path("cube.glb"), &character, true, &error));
    character_free(&character);
    return 0;
}

static struct character read_character(const char *name)
{
    struct character character;
    assert_done(character_read(folder_path(name), &character, &error));
    return character;
}

static void assert_looks(const struct character *c)
{
    size_t size;
    char *png = bytes_of(folder_path("two.png"), &size);
    assert_int_equal(c->looks.material_count, 2);
    assert_string_equal(c->looks.materials[TEXTURED].name, "sides");
    assert_int_equal(c->looks.materials[TEXTURED].image_size, size);
    assert_memory_equal(c->looks.materials[TEXTURED].image, png, size);
    assert_near((double)c->looks.materials[GREEN].color[1], 0.5, 0);
    assert_int_equal(c->index_count, 36);
    assert_non_null(c->looks.joined);
    for (int t = 0; t < 12; t++) {
        assert_int_equal(c->looks.joined[t], t % 2);
        assert_int_equal(c->looks.material[t], t < 10 ? TEXTURED : GREEN);
    }
    for (int i = 0; i < 6; i++) { // the first side: (0, 1) is its lower left
        const float *uv = c->looks.uv[c->indices[i]], *p = c->position[c->indices[i]];
        assert_near((double)uv[0], (double)p[0] + 0.5, 1e-6);
        assert_near((double)uv[1], 1 - (double)p[1], 1e-6);
    }
    free(png);
}

TEST_OF(struct character, c, *c = read_character("cube.glb"), character_free(c), they_are_read_back)
{
    assert_looks(c);
    assert_done(character_write(folder_path("again.glb"), c, true, &error));
    character_free(c);
    *c = read_character("again.glb");
    assert_looks(c);
}

/// A model file can be a mesh again: simulate and analyze take it, with its quads.
TEST(a_mesh_of_quads_comes_out_of_gltf)
{
    struct surface surface;
    assert_done(surface_read(folder_path("cube.glb"), &surface, &error));
    assert_int_equal(surface.index_count, 36);
    assert_non_null(surface.looks.joined);
    for (int t = 0; t < 12; t++) assert_int_equal(surface.looks.joined[t], t % 2);
    surface_free(&surface);
}

static const char *export_cube(const char *name)
{
    return export_file(folder_path("scene.json"), name, (struct export_options){0});
}

TEST(they_are_exported_as_gltf)
{
    const char *const names[] = {"out.glb", "out.gltf"};
    for (int n = 0; n < 2; n++) {
        struct gltf gltf;
        assert_done(gltf_read(export_cube(names[n]), &gltf, &error));
        assert_null(gltf.not_shown);
        assert_int_equal(gltf.meshes[0].part_count, 2);
        assert_int_equal(gltf.materials[TEXTURED].image, 0);
        assert_int_equal(gltf.images[0].width, 16);
        assert_near((double)gltf.materials[GREEN].color[1], 0.5, 0);
        assert_int_equal(gltf.meshes[0].parts[1].material, GREEN);
        const struct gltf_part *parts = gltf.meshes[0].parts;
        assert_non_null(parts[0].uv);
        assert_ptr_equal(parts[0].position, parts[1].position); // vertices that both have are there once
        assert_ptr_equal(parts[0].uv, parts[1].uv);
        gltf_free(&gltf);
    }
    for (int n = 0; n < 2; n++) {
        struct character c = read_character(names[n]);
        assert_looks(&c);
        character_free(&c);
    }
}

TEST(they_are_exported_as_usd_with_quads)
{
    size_t size, picture_size, original_size;
    char *text = bytes_of(export_cube("out.usda"), &size);
    static const char *const expected[] = {
        "int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]",
        "asset inputs:file = @./out_textures/sides_0.png@",
        "rel material:binding = </scene/cube/materials/sides>",
        "color3f inputs:diffuseColor = (0, 0.5, 0)",
        "texCoord2f[] primvars:st = [",
    };
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        if (!strstr(text, expected[i])) fail_msg("the .usda lacks %s", expected[i]);
    }
    free(text);
    char *picture = bytes_of(folder_path("out_textures/sides_0.png"), &picture_size);
    char *original = bytes_of(folder_path("two.png"), &original_size);
    assert_int_equal(picture_size, original_size);
    assert_memory_equal(picture, original, original_size);
    free(picture);
    free(original);
}

typedef unsigned char picture[HEIGHT][WIDTH][4];

/// The figure from the front and a little from above.
static void draw(const struct figure *figure, int map_coordinate, picture pixels)
{
    const float lo[3] = {-0.7f, 0, -0.7f}, hi[3] = {0.7f, 1.2f, 0.7f};
    const struct stage_character character = {.figure = figure, .map_coordinate = map_coordinate};
    offscreen_draw_characters(&character, 1, lo, hi, WIDTH, HEIGHT, pixels);
}

/// Pixels in which channel k is more than twice the others.
static int pixels_of(const picture pixels, int k)
{
    int count = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const unsigned char *p = pixels[i / WIDTH][i % WIDTH];
        const int other = p[(k + 1) % 3] > p[(k + 2) % 3] ? p[(k + 1) % 3] : p[(k + 2) % 3];
        count += p[k] > 2 * other + 30;
    }
    return count;
}

TEST(they_are_seen_on_the_stage)
{
    static picture seen, mapped;
    if (!platform) skip();
    struct character c = read_character("cube.glb");
    struct figure figure;
    figure_create(&figure, &c);
    draw(&figure, -1, seen);
    for (int k = 0; k < 3; k++) {
        if (pixels_of(seen, k) < 200) fail_msg("channel %d: %d pixels", k, pixels_of(seen, k));
    }
    draw(&figure, 0, mapped);
    assert_true(pixels_of(mapped, 1) < 20 && pixels_of(mapped, 0) < 20); // the phase map has colours of its own
    figure_free(&figure);
}

/// Through a top of half an alpha the background is seen, on which it lies as on glass; the sides stay as they were.
TEST(what_is_half_clear_is_seen_through)
{
    static picture opaque, clear, none;
    if (!platform) skip();
    for (int i = 0; i < 3; i++) {
        struct character c = read_character("cube.glb");
        struct figure figure;
        if (i > 0) c.looks.materials[GREEN].color[3] = i == 1 ? 0.5f : 0;
        figure_create(&figure, &c);
        draw(&figure, -1, i == 0 ? opaque : i == 1 ? clear : none);
        figure_free(&figure);
    }
    int between = 0, green = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const unsigned char *full = opaque[i / WIDTH][i % WIDTH], *half = clear[i / WIDTH][i % WIDTH],
                            *behind = none[i / WIDTH][i % WIDTH];
        if (!(full[1] > 2 * full[0] + 30 && full[1] > 2 * full[2] + 30)) continue;
        green++;
        between += half[1] < full[1] - 5 && half[1] > behind[1] + 5;
    }
    if (green < 100 || between < 2 * green / 3) fail_msg("of %d green pixels %d are seen through", green, between);
    for (int k = 0; k < 3; k += 2)
        assert_near(pixels_of(clear, k), pixels_of(opaque, k), 100); // but at the top's edges
}

/// Slopes of a picture that is drawn smaller than it is stay even, so that nothing glitters when it moves.
TEST(a_far_picture_is_smooth)
{
    enum { SIDE = 128 };
    static unsigned char waves[SIDE][SIDE][4];
    static picture seen;
    if (!platform) skip();
    for (int i = 0; i < SIDE * SIDE; i++) {
        memset(waves[i / SIDE][i % SIDE], 32 + 6 * abs(i % 64 - 32), 3);
        waves[i / SIDE][i % SIDE][3] = 255;
    }
    assert_done(png_write(folder_path("waves.png"), SIDE, SIDE, waves[0][0], &error));
    struct character c = read_character("cube.glb");
    struct looks_material *sides = &c.looks.materials[TEXTURED];
    free(sides->image);
    sides->image = (unsigned char *)bytes_of(folder_path("waves.png"), &sides->image_size);
    struct figure figure;
    figure_create(&figure, &c);
    draw(&figure, -1, seen);
    int uneven = 0;
    for (int x = WIDTH / 2 - 20; x < WIDTH / 2 + 20; x++) {
        const unsigned char(*p)[4] = &seen[HEIGHT / 2][x];
        uneven += abs(p[-1][0] - 2 * p[0][0] + p[1][0]) > 4;
    }
    if (uneven > 8) fail_msg("the slope changes at %d of 40 pixels", uneven);
    figure_free(&figure);
}

/// Of a ball, which is drawn coarser in a pair, the lower half stays red and the upper green.
TEST(coarse_triangles_keep_their_material)
{
    struct character ball = puppet_character(0.017f, 0);
    const int triangles = ball.index_count / 3;
    ball.looks.material = malloc((size_t)triangles * sizeof *ball.looks.material);
    assert_non_null(ball.looks.material);
    for (int t = 0; t < triangles; t++) ball.looks.material[t] = ball.position[ball.indices[3 * t]][1] > 0.5f;
    struct figure figure = puppet_figure(&ball);
    assert_true(figure.coarse_count < figure.character.index_count);
    int astray = 0;
    for (int t = 0; t < figure.coarse_count / 3; t++) {
        const float y = figure.character.position[figure.coarse[3 * t]][1];
        const uint32_t material = figure.character.looks.material[figure.coarse_from[t]];
        astray += fabsf(y - 0.5f) > 0.05f && material != (y > 0.5f);
    }
    assert_int_equal(astray, 0);
    figure_free(&figure);
}

static int open_all(void **state) { return make_cube(state) || offscreen_open(WIDTH, HEIGHT); }

static int close_all(void **state)
{
    offscreen_close(state);
    return folder_remove(state);
}

TESTS_BETWEEN(open_all, close_all)
