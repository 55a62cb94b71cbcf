/// Lists the exported kinds of rigs, collects the keys of one rig, and computes the slopes of its curves by differences.
#include "export/form.h"
#include "base/need.h"
#include "rig/strand.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

const struct form_kind chain_form = {.holds = FORM_IN_MODEL, .columns = form_channels};

#define FORM_ROW(constant, name) [constant] = &name##_form,
static const struct form_kind *const kinds[RIG_KINDS] = {RIG_KIND_LIST(FORM_ROW)};
#undef FORM_ROW

const struct form_kind *form_kind(enum rig_kind kind) { return kinds[kind]; }

const char *form_name(const struct rig *rig) { return rig->name ? rig->name : rig_word(rig->kind); }

char *form_text(struct pool *pool, const char *first, const char *second, const char *third)
{
    char *text = pool_take(pool, strlen(first) + strlen(second) + strlen(third) + 1, 1);
    stpcpy(stpcpy(stpcpy(text, first), second), third);
    return text;
}

char *form_word(struct pool *pool, const char *name)
{
    char *word = form_text(pool, name, "", ""), *to = word;
    for (const char *from = name; *from;) {
        const char *letter = from;
        if (letter_is_blank(utf8_next(&from))) {
            *to++ = '_';
        } else {
            to = mempcpy(to, letter, (size_t)(from - letter));
        }
    }
    *to = '\0';
    return word;
}

/// Other programs identify objects by name, so rigs of the same name get a number.
static void name_rig(const struct document *document, int rig, struct form *form)
{
    struct names names = {.between = "_"};
    for (int i = 0; i < rig; i++) names_add(&names, form_name(document->rigs[i]));
    form->name = form_text(&form->pool, names_add(&names, form_name(document->rigs[rig])), "", "");
    names_free(&names);
}

bool form_open(const struct export_range *range, int rig, struct form *form, struct error *error)
{
    struct rig_pose pose;
    const struct document *document = range->posing->document;
    const struct rig *source = document->rigs[rig];
    *form = (struct form){.kind = kinds[source->kind], .holder = -1};
    if (range->format->holds == FORM_JOINTS && source->kind == RIG_MODEL) form->kind = &skeleton_form;
    if (!range_pose(range, rig, 0, &pose, error)) return false;
    name_rig(document, rig, form);
    if (form->kind->open(range->posing, rig, &pose, form, error)) return true;
    form_close(form);
    return false;
}

void form_channels(const struct export_range *range, int rig, const struct rig_pose *pose, double key,
                   form_column *column, void *user)
{
    const struct document *document = range->posing->document;
    const char *name = form_name(document->rigs[rig]);
    struct strand strand;
    (void)pose;
    if (!strand_find(range->posing, rig_body(document, rig), rig, &strand)) return;
    for (int c = 0; c < strand.channel_count; c++) {
        const struct channel *channel = &strand.channels[c];
        const wiggly_value value = channel_value(range->posing, channel, range_position(range, key));
        if (!axis_bends(channel->axis))
            column(user, channel_moves(channel, value, 1, range->posing->look), "%s.%s.%s", name,
                   axis_word(channel->axis), document->splines[channel->spline]->name);
        for (int n = 0; n < strand.joints && axis_bends(channel->axis); n++) {
            const double angle = channel_bend(channel, value, n, strand.joints, range->posing->look);
            column(user, 180 / 3.14159265358979323846 * angle, "%s.%s.%s.%d", name, axis_word(channel->axis),
                   document->splines[channel->spline]->name, n);
        }
    }
}

void form_close(struct form *form)
{
    names_free(&form->names);
    pool_free(&form->pool);
    *form = (struct form){0};
}

// --- keys

#define STEP (1.0 / 16) /* of differences, in keys */

/// Poses one rig at any key.
struct sampler {
    const struct export_range *range;
    const struct form *form;
    int rig;
};

static bool sample(const struct sampler *from, const struct keys *keys, double key, float *row, struct error *error)
{
    struct rig_pose pose;
    struct form_key values = {.rotation = (float(*)[4])(row + keys_rotation(0)),
                              .scale = (float(*)[3])(row + keys_scale(keys, 0)),
                              .offset = (float(*)[3])(row + keys_offset(keys, 0)),
                              .weight = row + keys_weight(keys, 0)};
    for (int j = 0; j < keys->joints; j++) {
        for (int k = 0; k < 3; k++) values.scale[j][k] = 1;
        memcpy(values.offset[j], from->form->joints[j].offset, sizeof values.offset[j]);
    }
    if (!range_pose(from->range, from->rig, key, &pose, error)) return false;
    from->form->kind->key(from->form, &pose, &values);
    memcpy(row, values.translation, sizeof values.translation);
    return true;
}

