/// What a recorded motion becomes in the document: knots of the splines that the body's position follows, and a tail that follows
/// through as it did while it was dragged.
///
/// A channel whose spline has knots of its own stays as it is: the swing that the base causes is added by a channel of its own,
/// on a spline with the same poles. By linearity that is the same motion, and no key of the animator's changes its meaning.
#include "editor/core/core.h"
#include "editor/stage/hold.h"
#include "scene/order.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX_KNOTS = 64, NAME_SIZE = 300 };

static const double STILL = 2e-3;      ///< metres: a coordinate that moved less did not move
static const double TOLERANCE = 4e-3;  ///< metres between the hand's way and the cubic through its knots
static const double RESOLUTION = 1e-3; ///< metres
static const double LEAST_SHARE = 0.05;

static double largest(const double *values, int count)
{
    double most = 0;
    for (int i = 0; i < count; i++) most = fmax(most, fabs(values[i]));
    return most;
}

/// "tail x", or with a number behind it where that is taken.
static void free_name(const struct document *document, const char *base, char name[NAME_SIZE])
{
    snprintf(name, NAME_SIZE, "%s", base);
    for (int n = 2; document_find_spline(document, name) >= 0; n++) snprintf(name, NAME_SIZE, "%s %d", base, n);
}

/// Adds a spline behind all others; its index, or -1.
static int add_spline(struct core *core, const struct editor_world *world, const char *base)
{
    char name[NAME_SIZE];
    free_name(world->document, base, name);
    struct edit edit = core_edit_of(EDIT_SPLINE_ADD, world->document->spline_count);
    edit.text = name;
    return core_edit(core, world, &edit) ? world->document->spline_count - 1 : -1;
}

static void set_start(struct core *core, const struct editor_world *world, int spline, enum wiggly_start start)
{
    struct edit edit = core_parameter_edit(spline, PARAMETER_START, start);
    core_edit(core, world, &edit);
}

static void put_knot(struct core *core, const struct editor_world *world, int spline, int sample, double value,
                     bool level)
{
    struct edit edit = core_knot_edit(world->document, spline, sample);
    edit.knot.value = core_round(value, RESOLUTION);
    edit.knot.has_slope = level;
    edit.knot.slope = 0;
    edit.knot.stiffness = level ? RECORD_STIFFNESS : KNOT_DEFAULT_STIFFNESS;
    core_edit(core, world, &edit);
}

static void clear_knots(struct core *core, const struct editor_world *world, int spline, int from, int to)
{
    const struct document *document = world->document;
    for (;;) {
        int at = spline_lower_bound(document, &document->splines[spline], from);
        const struct spline *cleared = &document->splines[spline];
        if (at == cleared->knot_count || document_sample(document, cleared->knots[at].frame) > to) return;
        struct edit edit = core_edit_of(EDIT_KNOT_REMOVE, spline);
        edit.knot = cleared->knots[at];
        if (!core_edit(core, world, &edit)) return;
    }
}

/// The spline that a coordinate follows, made where it is a number yet; -1 on failure.
static int base_spline(struct core *core, const struct editor_world *world, int tail, int coordinate, bool loop)
{
    const struct tail *moved = document_tail(world->document, tail);
    char name[NAME_SIZE];
    if (moved->position[coordinate].track >= 0) return moved->position[coordinate].track;
    snprintf(name, sizeof name, "%.250s %s",
             world->document->rigs[document_find_rig(world->document, RIG_TAIL, tail)].name,
             coordinate_name(coordinate));
    int spline = add_spline(core, world, name);
    if (spline < 0) return -1;
    struct edit mode = core_parameter_edit(spline, PARAMETER_MODE, WIGGLY_CUBIC);
    core_edit(core, world, &mode);
    if (loop) set_start(core, world, spline, WIGGLY_LOOP);
    return spline;
}

/// Keys a coordinate's motion. Before and after it the body stands still, unless the scene is a loop, in which it comes back by
/// itself.
static int key_coordinate(const struct stage *stage, struct core *core, const struct editor_world *world,
                          int coordinate, bool loop)
{
    const struct record *record = &stage->record;
    const struct document *document = world->document;
    const struct param before = document_tail(document, stage->hold.tail)->position[coordinate];
    double from[RECORD_SAMPLES];
    int knots[MAX_KNOTS], last = document_samples(document) - 1;
    int spline = base_spline(core, world, stage->hold.tail, coordinate, loop);
    if (spline < 0) return -1;
    int count = record->count, end = document_last_knot_sample(document, &document->splines[spline]);
    if (record->first + count - 1 > end) count = end - record->first + 1;
    for (int i = 0; i < count; i++) {
        wiggly_value value = {.y = before.value};
        if (before.track >= 0) value = evaluation_at(world->evaluation, before.track, record->first + i);
        from[i] = value.y + value.re + record->way[coordinate][i];
    }
    int made = count >= 2 ? record_simplify(from, count, TOLERANCE, core->method, knots, MAX_KNOTS) : 0;
    if (before.track >= 0) clear_knots(core, world, spline, record->first, record->first + count - 1);
    for (int i = 0; i < made; i++) {
        put_knot(core, world, spline, record->first + knots[i], from[knots[i]], i == 0 || i == made - 1);
    }
    if (before.track >= 0 || made == 0) return spline;
    if (!loop && record->first > 1) put_knot(core, world, spline, 0, from[0], true);
    if (!loop && record->first + count < last) put_knot(core, world, spline, last, from[count - 1], true);
    struct edit edit = core_edit_of(EDIT_POSITION, 0);
    edit.rig = document_find_rig(world->document, RIG_TAIL, stage->hold.tail);
    edit.coordinate = coordinate;
    edit.param.track = spline;
    core_edit(core, world, &edit);
    return spline;
}

