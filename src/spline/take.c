/// Edits one knot of a long spline in O(log knots).
//
// A long spline under the hands of an animator: its chain of nodes with a tree over them (tree.c). Moving a knot changes two
// stretches and three rows; the tree condenses the elements above these anew, and is descended where one looks.
#include "spline/take.h"
#include "spline/limits.h"
#include "spline/problem.h"
#include "spline/tree.h"
#include "spline/variation.h"
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { AROUND = 2 }; ///< nodes on each side that a changed node's neighbours' rows are made of

struct wiggly_take {
    bool owned;
    int capacity;          ///< knots
    wiggly_solver *solver; ///< whose chain this is
    tree tree;
    wiggly_desc desc;
    wiggly_knot *knots;  ///< the description's
    int *node_of;        ///< node of each knot
    double *y, *re, *im; ///< equilibrium; scratch for a stretch
    problem problem;     ///< as it was posed, with its knots as they are now
};

/// A slope row as heavy as this costs the tree the digits of what stands beside it.
static const double heaviest = 1e5;

/// Whether the tree can promise what wiggly_solve() says of it: nothing may be singular, or ask to be refined.
static bool is_for_tree(const wiggly_take *take, const problem *p)
{
    for (int k = 0; k < take->desc.knot_count; k++) {
        const wiggly_knot *knot = &take->knots[k];
        if (!knot->has_slope || knot->stiffness * take->desc.step <= heaviest) continue;
        if (problem_slope(p, knot->sample, knot->slope, knot->stiffness).weight > heaviest) return false;
    }
    return p->start != WIGGLY_LOOP && !limits_are_set(p->desc) && !variation_is_set(p->desc) &&
           !problem_is_loose(p) && problem_fits_chain(take->solver, p) && !problem_pulls_imaginary(take->solver, p);
}

static wiggly_status build(wiggly_take *take)
{
    chain *c = &take->solver->chain;
    problem *p = &take->problem;
    wiggly_status status = problem_pose(take->solver, &take->desc, take->y, p);
    if (status != WIGGLY_OK) return status;
    if (!is_for_tree(take, p)) return WIGGLY_ERROR_ARGUMENT;
    problem_make_chain(take->solver, p);
    if (c->node_count < 2) return WIGGLY_ERROR_ARGUMENT;
    for (int k = 0, j = p->start == WIGGLY_REST; k < take->desc.knot_count; k++) {
        take->node_of[k] = j;
        bool shares = k + 1 < take->desc.knot_count && take->knots[k + 1].sample == take->knots[k].sample + 1 &&
                      c->nodes[j].sample == take->knots[k].sample - p->first;
        if (!shares) j++;
    }
    chain_make_tables(c);
    chain_assemble(c);
    chain_reset_nodes(c);
    chain_pull_known(c);
    int run_rows[TREE_MAX_LEVELS];
    take->tree.levels = tree_shape(c->node_count, take->tree.count, run_rows);
    return tree_update(&take->tree, 0, c->node_count - 1) ? WIGGLY_OK : WIGGLY_SINGULAR;
}

/// Where in a take's memory its parts are, in bytes.
typedef struct layout {
    size_t knots, y, x, solver, elements[TREE_MAX_LEVELS], rows[TREE_MAX_LEVELS], node_of, size;
    int levels;
} layout;

/// Adds `count` things of `size` bytes to the memory; false where that does not fit.
static bool reserve(layout *l, size_t *at, size_t count, size_t size)
{
    size_t bytes;
    *at = l->size;
    return !__builtin_mul_overflow(count, size, &bytes) &&
           !__builtin_add_overflow(bytes, -bytes % sizeof(double), &bytes) &&
           !__builtin_add_overflow(l->size, bytes, &l->size);
}

