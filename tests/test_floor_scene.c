/// A character's floor: no vertex below it at any sample, knots and pins met as ever, whatever was edited before.
#include "near.h"

#include "base/clock.h"
#include "model/morph.h"
#include "rig/opened.h"
#include "rig/pinning.h"
#include "scene/edit.h"
#include "scene/load.h"
#include "temporary.h"
#include <stdlib.h>
#include <string.h>

static struct opened open_scene(const char *start, const char *knots, const char *more)
{
    char text[4096], folder[2048];
    struct opened opened;
    struct error error = {0};
    if (!realpath("assets/models", folder)) fail_msg("no assets");
    snprintf(text, sizeof text,
             "{ \"wiggly\": 1, \"fps\": 24, \"frames\": [0, 120], \"splines\": ["
             "{ \"name\": \"up\", \"frequency\": 1, \"damping\": 0.1, \"start\": \"%s\", \"knots\": [%s] },"
             "{ \"name\": \"side\", \"frequency\": 0.8, \"damping\": 0.1, \"start\": \"%s\", \"knots\": [] } ],"
             "\"rigs\": [ { \"type\": \"character\", \"name\": \"creature\", \"model\": \"%s/creature.glb\", "
             "\"coordinates\": [ { \"name\": \"up\", \"spline\": \"up\" }, { \"name\": \"side\", \"spline\": \"side\" } ]%s } ] }",
             start, knots, start, folder, more);
    const char *path = temporary_file("floor.json", text, strlen(text));
    if (!opened_read(&opened, path, &error)) fail_msg("%s", error.text);
    assert_true(opened_solve(&opened, WIGGLY_CHAIN, &error));
    return opened;
}

static double lowest(const struct opened *opened, int sample)
{
    struct rig_pose pose;
    double low = INFINITY;
    const struct posing posing = opened_posing(opened);
    assert_true(rig_pose(&posing, 0, sample, NULL, &pose));
    const struct figure *figure = pose.character.figure;
    for (int v = 0; v < figure->character.vertex_count; v++) {
        float at[3];
        morph_vertex(figure, &pose.character.morph, v, at, NULL);
        low = fmin(low, (double)(at[1] + pose.character.position[1] - figure->lo[1]));
    }
    return low;
}

static void probe(const char *start, const char *knots, const char *more)
{
    struct opened o = open_scene(start, knots, more);
    double low = INFINITY, most = 0; int at = 0;
    for (int i = 0; i < o.evaluation.samples; i++) { double l = lowest(&o, i); if (l < low) low = l, at = i; most = fmax(most, fabs(o.evaluation.curves[0].total[i])); }
    const struct floor_left *left = evaluation_floor(&o.evaluation, 0);
    double t = clock_now();
    for (int k = 0; k < 20; k++) evaluation_update(&o.evaluation, o.document, NULL, false);
    t = (clock_now() - t) / 20;
    printf("%s [%s] %s: lowest %g at %d, largest %g; left %g at %d; %.3f ms\n", start, knots, more, low, at, most, left ? left->depth : -1, left ? left->sample : -1, t * 1e3);
    opened_free(&o);
}

static void test_probe(void **state)
{
    (void)state;
    for (int v = 3; v <= 12; v += 3) { char k[200]; snprintf(k, sizeof k, "{ \"frame\": 0, \"value\": 0 }, { \"frame\": 20, \"value\": %d }", v); probe("free", k, ""); probe("free", k, ", \"floor\": 0"); snprintf(k, sizeof k, "{ \"frame\": 0, \"value\": 0 }, { \"frame\": 20, \"value\": %d }", -v); probe("free", k, "");probe("free", k, ", \"floor\": 0"); }
    const char *knots = "{ \"frame\": 0, \"value\": 0 }, { \"frame\": 20, \"value\": 5 }, { \"frame\": 40, \"value\": 2.0 }";
    const char *starts[] = {"free", "loop", "rest"};
    for (int k = 0; k < 3; k++) {
        probe(starts[k], knots, "");
        probe(starts[k], knots, ", \"floor\": 0");
        probe(starts[k], knots, ", \"floor\": -0.02");
        probe(starts[k], knots, ", \"floor\": -0.1");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_probe)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
