/// Which kinds of rigs are exported.
#include "export/form.h"
#include "rig/strand.h"
#include <stdio.h>
#include <string.h>

const struct form_kind meadow_form = {0}; // no format holds one

#define FORM_ROW(constant, name) [constant] = &name##_form,
static const struct form_kind *const kinds[RIG_KINDS] = {RIG_KIND_LIST(FORM_ROW)};
#undef FORM_ROW

const struct form_kind *form_kind(enum rig_kind kind) { return kinds[kind]; }

const char *form_name(const struct rig *rig) { return rig->name ? rig->name : rig_word(rig->kind); }

/// Other programs tell what is in a file by its name: rigs of the same name get a number.
static void make_name(const struct document *document, int rig, char name[FORM_NAME])
{
    const char *wanted = form_name(document->rigs[rig]);
    int number = 1;
    for (int i = 0; i < rig; i++) number += strcmp(form_name(document->rigs[i]), wanted) == 0;
    snprintf(name, FORM_NAME, "%.40s", wanted);
    if (number > 1) snprintf(name + strlen(name), 16, "_%d", number);
}

bool form_open(const struct export_range *range, int rig, struct form *form, struct error *error)
{
    struct rig_pose pose;
    const struct document *document = range->posing->document;
    const struct rig *source = document->rigs[rig];
    *form = (struct form){.kind = kinds[source->kind]};
    if (!range_pose(range, rig, 0, &pose, error)) return false;
    make_name(document, rig, form->name);
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
        const wiggly_value value = range_value(range, channel->spline, key);
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
    if (form->kind) form->kind->close(form);
    *form = (struct form){0};
}