static bool plan(layout *l, int samples, int knots)
{
    int count[TREE_MAX_LEVELS], run_rows[TREE_MAX_LEVELS];
    size_t n = (size_t)samples, k = (size_t)knots + 1, solver = wiggly_memsize(samples, knots);
    *l = (layout){.size = sizeof(wiggly_take)};
    bool fits = solver > 0 && reserve(l, &l->knots, k, sizeof(wiggly_knot)) && reserve(l, &l->y, n, sizeof(double)) &&
                reserve(l, &l->x, 2 * n, sizeof(double)) && reserve(l, &l->solver, 1, solver) &&
                reserve(l, &l->node_of, k, sizeof(int));
    if (fits) l->levels = tree_shape(knots + 1, count, run_rows);
    for (int level = 0; level < l->levels && fits; level++) {
        fits = reserve(l, &l->elements[level], (size_t)count[level], sizeof(tree_element)) &&
               reserve(l, &l->rows[level], (size_t)run_rows[level], sizeof(tree_row));
    }
    return fits;
}

size_t wiggly_take_memsize(int samples, int knots)
{
    layout l;
    return samples >= 1 && knots >= 1 && knots < INT_MAX && plan(&l, samples, knots) ? l.size : 0;
}

/// Lays a take into zeroes.
static wiggly_take *lay_out(void *memory, int samples, int knots)
{
    layout l;
    if (!plan(&l, samples, knots)) return NULL;
    wiggly_take *take = memory;
    unsigned char *at = memory;
    take->capacity = knots;
    take->knots = (wiggly_knot *)(void *)(at + l.knots);
    take->node_of = (int *)(void *)(at + l.node_of);
    take->y = (double *)(void *)(at + l.y);
    take->re = (double *)(void *)(at + l.x);
    take->im = take->re + samples;
    take->solver = solver_lay_out(at + l.solver, samples, knots);
    take->tree.chain = &take->solver->chain;
    for (int level = 0; level < l.levels; level++) {
        take->tree.elements[level] = (tree_element *)(void *)(at + l.elements[level]);
        take->tree.rows[level] = (tree_row *)(void *)(at + l.rows[level]);
    }
    return take;
}

/// Whether the description is one at all, as far as the memory depends on it.
static wiggly_status check_desc(const wiggly_desc *desc)
{
    if (!desc || desc->samples < 1 || desc->knot_count < 1 || !desc->knots) return WIGGLY_ERROR_ARGUMENT;
    for (int k = 1; k < desc->knot_count; k++) {
        if (desc->knots[k].sample <= desc->knots[k - 1].sample) return WIGGLY_ERROR_KNOT;
    }
    return WIGGLY_OK;
}

static wiggly_status condense(wiggly_take *take, const wiggly_desc *desc)
{
    memcpy(take->knots, desc->knots, sizeof *take->knots * (size_t)desc->knot_count);
    take->desc = *desc;
    take->desc.knots = take->knots;
    return build(take);
}

wiggly_status wiggly_take_create(const wiggly_desc *desc, wiggly_take **out)
{
    wiggly_status status = check_desc(desc);
    if (!out) return WIGGLY_ERROR_ARGUMENT;
    if (status != WIGGLY_OK) return status;
    size_t size = wiggly_take_memsize(desc->samples, desc->knot_count);
    void *memory = size ? calloc(1, size) : NULL;
    if (!memory) return WIGGLY_ERROR_MEMORY;
    wiggly_take *take = lay_out(memory, desc->samples, desc->knot_count);
    status = condense(take, desc);
    if (status == WIGGLY_OK) {
        take->owned = true;
        *out = take;
    } else {
        free(memory);
    }
    return status;
}

