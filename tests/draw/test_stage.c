/// What a person sees on the stage, drawn offscreen: the fox and its skin; outlines without stairs; and soft characters, each the same picture
/// as of a figure that already has the shape, the place or the colours that it should be given.
#include "blind.h"
#include "draw/posed.h"
#include "gltf_builder.h"
#include "model/fox.h"
#include "models/fox_maker.h"
#include "offscreen.h"
#include "posed_tail.h"
#include "puppet.h"
#include "questions.h"

enum { JOINTS = 24, OUTLINE_WIDTH = 500, OUTLINE_HEIGHT = 200, FINE = 4 };

static int open_picture(void **state)
{
    (void)state;
    return offscreen_open(FINE * OUTLINE_WIDTH, FINE * OUTLINE_HEIGHT);
}

// --- the fox

static struct stage_view view;
static struct pose tail;
static struct models *models; ///< of its fox
static struct rig_pose fox;
static struct shot shot = {.width = 1000, .height = 400};

/// A tail lifted in a curve to the right side of its animal, its camera and its shadows.
static void arrange(double side)
{
    static struct channel channel;
    struct tail made = {.joints = JOINTS,
                        .length = 1.6,
                        .position = {param_number(0), param_number(FOX_BASE_HEIGHT), param_number(0)},
                        .channels = &channel,
                        .channel_count = 1};
    float lo[3], hi[3];
    made.rest.value[0] = 2;
    channel = (struct channel){.axis = AXIS_SIDE};
    channel.gain.value[0] = side;
    if (!models) models = models_create();
    pose_tail_in(models, &made, &(wiggly_value){.y = 1}, LOOK_WIGGLY, &tail, &fox);
    pose_bounds(&tail, lo, hi);
    look_at(&view, lo, hi, &shot);
    struct stage_model *shown = &view.models[view.model_count++];
    *shown = (struct stage_model){.posed = fox.model, .dusk = 0.35f * tail.scale};
    rig_bounds(&fox, shown->lo, shown->hi);
    view.has_tail = true;
    view.blob_count = pose_blobs(&tail, view.key_from, view.blobs, STAGE_MAX_BLOBS);
}

static void draw_tail(double side)
{
    if (!platform) skip();
    arrange(side);
    shoot(&view, &shot);
}

/// The pixel where a point of the world is seen.
static const unsigned char *pixel_of(const float world[3])
{
    const float width = (float)shot.width, height = (float)shot.height, whole[4] = {0, 0, width, height};
    float screen[2];
    assert_true(camera_project(view.view, view.projection, whole, world, screen));
    assert_true(screen[0] >= 0 && screen[0] < width && screen[1] > 0 && screen[1] <= height);
    return pixel_at(&shot, (int)screen[0], (int)(height - screen[1]));
}

static int brightness(const unsigned char *pixel) { return pixel[0] + pixel[1] + pixel[2]; }

static bool is_fur(const unsigned char *pixel) { return pixel[0] > 60 && pixel[0] > pixel[2] + 25; }

TEST(the_tail_is_drawn_where_its_joints_are)
{
    for (int side = -3; side <= 3; side += 2) {
        int fur = 0;
        draw_tail(side);
        for (int n = 2; n < JOINTS - 4; n++) fur += is_fur(pixel_of(tail.matrix[n] + 12));
        assert_true(fur >= JOINTS - 8); // a dark band may miss
        const unsigned char *tip = pixel_of(tail.matrix[JOINTS - 1] + 12);
        assert_true(brightness(tip) > 300 && abs(tip[0] - tip[2]) < 60); // the white tip
    }
}

/// Where nothing is the background is dark and even; under the animal, on its near side, the ground is darker.
TEST(ground_and_background)
{
    static const float beside[3] = {0.32f, 0, -0.25f};
    static const int background[3] = {0x1B, 0x20, 0x28};
    draw_tail(1);
    for (int i = 0; i < 3 * shot.width; i++)
        assert_near(pixel_at(&shot, i / 3, shot.height - 1)[i % 3], background[i % 3], 2);
    const int shadowed = brightness(pixel_of(beside));
    view.blob_count = 0;
    shoot(&view, &shot);
    assert_false(is_fur(pixel_of(beside)));
    assert_true(shadowed < brightness(pixel_of(beside)) - 12);
}

