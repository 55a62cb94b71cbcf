/// Solves a meadow's reeds in one batch, and places them.
#include "rig/meadow.h"
#include "base/hash.h"
#include "base/need.h"
#include "base/pool.h"
#include <math.h>
#include <stdlib.h>

enum { ROWS = 4 }; ///< of a reed's curve: re, im, y, omega

struct meadow {
    struct pool pool; ///< of the arrays
    wiggly_batch *batch;
    int most, most_samples, most_knots; ///< there is room for
    wiggly_desc *descs;
    wiggly_curve *curves;
    struct reed *reeds;
    double *numbers;
    wiggly_knot *knots;
    int count;
    int solved;      ///< by the last update
    uint64_t key;    ///< hash of what is solved; 0: nothing
    uint64_t ground; ///< hash of the reeds' places
};

struct meadow *meadow_create(void) { return need_zeroed(1, sizeof(struct meadow)); }

void meadow_destroy(struct meadow *meadow)
{
    if (!meadow) return;
    wiggly_batch_destroy(meadow->batch);
    pool_free(&meadow->pool);
    free(meadow);
}

static void make_room(struct meadow *m, int count, int samples, int knots)
{
    const bool fits = count <= m->most && samples <= m->most_samples && knots <= m->most_knots;
    if (m->batch && fits) return;
    wiggly_batch_destroy(m->batch);
    pool_free(&m->pool);
    m->most = count, m->most_samples = samples, m->most_knots = knots;
    m->descs = pool_take(&m->pool, (size_t)count, sizeof *m->descs);
    m->curves = pool_take(&m->pool, (size_t)count, sizeof *m->curves);
    m->reeds = pool_take(&m->pool, (size_t)count, sizeof *m->reeds);
    m->numbers = pool_take(&m->pool, (size_t)count * ROWS * (size_t)samples, sizeof *m->numbers);
    m->knots = pool_take(&m->pool, (size_t)knots, sizeof *m->knots);
    if (wiggly_batch_create(samples, knots + samples, 1, &m->batch) != WIGGLY_OK) need_failed();
}

/// A number from 0 to 1 that depends only on the seed, the reed and `what`.
static float chance(int seed, int reed, int what)
{
    const int key[] = {seed, reed, what};
    return (float)(hash_bytes(HASH_START, key, sizeof key) >> 40) * 0x1p-24f;
}

/// On a grid, each at a random place in its cell, so that there are neither rows nor clumps. The grid's square is mapped to the ellipse inside
/// it, thinner and with shorter reeds towards its edge.
static struct reed plant(const struct meadow_rig *rig, int reed)
{
    const double wide = rig->area[0], deep = rig->area[1];
    const int columns = (int)fmax(1, round(sqrt(rig->count * wide / deep))),
              rows = (rig->count + columns - 1) / columns;
    const float u = 2 * ((float)(reed % columns) + chance(rig->seed, reed, 0)) / (float)columns - 1;
    const float v = 2 * ((float)(reed / columns) + chance(rig->seed, reed, 1)) / (float)rows - 1;
    const float x = u * sqrtf(1 - v * v / 2), z = v * sqrtf(1 - u * u / 2), r2 = fminf(x * x + z * z, 1);
    const float out = 0.65f + (0.35f - 0.15f * chance(rig->seed, reed, 5)) * r2 * r2; // a ragged edge
    const float tall = (0.7f + 0.6f * chance(rig->seed, reed, 2)) * (1 - 0.5f * r2 * r2 * r2);
    return (struct reed){.place = {out * x * (float)wide / 2, 0, out * z * (float)deep / 2},
                         .height = tall * (float)rig->height,
                         .turn = 1.2f * (chance(rig->seed, reed, 3) - 0.5f),
                         .shade = chance(rig->seed, reed, 4)};
}

static void describe(struct meadow *m, const struct meadow_rig *rig, const wiggly_desc *desc)
{
    const size_t samples = (size_t)desc->samples;
    m->count = rig->count;
    for (int r = 0; r < rig->count; r++) {
        double *row = m->numbers + (size_t)r * ROWS * samples;
        m->curves[r] = (wiggly_curve){.size = sizeof(wiggly_curve),
                                      .re = row,
                                      .im = row + samples,
                                      .y = row + 2 * samples,
                                      .omega = row + 3 * samples};
        m->descs[r] = *desc;
        m->descs[r].variation = rig->variation;
        m->descs[r].variation_seed = rig->seed * MEADOW_MAX_REEDS + r;
    }
}

/// What the curves depend on: the spline, with all that it follows, and the variation.
static uint64_t key_of(const struct meadow_rig *rig, const struct evaluation *evaluation)
{
    const uint64_t *solved = &evaluation->revisions[rig->spline];
    const double numbers[] = {rig->spline, rig->count, rig->seed, rig->variation, evaluation->samples};
    return hash_bytes(hash_bytes(HASH_START, solved, sizeof *solved), numbers, sizeof numbers) | 1;
}

static uint64_t ground_of(const struct meadow_rig *rig)
{
    const double numbers[] = {rig->count, rig->seed, rig->area[0], rig->area[1], rig->height};
    return hash_bytes(HASH_START, numbers, sizeof numbers);
}

static void solve(struct meadow *m, const struct document *document, const struct evaluation *evaluation,
                  const struct meadow_rig *rig)
{
    m->count = 0;
    make_room(m, rig->count, evaluation->samples, document->splines[rig->spline]->knot_count);
    const wiggly_desc desc = evaluation_describe(evaluation, document, rig->spline, m->knots);
    describe(m, rig, &desc);
    m->solved = m->count;
    if (wiggly_batch_solve(m->batch, m->descs, m->curves, NULL, m->count) >= WIGGLY_ERROR_ARGUMENT) m->count = 0;
}

void meadow_update(struct meadow *m, const struct document *document, const struct evaluation *evaluation)
{
    const int index = document_find_rig(document, RIG_MEADOW, 0);
    const bool solved = index >= 0 && evaluation->count == document->spline_count && evaluation->samples > 0;
    m->solved = 0;
    if (!solved) {
        m->count = 0;
        m->key = 0;
        return;
    }
    const struct meadow_rig *rig = &document->rigs[index]->meadow;
    const uint64_t key = key_of(rig, evaluation), ground = ground_of(rig);
    const bool same = key == m->key;
    m->key = key;
    if (!same) solve(m, document, evaluation, rig);
    const bool planted = same && ground == m->ground;
    m->ground = ground;
    for (int r = 0; r < m->count && !planted; r++) m->reeds[r] = plant(rig, r);
}

int meadow_solved(const struct meadow *m) { return m ? m->solved : 0; }

int meadow_count(const struct meadow *m) { return m ? m->count : 0; }

const struct reed *meadow_reed(const struct meadow *m, int reed) { return &m->reeds[reed]; }

wiggly_value meadow_value(const struct meadow *m, int reed, double position)
{
    return wiggly_evaluate(&m->curves[reed], position);
}
