/// The lattice around a surface: what is inside, how much of it, what hangs together, and where the vertices are.
#include "near.h"
#include "simulation/lattice.h"

/// A surface and its lattice, either of which may be there or not.
struct cut {
    struct surface surface;
    struct lattice lattice;
};

static void add_vertex(struct cut *cut, double x, double y, double z)
{
    struct surface *s = &cut->surface;
    s->position = realloc(s->position, (size_t)++s->vertex_count * sizeof *s->position);
    assert_non_null(s->position);
    memcpy(s->position[s->vertex_count - 1], (const float[]){(float)x, (float)y, (float)z}, sizeof *s->position);
}

static void add_triangle(struct cut *cut, int a, int b, int c)
{
    struct surface *s = &cut->surface;
    s->indices = realloc(s->indices, (size_t)(s->index_count += 3) * sizeof *s->indices);
    assert_non_null(s->indices);
    const uint32_t corners[3] = {(uint32_t)a, (uint32_t)b, (uint32_t)c};
    memcpy(s->indices + s->index_count - 3, corners, sizeof corners);
}

/// Appends a closed box.
static void add_box(struct cut *cut, double x0, double y0, double z0, double x1, double y1, double z1)
{
    static const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    int first = cut->surface.vertex_count;
    for (int i = 0; i < 8; i++) add_vertex(cut, i & 1 ? x1 : x0, i & 2 ? y1 : y0, i & 4 ? z1 : z0);
    for (int f = 0; f < 6; f++) {
        add_triangle(cut, first + faces[f][0], first + faces[f][1], first + faces[f][2]);
        add_triangle(cut, first + faces[f][0], first + faces[f][2], first + faces[f][3]);
    }
}

static void add_unit_box(struct cut *cut) { add_box(cut, 0, 0, 0, 1, 1, 1); }

enum { RINGS = 32, SECTORS = 64 };

/// Appends a sphere of radius 1 and 2 × 32 × 64 triangles, some of them flat at the poles.
static void add_sphere(struct cut *cut)
{
    for (int i = 0; i < (RINGS + 1) * SECTORS; i++) {
        const int r = i / SECTORS, s = i % SECTORS;
        double polar = M_PI * r / RINGS, around = 2 * M_PI * s / SECTORS, ring = r % RINGS ? sin(polar) : 0;
        add_vertex(cut, ring * cos(around), cos(polar), ring * sin(around));
    }
    for (int a = 0; a < RINGS * SECTORS; a++) {
        const int b = a / SECTORS * SECTORS + (a + 1) % SECTORS;
        add_triangle(cut, a, b, b + SECTORS);
        add_triangle(cut, a, b + SECTORS, a + SECTORS);
    }
}

static void cut_free(struct cut *cut)
{
    pool_free(&cut->lattice.pool);
    surface_free(&cut->surface);
}

#define CUT_TEST(name, opens) TEST_OF(struct cut, cut, opens, cut_free(cut), name)
#define SPHERE_TEST(name) CUT_TEST(name, add_sphere(cut))

/// Refuses with a message that begins with "x".
static bool cut_as(struct cut *cut, int target, double thickness, struct error *error)
{
    const struct lattice_options options = {target, NAN, thickness};
    pool_free(&cut->lattice.pool);
    return lattice_create(&cut->lattice, &cut->surface, &options, "x", error);
}

static const struct lattice *cut_into(struct cut *cut, int target)
{
    assert_done(cut_as(cut, target, -1, &error));
    return &cut->lattice;
}

static struct solid solid_of(const struct cut *cut)
{
    struct solid solid;
    solid_create(&solid, &cut->surface, 0);
    return solid;
}

static double filled_volume(const struct cut *cut)
{
    double sum = 0;
    for (int e = 0; e < cut->lattice.tet_count; e++) sum += cut->lattice.fraction[e] * pow(cut->lattice.cell, 3) / 12;
    return sum;
}

static const double ball = 4 / 3.0 * M_PI;

// --- spheres

