/// The history: steps of changes, undo and redo.
#include "scene/change.h"
#include "scene/edit.h"
#include "scene/pins.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_STEPS = 1024, FIRST_DIRTY = 64 };

/// Bytes in use. The arrays double as they grow, so they may take up to 256 MiB.
static const size_t DEFAULT_LIMIT = (size_t)128 << 20;

struct step {
    const char *label;
    uint64_t merge;
    uint64_t state; ///< the document's, after it
    size_t end;     ///< its changes end here in the list of all
    size_t bytes;   ///< that it takes with its changes
};

struct history {
    struct change_list changes; ///< of all steps
    struct step *steps;
    size_t step_count, step_capacity;
    size_t done;          ///< steps that are not undone
    size_t bytes, limit;  ///< of all steps
    size_t dropped;       ///< steps dropped for newer ones
    uint64_t first_state; ///< the document's before the first step
    uint64_t last_state, saved_state, revision;

    struct change_list open; ///< the open step's: kept apart, so that a cancelled drag leaves redo alone
    size_t open_bytes;       ///< that it takes
    bool is_open, can_merge;
    const char *label;
    uint64_t merge;
    unsigned next_id, next_spline_id; ///< the document's, before the open step's first change

    bool *dirty;
    size_t dirty_capacity;
    bool all_dirty;
};

static void release_from(struct change_list *list, size_t count)
{
    while (list->count > count) change_release(&list->items[--list->count]);
}

struct history *history_create(void)
{
    struct history *history = calloc(1, sizeof *history);
    if (!history) return NULL;
    history->steps = malloc(FIRST_STEPS * sizeof *history->steps);
    history->step_capacity = FIRST_STEPS;
    history->limit = DEFAULT_LIMIT;
    history->dirty = calloc(FIRST_DIRTY, sizeof *history->dirty);
    history->dirty_capacity = FIRST_DIRTY;
    if (history->steps && history->dirty && change_list_reserve(&history->changes, 1) &&
        change_list_reserve(&history->open, 1)) {
        history_clear(history);
        return history;
    }
    history_destroy(history);
    return NULL;
}

void history_destroy(struct history *history)
{
    if (!history) return;
    release_from(&history->changes, 0);
    release_from(&history->open, 0);
    free(history->changes.items);
    free(history->open.items);
    free(history->steps);
    free(history->dirty);
    free(history);
}

static void forget_steps(struct history *history)
{
    release_from(&history->changes, 0);
    history->dropped += history->step_count;
    history->step_count = history->done = 0;
    history->bytes = 0;
    history->first_state = ++history->last_state;
    history->can_merge = false;
}

void history_clear(struct history *history)
{
    forget_steps(history);
    release_from(&history->open, 0);
    history->dropped = 0;
    history->is_open = false;
    history->saved_state = history->first_state;
    history->revision++;
    history->all_dirty = true;
}

bool history_set_folder(struct history *history, struct document *document, const char *folder)
{
    const struct change_list *all = &history->changes, *open = &history->open;
    const size_t now = history->done > 0 ? history->steps[history->done - 1].end : 0;
    bool moved = true;
    // beyond a change of the document it is another's, which has a folder of its own
    for (size_t i = now; i > 0 && all->items[i - 1].kind != CHANGE_DOCUMENT; i--)
        moved &= change_rebase(&all->items[i - 1], document->folder, folder);
    for (size_t i = now; i < all->count && all->items[i].kind != CHANGE_DOCUMENT; i++)
        moved &= change_rebase(&all->items[i], document->folder, folder);
    for (size_t i = 0; history->is_open && i < open->count; i++)
        moved &= change_rebase(&open->items[i], document->folder, folder);
    return document_set_folder(document, folder) && moved;
}

static uint64_t current_state(const struct history *history)
{
    return history->done > 0 ? history->steps[history->done - 1].state : history->first_state;
}

void history_begin(struct history *history, const char *label, uint64_t merge)
{
    assert(!history->is_open);
    history->is_open = true;
    history->label = label;
    history->merge = merge;
    history->open.count = 0;
}

static void mark_dirty(struct history *history, const struct change *change)
{
    if (change_concerns_all(change)) history->all_dirty = true;
    if (change->spline < 0) return;
    size_t spline = (size_t)change->spline, capacity = history->dirty_capacity;
    while (capacity <= spline) capacity *= 2;
    if (capacity > history->dirty_capacity) {
        bool *dirty = realloc(history->dirty, capacity);
        if (!dirty) {
            history->all_dirty = true;
            return;
        }
        memset(dirty + history->dirty_capacity, 0, capacity - history->dirty_capacity);
        history->dirty = dirty;
        history->dirty_capacity = capacity;
    }
    history->dirty[spline] = true;
}

