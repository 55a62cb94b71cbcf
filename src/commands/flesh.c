/// `wiggly flesh`: makes the mesh of a skinned character soft on its own bones.
///
/// The mesh at rest is shaken along x, y and z, near its bones held. Every pole p that a shake shows is an oscillator which the base's
/// acceleration a drives, u'' + 2ζω u' + ω² u = −a (u complex, as a spline's: Im u = −(u' + ζω u)/ω_d), and the shapes N of
///
///     s(t) ≈ Σ_p Re(u_p(t) N_p,i)        s: the motion of all vertices in the shake along axis i
///
/// are linear least squares. The three shapes of a pole are then split by the eigenvectors e of Re(N_i·N_j*), which are orthogonal
/// directions of the base: N_p,i = Σ_e e_i Ñ_e. So each Ñ_e is a coordinate that a base's acceleration drives by three real numbers
/// g = e, x'' + 2ζω x' + ω² x = −g·a, also if a body swings as fast to all sides.
#include "analysis/analysis.h"
#include "base/error.h"
#include "base/file.h"
#include "base/names.h"
#include "base/need.h"
#include "commands/report.h"
#include "commands/shaking.h"
#include "maths/maths.h"
#include "maths/symmetric.h"
#include "model/character.h"
#include "model/gltf.h"
#include "model/motion.h"
#include "model/vector.h"
#include "rig/import.h"
#include "scene/load.h"
#include "scene/rig.h"
#include <stdio.h>
#include <stdlib.h>

enum { SWINGS = 3 * ANALYSIS_MODES_MAX, FRAMES_A_PERIOD = 10, FINEST = 20 };

static const double usual_depth = 0.5;  ///< of the median distance of the flesh from the bones
static const double same_pole = 0.1;    ///< relative difference of frequencies that count as one
static const double wide = 1.5;         ///< the same, of the damping ratio
static const double least_share = 0.01; ///< of the motion, of a coordinate that is kept
static const double whole = 0.69314718; ///< log of the painted amplitude where flesh is wholly of the part

struct job {
    const char *input, *output, *scene;
    struct option_list part;
    double depth; ///< m; below 0: by default
    int modes;
    struct shaking by;
};

/// The mesh that becomes flesh, in the model's space at rest. Rows are the vertices of its parts, one part after the other.
struct flesh {
    struct pool pool;
    struct gltf gltf;
    struct gltf_pose rest;
    int node, skin, mesh; ///< what shows it
    bool *chosen;         ///< per node: it is in the part
    struct paint *paint;  ///< that is the part; NULL: none
    int bone;             ///< node that carries the part; −1: each coordinate has its own
    struct surface surface;
    const struct gltf_part **part_of; ///< per row
    int *row_of;                      ///< per row: the vertex of that part
    double *share;                    ///< per row: how much of it follows the part, 0 … 1
    double *held;                     ///< the rest
    struct region region;
    double thickness; ///< of the flesh on the bones, at most, m
    double *moves;    ///< per row: the share that counts, 0 where it is held
};

/// A joint that a row follows: k = 0 … 7; the node itself where it has no skin. Returns the weight.
static double follows(const struct flesh *f, int row, int k, int *node)
{
    const struct gltf_part *part = f->part_of[row];
    const int vertex = f->row_of[row];
    *node = part->joints ? f->gltf.skins[f->skin].joints[part->joints[vertex][k]] : f->node;
    return part->joints ? (double)part->weights[vertex][k] : k == 0;
}

/// Marks the bones of --part and those below, finds the bone that carries them, and reads paint.
static bool choose_part(struct flesh *f, const struct job *job, struct error *error)
{
    const struct gltf *gltf = &f->gltf;
    f->chosen = pool_take(&f->pool, (size_t)gltf->node_count, sizeof *f->chosen);
    f->bone = -1;
    if (job->part.count == 1 && path_has_end(job->part.text[0], ".npy"))
        return (f->paint = paint_read(job->part.text[0], error)) != NULL;
    for (int i = 0; i < job->part.count; i++) {
        const int node = gltf_find_node(gltf, job->part.text[i]);
        if (node < 0) {
            const char **names = pool_take(&f->pool, (size_t)gltf->node_count, sizeof *names);
            for (int n = 0; n < gltf->node_count; n++) names[n] = gltf->nodes[n].name;
            const char *near = options_nearest(job->part.text[i], names, gltf->node_count);
            return fail(error, ERROR_INPUT, "%s: expected a bone for --part, got \"%s\"%s%s%s", gltf->path,
                        job->part.text[i], near ? " (did you mean \"" : "", near ? near : "", near ? "\"?)" : "");
        }
        f->chosen[node] = true;
        if (i == 0) f->bone = node;
        for (int up = f->bone; up >= 0; up = gltf->nodes[up].parent) { // the lowest bone above both
            int below = node;
            while (below >= 0 && below != up) below = gltf->nodes[below].parent;
            f->bone = below >= 0 ? up : gltf->nodes[up].parent;
            if (below >= 0) break;
        }
    }
    for (int i = 0; i < gltf->node_count; i++) {
        const int n = gltf->order[i], parent = gltf->nodes[n].parent;
        f->chosen[n] |= job->part.count == 0 || (parent >= 0 && f->chosen[parent]);
    }
    return true;
}

