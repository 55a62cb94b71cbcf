/// `wiggly flesh` on characters that others made, from Debian's packages assimp-testmodels, minetest-data and minetest-mod-maidroid; the program
/// assimp, of assimp-utils, makes .glb files of them. Each keeps skin, clips and materials, and its flesh swings in its own gait.
#include "commands/commands.h"
#include "export_scene.h"

#define ASSIMP "/usr/share/assimp/models/"
#define MINETEST "/usr/share/games/minetest/"

/// The JSON of a .glb, and its buffer; the caller frees `*data`.
static json_t *chunks_of(const char *path, char **data, const char **buffer, size_t *size)
{
    uint32_t json, chunk;
    *data = bytes_of(path, size);
    memcpy(&json, *data + 12, 4);
    memcpy(&chunk, *data + 20 + json, 4);
    *buffer = *data + 28 + json;
    *size = chunk;
    json_t *root = json_loadb(*data + 20, json, 0, NULL);
    assert_non_null(root);
    return root;
}

/// All that a file has is in another, with all bytes; only its meshes have more.
static void assert_kept(const char *from, const char *to)
{
    char *old, *new;
    const char *was, *is, *key;
    size_t size, larger, i;
    json_t *before = chunks_of(from, &old, &was, &size), *after = chunks_of(to, &new, &is, &larger), *value, *item;
    assert_true(larger > size);
    assert_memory_equal(was, is, size);
    json_object_foreach(before, key, value)
    {
        const json_t *kept = json_object_get(after, key);
        const bool grows = strcmp(key, "accessors") == 0 || strcmp(key, "bufferViews") == 0;
        if (strcmp(key, "meshes") == 0 || strcmp(key, "buffers") == 0) continue;
        if (!grows && !json_equal(value, kept)) fail_msg("%s of %s changed", key, to);
        json_array_foreach(value, i, item) if (grows) assert_true(json_equal(item, json_array_get(kept, i)));
    }
    json_array_foreach(json_object_get(before, "meshes"), i, value)
    { // the primitives have all that they had
        size_t p;
        const json_t *mesh = json_array_get(json_object_get(after, "meshes"), i);
        json_array_foreach(json_object_get(value, "primitives"), p, item)
        {
            json_t *now = json_array_get(json_object_get(mesh, "primitives"), p);
            json_object_del(now, "targets");
            assert_true(json_equal(item, now));
        }
    }
    json_decref(before);
    json_decref(after);
    free(old);
    free(new);
}

static double apart(const double *a, const double *b)
{
    return sqrt(pow(a[0] - b[0], 2) + pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2));
}

/// The largest extent of the first frame.
static double size_of(const struct points *points)
{
    double size = 0;
    for (int k = 0; k < 3; k++) {
        double low = INFINITY, high = -INFINITY;
        for (int v = 0; v < points->vertices; v++) {
            low = fmin(low, points->number[3 * v + k]);
            high = fmax(high, points->number[3 * v + k]);
        }
        size = fmax(size, high - low);
    }
    return size;
}

/// The flesh moves by 0.2 to 15 % of the size at most, everything is finite, and a clip that loops closes.
TEST_WITH(folder_make, folder_remove, strangers_get_flesh)
{
    static const struct {
        const char *file;
        char *part;
        int meshes;
        double off; ///< of the size: where takes jump by the whole of it in a frame, float times show
    } rows[] = {
        {ASSIMP "X/BCN_Epileptic.X", "B_PTail1", 3, 1e-6}, // a woman's ponytail
        {ASSIMP "X/Testwuson.X", "Neck", 1, 1e-6},         // a bull's head
        {ASSIMP "FBX/huesitos.fbx", NULL, 1, 1e-6},        // a trunk with an arm, 5 m high in centimetres
        {MINETEST "games/minetest_game/mods/player_api/models/character.b3d", NULL, 1, 5e-6}, // all takes in one clip
        {MINETEST "mods/maidroid/maidroid/models/maidroid.b3d", "Head", 1, 5e-6},
    };
    if (system("command -v assimp >/dev/null") != 0) {
        print_message("skip - assimp-utils is not installed\n");
        return;
    }
    for (int r = 0; r < quick_or_all(1, sizeof rows / sizeof *rows); r++) {
        char line[512], in[128], out[128], scene_path[128];
        if (access(rows[r].file, R_OK) != 0) {
            print_message("skip - %s is not installed\n", strncmp(rows[r].file, ASSIMP, strlen(ASSIMP))
                                                              ? "minetest-mod-maidroid"
                                                              : "assimp-testmodels");
            continue;
        }
        snprintf(in, sizeof in, "%s", folder_path("in.glb"));
        snprintf(out, sizeof out, "%s", folder_path("soft.glb"));
        snprintf(scene_path, sizeof scene_path, "%s", folder_path("soft.json"));
        snprintf(line, sizeof line, "assimp export '%s' '%s' -fglb2 >'%s.log'", rows[r].file, in, in);
        assert_int_equal(system(line), 0);
        char *words[] = {"flesh",
                         in,
                         "--tets",
                         "300",
                         "--substeps",
                         "2",
                         "-o",
                         out,
                         "--scene",
                         scene_path,
                         rows[r].part ? "--part" : NULL,
                         rows[r].part,
                         NULL};
        assert_int_equal(command_flesh(rows[r].part ? 12 : 10, words), 0);
        assert_kept(in, out);
        assert_int_equal(command_check(2, (char *[]){"check", scene_path, NULL}), 0);

        struct opened scene = open_scene(scene_path);
        const struct model_rig *model = &scene.document->rigs[0]->model;
        struct points with = read_points(export_opened(&scene, "with.npy", (struct export_options){0}));
        if (rows[r].meshes == 1) // else the motion has the vertices of all
            assert_near(glb_is_off(export_opened(&scene, "with.glb", (struct export_options){0}), model->clip, &with),
                        0, rows[r].off * size_of(&with));
        const bool loops = scene.document->splines[0]->parameter[PARAMETER_START].value == WIGGLY_LOOP;
        close_scene(&scene);
        size_t d;
        json_t *still = json_load_file(scene_path, 0, NULL), *drive;
        json_array_foreach(json_object_get(json_array_get(json_object_get(still, "rigs"), 0), "coordinates"), d,
                           drive) json_object_set_new(drive, "amplitude", json_integer(0));
        assert_int_equal(json_dump_file(still, scene_path, 0), 0);
        json_decref(still);
        scene = open_scene(scene_path);
        struct points without = read_points(export_opened(&scene, "without.npy", (struct export_options){0}));
        double most = 0, gap = 0;
        for (int n = 0; n < with.frames * with.vertices; n++) {
            const double moved = apart(with.number + 3 * n, without.number + 3 * n);
            assert_true(isfinite(moved));
            most = fmax(most, moved);
        }
        for (int v = 0; v < with.vertices; v++)
            gap = fmax(gap, apart(frame_of(&with, 0) + 3 * v, frame_of(&with, with.frames - 1) + 3 * v));
        print_message("%s: %.2f %% of the size at most%s\n", strrchr(rows[r].file, '/') + 1,
                      100 * most / size_of(&without), loops ? ", in a loop" : "");
        assert_true(most > 0.002 * size_of(&without) && most < 0.15 * size_of(&without));
        if (loops) assert_near(gap, 0, 1e-5 * size_of(&with));
        free(with.number);
        free(without.number);
        close_scene(&scene);
    }
}
