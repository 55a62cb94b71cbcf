/// Judges whether a clip loops, by its pose without the travel of the root.
///
/// A channel is closed if its last value is close to its first, in parts of its range. A translation that is open but steady, of a node that
/// no open node carries, is travel. If all others are closed, the clip loops. Over all channels together it also loops
/// - if it is cut less than half a step beside its start and goes on at the same speed there, as cycles from captured motion do;
/// - if it leaves the copy of the first key out: then the step from its last key to its first is like the steps before and after it.
#include "model/gltf_read.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float SMALL_RANGE = 0.2f; ///< of a channel's largest value: a smaller range counts as that
static const float MOVES = 0.1f;       ///< of SMALL_RANGE: a channel that moves less stands still
static const float CLOSE = 0.02f;      ///< of a channel's range
static const float STEADY = 0.4f;      ///< of the mean speed: the least at both ends of a clip that travels
enum { PARTS = 8 };                    ///< of a clip, in which speeds are measured

// Of the step from the last key to the first, all squared:
static const double LIKE = 0.25; ///< of the steps around it: how far it may be from them,
static const double BENT = 2.25; ///< or of how far steps within the clip are from those around them
static const double CUT = 0.25;  ///< of the steps around it: a shorter one is a cut that nobody sees
static const double LEAST = 0.1; ///< of the mean step: a shorter one ends near the start, but not before it
static const double MOST = 6.25; ///< of the largest step of each channel
enum { LEAST_STEPS = 4, FEW_STEPS = 12, MOST_STEPS = 64 }; // MOST_STEPS are looked at

struct ends {
    const float *first, *last; ///< values
    float sign;                ///< of the last: a rotation may have the other sign
    float range, unit;         ///< of the values; and what differences are measured in
    bool open;
};

static double square(double x) { return x * x; }

static int stride_of(const struct gltf_channel *channel)
{
    return channel->components * (channel->interpolation == GLTF_CUBIC ? 3 : 1);
}

static float dot(const float *a, const float *b, int count)
{
    float sum = 0;
    for (int k = 0; k < count; k++) sum += a[k] * b[k];
    return sum;
}

static struct ends ends_of(const struct gltf_channel *channel)
{
    const int n = channel->components, stride = stride_of(channel);
    const bool turns = channel->path == GLTF_ROTATION;
    struct ends ends = {.first = channel->values + (stride > n ? n : 0), .sign = 1};
    ends.last = ends.first + (size_t)(channel->key_count - 1) * (size_t)stride;
    if (turns && dot(ends.first, ends.last, n) < 0) ends.sign = -1;
    float largest = 1e-6f, apart = 0;
    for (int i = 0; i < n; i++) {
        float lo = ends.first[i], hi = lo;
        for (const float *key = ends.first; key <= ends.last; key += stride) {
            const float value = turns && dot(ends.first, key, n) < 0 ? -key[i] : key[i];
            lo = fminf(lo, value);
            hi = fmaxf(hi, value);
        }
        largest = fmaxf(largest, fmaxf(-lo, hi));
        ends.range = fmaxf(ends.range, hi - lo);
        apart = fmaxf(apart, fabsf(ends.sign * ends.last[i] - ends.first[i]));
    }
    ends.unit = fmaxf(ends.range, SMALL_RANGE * largest);
    ends.open = apart > CLOSE * ends.unit;
    if (ends.range < MOVES * SMALL_RANGE * largest) ends.range = 0;
    return ends;
}

/// Whether an open translation goes on at about the same speed from the beginning to the end.
static bool is_steady(const struct gltf_channel *channel, const struct ends *ends, double first, double length)
{
    float way[3], at[3];
    if (channel->path != GLTF_TRANSLATION || channel->interpolation == GLTF_STEP) return false;
    for (int k = 0; k < 3; k++) way[k] = ends->last[k] - ends->first[k];
    float before = 0, size = dot(way, way, 3);
    for (int part = 1; part <= PARTS; part++) {
        gltf_channel_at(channel, first + length * part / PARTS, at);
        for (int k = 0; k < 3; k++) at[k] -= ends->first[k];
        const float now = dot(at, way, 3) / size, speed = PARTS * (now - before);
        if ((part == 1 || part == PARTS) && !(speed > STEADY && speed < 1 / STEADY)) return false;
        before = now;
    }
    return true;
}

/// Whether no node above one is open.
static bool is_root(const struct gltf *gltf, const bool *is_open, int node)
{
    for (int n = gltf->nodes[node].parent; n >= 0; n = gltf->nodes[n].parent) {
        if (is_open[n]) return false;
    }
    return true;
}

