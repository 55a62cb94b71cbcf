/// glTF characters as other programs write them: containers, every kind of accessor, primitives, materials, images, scenes.
#include "base/file.h"
#include "base/png.h"
#include "gltf_builder.h"
#include "model/surface.h"

static const float triangle[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

#define ONE_NODE "\"nodes\":[{\"mesh\":0}]"
#define MESH(attributes) "\"meshes\":[{\"primitives\":[{\"attributes\":{" attributes "}}]}]," ONE_NODE

static void add_triangle(struct builder *b)
{
    assert_int_equal(add_data(b, FLOAT, "VEC3", 3, triangle, sizeof triangle), 0);
}

/// The uv of a triangle whose texture coordinates are accessor 1: they take any component type.
static void assert_uv(struct builder *b, const double expected[3][2])
{
    read_built(b, MESH("\"POSITION\":0,\"TEXCOORD_0\":1"));
    const struct gltf_part *part = &b->gltf.meshes[0].parts[0];
    for (int i = 0; i < 6; i++) assert_near(part->uv[i / 2][i % 2], expected[i / 2][i % 2], 1e-7);
    gltf_free(&b->gltf);
}

TEST(every_component_type)
{
    const int8_t bytes[] = {-128, 127, 0, 1, -127, 64};
    const uint8_t ubytes[] = {255, 0, 51, 1, 2, 3};
    const int16_t shorts[] = {-32768, 32767, 0, 1, -5, 7};
    const uint16_t ushorts[] = {65535, 0, 13107, 1, 2, 3};
    const uint32_t words[] = {4000000000u, 0, 1, 2, 3, 4};
    const struct {
        int type;
        const void *data;
        size_t size;
        bool normalised;
        double expected[3][2];
    } cases[] = {
        {BYTE, bytes, sizeof bytes, false, {{-128, 127}, {0, 1}, {-127, 64}}},
        {BYTE, bytes, sizeof bytes, true, {{-1, 1}, {0, 1 / 127.0}, {-1, 64 / 127.0}}},
        {UBYTE, ubytes, sizeof ubytes, false, {{255, 0}, {51, 1}, {2, 3}}},
        {UBYTE, ubytes, sizeof ubytes, true, {{1, 0}, {0.2, 1 / 255.0}, {2 / 255.0, 3 / 255.0}}},
        {SHORT, shorts, sizeof shorts, false, {{-32768, 32767}, {0, 1}, {-5, 7}}},
        {SHORT, shorts, sizeof shorts, true, {{-1, 1}, {0, 1 / 32767.0}, {-5 / 32767.0, 7 / 32767.0}}},
        {USHORT, ushorts, sizeof ushorts, false, {{65535, 0}, {13107, 1}, {2, 3}}},
        {USHORT, ushorts, sizeof ushorts, true, {{1, 0}, {0.2, 1 / 65535.0}, {2 / 65535.0, 3 / 65535.0}}},
        {UINT, words, sizeof words, false, {{4e9, 0}, {1, 2}, {3, 4}}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct builder b = {0};
        char more[64];
        add_triangle(&b);
        snprintf(more, sizeof more, ",\"bufferView\":%d,\"normalized\":%s",
                 add_view(&b, cases[i].data, cases[i].size, 0), cases[i].normalised ? "true" : "false");
        add_accessor(&b, cases[i].type, "VEC2", 3, more);
        assert_uv(&b, cases[i].expected);
    }
}

/// Positions and texture coordinates in turn in one view, with a gap, from a byte of their own.
GLTF_TEST(strides_and_offsets)
{
    const float rows[3][7] = {{9, 1, 2, 3, 0.5f, 0.25f, 9}, {9, 4, 5, 6, 1, 0, 9}, {9, 7, 8, 10, 0, 1, 9}};
    add_view(b, rows, sizeof rows, 28);
    add_accessor(b, FLOAT, "VEC3", 3, ",\"bufferView\":0,\"byteOffset\":4");
    add_accessor(b, FLOAT, "VEC2", 3, ",\"bufferView\":0,\"byteOffset\":16");
    read_built(b, MESH("\"POSITION\":0,\"TEXCOORD_0\":1"));
    const struct gltf_part *part = &b->gltf.meshes[0].parts[0];
    for (int i = 0; i < 3; i++) {
        assert_memory_equal(part->position[i], rows[i] + 1, 12);
        assert_memory_equal(part->uv[i], rows[i] + 4, 8);
    }
    assert_near(b->gltf.lo[0], 1, 0);
    assert_near(b->gltf.hi[2], 10, 0);
}

/// Changes to a view, and to zeros where there is no view.
GLTF_TEST(sparse_accessors)
{
    const uint8_t places[] = {2};
    const float by[] = {0.5f, 3, -1};
    int view = add_view(b, triangle, sizeof triangle, 0), indices = add_view(b, places, 1, 0);
    int values = add_view(b, by, sizeof by, 0);
    char sparse[256], more[320];
    snprintf(sparse, sizeof sparse,
             ",\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":%d,\"componentType\":5121},\"values\":{"
             "\"bufferView\":%d}}",
             indices, values);
    snprintf(more, sizeof more, ",\"bufferView\":%d%s", view, sparse);
    add_accessor(b, FLOAT, "VEC3", 3, more);
    add_accessor(b, FLOAT, "VEC3", 3, sparse);
    add_accessor(b, FLOAT, "VEC3", 3, "");
    read_built(b, "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"targets\":[{\"POSITION\":1},"
                  "{\"POSITION\":2}]}]}]," ONE_NODE);
    const struct gltf_part *part = &b->gltf.meshes[0].parts[0];
    const float position[3][3] = {{0, 0, 0}, {1, 0, 0}, {0.5f, 3, -1}}, moved[3][3] = {{0}, {0}, {0.5f, 3, -1}};
    assert_int_equal(b->gltf.meshes[0].target_count, 2);
    assert_memory_equal(part->position, position, sizeof position);
    assert_memory_equal(part->targets[0].position, moved, sizeof moved);
    for (int i = 0; i < 9; i++) assert_near(part->targets[1].position[i / 3][i % 3], 0, 0);
}

/// Five corners as triangles (the two left over are dropped), strip and fan; points and lines are named.
GLTF_TEST(strips_and_fans)
{
    const float corners[5][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}};
    const uint8_t indices[] = {0, 1, 2, 3, 4};
    add_data(b, FLOAT, "VEC3", 5, corners, sizeof corners);
    add_data(b, FLOAT, "VEC3", 5, corners, sizeof corners); // taken for normals, so that vertices stay shared
    add_data(b, UBYTE, "SCALAR", 5, indices, sizeof indices);
#define PRIMITIVE(mode) "{\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\"indices\":2,\"mode\":" mode "}"
    read_built(b, "\"meshes\":[{\"primitives\":[" PRIMITIVE("0") "," PRIMITIVE("1") "," PRIMITIVE("3") "," PRIMITIVE(
                      "4") "," PRIMITIVE("5") "," PRIMITIVE("6") "]}]," ONE_NODE);
    const uint32_t plain[] = {0, 1, 2}, strip[] = {0, 1, 2, 1, 3, 2, 2, 3, 4}, fan[] = {1, 2, 0, 2, 3, 0, 3, 4, 0};
    const struct gltf_part *parts = b->gltf.meshes[0].parts;
    assert_int_equal(b->gltf.meshes[0].part_count, 3);
    assert_int_equal(parts[0].index_count, 3);
    assert_memory_equal(parts[0].indices, plain, sizeof plain);
    assert_int_equal(parts[1].index_count, 9);
    assert_memory_equal(parts[1].indices, strip, sizeof strip);
    assert_int_equal(parts[2].index_count, 9);
    assert_memory_equal(parts[2].indices, fan, sizeof fan);
    assert_string_equal(b->gltf.not_shown, "points, lines");
}

/// Strips jump by triangles that name a vertex twice, which no reader keeps; a primitive of nothing else is not there.
GLTF_TEST(triangles_that_repeat_a_vertex_are_left_out)
{
    const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    const uint8_t strip[] = {0, 1, 2, 2, 1, 3}, flat[] = {0, 1, 0, 3, 3, 3};
    add_data(b, FLOAT, "VEC3", 4, corners, sizeof corners);
    add_data(b, FLOAT, "VEC3", 4, corners, sizeof corners);
    add_data(b, UBYTE, "SCALAR", 6, strip, sizeof strip);
    add_data(b, UBYTE, "SCALAR", 6, flat, sizeof flat);
#define REPEATS(normal, indices, mode)                                                                               \
    "{\"attributes\":{\"POSITION\":0" normal "},\"indices\":" indices ",\"mode\":" mode                              \
    ",\"targets\":[{\"POSITION\":0}]}"
    read_built(b, "\"meshes\":[{\"primitives\":[" REPEATS("", "3", "4") "," REPEATS(
                      ",\"NORMAL\":1", "2", "5") "," REPEATS("", "2", "5") "]}]," ONE_NODE);
    const uint32_t indices[] = {0, 1, 2, 2, 3, 1};
    const struct gltf_part *parts = b->gltf.meshes[0].parts;
    assert_int_equal(b->gltf.meshes[0].part_count, 2);
    assert_int_equal(parts[0].index_count, 6);
    assert_memory_equal(parts[0].indices, indices, sizeof indices);
    assert_string_equal(b->gltf.not_shown, "triangles without area");
    const char *path = temporary_file(
        "flat.gltf", b->json,
        strlen(builder_json(b, "\"meshes\":[{\"primitives\":[" REPEATS("", "3", "4") "]}]," ONE_NODE)));
    struct surface surface;
    assert_refusal(surface_read(path, &surface, &error), "got none");
}

/// A surface has the meshes of all nodes, whatever nodes without one stand between them.
GLTF_TEST(a_surface_has_the_meshes_of_all_nodes)
{
    const float corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    add_data(b, FLOAT, "VEC3", 3, corners, sizeof corners);
    const char *text = builder_json(
        b, "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{},{\"mesh\":0},"
           "{\"children\":[3]},{\"mesh\":0,\"translation\":[0,0,5]},{}],\"scenes\":[{\"nodes\":[0,1,2,4]}]");
    struct surface surface;
    assert_done(surface_read(temporary_file("nodes.gltf", text, strlen(text)), &surface, &error));
    assert_int_equal(surface.vertex_count, 6);
    assert_int_equal(surface.index_count, 6);
    assert_near(surface.position[5][2], 5, 0);
    surface_free(&surface);
}

/// Without normals a part keeps the vertices of its file, and is drawn flat (test_model_draw.c). A part without the mesh's targets stays as it is.
GLTF_TEST(parts_without_normals_or_targets)
{
    const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const uint16_t indices[] = {0, 1, 2, 0, 3, 1};
    const uint8_t colors[4][4] = {{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {0, 0, 0, 51}};
    add_data(b, FLOAT, "VEC3", 4, corners, sizeof corners);
    add_data(b, USHORT, "SCALAR", 6, indices, sizeof indices);
    char more[64];
    snprintf(more, sizeof more, ",\"normalized\":true,\"bufferView\":%d", add_view(b, colors, sizeof colors, 0));
    add_accessor(b, UBYTE, "VEC4", 4, more);
    read_built(
        b, "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"COLOR_0\":2},\"indices\":1,\"targets\":["
           "{\"POSITION\":0}]},{\"attributes\":{\"POSITION\":0}}],\"weights\":[0.5]}]," ONE_NODE);
    const struct gltf_part *part = &b->gltf.meshes[0].parts[0], *still = part + 1;
    assert_int_equal(part->vertex_count, 4);
    assert_null(part->normal);
    assert_memory_equal(part->position, corners, sizeof corners);
    assert_memory_equal(part->targets[0].position, corners, sizeof corners);
    for (int i = 0; i < 6; i++) assert_int_equal(part->indices[i], indices[i]);
    for (int i = 0; i < 16; i++) assert_near(part->color[i / 4][i % 4], colors[i / 4][i % 4] / 255.0, 1e-7);
    assert_int_equal(b->gltf.meshes[0].target_count, 1);
    assert_null(still->targets[0].position);
    assert_near(b->gltf.hi[0], 1.5, 1e-6); // the weights at rest count
}

GLTF_TEST(eight_influences)
{
    const uint8_t first[3][4] = {{0, 1, 2, 3}, {3, 0, 0, 0}, {1, 9, 0, 0}}, second[3][4] = {{4, 5, 6, 7}, {0}, {0}};
    const float weights[3][4] = {{0.2f, 0.2f, 0.2f, 0.2f}, {0, 0, 0, 0}, {0.5f, 0, 0, 0}};
    const float more[3][4] = {{0.2f, 0.2f, 0.2f, 0.6f}, {0}, {0}};
    add_triangle(b);
    add_data(b, UBYTE, "VEC4", 3, first, sizeof first);
    add_data(b, FLOAT, "VEC4", 3, weights, sizeof weights);
    add_data(b, UBYTE, "VEC4", 3, second, sizeof second);
    add_data(b, FLOAT, "VEC4", 3, more, sizeof more);
    read_built(
        b,
        "\"skins\":[{\"joints\":[1,2,3,4,5,6,7,8]}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,"
        "\"JOINTS_0\":1,\"WEIGHTS_0\":2,\"JOINTS_1\":3,\"WEIGHTS_1\":4}}]}],\"nodes\":[{\"mesh\":0,\"skin\":0},{},{},"
        "{},{},{},{},{},{}]");
    const struct gltf_part *part = &b->gltf.meshes[0].parts[0];
    for (int k = 0; k < 8; k++) {
        assert_int_equal(part->joints[0][k], k);
        assert_near(part->weights[0][k], k < 7 ? 0.1 : 0.3, 1e-6); // their sum was 2
        assert_near(part->weights[1][k], k == 0, 0);               // no weights: the first joint
        assert_near(part->weights[2][k], k == 0, 0);
    }
    assert_int_equal(part->joints[1][0], 3);
    assert_int_equal(part->joints[2][1], 0); // the number of a joint without weight says nothing
    assert_string_equal(b->gltf.nodes[8].name, "node 8");
    assert_null(b->gltf.not_shown);
}

/// 16 by 16 pixels of 128.
#define GREY_JPEG                                                                                                    \
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAAMCAgMCAgMDAwMEAwMEBQgFBQQEBQoHBwYIDAoMDAsKCwsNDhIQDQ4RDgsLEBYQERMU"           \
    "FRUVDA8XGBYUGBIUFRT/wAALCAAQABABAREA/8QAFAABAAAAAAAAAAAAAAAAAAAAAP/EABQQAQAAAAAAAAAAAAAAAAAAAAD/2gAI"           \
    "AQEAAD8AAP/Z"

/// PNG in a view, JPEG in a data URI, PNG in a file; one picture that is none.
GLTF_TEST(materials_and_images)
{
    unsigned char pixels[2 * 3 * 4];
    for (int i = 0; i < 24; i++) pixels[i] = (unsigned char)(10 * i);
    const float uv[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    add_triangle(b);
    add_data(b, FLOAT, "VEC2", 3, uv, sizeof uv);
    assert_done(png_write(temporary_path("a b.png"), 2, 3, pixels, &error));
    char *png;
    size_t png_size;
    assert_done(file_read(temporary_path("a b.png"), 1000, &png, &png_size, &error));
    assert_int_equal(add_view(b, png, png_size, 0), 2);
    free(png);
    read_built(
        b,
        "\"images\":[{\"bufferView\":2,\"mimeType\":\"image/png\"},{\"uri\":\"data:image/jpeg;base64," GREY_JPEG
        "\"},{\"uri\":\"a%20b.png\"},"
        "{\"name\":\"none\",\"bufferView\":0},{\"name\":\"unused\",\"bufferView\":0},{\"uri\":\"../missing.png\"}],"
        "\"textures\":[{\"source\":1},{\"source\":0},{\"source\":2},{\"source\":3},{},{\"source\":5}],"
        "\"extensionsUsed\":[\"KHR_texture_transform\",\"KHR_materials_sheen\"],"
        "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0},\"baseColorFactor\":[0.5,0.25,"
        "1,0.75]},"
        "\"alphaMode\":\"BLEND\",\"doubleSided\":true},"
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":1,\"texCoord\":3,\"extensions\":{"
        "\"KHR_texture_transform\":{\"offset\":[0.5,0.25],\"rotation\":1.5707963267948966,\"scale\":[2,4],"
        "\"texCoord\":1}}}},"
        "\"alphaMode\":\"MASK\"},"
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":2}},\"alphaMode\":\"MASK\",\"alphaCutoff\":0.25},"
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":3}}},{\"pbrMetallicRoughness\":{"
        "\"baseColorTexture\":{"
        "\"index\":4}},\"normalTexture\":{\"index\":0}},{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":3}"
        "}},"
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":5}}}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_1\":1},\"material\":1},"
        "{\"attributes\":{\"POSITION\":0,\"TEXCOORD_1\":1}}]}]," ONE_NODE);
    assert_int_equal(b->gltf.image_count, 3);
    assert_int_equal(b->gltf.images[0].width, 16);
    assert_in_range(b->gltf.images[0].pixels[4], 126, 130);
    assert_int_equal(b->gltf.images[0].pixels[3], 255);
    for (int i = 1; i < 3; i++) {
        assert_int_equal(b->gltf.images[i].width, 2);
        assert_int_equal(b->gltf.images[i].height, 3);
        assert_memory_equal(b->gltf.images[i].pixels, pixels, sizeof pixels);
    }
    const int image[] = {0, 1, 2, -1, -1, -1, -1};
    for (int i = 0; i < 7; i++) assert_int_equal(b->gltf.materials[i].image, image[i]);
    assert_near(b->gltf.materials[0].color[1], 0.25, 0);
    assert_near(b->gltf.materials[0].color[3], 0.75, 0);
    assert_true(b->gltf.materials[0].blended && b->gltf.materials[0].double_sided);
    assert_near(b->gltf.materials[1].cutoff, 0.5, 0);
    assert_near(b->gltf.materials[2].cutoff, 0.25, 0);
    assert_near(b->gltf.materials[3].cutoff, 0, 0);
    // scale, then a quarter turn, then the offset: (1, 0) → (2, 0) → (0, −2) → (0.5, −1.75)
    const struct gltf_part *part = &b->gltf.meshes[0].parts[0];
    assert_near(part->uv[1][0], 0.5, 1e-6);
    assert_near(part->uv[1][1], -1.75, 1e-6);
    assert_near(part->uv[2][0], 4.5, 1e-6);
    assert_near(part->uv[2][1], 0.25, 1e-6);
    assert_null(b->gltf.meshes[0].parts[1].uv); // plain white has no second set
    assert_int_equal(b->gltf.meshes[0].parts[1].material, -1);
    assert_non_null(strstr(b->gltf.not_shown, "KHR_materials_sheen, image none (expected PNG or JPEG"));
    assert_non_null(strstr(b->gltf.not_shown, "normal maps"));
    assert_non_null(strstr(b->gltf.not_shown, "image ../missing.png ("));
    assert_null(strstr(b->gltf.not_shown, "KHR_texture_transform"));
    assert_null(strstr(b->gltf.not_shown, "unused"));
    assert_null(strstr(strstr(b->gltf.not_shown, "image none") + 1, "image none")); // once
}

/// The same file as .glb, as .gltf with a file beside it, and as one that counts on neither.
TEST(containers)
{
    const char *json =
        "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":36%s}],\"bufferViews\":[{\"buffer\":0,"
        "\"byteLength\":36}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":"
        "\"VEC3\"}]," MESH("\"POSITION\":0") "}";
    char text[1024];
    unsigned char glb[2048];
    struct gltf gltf[2];
    uint32_t length = (uint32_t)snprintf(text, sizeof text, json, "");
    const uint32_t header[5] = {0x46546C67, 2, 28 + length + 36, length, 0x4E4F534A}, chunk[2] = {36, 0x004E4942};
    memcpy(glb, header, 20);
    memcpy(glb + 20, text, length);
    memcpy(glb + 20 + length, chunk, 8);
    memcpy(glb + 28 + length, triangle, 36);
    assert_done(gltf_read(temporary_file("model.glb", glb, header[2]), &gltf[0], &error));
    snprintf(text, sizeof text, json, ",\"uri\":\"./some%20bytes.bin\"");
    temporary_file("some bytes.bin", triangle, sizeof triangle);
    read_text(text, &gltf[1]);
    for (int i = 0; i < 2; i++) assert_memory_equal(gltf[i].meshes[0].parts[0].position, triangle, sizeof triangle);
    assert_true(gltf[0].id != 0 && gltf[1].id != 0 && gltf[0].id != gltf[1].id);
    assert_non_null(strstr(gltf[0].path, "model.glb"));
    for (int i = 0; i < 2; i++) gltf_free(&gltf[i]);
}

