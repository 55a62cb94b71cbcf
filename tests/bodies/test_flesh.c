/// `wiggly flesh`: what it finds in a skinned mesh moves as the same body does on a base that moves; and all else in the file stays.
#include "base/file.h"
#include "beast.h"
#include "commands/shaking.h"
#include "model/character.h"
#include "near.h"
#include "scene/rig.h"
#include "temporary.h"
#include <complex.h>

enum { ROUND = 16, RINGS = 9, VERTICES = ROUND * RINGS + 2 };

/// Runs `wiggly flesh` with words that are apart by one space; in them %s are the paths, the third one that of paint.
static int flesh(const char *format, const char *from, const char *to)
{
    char line[2048], *words[64], *rest = line;
    int count = 0;
    snprintf(line, sizeof line, format, from, to, temporary_path("paint.npy")); // NOLINT
    for (char *word; (word = strsep(&rest, " "));) words[count++] = word;
    words[count] = NULL;
    return command_flesh(count, words);
}

static float position[VERTICES][3];
static uint16_t triangles[6 * ROUND * RINGS];

/// A ball of radius ½ around (0, 1, 0).
static void make_ball(void)
{
    uint16_t *to = triangles;
    for (int v = 0; v < VERTICES; v++) {
        const int ring = v == 0 ? 0 : v == VERTICES - 1 ? RINGS + 1 : 1 + (v - 1) / ROUND;
        const double down = M_PI * ring / (RINGS + 1), turn = 2 * M_PI * ((v - 1) % ROUND) / ROUND;
        position[v][0] = (float)(0.5 * sin(down) * sin(turn));
        position[v][1] = (float)(1 + 0.5 * cos(down));
        position[v][2] = (float)(0.5 * sin(down) * cos(turn));
    }
    for (int i = 0; i < ROUND * RINGS;
         i++) { // below each vertex a quad, at the top and below the last ring a triangle
        const int next = i % ROUND == ROUND - 1 ? i + 1 - ROUND : i + 1;
        const int below = i + ROUND < ROUND * RINGS ? 1 + i + ROUND : VERTICES - 1;
        const int other = i + ROUND < ROUND * RINGS ? 1 + next + ROUND : VERTICES - 1;
        const int quad[6] = {1 + i, below, 1 + next, 1 + next, below, other};
        for (int k = 0; k < (below == other ? 3 : 6); k++) *to++ = (uint16_t)quad[k];
        const int top[3] = {0, 1 + i, 1 + next};
        for (int k = 0; i < ROUND && k < 3; k++) *to++ = (uint16_t)top[k];
    }
    assert_int_equal(to - triangles, 6 * ROUND * RINGS);
}

/// The ball on one bone, with a shape of its own that a clip moves by keys in a second buffer. Returns the path.
static const char *write_ball(void)
{
    static struct builder b;
    static float weights[VERTICES][4];
    static uint8_t joints[VERTICES][4];
    b = (struct builder){0};
    make_ball();
    for (int v = 0; v < VERTICES; v++) weights[v][0] = 1;
    add_data(&b, FLOAT, "VEC3", VERTICES, position, sizeof position);
    add_data(&b, UBYTE, "VEC4", VERTICES, joints, sizeof joints);
    add_data(&b, FLOAT, "VEC4", VERTICES, weights, sizeof weights);
    add_data(&b, USHORT, "SCALAR", 6 * ROUND * RINGS, triangles, sizeof triangles);
    ADD(&b, FLOAT, float, 16, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1);
    ADD(&b, FLOAT, float, 1, 0, 1, 2);
    b.buffers = ",{'byteLength':12,'uri':'data:application/octet-stream;base64,AAAAAAAAAD8AAIA+'}"; // 0, 0.5, 0.25
    strcat(b.views, ",{'buffer':1,'byteLength':12}");
    add_accessor(&b, FLOAT, "SCALAR", 3, ",'bufferView':6");
    add_accessor(&b, FLOAT, "VEC3", VERTICES, ""); // a shape of zeros
    return write_built(&b, "ball.gltf",
                       "'scene':0,'scenes':[{'nodes':[0,1]}],'nodes':[{'name':'bone','translation':[0,1,0]},"
                       "{'mesh':0,'skin':0,'weights':[0.75]}],'skins':[{'joints':[0],'inverseBindMatrices':4}],"
                       "'meshes':[{'name':'ball','extras':{'mine':[1,2],'targetNames':['smile']},'primitives':[{"
                       "'attributes':{'POSITION':0,'JOINTS_0':1,'WEIGHTS_0':2},'indices':3,"
                       "'targets':[{'POSITION':7}]}]}],'animations':[{'channels':[{'sampler':0,'target':"
                       "{'node':1,'path':'weights'}}],'samplers':[{'input':5,'output':6}]}]");
}