/// Finds the vertices of the node's mesh and how much of each is of the part. Returns how many are; −1: the paint is of another mesh.
static int find_share(struct flesh *f, int node)
{
    const struct gltf_mesh *mesh = &f->gltf.meshes[f->gltf.nodes[node].mesh];
    const size_t count = (size_t)gltf_vertex_count(&f->gltf, node);
    int found = 0;
    f->node = node;
    f->skin = f->gltf.nodes[node].skin;
    f->mesh = f->gltf.nodes[node].mesh;
    f->surface.vertex_count = (int)count;
    f->part_of = pool_take(&f->pool, count + 1, sizeof *f->part_of);
    f->row_of = pool_take(&f->pool, count + 1, sizeof *f->row_of);
    f->share = pool_take(&f->pool, count + 1, sizeof *f->share);
    int unshared = 0; // paint has the vertices of a part that shares them once
    for (int p = 0; p < mesh->part_count; p++) unshared += gltf_own_vertices(&mesh->parts[p]);
    if (f->paint && f->paint->vertices != unshared) return -1;
    for (int p = 0, row = 0, next = 0; p < mesh->part_count; p++) {
        const struct gltf_part *part = &mesh->parts[p];
        const int first = part->shared ? 0 : next;
        next += gltf_own_vertices(part);
        for (int i = 0; i < part->vertex_count; i++, row++) {
            f->part_of[row] = part;
            f->row_of[row] = i;
            f->share[row] = 0; // as far as a coordinate has its amplitude raised
            for (int c = 0; f->paint && c < f->paint->coordinates; c++) {
                const size_t at = (size_t)c * (size_t)f->paint->vertices + (size_t)(first + i);
                f->share[row] = fmax(f->share[row], (double)f->paint->values[at][0] / whole);
            }
            for (int k = 0; k < GLTF_INFLUENCES; k++) {
                int joint;
                const double weight = follows(f, row, k, &joint);
                f->share[row] += f->chosen[joint] ? weight : 0;
            }
            f->share[row] = fmin(f->share[row], 1);
            found += f->share[row] > 0;
        }
    }
    return found;
}

/// Chooses the skinned mesh of which most is of the part, and says so if there are several.
static bool choose_mesh(struct flesh *f, const struct job *job, struct error *error)
{
    const struct gltf *gltf = &f->gltf;
    int best = -1, most = 0, skinned = 0, candidates = 0, suits = 0;
    for (int n = 0; n < gltf->node_count; n++) {
        if (gltf->nodes[n].mesh < 0 || gltf->nodes[n].skin < 0 || gltf_vertex_count(gltf, n) == 0) continue;
        const int found = find_share(f, n);
        skinned++;
        candidates += found > 0;
        suits += found >= 0;
        if (found <= most) continue;
        most = found;
        best = n;
    }
    if (skinned == 0)
        return fail(error, ERROR_INPUT, "%s: expected a mesh with a skin, got none: wiggly simulate takes it",
                    gltf->path);
    if (suits == 0)
        return fail(error, ERROR_INPUT, "%s: expected paint for a skinned mesh of %s, got paint for %d vertices",
                    job->part.text[0], gltf->path, f->paint->vertices);
    if (best < 0 && f->paint)
        return fail(error, ERROR_INPUT, "%s: expected vertices with a raised amplitude, got none", job->part.text[0]);
    if (best < 0)
        return fail(error, ERROR_INPUT, "%s: no vertex follows the bone \"%s\" or one below it", gltf->path,
                    job->part.text[0]);
    find_share(f, best);
    if (candidates > 1)
        print_line(stdout, "%s: %d skinned meshes; \"%s\", with most vertices, becomes flesh", gltf->path, candidates,
                   gltf->meshes[f->mesh].name);
    return true;
}