/// Without multisampling: coming from the left, edges of the animal cross rows of pixels at any fraction of a pixel, so
/// that the first pixel that differs from the background is as often weak as strong.
/// It fits into the stage, its top row at the top, half as strong; without it all is as before.
TEST(a_picture_is_behind_it)
{
    static const unsigned char pixels[2][4] = {{255, 0, 0, 255}, {0, 0, 255, 0}}; // red above what is not there
    const float far[3] = {0, 0, -900};
    if (!platform) skip();
    look_at(&view, far, far, &shot);
    view.colors.ground = view.colors.top = view.colors.bottom = 0x204060FF;
    shoot(&view, &shot);
    const struct shot before = shot;
    view.behind = (struct png_picture){1, 2, 4, pixels[0]};
    view.behind_id = 7;
    shoot(&view, &shot);
    for (int k = 0; k < 3; k++) {
        const int plain[] = {0x20, 0x40, 0x60}, mixed = (plain[k] + pixels[0][k]) / 2;
        assert_near(pixel_at(&shot, 500, 390)[k], mixed, 2);
        assert_near(pixel_at(&shot, 450, 390)[k], mixed, 2); // 200 wide, about 500
        assert_near(pixel_at(&shot, 380, 390)[k], plain[k], 2);
        assert_near(pixel_at(&shot, 500, 10)[k], plain[k], 2);
    }
    view.behind = (struct png_picture){0};
    shoot(&view, &shot);
    assert_int_equal(differing(&before, &shot, 0), 0);
}

TEST(silhouettes_are_soft)
{
    int rows = 0, shares[4] = {0};
    draw_tail(0);
    for (int y = shot.height / 2; y < shot.height; y++) {
        const int background = brightness(pixel_at(&shot, 0, y));
        int x = 1;
        while (x < shot.width - 3 && brightness(pixel_at(&shot, x, y)) < background + 8) x++;
        const int whole = brightness(pixel_at(&shot, x + 2, y)) - background;
        if (x == shot.width - 3 || whole < 100) continue;
        const int share = 4 * (brightness(pixel_at(&shot, x, y)) - background) / whole;
        shares[share < 0 ? 0 : share > 3 ? 3 : share]++;
        rows++;
    }
    assert_true(rows > 100);
    for (int quarter = 0; quarter < 4; quarter++) assert_true(shares[quarter] > rows / 16);
}

// --- its skin

enum { PLACES = 60 };
static struct vertex places[3 * PLACES];
static float skinned[3 * PLACES][3], normals[3 * PLACES][3]; ///< of the places, in the world

/// Bind-space vertices in, world positions and normals out: as the stage draws them, on a coat of their own.
static void skin(int count)
{
    struct gltf own;
    fox_create(FOX_LEVELS - 1, JOINTS, &own);
    struct gltf_part *coat = &own.meshes->parts[0];
    const size_t whole = (size_t)gltf_vertex_count(&own, own.node_count - 1);
    float(*place)[3] = calloc(whole, sizeof *place), (*normal)[3] = calloc(whole, sizeof *normal);
    assert_true(place && normal && count <= coat->vertex_count);
    for (int i = 0; i < count; i++) {
        memcpy(coat->position[i], places[i].position, sizeof coat->position[i]);
        memcpy(coat->normal[i], places[i].normal, sizeof coat->normal[i]);
        memset(coat->along[i], 0, sizeof coat->along[i]);
        coat->fur[i][0] = places[i].bend;
    }
    coat->vertex_count = count;
    fox_hang(coat, JOINTS);
    gltf_pose_vertices(&own, fox.model.pose, own.node_count - 1, place, normal);
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) skinned[i][k] = fox.model.root[0] * place[i][k] + fox.model.root[12 + k];
    memcpy(normals, normal, (size_t)count * sizeof *normals);
    free(place);
    free(normal);
    gltf_free(&own);
}

