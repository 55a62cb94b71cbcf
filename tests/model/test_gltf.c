/// glTF characters as other programs write them: containers, every kind of accessor, primitives, materials, images, scenes; and their poses:
/// every interpolation against numbers made by hand, skins and morph targets against the textbook.
#include "base/file.h"
#include "base/png.h"
#include "facts.h"
#include "gltf_builder.h"
#include "model/surface.h"

enum { FACTS_VERTICES = FACTS_NUMBERS / GLTF_INFLUENCES }; ///< the most of a row

/// Where the words look: at first at part 0 of mesh 0, its target 0, node 0, and the pose at rest.
struct gltf_view {
    const struct gltf *gltf;
    struct gltf_pose pose;
    int part, target, node, clip;
};

/// "part", "target", "node", "clip" and "at" (seconds of the clip) say where the next words look. Nothing that is not there has numbers.
static int gltf_numbers(void *view, const char *word, const double *given, double *out)
{
    static const struct gltf_part none;
    static float posed[3 * FACTS_VERTICES], turned[3 * FACTS_VERTICES];
    struct gltf_view *v = view;
    const struct gltf *g = v->gltf;
    const struct {
        const char *word;
        int *number;
    } places[] = {{"part", &v->part}, {"target", &v->target}, {"node", &v->node}, {"clip", &v->clip}};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        if (strcmp(word, places[i].word) != 0) continue;
        *places[i].number = (int)given[0];
        return FACTS_LOOKED;
    }
    if (strcmp(word, "at") == 0) {
        gltf_pose_clip(g, v->clip, given[0], &v->pose);
        gltf_pose_world(g, &v->pose);
        return FACTS_LOOKED;
    }
    const struct gltf_part *p = g->mesh_count > 0 ? &g->meshes[0].parts[v->part] : &none;
    const struct gltf_node *node = &g->nodes[v->node];
    const struct gltf_place *place = &v->pose.place[v->node];
    const float *world = v->pose.world[v->node];
    const bool has_target = p->targets && v->target < g->meshes[0].target_count;
    const int n = p->vertex_count, count = gltf_vertex_count(g, v->node);
    assert_true(n <= FACTS_VERTICES && count <= FACTS_VERTICES && p->index_count <= FACTS_NUMBERS);
    gltf_pose_vertices(g, &v->pose, v->node, (float(*)[3])posed, (float(*)[3])turned);
    const struct {
        const char *word;
        const void *at;
        int count;
    } reals[] = {{"position", p->position, 3 * n},
                 {"normal", p->normal, 3 * n},
                 {"uv", p->uv, 2 * n},
                 {"color", p->color, 4 * n},
                 {"weights", p->weights, GLTF_INFLUENCES * n},
                 {"moves", has_target ? p->targets[v->target].position : NULL, 3 * n},
                 {"posed", posed, 3 * count}, // of the node, in the pose
                 {"turned", turned, 3 * count},
                 {"translation", place->translation, 3},
                 {"rotation", place->rotation, 4},
                 {"scale", place->scale, 3},
                 {"place", world + 12, 3},
                 {"morphs", v->pose.weights, g->weight_count},
                 {"lo", g->lo, 3},
                 {"hi", g->hi, 3}};
    const struct {
        const char *word;
        int number;
    } wholes[] = {{"parts", g->mesh_count ? g->meshes[0].part_count : 0},
                  {"targets", g->mesh_count ? g->meshes[0].target_count : 0},
                  {"parent", node->parent},
                  {"mesh", node->mesh},
                  {"last", g->clip_count ? (int)g->clips[0].last : -1},
                  {"sheared", node->has_matrix}};
    for (size_t i = 0; i < sizeof wholes / sizeof *wholes; i++)
        if (strcmp(word, wholes[i].word) == 0) return take_whole(wholes[i].number, out);
    for (size_t i = 0; i < sizeof reals / sizeof *reals; i++)
        if (strcmp(word, reals[i].word) == 0) return take_floats(reals[i].at, reals[i].count, out);
    for (int i = 0; i < 9; i++) out[i] = (double)world[i / 3 * 4 + i % 3];
    if (strcmp(word, "axes") == 0) return 9;
    for (int i = 0; p->joints && i < GLTF_INFLUENCES * n; i++)
        out[i] = p->joints[i / GLTF_INFLUENCES][i % GLTF_INFLUENCES];
    if (strcmp(word, "joints") == 0) return p->joints ? GLTF_INFLUENCES * n : 0;
    for (int i = 0; i < p->index_count; i++) out[i] = p->indices[i];
    return strcmp(word, "indices") == 0 ? p->index_count : -1;
}