#define BALL "flesh %s --tets 400 --depth 0.2 --damping 0.1 --substeps 3 -o %s"

/// The first coordinate, driven by its three numbers, against the same body simulated on a base that swings aslant.
TEST(a_coordinate_answers_the_base_as_the_body_does)
{
    static const double hertz[] = {1.3, 2, 2.6}, line[1][2][3] = {{{0, 1, 0}, {0, 1, 0}}}, held[VERTICES];
    const double direction[3] = {0.6, 0.8, 0};
    struct character character;
    struct surface surface = {.vertex_count = VERTICES, .index_count = 6 * ROUND * RINGS};
    assert_int_equal(flesh(BALL, write_ball(), temporary_path("ball.glb")), 0);
    assert_done(character_read(temporary_path("ball.glb"), &character, &error));
    assert_true(character.coordinate_count >= 3);
    const struct coordinate *c = &character.coordinates[0];
    assert_string_equal(c->bone, "bone");
    surface.position = position;
    surface.indices = character.indices;

    for (int row = 0; row < 3; row++) {
        struct shaking by = shaking_default();
        struct soft soft;
        struct record record;
        by.name = "ball";
        by.soft.tets = 400;
        by.soft.shake = &by.shake;
        by.soft.pin = (struct region){.kind = REGION_BONES, .size = 0.2, .line = line, .line_count = 1, .held = held};
        by.damping = 0.1;
        assert_null(shaking_check(&by));
        shaking_drive(&by, DRIVE_SINE);
        assert_done(soft_create(&soft, &surface, "ball", &by.soft, &error));
        memcpy(by.drive.direction, direction, sizeof direction);
        by.drive.frequency = hertz[row];
        by.drive.size = 0.005;
        by.drive.seconds = by.seconds = 8 / hertz[row];
        by.fps = 24 * hertz[row];
        by.loads.drive = &by.drive;
        by.substeps = 2;
        assert_done(record_create(&record, &by, &soft, &error));

        // Along Re Ñ over the last three periods: of the body, and of Re(x Ñ) of the coordinate.
        double complex body = 0, swing = 0;
        double q = 0, v = 0, norm = 0, turned = 0;
        float(*at)[3] = calloc(VERTICES, sizeof *at);
        const double omega = 2 * M_PI * c->frequency, decay = c->damping * omega,
                     g = c->base[0] * direction[0] + c->base[1] * direction[1];
        for (int n = 0; n < 3 * VERTICES; n++) {
            norm += pow((double)c->re[n / 3][n % 3], 2);
            turned += (double)c->re[n / 3][n % 3] * (double)c->im[n / 3][n % 3];
        }
        for (int frame = 0; frame < record.frames; frame++) {
            const double complex wave = cexp(-2 * M_PI * I * frame / 24);
            double along = 0;
            record_embed(&record, frame, &soft, (const double[3]){0}, at);
            for (int n = 0; n < 3 * VERTICES; n++)
                along += (double)(at[n / 3][n % 3] - position[n / 3][n % 3]) * (double)c->re[n / 3][n % 3];
            if (frame >= record.frames - 72) {
                body += along * wave;
                swing += (q * norm + (v + decay * q) / sqrt(omega * omega - decay * decay) * turned) * wave;
            }
            for (int k = 0; k < 200; k++) { // symplectic Euler in small steps
                const double h = 1 / by.fps / 200, a = drive_acceleration(&by.drive, frame / by.fps + k * h);
                v += h * (-g * a - 2 * decay * v - omega * omega * q);
                q += h * v;
            }
        }
        const double complex ratio = swing / body;
        print_message("%g Hz: amplitude %.3f of the body's, phase %.1f degrees ahead\n", hertz[row], cabs(ratio),
                      carg(ratio) * 180 / M_PI);
        assert_near(cabs(ratio), 1, 0.1);
        assert_near(carg(ratio) * 180 / M_PI, 0, 10);
        free(at);
        record_free(&record);
        soft_free(&soft);
    }
    character_free(&character);
}