/// The normal of the skin is that of its surface, by finite differences. However tight a bend, places are finite and normals unit vectors: the
/// picture has no holes and no sparks.
TEST(normals_are_right_under_bending)
{
    static const double sides[] = {0, 6, 12, 45, 90, 179, 180, 5000}; // degrees a joint
    struct mesh mesh = {0};
    mesh_fox_tail(100, 40, &mesh);
    for (int i = 0; i < 3 * PLACES; i++) { // a vertex, then one beside it along each of two tangents
        const struct vertex *vertex = &mesh.vertices[(15 + i / 3) * 40 + i / 3 * 7 % 40];
        vec3 around = {-vertex->normal[1], vertex->normal[0], 0}, along;
        glm_vec3_normalize(around);
        glm_vec3_cross((float *)(uintptr_t)vertex->normal, around, along);
        places[i] = *vertex;
        if (i % 3) glm_vec3_muladds(i % 3 == 1 ? around : along, 1e-3f, places[i].position);
    }
    mesh_free(&mesh);
    for (size_t s = 0; s < sizeof sides / sizeof *sides; s++) {
        arrange(sides[s]);
        skin(3 * PLACES);
        for (int i = 0; i < 3 * PLACES; i++) {
            assert_near(glm_vec3_norm(normals[i]), 1, 1e-3);
            for (int k = 0; k < 3; k++) assert_near(skinned[i][k], 0, 3);
            if (i % 3 || sides[s] > 12) continue;
            vec3 u, v, n;
            glm_vec3_sub(skinned[i + 1], skinned[i], u);
            glm_vec3_sub(skinned[i + 2], skinned[i], v);
            glm_vec3_crossn(u, v, n);
            for (int k = 0; k < 3; k++) assert_near(normals[i][k], n[k], 0.02);
        }
    }
}

/// A straight tail is where it was made; a bent one keeps to its chain of joints.
TEST(skin_follows_the_joints)
{
    for (int n = 0; n < JOINTS; n++)
        places[n] = (struct vertex){.position = {0, 0, 1.6f * (float)n / JOINTS}, .normal = {1, 0, 0}, .bend = 1};
    for (int side = 0; side <= 8; side += 8) {
        arrange(side);
        skin(JOINTS);
        for (int i = 0; i < 3 * JOINTS; i++)
            assert_near(skinned[i / 3][i % 3], tail.matrix[i / 3][12 + i % 3], 0.015);
    }
}

/// Files have room for four influences a vertex, whose sum is 1, however many joints the tail has.
TEST(influences_fit_files)
{
    static const int joints[] = {1, 2, 3, 24, 256};
    for (size_t n = 0; n < sizeof joints / sizeof *joints; n++) {
        struct gltf own;
        fox_create(1, joints[n], &own);
        for (int p = 0; p < own.meshes->part_count; p++) {
            const struct gltf_part *part = &own.meshes->parts[p];
            for (int v = 0; v < part->vertex_count; v++) {
                float sum = 0;
                for (int k = 0; k < 4; k++) {
                    sum += part->weights[v][k];
                    assert_true(part->joints[v][k] < own.joint_count);
                }
                assert_near(sum, 1, 1e-6);
            }
        }
        gltf_free(&own);
    }
}

// --- outlines

/// A square of one metre, seen from +z, for two nodes, one of them 5 m behind, its back to the eye: each stands in its own place, and faces the
/// eye or not by itself.
TEST(nodes_stand_for_themselves)
{
    static const char nodes[] =
        "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1},'indices':2}]}],'nodes':[{'mesh':0},{},"
        "{'mesh':0,'translation':[0,0,-5],'rotation':[0,1,0,0]}]";
    static const float square[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, eye[3] = {0, 0, 10};
    struct builder b = {0};
    struct gltf gltf;
    struct gltf_pose pose;
    struct posed mesh;
    add_data(&b, FLOAT, "VEC3", 4, square, sizeof square);
    ADD(&b, FLOAT, float, 3, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1);
    ADD(&b, UBYTE, uint8_t, 1, 0, 1, 2, 0, 2, 3);
    read_text(builder_json(&b, nodes), &gltf);
    assert_true(gltf_pose_create(&gltf, &pose));
    gltf_pose_clip(&gltf, -1, 0, &pose);
    gltf_pose_world(&gltf, &pose);
    const struct stage_model shown = {
        .posed = {.gltf = &gltf, .pose = &pose, .root = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 2, 0, 0, 1}}};
    posed_from_gltf(&mesh, &gltf);
    assert_int_equal(mesh.part_count, 2);
    posed_pose(&mesh, &shown, eye);
    for (int p = 0; p < 2; p++) { // the second is turned half round
        const struct posed_part *part = &mesh.parts[p];
        int edges = 0;
        for (int v = 0; v < 4; v++) {
            const float *place = mesh.place[part->vertex + v];
            assert_near(place[0], 2 + (p ? -1 : 1) * square[v][0], 1e-6);
            assert_near(place[1], square[v][1], 1e-6);
            assert_near(place[2], p ? -5 : 0, 1e-6);
        }
        for (int at = part->first - 1; (at = skirt_next(&mesh, part, at + 1)) < part->end;) edges++;
        assert_int_equal(edges, p ? 0 : 4); // not where its triangles meet
    }
    posed_free(&mesh);
    gltf_pose_free(&pose);
    gltf_free(&gltf);
}