static void assert_facts(const struct gltf *gltf, const char *facts)
{
    struct gltf_view v = {.gltf = gltf, .clip = -1};
    assert_true(gltf_pose_create(gltf, &v.pose));
    assert_facts_of(&v, gltf_numbers, facts, facts);
    gltf_pose_free(&v.pose);
}

/// A file and what it holds; behind a |, the names of what it has that is not shown.
struct gltf_row {
    const char *members, *facts;
};

static void assert_rows(struct builder *b, const struct gltf_row *rows, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const char *bar = strchr(rows[i].facts, '|'), *hidden = bar ? bar + 2 : "";
        read_built(b, rows[i].members);
        if (strcmp(b->gltf.not_shown ? b->gltf.not_shown : "", hidden) != 0)
            fail_msg("%s: \"%s\" is not shown", rows[i].facts, b->gltf.not_shown);
        assert_facts(&b->gltf, rows[i].facts);
        gltf_free(&b->gltf);
    }
}

#define ONE_NODE "'nodes':[{'mesh':0}]"
#define MESH(attributes) "'meshes':[{'primitives':[{'attributes':{" attributes "}}]}]," ONE_NODE
#define UV(accessor) MESH("'POSITION':0,'TEXCOORD_0':" accessor)
#define PRIMITIVE(mode) "{'attributes':{'POSITION':2,'NORMAL':2},'indices':3,'mode':" mode "}"
#define REPEATS(normal, indices, mode)                                                                               \
    "{'attributes':{'POSITION':2" normal "},'indices':" indices ",'mode':" mode ",'targets':[{'POSITION':2}]}"
#define MOVES(node) "{'sampler':0,'target':{'node':" node ",'path':'translation'}}"

