/// Which kinds of rigs are exported.
#include "export/form.h"
#include <stdio.h>

extern const struct form_kind tail_form, character_form;

static const struct form_kind *const kinds[RIG_KINDS] = {
    [RIG_TAIL] = &tail_form,
    [RIG_CHARACTER] = &character_form,
};

const struct form_kind *form_kind(enum rig_kind kind) { return kinds[kind]; }

const char *form_name(const struct rig *rig) { return rig->name ? rig->name : rig_word(rig->kind); }

bool form_open(const struct take *take, int rig, struct form *form, struct error *error)
{
    struct rig_pose pose;
    const struct document *document = take->posing->document;
    const struct rig *source = &document->rigs[rig];
    *form = (struct form){.kind = kinds[source->kind]};
    if (!take_pose(take, rig, 0, &pose, error)) return false;
    snprintf(form->name, sizeof form->name, "%s", form_name(source));
    if (form->kind->open(document, rig, &pose, form, error)) return true;
    form_close(form);
    return false;
}

void form_close(struct form *form)
{
    if (form->kind) form->kind->close(form);
    *form = (struct form){0};
}
