/// The table of parameters: each is one that the solver knows, in the right place; an edit of it is seen in the curve, is saved, and is
/// loaded again; and a reader of docs/scene-format.md finds it.
#include "base/file.h"
#include "scene/evaluate.h"
#include "scene/order.h"
#include "spline/desc.h"
#include "world.h"

static const char scene[] =
    "{\"wiggly\": 1, \"frames\": [0, 240], \"splines\": ["
    "{\"name\": \"a\", \"frequency\": 1.1, \"damping\": 0.1, \"calm\": 0.5, \"variation\": {\"seed\": 4, \"amount\": "
    "0.2}, \"knots\": ["
    "{\"frame\": 8, \"value\": 1}, {\"frame\": 40, \"value\": 0, \"slope\": 1}, {\"frame\": 90, \"value\": 2}]},"
    "{\"name\": \"b\", \"mode\": \"real\", \"spring\": 40, \"friction\": 1, \"variation\": {\"amount\": 0.2}, "
    "\"knots\": [{\"frame\": 8, \"value\": 1}, {\"frame\": 40, \"value\": 0, \"slope\": 1}]},"
    "{\"name\": \"c\", \"mode\": \"cubic\", \"frequency\": 0.5, \"start\": \"rest\", \"knots\": ["
    "{\"frame\": 8, \"value\": 0.4}, {\"frame\": 40, \"value\": 0.5}]}]}";

static enum desc_kind kind_in_desc(enum parameter_kind kind)
{
    if (kind == PARAMETER_CHOICE) return DESC_CHOICE;
    if (kind == PARAMETER_WHOLE) return DESC_COUNT;
    return kind == PARAMETER_TRACK ? DESC_PARAM : DESC_NUMBER;
}

static const struct parameter_row *row_at(size_t place)
{
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        if (parameter_rows[p].place == place) return &parameter_rows[p];
    }
    return NULL;
}

TEST(every_setting_of_the_solver_has_a_row)
{
    static const char *const others[] = {"samples", "step"}; // the scene's
    int found = 0;
    for (const desc_member *m = desc_members; m->name; m++) {
        bool other = strncmp(m->name, "has_", 4) == 0; // whether another one is read
        for (int i = 0; i < 2; i++) other |= strcmp(m->name, others[i]) == 0;
        const struct parameter_row *row = row_at(m->offset);
        if (other) continue;
        if (!row) fail_msg("%s has no row", m->name);
        assert_int_equal(kind_in_desc(row->kind), m->kind);
        if (row->kind == PARAMETER_CHOICE) assert_int_equal(m->size, sizeof(unsigned));
        found++;
    }
    assert_int_equal(found, PARAMETER_COUNT);
}

TEST(every_row_is_whole)
{
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        const struct parameter_row *row = &parameter_rows[p];
        assert_true(row->name && row->hint && row->undo && row->modes);
        const enum parameter first = // one member of the file for two
            p == PARAMETER_HIGH   ? PARAMETER_LOW
            : p == PARAMETER_SEED ? PARAMETER_VARIATION
                                  : p;
        assert_int_equal(parameter_find(parameter_key(p)), first);
        assert_true(row->standard >= row->minimum && row->standard <= row->maximum);
        assert_true(row->fresh >= row->minimum && row->fresh <= row->maximum);
        assert_true(row->kind == PARAMETER_CHOICE || row->step > 0);
        if (row->letter) assert_int_equal(parameter_of_letter(row->letter[0]), p);
        int words = 0;
        while (row->words[words]) assert_non_null(row->labels[words++]);
        assert_int_equal(words, row->kind == PARAMETER_CHOICE ? (int)row->maximum + 1 : 0);
    }
}