static void follow_base(struct core *core, const struct editor_world *world, int spline, int base)
{
    struct edit edit = core_edit_of(EDIT_PARAMETER, spline);
    edit.parameter = PARAMETER_EQUILIBRIUM;
    edit.param.track = base;
    core_edit(core, world, &edit);
}

static void set_angles(const struct stage *stage, struct core *core, const struct editor_world *world, int channel,
                       enum angle_kind kind, const struct angles *angles)
{
    struct edit edit = core_edit_of(EDIT_ANGLES, 0);
    edit.rig = document_find_rig(world->document, RIG_TAIL, stage->hold.tail);
    edit.channel = channel;
    edit.angle = kind;
    edit.angles = angles;
    core_edit(core, world, &edit);
}

/// A spline with the poles of another and no knots, driven by the base from rest (or round the loop); its index, or -1.
static int add_follower(struct core *core, const struct editor_world *world, int model, int base)
{
    char name[NAME_SIZE];
    snprintf(name, sizeof name, "%.280s follow", world->document->splines[model].name);
    int spline = add_spline(core, world, name);
    if (spline < 0) return -1;
    const struct spline copied = world->document->splines[model];
    struct edit mode = core_edit_of(EDIT_PARAMETER, spline), spring = core_edit_of(EDIT_SPRING, spline);
    mode.parameter = PARAMETER_MODE;
    mode.param = copied.parameter[PARAMETER_MODE];
    spring.flag = copied.spring_friction;
    core_edit(core, world, &mode);
    if (spring.flag) core_edit(core, world, &spring);
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        if (p == PARAMETER_EQUILIBRIUM || p == PARAMETER_START || !spline_has(&copied, p)) continue;
        struct edit edit = core_edit_of(EDIT_PARAMETER, spline);
        edit.parameter = p;
        edit.param = copied.parameter[p];
        core_edit(core, world, &edit);
    }
    set_start(core, world, spline, spline_start(&copied) == WIGGLY_LOOP ? WIGGLY_LOOP : WIGGLY_REST);
    follow_base(core, world, spline, base);
    return spline;
}

/// Adds a channel of the displacement beside one of the total: as it swung by hand.
static void add_channel(const struct stage *stage, struct core *core, const struct editor_world *world,
                        const struct channel *model, double scale, int base)
{
    const struct document *document = world->document;
    struct edit edit = core_edit_of(EDIT_CHANNEL_ADD, add_follower(core, world, model->spline, base));
    struct angles gain = model->gain;
    const struct angles lag = model->lag;
    edit.rig = document_find_rig(world->document, RIG_TAIL, stage->hold.tail);
    edit.axis = model->axis;
    edit.of = PART_DISPLACEMENT;
    if (edit.spline < 0) return;
    for (int i = 0; i < angles_count(&gain); i++)
        angles_set_number(&gain, i, round(angles_number(&gain, i) * scale * 1e4) / 1e4);
    if (!core_edit(core, world, &edit)) return;
    int added = document_tail(document, stage->hold.tail)->channel_count - 1;
    set_angles(stage, core, world, added, ANGLE_LAG, &lag);
    set_angles(stage, core, world, added, ANGLE_GAIN, &gain);
}

/// Lets the channels that swung with a coordinate follow its spline.
static void hang_channels(const struct stage *stage, struct core *core, const struct editor_world *world,
                          int coordinate, int base)
{
    int index = stage->hold.tail, count = document_tail(world->document, index)->channel_count;
    for (int c = 0; c < count; c++) {
        const struct tail *tail = document_tail(world->document, index);
        const struct channel channel = tail->channels[c];
        const struct param *equilibrium = &world->document->splines[channel.spline].parameter[PARAMETER_EQUILIBRIUM];
        double direction[3], scale = stage->sway[index].scale[c];
        swing_direction(tail, channel.axis, direction);
        bool swung = stage->record.hangs[c] && fabs(direction[coordinate]) > LEAST_SHARE && scale != 0;
        if (!swung) continue;
        if (channel.of == PART_TOTAL) {
            add_channel(stage, core, world, &channel, scale * direction[coordinate], base);
        } else if (!param_follows(equilibrium)) {
            follow_base(core, world, channel.spline, base);
        }
    }
}

void record_keep(struct stage *stage, struct core *core, const struct editor_world *world)
{
    struct record *record = &stage->record;
    const struct tail *tail = document_tail(world->document, stage->hold.tail);
    bool loop = tail->channel_count > 0;
    for (int c = 0; c < tail->channel_count; c++) {
        record->hangs[c] = swing_hangs(tail, &tail->channels[c]);
        loop &= spline_start(&world->document->splines[tail->channels[c].spline]) == WIGGLY_LOOP;
    }
    for (int k = 0; k < 3; k++) {
        if (largest(record->way[k], record->count) < STILL) continue;
        int base = key_coordinate(stage, core, world, k, loop);
        if (base < 0) continue;
        hang_channels(stage, core, world, k, base);
        core_tell(core, world, NEWS_EDITED, base);
    }
    record_forget(stage);
}