SPHERE_TEST(voxels_inside_a_sphere)
{
    // The grid's planes go through the poles and along edges: hits on vertices and edges are the rule here.
    struct voxels voxels = {.size = {41, 41, 41}, .origin = {-1.025, -1.025, -1.025}, .spacing = 0.05};
    for (int i = 0; i < cut->surface.vertex_count; i += 100)
        add_triangle(cut, i, i, i); // of no size: changes nothing
    struct solid solid = solid_of(cut);
    assert_int_equal(solid.open, 0);
    voxels_fill(&voxels, &solid);
    for (int i = 0; i < 41 * 41 * 41; i++) {
        double distance = 0.05 * sqrt(pow(i / (41 * 41) - 20, 2) + pow(i / 41 % 41 - 20, 2) + pow(i % 41 - 20, 2));
        if (distance < 0.99 || distance > 1.0001) assert_int_equal(voxels.inside[i], distance < 0.99);
    }
    pool_free(&voxels.pool);
    pool_free(&solid.pool);
}

/// In about as many tetrahedra as asked, of its volume, and as symmetric as the mesh. The vertices stay where they are at rest, and follow any
/// affine map of the nodes exactly.
SPHERE_TEST(a_sphere_is_filled_evenly_and_followed)
{
    static const double map[3][4] = {{1.2, 0.3, -0.1, 5}, {-0.4, 0.8, 0.2, -1}, {0.1, 0.5, 1.5, 2}};
    for (int target = 500; target <= quick_or_all(2000, 8000); target *= 4) {
        const struct lattice *filled = cut_into(cut, target);
        assert_near((double)filled->tet_count / target, 1, 0.1);
        assert_near(filled_volume(cut) / ball, 1, 0.01);
        assert_int_equal(filled->part_count, 1);
    }
    const struct lattice *lattice = cut_into(cut, 700);
    for (int i = 0; i < lattice->node_count; i++) {
        bool found = false;
        for (int j = 0; j < lattice->node_count && !found; j++) {
            const double *p = lattice->node[i], *q = lattice->node[j];
            found = fabs(p[0] + q[0]) < 1e-6 && fabs(p[1] - q[1]) < 1e-6 && fabs(p[2] - q[2]) < 1e-6;
        }
        assert_true(found);
    }
    double(*x)[3] = calloc((size_t)lattice->node_count, sizeof *x);
    float(*position)[3] = calloc((size_t)lattice->vertex_count, sizeof *position);
    assert_true(x && position);
    for (int i = 0; i < 3 * lattice->node_count; i++) {
        const double *m = map[i % 3], *p = lattice->node[i / 3];
        x[i / 3][i % 3] = m[3] + m[0] * p[0] + m[1] * p[1] + m[2] * p[2];
    }
    lattice_embed(lattice, (const double(*)[3])x, position);
    for (int i = 0; i < lattice->vertex_count; i++) {
        const float *p = cut->surface.position[i];
        for (int c = 0; c < 3; c++) {
            const double *m = map[c];
            assert_near(position[i][c], m[3] + m[0] * (double)p[0] + m[1] * (double)p[1] + m[2] * (double)p[2], 1e-6);
        }
        for (int a = 0; a < 4; a++) assert_true(lattice->weight[i][a] > -0.5 && lattice->weight[i][a] < 1.5);
    }
    free(x);
    free(position);
}