/// The mesh at rest as one surface, in memory that surface_free() does not know.
static void make_surface(struct flesh *f)
{
    struct surface *s = &f->surface;
    const struct gltf_mesh *mesh = &f->gltf.meshes[f->mesh];
    for (int p = 0; p < mesh->part_count; p++) s->index_count += mesh->parts[p].index_count;
    s->position = pool_take(&f->pool, (size_t)s->vertex_count + 1, sizeof *s->position);
    s->indices = pool_take(&f->pool, (size_t)s->index_count + 1, sizeof *s->indices);
    gltf_pose_vertices(&f->gltf, &f->rest, f->node, s->position, NULL);
    for (int p = 0, first = 0, index = 0; p < mesh->part_count; first += mesh->parts[p++].vertex_count)
        for (int i = 0; i < mesh->parts[p].index_count; i++)
            s->indices[index++] = (uint32_t)first + mesh->parts[p].indices[i];
}

/// The bones as lines: from each joint with vertices to the next one above it. A joint without another below it reaches through the middle
/// of what follows it and as far again, unless it is of the part: that hangs on it.
static void make_lines(struct flesh *f, bool has_part)
{
    const size_t nodes = (size_t)f->gltf.node_count;
    double(*line)[2][3] = pool_take(&f->pool, 2 * nodes, sizeof *line),
    *weight = pool_take(&f->pool, nodes, sizeof *weight);
    double(*middle)[3] = pool_take(&f->pool, nodes, sizeof *middle);
    bool *is_parent = pool_take(&f->pool, nodes, sizeof *is_parent);
    int *above = pool_take(&f->pool, nodes, sizeof *above);
    for (int n = 0; n < GLTF_INFLUENCES * f->surface.vertex_count; n++) {
        int node;
        const double w = follows(f, n / GLTF_INFLUENCES, n % GLTF_INFLUENCES, &node);
        weight[node] += w;
        for (int c = 0; c < 3; c++) middle[node][c] += w * (double)f->surface.position[n / GLTF_INFLUENCES][c];
    }
    for (size_t n = 0; n < nodes; n++) {
        above[n] = f->gltf.nodes[n].parent;
        while (above[n] >= 0 && weight[above[n]] == 0) above[n] = f->gltf.nodes[above[n]].parent;
        if (weight[n] > 0 && above[n] >= 0) is_parent[above[n]] = true;
    }
    for (size_t n = 0; n < nodes; n++) {
        const bool ends = !is_parent[n] && !(has_part && f->chosen[n]);
        for (int end = 0; weight[n] > 0 && end < (ends ? 2 : 1);
             end++) { // the line to its parent, and through its middle
            double(*to)[3] = line[f->region.line_count++];
            for (int c = 0; c < 3; c++) {
                to[0][c] = (double)f->rest.world[n][12 + c];
                to[1][c] = end             ? 2 * middle[n][c] / weight[n] - to[0][c]
                           : above[n] >= 0 ? (double)f->rest.world[above[n]][12 + c]
                                           : to[0][c];
            }
        }
    }
    f->region.kind = REGION_BONES;
    f->region.line = (const double(*)[2][3])line;
}

/// Finds the depth, and how far the flesh reaches.
static void measure(struct flesh *f, double depth)
{
    const size_t count = (size_t)f->surface.vertex_count;
    double *away = pool_take(&f->pool, count + 1, sizeof *away);
    size_t soft = 0;
    f->held = pool_take(&f->pool, count + 1, sizeof *f->held);
    f->moves = pool_take(&f->pool, count + 1, sizeof *f->moves);
    for (size_t v = 0; v < count; v++) {
        const float *at = f->surface.position[v];
        f->held[v] = 1 - f->share[v];
        f->moves[v] = region_distance(&f->region, (const double[]){(double)at[0], (double)at[1], (double)at[2]});
        if (f->share[v] > 0.5) away[soft++] = f->moves[v];
    }
    if (soft == 0) away[soft++] = 0;
    qsort(away, soft, sizeof *away, maths_compare);
    f->region.held = f->held;
    f->region.size = depth >= 0 ? depth : usual_depth * away[soft / 2];
    f->thickness = away[soft - 1];
}

/// How much finer the lattice must be to have about as many tetrahedra in the part as in a whole mesh.
static double finer(const struct flesh *f)
{
    double box[2] = {1, 1};
    for (int part = 0; part < 2; part++) {
        for (int c = 0; c < 3; c++) {
            float low = INFINITY, high = -INFINITY;
            for (int v = 0; v < f->surface.vertex_count; v++) {
                if (part && f->share[v] <= 0.5) continue;
                low = fminf(low, f->surface.position[v][c]);
                high = fmaxf(high, f->surface.position[v][c]);
            }
            box[part] *= fmax((double)(high - low), 0);
        }
    }
    return fmin(fmax(box[0] / fmax(box[1], 1e-300), 1), FINEST);
}

