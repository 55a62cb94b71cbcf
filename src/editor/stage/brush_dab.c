/// What a moment of the brush does to the paint p = a + jψ at each vertex that it reaches.
#include "editor/stage/brush.h"
#include "model/vector.h"
#include <math.h>

enum { SMOOTHINGS = 4 }; ///< passes of a frame

static const double PHASE_FLOW = 6.2831853071795865;     ///< radians a second at full strength
static const double AMPLITUDE_FLOW = 1.3862943611198906; ///< of a: four times as much in a second
static const float STROKE_LEAD = 1.5707963f,
                   STROKE_SWELL = 1.3862944f; ///< a stroke saturates here, however long it is held:
                                              ///< what differs by more folds through itself
static const double BLENDING_FLOW = 12;       ///< of smoothing and erasing, 1/s
static const double MOST_BLEND = 0.5;         ///< of one pass; more would overshoot
static const float MOST_LEAD = 12.5663706f, LEAST_SWELL = -4.60517f, MOST_SWELL = 1.3862944f; ///< ±720°; 0.01 … 4
static const float STILL = 1e-4f; ///< of the largest amplitude: below this a phase means nothing

/// 1 in the middle, 0 at the rim, flat at both.
static float falloff(float distance, float radius)
{
    const float t = distance / radius;
    return t < 1 ? (1 - t * t) * (1 - t * t) : 0;
}

static double blend(double flow) { return fmin(MOST_BLEND, BLENDING_FLOW * flow / SMOOTHINGS); }

static void multiply(const float a[2], const float b[2], float out[2])
{
    const float re = a[0] * b[0] - a[1] * b[1], im = a[0] * b[1] + a[1] * b[0];
    out[0] = re;
    out[1] = im;
}

/// Ñ' of a vertex as far as this frame has come.
static void motion_of(const struct brush_work *work, const struct coordinate *c, uint32_t vertex, float out[3][2])
{
    for (int k = 0; k < 3; k++)
        multiply(work->turned[vertex], (const float[2]){c->re[vertex][k], c->im[vertex][k]}, out[k]);
}

/// What a vertex lacks to be as its neighbours are: log of amplitude, and the angle φ for which e^{jφ} Ñ' comes closest to their
/// mean m, which is that of Σ conj(Ñ') m over the three directions. Angles that way need no unwrapping. false where
/// there is no motion to speak of.
static bool difference(const struct brush_work *work, const struct figure *figure, int coordinate, int vertex,
                       float out[2])
{
    const struct coordinate *c = &figure->character.coordinates[coordinate];
    const int first = figure->edges.first[vertex], end = figure->edges.first[vertex + 1];
    float own[3][2], turn[2] = {0}, size = 0, mean = 0, largest = 0;
    for (int k = 0; k < 3; k++) largest = fmaxf(largest, figure->largest[coordinate][k]);
    motion_of(work, c, (uint32_t)vertex, own);
    for (int k = 0; k < 3; k++) size += own[k][0] * own[k][0] + own[k][1] * own[k][1];
    for (int e = first; e < end; e++) {
        float other[3][2], square = 0;
        motion_of(work, c, figure->edges.other[e], other);
        for (int k = 0; k < 3; k++) {
            turn[0] += own[k][0] * other[k][0] + own[k][1] * other[k][1];
            turn[1] += own[k][0] * other[k][1] - own[k][1] * other[k][0];
            square += other[k][0] * other[k][0] + other[k][1] * other[k][1];
        }
        mean += sqrtf(square) / (float)(end - first);
    }
    size = sqrtf(size);
    if (!(size > STILL * largest) || !(mean > STILL * largest)) return false;
    out[0] = logf(mean / size);
    out[1] = atan2f(turn[1], turn[0]);
    return true;
}

