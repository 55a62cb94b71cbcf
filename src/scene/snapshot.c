/// Copies a document's knots in slices, while edits go on.
///
/// Knots are copied spline by spline, by sample, so the place that copying has come to parts each spline's knots in those that had their
/// turn and those that did not. What is put in or taken out before that place only moves it. Behind it, a knot that goes is copied
/// at once, out of turn, and one that comes is left out when its turn is there. So the copy is of the moment when it was begun,
/// and an edit costs no more than the knots that it changes.
#include "scene/snapshot.h"
#include "scene/load.h"
#include "scene/members.h"
#include <assert.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

/// A spline's knots: those copied in turn from the front on, those out of turn from the end back.
struct part {
    size_t first;     ///< in the array of all
    int count;        ///< when the copy was begun
    int copied, late; ///< in turn and out of turn
};

struct snapshot {
    struct document *document; ///< while it is copied
    json_t *owned;             ///< holds the unknown keys of its knots
    struct text text, paint;   ///< all but the knots
    struct part *parts;
    size_t *places; ///< where each spline's knots belong in the text
    struct knot *knots;
    unsigned char *skipped; ///< a bit for each id: not to be copied in turn
    size_t part_capacity, place_capacity, knot_capacity, skipped_capacity;
    int part_count;
    unsigned ids;     ///< a knot with this id or a higher one is a new one
    int spline, next; ///< whose turn it is
};

struct snapshot *snapshot_create(void) { return calloc(1, sizeof(struct snapshot)); }

void snapshot_destroy(struct snapshot *snapshot)
{
    if (!snapshot) return;
    snapshot_give_up(snapshot);
    json_decref(snapshot->owned);
    free(snapshot->text.data);
    free(snapshot->paint.data);
    free(snapshot->parts);
    free(snapshot->places);
    free(snapshot->knots);
    free(snapshot->skipped);
    free(snapshot);
}

/// Room for `count` things and some to spare, in place of the old one, which is lost. NULL if memory runs out.
static void *make_room(void *old, size_t *capacity, size_t count, size_t each)
{
    if (count < *capacity) return old;
    const size_t larger = count + count / 4 + 1;
    free(old);
    void *room = malloc(larger * each);
    *capacity = room ? larger : 0;
    return room;
}

static bool make_all_room(struct snapshot *snapshot, const struct document *document)
{
    const size_t splines = (size_t)document->spline_count, ids = document->next_id / CHAR_BIT + 1;
    size_t knots = 0;
    for (int s = 0; s < document->spline_count; s++) knots += (size_t)document->splines[s].knot_count;
    snapshot->parts = make_room(snapshot->parts, &snapshot->part_capacity, splines, sizeof *snapshot->parts);
    snapshot->places = make_room(snapshot->places, &snapshot->place_capacity, splines, sizeof *snapshot->places);
    snapshot->knots = make_room(snapshot->knots, &snapshot->knot_capacity, knots, sizeof *snapshot->knots);
    snapshot->skipped = make_room(snapshot->skipped, &snapshot->skipped_capacity, ids, 1);
    return snapshot->parts && snapshot->places && snapshot->knots && snapshot->skipped;
}

/// What is small: all but the knots, as text.
static bool print_rest(struct snapshot *snapshot, const struct document *document, const char *folder)
{
    struct text *text = &snapshot->text, *paint = &snapshot->paint;
    text->size = paint->size = 0;
    text->no_memory = false;
    print_document(text, document, folder, snapshot->places);
    return scene_print_paint(document, &paint->data, &paint->capacity, &paint->size) && !text->no_memory;
}

bool snapshot_begin(struct snapshot *snapshot, struct document *document, const char *folder)
{
    snapshot_give_up(snapshot);
    if (!make_all_room(snapshot, document) || !print_rest(snapshot, document, folder)) return false;
    json_decref(snapshot->owned);
    snapshot->owned = json_incref(document->owned);
    snapshot->part_count = document->spline_count;
    size_t first = 0;
    for (int s = 0; s < document->spline_count; s++) {
        const int count = document->splines[s].knot_count;
        snapshot->parts[s] = (struct part){.first = first, .count = count};
        first += (size_t)count;
    }
    snapshot->ids = document->next_id;
    memset(snapshot->skipped, 0, document->next_id / CHAR_BIT + 1);
    snapshot->spline = snapshot->next = 0;
    snapshot->document = document;
    document->snapshot = snapshot;
    document->watched = &snapshot->document;
    return true;
}