// --- poles and coordinates

struct swing {
    double frequency, damping, power;
    bool seen[3];             ///< in the shake along each axis
    double complex *answer;   ///< u, per frame
    double complex *shape[3]; ///< N of each axis
};

/// A coordinate before it is chosen.
struct candidate {
    int pole;
    double direction[3]; ///< e
    double scale;        ///< the largest |u|: x = u / scale
    double explained;    ///< share of the three shakes
};

static int compare_explained(const void *a, const void *b)
{
    const struct candidate *x = a, *y = b;
    return (x->explained < y->explained) - (x->explained > y->explained);
}

/// u of a pole, by the classical Runge-Kutta method.
static void answer(struct swing *s, const struct base_drive *drive, int frames, double fps)
{
    enum { STEPS = 32 };
    const double omega = 2 * M_PI * s->frequency, decay = s->damping * omega,
                 turn = sqrt(omega * omega - decay * decay);
    const double h = 1 / (fps * STEPS);
    double q = 0, v = 0;
    for (int n = 0; n <= (frames - 1) * STEPS; n++) {
        if (n % STEPS == 0) s->answer[n / STEPS] = q - I * (v + decay * q) / turn;
        double dq = 0, dv = 0, sum_q = 0, sum_v = 0;
        for (int k = 0; k < 4; k++) {
            const double part = k == 0 ? 0 : k == 3 ? h : h / 2, at = q + part * dq, speed = v + part * dv;
            dq = speed;
            dv = -drive_acceleration(drive, n * h + part) - 2 * decay * speed - omega * omega * at;
            sum_q += (k % 3 == 0 ? h / 6 : h / 3) * dq;
            sum_v += (k % 3 == 0 ? h / 6 : h / 3) * dv;
        }
        q += sum_q;
        v += sum_v;
    }
}

/// The three shakes, and what is found in them.
struct shakes {
    struct pool pool;
    int frames, vertices;
    float (*motion[3])[3]; ///< frames × vertices
    struct swing swings[SWINGS];
    int swing_count;
    double power;                            ///< Σ |s|²
    struct candidate candidates[3 * SWINGS]; ///< the first is the largest
    int count;
};

/// Shakes the body along each axis. Away from the part the motion fades.
static bool shake(struct shakes *s, struct flesh *f, struct shaking *by, struct soft *soft, struct error *error)
{
    const float(*rest)[3] = (const float(*)[3])f->surface.position;
    const size_t vertices = (size_t)f->surface.vertex_count;
    s->frames = shaking_frames(by);
    s->vertices = f->surface.vertex_count;
    if (!need_has_room(3 * (size_t)s->frames * vertices * sizeof *rest)) return fail_no_memory(error, by->name);
    for (int axis = 0; axis < 3; axis++) {
        struct record record;
        for (int c = 0; c < 3; c++) by->drive.direction[c] = c == axis;
        if (!record_create(&record, by, soft, error)) return false;
        s->motion[axis] = pool_take(&s->pool, (size_t)s->frames * vertices, sizeof **s->motion);
        for (int t = 0; t < s->frames; t++) {
            float(*at)[3] = s->motion[axis] + (size_t)t * vertices;
            memcpy(at, rest, vertices * sizeof *at);
            record_embed(&record, t, soft, (const double[3]){0}, at);
            for (size_t n = 0; n < 3 * vertices; n++) {
                const double way = ((double)at[n / 3][n % 3] - (double)rest[n / 3][n % 3]) * f->moves[n / 3];
                at[n / 3][n % 3] = (float)((double)rest[n / 3][n % 3] + way);
                s->power += way * way;
            }
        }
        if (record.left >= 0) // the other shakes need about the same steps
            by->substeps = 4 * record.left < by->accuracy ? (record.substeps + 1) / 2 : record.substeps;
        record_free(&record);
    }
    return true;
}