void keys_turn_short_way(const float before[4], float q[4])
{
    if (before[0] * q[0] + before[1] * q[1] + before[2] * q[2] + before[3] * q[3] >= 0) return;
    for (int k = 0; k < 4; k++) q[k] = -q[k];
}

static void turn_short_way(const struct keys *keys, const float *before, float *row)
{
    for (int j = 0; j < keys->joints; j++) keys_turn_short_way(before + keys_rotation(j), row + keys_rotation(j));
}

void keys_close_loop(float *rows, int width, int count)
{
    float *last = rows + (size_t)(count - 1) * (size_t)width;
    for (int i = 0; i < width && last > rows; i++) {
        if (!(fabsf(last[i] - rows[i]) <= 1e-5f)) return;
    }
    memmove(last, rows, (size_t)width * sizeof *rows);
}

/// slope = Σ factor · row(key + offset) / seconds
struct difference {
    double offset[3], factor[3];
};

/// Central; one-sided at the ends of the document.
static struct difference choose_difference(const struct export_range *range, double key, bool loops)
{
    if (!loops && !range_is_inside(range, key - STEP))
        return (struct difference){{0, STEP, 2 * STEP}, {-1.5, 2, -0.5}};
    if (!loops && !range_is_inside(range, key + STEP))
        return (struct difference){{0, -STEP, -2 * STEP}, {1.5, -2, 0.5}};
    return (struct difference){{-STEP, 0, STEP}, {-0.5, 0, 0.5}};
}

/// `scratch` holds one row.
static bool add_slopes(const struct sampler *from, struct keys *keys, float *scratch, struct error *error)
{
    const size_t width = (size_t)keys->width;
    const double seconds = range_seconds(from->range, STEP);
    const bool loops = memcmp(keys->rows, keys_at(keys, keys->count - 1, 0), width * sizeof *keys->rows) == 0;
    for (int k = 0; k < keys->count; k++) {
        const struct difference difference = choose_difference(from->range, k, loops);
        float *slope = keys->slopes + (size_t)k * width;
        for (int d = 0; d < 3; d++) {
            if (difference.factor[d] == 0) continue;
            if (!sample(from, keys, k + difference.offset[d], scratch, error)) return false;
            turn_short_way(keys, keys_at(keys, k, 0), scratch);
            for (size_t i = 0; i < width; i++)
                slope[i] += (float)(difference.factor[d] / seconds * (double)scratch[i]);
        }
    }
    return true;
}

static bool collect(struct export_range *range, const struct sampler *from, struct keys *keys, struct error *error)
{
    const size_t width = (size_t)keys->width;
    for (int k = 0; k < keys->count; k++) {
        float *row = keys->rows + (size_t)k * width;
        if (!sample(from, keys, k, row, error) || !range_proceed(range, error)) return false;
        if (k > 0) turn_short_way(keys, row - width, row);
        keys->travels = keys->travels || memcmp(row, keys->rows, 3 * sizeof *row) != 0;
    }
    keys_close_loop(keys->rows, keys->width, keys->count);
    return !keys->slopes || add_slopes(from, keys, keys->rows + (size_t)keys->count * width, error);
}

bool keys_collect(struct export_range *range, int rig, struct form *form, struct keys *keys, struct error *error)
{
    const struct sampler from = {range, form, rig};
    const size_t count = (size_t)range->key_count,
                 width = 3 + 10 * (size_t)form->joint_count + (size_t)form->target_count;
    const bool tangents = range->options->is_cubic && range->format->has_tangents && range->key_count > 1;
    *keys = (struct keys){.count = range->key_count, .width = (int)width, .joints = form->joint_count};
    if (!need_has_room((2 * count + 1) * width * sizeof *keys->rows)) return fail_no_memory(error, form->name);
    keys->rows = pool_take(&form->pool, (count + 1) * width, sizeof *keys->rows);
    if (tangents) keys->slopes = pool_take(&form->pool, count * width, sizeof *keys->slopes);
    return collect(range, &from, keys, error);
}
