/// A character that is soft on its own skeleton: each vertex is skin(rest + shapes), while a clip plays, chains bend and the clip moves
/// the shapes, too; its pins and its floor hold there.
#include "beast.h"
#include "model/vector.h"
#include "stand.h"
#include "temporary.h"
#include <string.h>

#define SWING                                                                                                        \
    "'splines':[{'name':'s','frequency':2,'damping':0.1,'knots':[{'frame':0,'value':0.6},{'frame':9,'value':-0.4}]}" \
    ",{'name':'t','frequency':1.3,'damping':0.1,'knots':[{'frame':0,'value':0.3}]}]"
#define TAIL                                                                                                         \
    ",{'type':'chain','name':'tail','model':'beast','from':'tail_1','to':'tail_8','channels':[{'spline':'t','axis':" \
    "'up'}]}"

/// The soft beast with more members, and rigs behind it.
static struct stand open_beast(const char *more, const char *rigs)
{
    char text[2048];
    struct stand stand;
    assert_true(beast_write_as(temporary_path("beast.glb"), true));
    snprintf(text, sizeof text,
             "{'frames':[0,24]," SWING ",'rigs':[{'type':'model','name':'beast','model':'beast.glb','coordinates':"
             "[{'name':'belly','spline':'s','amplitude':0.8,'lag':40}]%s}%s]}",
             more, rigs);
    quote(text);
    stand_open(&stand, temporary_file("beast.json", text, strlen(text)));
    stand_solve(&stand);
    return stand;
}

/// The clip's own z at a frame, and the drive's.
static void z_at(const struct stand *stand, int frame, double z[2])
{
    const wiggly_curve *curve = &stand->opened.evaluation.curves[0];
    const double lag = 40 * M_PI / 180, c = cos(lag), s = sin(lag), again = frame % 12 / 6.0;
    z[0] = 0.8 * (curve->y[frame] + curve->re[frame] * c + curve->im[frame] * s) + 0.2 * (1 - fabs(1 - again));
    z[1] = 0.8 * (curve->im[frame] * c - curve->re[frame] * s);
}

/// As glTF defines it, vertex by vertex. Re z and Im z are half as much in weights, because the file's shapes are twice as large.
TEST(a_vertex_is_the_skin_of_rest_and_shapes)
{
    static const char *const more[] = {"", ",'clip':'Walk'",
                                       ",'clip':'Walk','scale':1.5,'turn':30,'position':[1,0.5,-2]"};
    for (int r = 0; r < 6; r++) {
        struct stand stand = open_beast(more[r % 3], r < 3 ? "" : TAIL);
        const struct posing posing = opened_posing(&stand.opened);
        for (int frame = 0; frame <= 24; frame += 5) {
            struct rig_pose posed;
            double z[2];
            assert_true(rig_pose(&posing, 0, frame, &posed));
            const struct model_pose *model = &posed.model;
            const int vertices = model->figure->character.vertex_count;
            const struct coordinate *belly = &model->figure->character.coordinates[0];
            float(*places)[3] = malloc(3 * (size_t)vertices * sizeof *places);
            assert_non_null(places);
            gltf_pose_vertices(model->gltf, model->pose, BEAST_BONES, places + vertices, NULL);
            figure_vertices(model, places, NULL, NULL, NULL);
            z_at(&stand, frame, z);
            if (r % 3 == 0) z[0] -= 0.2 * (1 - fabs(1 - frame % 12 / 6.0));
            assert_near((double)model->pose->weights[0], z[0] / 2, 1e-5);
            assert_near((double)model->pose->weights[2], z[1] / 2, 1e-5);
            const mat4s root = mat4_from(model->root);
            for (int v = 0; v < vertices; v++) {
                float *expected = places[vertices + v], *single = places[2 * vertices + v];
                glm_mat4_mulv3((vec4 *)root.raw, expected, 1, expected);
                figure_vertex(model, v, single);
                for (int k = 0; k < 3; k++) {
                    assert_near((double)places[v][k], (double)expected[k], 2e-6);
                    assert_near((double)single[k], (double)places[v][k], 1e-6);
                }
                assert_near((double)belly->re[v][0],
                            0.1 * (double)(0.7f - model->figure->character.position[v][1]) *
                                cos(2.0 * (double)model->figure->character.position[v][2]),
                            1e-6);
            }
            free(places);
        }
        stand_close(&stand);
    }
}

/// The vertex that the stage shows is at the pin, in the walk, with the character moved, turned and larger, and later by its offset.
TEST(a_point_of_a_walking_character_is_pinned)
{
    static const char *const more[] = {"", ",'clip':'Walk'",
                                       ",'clip':'Walk','scale':1.5,'turn':30,'position':[1,0.5,-2]",
                                       ",'clip':'Walk','offset':2"};
    for (size_t r = 0; r < sizeof more / sizeof *more; r++) {
        struct stand stand = open_beast(more[r], TAIL);
        pin_pull pull[2];
        stand_find(&stand, 0, 9, 15, pull);
        struct pin pin = {.frame = 15, .point = 9};
        const wiggly_curve *curve = &stand.opened.evaluation.curves[0];
        for (int back = 0; back < 2; back++) { // where another x would have it: on its curve
            for (int i = 0; i < curve->samples; i++)
                curve->re[i] += back ? -0.7 : 0.7, curve->im[i] += back ? -0.2 : 0.2;
            const struct pin_point there = stand_find(&stand, 0, 9, 15, NULL);
            if (!back) memcpy(pin.to, there.at, sizeof pin.to);
        }
        assert_true(fabs(pull[0][0][0]) + fabs(pull[0][1][0]) > 0.01 && fabs(pull[1][0][0]) == 0);
        struct document *document = stand_begin(&stand);
        stand_end(&stand, edit_pin_set(document, 0, &pin, NULL));
        stand_solve(&stand);
        assert_true(length_of(stand_left(&stand, 0, 0)->way) < 1e-7);
        struct rig_pose posed;
        float place[3];
        const struct posing posing = opened_posing(&stand.opened);
        assert_true(rig_pose(&posing, 0, 15, &posed));
        figure_vertex(&posed.model, 9, place);
        for (int k = 0; k < 3; k++) assert_near((double)place[k], pin.to[k], 2e-6);
        assert_knots_are_hit(&stand);
        stand_close(&stand);
    }
}

/// The lowest height over the scene of what its coordinate moves.
static double lowest_of(const struct stand *stand)
{
    const struct posing posing = opened_posing(&stand->opened);
    float least = INFINITY;
    for (int i = 0; i < stand->opened.evaluation.samples; i++) {
        struct rig_pose posed;
        assert_true(rig_pose(&posing, 0, i, &posed));
        figure_lowest(&posed.model, &least);
    }
    return (double)least;
}

TEST(a_walking_character_stays_above_its_floor)
{
    struct stand loose = open_beast(",'clip':'Walk'", ""), kept = open_beast(",'clip':'Walk','floor':-0.012", "");
    assert_true(lowest_of(&loose) < -0.014);
    assert_true(lowest_of(&kept) > -0.0121);
    assert_true(evaluation_floor(&kept.opened.evaluation, 0)->depth < 1e-4);
    stand_close(&loose);
    stand_close(&kept);
}
