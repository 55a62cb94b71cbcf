/// Solves long documents in a thread, and shows the visible part at once.
#include "scene/background.h"
#include "scene/pins.h"
#include "scene/preview.h"
#include "scene/storage.h"
#include "scene/worker.h"
#include "spline/desc.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Nanoseconds a sample, measured on the slowest machine at hand under load: with constant parameters and cold caches; with tracks or
/// a loop.
enum { CHAIN_COST = 4, BAND_COST = 1000 };

static const double LONG = 2e6; ///< nanoseconds; a spline that takes more is left to the thread

/// Seconds that a frame with an edit waits for the thread, so that a quick solve shows in the same frame.
static const double PATIENCE = 0.004;

/// Seconds after which a newer edit abandons a running solve. Shorter solves are shown, so that the curve keeps up with a slider.
static const double WORTH_SHOWING = 0.1;

enum {
    WIDEST = 1 << 18, ///< samples on screen that are read in a frame: 0.5 ms
    AROUND = 1 << 13, ///< on each side of the playhead and of a knot that moved
};

struct background {
    struct worker *worker;
    double *numbers; ///< ROWS · N for `spare`, which later swaps places with curves
    double *marks;
    int samples; ///< N there is room for
    wiggly_curve spare;
    struct extremes spare_extremes;
    bool *pending; ///< for each spline: edited since its last job began
    int splines;
    wiggly_desc desc; ///< of the running job, or the last one
    int solving;      ///< spline being solved, -1: none
    int condensing;   ///< spline being condensed into a take, -1: none
    int turn;         ///< place in the order where the search for the next spline starts
    struct preview preview;
    int unfit;        ///< spline that could not become a take as it last was, -1: none
    bool knots_alone; ///< the last two solves differ in knots only: a take will help
};

static bool uses_band(const struct spline *spline)
{
    for (int p = 0; p < PARAMETER_COUNT; p++) {
        if (param_follows(&spline->parameter[p]) && spline_uses(spline, (enum parameter)p, false)) return true;
    }
    return spline_start(spline) == WIGGLY_LOOP;
}

bool background_serves(const struct document *document, wiggly_method method)
{
    double samples = document_samples(document);
    if (pins_hold_any(document)) return false;
    if (samples * BAND_COST <= LONG) return false;
    if (samples * CHAIN_COST > LONG || method == WIGGLY_BAND) return document->spline_count > 0;
    for (int s = 0; s < document->spline_count; s++) {
        if (uses_band(&document->splines[s])) return true;
    }
    return false;
}

void background_destroy(struct background *background)
{
    if (!background) return;
    struct job job = {0};
    if (background->worker) worker_stop(background->worker);
    if (background->worker && worker_collect(background->worker, INFINITY, &job) && job.kind == WORK_TAKE)
        wiggly_take_destroy(job.take);
    worker_destroy(background->worker);
    wiggly_take_destroy(background->preview.take);
    free(background->numbers);
    free(background->marks);
    free(background->pending);
    free(background);
}

static struct background *background_create(void)
{
    struct background *background = calloc(1, sizeof *background);
    if (background && (background->worker = worker_create())) return background;
    background_destroy(background);
    return NULL;
}

static bool reserve(struct background *b, int splines, int samples)
{
    if (samples > b->samples) {
        free(b->numbers);
        free(b->marks);
        b->numbers = calloc(ROWS * (size_t)samples, sizeof *b->numbers);
        b->marks = calloc(2 * extremes_blocks(samples), sizeof *b->marks);
        b->samples = b->numbers && b->marks ? samples : 0;
    }
    if (splines > b->splines) {
        free(b->pending);
        b->pending = calloc((size_t)splines, sizeof *b->pending);
        b->splines = b->pending ? splines : 0;
    }
    return b->samples >= samples && b->splines >= splines;
}

/// Starts over after a new layout. Without enough memory this layout gets no thread.
static void begin(struct evaluation *evaluation)
{
    struct storage *storage = evaluation->storage;
    if (!storage->background) storage->background = background_create();
    struct background *b = storage->background;
    if (b && !reserve(b, evaluation->count, evaluation->samples)) {
        background_destroy(b);
        b = storage->background = NULL;
    }
    storage->threaded_layout = storage->layout;
    if (!b) return;
    storage_place(&b->spare, b->numbers, evaluation->samples);
    double *marks = storage_wants_extremes(evaluation->samples) ? b->marks : NULL;
    b->spare_extremes = storage_extremes(marks, evaluation->samples);
    memset(b->pending, 0, (size_t)b->splines);
    wiggly_take_destroy(b->preview.take);
    b->preview = (struct preview){.spline = -1, .moved = -1};
    b->desc = (wiggly_desc){0};
    b->solving = b->condensing = b->unfit = -1;
    b->turn = 0;
    b->knots_alone = false;
}

static bool follows(const struct spline *spline, int leader, bool cubic)
{
    for (int p = 0; p < PARAMETER_COUNT; p++) {
        if (spline->parameter[p].track == leader && spline_uses(spline, (enum parameter)p, cubic)) return true;
    }
    return false;
}