/// Accessor 0 is a triangle, 1 its normals, 2 five corners, 3 their numbers, 4 a strip that jumps, 5 triangles without area, 6 four corners, 7
/// two triangles of these, 8 colours; 9 and 10 have a stride and an offset, 11 to 13 are sparse; 14 to 17 are influences, 18 to 26 one list in
/// every type, 27 and 28 a move.
static void add_meshes(struct builder *b)
{
    const float strides[3][7] = {{9, 1, 2, 3, 0.5f, 0.25f, 9}, {9, 4, 5, 6, 1, 0, 9}, {9, 7, 8, 10, 0, 1, 9}},
                triangle[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, by[] = {0.5f, 3, -1};
    const uint8_t place = 2;
    char view[128], sparse[256], more[384];
    add_data(b, FLOAT, "VEC3", 3, triangle, sizeof triangle);
    ADD(b, FLOAT, float, 3, 0, 0, 1, 0, 0, 1, 0, 0, 1);
    ADD(b, FLOAT, float, 3, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0);
    ADD(b, UBYTE, uint8_t, 1, 0, 1, 2, 3, 4);
    ADD(b, UBYTE, uint8_t, 1, 0, 1, 2, 2, 1, 3);
    ADD(b, UBYTE, uint8_t, 1, 0, 1, 0, 3, 3, 3);
    ADD(b, FLOAT, float, 3, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1);
    ADD(b, USHORT, uint16_t, 1, 0, 1, 2, 0, 3, 1);
    ADD_NORMALISED(b, UBYTE, uint8_t, 4, 255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 0, 0, 0, 51);
    const int strided = add_view(b, strides, sizeof strides, 28);
    snprintf(view, sizeof view, ",'bufferView':%d,'byteOffset':4", strided);
    add_accessor(b, FLOAT, "VEC3", 3, view);
    snprintf(view, sizeof view, ",'bufferView':%d,'byteOffset':16", strided);
    add_accessor(b, FLOAT, "VEC2", 3, view);
    snprintf(sparse, sizeof sparse,
             ",'sparse':{'count':1,'indices':{'bufferView':%d,'componentType':5121},'values':{'bufferView':%d}}",
             add_view(b, &place, 1, 0), add_view(b, by, sizeof by, 0));
    snprintf(more, sizeof more, ",'bufferView':%d%s", add_view(b, triangle, sizeof triangle, 0), sparse);
    add_accessor(b, FLOAT, "VEC3", 3, more);
    add_accessor(b, FLOAT, "VEC3", 3, sparse);
    add_accessor(b, FLOAT, "VEC3", 3, "");
    ADD(b, UBYTE, uint8_t, 4, 0, 1, 2, 3, 3, 0, 0, 0, 1, 9, 0, 0);
    ADD(b, FLOAT, float, 4, 0.2f, 0.2f, 0.2f, 0.2f, 0, 0, 0, 0, 0.5f, 0, 0, 0);
    ADD(b, UBYTE, uint8_t, 4, 4, 5, 6, 7, 0, 0, 0, 0, 0, 0, 0, 0);
    ADD(b, FLOAT, float, 4, 0.2f, 0.2f, 0.2f, 0.6f, 0, 0, 0, 0, 0, 0, 0, 0);
    ADD(b, BYTE, int8_t, 2, -128, 127, 0, 1, -127, 64);
    ADD_NORMALISED(b, BYTE, int8_t, 2, -128, 127, 0, 1, -127, 64);
    ADD(b, UBYTE, uint8_t, 2, 255, 0, 51, 1, 2, 3);
    ADD_NORMALISED(b, UBYTE, uint8_t, 2, 255, 0, 51, 1, 2, 3);
    ADD(b, SHORT, int16_t, 2, -32768, 32767, 0, 1, -5, 7);
    ADD_NORMALISED(b, SHORT, int16_t, 2, -32768, 32767, 0, 1, -5, 7);
    ADD(b, USHORT, uint16_t, 2, 65535, 0, 13107, 1, 2, 3);
    ADD_NORMALISED(b, USHORT, uint16_t, 2, 65535, 0, 13107, 1, 2, 3);
    ADD(b, UINT, uint32_t, 2, 4000000000, 0, 1, 2, 3, 4);
    ADD(b, FLOAT, float, 1, 0, 1);
    assert_int_equal(ADD(b, FLOAT, float, 3, 0, 0, 0, 4, 5, 6), 28);
}

static const struct gltf_row files[] = {
    {UV("18"), "uv -128 127 0 1 -127 64"},
    {UV("19"), "uv -1 1 0 0.007874015748 -1 0.503937007874"},
    {UV("20"), "uv 255 0 51 1 2 3"},
    {UV("21"), "uv 1 0 0.2 0.00392156862745 0.0078431372549 0.0117647058824"},
    {UV("22"), "uv -32768 32767 0 1 -5 7"},
    {UV("23"), "uv -1 1 0 0.0000305185094760 -0.000152592547380 0.000213629566332"},
    {UV("24"), "uv 65535 0 13107 1 2 3"},
    {UV("25"), "uv 1 0 0.2 0.0000152590218967 0.0000305180437934 0.0000457770656902"},
    {UV("26"), "uv 4000000000 0 1 2 3 4"},
    // positions and texture coordinates in turn in one view, with a gap, from a byte of their own
    {MESH("'POSITION':9,'TEXCOORD_0':10"), "position 1 2 3 4 5 6 7 8 10 uv 0.5 0.25 1 0 0 1 lo 1 2 3 hi 7 8 10"},
    // sparse: changes to a view, and to zeros where there is no view
    {"'meshes':[{'primitives':[{'attributes':{'POSITION':11},'targets':[{'POSITION':12},{'POSITION':13}]}]}]"
     "," ONE_NODE,
     "targets 2 position 0 0 0 1 0 0 0.5 3 -1 moves 0 0 0 0 0 0 0.5 3 -1 target 1 moves 0 0 0 0 0 0 0 0 0"},
    // triangles (the two corners left over are dropped), strip and fan of five corners, which stay shared as they have normals
    {"'meshes':[{'primitives':[" PRIMITIVE("0") "," PRIMITIVE("1") "," PRIMITIVE("3") "," PRIMITIVE(
         "4") "," PRIMITIVE("5") "," PRIMITIVE("6") "]}]," ONE_NODE,
     "parts 3 indices 0 1 2 part 1 indices 0 1 2 1 3 2 2 3 4 part 2 indices 1 2 0 2 3 0 3 4 0 | points, lines"},
    // strips jump by triangles that name a vertex twice, which no reader keeps; a primitive of nothing else is not there
    {"'meshes':[{'primitives':[" REPEATS("", "5", "4") "," REPEATS(",'NORMAL':2", "4",
                                                                   "5") "," REPEATS("", "4", "5") "]}]," ONE_NODE,
     "parts 2 indices 0 1 2 2 3 1 | triangles without area"},
    // without normals a part keeps its vertices, and is drawn flat; one without the mesh's targets stays; weights at rest count
    {"'meshes':[{'primitives':[{'attributes':{'POSITION':6,'COLOR_0':8},'indices':7,'targets':[{'POSITION':6}]},"
     "{'attributes':{'POSITION':6}}],'weights':[0.5]}]," ONE_NODE,
     "targets 1 normal position 0 0 0 1 0 0 0 1 0 0 0 1 moves 0 0 0 1 0 0 0 1 0 0 0 1 indices 0 1 2 0 3 1 "
     "color 1 0 0 1 0 1 0 1 0 0 1 1 0 0 0 0.2 hi 1.5 1.5 1.5 part 1 moves"},
    // eight influences: the first vertex' sum was 2; without weights it follows the first joint; a joint without weight says nothing
    {"'skins':[{'joints':[1,2,3,4,5,6,7,8]}],'nodes':[{'mesh':0,'skin':0},{},{},{},{},{},{},{},{}],'meshes':[{"
     "'primitives':[{'attributes':{'POSITION':0,'JOINTS_0':14,'WEIGHTS_0':15,'JOINTS_1':16,'WEIGHTS_1':17}}]}]",
     "joints 0 1 2 3 4 5 6 7 3 0 0 0 0 0 0 0 1 0 0 0 0 0 0 0 weights ~0.1 ~0.1 ~0.1 ~0.1 ~0.1 ~0.1 ~0.1 ~0.3 "
     "1 0 0 0 0 0 0 0 1 0 0 0 0 0 0 0"},
    // a matrix is a move, a turn and a scale, which clips can change; one that is sheared or flat stays, and does not move
    {"'nodes':[{'matrix':[0,3,0,0,-2,0,0,0,0,0,1,0,5,0,7,1]},{'matrix':[-1,0,0,0,0,1,0,0,0,0,4,0,-1,2,0,1]},"
     "{'matrix':[1,0,0,0,1,1,0,0,0,0,1,0,4,5,6,1]},{'matrix':[1,0,0,0,0,0,0,0,0,0,1,0,1,2,3,1]}],'animations':[{"
     "'samplers':[{'input':27,'output':28}],'channels':[" MOVES("0") "," MOVES("1") "," MOVES("2") "," MOVES(
         "3") "]}]",
     "sheared 0 axes ~0 ~3 ~0 ~-2 ~0 ~0 ~0 ~0 ~1 place 5 0 7 node 1 sheared 0 axes ~-1 ~0 ~0 ~0 ~1 ~0 ~0 ~0 ~4 "
     "place -1 2 0 node 2 sheared 1 node 3 sheared 1 place 1 2 3 clip 0 at 1 node 0 place 4 5 6 node 1 place 4 5 6 "
     "node 2 place 4 5 6 node 3 place 1 2 3 | clips of nodes with sheared matrices"},
    // children before parents; what the scene leaves out has no mesh: (1, 0, 0) → (2, 0, 0) → (0, 2, 0) + (5, 0, 0) + (0, 0, 7)
    {"'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1}}]}],'cameras':[{}],'scene':1,'scenes':[{"
     "'nodes':[3]},{'nodes':[2]}],'nodes':[{'mesh':0,'scale':[2,2,2]},{'children':[0],"
     "'matrix':[0,1,0,0,-1,0,0,0,0,0,1,0,5,0,0,1]},{'children':[1],'translation':[0,0,7]},{'mesh':0}]",
     "parent 1 posed 5 0 7 ~5 ~2 ~7 ~3 ~0 ~7 turned ~0 ~0 ~1 ~0 ~0 ~1 ~0 ~0 ~1 lo ~3 ~0 ~7 node 1 sheared 0 "
     "node 3 mesh -1 | cameras, other scenes"},
};

TEST(files_are_read)
{
    struct builder b = {0};
    add_meshes(&b);
    assert_rows(&b, files, sizeof files / sizeof *files);
}

/// A surface has the meshes of all nodes, whatever nodes without one stand between them, and is none where no triangle has an area.
GLTF_TEST(a_surface_has_the_meshes_of_all_nodes)
{
    add_meshes(b);
    struct surface surface;
    const char *path =
        write_built(b, "nodes.gltf",
                    "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],'nodes':[{},{'mesh':0},"
                    "{'children':[3]},{'mesh':0,'translation':[0,0,5]},{}],'scenes':[{'nodes':[0,1,2,4]}]");
    assert_done(surface_read(path, &surface, &error));
    assert_int_equal(surface.vertex_count, 6);
    assert_int_equal(surface.index_count, 6);
    assert_near(surface.position[5][2], 5, 0);
    surface_free(&surface);
    path = write_built(b, "flat.gltf", "'meshes':[{'primitives':[" REPEATS("", "5", "4") "]}]," ONE_NODE);
    assert_refusal(surface_read(path, &surface, &error), "got none");
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
    ADD(b, FLOAT, float, 3, 0, 0, 0, 1, 0, 0, 0, 1, 0);
    ADD(b, FLOAT, float, 2, 0, 0, 1, 0, 0, 1);
    assert_done(png_write(temporary_path("a b.png"), 2, 3, pixels, &error));
    char *png;
    size_t png_size;
    assert_done(file_read(temporary_path("a b.png"), 1000, &png, &png_size, &error));
    assert_int_equal(add_view(b, png, png_size, 0), 2);
    free(png);
#define TEXTURE(index) "{'pbrMetallicRoughness':{'baseColorTexture':{'index':" index "}}"
#define SECOND_SET "{'attributes':{'POSITION':0,'TEXCOORD_1':1}"
    read_built(
        b,
        "'images':[{'bufferView':2,'mimeType':'image/png'},{'uri':'data:image/jpeg;base64," GREY_JPEG
        "'},{'uri':'a%20b.png'},{'name':'none','bufferView':0},{'name':'unused','bufferView':0},"
        "{'uri':'../missing.png'}],'textures':[{'source':1},{'source':0},{'source':2},{'source':3},{},{'source':5}],"
        "'extensionsUsed':['KHR_texture_transform','KHR_materials_sheen'],'materials':["
        "{'pbrMetallicRoughness':{'baseColorTexture':{'index':0},'baseColorFactor':[0.5,0.25,1,0.75]},"
        "'alphaMode':'BLEND','doubleSided':true},"
        "{'pbrMetallicRoughness':{'baseColorTexture':{'index':1,'texCoord':3,'extensions':{'KHR_texture_transform':{"
        "'offset':[0.5,0.25],'rotation':1.5707963267948966,'scale':[2,4],'texCoord':1}}}},'alphaMode':'MASK'}"
        "," TEXTURE("2") ",'alphaMode':'MASK','alphaCutoff':0.25}," TEXTURE("3") "}," TEXTURE(
            "4") ",'normalTexture':{'index':0}}," TEXTURE("3") "}," TEXTURE("5") "}],"
                                                                                 "'meshes':[{'primitives':"
                                                                                 "[" SECOND_SET
                                                                                 ",'material':1}," SECOND_SET
                                                                                 "}]}]," ONE_NODE);
    // the second material's: scale, then a quarter turn, then the offset: (1, 0) → (2, 0) → (0, −2) → (0.5, −1.75)
    assert_facts(&b->gltf, "uv ~0.5 ~0.25 ~0.5 ~-1.75 ~4.5 ~0.25 part 1 uv"); // plain white has no second set
    static const struct {
        int image;
        double cutoff;
    } expected[] = {{0, 0}, {1, 0.5}, {2, 0.25}, {-1, 0}, {-1, 0}, {-1, 0}, {-1, 0}};
    static const char *const shown[] = {"KHR_texture_transform", "unused"},
                             *const hidden[] = {"KHR_materials_sheen, image none (expected PNG or JPEG",
                                                "normal maps", "image ../missing.png ("};
    const struct gltf_image *images = b->gltf.images;
    const struct gltf_material *materials = b->gltf.materials;
    assert_int_equal(b->gltf.image_count, 3);
    assert_int_equal(images[0].width, 16);
    assert_in_range(images[0].pixels[4], 126, 130);
    assert_int_equal(images[0].pixels[3], 255);
    for (int i = 1; i < 3; i++) {
        assert_int_equal(10 * images[i].width + images[i].height, 23);
        assert_memory_equal(images[i].pixels, pixels, sizeof pixels);
    }
    for (int i = 0; i < 7; i++) {
        assert_int_equal(materials[i].image, expected[i].image);
        assert_near(materials[i].cutoff, expected[i].cutoff, 0);
        assert_int_equal(materials[i].blended, i == 0);
        assert_int_equal(materials[i].double_sided, i == 0);
    }
    assert_memory_equal(materials[0].color, ((const float[]){0.5f, 0.25f, 1, 0.75f}), sizeof materials[0].color);
    assert_int_equal(b->gltf.meshes[0].parts[1].material, -1);
    for (int i = 0; i < 3; i++) assert_non_null(strstr(b->gltf.not_shown, hidden[i]));
    for (int i = 0; i < 2; i++) assert_null(strstr(b->gltf.not_shown, shown[i]));
    assert_null(strstr(strstr(b->gltf.not_shown, "image none") + 1, "image none")); // once
}

/// The same file as .glb, as .gltf with a file beside it, and as one that counts on neither.
TEST(containers)
{
    const char *json =
        "{'asset':{'version':'2.0'},'buffers':[{'byteLength':36%s}],'bufferViews':[{'buffer':0,'byteLength':36}],"
        "'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'}]," MESH("'POSITION':0") "}";
    const float triangle[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    char text[1024], glb[2048];
    struct gltf gltf[2];
    snprintf(text, sizeof text, json, "");
    const size_t size = put_glb(glb, text, triangle, sizeof triangle);
    assert_done(gltf_read(temporary_file("model.glb", glb, size), &gltf[0], &error));
    snprintf(text, sizeof text, json, ",'uri':'./some%20bytes.bin'");
    temporary_file("some bytes.bin", triangle, sizeof triangle);
    read_text(quote(text), &gltf[1]);
    for (int i = 0; i < 2; i++) assert_memory_equal(gltf[i].meshes[0].parts[0].position, triangle, sizeof triangle);
    assert_true(gltf[0].id != 0 && gltf[1].id != 0 && gltf[0].id != gltf[1].id);
    assert_non_null(strstr(gltf[0].path, "model.glb"));
    for (int i = 0; i < 2; i++) gltf_free(&gltf[i]);
}

/// Scenes find nodes and clips by name. A name that repeats gets a number, but takes no other's, and one that nobody sees is none.
GLTF_TEST(no_two_names_are_alike)
{
    static const char *const nodes[] = {"bone", "bone 3", "node 2", "bone 2", "node 4", "bone 4", "node 2 2"},
                             *const clips[] = {"walk", "run", "walk 3", "clip 3"};
    read_built(b, "'nodes':[{'name':'bone'},{'name':'bone'},{'name':'node 2'},{'name':'bone 2'},{'name':' \u3000'},"
                  "{'name':'bone'},{'name':'node 2'}],'animations':[{'name':'walk'},{'name':'run'},{'name':'walk'},"
                  "{'name':''}]");
    for (int n = 0; n < b->gltf.node_count; n++) {
        assert_string_equal(b->gltf.nodes[n].name, nodes[n]);
        assert_int_equal(gltf_find_node(&b->gltf, nodes[n]), n);
    }
    for (int c = 0; c < b->gltf.clip_count; c++) {
        assert_string_equal(b->gltf.clips[c].name, clips[c]);
        assert_int_equal(gltf_find_clip(&b->gltf, clips[c]), c);
    }
    assert_int_equal(gltf_find_node(&b->gltf, "tree"), -1);
}

/// From where glTF's exporters put them, VRM 0.x among these. A target without a name has that of a shape of VRM 0.x, rather of one that it
/// makes alone.
GLTF_TEST(names_of_targets)
{
#define TARGETS "'attributes':{'POSITION':0},'targets':[{'POSITION':0},{'POSITION':0}]"
#define NAMES(first, second) "'extras':{'targetNames':[" first "," second "]}"
#define PLAIN "'primitives':[{" TARGETS "}]"
#define SHAPES(groups) "}],'extensions':{'VRM':{'blendShapeMaster':{'blendShapeGroups':[" groups "]}}},'more':[{"
#define SHAPE(name, binds) "{" name ",'binds':[" binds "]}"
#define BIND(index) "{'mesh':0,'index':" index ",'weight':100}"
#define BOTH BIND("0") "," BIND("1")
    static const struct {
        const char *mesh, *second;
    } cases[] = {
        {PLAIN SHAPES(SHAPE("'name':'Blink'", BIND("0")) "," SHAPE("'name':'Joy'", BIND("1"))), "Joy"},
        {PLAIN SHAPES(SHAPE("'name':'Fun'", BOTH) "," SHAPE("'name':'','presetName':'joy'", BIND("1")) "," SHAPE(
             "'name':'Blink'", BIND("0")) "," SHAPE("'name':'again'", BIND("0"))),
         "joy"},
        {PLAIN SHAPES("7," SHAPE("'name':'Blink'", BOTH)), "Blink"},
        {PLAIN SHAPES(
             SHAPE("'name':'Blink'", BIND("0") "," BIND("2") "," BIND("-1") ",{},7,{'mesh':1,'index':1}") "," SHAPE(
                 "'name':8", BIND("1"))),
         "none"},
        {NAMES("'Blink'", "'Joy'") "," PLAIN SHAPES(SHAPE("'name':'no'", BIND("1"))), "Joy"},
        {NAMES("'Blink'", "'Joy'") ",'primitives':[{" NAMES("'no'", "'no'") "," TARGETS "}]", "Joy"},
        {"'primitives':[{" NAMES("'Blink'", "'Joy'") "," TARGETS "}]", "Joy"},
        {"'extras':{'other':1},'primitives':[{" TARGETS "},{" NAMES("'Blink'", "'Joy'") "," TARGETS "}]", "Joy"},
        {"'primitives':[{'attributes':{'POSITION':0},'targets':[{'POSITION':0,'extra':{'name':'Blink'}},"
         "{'POSITION':0,'extras':{'name':'Joy'}}]}]",
         "Joy"},
        {NAMES("'Blink'", "7") ",'primitives':[{" TARGETS "}]", "none"},
    };
    ADD(b, FLOAT, float, 3, 0, 0, 0, 1, 0, 0, 0, 1, 0);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char all[640];
        gltf_free(&b->gltf);
        snprintf(all, sizeof all, "'meshes':[{%s}]," ONE_NODE, cases[i].mesh);
        read_built(b, all);
        const char *second = gltf_target_name(b->gltf.meshes, 1);
        assert_string_equal(gltf_target_name(b->gltf.meshes, 0), "Blink");
        assert_string_equal(second ? second : "none", cases[i].second);
    }
}

// --- poses

#define CHANNEL(node, path, sampler) "{'sampler':" sampler ",'target':{'node':" node ",'path':'" path "'}}"
#define CUBIC(output) "{'input':4,'output':" output ",'interpolation':'CUBICSPLINE'}"

/// Accessors: 0 three times, 1 places; 2 three times, 3 turns by 0°, 120° as −q, and as q; 4 two times, 5 cubic places, 6 cubic turns; 7 a
/// triangle, 8 and 9 moves of it, 10 normals, 11 times as normalised bytes, 12 weights as normalised shorts; 13 a slope, 14 its normals; 15 to 17 joints, weights
/// and inverse binds.
static void add_clips(struct builder *b)
{
    ADD(b, FLOAT, float, 1, 1, 2, 4);
    ADD(b, FLOAT, float, 3, 0, 10, 4, 2, 20, 4, 6, 0, 8);
    ADD(b, FLOAT, float, 1, 0, 3, 4);
    ADD(b, FLOAT, float, 4, 0, 0, 0, 1, 0, 0, -0.8660254037844386f, -0.5f, 0, 0, 0.8660254037844386f, 0.5f);
    ADD(b, FLOAT, float, 1, 1, 3);
    ADD(b, FLOAT, float, 3, 9, 9, 9, 1, 2, 3, 4, 0, -8, 8, 16, 0, 5, 6, 7, 9, 9, 9);
    ADD(b, FLOAT, float, 4, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0.5f, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0);
    ADD(b, FLOAT, float, 3, 0, 0, 0, 1, 0, 0, 0, 1, 0);
    ADD(b, FLOAT, float, 3, 0, 0, 1, 0, 0, 2, 0, 0, 3);
    ADD(b, FLOAT, float, 3, 1, 0, -1, 1, 0, -1, 1, 0, -1);
    ADD(b, FLOAT, float, 3, 0, 0, 1, 0, 0, 1, 0, 0, 1);
    ADD_NORMALISED(b, UBYTE, uint8_t, 1, 0, 255);
    ADD_NORMALISED(b, SHORT, int16_t, 1, 0, 32767, 32767, -32767);
    ADD(b, FLOAT, float, 3, 0, 0, 0, 1, 0, 1, 0, 1, 0);
    ADD(b, FLOAT, float, 3, -1, 0, 1, -1, 0, 1, -1, 0, 1);
    ADD(b, UBYTE, uint8_t, 4, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0);
    ADD(b, FLOAT, float, 4, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0, 0, 1, 0);
    assert_int_equal(ADD(b, FLOAT, float, 16, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1, // joint 0
                         1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 1, 1),
                     17);
}

static const struct gltf_row poses[] = {
    {"'nodes':[{'translation':[7,8,9]}],'animations':[{'samplers':[{'input':0,'output':1},{'input':0,'output':1,"
     "'interpolation':'STEP'}],'channels':[" CHANNEL("0", "translation", "0") "," CHANNEL("0", "scale", "1") "]}]",
     "last 4 at 3 translation 7 8 9 clip 0 at -5 translation 0 10 4 scale 0 10 4 at 1 translation 0 10 4 scale 0 10 "
     "4 "
     "at 1.25 translation 0.5 12.5 4 scale 0 10 4 at 2 translation 2 20 4 scale 2 20 4 at 3 translation 4 10 6 "
     "scale 2 20 4 at 3.875 translation 5.75 1.25 7.75 scale 2 20 4 at 4 translation 6 0 8 scale 6 0 8 "
     "at 1000000000 translation 6 0 8 scale 6 0 8"},
    // the short way is a third of 120° at a third of the time; between keys of the same rotation with other signs nothing moves
    {"'nodes':[{}],'animations':[{'samplers':[{'input':2,'output':3,'interpolation':'LINEAR'}],"
     "'channels':[" CHANNEL("0", "rotation", "0") "]}]",
     "clip 0 at 1 rotation ~0 ~0 ~0.342020143326 ~0.939692620786 "
     "at 3.5 axes ~-0.5 ~0.866025403784 ~0 ~-0.866025403784 ~-0.5 ~0 ~0 ~0 ~1"},
    // the spline of glTF's appendix at a quarter of two seconds: s = 1/4 has the weights 27/32, 9/64, 5/32 and −3/64
    {"'nodes':[{}],'animations':[{'samplers':[" CUBIC("5") "," CUBIC("6") "],'channels':[" CHANNEL(
         "0", "translation", "0") "," CHANNEL("0", "rotation", "1") "]}]",
     "clip 0 at 1.5 translation ~2 ~1.125 ~1.375 rotation ~0 ~0 ~0.331906211591 ~0.943312390837 "
     "at 9 translation 5 6 7 at 0 translation 1 2 3"},
    // two nodes show one mesh: weights at rest are the mesh's and the second node's own, and a clip moves the second's
    {"'meshes':[{'weights':[0.5,0],'primitives':[{'attributes':{'POSITION':7,'NORMAL':10},'targets':[{'POSITION':8},{"
     "'POSITION':8,'NORMAL':9}]}]}],'nodes':[{'mesh':0},{'mesh':0,'weights':[0,1],'translation':[10,0,0]}],"
     "'animations':[{'samplers':[{'input':11,'output':12}],'channels':[" CHANNEL("1", "weights", "0") "]}]",
     "morphs 0.5 0 0 1 posed ~0 ~0 ~0.5 ~1 ~0 ~1 ~0 ~1 ~1.5 node 1 posed ~10 ~0 ~1 ~11 ~0 ~2 ~10 ~1 ~3 "
     "turned ~1 ~0 ~0 ~1 ~0 ~0 ~1 ~0 ~0 clip 0 at 0.25 morphs 0.5 0 ~0.25 ~0.5 "
     "posed ~10 ~0 ~0.75 ~11 ~0 ~1.5 ~10 ~1 ~2.25 at 0.75 morphs 0.5 0 ~0.75 ~-0.5 "
     "posed ~10 ~0 ~0.25 ~11 ~0 ~0.5 ~10 ~1 ~0.75"},
    // mirrored and stretched: normals stay across the surface, and look to where they did
    {"'meshes':[{'primitives':[{'attributes':{'POSITION':13,'NORMAL':14}}]}],'nodes':[{'mesh':0,'scale':[-3,1,1]}]",
     "posed ~0 ~0 ~0 ~-3 ~0 ~1 ~0 ~1 ~0 turned ~0.316227766017 ~0 ~0.948683298051 ~0.316227766017 ~0 ~0.948683298051 "
     "~0.316227766017 ~0 ~0.948683298051"},
    // a skin: joint 0 takes (x, y, z) to (1 - y, x - 1, 5 + z), and joint 1, below it and stretched, to (z - 1, x, 8 + 3 y); the second vertex
    // follows both by half, the mesh's own place is nothing, and a clip moves joint 0
    {"'meshes':[{'primitives':[{'attributes':{'POSITION':7,'NORMAL':10,'JOINTS_0':15,'WEIGHTS_0':16}}]}],"
     "'skins':[{'joints':[2,3],'inverseBindMatrices':17}],'nodes':[{'mesh':0,'skin':0,'translation':[9,9,9]},"
     "{'translation':[0,0,5],'children':[2]},{'translation':[1,0,0],'rotation':[0,0,0.7071067811865476,"
     "0.7071067811865476],'children':[3]},{'translation':[0,2,0],'scale':[1,1,3]}],'animations':[{'samplers':["
     "{'input':0,'output':1}],'channels':[" CHANNEL("2", "translation", "0") "]}]",
     "posed ~1 ~-1 ~5 ~0 ~0.5 ~6.5 ~-1 ~0 ~11 turned ~0 ~0 ~1 ~0.948683298051 ~0 ~0.316227766017 ~1 ~0 ~0 "
     "clip 0 at 1 posed ~0 ~9 ~9 ~-1 ~10.5 ~10.5 ~-2 ~10 ~15"},
};

TEST(poses_are_those_of_the_textbook)
{
    struct builder b = {0};
    add_clips(&b);
    assert_rows(&b, poses, sizeof poses / sizeof *poses);
}
