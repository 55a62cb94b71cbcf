/// The motion of a body that is dragged while it is recorded: one place for each sample that the playhead passes.
#include "editor/core/core.h"
#include "editor/stage/hold.h"
#include <math.h>
#include <stdlib.h>

void record_begin(struct stage *stage, struct core *core)
{
    struct record *record = &stage->record;
    if (record->running) return;
    *record = (struct record){.running = true, .first = (int)ceil(core->playback.position)};
    core->playback.playing = true;
    core_message(core, false, "Recording the body: release to keep it.");
}

void record_advance(struct stage *stage, const struct core *core, const struct editor_world *world)
{
    struct record *record = &stage->record;
    if (!record->running || !body_is_held(core)) return;
    double offset[3], position = core->playback.position;
    hold_way(stage, core, offset);
    int next = record->first + record->count;
    bool ended = position < next - 1 || !core->playback.playing || record->count == RECORD_SAMPLES ||
                 next >= document_samples(world->document);
    if (ended) {
        record->running = false;
        return;
    }
    const double from = record->seen_position, span = position - from;
    for (; next <= position && record->count < RECORD_SAMPLES; next++) {
        double share = span > 0 && record->count > 0 ? fmax(0, (next - from) / span) : 1;
        for (int k = 0; k < 3; k++) {
            record->way[k][record->count] = record->seen[k] + share * (offset[k] - record->seen[k]);
        }
        record->count++;
    }
    record->seen_position = position;
    for (int k = 0; k < 3; k++) record->seen[k] = offset[k];
}

bool record_has_motion(const struct stage *stage) { return stage->record.count >= 3; }

void record_forget(struct stage *stage) { stage->record = (struct record){0}; }

/// The cubic through some of the values, level at both ends; false where it could not be solved.
static bool solve_through(wiggly_solver *solver, const double *values, int count, const int *knots, int knot_count,
                          wiggly_knot *buffer, double *total)
{
    wiggly_desc desc = wiggly_default_desc();
    wiggly_curve curve = {.total = total};
    desc.samples = count;
    desc.mode = WIGGLY_CUBIC;
    for (int i = 0; i < knot_count; i++) {
        bool end = i == 0 || i == knot_count - 1;
        buffer[i] = (wiggly_knot){
            .sample = knots[i], .value = values[knots[i]], .has_slope = end, .stiffness = RECORD_STIFFNESS};
    }
    desc.knots = buffer;
    desc.knot_count = knot_count;
    return wiggly_solve(solver, &desc, &curve) < WIGGLY_ERROR_ARGUMENT;
}

/// The sample at which two curves are farthest apart, and how far. Neighbours of the ends are left out: a knot there would take
/// the end's slope away.
static int farthest(const double *a, const double *b, int count, double *distance)
{
    int at = 0;
    *distance = 0;
    for (int i = 2; i < count - 2; i++) {
        double d = fabs(a[i] - b[i]);
        if (d > *distance) *distance = d, at = i;
    }
    return at;
}

static void insert_sorted(int *knots, int count, int sample)
{
    int i = count;
    for (; i > 0 && knots[i - 1] > sample; i--) knots[i] = knots[i - 1];
    knots[i] = sample;
}

int record_simplify(const double *values, int count, double tolerance, wiggly_method method, int *knots, int capacity)
{
    wiggly_solver *solver = NULL;
    double *total = malloc((size_t)count * sizeof *total), miss = 0;
    wiggly_knot *buffer = malloc((size_t)capacity * sizeof *buffer);
    int made = 2;
    knots[0] = 0;
    knots[1] = count - 1;
    bool good = total && buffer && wiggly_create(count, capacity, &solver) == WIGGLY_OK;
    if (good) wiggly_set_method(solver, method);
    while (good && solve_through(solver, values, count, knots, made, buffer, total)) {
        int at = farthest(values, total, count, &miss);
        if (miss <= tolerance || made == capacity) break;
        insert_sorted(knots, made++, at);
    }
    wiggly_destroy(solver);
    free(buffer);
    free(total);
    return good ? made : 0;
}
