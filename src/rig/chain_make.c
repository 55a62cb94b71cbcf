/// Makes chains with their own splines.
#include "rig/chain_make.h"
#include "base/need.h"
#include "maths/maths.h"
#include "rig/posing.h"
#include "rig/strand.h"
#include "scene/edit.h"
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double USUAL_LENGTH = 0.5, USUAL_FREQUENCY = 1.5; ///< longer chains swing slower, like a pendulum
static const double SLOWEST = 0.8, FASTEST = 3.5, USUAL_DAMPING = 0.12;
static const double WHOLE_LAG = 110;  ///< degrees from the first bone to the tip
static const double WHOLE_BEND = 110; ///< degrees for 1 of a spline whose knots set it
static const double DEGREES = 57.29577951308232;
static const double SHORTEST = 1e-3; ///< of the character's size; less cannot be bent
static const double LEAF = 0.03;     ///< of that size: length of a bone without a child, at least

/// A chain's name: its first bone's without the number at the end, made unique. The caller frees it.
static char *name_chain(const struct document *document, const char *bone)
{
    char other[BONE_NAME_SIZE], *stem = need_text(bone);
    size_t length = strlen(stem);
    if (!bone_other_side(bone, other)) { // ear_1_L keeps its whole name
        while (length > 1 && isdigit((unsigned char)bone[length - 1])) length--;
        while (length > 1 && strchr("_-. ", bone[length - 1])) length--;
    }
    stem[length] = '\0';
    char *name = edit_rig_free_name(document, stem);
    free(stem);
    return name;
}

/// The diagonal of the character's box, metres.
static double size_of(const struct imported *imported, double scale)
{
    double square = 0;
    for (int k = 0; k < 3; k++) square += pow((double)imported->gltf.hi[k] - (double)imported->gltf.lo[k], 2);
    return scale * sqrt(square);
}

/// Length along the bones at rest, metres.
static double length_of(const struct imported *imported, const struct chain_bones *bones, double scale)
{
    float point[ANGLES_MAX_JOINTS + 1][3];
    double sum = 0;
    chain_points_at_rest(imported, bones, point);
    for (int n = 1; n <= bones->count; n++) {
        const float *a = point[n - 1], *b = point[n];
        sum += maths_hypot(maths_hypot((double)(b[0] - a[0]), (double)(b[1] - a[1])), (double)(b[2] - a[2]));
    }
    const bool is_leaf = bones->count == 1 && imported->gltf.nodes[bones->node[0]].child < 0; // its tip is a guess
    return is_leaf ? fmax(scale * sum, LEAF * size_of(imported, scale)) : scale * sum;
}

double chain_bend_a_metre(const struct imported *imported, const struct chain_bones *bones, double scale)
{
    // A bend of g at each of n bones moves the tip by g · length · (n + 1) / 2.
    const double length = fmax(length_of(imported, bones, scale), fmax(SHORTEST * size_of(imported, scale), 1e-6));
    return DEGREES * 2 / (length * (bones->count + 1));
}

/// Properties shared by all splines of a new chain.
struct plan {
    struct document *document;
    const struct chain_wish *wish;
    char *model; ///< its name, else its file
    bool by_file;
    char *chain, *from, *to; ///< the names of the chain, its first bone and its last
    double frequency, damping;
    bool loops;
};

static bool set(const struct plan *plan, int spline, enum parameter parameter, struct param param,
                struct error *error)
{
    return edit_parameter(plan->document, spline, parameter, &param, error);
}

/// Appends a spline for one axis.
static bool add_spline(const struct plan *plan, const char *axis, struct error *error)
{
    char *name;
    const int spline = plan->document->spline_count;
    if (asprintf(&name, "%s %s", plan->chain, axis) < 0) need_failed();
    const bool added = edit_spline_add(plan->document, spline, name, NULL, error);
    free(name);
    return added && set(plan, spline, PARAMETER_FREQUENCY, param_number(plan->frequency), error) &&
           set(plan, spline, PARAMETER_DAMPING, param_number(plan->damping), error) &&
           set(plan, spline, PARAMETER_START, param_number(plan->loops ? WIGGLY_LOOP : WIGGLY_REST), error);
}

/// Makes a spline's equilibrium follow the stiff chain's tip through the clip.
static bool follow_tip(const struct plan *plan, int spline, enum motion_of of, struct error *error)
{
    struct joint_motion motion = {
        .model = plan->model, .by_file = plan->by_file, .joint = plan->to, .of = of, .gain = 1, .chain = plan->chain};
    const struct param equilibrium = {.track = -1, .motion = &motion};
    return set(plan, spline, PARAMETER_EQUILIBRIUM, equilibrium, error);
}