/// A matrix is a move, a turn and a scale, which clips can change; one that is sheared or flat stays a matrix, and the character says that it
/// does not move.
GLTF_TEST(matrices_are_split)
{
    static const float times[2] = {0, 1}, places[2][3] = {{0, 0, 0}, {4, 5, 6}};
    const int input = add_data(b, FLOAT, "SCALAR", 2, times, sizeof times);
    const int output = add_data(b, FLOAT, "VEC3", 2, places, sizeof places);
    char members[2048], *end = members;
    end += sprintf(end,
                   "\"nodes\":[{\"matrix\":[0,3,0,0,-2,0,0,0,0,0,1,0,5,0,7,1]},"
                   "{\"matrix\":[-1,0,0,0,0,1,0,0,0,0,4,0,-1,2,0,1]},"
                   "{\"matrix\":[1,0,0,0,1,1,0,0,0,0,1,0,4,5,6,1]},"
                   "{\"matrix\":[1,0,0,0,0,0,0,0,0,0,1,0,1,2,3,1]}],\"animations\":[{\"samplers\":[{\"input\":%d,"
                   "\"output\":%d}],\"channels\":[",
                   input, output);
    for (int n = 0; n < 4; n++)
        end += sprintf(end, "%s{\"sampler\":0,\"target\":{\"node\":%d,\"path\":\"translation\"}}", n ? "," : "", n);
    strcpy(end, "]}]");
    read_built(b, members);
    struct gltf_pose pose;
    assert_true(gltf_pose_create(&b->gltf, &pose));
    for (int n = 0; n < 4; n++) assert_int_equal(b->gltf.nodes[n].has_matrix, n > 1);
    static const double corner[2][3] = {{3, 3, 8}, {-2, 3, 4}}, moved[3] = {4, 5, 6};
    for (int n = 0; n < 2; n++) { // where (1, 1, 1) comes
        const float *m = pose.world[n];
        for (int k = 0; k < 3; k++) assert_near(m[k] + m[4 + k] + m[8 + k] + m[12 + k], corner[n][k], 1e-6);
    }
    gltf_pose_clip(&b->gltf, 0, 1, &pose);
    gltf_pose_world(&b->gltf, &pose);
    for (int n = 0; n < 3; n++) { // the sheared one is there anyway
        for (int k = 0; k < 3; k++) assert_near(pose.world[n][12 + k], moved[k], 1e-6);
    }
    assert_string_equal(b->gltf.not_shown, "clips of nodes with sheared matrices");
    gltf_pose_free(&pose);
}