/// The thread's rows become the spline's; its followers are solved next.
static void show_solved(struct evaluation *evaluation, const struct document *document, const struct job *job)
{
    struct storage *storage = evaluation->storage;
    struct background *b = storage->background;
    int spline = b->solving;
    b->solving = -1;
    if (job->stopped) {
        b->pending[spline] = true;
        return;
    }
    b->spare = evaluation->curves[spline];
    b->spare_extremes = storage->extremes[spline];
    evaluation->curves[spline] = job->curve;
    storage->extremes[spline] = job->extremes;
    evaluation->status[spline] = job->status;
    storage_curve_changed(evaluation, spline);
    evaluation->solved_splines++;
    evaluation->solved_samples += job->desc.samples;
    evaluation->solved_knots += job->desc.knot_count;
    for (int s = 0; s < evaluation->count; s++) {
        if (follows(&document->splines[s], spline, evaluation->cubic)) b->pending[s] = true;
    }
}

/// Brings the take up to what the document says of its spline; the band has none.
static void update_preview(const struct evaluation *evaluation, const struct document *document)
{
    struct preview *preview = &evaluation->storage->background->preview;
    wiggly_desc desc =
        storage_describe(evaluation->storage, evaluation->curves, document, preview->spline, evaluation->cubic);
    preview->is_current = false;
    if (evaluation->method == WIGGLY_CHAIN) preview_update(preview, document, &desc);
}

static void adopt_take(struct evaluation *evaluation, const struct document *document, const struct job *job)
{
    struct background *b = evaluation->storage->background;
    b->preview = (struct preview){.take = job->take, .spline = b->condensing, .moved = -1};
    if (!job->take) b->unfit = b->condensing;
    b->condensing = -1;
    if (job->take) update_preview(evaluation, document);
}

/// Collects the thread's job if it finishes within `seconds`.
static bool collect(struct evaluation *evaluation, const struct document *document, double seconds)
{
    struct background *b = evaluation->storage->background;
    struct job job;
    if (!worker_collect(b->worker, seconds, &job)) return false;
    if (job.kind == WORK_SOLVE) {
        show_solved(evaluation, document, &job);
    } else {
        adopt_take(evaluation, document, &job);
    }
    return true;
}

static void give(struct evaluation *evaluation, const struct document *document, int spline, enum work kind)
{
    struct storage *storage = evaluation->storage;
    struct background *b = storage->background;
    wiggly_desc desc = storage_describe(evaluation->storage, evaluation->curves, document, spline, evaluation->cubic);
    storage_add_knots(&desc, document, spline, storage->knots);
    struct job job = {.kind = kind, .desc = desc, .solver = storage->solver};
    if (kind == WORK_SOLVE) {
        wiggly_set_method(storage->solver, storage->method);
        job.curve = b->spare;
        job.extremes = b->spare_extremes;
        b->knots_alone = desc_same_settings(&b->desc, &desc);
        b->pending[spline] = false;
        b->solving = spline;
    } else {
        job.take = b->preview.take;
        b->preview = (struct preview){.spline = -1, .moved = -1};
        b->knots_alone = false;
        b->condensing = spline;
    }
    b->desc = desc;
    worker_give(b->worker, &job);
}

/// The next pending spline after the last one in dependency order, so that none starves; -1: none.
static int next_pending(const struct storage *storage, int count)
{
    struct background *b = storage->background;
    for (int n = 0; n < count; n++) {
        int place = (b->turn + n) % count;
        if (!b->pending[storage->order[place]]) continue;
        b->turn = place + 1;
        return storage->order[place];
    }
    b->turn = 0;
    return -1;
}

static bool wants_take(const struct evaluation *evaluation, const struct document *document,
                       const struct focus *focus)
{
    const struct background *b = evaluation->storage->background;
    bool has = b->preview.take && b->preview.spline == focus->spline && b->preview.is_current;
    if (focus->spline < 0 || has || focus->spline == b->unfit || evaluation->method == WIGGLY_BAND) return false;
    wiggly_desc desc =
        storage_describe(evaluation->storage, evaluation->curves, document, focus->spline, evaluation->cubic);
    return preview_serves(&desc);
}

/// Gives an idle thread its next job: rows before a take, unless knots are being moved and there is no take yet.
static void give_next(struct evaluation *evaluation, const struct document *document, const struct focus *focus)
{
    struct storage *storage = evaluation->storage;
    struct background *b = storage->background;
    if (worker_has_job(b->worker)) return;
    bool take = wants_take(evaluation, document, focus);
    int spline = take && b->knots_alone ? -1 : next_pending(storage, evaluation->count);
    if (spline >= 0) {
        give(evaluation, document, spline, WORK_SOLVE);
    } else if (take) {
        give(evaluation, document, focus->spline, WORK_TAKE);
    }
}

static bool is_stale(const struct background *b, int count)
{
    for (int s = 0; s < count; s++) {
        if (b->pending[s]) return true;
    }
    return b->solving >= 0;
}