/// Winding numbers against those of a plain sum over all triangles' solid angles, which for a closed sphere are 0 and 1.
SPHERE_TEST(the_tree_sums_like_all_triangles)
{
    struct winding winding;
    struct pool pool = {0};
    winding_create(&winding, &pool, &cut->surface);
    for (int i = 0; i < 200; i++) {
        const double r = i * 0.015, p[3] = {r * 0.6, r * 0.64, r * -0.48};
        if (fabs(r - 1) > 0.01) assert_near(winding_at(&winding, p), r < 1, 0.01);
    }
    cut->surface.index_count /= 2; // the upper half: seen from its middle, half of all directions
    winding_create(&winding, &pool, &cut->surface);
    assert_near(winding_at(&winding, (const double[3]){0, 0, 0}), 0.5, 0.01);

    static const int corners[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    struct cut few = {0}; // so few triangles that they are no tree
    for (int v = 0; v < 4; v++) add_vertex(&few, v == 1, v == 2, v == 3);
    for (int t = 0; t < 4; t++) add_triangle(&few, corners[t][0], corners[t][1], corners[t][2]);
    winding_create(&winding, &pool, &few.surface);
    assert_near(winding_at(&winding, (const double[3]){0.2, 0.2, 0.2}), 1, 1e-6);
    assert_near(winding_at(&winding, (const double[3]){0.5, 0.5, 0.5}), 0, 1e-6);
    pool_free(&pool);
    surface_free(&few.surface);
}

// --- what hangs together

#define GAP 0.1

/// Two prongs closer together than a cube's edge share no node above the base that joins them. The fork is made of three
/// boxes that run into each other, which are one solid.
CUT_TEST(prongs_closer_than_a_cell_are_not_glued, add_box(cut, 0, 0, 0, 2 + GAP, 1, 1))
{
    add_box(cut, 0, 0.5, 0, 1, 4, 1);
    add_box(cut, 1 + GAP, 0.5, 0, 2 + GAP, 4, 1);
    const struct lattice *lattice = cut_into(cut, 1000);
    assert_true(lattice->cell > 3 * GAP);
    assert_int_equal(lattice->part_count, 1);
    assert_near(filled_volume(cut), 1 * (2 + GAP) + 2 * 3, 0.6);
    int *side = calloc((size_t)lattice->node_count, sizeof *side), seen[4] = {0};
    assert_non_null(side);
    // Colour the nodes of either prong from its top, going from element to element as long as they lie above the base.
    for (int i = 8; i < 24; i++) {
        if ((double)cut->surface.position[i][1] < 3.9) continue;
        for (int a = 0; a < 4; a++) side[lattice->tet[lattice->host[i]][a]] |= i < 16 ? 1 : 2;
    }
    for (int i = 0; i < 100 * lattice->tet_count; i++) {
        const int *tet = lattice->tet[i % lattice->tet_count];
        const int reached = side[tet[0]] | side[tet[1]] | side[tet[2]] | side[tet[3]];
        bool above = true;
        for (int a = 0; a < 4; a++) above = above && lattice->node[tet[a]][1] > 1 + lattice->cell;
        for (int a = 0; above && a < 4; a++) side[tet[a]] |= reached;
    }
    for (int i = 0; i < lattice->node_count; i++) seen[side[i]]++;
    assert_true(seen[1] > 20 && seen[2] > 20);
    assert_int_equal(seen[3], 0);
    free(side);
}

CUT_TEST(separate_solids_are_separate_parts, add_unit_box(cut))
{
    add_box(cut, 1.1, 0, 0, 2.1, 1, 1);
    const struct lattice *lattice = cut_into(cut, 500);
    assert_int_equal(lattice->part_count, 2);
    for (int i = 0; i < 16; i++)
        assert_int_equal(lattice->part[lattice->host[i]], lattice->part[lattice->host[i < 8 ? 0 : 8]]);
}

/// Vertices that no triangle has stay where they are, and do not widen the box.
CUT_TEST(strays_stay, add_vertex(cut, 1000, 0, 0))
{
    float position[9][3] = {{1000}};
    add_unit_box(cut);
    const struct lattice *lattice = cut_into(cut, 500);
    assert_int_equal(lattice->host[0], -1);
    assert_true(lattice->cell < 0.5);
    lattice_embed(lattice, (const double(*)[3])lattice->node, position);
    assert_near(position[0][0], 1000, 0);
    assert_near(position[8][0], 1, 1e-6);
}

/// However thin it is, cutting it takes bounded memory, and where nothing is left of it that is said.
CUT_TEST(a_needle_is_cut_within_bounds, add_box(cut, 0, 0, 0, 1e-3, 2, 1e-3))
{
    struct cut hair = {0};
    assert_true(cut_into(cut, 3000)->tet_count > 100);
    add_box(&hair, 0, 0, 0, 1e-9, 2, 1e-9);
    assert_refusal(cut_as(&hair, 3000, -1, &error), "x: the mesh is too thin for a lattice of 3000 tetrahedra");
    cut_free(&hair);
}

/// A corner of a box drawn out far along an axis: the tip is thinner than a voxel, and its vertex goes to the end of what is left.
TEST(a_long_thin_tip_follows_the_nearest_element)
{
    for (int axis = 0; axis < 3; axis++) {
        for (int shape = 0; shape < (axis < 2 ? quick_or_all(1, 2) : 2); shape++) {
            struct cut cut = {0};
            add_unit_box(&cut);
            cut.surface.position[7][axis] = shape ? 5123 : 256;
            const struct lattice *lattice = cut_into(&cut, 300);
            for (int v = 0; v < 8; v++) {
                const float *at = cut.surface.position[v];
                double nearest = INFINITY, own = INFINITY;
                for (int i = 0; i < 4 * lattice->tet_count; i++) {
                    const double *node = lattice->node[lattice->tet[i / 4][i % 4]];
                    const double away =
                        hypot(hypot(node[0] - (double)at[0], node[1] - (double)at[1]), node[2] - (double)at[2]);
                    nearest = fmin(nearest, away);
                    if (i / 4 == lattice->host[v]) own = fmin(own, away);
                }
                if (!(own <= nearest + lattice->cell)) fail_msg("axis %d, shape %d, vertex %d", axis, shape, v);
            }
            cut_free(&cut);
        }
    }
}

// --- what is put right

/// Of a closed box; of one without a triangle; and of one with every corner there three times, as exporters write them for normals.
TEST(open_edges_are_counted)
{
    static const int open[] = {0, 3, 0};
    for (int kind = 0; kind < 3; kind++) {
        struct cut box = {0};
        for (int i = 0; i < (kind == 2 ? 3 : 1); i++) add_unit_box(&box);
        struct surface *s = &box.surface;
        s->index_count = kind == 1 ? 33 : 36;
        for (int i = 0; kind == 2 && i < s->index_count; i++) s->indices[i] += 8 * (uint32_t)(i % 3);
        struct solid solid = solid_of(&box);
        assert_int_equal(solid.open, open[kind]);
        pool_free(&solid.pool);
        cut_free(&box);
    }
}

/// Every third triangle of a box seen from inside, all of another one that stands in it, and a cavity that faces rightly inwards.
CUT_TEST(mixed_sides_are_made_to_agree, add_box(cut, 0, 0, 0, 4, 4, 4))
{
    add_box(cut, 3, 1, 1, 8, 2, 2);
    add_box(cut, 1, 1, 1, 2, 2, 2);
    for (int t = 0; t < 36; t += t < 12 ? 3 : 1) {
        uint32_t *corner = cut->surface.indices + 3 * t, swap = corner[0];
        corner[0] = corner[1];
        corner[1] = swap;
    }
    struct solid solid = solid_of(cut);
    assert_int_equal(solid.open, 0);
    assert_int_equal(solid.turned, 4 + 12);
    pool_free(&solid.pool);
    assert_string_equal(cut_into(cut, 2000)->repair, "16 triangles turned to face outwards");
    assert_near(filled_volume(cut), 64 - 1 + 4, 2);
}

SPHERE_TEST(a_triangle_there_twice_counts_once)
{
    for (int t = cut->surface.index_count / 3 - 1; t >= 0; t--) { // seen from both sides
        const uint32_t *corner = cut->surface.indices + 3 * t;
        add_triangle(cut, (int)corner[1], (int)corner[0], (int)corner[2]);
    }
    assert_non_null(strstr(cut_into(cut, 1000)->repair, " duplicate triangles left out"));
    assert_near(filled_volume(cut) / ball, 1, 0.02);
}

/// A bowl is closed by a flat lid, on which it takes up half of all directions.
SPHERE_TEST(a_hole_is_closed_by_winding_numbers)
{
    const int left_out = 3 * 2 * SECTORS * 10;
    const double height = 1 - cos(M_PI * 10 / RINGS), cap = M_PI * height * height * (3 - height) / 3;
    struct surface *s = &cut->surface;
    s->index_count -= left_out;
    memmove(s->indices, s->indices + left_out, (size_t)s->index_count * sizeof *s->indices);
    assert_non_null(strstr(cut_into(cut, 1000)->repair, "open at 64 edges"));
    assert_near(filled_volume(cut), ball - cap, 0.02 * ball);
}

// --- sheets over 0 ≤ u, v ≤ 1; places that meet are one vertex to the lattice

static void flag(double u, double v, double at[3])
{
    at[0] = 1.5 * u;
    at[1] = v;
    at[2] = 0.05 * sin(2 * M_PI * u);
}

static void skirt(double u, double v, double at[3])
{
    at[0] = (0.35 - 0.2 * v) * cos(2 * M_PI * u);
    at[1] = 0.6 * v;
    at[2] = (0.35 - 0.2 * v) * sin(2 * M_PI * u);
}

static void moebius(double u, double v, double at[3])
{
    const double away = 0.4 * v - 0.2, radius = 1 + away * cos(M_PI * u);
    at[0] = radius * cos(2 * M_PI * u);
    at[1] = radius * sin(2 * M_PI * u);
    at[2] = away * sin(M_PI * u);
}

/// The bottle whose neck goes through its wall.
static void klein(double u, double v, double at[3])
{
    const double along = 2 * M_PI * u, around = 2 * M_PI * v, radius = 0.2 - 0.1 * cos(along);
    const bool outer = along < M_PI;
    at[0] = 0.3 * cos(along) * (1 + sin(along)) + radius * (outer ? cos(along) * cos(around) : -cos(around));
    at[1] = 0.8 * sin(along) + (outer ? radius * sin(along) * cos(around) : 0);
    at[2] = radius * sin(around);
}

static void bowl(double u, double v, double at[3])
{
    const double polar = M_PI * (0.3 + 0.7 * v);
    at[0] = sin(polar) * cos(2 * M_PI * u);
    at[1] = cos(polar);
    at[2] = sin(polar) * sin(2 * M_PI * u);
}

/// Sheets are refused without a thickness, with one that fits in the error; with it they are one part of their own volume, and every vertex
/// is near its element.
TEST(sheets_need_a_thickness_and_bodies_do_not)
{
    enum { ACROSS = 48, UP = 12, WIDE = ACROSS + 1 };
    static const struct {
        const char *name;
        void (*place)(double u, double v, double at[3]);
        bool closable, body;
        const char *thickness;
        bool needs_more; ///< tetrahedra, to be that thin: make test-all has them
    } rows[] = {{"a flag", flag, false, false, "0.05", false},
                {"a Möbius strip", moebius, false, false, "0.06", true},
                {"a Klein bottle", klein, false, false, "0.09", false},
                {"a skirt", skirt, true, false, "0.04", false},
                {"a bowl", bowl, true, true, "0.1", true}};
    for (size_t row = 0; row < sizeof rows / sizeof *rows; row++) {
        struct cut cut = {0};
        struct error refusal = {0};
        char offer[80];
        for (int i = 0; i < WIDE * (UP + 1); i++) {
            double at[3];
            rows[row].place((double)(i % WIDE) / ACROSS, (double)(i / WIDE) / UP, at);
            add_vertex(&cut, round(1e4 * at[0]) / 1e4, round(1e4 * at[1]) / 1e4, round(1e4 * at[2]) / 1e4);
        }
        for (int i = 0; i < ACROSS * UP; i++) {
            const int a = i / ACROSS * WIDE + i % ACROSS, d = a + WIDE;
            add_triangle(&cut, a, a + 1, d + 1);
            add_triangle(&cut, a, d + 1, d);
        }
        snprintf(offer, sizeof offer, "x: the mesh has no clear inside: --thickness %s makes", rows[row].thickness);
        for (int closes = 0; closes < 2; closes++) {
            const bool good = cut_as(&cut, 300, closes ? 0 : -1, &refusal);
            if (good != (closes ? rows[row].closable : rows[row].body))
                fail_msg("%s: %s", rows[row].name, refusal.text);
            if (good) continue;
            assert_ptr_equal(strstr(refusal.text, offer), refusal.text);
            assert_int_equal(strstr(refusal.text, "--thickness 0 closes") != NULL, rows[row].closable);
        }
        if (!rows[row].needs_more || is_thorough()) {
            const double thickness = atof(rows[row].thickness);
            assert_done(cut_as(&cut, quick_or_all(3000, 6000), thickness, &error));
            struct solid solid = solid_of(&cut);
            const double share = filled_volume(&cut) / (solid.area * thickness);
            if (cut.lattice.part_count != 1 || fabs(share - 1) > 0.15)
                fail_msg("%s: %d parts, %g of its volume", rows[row].name, cut.lattice.part_count, share);
            for (int i = 0; i < 4 * cut.surface.vertex_count; i++)
                assert_true(cut.lattice.weight[i / 4][i % 4] > -0.5);
            pool_free(&solid.pool);
        }
        cut_free(&cut);
    }
}