/// Children may come before parents; what the scene leaves out has no mesh.
GLTF_TEST(nodes_and_scenes)
{
    struct gltf_pose pose;
    const float normal[3][3] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    add_triangle(b);
    add_data(b, FLOAT, "VEC3", 3, normal, sizeof normal);
    read_built(
        b,
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1}}]}],\"cameras\":[{}],\"scene\":1,"
        "\"scenes\":[{\"nodes\":[3]},{\"nodes\":[2]}],\"nodes\":[{\"mesh\":0,\"name\":\"leaf\",\"scale\":[2,2,2]},"
        "{\"children\":[0],\"matrix\":[0,1,0,0,-1,0,0,0,0,0,1,0,5,0,0,1]},"
        "{\"children\":[1],\"translation\":[0,0,7]},{\"mesh\":0}]");
    assert_int_equal(gltf_find_node(&b->gltf, "leaf"), 0);
    assert_int_equal(gltf_find_node(&b->gltf, "tree"), -1);
    assert_int_equal(b->gltf.nodes[0].parent, 1);
    assert_false(b->gltf.nodes[1].has_matrix); // it is a move and a turn
    assert_int_equal(b->gltf.nodes[3].mesh, -1);
    assert_string_equal(b->gltf.not_shown, "cameras, other scenes");
    assert_true(gltf_pose_create(&b->gltf, &pose));
    float positions[3][3], normals[3][3];
    gltf_pose_vertices(&b->gltf, &pose, 0, positions, normals);
    // (1, 0, 0) → (2, 0, 0) → (0, 2, 0) + (5, 0, 0) → + (0, 0, 7)
    const double moved[] = {5, 2, 7};
    for (int k = 0; k < 3; k++) assert_near(positions[1][k], moved[k], 1e-6);
    assert_near(normals[0][2], 1, 1e-6);
    assert_near(b->gltf.lo[0], 3, 1e-6); // (0, 2, 0) turned is (−2, 0, 0)
    gltf_pose_free(&pose);
}

