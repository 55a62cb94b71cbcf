/// glTF files that are wrong: each is refused with one sentence that names file, place, what was expected and what was found, whatever it
/// claims it takes little memory, and changed bytes do no harm.
#include "gltf_builder.h"
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>

#ifdef __SANITIZE_ADDRESS__
static const bool sanitized = true;
#else
static const bool sanitized = false;
#endif

static void assert_refused(const char *text, const char *says)
{
    struct gltf gltf;
    struct error error = {0};
    static char copy[1 << 16];
    const char *path = temporary_file("bad.gltf", quote(strcpy(copy, text)), strlen(text));
    if (gltf_read(path, &gltf, &error)) fail_msg("opened, though '%s'", says);
    if (strncmp(error.text, path, strlen(path)) != 0 || !strstr(error.text, says))
        fail_msg("'%s' does not name the file and say '%s'", error.text, says);
    assert_null(gltf.nodes);
}

#define POSITION "'meshes':[{'primitives':[{'attributes':{'POSITION':"
#define NODES ",'nodes':[{'mesh':0}]"
#define CLIP(sampler, path)                                                                                          \
    "'nodes':[{}],'animations':[{'channels':[{'sampler':0,'target':{'node':0,'path':'" path                          \
    "'}}],'samplers':[" sampler "]}]"

/// Members, and what is said of them. Accessor 0 is a triangle, 1 three quaternions, 2 descending times, 3 a lonely 7 as a byte, 4 has a
/// NaN, 5 joints, 6 weights.
static const struct {
    const char *members, *says;
} bad[] = {
    {"'scenes':[]", "nodes: expected something to show, got no nodes"},
    {"'nodes':7", "nodes: expected an array, got something else"},
    {"'extensionsRequired':['x','KHR_meshopt_compression']",
     "extensionsRequired[1]: expected meshes that are not compressed, got KHR_meshopt"},
    {"'nodes':[{'mesh':0}]", "nodes[0].mesh: expected none, because the file has none"},
    {POSITION "0}}]}],'nodes':[{'mesh':1}]", "nodes[0].mesh: expected a number from 0 to 0, got 1"},
    {POSITION "0}}]}],'nodes':[{'mesh':-1}]", "nodes[0].mesh: expected a number from 0 to 0, got -1"},
    {"'nodes':[{'children':[1]},{'children':[0]}]", "nodes: expected a tree, got a node that is below itself"},
    {"'nodes':[{'children':[0]}]", "nodes: expected a tree"},
    {"'nodes':[{'children':[2]},{'children':[2]},{}]",
     "nodes[1].children[0]: expected a node of one parent, got node 2, which nodes[0] has too"},
    {"'nodes':[{'children':[9]}]", "nodes[0].children[0]: expected a node from 0 to 0, got another number"},
    {"'nodes':[{'children':['a']}]", "nodes[0].children[0]: expected a node from 0 to 0, got something else"},
    {"'nodes':[{'translation':[1,2]}]", "nodes[0].translation: expected 3 numbers, got 2"},
    {"'nodes':[{'scale':[1,'b',1]}]", "nodes[0].scale[1]: expected a finite number, got something else"},
    {"'nodes':[{'scale':[1,1e300,1]}]", "nodes[0].scale[1]: expected a finite number"},
    {"'nodes':[{'rotation':[0,0,0,0]}]", "nodes[0].rotation: expected a unit quaternion"},
    {"'nodes':[{}],'scenes':[{'nodes':[3]}]", "scenes[0].nodes[0]: expected a node from 0 to 0"},
    {"'nodes':[{}],'scenes':[{'nodes':[0]}],'scene':4", "scene.scene: expected a number from 0 to 0, got 4"},
    {POSITION "50}}]}]" NODES, "meshes[0].primitives[0].attributes.POSITION: expected an accessor, got none"},
    {POSITION "1}}]}]" NODES,
     "meshes[0].primitives[0].attributes.POSITION: expected 3 elements of 3 numbers, got 3 of 4"},
    {POSITION "4}}]}]" NODES, "accessors[4]: expected finite numbers, got NaN"},
    {POSITION "0,'NORMAL':3}}]}]" NODES, "attributes.NORMAL: expected 3 elements of 3 numbers, got 1 of 1"},
    {POSITION "0},'indices':3}]}]" NODES,
     "meshes[0].primitives[0].indices: expected numbers from 0 to 2, got 7 at place 0"},
    {POSITION "0},'indices':0}]}]" NODES, "meshes[0].primitives[0].indices: expected one number each, got 3"},
    {POSITION "0},'mode':7}]}]" NODES, "meshes[0].primitives[0].mode: expected a number from 0 to 6"},
    {POSITION "0},'material':0}]}]" NODES, "meshes[0].primitives[0].material: expected none"},
    {POSITION "0},'targets':[{}]}],'weights':[1,2]}]" NODES, "meshes[0].weights: expected 1 numbers, got 2"},
    {"'meshes':[{'primitives':{}}]" NODES, "meshes[0].primitives: expected an array"},
    {POSITION "0,'JOINTS_0':5,'WEIGHTS_0':6}}]}],'skins':[{'joints':[0]}],'nodes':[{'mesh':0,'skin':0}]",
     "nodes[0].skin: expected a skin of 3 joints, which its mesh uses, got 1"},
    {POSITION "0,'JOINTS_0':1,'WEIGHTS_0':6}}]}]" NODES, "attributes.JOINTS_0: expected numbers of joints"},
    {POSITION "0,'JOINTS_0':5}}]}]" NODES,
     "meshes[0].primitives[0].attributes: expected WEIGHTS_0 beside JOINTS_0, got JOINTS_0 alone"},
    {"'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{'index':3}}}],'textures':[{}]",
     "materials[0].index: expected a number from 0 to 0, got 3"},
    {"'nodes':[{}],'skins':[{}]", "skins[0].joints: expected a joint or more, got none"},
    {"'nodes':[{}],'skins':[{'joints':[1]}]", "skins[0].joints[0]: expected a node from 0 to 0"},
    {"'nodes':[{}],'skins':[{'joints':[0],'inverseBindMatrices':0}]",
     "skins[0].inverseBindMatrices: expected 1 matrices of 16 numbers, got 3 of 3"},
    {CLIP("{'input':2,'output':0}", "scale"),
     "animations[0].samplers[0].input: expected ascending times, got 1 after 2"},
    {CLIP("{'input':3,'output':0}", "scale"),
     "animations[0].samplers[0].output: expected 1 elements of 3 numbers, got 3 of 3"},
    {CLIP("{'input':0,'output':0}", "scale"), "animations[0].samplers[0].input: expected times, got 3 numbers a key"},
    {CLIP("{'input':2}", "scale"), "animations[0].samplers[0].output: expected an accessor, got none"},
    {CLIP("{'input':3,'output':3,'interpolation':'SOFT'}", "rotation"),
     "interpolation: expected STEP, LINEAR or CUBICSPLINE, got SOFT"},
    {CLIP("", "scale"), "animations[0].channels[0].sampler: expected none"},
};