void snapshot_give_up(struct snapshot *snapshot)
{
    if (!snapshot->document) return;
    snapshot->document->snapshot = NULL;
    snapshot->document->watched = NULL;
    snapshot->document = NULL;
}

bool snapshot_is_running(const struct snapshot *snapshot) { return snapshot->document; }

static bool is_skipped(const struct snapshot *snapshot, unsigned id)
{
    return id >= snapshot->ids || (snapshot->skipped[id / CHAR_BIT] >> id % CHAR_BIT & 1);
}

bool snapshot_continue(struct snapshot *snapshot, int knots)
{
    struct document *document = snapshot->document;
    if (!document) return false;
    while (snapshot->spline < snapshot->part_count) {
        const struct spline *spline = &document->splines[snapshot->spline];
        struct part *part = &snapshot->parts[snapshot->spline];
        for (; snapshot->next < spline->knot_count; snapshot->next++) {
            if (knots-- == 0) return false;
            const struct knot *knot = &spline->knots[snapshot->next];
            if (is_skipped(snapshot, knot->id)) continue;
            assert(part->copied + part->late < part->count);
            snapshot->knots[part->first + (size_t)part->copied++] = *knot;
        }
        snapshot->spline++;
        snapshot->next = 0;
    }
    snapshot_give_up(snapshot);
    return true;
}

void snapshot_finish(struct snapshot *snapshot) { snapshot_continue(snapshot, INT_MAX); }

/// Whether a knot there had its turn; then the turn moves by one as it goes or comes.
static bool had_turn(struct snapshot *snapshot, int spline, int at, int move)
{
    if (spline != snapshot->spline) return spline < snapshot->spline;
    if (at >= snapshot->next) return false;
    snapshot->next += move;
    return true;
}

void snapshot_knot_goes(const struct document *document, int spline, int at)
{
    struct snapshot *snapshot = document->snapshot;
    const struct knot *knot = &document->splines[spline].knots[at];
    if (!snapshot || had_turn(snapshot, spline, at, -1) || is_skipped(snapshot, knot->id)) return;
    struct part *part = &snapshot->parts[spline];
    assert(part->copied + part->late < part->count);
    snapshot->knots[part->first + (size_t)(part->count - ++part->late)] = *knot;
}

void snapshot_knot_came(const struct document *document, int spline, int at)
{
    struct snapshot *snapshot = document->snapshot;
    if (!snapshot || had_turn(snapshot, spline, at, 1)) return;
    const unsigned id = document->splines[spline].knots[at].id;
    if (id < snapshot->ids) snapshot->skipped[id / CHAR_BIT] |= (unsigned char)(1u << id % CHAR_BIT);
}

static int compare_frames(const void *a, const void *b)
{
    const struct knot *left = a, *right = b;
    return (left->frame > right->frame) - (left->frame < right->frame);
}

bool snapshot_print(struct snapshot *snapshot, char **buffer, size_t *capacity, size_t *size)
{
    struct text text = {.data = *buffer, .capacity = *capacity};
    size_t from = 0;
    for (int s = 0; s < snapshot->part_count; s++) {
        text_bytes(&text, snapshot->text.data + from, snapshot->places[s] - from);
        from = snapshot->places[s];
        const struct part *part = &snapshot->parts[s];
        struct knot *knots = snapshot->knots + part->first;
        if (part->late > 0) qsort(knots, (size_t)part->count, sizeof *knots, compare_frames);
        print_knots(&text, knots, part->count);
    }
    text_bytes(&text, snapshot->text.data + from, snapshot->text.size - from);
    if (snapshot->paint.size > 0) text_bytes(&text, snapshot->paint.data, snapshot->paint.size);
    *buffer = text.data;
    *capacity = text.capacity;
    *size = text.size;
    return !text.no_memory;
}
