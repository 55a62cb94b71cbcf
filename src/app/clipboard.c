/// The system's clipboard between the platform and the editor.
#include "app/state.h"
#include <string.h>

enum { MAX_CLIPBOARD = 16 << 20 }; ///< bytes

void app_copy(struct app *app)
{
    if (!app->replay) platform_set_clipboard(app->platform, app->table.editor->core.clipboard);
}

const char *app_clipboard_text(struct app *app)
{
    const char *text = platform_clipboard(app->platform);
    if (!text || !*text) {
        core_message(&app->table.editor->core, false, "The clipboard has no text.");
    } else if (strlen(text) > MAX_CLIPBOARD) {
        core_message(&app->table.editor->core, true, "The clipboard holds more than 16 MB, too much for knots.");
        text = NULL;
    }
    return text && *text ? text : NULL;
}