/// Finds the poles of each shake; those with about the same frequency become one.
static bool find_poles(struct shakes *s, const struct shaking *by, struct error *error)
{
    struct lapack lapack;
    char description[128];
    if (!lapack_load(&lapack, description, sizeof description))
        return fail(error, ERROR_ENVIRONMENT, "LAPACKE and OpenBLAS: %s", description);
    struct error why = {0};
    for (int axis = 0; axis < 3; axis++) {
        const double direction[] = {axis == 0, axis == 1, axis == 2};
        struct analysis_plan plan = {
            .method = ANALYSIS_POLES, .fps = by->fps, .modes = ANALYSIS_MODES_MAX, .direction = direction};
        plan.first = (int)ceil(drive_end(&by->drive) * by->fps);
        struct analysis analysis = {0};
        const struct motion motion =
            motion_of_memory((const float(*)[3])s->motion[axis], s->frames, s->vertices, by->fps, by->name);
        if (!analysis_create(&analysis, &lapack, &motion, &plan, &why)) continue; // another axis may show more
        for (int k = 0; k < analysis.count; k++) {
            const struct component *c = &analysis.components[k];
            const double power = c->explained * analysis.power;
            if (!(c->frequency > 0 && c->damping < 1 && power > least_share * analysis.power)) continue;
            struct swing *swing = &s->swings[s->swing_count++];
            *swing = (struct swing){.frequency = c->frequency, .damping = c->damping, .power = power};
            swing->seen[axis] = true;
        }
        pool_free(&analysis.pool);
    }
    for (int n = 0; n < s->swing_count * s->swing_count;
         n++) { // nearer than a resonance is wide, two would only cancel
        const int p = n / s->swing_count, q = n % s->swing_count;
        struct swing *to = &s->swings[p], *from = &s->swings[q];
        if (p >= q || fabs(log(from->frequency / to->frequency)) > fmax(same_pole, wide * to->damping)) continue;
        to->power += from->power;
        to->frequency += (from->frequency - to->frequency) * from->power / to->power;
        to->damping += (from->damping - to->damping) * from->power / to->power;
        for (int axis = 0; axis < 3; axis++) to->seen[axis] |= from->seen[axis];
        *from = s->swings[--s->swing_count];
        n = -1; // once more from the first pair on
    }
    lapack_unload(&lapack);
    if (s->swing_count == 0) *error = why;
    return s->swing_count > 0 || *error->text ||
           fail(error, ERROR_INPUT, "%s: expected an oscillation, got none", by->name);
}

/// A number of the shape of a candidate, in metres a unit of x.
static double complex shape_of(const struct shakes *s, const struct candidate *c, size_t number)
{
    double complex sum = 0;
    for (int axis = 0; axis < 3; axis++) sum += c->direction[axis] * s->swings[c->pole].shape[axis][number];
    return sum;
}

/// The relative error of the three shakes that some coordinates leave.
static double error_left(const struct shakes *s, const struct candidate *kept, int count)
{
    const size_t numbers = 3 * (size_t)s->vertices;
    double left = 0;
    for (size_t n = 0; n < 3 * numbers; n++) {
        const size_t axis = n / numbers, number = n % numbers;
        const float *at = *s->motion[axis] + number;
        double complex shape[ANALYSIS_MODES_MAX];
        for (int k = 0; k < count; k++) shape[k] = kept[k].direction[axis] * shape_of(s, &kept[k], number);
        for (int t = 0; t < s->frames; t++) {
            double way = (double)at[(size_t)t * numbers] - (double)at[0];
            for (int k = 0; k < count; k++) way -= creal(s->swings[kept[k].pole].answer[t] * shape[k]);
            left += way * way;
        }
    }
    return s->power > 0 ? sqrt(left / s->power) : 0;
}

