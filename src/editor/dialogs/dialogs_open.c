/// What lies over the panels, and which of it takes an event.
#include "editor/dialogs/dialog.h"
#include "editor/dialogs/dialogs.h"
#include "editor/dialogs/help.h"
#include <stdlib.h>

struct dialogs *dialogs_create(void) { return calloc(1, sizeof(struct dialogs)); }

void dialogs_destroy(struct dialogs *dialogs) { free(dialogs); }

void dialogs_set_files(struct dialogs *dialogs, const struct dialog_files *files) { dialogs->dialog.files = *files; }

bool dialogs_event(struct dialogs *dialogs, struct core *core, const struct editor_world *world,
                   const struct event *event, bool busy)
{
    return dialog_event(dialogs, core, world, event) || help_event(dialogs, core, event, busy) ||
           welcome_event(dialogs, event);
}

void dialogs_show(struct dialogs *dialogs, struct core *core, const struct editor_world *world)
{
    help_show(dialogs, core);
    dialog_show(dialogs, core, world);
}

bool dialogs_cover(const struct dialogs *dialogs)
{
    return dialogs->dialog.kind != DIALOG_NONE || dialogs->help.open;
}

bool dialogs_over(const struct dialogs *dialogs, enum ui_over *over)
{
    *over = dialogs->dialog.kind != DIALOG_NONE ? dialogs->dialog.ui.over : UI_OVER_NOTHING;
    return dialogs_cover(dialogs);
}

float dialogs_bottom(const struct dialogs *dialogs, const struct core *core)
{
    const struct rect *stage = &core->layout.stage;
    return dialogs->welcome ? dialogs->card.y : stage->y + stage->h;
}