/// Whether the thread is reading that spline's rows as a track.
static bool is_read(const struct evaluation *evaluation, const struct background *b, int spline)
{
    return b->solving >= 0 && desc_reads(&b->desc, evaluation->curves[spline].total);
}

/// Reads what is on screen from the take where the rows are older. false if there is no take for it.
static bool show_preview(struct evaluation *evaluation, const struct focus *focus)
{
    struct storage *storage = evaluation->storage;
    struct background *b = storage->background;
    struct preview *preview = &b->preview;
    int spline = preview->spline;
    if (!preview->take || !preview->is_current || !(b->pending[spline] || b->solving == spline)) return false;
    if (is_read(evaluation, b, spline)) return false;
    const wiggly_curve *curve = &evaluation->curves[spline];
    const struct extremes *extremes = &storage->extremes[spline];
    bool good = preview_show(preview, curve, extremes, focus->at - AROUND, 2 * AROUND);
    if (good && preview->moved >= 0)
        good = preview_show(preview, curve, extremes, preview->moved - AROUND, 2 * AROUND);
    if (good && focus->count <= WIDEST) good = preview_show(preview, curve, extremes, focus->first, focus->count);
    if (!good) b->unfit = spline;
    storage_curve_changed(evaluation, spline);
    return good;
}

/// Stops a long solve whose spline, or one that it follows, was edited again: it would come late and hold up newer previews.
static void drop_superseded(const struct evaluation *evaluation, const struct document *document)
{
    const struct background *b = evaluation->storage->background;
    if (b->solving < 0 || worker_seconds(b->worker) < WORTH_SHOWING) return;
    bool superseded = b->pending[b->solving];
    for (int s = 0; s < evaluation->count; s++) {
        if (b->pending[s] && follows(&document->splines[b->solving], s, evaluation->cubic)) superseded = true;
    }
    if (superseded) worker_stop(b->worker);
}

/// Marks what an edit made out of date; false if nothing was edited.
static bool mark(struct evaluation *evaluation, const struct document *document, const bool *dirty, bool cubic)
{
    struct storage *storage = evaluation->storage;
    struct background *b = storage->background;
    bool all = cubic != evaluation->cubic || evaluation->method != storage->method, any = false;
    evaluation->cubic = cubic;
    storage->method = evaluation->method;
    for (int s = 0; s < evaluation->count; s++) {
        if (!all && !dirty[s] && !storage->baked[s].is_new) continue;
        b->pending[s] = any = true;
        storage->baked[s].is_new = false;
        if (s == b->unfit) b->unfit = -1;
        if (s == b->preview.spline && b->preview.take) update_preview(evaluation, document);
    }
    return any;
}

void background_update(struct evaluation *evaluation, const struct document *document, const bool *dirty, bool cubic,
                       const struct focus *focus)
{
    struct storage *storage = evaluation->storage;
    struct order_cycle cycle;
    bool fits = evaluation->count == document->spline_count && evaluation->samples == document_samples(document);
    if (!fits || !scene_order(document, storage->space, storage->order, &cycle)) return;
    bool begun = storage->threaded_layout == storage->layout;
    if (!dirty || storage->is_new || !begun || !storage->background) {
        evaluation_update(evaluation, document, dirty, cubic);
        if (!begun) begin(evaluation);
        return;
    }
    evaluation->solved_splines = evaluation->solved_samples = evaluation->solved_knots = 0;
    struct background *b = storage->background;
    collect(evaluation, document, 0);
    bool edited = mark(evaluation, document, dirty, cubic);
    if (edited) drop_superseded(evaluation, document);
    bool shown = show_preview(evaluation, focus);
    give_next(evaluation, document, focus);
    while (edited && !shown && b->solving >= 0 && collect(evaluation, document, PATIENCE)) {
        give_next(evaluation, document, focus);
    }
    if (!shown) show_preview(evaluation, focus);
    evaluation->stale = is_stale(b, evaluation->count);
}

void background_settle(struct evaluation *evaluation, const struct document *document, const struct focus *focus)
{
    struct storage *storage = evaluation->storage;
    if (!storage || !storage->background) return;
    do {
        give_next(evaluation, document, focus);
    } while (collect(evaluation, document, INFINITY));
    evaluation->stale = is_stale(storage->background, evaluation->count);
}

void background_halt(struct evaluation *evaluation)
{
    struct storage *storage = evaluation->storage;
    struct background *b = storage->background;
    struct job job;
    if (!b) return;
    b->preview.is_current = false;
    worker_stop(b->worker);
    if (!worker_collect(b->worker, INFINITY, &job)) return;
    if (job.kind == WORK_TAKE) wiggly_take_destroy(job.take);
    if (b->solving >= 0) b->pending[b->solving] = true;
    b->solving = b->condensing = -1;
}

void background_forget(struct evaluation *evaluation)
{
    struct storage *storage = evaluation->storage;
    background_halt(evaluation);
    if (storage->background) memset(storage->background->pending, 0, (size_t)storage->background->splines);
}