static void swap_change(struct history *history, struct change *change, struct document *document)
{
    change_swap(change, document);
    mark_dirty(history, change);
}

/// Whether the edited document's pins are as a file may have them.
static bool suits_pins(const struct document *document, const struct edit *edit, struct error *error)
{
    struct pin_trouble trouble;
    const bool follows = edit->kind == EDIT_PARAMETER && edit->param.track >= 0;
    const bool regroups = edit->kind == EDIT_PIN_ADD || edit->kind == EDIT_FEED || edit->kind == EDIT_CHANNEL_ADD ||
                          edit->kind == EDIT_DRIVE || edit->kind == EDIT_DRIVE_ADD || edit->kind == EDIT_FLOOR;
    if (edit->kind == EDIT_DOCUMENT || !pins_hold_any(document)) return true;
    if (pins_check(document, &trouble) && (!(follows || regroups) || pins_check_order(document, &trouble)))
        return true;
    const struct rig *rig = &document->rigs[trouble.rig];
    return fail(error, ERROR_INPUT, "%s: %s: %s", rig_title(rig), trouble.pin >= 0 ? "pins" : trouble.member,
                trouble.sentence);
}

bool history_apply(struct history *history, struct document *document, const struct edit *edit, struct error *error)
{
    assert(history->is_open);
    size_t from = history->open.count;
    if (from == 0) {
        history->next_id = document->next_id;
        history->next_spline_id = document->next_spline_id;
    }
    if (!edit_plan(document, edit, &history->open, error)) {
        release_from(&history->open, from);
        return false;
    }
    if (from == 0) history->open_bytes = 0;
    for (size_t i = from; i < history->open.count; i++) swap_change(history, &history->open.items[i], document);
    if (!suits_pins(document, edit, error)) {
        for (size_t i = history->open.count; i > from; i--)
            swap_change(history, &history->open.items[i - 1], document);
        release_from(&history->open, from);
        return false;
    }
    for (size_t i = from; i < history->open.count; i++) {
        history->open_bytes += change_bytes(&history->open.items[i], document);
    }
    history->revision++;
    return true;
}

void history_restart(struct history *history, struct document *document)
{
    struct change_list *open = &history->open;
    assert(history->is_open);
    if (open->count == 0) return;
    for (size_t i = open->count; i > 0; i--) swap_change(history, &open->items[i - 1], document);
    release_from(open, 0);
    document->next_id = history->next_id; // so that what is inserted again gets the same ids
    document->next_spline_id = history->next_spline_id;
    history->revision++;
}

static bool reserve_step(struct history *history)
{
    if (history->step_count < history->step_capacity) return true;
    struct step *steps = realloc(history->steps, 2 * history->step_capacity * sizeof *steps);
    if (!steps) return false;
    history->steps = steps;
    history->step_capacity *= 2;
    return true;
}

/// Drops the oldest steps to make room for `more` bytes, an eighth of the limit at a time, so that the rest rarely move.
static void drop_oldest(struct history *history, size_t more)
{
    size_t drop = 0, kept = history->bytes, room = history->limit - history->limit / 8;
    if (history->step_count == 0 || kept + more <= history->limit) return;
    while (drop < history->step_count && (drop == 0 || kept + more > room)) kept -= history->steps[drop++].bytes;
    size_t changes = history->steps[drop - 1].end;
    history->first_state = history->steps[drop - 1].state;
    history->dropped += drop;
    history->step_count -= drop;
    history->done -= drop;
    for (size_t i = 0; i < changes; i++) change_release(&history->changes.items[i]);
    history->bytes = kept;
    history->changes.count -= changes;
    memmove(history->steps, history->steps + drop, history->step_count * sizeof *history->steps);
    memmove(history->changes.items, history->changes.items + changes,
            history->changes.count * sizeof *history->changes.items);
    for (size_t i = 0; i < history->step_count; i++) history->steps[i].end -= changes;
}

static void forget_undone(struct history *history)
{
    while (history->step_count > history->done) history->bytes -= history->steps[--history->step_count].bytes;
    release_from(&history->changes, history->done > 0 ? history->steps[history->done - 1].end : 0);
}