/// Finds the shapes of all poles, and their coordinates.
static void find_coordinates(struct shakes *s, const struct shaking *by)
{
    const size_t frames = (size_t)s->frames, numbers = 3 * (size_t)s->vertices;
    double *row = need(frames, sizeof *row), *weights = need(2 * SWINGS * frames, sizeof *weights);
    for (int p = 0; p < s->swing_count; p++) {
        s->swings[p].answer = pool_take(&s->pool, frames, sizeof *s->swings[p].answer);
        answer(&s->swings[p], &by->drive, s->frames, by->fps);
        for (int axis = 0; axis < 3; axis++)
            s->swings[p].shape[axis] = pool_take(&s->pool, numbers, sizeof **s->swings[p].shape);
    }
    for (int axis = 0; axis < 3; axis++) {
        const float *at = *s->motion[axis];
        struct basis basis;
        basis_create(&basis, s->frames, 2 * SWINGS);
        for (int n = 0; n < 2 * s->swing_count; n++) {
            const double complex *u = s->swings[n / 2].answer;
            if (!s->swings[n / 2].seen[axis]) continue;
            for (size_t t = 0; t < frames; t++) row[t] = n % 2 ? -cimag(u[t]) : creal(u[t]);
            basis_append(&basis, row);
        }
        basis_weights(&basis, weights);
        for (int p = 0, used = 0; p < s->swing_count; p++) {
            if (!s->swings[p].seen[axis]) continue;
            const double *re = weights + (size_t)used * frames, *im = re + frames;
            double complex *shape = s->swings[p].shape[axis];
            for (size_t t = 0; t < frames; t++)
                for (size_t n = 0; n < numbers; n++)
                    shape[n] += (re[t] + I * im[t]) * ((double)at[t * numbers + n] - (double)at[n]);
            used += 2;
        }
        pool_free(&basis.pool);
    }
    free(row);
    free(weights);
    for (int p = 0; p < s->swing_count; p++) {
        double moment[9], values[3], vectors[9], largest = 0;
        for (int n = 0; n < 9; n++) {
            const double complex *a = s->swings[p].shape[n / 3], *b = s->swings[p].shape[n % 3];
            moment[n] = 0;
            for (size_t k = 0; k < numbers; k++) moment[n] += creal(a[k] * conj(b[k]));
        }
        symmetric_eigen(3, moment, values, vectors);
        for (size_t t = 0; t < frames; t++) largest = fmax(largest, cabs(s->swings[p].answer[t]));
        for (size_t t = 0; largest > 0 && t < frames; t++)
            s->swings[p].answer[t] /= largest; // max |x| = 1 in a shake along e
        for (int axis = 0; axis < 3; axis++)
            for (size_t k = 0; k < numbers; k++) s->swings[p].shape[axis][k] *= largest;
        for (int e = 0; e < 3; e++) {
            struct candidate *to = &s->candidates[s->count];
            const double *v = vectors + 3 * e;
            int axis = 0; // the longest
            for (int c = 1; c < 3; c++) axis = fabs(v[c]) > fabs(v[axis]) ? c : axis;
            *to = (struct candidate){.pole = p, .scale = largest};
            for (int c = 0; c < 3; c++) to->direction[c] = copysign(1, v[axis]) * v[c];
            const double left = error_left(s, to, 1);
            to->explained = 1 - left * left;
            s->count += values[e] > 0;
        }
    }
    qsort(s->candidates, (size_t)s->count, sizeof *s->candidates, compare_explained);
}

/// A candidate as a coordinate of the mesh's own space, where its skin takes it from, and with the bone that has most of its energy.
static void make_coordinate(struct coordinate *to, struct flesh *f, const struct shakes *s,
                            const struct candidate *from)
{
    const size_t rows = (size_t)f->surface.vertex_count;
    const struct swing *swing = &s->swings[from->pole];
    double *energy = pool_take(&f->pool, (size_t)f->gltf.node_count, sizeof *energy), reach = 0, total = 0;
    vec3s at = {0};
    double(*middle)[3] = pool_take(&f->pool, (size_t)f->gltf.node_count, sizeof *middle);
    to->frequency = round(swing->frequency * 1e6) / 1e6;
    to->damping = round(swing->damping * 1e6) / 1e6;
    to->explained = round(fmin(from->explained, 1) * 1e6) / 1e6;
    to->re = pool_take(&f->pool, rows, sizeof *to->re);
    to->im = pool_take(&f->pool, rows, sizeof *to->im);
    for (int c = 0; c < 3; c++) to->base[c] = round(from->direction[c] / from->scale * 1e6) / 1e6;
    for (size_t v = 0; v < rows; v++) {
        const struct gltf_part *own = f->part_of[v];
        mat4s place = mat4_from(f->rest.world[f->node]);
        double squares = 0;
        vec3s part[2];
        for (int c = 0; c < 3; c++) {
            const double complex n = shape_of(s, from, 3 * v + (size_t)c);
            part[0].raw[c] = (float)creal(n);
            part[1].raw[c] = (float)cimag(n);
            squares += creal(n * conj(n));
        }
        reach = fmax(reach, sqrt(squares));
        for (int k = 0; k < GLTF_INFLUENCES; k++) {
            int node;
            const double weight = follows(f, (int)v, k, &node);
            energy[node] += weight * squares;
            for (int c = 0; c < 3; c++) middle[node][c] += weight * squares * (double)f->surface.position[v][c];
        }
        if (own->joints)
            gltf_blend((const float(*)[16])f->rest.joints + f->gltf.skins[f->skin].first_joint,
                       own->joints[f->row_of[v]], own->weights[f->row_of[v]], *place.raw);
        const mat3s turn = mat3_inverse(glms_mat4_pick3(place));
        memcpy(to->re[v], glms_mat3_mulv(turn, part[0]).raw, sizeof *to->re);
        memcpy(to->im[v], glms_mat3_mulv(turn, part[1]).raw, sizeof *to->im);
    }
    int bone = f->bone;
    for (int n = 0; f->bone < 0 && n < f->gltf.node_count; n++)
        if (bone < 0 || energy[n] > energy[bone]) bone = n;
    for (int n = 0; n < f->gltf.node_count;
         n++) { // what moves with the bone: the part, or what has most weight there
        if (f->bone < 0 && n != bone) continue;
        total += energy[n];
        for (int c = 0; c < 3; c++) at.raw[c] += (float)middle[n][c];
    }
    at = glms_mat4_mulv3(glms_mat4_inv(mat4_from(f->rest.world[bone])),
                         glms_vec3_scale(at, total > 0 ? (float)(1 / total) : 0), 1);
    for (int c = 0; c < 3; c++) to->at[c] = (double)at.raw[c];
    to->bone = f->gltf.nodes[bone].name;
    print_line(stdout, "  %s: %.4g Hz, damping ratio %.3g, explains %.1f %%; %.3g m at most", to->name, to->frequency,
               to->damping, 100 * to->explained, reach);
    print_line(stdout, "    follows %s: x'' + 2 zeta omega x' + omega^2 x = -(%.4g, %.4g, %.4g) . a", to->bone,
               printable_number(to->base[0], 1e-4), printable_number(to->base[1], 1e-4),
               printable_number(to->base[2], 1e-4));
}