/// The chain on the other side, or NULL.
static const struct chain *find_twin(const struct document *document, const struct chain_wish *wish)
{
    char other[BONE_NAME_SIZE];
    if (!bone_other_side(wish->from, other)) return NULL;
    for (int r = -1; (r = document_next_chain(document, wish->model, r)) >= 0;) {
        if (strcmp(document->rigs[r]->chain.from, other) == 0) return &document->rigs[r]->chain;
    }
    return NULL;
}

static bool add_chain(const struct plan *plan, const struct chain *chain, int *rig, struct error *error)
{
    const struct rig contents = {.kind = RIG_CHAIN, .name = plan->chain, .chain = *chain};
    *rig = plan->document->rig_count;
    return edit_rig_add(plan->document, &contents, error);
}

/// Adds two splines, and a chain of `bones` bones that each bend by `bend` degrees.
static bool add_whole(const struct plan *plan, struct chain *chain, int bones, double bend, int *rig,
                      struct error *error)
{
    const struct chain_wish *wish = plan->wish;
    struct channel channels[2];
    for (int c = 0; c < 2; c++) {
        channels[c] = (struct channel){.spline = plan->document->spline_count + c,
                                       .axis = c == 0 ? AXIS_SIDE : AXIS_UP,
                                       .of = wish->follows ? PART_DISPLACEMENT : PART_TOTAL,
                                       .lag.value = {wish->lag > 0 ? wish->lag : round(WHOLE_LAG / bones)},
                                       .gain.value = {round(10 * bend) / 10}};
    }
    chain->channels = channels;
    chain->channel_count = 2;
    const int first = channels[0].spline;
    if (!add_spline(plan, "side", error) || !add_spline(plan, "up", error) || !add_chain(plan, chain, rig, error))
        return false;
    return !wish->follows ||
           (follow_tip(plan, first, MOTION_ACROSS, error) && follow_tip(plan, first + 1, MOTION_UP, error));
}

bool chain_make(struct document *document, const struct models *models, const struct chain_wish *wish, int *rig,
                struct error *error)
{
    const struct rig *model = document->rigs[wish->model];
    const struct imported *imported = models_imported(models, document, wish->model);
    struct chain_bones bones;
    if (!imported)
        return fail(error, ERROR_INPUT, "%s: it could not be read, so it has no bones", model->model.model);
    const struct gltf *gltf = &imported->gltf;
    const int from = gltf_find_node(gltf, wish->from);
    const int last = wish->to || from < 0 ? -1 : chain_end(imported, from, error);
    if (from >= 0 && !wish->to && last < 0) return false;
    const char *to = wish->to ? wish->to : last < 0 ? wish->from : gltf->nodes[last].name;
    if (!chain_find(gltf, wish->from, to, &bones, error)) return false;
    const int clip = gltf_find_clip(gltf, model->model.clip);
    struct clip_play play = {0};
    if (clip >= 0) play = clip_play(&model->model, &gltf->clips[clip]);
    const double length = length_of(imported, &bones, model->model.scale);
    if (!(length > SHORTEST * size_of(imported, model->model.scale)))
        return fail(error, ERROR_INPUT,
                    "%s: the bones \"%s\" to \"%s\" lie at one place, so there is nothing to bend: choose others",
                    model->model.model, wish->from, to);
    const double frequency = fmin(fmax(USUAL_FREQUENCY * sqrt(USUAL_LENGTH / length), SLOWEST), FASTEST);
    char *name = name_chain(document, wish->from);
    const struct plan plan = {.document = document,
                              .wish = wish,
                              .model = model->name ? model->name : model->model.model,
                              .by_file = !model->name,
                              .chain = name,
                              .from = gltf->nodes[bones.node[0]].name,
                              .to = gltf->nodes[bones.node[bones.count - 1]].name,
                              .frequency = wish->frequency > 0 ? wish->frequency : round(10 * frequency) / 10,
                              .damping = wish->damping > 0 ? wish->damping : USUAL_DAMPING,
                              .loops = document_loops(document) || posing_clip_loops(document, &play)};
    struct chain chain = {.model = plan.model, .by_file = plan.by_file, .from = plan.from, .to = plan.to};
    const struct chain *twin = wish->own ? NULL : find_twin(document, wish);
    const double bend =
        wish->follows ? chain_bend_a_metre(imported, &bones, model->model.scale) : WHOLE_BEND / bones.count;
    bool done;
    if (twin) {
        chain.turn = -twin->turn;
        chain.mirror = !twin->mirror;
        chain.channels = twin->channels;
        chain.channel_count = twin->channel_count;
        done = add_chain(&plan, &chain, rig, error);
    } else {
        done = add_whole(&plan, &chain, bones.count, bend, rig, error);
    }
    free(name);
    return done;
}
