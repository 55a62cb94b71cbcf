/// The undo history: documents, and the steps between them.
#include "scene/history.h"
#include "base/need.h"
#include "scene/fields.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

static const size_t DEFAULT_LIMIT = (size_t)128 << 20; ///< bytes

/// A past document, and the step that led to it. The first has no label.
struct state {
    struct document *document;
    const char *label;
    uint64_t merge;
    uint64_t number; ///< unique
    size_t bytes;    ///< replaced by the step
    void *seen[2];   ///< as the step began and ended, by history_see()
};

struct history {
    struct document *document; ///< the document that is edited
    struct document *left;     ///< the document before the last undo, which this frame's panels may still read
    struct state *states;      ///< one more than there are steps
    size_t step_count;
    size_t done;         ///< steps not undone: the current state's index
    size_t bytes, limit; ///< of all steps together
    size_t dropped;      ///< steps dropped to save memory
    uint64_t last_number, saved_number;
    bool is_open, can_merge;
    const char *label;
    uint64_t merge;
    unsigned next_id; ///< the document's next id when the open step began
};

static void forget(const struct state *state)
{
    document_destroy(state->document);
    free(state->seen[0]);
    free(state->seen[1]);
}

/// Forgets the states from an index on.
static void forget_from(struct history *history, size_t first)
{
    for (size_t i = first; i <= history->step_count; i++) {
        history->bytes -= history->states[i].bytes;
        forget(&history->states[i]);
    }
}

struct history *history_create(struct document *document)
{
    struct history *history = need_zeroed(1, sizeof *history);
    history->limit = DEFAULT_LIMIT;
    history->states = need_zeroed(1, sizeof *history->states);
    history_clear(history, document);
    return history;
}

void history_destroy(struct history *history)
{
    if (!history) return;
    forget_from(history, 0);
    document_destroy(history->left);
    free(history->states);
    free(history);
}

void history_clear(struct history *history, struct document *document)
{
    forget_from(history, 0);
    history->document = document;
    history->step_count = history->done = history->bytes = history->dropped = 0;
    history->states[0] =
        (struct state){.document = document ? document_copy(document) : NULL, .number = ++history->last_number};
    history->saved_number = history->last_number;
    history->is_open = history->can_merge = false;
}

static struct state *current(const struct history *history) { return &history->states[history->done]; }

void history_begin(struct history *history, const char *label, uint64_t merge)
{
    assert(!history->is_open);
    history->is_open = true;
    history->label = label;
    history->merge = merge;
    history->next_id = history->document->next_id;
}

/// Makes the document what it was in the current state. Ids given since are not reused.
static void go_back(struct history *history)
{
    struct document *document = history->document, *next = document_copy(current(history)->document);
    if (document->next_id > next->next_id) next->next_id = document->next_id;
    document_destroy(history->left);
    history->left = document_copy(document);
    document_become(document, next);
}

/// Whether the document is another value than the current state: other splines or rigs, or other frames.
static bool has_changed(const struct history *history)
{
    const struct document *a = history->document, *b = current(history)->document;
    bool same = a->serial == b->serial && a->fps == b->fps && a->substeps == b->substeps &&
                a->first_frame == b->first_frame && a->last_frame == b->last_frame &&
                a->spline_count == b->spline_count && a->rig_count == b->rig_count &&
                fields_equal(background_fields, &a->background, &b->background);
    for (int i = 0; same && i < a->spline_count; i++) same = a->splines[i] == b->splines[i];
    for (int i = 0; same && i < a->rig_count; i++) same = a->rigs[i] == b->rigs[i];
    return !same;
}

void history_restart(struct history *history)
{
    assert(history->is_open);
    if (!has_changed(history)) return;
    go_back(history);
    history->document->next_id = history->next_id; // so that an object inserted again gets the same id
}