/// One pass over all vertices from the state before it (Jacobi), so that their order means nothing.
static void smooth_once(struct painting *painting, const struct figure *figure, int coordinate, float radius,
                        int count, double flow)
{
    struct brush_work *work = &painting->work;
    const bool phase = painting->stroke == BRUSH_SMOOTH_PHASE;
    const float share = (float)blend(flow);
    for (int i = 0; i < count; i++) {
        const int vertex = work->vertices[i];
        const float weight = share * falloff(work->reach.distance[vertex], radius);
        float by[2] = {0, 0};
        difference(work, figure, coordinate, vertex, by);
        work->steps[i][0] = phase ? 0 : weight * by[0];
        work->steps[i][1] = phase ? weight * by[1] : 0;
    }
    for (int i = 0; i < count; i++) {
        float *value = work->values[i], *turned = work->turned[work->vertices[i]];
        const float swell = glm_clamp(value[0] + work->steps[i][0], LEAST_SWELL, MOST_SWELL) - value[0];
        const float lead = glm_clamp(value[1] + work->steps[i][1], -MOST_LEAD, MOST_LEAD) - value[1];
        const float size = expf(swell);
        multiply(turned, (const float[2]){size * cosf(lead), size * sinf(lead)}, turned);
        value[0] += swell;
        value[1] += lead;
    }
}

static void smooth(struct painting *painting, const struct figure *figure, int coordinate, float radius, int count,
                   double flow)
{
    struct brush_work *work = &painting->work;
    for (int pass = 0; pass < SMOOTHINGS; pass++) smooth_once(painting, figure, coordinate, radius, count, flow);
    for (int i = 0; i < count; i++) {
        work->turned[work->vertices[i]][0] = 1;
        work->turned[work->vertices[i]][1] = 0;
    }
}

/// How much of a step a stroke may still take where it has come to `spent`, which counts it.
static float saturate(float step, float most, float *spent)
{
    const float allowed = fminf(step, fmaxf(most - *spent, 0));
    *spent += allowed;
    return allowed;
}

/// The change of one vertex's paint where it does not depend on its neighbours'.
static void change(enum brush_mode mode, double flow, float weight, float *spent, float value[2])
{
    const bool turns = mode == BRUSH_ADVANCE || mode == BRUSH_DELAY,
               swells = mode == BRUSH_MORE || mode == BRUSH_LESS;
    const float lead = turns ? saturate(weight * (float)(PHASE_FLOW * flow), weight * STROKE_LEAD, spent) : 0;
    const float swell = swells ? saturate(weight * (float)(AMPLITUDE_FLOW * flow), weight * STROKE_SWELL, spent) : 0;
    const float kept = 1 - weight * (float)fmin(1, BLENDING_FLOW * flow);
    if (mode == BRUSH_ADVANCE) value[1] = glm_clamp(value[1] + lead, -MOST_LEAD, MOST_LEAD);
    if (mode == BRUSH_DELAY) value[1] = glm_clamp(value[1] - lead, -MOST_LEAD, MOST_LEAD);
    if (mode == BRUSH_MORE) value[0] = glm_clamp(value[0] + swell, LEAST_SWELL, MOST_SWELL);
    if (mode == BRUSH_LESS) value[0] = glm_clamp(value[0] - swell, LEAST_SWELL, MOST_SWELL);
    if (mode != BRUSH_ERASE) return;
    for (int k = 0; k < 2; k++) value[k] = fabsf(value[k]) < 1e-3f ? 0 : kept * value[k];
}

struct dab brush_dab(struct painting *painting, const struct paint *paint, const struct figure *figure,
                     int coordinate, float radius, double flow)
{
    struct brush_work *work = &painting->work;
    const bool smooths = painting->stroke == BRUSH_SMOOTH_PHASE || painting->stroke == BRUSH_SMOOTH_AMPLITUDE;
    int count = 0;
    for (int i = 0; i < work->reach.count; i++) {
        const int vertex = work->reach.vertices[i];
        const float weight = falloff(work->reach.distance[vertex], radius);
        const float *old = paint->values[(size_t)coordinate * (size_t)paint->vertices + (size_t)vertex];
        if (!(weight > 0)) continue;
        work->vertices[count] = vertex;
        for (int k = 0; k < 2; k++) work->values[count][k] = old[k];
        change(painting->stroke, flow, weight, &work->spent[vertex], work->values[count]);
        count++;
    }
    if (smooths) smooth(painting, figure, coordinate, radius, count, flow);
    return (struct dab){coordinate, count, work->vertices, (const float(*)[2])work->values};
}