/// Squares of differences, in parts of channels' units, summed over all channels that do not travel.
struct steps {
    double step, around[2]; ///< the step from one key to the next, and those before and after it
    double bend;            ///< how far it is from the mean of those
    double change;          ///< and how far those are from each other
};

/// Adds the step between the middle two of four times. `values` holds four values of the channel.
static void add_steps(const struct gltf_channel *channel, const struct ends *ends, const double times[4],
                      float *values, struct steps *sum)
{
    const int n = channel->components;
    for (int i = 0; i < 4; i++) {
        float *value = values + (size_t)i * (size_t)n;
        gltf_channel_at(channel, times[i], value);
        const bool turned = channel->path == GLTF_ROTATION && dot(ends->first, value, n) < 0;
        for (int k = 0; k < n; k++) value[k] = (turned ? -value[k] : value[k]) / ends->unit;
    }
    for (int k = 0; k < n; k++) {
        const float *v = values + k;
        const double before = (double)(v[n] - v[0]), step = (double)(v[2 * n] - v[n]),
                     after = (double)(v[3 * n] - v[2 * n]);
        sum->step += step * step;
        sum->around[0] += before * before;
        sum->around[1] += after * after;
        sum->bend += square(step - (before + after) / 2);
        sum->change += square(after - before);
    }
}

/// Whether the way from the last key to the first is a step like others, or so short a way that nobody sees it: then there is no gap.
static bool goes_on(struct gltf_clip *clip, const struct ends *ends, float *values)
{
    const double first = clip->first, last = clip->last, gap = clip->gap;
    const int steps = (int)((last - first) / gap + 0.5), apart = 1 + steps / MOST_STEPS;
    struct steps seam = {0}, within = {0};
    int count = 0;
    for (int c = 0; c < clip->channel_count; c++) {
        const struct gltf_channel *channel = &clip->channels[c];
        const double before = seam.step;
        double largest = square((double)CLOSE);
        if (channel->travels) continue;
        add_steps(channel, &ends[c], (const double[]){last - gap, last, first, first + gap}, values, &seam);
        count = 0;
        for (int k = 1; k + 1 < steps; k += apart, count++) {
            const double at = first + k * gap, so_far = within.step;
            add_steps(channel, &ends[c], (const double[]){at - gap, at, at + gap, at + 2 * gap}, values, &within);
            largest = fmax(largest, within.step - so_far);
        }
        if (seam.step - before > MOST * largest) return false;
    }
    const double around = fmax(seam.around[0], seam.around[1]), mean = count > 0 ? within.step / count : INFINITY;
    if (steps >= FEW_STEPS && seam.step < CUT * around && seam.change < LIKE * around) {
        clip->gap = 0;
        return true;
    }
    if (seam.step < (steps < FEW_STEPS ? CUT : LEAST) * mean) return false;
    return CUT * seam.step < around && (seam.bend < LIKE * around || seam.bend < BENT * within.bend / count);
}

bool gltf_judge_loop(const struct gltf *gltf, struct gltf_clip *clip)
{
    const double length = clip->last - clip->first;
    int most_keys = 0, most_components = 4;
    bool closed = true, moves = false, travels = false, done = false;
    struct ends *ends = calloc((size_t)clip->channel_count + 1, sizeof *ends);
    bool *is_open = calloc((size_t)gltf->node_count + 1, sizeof *is_open);
    float *values = NULL;
    if (!ends || !is_open) goto end;
    for (int c = 0; c < clip->channel_count; c++) {
        const struct gltf_channel *channel = &clip->channels[c];
        ends[c] = ends_of(channel);
        is_open[channel->node] |= ends[c].open;
        if (channel->key_count > most_keys) most_keys = channel->key_count;
        if (channel->components > most_components) most_components = channel->components;
    }
    for (int c = 0; c < clip->channel_count; c++) {
        struct gltf_channel *channel = &clip->channels[c];
        channel->travels = ends[c].open && is_steady(channel, &ends[c], clip->first, length) &&
                           is_root(gltf, is_open, channel->node);
        travels = travels || channel->travels;
        closed = closed && (!ends[c].open || channel->travels);
        moves = moves || (ends[c].range > 0 && !channel->travels);
    }
    clip->loops = closed && (moves || !travels);
    clip->gap = clip->loops || most_keys < 2 ? 0 : length / (most_keys - 1);
    values = malloc(4 * (size_t)most_components * sizeof *values);
    if (!values) goto end;
    if (!clip->loops && moves && clip->gap > 0 && most_keys > LEAST_STEPS) clip->loops = goes_on(clip, ends, values);
    done = true;
end:
    free(values);
    free(is_open);
    free(ends);
    return done;
}