bool history_end(struct history *history)
{
    assert(history->is_open);
    if (!has_changed(history)) return history->is_open = false;
    // A saved state stays separate, so that undo can return to it.
    struct state *last = current(history);
    const bool joins = history->done > 0 && history->can_merge && history->merge != 0 &&
                       last->merge == history->merge && last->number != history->saved_number;
    void *began = joins ? last->seen[0] : NULL;
    if (joins) last->seen[0] = NULL;
    forget_from(history, history->done + (joins ? 0 : 1));
    document_destroy(history->left);
    history->left = NULL;
    if (joins) history->done--;
    history->step_count = history->done;
    history->states = need_more(history->states, history->step_count + 2, sizeof *history->states);
    const struct state next = {.document = document_copy(history->document),
                               .label = history->label,
                               .merge = history->merge,
                               .seen = {began},
                               .number = ++history->last_number,
                               .bytes = sizeof next +
                                        document_bytes_beside(current(history)->document, history->document)};
    history->states[++history->done] = next;
    history->step_count = history->done;
    history->bytes += current(history)->bytes;
    history->can_merge = true;
    history->is_open = false;

    // The oldest steps go while they exceed the limit, an eighth at a time, so that the others rarely move.
    if (history->bytes <= history->limit) return true;
    const size_t room = history->limit - history->limit / 8;
    size_t drop = 0;
    while (drop + 1 < history->step_count && history->bytes > room) {
        forget(&history->states[drop]);
        history->bytes -= history->states[++drop].bytes;
        history->states[drop].bytes = 0;
    }
    history->dropped += drop;
    history->step_count -= drop;
    history->done -= drop;
    memmove(history->states, history->states + drop, (history->step_count + 1) * sizeof *history->states);
    history->states[0].label = NULL;
    return true;
}

void history_see(struct history *history, void *began, void *ended)
{
    struct state *state = current(history);
    free(state->seen[0] ? began : NULL);
    if (!state->seen[0]) state->seen[0] = began;
    free(state->seen[1]);
    state->seen[1] = ended;
}

const void *history_seen(const struct history *history, bool undone)
{
    if (!undone) return current(history)->seen[1];
    return history->done < history->step_count ? current(history)[1].seen[0] : NULL;
}

bool history_is_open(const struct history *history) { return history->is_open; }

const struct document *history_before(const struct history *history) { return current(history)->document; }

bool history_jump(struct history *history, size_t done)
{
    assert(!history->is_open);
    if (done > history->step_count || done == history->done) return false;
    history->done = done;
    history->can_merge = false;
    go_back(history);
    return true;
}

bool history_undo(struct history *history) { return history->done > 0 && history_jump(history, history->done - 1); }

bool history_redo(struct history *history) { return history_jump(history, history->done + 1); }

size_t history_count(const struct history *history) { return history->step_count; }

size_t history_done(const struct history *history) { return history->done; }

size_t history_dropped(const struct history *history) { return history->dropped; }

size_t history_bytes(const struct history *history) { return history->bytes; }

const char *history_label(const struct history *history, size_t step)
{
    return step < history->step_count ? history->states[step + 1].label : NULL;
}

bool history_step_is_saved(const struct history *history, size_t done)
{
    return history->states[done].number == history->saved_number;
}

void history_set_limit(struct history *history, size_t bytes) { history->limit = bytes; }

uint64_t history_revision(const struct history *history) { return history->document->edits; }

static bool is_changing(const struct history *history) { return history->is_open && has_changed(history); }

void history_mark_saved(struct history *history)
{
    history->saved_number = is_changing(history) ? 0 : current(history)->number;
}

void history_mark_unsaved(struct history *history) { history->saved_number = 0; }

bool history_is_saved(const struct history *history)
{
    return !is_changing(history) && history->saved_number == current(history)->number;
}

void history_amend(struct history *history)
{
    struct state *state = current(history);
    assert(!history->is_open);
    document_destroy(state->document);
    state->document = document_copy(history->document);
}

void history_set_path(struct history *history, const char *path)
{
    const unsigned serial = history->document->serial;
    char *copy = need_text(path); // `path` may be the document's own
    document_set_path(history->document, copy);
    for (size_t i = 0; i <= history->step_count; i++) {
        if (history->states[i].document->serial == serial) document_set_path(history->states[i].document, copy);
    }
    free(copy);
}
