/// Flesh that hangs on a bone: what the bone's acceleration does to a coordinate, round after round.
#include "gltf_builder.h"
#include "rig/import.h"
#include "rig/posing.h"
#include "scene/edit.h"
#include <complex.h>

enum { KEYS = 25 };

static const double frequency = 2, damping = 0.1, along = 3, sway = 0.2;

/// A bone that lies on its side, sways once a second along the world's y, and travels along z or not; a coordinate of its mesh answers what its
/// own x feels. Or the bone stays and turns, so that a point `arm` behind it sways. From
/// the middle of the clip on it is a `jump` higher.
static const char *write_swaying(float travel, double arm, double jump)
{
    static struct builder b;
    float times[KEYS], places[KEYS][3], way[KEYS][3], turns[KEYS][4];
    char members[2048];
    b = (struct builder){0};
    for (int k = 0; k < KEYS; k++) {
        times[k] = (float)k / 24;
        const double here = sway * sin(2 * M_PI * k / 24), half = M_PI / 4 + (arm > 0 ? here / arm / 2 : 0);
        memcpy(places[k], (float[3]){0, (float)((arm > 0 ? 0 : here) + (k < KEYS / 2 ? 0 : jump)), 0},
               sizeof *places);
        memcpy(way[k], (float[3]){0, 0, travel * times[k]}, sizeof *way);
        memcpy(turns[k], (float[4]){0, 0, (float)sin(half), (float)cos(half)}, sizeof *turns);
    }
    ADD(&b, FLOAT, float, 3, 0, 0, 0, 0, 1, 0, 1, 0, 0);
    add_data(&b, FLOAT, "SCALAR", KEYS, times, sizeof times);
    add_data(&b, FLOAT, "VEC3", KEYS, places, sizeof places);
    add_data(&b, FLOAT, "VEC4", KEYS, turns, sizeof turns);
    add_data(&b, FLOAT, "VEC3", KEYS, way, sizeof way);
    snprintf(members, sizeof members,
             "'scenes':[{'nodes':[0]}],'nodes':[{'name':'root','children':[1]},{'name':'bone','children':[2]},{'mesh'"
             ":0}],'meshes':[{'extras':{"
             "'targetNames':['belly.re','belly.im'],'wiggly':{'coordinates':[{'name':'belly','frequency':%g,"
             "'damping':%g,'base':[%g,0,0],'at':[0,%g,0],'bone':'bone'}]}},'primitives':[{'attributes':{'POSITION':0}"
             ",'targets':"
             "[{'POSITION':0},{'POSITION':0}]}]}],'animations':[{'name':'Sway','samplers':[{'input':1,'output':2},"
             "{'input':1,'output':3},{'input':1,'output':4}],'channels':[{'sampler':2,'target':{'node':0,'path':'"
             "translation'}},{'sampler':0,'target':{'node':1,'path':'translation'}},"
             "{'sampler':1,'target':{'node':1,'path':'rotation'}}]}]",
             frequency, damping, along, -arm);
    return write_built(&b, "sways.gltf", members);
}

/// x is the ODE's periodic answer, also if the bone travels or only turns, and the drive shows x alone. The clip's frames are all that it needs.
TEST(flesh_answers_its_bone_and_closes)
{
    for (int way = 0; way < 3; way++) {
        struct opened opened;
        assert_done(opened_read(&opened, write_swaying(way == 1 ? 1.5f : 0, way == 2 ? 4 : 0, 0), &error));
        const struct document *document = opened.document;
        assert_int_equal(document->spline_count, 1);
        assert_int_equal(document->last_frame, 24);
        opened_solve(&opened, SOLVER_BY_LENGTH);
        const struct posing posing = opened_posing(&opened);
        const wiggly_curve *curve = &posing.evaluation->curves[0];
        const double w = 2 * M_PI, o = 2 * M_PI * frequency, size = along * sway * w * w;
        const double complex answer = size / (o * o - w * w + 2 * I * damping * o * w); // to −g · a = size sin w t
        double most = 0;
        for (int s = 0; s <= 24; s++) {
            wiggly_value values[RIG_MAX_INPUTS];
            const double wanted = cimag(answer * cexp(I * w * s / 24));
            assert_near(curve->re[s], wanted, 0.05 * cabs(answer));
            posing_values(&posing, 0, s, values);
            assert_near(curve->y[s], 0, 0);
            assert_near(curve->total[s], curve->re[s], 1e-12);
            assert_near(values[0].y, 0, 0);
            assert_near(values[0].re, curve->re[s], 1e-12);
            most = fmax(most, fabs(curve->re[s] - wanted));
        }
        print_message("off by %.2g of the amplitude\n", most / cabs(answer));
        assert_near(curve->re[24], curve->re[0], 1e-9);
        opened_free(&opened);
    }
}