/// The most knots, but no more than samples, that a take of so many bytes has room for; 0 where not even `least`.
static int capacity_of(size_t size, int samples, int least)
{
    int low = least, high = samples > least ? samples : least;
    size_t needed = wiggly_take_memsize(samples, least);
    if (!needed || size < needed) return 0;
    while (low < high) {
        int middle = low + (high - low + 1) / 2;
        needed = wiggly_take_memsize(samples, middle);
        if (needed && needed <= size) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    return low;
}

wiggly_status wiggly_take_create_at(void *memory, size_t size, const wiggly_desc *desc, wiggly_take **out)
{
    wiggly_status status = check_desc(desc);
    if (!memory || !out || (uintptr_t)memory % sizeof(double) != 0) return WIGGLY_ERROR_ARGUMENT;
    if (status != WIGGLY_OK) return status;
    int capacity = capacity_of(size, desc->samples, desc->knot_count);
    if (!capacity) return WIGGLY_ERROR_MEMORY;
    memset(memory, 0, wiggly_take_memsize(desc->samples, capacity));
    wiggly_take *take = lay_out(memory, desc->samples, capacity);
    status = condense(take, desc);
    if (status == WIGGLY_OK) *out = take;
    return status;
}

void wiggly_take_destroy(wiggly_take *take)
{
    if (take && take->owned) free(take);
}

/// Whether a knot has another beside it: then nodes are shared, and which ones may change down the line.
static bool has_company(const wiggly_take *take, int index)
{
    const wiggly_knot *k = &take->knots[index];
    return (index > 0 && k[-1].sample == k->sample - 1) ||
           (index + 1 < take->desc.knot_count && k[1].sample == k->sample + 1);
}

/// Makes the stretches and rows around node j anew. false where the tables were full and forgot other stretches.
static bool renew_rows(wiggly_take *take, int j)
{
    chain *c = &take->solver->chain;
    chain_row rows[2 * AROUND + 1];
    int from = j - AROUND > 0 ? j - AROUND : 0, to = j + AROUND < c->node_count - 1 ? j + AROUND : c->node_count - 1;
    chain part = *c;
    part.nodes += from;
    part.rows = rows;
    part.node_count = to - from + 1;
    if (from > 0) part.start = (start_cost){0};
    if (to + 1 < c->node_count) part.settles = false; // the end's form is not part of it
    chain_make_tables(&part);
    bool forgot = part.stretch_count < c->stretch_count;
    c->stretch_count = part.stretch_count;
    c->powers_count = part.powers_count;
    if (forgot) return false;
    chain_assemble(&part);
    chain_reset_nodes(&part);
    chain_pull_known(&part);
    int first = j > 0 ? j - 1 : 0, last = j + 1 < c->node_count ? j + 1 : j;
    memcpy(&c->rows[first], &rows[first - from], sizeof *rows * (size_t)(last - first + 1));
    return true;
}

static bool is_good(const wiggly_knot *knot)
{
    bool good = isfinite(knot->value) && fabs(knot->value) <= LARGEST_VALUE;
    return good && (!knot->has_slope || (isfinite(knot->slope) && knot->stiffness > 0 && isfinite(knot->stiffness)));
}

/// Where a knot may go and what it may say.
static wiggly_status check_knot(const wiggly_take *take, int index, const wiggly_knot *knot)
{
    if (!take || index < 0 || index >= take->desc.knot_count) return WIGGLY_ERROR_ARGUMENT;
    const wiggly_knot *knots = take->knots;
    int low = index > 0 ? knots[index - 1].sample + 1 : 0;
    int high = index + 1 < take->desc.knot_count ? knots[index + 1].sample - 1 : take->desc.samples - 1;
    if (knot->sample < low || knot->sample > high) return WIGGLY_ERROR_KNOT;
    return is_good(knot) ? WIGGLY_OK : WIGGLY_ERROR_NUMBER;
}

/// Whether a slope is so heavy that the take may have to be refused.
static bool is_heavy(const wiggly_take *take, const wiggly_knot *knot)
{
    return knot->has_slope && knot->stiffness * take->desc.step > heaviest;
}

/// Replaces a checked knot; false where more than the rows around it has to be made anew.
static bool patch(wiggly_take *take, int index, wiggly_knot knot, wiggly_status *status)
{
    wiggly_knot before = take->knots[index];
    bool shared = has_company(take, index);
    take->knots[index] = knot;
    shared = shared || has_company(take, index);
    bool is_last = index == take->desc.knot_count - 1, moves_start = index == 0 && knot.sample != before.sample;
    bool changes_end = is_last && knot.has_slope != before.has_slope;
    bool on_last = knot.has_slope && knot.sample == take->desc.samples - 1;
    int j = take->node_of[index], last = take->solver->chain.node_count - 1;
    if (shared || moves_start || changes_end || is_heavy(take, &knot) ||
        (on_last && !problem_oscillates(&take->problem)))
        return false;
    if (is_last) {
        take->problem.latest = knot.sample;
        take->solver->chain.count = problem_rows(&take->problem);
    }
    problem_put_knot(&take->problem, &take->solver->chain.nodes[j], &knot, NULL);
    if (!renew_rows(take, j)) return false;
    bool good = tree_update(&take->tree, j > 0 ? j - 1 : 0, j < last ? j + 1 : last);
    *status = good ? WIGGLY_OK : WIGGLY_SINGULAR;
    return true;
}

wiggly_status wiggly_take_set_knot(wiggly_take *take, int index, wiggly_knot knot)
{
    wiggly_status status = check_knot(take, index, &knot);
    if (status != WIGGLY_OK) return status;
    wiggly_knot before = take->knots[index];
    if (patch(take, index, knot, &status)) return status;
    status = build(take);
    if (status == WIGGLY_OK) return status;
    take->knots[index] = before; // what cannot be a take is refused, and the take is as it was
    build(take);
    return status;
}

/// Moves the end of the spline to its last knot and makes the rows there; false where more than these has to be made anew.
static bool extend(wiggly_take *take, wiggly_status *status)
{
    chain *c = &take->solver->chain;
    const int index = take->desc.knot_count - 1, j = take->node_of[index - 1] + 1;
    const wiggly_knot *knot = &take->knots[index], *before = knot - 1;
    bool on_last = knot->has_slope && knot->sample == take->desc.samples - 1;
    if (has_company(take, index) || has_company(take, index - 1) || knot->has_slope != before->has_slope)
        return false;
    if (is_heavy(take, knot) || (on_last && !problem_oscillates(&take->problem))) return false;
    take->problem.latest = knot->sample;
    c->count = problem_rows(&take->problem);
    problem_put_knot(&take->problem, &c->nodes[j - 1], before, NULL);
    problem_put_knot(&take->problem, &c->nodes[j], knot, NULL);
    take->node_of[index] = j;
    c->node_count = j + 1;
    if (!renew_rows(take, j - 1)) return false;
    *status = tree_grow(&take->tree) ? WIGGLY_OK : WIGGLY_SINGULAR;
    return true;
}

wiggly_status wiggly_take_append(wiggly_take *take, wiggly_knot knot)
{
    if (!take) return WIGGLY_ERROR_ARGUMENT;
    if (take->desc.knot_count == take->capacity) return WIGGLY_ERROR_CAPACITY;
    if (knot.sample <= take->knots[take->desc.knot_count - 1].sample || knot.sample >= take->desc.samples)
        return WIGGLY_ERROR_KNOT;
    if (!is_good(&knot)) return WIGGLY_ERROR_NUMBER;
    wiggly_status status = WIGGLY_OK;
    take->knots[take->desc.knot_count++] = knot;
    if (extend(take, &status)) return status;
    status = build(take);
    if (status == WIGGLY_OK) return status;
    take->desc.knot_count--; // what cannot be a take is refused, and the take is as it was
    build(take);
    return status;
}

bool take_patch_knot(wiggly_take *take, int index, wiggly_knot knot)
{
    wiggly_status status;
    return check_knot(take, index, &knot) == WIGGLY_OK && patch(take, index, knot, &status) && status == WIGGLY_OK;
}

const wiggly_desc *take_desc(const wiggly_take *take) { return &take->desc; }

/// Where samples of a window go.
typedef struct sink {
    int from, count;
    double *total, *im; ///< or NULL
    int columns;
    double *low, *high;
} sink;

/// Takes samples at … at + count − 1 (numbers of the whole spline), of which some may lie outside the window.
static void pour(const wiggly_take *take, const sink *s, int at, int count, const double *re, const double *im)
{
    int begin = at > s->from ? at : s->from, end = at + count < s->from + s->count ? at + count : s->from + s->count;
    const double *u_im = take->problem.swing.im;
    for (int i = begin; i < end; i++) {
        double total = problem_about(&take->problem, i) + re[i - at];
        if (s->total) s->total[i - s->from] = total;
        if (s->im) s->im[i - s->from] = (im ? im[i - at] : 0) + (u_im ? u_im[i] : 0);
        if (!s->columns) continue;
        int column = (int)((long long)(i - s->from) * s->columns / s->count);
        s->low[column] = fmin(s->low[column], total);
        s->high[column] = fmax(s->high[column], total);
    }
}

/// The node at or before a sample of the system; the first where there is none.
static int node_before(const chain *c, int sample)
{
    int low = 0, high = c->node_count - 1;
    while (low < high) {
        int middle = (low + high + 1) / 2;
        if (c->nodes[middle].sample <= sample) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    return low;
}

/// Samples of the system from the last node to `to`: free, or as the tail has them.
static void look_behind(wiggly_take *take, const sink *s, int to)
{
    const chain *c = &take->solver->chain;
    const chain_node *end = &c->nodes[c->node_count - 1];
    double *re = take->re, *im = c->is_complex ? take->im : NULL;
    int first = take->problem.first, count = to - end->sample + 1, own = c->count - end->sample;
    chain_run_free(c, end, count < own ? count : own, re, im);
    pour(take, s, first + end->sample, count < own ? count : own, re, im);
    if (count <= own) return;
    const problem *p = &take->problem;
    const cplx w = {re[own - 1], im ? im[own - 1] : 0};
    int begin = s->from > p->latest ? s->from : p->latest + 1, rest = s->from + s->count - begin;
    problem_fill_tail(take->solver, p, w, begin - p->latest, rest, re, im);
    pour(take, s, begin, rest, re, im);
}

static wiggly_status look(wiggly_take *take, const sink *s)
{
    chain *c = &take->solver->chain;
    int from = s->from - take->problem.first, to = from + s->count - 1; // of the system
    int p = node_before(c, from), q = node_before(c, to), last = c->node_count - 1;
    q = q < last ? q + 1 : last;
    chain part = *c;
    part.nodes += p;
    part.node_count = q - p + 1;
    chain_reset_nodes(&part);
    if (!tree_solve(&take->tree, p, q)) return WIGGLY_SINGULAR;
    double *im = c->is_complex ? take->im : NULL;
    for (int i = s->from; i < take->problem.first && i < s->from + s->count; i++)
        pour(take, s, i, 1, &c->nodes[0].value, &c->nodes[0].x_im);
    for (int j = p; j < q; j++) {
        const chain_node *node = &c->nodes[j];
        chain_fill_stretch(c, node, node + 1, take->re - node->sample, im ? im - node->sample : NULL);
        pour(take, s, take->problem.first + node->sample, node[1].sample - node->sample, take->re, im);
    }
    if (q == last && to >= c->nodes[last].sample) look_behind(take, s, to);
    return take->tree.elements[take->tree.levels - 1][0].weak ? WIGGLY_INEXACT : WIGGLY_OK;
}

static bool is_inside(const wiggly_take *take, int from, int count)
{
    return take && from >= 0 && count >= 1 && from <= take->desc.samples - count;
}

/// Keys are hit to the bit: y + (value − y) may not be.
static void set_keys(const wiggly_take *take, int from, int count, double *total)
{
    int low = 0, high = take->desc.knot_count;
    while (low < high) {
        int middle = (low + high) / 2;
        if (take->knots[middle].sample < from) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    for (; low < take->desc.knot_count && take->knots[low].sample < from + count; low++) {
        total[take->knots[low].sample - from] = take->knots[low].value;
    }
}

wiggly_status wiggly_take_read(wiggly_take *take, int from, int count, double *total, double *im)
{
    if (!is_inside(take, from, count)) return WIGGLY_ERROR_ARGUMENT;
    wiggly_status status = look(take, &(sink){.from = from, .count = count, .total = total, .im = im});
    if (total) set_keys(take, from, count, total);
    return status;
}

wiggly_status wiggly_take_range(wiggly_take *take, int from, int count, int columns, double *low, double *high)
{
    if (!is_inside(take, from, count) || columns < 1 || columns > count || !low || !high)
        return WIGGLY_ERROR_ARGUMENT;
    for (int i = 0; i < columns; i++) low[i] = INFINITY, high[i] = -INFINITY;
    return look(take, &(sink){.from = from, .count = count, .columns = columns, .low = low, .high = high});
}
