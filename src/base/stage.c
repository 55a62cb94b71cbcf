/// Hands on how far long work is.
#include "base/stage.h"
#include <stddef.h>

static stage_listener *listening;

void stage_listen(stage_listener *listener) { listening = listener; }

void stage_tell(const char *doing, long done, long total)
{
    if (listening) listening(doing, done, total);
}