TEST(bad_files_get_one_sentence)
{
    struct builder b = {0};
    ADD(&b, FLOAT, float, 3, 0, 0, 0, 1, 0, 0, 0, 1, 0);
    ADD(&b, FLOAT, float, 4, 0.5f, [11] = 0);
    ADD(&b, FLOAT, float, 1, 2, 1);
    ADD(&b, UBYTE, uint8_t, 1, 7);
    ADD(&b, FLOAT, float, 3, 0, 0, 0, 0, NAN, 0, 0, 0, 0);
    ADD(&b, UBYTE, uint8_t, 4, 2, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0);
    ADD(&b, FLOAT, float, 4, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_refused(builder_json(&b, bad[i].members), bad[i].says);
}

/// Room that is filled up with zeros behind the text is no fault; a zero in it ends the text for some readers and not for others.
TEST(zeros_may_only_follow_the_text)
{
    static const char padded[] = "{\"asset\":{\"version\":\"1.0\"}}\0\0",
                      split[] = "{\"asset\":\0{\"version\":\"1.0\"}}";
    struct gltf gltf;
    assert_refusal(gltf_read(temporary_file("bad.gltf", padded, sizeof padded), &gltf, &error),
                   "expected glTF 2.0, got 1.0");
    assert_refusal(gltf_read(temporary_file("bad.gltf", split, sizeof split - 1), &gltf, &error),
                   "JSON: expected text, got a NUL byte");
}

#define ASSET "{'asset':{'version':'2.0'},"
#define BUFFER(members) ASSET "'buffers':[{" members "}]}"

TEST(bad_containers)
{
    static const struct {
        const char *text, *says;
    } containers[] = {
        {"", "JSON, line 1"},
        {"{'asset':", "JSON, line 1"},
        {"[1]", "expected a JSON object"},
        {"{}", "asset.version: expected glTF 2.0, got none"},
        {"{'asset':{'version':'1.0'}}", "asset.version: expected glTF 2.0, got 1.0"},
        {"{'asset':{'version':'2.9','minVersion':'2.1'}}", "asset.version: expected glTF 2.0, got 2.1"},
        {BUFFER("'uri':'no.bin','byteLength':1"), "buffers[0].uri: "},
        {BUFFER("'uri':'https://a.example/b.bin','byteLength':1"),
         "buffers[0].uri: expected a data URI or a file's name, from the folder of this one, got "
         "'https://a.example/b.bin'"},
        {BUFFER("'uri':'/etc/passwd','byteLength':1"), "got '/etc/passwd'"},
        {BUFFER("'uri':'%2fetc/passwd','byteLength':1"), "got '%2fetc/passwd'"},
        {BUFFER("'uri':'a%00b','byteLength':1"), "expected a data URI or a file's name"},
        {BUFFER("'uri':'data:,abc','byteLength':1"), "buffers[0].uri: expected a data URI in base64"},
        {BUFFER("'uri':'data:;base64,AA*A','byteLength':1"), "expected base64, got something else"},
        {BUFFER("'uri':'data:;base64,AAAA','byteLength':4"),
         "buffers[0].byteLength: expected at most the 3 bytes that are there, got 4"},
        {BUFFER("'byteLength':4"), "expected at most the 0 bytes that are there, got 4"},
    };
    struct gltf gltf;
    for (size_t i = 0; i < sizeof containers / sizeof *containers; i++)
        assert_refused(containers[i].text, containers[i].says);
    assert_refusal(gltf_read("/nowhere.gltf", &gltf, &error), "/nowhere.gltf: cannot be opened");
}

/// Reads a file in a process of its own: the most memory that it had, in KiB, beyond what it began with.
static long memory_to_read(const char *text, bool *opened)
{
    int said[2], status;
    long answer[2] = {0, 0};
    static char copy[1 << 16];
    const char *path = temporary_file("claim.gltf", quote(strcpy(copy, text)), strlen(text));
    assert_int_equal(pipe(said), 0);
    pid_t child = fork();
    if (child == 0) {
        struct gltf gltf;
        struct rusage before, after;
        getrusage(RUSAGE_SELF, &before);
        answer[1] = gltf_read(path, &gltf, NULL);
        getrusage(RUSAGE_SELF, &after);
        answer[0] = after.ru_maxrss - before.ru_maxrss;
        _exit(write(said[1], answer, sizeof answer) != sizeof answer);
    }
    waitpid(child, &status, 0);
    assert_int_equal(status, 0);
    assert_int_equal(read(said[0], answer, sizeof answer), sizeof answer);
    close(said[0]);
    close(said[1]);
    *opened = answer[1];
    return answer[0];
}

/// Small files with large claims: without views, sparse, again and again, and a picture of 200 million pixels.
TEST(claims_take_little_memory)
{
    static char many[1 << 16];
    unsigned char png[] = "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x38\0\0\0\x38\0\x08\x06\0\0\0";
    char picture[512], base64[128];
    *append_base64(base64, png, sizeof png - 1) = '\0';
    snprintf(picture, sizeof picture,
             ASSET "'images':[{'uri':'data:;base64,%s'}],'textures':[{'source':0}],'materials':[{"
                   "'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}],'nodes':[{}]}",
             base64);
    strcpy(many, ASSET "'buffers':[{'byteLength':12,'uri':'data:;base64,AAAAAAAAAAAAAAAA'}],'bufferViews':[{'buffer':"
                       "0,'byteLength':12}],'accessors':[{'componentType':5126,'type':'VEC3','count':40000,'sparse':{"
                       "'count':1,'indices':{'bufferView':0,'componentType':5121},'values':{'bufferView':0}}}],"
                       "'nodes':[{'mesh':0}],'meshes':[{'primitives':[");
    for (int i = 0; i < 1000; i++)
        strcat(many, i ? ",{'attributes':{'POSITION':0,'NORMAL':0}}" : "{'attributes':{'POSITION':0,'NORMAL':0}}");
    strcat(many, "]}]}");
#define SPARSE_CLAIM(count)                                                                                          \
    ",'sparse':{'count':" count ",'indices':{'bufferView':0,'componentType':5121},'values':{'bufferView':0}}"
#define CLAIM(count, more)                                                                                           \
    ASSET "'buffers':[{'byteLength':3,'uri':'data:;base64,AAAA'}],'bufferViews':[{'buffer':0,'byteLength':3}],"      \
          "'accessors':[{'componentType':5126,'type':'VEC3','count':" count more "}],'nodes':[{'mesh':0}],"          \
          "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}]}"
    const struct {
        const char *text;
        bool opens;
    } cases[] = {
        {CLAIM("30000000", ""), false},
        {CLAIM("2147483647", ""), false},
        {CLAIM("30000000", ",'bufferView':0"), false},
        {CLAIM("30000000", SPARSE_CLAIM("3")), false},
        {CLAIM("1000000", ""), false},
        {CLAIM("1000000", SPARSE_CLAIM("1")), false},
        {many, false},
        {picture, true}, // in white, and named
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bool opened;
        long used = memory_to_read(cases[i].text, &opened);
        if (!sanitized && used > 24L << 10) fail_msg("case %zu took %ld MiB", i, used >> 10);
        assert_int_equal(opened, cases[i].opens);
    }
}

/// A small file with everything in it.
static void build_all(struct builder *b, const char **members)
{
    const uint8_t places[] = {1, 3};
    char more[256];
    ADD(b, FLOAT, float, 3, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0);
    ADD(b, UBYTE, uint8_t, 1, 0, 1, 2, 3);
    ADD(b, UBYTE, uint8_t, 4, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0);
    ADD(b, FLOAT, float, 4, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0);
    ADD(b, FLOAT, float, 1, 0, 1);
    ADD(b, FLOAT, float, 4, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0);
    ADD(b, FLOAT, float, 1, 0, 1);
    ADD(b, FLOAT, float, 16, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, [31] = 0);
    snprintf(more, sizeof more,
             ",'sparse':{'count':2,'indices':{'bufferView':%d,'componentType':5121},'values':{'bufferView':0}}",
             add_view(b, places, sizeof places, 0));
    add_accessor(b, FLOAT, "VEC3", 4, more);
    unsigned char png[] = "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x02\0\0\0\x02\x08\x06\0\0\0\x72\xb6\x0d\x24";
    add_view(b, png, sizeof png, 0);
    *members =
        "'images':[{'bufferView':9}],'textures':[{'source':0}],'materials':[{'pbrMetallicRoughness':{"
        "'baseColorTexture':{'index':0},'baseColorFactor':[1,1,1,1]}}],'meshes':[{'primitives':[{'attributes':{"
        "'POSITION':0,'JOINTS_0':2,'WEIGHTS_0':3},'indices':1,'mode':5,'material':0,'targets':[{'POSITION':8}]},"
        "{'attributes':{'POSITION':0,'NORMAL':0},'indices':1,'targets':[{'POSITION':8,'NORMAL':8}]}],"
        "'weights':[0.5]}],'skins':[{'joints':[1,2],'inverseBindMatrices':7}],'scene':0,'scenes':[{'nodes':[0,1]}],"
        "'nodes':[{'mesh':0,'skin':0,'weights':[1]},{'children':[2]},{'rotation':[0,0,0,1]}],'animations':[{"
        "'channels':[{'sampler':0,'target':{'node':2,'path':'rotation'}},{'sampler':1,'target':{'node':0,"
        "'path':'weights'}}],'samplers':[{'input':4,'output':5,'interpolation':'CUBICSPLINE'},{'input':4,'output':6}]"
        "}]";
}

/// Poses all that was read, as the app would.
static void use(const struct gltf *gltf)
{
    struct gltf_pose pose;
    assert_true(gltf_pose_create(gltf, &pose));
    for (int clip = -1; clip < gltf->clip_count; clip++) {
        gltf_pose_clip(gltf, clip, 0.4, &pose);
        gltf_pose_world(gltf, &pose);
        for (int n = 0; n < gltf->node_count; n++) {
            size_t count = (size_t)gltf_vertex_count(gltf, n) + 1;
            float(*vertices)[3] = malloc(2 * count * sizeof *vertices);
            gltf_pose_vertices(gltf, &pose, n, vertices, vertices + count);
            free(vertices);
        }
    }
    for (int m = 0; m < gltf->mesh_count; m++) {
        for (int p = 0; p < gltf->meshes[m].part_count; p++) {
            const struct gltf_part *part = &gltf->meshes[m].parts[p];
            for (int i = 0; i < part->index_count; i++) assert_true(part->indices[i] < (uint32_t)part->vertex_count);
        }
    }
    gltf_pose_free(&pose);
}

static uint32_t draw(size_t below)
{
    static uint32_t seed = 2026;
    seed = 1664525u * seed + 1013904223u;
    return (seed >> 8) % (uint32_t)below;
}

/// Bytes and numbers of the JSON and bytes of the buffer are changed: the file is read or refused, never more (the sanitizers watch).
TEST(changed_files_do_no_harm)
{
    static char text[1 << 16];
    struct builder whole = {0}, b;
    const char *members;
    struct gltf gltf;
    struct error error;
    int refused = 0, opened = 0;
    build_all(&whole, &members);
    read_text(builder_json(&whole, members), &gltf);
    use(&gltf);
    gltf_free(&gltf);
    for (int round = 0; round < 1500; round++) {
        b = whole;
        for (uint32_t k = round % 3 == 0 ? 3 : 0; k > 0; k--) b.bytes[draw(b.size)] = (unsigned char)draw(256);
        strcpy(text, builder_json(&b, members));
        char *views = strstr(text, "\"bufferViews\"");
        for (uint32_t k = round % 3 ? 1 + draw(2) : 0; k > 0;) {
            char *at = views + draw(strlen(views));
            bool digit = *at >= '0' && *at <= '9';
            if (round % 3 == 1 ? !digit : digit) continue;
            *at = round % 3 == 1 ? "0123456789e-"[draw(12)] : (char)(' ' + (char)draw(95));
            k--;
        }
        if (gltf_read(temporary_file("changed.gltf", text, strlen(text)), &gltf, &error)) {
            use(&gltf);
            gltf_free(&gltf);
            opened++;
        } else {
            assert_non_null(strstr(error.text, "changed.gltf: "));
            refused++;
        }
    }
    assert_in_range(refused, 100, 1400);
    assert_in_range(opened, 100, 1400);
}

/// Decodes a JPEG that begins with a table of so many codes, behind bytes that only look like one.
static void decode_table(int codes, size_t cut, const char *says)
{
    unsigned char file[512] = {0xFF, 0xFF, 0xD8, 0xFF, 0xFE, 0, 6, 0xFF, 0xC4, 0, 3, 0x55, 0xFF, 0xFF, 0xC4};
    const size_t size = 15 + 2 + 17 + (size_t)codes;
    file[15] = (unsigned char)((size - 15) >> 8);
    file[16] = (unsigned char)(size - 15);
    for (int length = 9; codes > 0; length++) {
        file[17 + length] = (unsigned char)(codes < 255 ? codes : 255);
        codes -= file[17 + length];
    }
    for (int fill = 0; fill < 2; fill++) { // a byte before the start is passed over
        struct gltf_image image;
        assert_refusal(gltf_decode_image(file + 1 - fill, size - 1 + (size_t)fill - cut, 1 << 20, &image, &error),
                       says);
    }
}

TEST(tables_of_a_jpeg)
{
    decode_table(256, 0, "unknown image type");
    decode_table(257, 0, "a part of it is too large");
    decode_table(300, 0, "a part of it is too large");
    decode_table(256, 1, "a part of it is too large");
}

TEST(chunks_of_a_png)
{
    unsigned char file[] = "\x89PNG\r\n\x1a\n\0\0\0\x0DIHDR\0\0\0\1\0\0\0\1\x08\0\0\0\0crc!"
                           "\0\0\0\x0DIDAT\x78\1\1\2\0\xFD\xFF\0\x50\0\x52\0\x51"
                           "crc!\0\0\0\0IEND";
    struct gltf_image image;
    assert_done(gltf_decode_image(file, sizeof file - 1, 1 << 20, &image, &error));
    assert_int_equal(image.pixels[0], 0x50);
    free(image.pixels);
    file[33] = 0x19; // 419 million bytes more
    assert_refusal(gltf_decode_image(file, sizeof file - 1, 1 << 20, &image, &error), "a part of it is too large");
    memcpy(file + 33, "\0\0\0\0IDATcrc!\0\0\0\1IDAT\x78", 21); // data that begins with an empty chunk
    assert_refusal(gltf_decode_image(file, sizeof file - 1, 1 << 20, &image, &error), "or empty");
}