/// Scenes find nodes and clips by name. A name that repeats gets a number, but takes no other's, and one that nobody sees is none.
GLTF_TEST(no_two_names_are_alike)
{
    static const char *const nodes[] = {"bone", "bone 3", "node 2", "bone 2", "node 4", "bone 4", "node 2 2"},
                             *const clips[] = {"walk", "run", "walk 3", "clip 3"};
    read_built(b, "\"nodes\":[{\"name\":\"bone\"},{\"name\":\"bone\"},{\"name\":\"node 2\"},{\"name\":\"bone 2\"},"
                  "{\"name\":\" \u3000\"},{\"name\":\"bone\"},{\"name\":\"node 2\"}],"
                  "\"animations\":[{\"name\":\"walk\"},{\"name\":\"run\"},{\"name\":\"walk\"},{\"name\":\"\"}]");
    for (int n = 0; n < b->gltf.node_count; n++) assert_string_equal(b->gltf.nodes[n].name, nodes[n]);
    for (int c = 0; c < b->gltf.clip_count; c++) assert_string_equal(b->gltf.clips[c].name, clips[c]);
}

/// From where glTF's exporters put them, VRM 0.x among these; a name that is missing is none.
GLTF_TEST(names_of_targets)
{
    static const char *const members[] = {
        "\"extras\":{\"targetNames\":[\"Blink\",\"Joy\"]},\"primitives\":[{\"extras\":{\"targetNames\":[\"no\"]},%s}"
        "]",
        "\"primitives\":[{\"extras\":{\"targetNames\":[\"Blink\",\"Joy\"]},%s}]",
        "\"extras\":{\"other\":1},\"primitives\":[{%1$s},{\"extras\":{\"targetNames\":[\"Blink\",\"Joy\"]},%1$s}]",
        "\"primitives\":[{\"attributes\":{\"POSITION\":0},\"targets\":[{\"POSITION\":0,\"extra\":{\"name\":\"Blink\"}"
        "},"
        "{\"POSITION\":0,\"extras\":{\"name\":\"Joy\"}}]}]",
        "\"extras\":{\"targetNames\":[\"Blink\",7]},\"primitives\":[{%s}]",
    };
    add_triangle(b);
    for (size_t i = 0; i < sizeof members / sizeof *members; i++) {
        char mesh[512], all[640];
        snprintf(mesh, sizeof mesh, members[i],
                 "\"attributes\":{\"POSITION\":0},\"targets\":[{\"POSITION\":0},{\"POSITION\":0}]");
        snprintf(all, sizeof all, "\"meshes\":[{%s}]," ONE_NODE, mesh);
        read_built(b, all);
        assert_string_equal(gltf_target_name(b->gltf.meshes, 0), "Blink");
        if (i + 1 < sizeof members / sizeof *members)
            assert_string_equal(gltf_target_name(b->gltf.meshes, 1), "Joy");
        else
            assert_null(gltf_target_name(b->gltf.meshes, 1));
        if (i + 1 < sizeof members / sizeof *members) gltf_free(&b->gltf);
    }
}
