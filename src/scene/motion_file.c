/// The joint that a spline follows: { "model": "walk", "joint": "hips", "of": "turn", "gain": 1 }.
#include "base/need.h"
#include "scene/fields.h"
#include <stdlib.h>

const char *const motion_words[] = {
    [MOTION_TURN] = "turn", [MOTION_ACROSS] = "across", [MOTION_UP] = "up", [MOTION_KINDS] = NULL};

const struct field motion_fields[] = {
    {FIELD("model", FIELD_MODEL, struct joint_motion, model), .is_required = true,
     .flag = offsetof(struct joint_motion, by_file)},
    {FIELD("joint", FIELD_TEXT, struct joint_motion, joint), .is_required = true},
    {FIELD("of", FIELD_WORD, struct joint_motion, of), .words = motion_words, .is_required = true},
    {FIELD("gain", FIELD_NUMBER, struct joint_motion, gain), .range = FIELD_ANY, .usual = {1}},
    {FIELD("chain", FIELD_TEXT, struct joint_motion, chain)},
    FIELD_END(struct joint_motion),
};

bool motion_equals(const struct joint_motion *a, const struct joint_motion *b)
{
    return a == b || (a && b && fields_equal(motion_fields, a, b));
}

struct joint_motion *motion_create(const struct joint_motion *motion)
{
    struct joint_motion *copy = need(1, sizeof *copy);
    *copy = *motion;
    atomic_init(&copy->holders, 1);
    fields_copy(motion_fields, copy);
    return copy;
}

void motion_hold(struct joint_motion *motion)
{
    if (motion) atomic_fetch_add(&motion->holders, 1);
}

void motion_drop(struct joint_motion *motion)
{
    if (!motion || atomic_fetch_sub(&motion->holders, 1) > 1) return;
    fields_free(motion_fields, motion);
    free(motion);
}

static bool has_chain(const struct document *document, const struct joint_motion *motion, struct error *error)
{
    return !motion->chain || document_find_chain(document, motion->chain) >= 0 ||
           fail(error, ERROR_INPUT, "expected the name of a chain, got \"%s\"", motion->chain);
}

bool motion_check(const struct document *document, struct joint_motion *motion, struct error *error)
{
    return fields_check(document, JOINTS_UNKNOWN, motion_fields, motion, error) && has_chain(document, motion, error);
}

void motion_load(struct reader *reader, const struct value *object, struct param *param)
{
    const int errors = reader->errors;
    struct joint_motion *motion = need_zeroed(1, sizeof *motion);
    atomic_init(&motion->holders, 1);
    object_load(reader, object, motion_fields, motion);
    if (reader->errors == errors)
        *param = (struct param){.track = -1, .motion = motion};
    else
        motion_drop(motion);
}

void resolve_motions(struct reader *reader, const struct value *scene)
{
    const struct document *document = reader->document;
    const struct value splines = reader_member(scene, "splines");
    for (int s = 0; s < document->spline_count; s++) {
        struct joint_motion *motion = document->splines[s]->parameter[PARAMETER_EQUILIBRIUM].motion;
        const struct value spline = reader_element(&splines, s);
        const struct value object = reader_member(&spline, parameter_rows[PARAMETER_EQUILIBRIUM].name);
        const struct value model = reader_member(&object, "model"), chain = reader_member(&object, "chain");
        struct error error;
        if (!motion) continue;
        if (!model_find(document, motion->model, &motion->by_file, &error))
            reader_fail(reader, &model.at, "%s", error.text);
        if (!has_chain(document, motion, &error)) reader_fail(reader, &chain.at, "%s", error.text);
    }
}
