/// Copies, compares, reads and prints what follows a joint: { "model": "walk", "joint": "hips", "of": "turn", "gain": 1 }.
#include "base/need.h"
#include "scene/members.h"
#include "scene/reader.h"
#include <stdlib.h>
#include <string.h>

const char *const motion_words[] = {
    [MOTION_TURN] = "turn", [MOTION_ACROSS] = "across", [MOTION_UP] = "up", [MOTION_KINDS] = NULL};

static bool same_text(const char *a, const char *b) { return a == b || (a && b && strcmp(a, b) == 0); }

bool motion_equals(const struct joint_motion *a, const struct joint_motion *b)
{
    if (a == b || !a || !b) return a == b;
    return a->of == b->of && a->by_file == b->by_file && same_text(a->model, b->model) &&
           same_text(a->joint, b->joint) && same_text(a->chain, b->chain);
}

struct joint_motion *motion_create(const struct joint_motion *motion)
{
    struct joint_motion *copy = need(1, sizeof *copy);
    *copy = *motion;
    atomic_init(&copy->holders, 1);
    copy->model = need_text(motion->model);
    copy->joint = need_text(motion->joint);
    copy->chain = motion->chain ? need_text(motion->chain) : NULL;
    return copy;
}

void motion_hold(struct joint_motion *motion)
{
    if (motion) atomic_fetch_add(&motion->holders, 1);
}

void motion_drop(struct joint_motion *motion)
{
    if (!motion || atomic_fetch_sub(&motion->holders, 1) > 1) return;
    free(motion->model);
    free(motion->joint);
    free(motion->chain);
    free(motion);
}

json_t *reader_motion(struct reader *reader, const struct value *object, struct param *param)
{
    static const char *const known[] = {"model", "joint", "of", "gain", "chain", NULL};
    const struct value chain = reader_member(object, "chain");
    struct joint_motion motion = {.model = reader_name(reader, reader_member(object, "model")),
                                  .joint = reader_name(reader, reader_member(object, "joint"))};
    const int of = reader_word(reader, reader_member(object, "of"), motion_words, -1);
    double gain = 1;
    bool good = reader_number(reader, reader_member(object, "gain"), false, range_any, &gain);
    if (chain.json) good &= (motion.chain = reader_name(reader, chain)) != NULL;
    if (good && of >= 0 && motion.model && motion.joint) {
        motion.of = (enum motion_of)of;
        *param = (struct param){0, -1, motion_create(&motion), gain};
    }
    free(motion.model);
    free(motion.joint);
    free(motion.chain);
    return reader_extra(reader, object, known);
}

static void check_motion(struct reader *reader, const struct value *object, const struct joint_motion *motion)
{
    const struct document *document = reader->document;
    const struct value model = reader_member(object, "model"), chain = reader_member(object, "chain");
    if (document_find_model(document, motion->model, motion->by_file) < 0) {
        reader_fail(reader, &model.at, "expected the name or file of a model rig, got \"%s\"", motion->model);
    }
    if (motion->chain && document_find_chain(document, motion->chain) < 0) {
        reader_fail(reader, &chain.at, "expected the name of a chain, got \"%s\"", motion->chain);
    }
}

void resolve_motions(struct reader *reader, const struct value *scene)
{
    const struct document *document = reader->document;
    const struct value splines = reader_member(scene, "splines");
    for (int s = 0; s < document->spline_count; s++) {
        const struct param *param = &document->splines[s]->parameter[PARAMETER_EQUILIBRIUM];
        if (!param->motion) continue;
        param->motion->by_file = document_find_model(document, param->motion->model, false) < 0;
        const struct value spline = reader_element(&splines, s);
        const struct value object = reader_member(&spline, parameter_rows[PARAMETER_EQUILIBRIUM].name);
        check_motion(reader, &object, param->motion);
    }
}

void print_motion(struct members *members, const struct document *document, const struct param *param,
                  const char *folder)
{
    const struct joint_motion *motion = param->motion;
    if (motion->by_file) {
        member_path(members, "model", document, motion->model, folder);
    } else {
        member_string(members, "model", motion->model);
    }
    member_string(members, "joint", motion->joint);
    member_string(members, "of", motion_words[motion->of]);
    member_number(members, "gain", param->gain);
    if (motion->chain) member_string(members, "chain", motion->chain);
}