/// Keeps the largest coordinates, reports on them, and writes the file.
static bool write_flesh(const struct job *job, struct flesh *f, const struct shakes *s, struct error *error)
{
    struct coordinate coordinates[ANALYSIS_MODES_MAX] = {0};
    const struct gltf_mesh *mesh = &f->gltf.meshes[f->mesh];
    struct names names = {.between = "-"};
    int count = 0;
    for (int t = 0; t < mesh->target_count; t++) { // "belly.re" takes "belly"
        const char *name = gltf_target_name(mesh, t), *dot = name ? strrchr(name, '.') : NULL;
        char *stem = name ? name_from(name, dot ? (size_t)(dot - name) : strlen(name)) : NULL;
        if (name && !names_has(&names, stem)) names_add(&names, stem);
        free(stem);
    }
    while (count < job->modes && count < s->count && (count == 0 || s->candidates[count].explained >= least_share)) {
        const char *name = names_add(&names, f->bone >= 0 ? job->part.text[0] : "flesh");
        coordinates[count].name = pool_text(&f->pool, name, "", "");
        make_coordinate(&coordinates[count], f, s, &s->candidates[count]);
        count++;
    }
    print_line(stdout, "  relative error of the three shakes with %d coordinate%s: %.3g", count, count > 1 ? "s" : "",
               error_left(s, s->candidates, count));
    int most = count;
    while (most < ANALYSIS_MODES_MAX && most < s->count && s->candidates[most].explained >= least_share) most++;
    if (most > count) printf("  with --modes %d: %.3g\n", most, error_left(s, s->candidates, most));
    bool done = coordinates_write(job->output, &f->gltf, f->mesh, coordinates, count, error);
    if (done) print_line(stdout, "wrote %s", job->output);
    if (done && job->scene) {
        struct document *document = import_scene(job->output, error);
        done = document && scene_save(document, job->scene, error);
        if (done) print_line(stdout, "wrote %s", job->scene);
        document_destroy(document);
    }
    names_free(&names);
    return done;
}

/// Makes the soft body, shakes it and says what of.
static bool soften(struct job *job, struct flesh *f, struct shakes *s, struct error *error)
{
    struct shaking *by = &job->by;
    struct soft soft;
    bool fits;
    by->soft.pin = f->region;
    by->soft.tets = (int)fmin(by->soft.tets * finer(f), 200000);
    if (!soft_create(&soft, &f->surface, job->input, &by->soft, error)) return false;
    const double hertz = soft_frequency(&soft);
    if (by->fps == 0) by->fps = fmax(24, ceil(FRAMES_A_PERIOD * hertz));
    by->seconds = shaking_seconds(by, &soft, &fits);
    f->region.size = soft.depth;
    f->thickness -= soft.depth;
    by->drive.size = by->shake.amplitude * f->thickness;
    by->loads.drive = &by->drive;
    for (int v = 0; v < f->surface.vertex_count; v++) // within a cell it fades to what is held
        f->moves[v] = f->share[v] * fmin(fmax((f->moves[v] - f->region.size) / soft.lattice.cell, 0), 1);
    print_line(stdout, "%s: \"%s\", %d vertices; %d tetrahedra, %d of them soft; Young's modulus %.4g Pa", job->input,
               f->gltf.meshes[f->mesh].name, f->surface.vertex_count, soft.lattice.tet_count, soft.body.element_count,
               soft.young);
    printf("  held within %.3g m of the bones (--depth); the flesh is up to %.3g m thick\n", f->region.size,
           f->thickness);
    printf("  seen most: mode %d, %.4g Hz, with %.0f %% of the motion\n", soft.seen + 1, hertz, 100 * soft.share);
    if (soft.unpinned_parts > 0)
        printf("  %d of %d separate parts are not near a bone: they stay\n", soft.unpinned_parts,
               soft.lattice.part_count);
    if (soft.lattice.repair[0]) print_line(stdout, "%s: %s", job->input, soft.lattice.repair);
    fflush(stdout);
    const bool done = (fits || fail(error, ERROR_INPUT,
                                    "%s: a burst of %.4g s and a period of %.4g s do not fit into %.4g s: choose a "
                                    "longer time",
                                    job->input, drive_end(&by->drive), 1 / hertz, by->seconds)) &&
                      shake(s, f, by, &soft, error);
    soft_free(&soft);
    return done;
}