/// Outlines, inner ones too, are those of a much finer picture, without stairs: pixels that are off its mean over their area.
TEST(outlines_have_no_stairs)
{
    enum { BYTES = OUTLINE_WIDTH * OUTLINE_HEIGHT * 4 };
    static const struct {
        const char *scene;
        int most[2]; ///< in the dark theme and in the light one
    } rows[] = {
        {"assets/scenes/tail.json", {90, 50}}, // without skirts 103 and 74, with markings edged by distance alone 440
        {"assets/scenes/dog.json", {85, 70}},
        {"assets/scenes/character.json", {18, 45}},
    };
    static unsigned char drawn[BYTES], fine[FINE * FINE * BYTES];
    if (!platform) skip();
    for (size_t row = 0; row < sizeof rows / sizeof *rows; row++) {
        struct blind blind;
        blind_open(&blind, rows[row].scene);
        blind_frame(&blind);
        struct stage_view stage = *editor_stage(blind.app.work.editor);
        for (int t = 0; t < 2; t++) {
            int rough = 0;
            theme_use(t ? THEME_LIGHT : THEME_DARK);
            stage.colors = theme()->stage;
            offscreen_draw(&stage, OUTLINE_WIDTH, OUTLINE_HEIGHT, drawn);
            offscreen_draw(&stage, FINE * OUTLINE_WIDTH, FINE * OUTLINE_HEIGHT, fine);
            for (int i = 0; i < OUTLINE_WIDTH * OUTLINE_HEIGHT; i++) {
                const unsigned char *from =
                    fine + 4 * FINE * (i / OUTLINE_WIDTH * FINE * OUTLINE_WIDTH + i % OUTLINE_WIDTH);
                bool is_off = false;
                for (int k = 0; k < 3; k++) {
                    int sum = 0;
                    for (int f = 0; f < FINE * FINE; f++)
                        sum += from[4 * (f / FINE * FINE * OUTLINE_WIDTH + f % FINE) + k];
                    is_off |= abs(drawn[4 * i + k] - sum / (FINE * FINE)) > 60;
                }
                rough += is_off;
            }
            if (rough > rows[row].most[t])
                fail_msg("%s: expected at most %d rough pixels, got %d", rows[row].scene, rows[row].most[t], rough);
        }
        blind_close(&blind);
    }
    theme_use(THEME_DARK);
}

// --- soft characters

static struct shot one = {.width = 500, .height = 300}, other = {.width = 500, .height = 300},
                   third = {.width = 500, .height = 300};

/// A puppet, and how it is shown.
static struct stage_model shown(const struct imported *imported)
{
    static const float origin[3];
    return (struct stage_model){.posed = puppet_pose(imported, origin),
                                .dusk = 0.3f * (imported->gltf.hi[1] - imported->gltf.lo[1]),
                                .lo = {-1, 0, -1},
                                .hi = {1, 1.5f, 1},
                                .map_coordinate = -1};
}

static struct stage_model mapped(const struct imported *imported, int axis)
{
    struct stage_model model = shown(imported);
    model.map_coordinate = 1;
    model.map_axis = axis;
    return model;
}

static void draw_all(const struct stage_model *shown_models, int count, struct shot *out)
{
    const float lo[3] = {-1, 0, -1}, hi[3] = {1, 1.5f, 1};
    if (!platform) skip();
    look_at(&view, lo, hi, out);
    memcpy(view.models, shown_models, (size_t)count * sizeof *shown_models);
    view.model_count = count;
    shoot(&view, out);
}

static void draw(struct stage_model model, struct shot *out) { draw_all(&model, 1, out); }