/// Knots of flesh are of x, wherever the base is: a value, a slope, and a value where it settles. A still knot leaves x to the base alone.
TEST(knots_of_flesh_are_of_the_flesh)
{
    static const struct knot knots[] = {
        {.frame = 4, .value = 0.5, .has_slope = true, .slope = 3, .stiffness = KNOT_DEFAULT_STIFFNESS},
        {.frame = 12, .still = true, .stiffness = KNOT_DEFAULT_STIFFNESS},
        {.frame = 18, .value = -0.25, .settles = true, .stiffness = KNOT_DEFAULT_STIFFNESS}};
    const struct param rest = param_number(WIGGLY_REST);
    double slope = 0;                   // without a base
    for (int row = 0; row < 3; row++) { // without one; with one; and one that travels
        struct opened opened;
        assert_done(opened_read(&opened, write_swaying(row == 2 ? 1.5f : 0, 0, 0), &error));
        struct document *document = opened.document;
        const int each = document->substeps;
        assert_done(edit_parameter(document, 0, PARAMETER_START, &rest, &error));
        if (row == 0)
            assert_done(edit_parameter(document, 0, PARAMETER_EQUILIBRIUM, &(struct param){.track = -1}, &error));
        opened_solve(&opened, SOLVER_BY_LENGTH);
        const double *const total = opened.evaluation.curves[0].total;
        const double alone = total[12 * each];
        struct rig floored = *document->rigs[0];
        floored.model.has_floor = true; // far below, which solves it with the rig
        floored.model.floor = -9;
        assert_done(edit_rig_set(document, 0, &floored, &error));
        opened_solve(&opened, SOLVER_BY_LENGTH);
        assert_near(total[12 * each], alone, 1e-9);
        for (int k = 0; k < 3; k++) assert_done(edit_knot_insert(document, 0, &knots[k], &error));
        opened_solve(&opened, SOLVER_BY_LENGTH);
        assert_near(total[4 * each], 0.5, 1e-9);
        assert_near(total[12 * each], alone, 1e-9);
        assert_near(total[18 * each], -0.25, 1e-9);
        assert_near(evaluation_offset(&opened.evaluation, document, 0, 18 * each), -0.25, 1e-9);
        const double here = evaluation_slope(&opened.evaluation, document, 0, 4 * each);
        if (row == 0) slope = here;
        assert_near(here, slope, 0.5); // the base alone moves at 1.9
        opened_free(&opened);
    }
}

/// A clip of several takes jumps between them. That throws flesh no further than a steady pull at its limit would, with a swing on top.
TEST(a_jump_tears_no_flesh)
{
    struct opened opened;
    double most = 0;
    assert_done(opened_read(&opened, write_swaying(0, 0, 100), &error));
    opened_solve(&opened, SOLVER_BY_LENGTH);
    const wiggly_curve *curve = &opened.evaluation.curves[0];
    for (int s = 0; s < curve->samples; s++) most = fmax(most, fabs(curve->re[s]));
    assert_in_range((int)(10 * most), 5, 60);
    opened_free(&opened);
}