int command_flesh(int argc, char **argv)
{
    struct job job = {.depth = -1, .modes = 3, .by = shaking_default()};
    job.by.fps = 0;
    struct option_spec options[OPTIONS_MOST + 1] = {
        {"-o, --output FILE", "required: a copy of the character, with its flesh as morph targets (.glb)",
         OPTION_OUTPUT, &job.output, 0, 0},
        {"--scene FILE", "also write a scene in which the flesh follows its bones through the first clip",
         OPTION_OUTPUT, &job.scene, 0, 0},
        {"--part BONE",
         "only what follows this bone or those below it (can be repeated), or PAINT.npy (the whole mesh)",
         OPTION_LIST, &job.part, 0, 0},
        {"--depth H", "hold what lies within H metres of the bones (half the median distance)", OPTION_REAL,
         &job.depth, 0, 1e6},
        {"--modes K", "coordinates, most important first (3)", OPTION_INT, &job.modes, 1, ANALYSIS_MODES_MAX},
        {"--amplitude A", "how far the base moves, relative to the thickness of the flesh (0.05)", OPTION_REAL,
         &job.by.amplitude, -2, 2},
        {"--fps N", "frames per second (24, or 10 a period)", OPTION_REAL, &job.by.fps, 1, 1000},
        {"--soft MAP", "soften by distance (from what is held, the default) or FILE.npy (0 to 1 per vertex)",
         OPTION_TEXT, &job.by.soft_text, 0, 0},
        {"--damping Z", "damping ratio of the mode seen most (0.2)", OPTION_REAL, &job.by.damping, 0, 1},
    };
    shaking_options(&job.by, options);
    const struct usage usage = {
        .command = "flesh",
        .operands = "character.glb",
        .summary =
            "Makes a skinned character soft on its own bones: shakes its mesh at rest as a soft body, and adds "
            "what it finds to a copy of the file.",
        .options = options,
    };
    const int result = options_parse(&usage, argc, argv, &job.input);
    if (result != OPTIONS_RUN) return result;
    const char *wrong = shaking_check(&job.by);
    job.by.name = job.input;
    job.by.soft.shake = &job.by.shake;
    shaking_drive(&job.by, DRIVE_BURST);
    if (!job.output)
        wrong = "-o FILE is missing: name the file to write";
    else if (!path_has_end(job.output, ".glb"))
        wrong = "--output: expected a name ending in .glb";
    if (wrong) return options_wrong(&usage, "%s", wrong);

    struct error error;
    struct flesh f = {0};
    struct shakes *s = need_zeroed(1, sizeof *s);
    progress_end_when_interrupted();
    progress_show_stages(job.by.verbose);
    bool done = gltf_read_stored(job.input, &f.gltf, &error);
    if (done) {
        done = (gltf_pose_create(&f.gltf, &f.rest) || fail_no_memory(&error, job.input)) &&
               choose_part(&f, &job, &error) && choose_mesh(&f, &job, &error);
        if (done) {
            make_surface(&f);
            make_lines(&f, job.part.count > 0);
            measure(&f, job.depth);
            done = soften(&job, &f, s, &error) && find_poles(s, &job.by, &error);
        }
        if (done) {
            find_coordinates(s, &job.by);
            done = write_flesh(&job, &f, s, &error);
        }
        gltf_pose_free(&f.rest);
        gltf_free(&f.gltf);
    }
    paint_drop(f.paint);
    pool_free(&s->pool);
    pool_free(&f.pool);
    free(s);
    return options_end(done, &error);
}