/// Whether the open step joins the last one. A saved state stays a step of its own, so that undo can return to it.
static bool joins_last(const struct history *history)
{
    return history->done > 0 && history->can_merge && history->merge != 0 &&
           history->steps[history->done - 1].merge == history->merge && !history_is_saved(history);
}

void history_end(struct history *history)
{
    struct change_list *all = &history->changes, *open = &history->open;
    assert(history->is_open);
    history->is_open = false;
    if (open->count == 0) return;
    for (size_t i = 0; i < open->count; i++) history->open_bytes -= change_settle(&open->items[i]);
    forget_undone(history);
    bool wants_to_join = joins_last(history);
    size_t bytes = history->open_bytes + sizeof *history->steps;
    drop_oldest(history, bytes);
    bool joins = wants_to_join && history->done > 0;
    if (!change_list_reserve(all, open->count) || !reserve_step(history)) {
        forget_steps(history); // losing undo is better than losing work
        release_from(open, 0);
        return;
    }
    memcpy(all->items + all->count, open->items, open->count * sizeof *open->items);
    all->count += open->count;
    open->count = 0;
    if (joins) bytes -= sizeof *history->steps;
    if (!joins)
        history->steps[history->step_count++] = (struct step){.label = history->label, .merge = history->merge};
    history->done = history->step_count;
    history->steps[history->done - 1].state = ++history->last_state;
    history->steps[history->done - 1].end = all->count;
    history->steps[history->done - 1].bytes += bytes;
    history->bytes += bytes;
    history->can_merge = true;
}

bool history_is_open(const struct history *history) { return history->is_open; }

bool history_undo(struct history *history, struct document *document)
{
    assert(!history->is_open);
    if (history->done == 0) return false;
    size_t end = history->steps[--history->done].end;
    size_t begin = history->done > 0 ? history->steps[history->done - 1].end : 0;
    while (end > begin) swap_change(history, &history->changes.items[--end], document);
    history->can_merge = false;
    history->revision++;
    return true;
}

bool history_redo(struct history *history, struct document *document)
{
    assert(!history->is_open);
    if (history->done == history->step_count) return false;
    size_t begin = history->done > 0 ? history->steps[history->done - 1].end : 0;
    size_t end = history->steps[history->done++].end;
    for (; begin < end; begin++) swap_change(history, &history->changes.items[begin], document);
    history->can_merge = false;
    history->revision++;
    return true;
}

const char *history_undo_label(const struct history *history)
{
    return history->done > 0 ? history->steps[history->done - 1].label : NULL;
}

const char *history_redo_label(const struct history *history)
{
    return history->done < history->step_count ? history->steps[history->done].label : NULL;
}

bool history_jump(struct history *history, struct document *document, size_t done)
{
    if (done > history->step_count || done == history->done) return false;
    while (history->done > done) history_undo(history, document);
    while (history->done < done) history_redo(history, document);
    return true;
}

size_t history_count(const struct history *history) { return history->step_count; }

size_t history_done(const struct history *history) { return history->done; }

size_t history_dropped(const struct history *history) { return history->dropped; }

size_t history_bytes(const struct history *history) { return history->bytes; }

const char *history_label(const struct history *history, size_t step)
{
    assert(step < history->step_count);
    return history->steps[step].label;
}

bool history_step_is_saved(const struct history *history, size_t done)
{
    uint64_t state = done > 0 ? history->steps[done - 1].state : history->first_state;
    return state == history->saved_state;
}

void history_set_limit(struct history *history, size_t bytes) { history->limit = bytes; }

uint64_t history_revision(const struct history *history) { return history->revision; }

void history_mark_saved(struct history *history)
{
    history->saved_state = history->open.count > 0 && history->is_open ? 0 : current_state(history);
}

void history_mark_unsaved(struct history *history) { history->saved_state = 0; }

bool history_is_saved(const struct history *history)
{
    bool changing = history->is_open && history->open.count > 0;
    return !changing && history->saved_state == current_state(history);
}

void history_take_dirty(struct history *history, const struct document *document, bool *dirty, int count)
{
    for (int i = 0; i < count; i++) {
        bool known = (size_t)i < history->dirty_capacity;
        dirty[i] = history->all_dirty || (known && i < document->spline_count && history->dirty[i]);
        if (known) history->dirty[i] = false;
    }
    history->all_dirty = false;
}
