/// Time: playing, stepping, scrubbing. The position is in samples and may lie between two.
#include "editor/actions.h"
#include "editor/curves.h"
#include <math.h>

static double last_position(const struct document *document) { return fmax(document_samples(document) - 1, 0); }

static void go_to(struct editor *editor, const struct document *document, double position)
{
    editor->playback.position = fmin(fmax(position, 0), last_position(document));
}

void playback_toggle(struct editor *editor, const struct editor_world *world)
{
    struct playback *playback = &editor->playback;
    playback->playing = !playback->playing;
    if (playback->playing && !playback->looping && playback->position >= last_position(world->document)) {
        playback->position = 0;
    }
}

void playback_advance(struct editor *editor, const struct editor_world *world, double dt)
{
    struct playback *playback = &editor->playback;
    double last = last_position(world->document);
    if (!playback->playing) {
        go_to(editor, world->document, playback->position); /* an edit may have shortened the scene */
        return;
    }
    playback->position += dt * world->document->fps * world->document->substeps;
    if (playback->position < last) return;
    if (playback->looping && last > 0) {
        playback->position = fmod(playback->position, last);
    } else {
        playback->position = last;
        playback->playing = playback->looping;
    }
}

void playback_seek(struct editor *editor, const struct document *document, double frame)
{
    editor->playback.playing = false;
    go_to(editor, document, curves_position(document, frame));
}

void playback_step(struct editor *editor, const struct editor_world *world, int direction)
{
    double frame = editor_frame(editor, world->document);
    playback_seek(editor, world->document, direction > 0 ? floor(frame + 1e-6) + 1 : ceil(frame - 1e-6) - 1);
}

void playback_end(struct editor *editor, const struct editor_world *world, int direction)
{
    playback_seek(editor, world->document,
                  direction > 0 ? world->document->last_frame : world->document->first_frame);
}