static void assert_same_curves(const struct evaluation *a, const struct evaluation *b, const char *name)
{
    for (int s = 0; s < a->count; s++) {
        size_t size = sizeof(double) * (size_t)a->samples;
        bool same = a->status[s] == b->status[s] && memcmp(a->curves[s].total, b->curves[s].total, size) == 0 &&
                    memcmp(a->curves[s].im, b->curves[s].im, size) == 0;
        if (!same) fail_msg("%s: spline %d is not solved anew", name, s);
    }
}

static void assert_round_trip(const struct world *world)
{
    char *text = text_of_document(world->document);
    struct document *again = document_of_text(text);
    for (int s = 0; s < again->spline_count; s++) {
        for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
            const struct spline *spline = world->document->splines[s];
            assert_true(spline->parameter[p].value == again->splines[s]->parameter[p].value);
            assert_int_equal(spline->parameter[p].track, again->splines[s]->parameter[p].track);
        }
    }
    document_destroy(again);
    free(text);
}

/// Another number than it has, inside its range, or another word.
static double another(const struct spline *spline, enum parameter p)
{
    double value = spline->parameter[p].value;
    if (parameter_rows[p].kind == PARAMETER_CHOICE) return value < parameter_rows[p].maximum ? value + 1 : 0;
    double edge = spline->knots[0].value; // a limit just beyond the knots, which the curve overshoots
    for (int k = 0; k < spline->knot_count; k++) {
        const double knot = spline->knots[k].value;
        if (p == PARAMETER_LOW) edge = fmin(edge, knot - 0.001);
        if (p == PARAMETER_HIGH) edge = fmax(edge, knot + 0.001);
    }
    if (parameter_rows[p].kind == PARAMETER_LIMIT) return edge;
    if (parameter_rows[p].kind == PARAMETER_WHOLE) return value + 1;
    return value > 0 ? 0.75 * value : 0.25;
}

/// Makes a parameter another with an evaluation that has solved what was there before, and compares with one that has not.
static void try_edit(int spline, enum parameter parameter, struct param param)
{
    const char *name = parameter_key(parameter);
    struct world world;
    struct evaluation kept = {0}, fresh = {0};
    world_open_scene(&world, scene);
    evaluation_update(&kept, world.document, false);
    int samples = kept.samples;
    double *before = malloc(sizeof *before * (size_t)samples);
    memcpy(before, kept.curves[spline].total, sizeof *before * (size_t)samples);
    world_must(&world, edit_parameter(world_edit(&world), spline, parameter, &param, &world.error));
    evaluation_update(&kept, world.document, false);
    evaluation_update(&fresh, world.document, false);
    assert_same_curves(&kept, &fresh, name);
    if (memcmp(before, kept.curves[spline].total, sizeof *before * (size_t)samples) == 0)
        fail_msg("%s: spline %d does not change", name, spline);
    assert_round_trip(&world);
    free(before);
    evaluation_free(&kept);
    evaluation_free(&fresh);
    world_close(&world);
}

TEST(an_edit_of_each_is_seen_and_saved)
{
    struct document *document = document_of_text(scene);
    for (int s = 0; s < document->spline_count; s++) {
        for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
            const struct spline *spline = document->splines[s];
            bool still =
                p == PARAMETER_CALM && spline_start(spline) != WIGGLY_FREE; // nothing swings before the start
            still |= p == PARAMETER_HIGH && s == 1;                         // it only falls
            if (!spline_uses(spline, p, false) || still) continue;
            try_edit(s, p, param_number(another(spline, p)));
            if (parameter_rows[p].kind == PARAMETER_TRACK) try_edit(s, p, param_track(s == 2 ? 1 : 2));
        }
    }
    document_destroy(document);
}

TEST(each_is_described)
{
    char *text, quoted[64];
    size_t size;
    assert_done(file_read("docs/scene-format.md", 1 << 20, &text, &size, &error));
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        snprintf(quoted, sizeof quoted, "`%s`", parameter_key(p));
        if (!strstr(text, quoted)) fail_msg("docs/scene-format.md does not name %s", quoted);
    }
    free(text);
}