/// Names, weights and clips of shapes that the mesh has already.
TEST(shapes_that_a_mesh_has_stay)
{
    static const float keys[] = {0, 0.5f, 0.25f};
    struct gltf gltf;
    assert_int_equal(flesh(BALL, write_ball(), temporary_path("ball.glb")), 0);
    assert_int_equal(flesh(BALL " --modes 1", temporary_path("ball.glb"), temporary_path("again.glb")), 0);
    assert_done(gltf_read(temporary_path("again.glb"), &gltf, &error));
    const struct gltf_mesh *mesh = &gltf.meshes[0];
    const struct gltf_channel *channel = &gltf.clips[0].channels[0];
    const int targets = mesh->target_count;
    assert_true(targets >= 9); // smile, three coordinates, and then one
    assert_string_equal(gltf_target_name(mesh, 0), "smile");
    assert_string_equal(gltf_target_name(mesh, 1), "flesh.re");
    assert_string_equal(gltf_target_name(mesh, targets - 1), targets == 9 ? "flesh-4.im" : "flesh-5.im");
    assert_int_equal(channel->components, targets);
    assert_near(gltf.nodes[1].first_weight, 0, 0);
    assert_near(gltf.weights[0], 0.75, 0);
    for (int n = 0; n < 3 * targets; n++) assert_near(channel->values[n], n % targets ? 0 : keys[n / targets], 0);
    gltf_free(&gltf);
}

/// The bytes of a .glb's buffer; the caller frees `*data`.
static const char *read_chunk(const char *path, char **data, size_t *size)
{
    assert_done(file_read(path, 1 << 24, data, size, &error));
    uint32_t json, chunk;
    memcpy(&json, *data + 12, 4);
    memcpy(&chunk, *data + 20 + json, 4);
    *size = chunk;
    return *data + 28 + json;
}

/// Of the beast the part alone moves, by its share, or what is far from the bones; its skin, clips and all their bytes stay.
TEST(flesh_moves_the_part_alone)
{
    static const struct {
        const char *line, *bone, *bones; ///< the bone that carries it; all bones with the names' start move
        double depth;                    ///< held this far from the bones
    } rows[] = {{"flesh %s --tets 100 --substeps 2 --part tail_1 -o %s", "tail_1", "tail", 0},
                {"flesh %s --tets 100 --substeps 2 --part ear_L_2 --part ear_R_1 -o %s", "head", "ear", 0},
                {"flesh %s --tets 700 --substeps 2 --depth 0.05 -o %s --part %s", NULL, "spine", 0.05},
                {"flesh %s --tets 700 --substeps 2 --depth 0.09 -o %s", NULL, "", 0.09}};
    char from[512], to[512];
    strcpy(from, temporary_path("beast.glb"));
    strcpy(to, temporary_path("soft.glb"));
    struct beast_bone bones[BEAST_BONES];
    beast_bones(bones);
    assert_true(beast_write(from));
    struct paint *paint = paint_create(2, 8 * BEAST_BONES); // raises the amplitude of the spine alone
    for (int n = 0; n < 2 * paint->vertices; n++) {
        const bool spine = strcmp(bones[n % paint->vertices / 8].name, "spine") == 0;
        paint->values[n][0] = spine && n < paint->vertices ? 0.5f : -1;
    }
    assert_done(paint_write(paint, temporary_path("paint.npy"), &error));
    paint_drop(paint);
    for (size_t row = 0; row < sizeof rows / sizeof *rows; row++) {
        struct character character;
        char *before, *after;
        size_t size, larger;
        assert_int_equal(flesh(rows[row].line, from, to), 0);
        const char *bytes = read_chunk(from, &before, &size), *others = read_chunk(to, &after, &larger);
        assert_true(larger > size);
        assert_memory_equal(bytes, others, size);
        free(before);
        free(after);
        assert_done(character_read(to, &character, &error));
        assert_true(character.coordinate_count > 0);
        bool moved = false;
        for (int i = 0; i < character.coordinate_count; i++) {
            const struct coordinate *c = &character.coordinates[i];
            if (rows[row].bone) assert_string_equal(c->bone, rows[row].bone);
            for (int v = 0; v < character.vertex_count; v++) {
                const struct beast_bone *bone = &bones[v / 8];
                const bool moves = c->re[v][0] != 0 || c->re[v][1] != 0 || c->re[v][2] != 0;
                const bool may = strncmp(bone->name, rows[row].bones, strlen(rows[row].bones)) == 0 &&
                                 bone->half * (float)M_SQRT2 > (float)rows[row].depth;
                if (moves && !may) fail_msg("row %zu: %s moves", row, bone->name);
                moved |= moves;
            }
        }
        assert_true(moved);
        character_free(&character);
    }
}