/// Weights work on re and im with their signs: z Ñ = (3 + 4j)(0.12 − 0.16j) = 1 moves as far as another place does; the
/// second coordinate adds to it. Several rigs may show the same figure.
TEST(coordinates_move_it)
{
    struct character character = puppet_character(0.05f, 3);
    for (int i = 0; i < character.vertex_count; i++) {
        character.coordinates[0].re[i][0] = 9; // not driven
        character.coordinates[1].re[i][0] = 0.12f;
        character.coordinates[1].im[i][0] = -0.16f;
        character.coordinates[2].re[i][1] = 0.5f;
    }
    struct imported figure = puppet_imported(&character);
    struct stage_model moved = shown(&figure), placed = shown(&figure);
    moved.posed.morph = (struct morph){2, {1, 2}, {{1.5f, 2}, {0.5f, 9}}};
    moved.posed.root[12] = -0.5f;
    placed.posed.morph = (struct morph){1, {2}, {{0.5f, 0}}};
    draw(moved, &one);
    draw(placed, &other);
    assert_true(differing(&one, &other, 2) < 20);
    draw(shown(&figure), &other);
    assert_true(differing(&one, &other, 20) > 1000);

    struct stage_model both[2] = {shown(&figure), shown(&figure)};
    both[0].posed.root[12] = -0.5f;
    both[1].posed.root[12] = 0.5f;
    draw_all(both, 2, &other);
    for (int c = 0; c < 2; c++) {
        draw(both[c], &one);
        assert_true(differing(&one, &other, 20) > 1000);
    }
    imported_free(&figure);
}

/// A ball that is stretched by its coordinate looks like one that was made so, light and all.
TEST(normals_follow_on_the_stage)
{
    struct character soft = puppet_character(0.05f, 1), firm = puppet_character(0.05f, 1);
    for (int i = 0; i < soft.vertex_count; i++) {
        const float *p = soft.position[i], *n = soft.normal[i];
        soft.coordinates[0].im[i][0] = -0.8f * p[0] - 0.5f * p[1];
        firm.position[i][0] += 0.8f * p[0] + 0.5f * p[1];
        // Cofactors of ((1.8, 0.5, 0), (0, 1, 0), (0, 0, 1)).
        memcpy(firm.normal[i], (const float[]){n[0], 1.8f * n[1] - 0.5f * n[0], 1.8f * n[2]}, sizeof firm.normal[i]);
        glm_vec3_normalize(firm.normal[i]);
    }
    struct imported soft_figure = puppet_imported(&soft), firm_figure = puppet_imported(&firm);
    struct stage_model moved = shown(&soft_figure);
    moved.posed.morph = (struct morph){1, {0}, {{0, 1}}};
    draw(moved, &one);
    draw(shown(&firm_figure), &other);
    assert_true(differing(&one, &other, 6) < 60);
    imported_free(&soft_figure);
    imported_free(&firm_figure);
}

/// What is painted after a figure was drawn reaches the GPU: the picture is that of a figure which was made so, and of the plain
/// one when the paint is gone.
TEST(paint_shows_on_the_stage)
{
    struct character plain = puppet_character(0.05f, 2), made = puppet_character(0.05f, 2);
    float(*paint)[2] = calloc(2 * (size_t)plain.vertex_count, sizeof *paint);
    assert_non_null(paint);
    for (int i = 0; i < plain.vertex_count; i++) {
        const float y = plain.position[i][1], turn = y > 0.6f ? 3 * (y - 0.6f) : 0;
        plain.coordinates[1].re[i][0] = 0.3f;
        made.coordinates[1].re[i][0] = 0.3f * cosf(turn);
        made.coordinates[1].im[i][0] = 0.3f * sinf(turn);
        paint[plain.vertex_count + i][1] = turn;
    }
    struct imported plain_figure = puppet_imported(&plain), made_figure = puppet_imported(&made);
    struct painted *painted = painted_create(&plain_figure.figure);
    assert_non_null(painted);
    struct stage_model moved = shown(&plain_figure), expected = shown(&made_figure);
    moved.posed.figure = &painted->figure;
    moved.posed.morph = expected.posed.morph = (struct morph){1, {1}, {{0.4f, 0.8f}}};
    draw(moved, &third);
    painted_update(painted, (const float(*)[2])paint);
    draw(moved, &one);
    draw(expected, &other);
    assert_true(differing(&one, &other, 2) < 20);
    assert_true(differing(&one, &third, 20) > 1000);
    painted_update(painted, NULL);
    draw(moved, &other);
    assert_int_equal(differing(&other, &third, 0), 0);
    painted_destroy(painted);
    imported_free(&plain_figure);
    imported_free(&made_figure);
    free(paint);
}

/// A puppet whose phase along z is `phase` at its feet and grows by `more` a metre upwards.
static struct character phased(float phase, float more)
{
    struct character character = puppet_character(0.05f, 2);
    for (int i = 0; i < character.vertex_count; i++) {
        const float y = character.position[i][1], angle = phase + more * y;
        character.coordinates[1].re[i][2] = y * cosf(angle);
        character.coordinates[1].im[i][2] = y * sinf(angle);
    }
    return character;
}

/// Draws a figure twice: by the shader's phase map into `one`, painted with the legend's colours into `other`; without motion into `third`.
static void draw_mapped(float phase, float more)
{
    struct character character = phased(phase, more), painted = puppet_character(0.05f, 1);
    struct imported figure = puppet_imported(&character);
    const struct coordinate *c = &figure.figure.character.coordinates[1];
    const float largest = figure.figure.largest[1][2];
    for (int i = 0; i < painted.vertex_count; i++)
        phase_color_linear(c->re[i][2] / largest, c->im[i][2] / largest, painted.color[i]);
    struct imported painted_figure = puppet_imported(&painted);
    draw(mapped(&figure, 2), &one);
    draw(shown(&painted_figure), &other);
    draw(mapped(&figure, 0), &third);
    imported_free(&painted_figure);
    imported_free(&figure);
}

/// The shader's phase map has the legend's colours, all around; where nothing moves it is grey. Between two eighths of a turn there is a thin
/// dark line, wherever on the circle; it has no gap to either side of where half a turn ahead is half a turn behind.
TEST(phases_are_the_legends_colours_and_a_line_divides_eighths)
{
    for (int eighth = 0; eighth < 8; eighth++) {
        int rows = 0, lit = 0;
        draw_mapped((float)eighth * 0.785398163f - 0.15f, 0.3f);
        assert_int_equal(differing(&one, &other, 2), 0);
        assert_true(differing(&third, &other, 20) > 1000);
        draw_mapped(((float)eighth + 0.5f) * 0.785398163f - 0.45f, 0.7f);
        for (int y = 0; y < one.height; y++) {
            int dark = 0;
            for (int x = 0; x < one.width; x++) {
                const int darker = pixel_at(&other, x, y)[1] - pixel_at(&one, x, y)[1];
                dark += darker > 15;
                lit += -darker > 2;
            }
            rows += dark > 0;
        }
        assert_int_equal(lit, 0);
        assert_in_range(differing(&one, &other, 15), 20, 1000);
        assert_in_range(rows, 1, one.height / 4);
    }
}

/// Draws a figure's phase map and its own colours: a coat, and eyes where it is high up.
static void draw_with_eyes(float coat, float eyes, struct shot *map, struct shot *plain)
{
    struct character character = phased(0.5f, 0.3f);
    for (int i = 0; i < character.vertex_count; i++)
        for (int k = 0; k < 3; k++) character.color[i][k] = character.position[i][1] > 0.9f ? eyes : coat;
    struct imported figure = puppet_imported(&character);
    draw(mapped(&figure, 2), map);
    draw(shown(&figure), plain);
    imported_free(&figure);
}

/// Dark eyes on a coat stay as they are; a coat that is dark all over has phases all over.
TEST(eyes_stay_on_the_phase_map)
{
    int kept = 0, changed = 0;
    draw_with_eyes(0.4f, 0.4f, &third, &other);
    draw_with_eyes(0.01f, 0.01f, &one, &other);
    assert_int_equal(differing(&one, &third, 2), 0);
    draw_with_eyes(0.4f, 0.01f, &one, &other);
    for (int i = 0; i < one.width * one.height; i++) {
        const int map = one.pixel[i][0], own = other.pixel[i][0];
        const bool is_eye = map + 90 < third.pixel[i][0];
        kept += is_eye && abs(map - own) <= 2;
        changed += is_eye && abs(map - own) > 2; // at their rim
    }
    assert_true(kept > 500);
    assert_true(changed < kept / 10);
}

TESTS_BETWEEN(open_picture, offscreen_close)
