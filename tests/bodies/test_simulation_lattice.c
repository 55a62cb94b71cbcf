/// The lattice around a surface: what is inside, how much of it, what hangs together, and where the vertices are.
#include "near.h"
#include "simulation/lattice.h"
#include "simulation/solid.h"

static void add_vertex(struct surface *surface, double x, double y, double z)
{
    size_t count = (size_t)++surface->vertex_count;
    surface->position = realloc(surface->position, count * sizeof *surface->position);
    assert_non_null(surface->position);
    float *p = surface->position[count - 1];
    p[0] = (float)x;
    p[1] = (float)y;
    p[2] = (float)z;
}

static void add_triangle(struct surface *surface, int a, int b, int c)
{
    size_t count = (size_t)(surface->index_count += 3);
    surface->indices = realloc(surface->indices, count * sizeof *surface->indices);
    assert_non_null(surface->indices);
    const int corners[3] = {a, b, c};
    for (size_t k = 0; k < 3; k++) surface->indices[count - 3 + k] = (uint32_t)corners[k];
}

/// Appends a closed box.
static void add_box(struct surface *surface, const double lo[3], const double hi[3])
{
    static const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    int first = surface->vertex_count;
    for (int i = 0; i < 8; i++) {
        add_vertex(surface, i & 1 ? hi[0] : lo[0], i & 2 ? hi[1] : lo[1], i & 4 ? hi[2] : lo[2]);
    }
    for (int f = 0; f < 6; f++) {
        add_triangle(surface, first + faces[f][0], first + faces[f][1], first + faces[f][2]);
        add_triangle(surface, first + faces[f][0], first + faces[f][2], first + faces[f][3]);
    }
}

/// Appends a sphere of 2 × 32 × 64 triangles, some of them flat at the poles.
static void add_sphere(struct surface *surface, double radius)
{
    enum { RINGS = 32, SECTORS = 64 };
    const double pi = acos(-1.0);
    int first = surface->vertex_count;
    for (int r = 0; r <= RINGS; r++) {
        for (int s = 0; s < SECTORS; s++) {
            double polar = pi * r / RINGS, around = 2 * pi * s / SECTORS, ring = r % RINGS ? sin(polar) : 0;
            add_vertex(surface, radius * ring * cos(around), radius * cos(polar), radius * ring * sin(around));
        }
    }
    for (int i = 0; i < RINGS * SECTORS; i++) {
        int a = first + i, b = first + i / SECTORS * SECTORS + (i + 1) % SECTORS;
        add_triangle(surface, a, b, b + SECTORS);
        add_triangle(surface, a, b + SECTORS, a + SECTORS);
    }
}

/// A surface and its lattice, either of which may be there or not.
struct cut {
    struct surface surface;
    struct lattice lattice;
};

static void cut_into(struct cut *cut, int target)
{
    assert_done(
        lattice_create(&cut->lattice, &cut->surface, &(struct lattice_options){target, NAN, -1}, "test", &error));
}

static void cut_sphere(struct cut *cut, int target)
{
    add_sphere(&cut->surface, 1);
    cut_into(cut, target);
}

static void cut_free(struct cut *cut)
{
    lattice_free(&cut->lattice);
    surface_free(&cut->surface);
}

#define CUT_TEST(name, opens) TEST_OF(struct cut, cut, opens, cut_free(cut), name)

static struct solid solid_of(const struct surface *surface)
{
    struct solid solid;
    solid_create(&solid, surface, 0);
    return solid;
}

static double filled_volume(const struct lattice *lattice)
{
    double sum = 0;
    for (int e = 0; e < lattice->tet_count; e++) sum += lattice->fraction[e] * pow(lattice->cell, 3) / 12;
    return sum;
}

CUT_TEST(voxels_inside_a_sphere, add_sphere(&cut->surface, 1))
{
    for (int i = 0; i < cut->surface.vertex_count; i += 100)
        add_triangle(&cut->surface, i, i, i); // of no size: changes nothing
    // The grid's planes go through the poles and along edges: hits on vertices and edges are the rule here.
    struct voxels voxels = {.size = {41, 41, 41}, .origin = {-1.025, -1.025, -1.025}, .spacing = 0.05};
    struct solid solid = solid_of(&cut->surface);
    assert_int_equal(solid.open, 0);
    voxels_fill(&voxels, &solid);
    for (int i = 0; i < 41 * 41 * 41; i++) {
        const int at[3] = {i / (41 * 41), i / 41 % 41, i % 41};
        double distance = 0.05 * sqrt(pow(at[0] - 20, 2) + pow(at[1] - 20, 2) + pow(at[2] - 20, 2));
        if (distance < 0.99) assert_int_equal(voxels.inside[i], 1);
        if (distance > 1.0001) assert_int_equal(voxels.inside[i], 0);
    }
    voxels_free(&voxels);
    solid_free(&solid);
}

CUT_TEST(a_sphere_in_about_as_many_tetrahedra_as_asked, add_sphere(&cut->surface, 1))
{
    for (int target = 500; target <= quick_or_all(2000, 8000); target *= 4) {
        cut_into(cut, target);
        assert_near((double)cut->lattice.tet_count / target, 1, 0.1);
        assert_near(filled_volume(&cut->lattice) / (4 / 3.0 * acos(-1.0)), 1, 0.01);
        assert_int_equal(cut->lattice.part_count, 1);
        lattice_free(&cut->lattice);
    }
}

/// The vertices stay where they are at rest, and follow any affine map of the nodes exactly.
CUT_TEST(embedding_reproduces_linear_fields, add_sphere(&cut->surface, 1))
{
    static const double map[3][4] = {{1.2, 0.3, -0.1, 5}, {-0.4, 0.8, 0.2, -1}, {0.1, 0.5, 1.5, 2}};
    cut_into(cut, 1000);
    double(*x)[3] = calloc((size_t)cut->lattice.node_count, sizeof *x);
    float(*position)[3] = calloc((size_t)cut->lattice.vertex_count, sizeof *position);
    assert_true(x && position);
    for (int i = 0; i < cut->lattice.node_count; i++) {
        for (int c = 0; c < 3; c++) {
            x[i][c] = map[c][3];
            for (int k = 0; k < 3; k++) x[i][c] += map[c][k] * cut->lattice.node[i][k];
        }
    }
    lattice_embed(&cut->lattice, (const double(*)[3])x, position);
    for (int i = 0; i < cut->lattice.vertex_count; i++) {
        for (int c = 0; c < 3; c++) {
            double expected = map[c][3];
            for (int k = 0; k < 3; k++) expected += map[c][k] * (double)cut->surface.position[i][k];
            assert_near(position[i][c], expected, 1e-6);
        }
        for (int a = 0; a < 4; a++) assert_true(cut->lattice.weight[i][a] > -0.5 && cut->lattice.weight[i][a] < 1.5);
    }
    free(x);
    free(position);
}

#define GAP 0.1

/// Two prongs closer together than a cube's edge share no node above the base that joins them. The fork is made of three
/// boxes that run into each other, which are one solid.
CUT_TEST(prongs_closer_than_a_cell_are_not_glued,
         add_box(&cut->surface, (const double[3]){0, 0, 0}, (const double[3]){2 + GAP, 1, 1}))
{
    add_box(&cut->surface, (const double[3]){0, 0.5, 0}, (const double[3]){1, 4, 1});
    add_box(&cut->surface, (const double[3]){1 + GAP, 0.5, 0}, (const double[3]){2 + GAP, 4, 1});
    cut_into(cut, 1000);
    assert_true(cut->lattice.cell > 3 * GAP);
    assert_int_equal(cut->lattice.part_count, 1);
    assert_near(filled_volume(&cut->lattice), 1 * (2 + GAP) + 2 * 3, 0.6);
    int *side = calloc((size_t)cut->lattice.node_count, sizeof *side);
    assert_non_null(side);
    // Colour the nodes of either prong from its top, going from element to element as long as they lie above the base.
    for (int i = 8; i < 24; i++) {
        if ((double)cut->surface.position[i][1] < 3.9) continue;
        for (int a = 0; a < 4; a++) side[cut->lattice.tet[cut->lattice.host[i]][a]] |= i < 16 ? 1 : 2;
    }
    for (int round = 0; round < 100; round++) {
        for (int e = 0; e < cut->lattice.tet_count; e++) {
            const int *tet = cut->lattice.tet[e];
            int reached = 0;
            bool above = true;
            for (int a = 0; a < 4; a++) {
                reached |= side[tet[a]];
                above = above && cut->lattice.node[tet[a]][1] > 1 + cut->lattice.cell;
            }
            for (int a = 0; above && a < 4; a++) side[tet[a]] |= reached;
        }
    }
    int seen[4] = {0};
    for (int i = 0; i < cut->lattice.node_count; i++) seen[side[i]]++;
    assert_true(seen[1] > 20 && seen[2] > 20);
    assert_int_equal(seen[3], 0);
    free(side);
}

CUT_TEST(separate_solids_are_separate_parts,
         add_box(&cut->surface, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1}))
{
    add_box(&cut->surface, (const double[3]){1.1, 0, 0}, (const double[3]){2.1, 1, 1});
    cut_into(cut, 500);
    assert_int_equal(cut->lattice.part_count, 2);
    for (int i = 0; i < 16; i++) {
        assert_int_equal(cut->lattice.part[cut->lattice.host[i]],
                         cut->lattice.part[cut->lattice.host[i < 8 ? 0 : 8]]);
    }
}

/// A mesh that is symmetric left and right gets a lattice that is.
CUT_TEST(the_lattice_is_as_symmetric_as_the_mesh, cut_sphere(cut, 700))
{
    for (int i = 0; i < cut->lattice.node_count; i++) {
        bool found = false;
        for (int j = 0; j < cut->lattice.node_count && !found; j++) {
            const double *p = cut->lattice.node[i], *q = cut->lattice.node[j];
            found = fabs(p[0] + q[0]) < 1e-6 && fabs(p[1] - q[1]) < 1e-6 && fabs(p[2] - q[2]) < 1e-6;
        }
        assert_true(found);
    }
}

/// However thin it is, cutting it takes bounded memory, and where nothing is left of it that is said.
CUT_TEST(a_needle_is_cut_within_bounds,
         add_box(&cut->surface, (const double[3]){0, 0, 0}, (const double[3]){1e-3, 2, 1e-3}))
{
    struct error error = {0};
    struct surface hair = {0};
    cut_into(cut, 3000);
    assert_true(cut->lattice.tet_count > 100);
    lattice_free(&cut->lattice);
    add_box(&hair, (const double[3]){0, 0, 0}, (const double[3]){1e-9, 2, 1e-9});
    assert_false(lattice_create(&cut->lattice, &hair, &(struct lattice_options){3000, NAN, -1}, "hair.obj", &error));
    assert_string_equal(error.text, "hair.obj: the mesh is too thin for a lattice of 3000 tetrahedra");
    surface_free(&hair);
}

static int open_edges(const struct surface *surface)
{
    struct solid solid = solid_of(surface);
    int open = solid.open;
    solid_free(&solid);
    return open;
}

/// A corner of a box drawn out far along an axis: the tip is thinner than a voxel, and its vertex goes to the end of what is left.
TEST(a_long_thin_tip_follows_the_nearest_element)
{
    for (int axis = 0; axis < 3; axis++) {
        for (int shape = 0; shape < (axis < 2 ? quick_or_all(1, 2) : 2); shape++) {
            struct cut cut = {0};
            add_box(&cut.surface, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
            cut.surface.position[7][axis] = shape ? 5123 : 256;
            cut_into(&cut, 300);
            const struct lattice *lattice = &cut.lattice;
            for (int v = 0; v < 8; v++) {
                double nearest = INFINITY, own = INFINITY;
                for (int i = 0; i < 4 * lattice->tet_count; i++) {
                    const double *node = lattice->node[lattice->tet[i / 4][i % 4]];
                    const float *at = cut.surface.position[v];
                    const double away =
                        hypot(hypot(node[0] - (double)at[0], node[1] - (double)at[1]), node[2] - (double)at[2]);
                    nearest = fmin(nearest, away);
                    if (i / 4 == lattice->host[v]) own = fmin(own, away);
                }
                assert_true(own <= nearest + lattice->cell);
            }
            cut_free(&cut);
        }
    }
}

TEST(open_edges_are_counted)
{
    struct surface box = {0};
    add_box(&box, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
    assert_int_equal(open_edges(&box), 0);
    box.index_count -= 3;
    assert_int_equal(open_edges(&box), 3);
    surface_free(&box);

    struct surface split = {0}; // every corner there three times, as exporters write them for normals
    for (int i = 0; i < 3; i++) add_box(&split, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
    split.index_count /= 3;
    for (int i = 0; i < split.index_count; i++) split.indices[i] += 8 * (uint32_t)(i % 3);
    assert_int_equal(open_edges(&split), 0);
    surface_free(&split);
}

static void flip(struct surface *surface, int triangle)
{
    uint32_t *corner = surface->indices + 3 * triangle, swap = corner[0];
    corner[0] = corner[1];
    corner[1] = swap;
}

/// Every third triangle of a box seen from inside, all of another one that stands in it, and a cavity that faces rightly inwards.
CUT_TEST(mixed_sides_are_made_to_agree,
         add_box(&cut->surface, (const double[3]){0, 0, 0}, (const double[3]){4, 4, 4}))
{
    add_box(&cut->surface, (const double[3]){3, 1, 1}, (const double[3]){8, 2, 2});
    add_box(&cut->surface, (const double[3]){1, 1, 1}, (const double[3]){2, 2, 2});
    for (int t = 0; t < 12; t += 3) flip(&cut->surface, t);
    for (int t = 12; t < 36; t++) flip(&cut->surface, t);
    struct solid solid = solid_of(&cut->surface);
    assert_int_equal(solid.open, 0);
    assert_int_equal(solid.turned, 4 + 12);
    cut_into(cut, 2000);
    assert_near(filled_volume(&cut->lattice), 64 - 1 + 4, 2);
    assert_string_equal(cut->lattice.repair, "16 triangles turned to face outwards");
    solid_free(&solid);
}

CUT_TEST(a_triangle_there_twice_counts_once, add_sphere(&cut->surface, 1))
{
    const int triangles = cut->surface.index_count / 3;
    for (int t = 0; t < triangles; t++) {
        const uint32_t *corner = cut->surface.indices + 3 * t;
        const int a = (int)corner[0], b = (int)corner[1], c = (int)corner[2];
        add_triangle(&cut->surface, b, a, c); // seen from both sides
    }
    cut_into(cut, 1000);
    assert_near(filled_volume(&cut->lattice) / (4 / 3.0 * acos(-1.0)), 1, 0.02);
    assert_non_null(strstr(cut->lattice.repair, " duplicate triangles left out"));
}

/// Winding numbers against those of a plain sum over all triangles' solid angles, which for a closed sphere are 0 and 1.
CUT_TEST(the_tree_sums_like_all_triangles, add_sphere(&cut->surface, 1))
{
    struct winding winding;
    winding_create(&winding, &cut->surface);
    for (int i = 0; i < 200; i++) {
        const double r = i * 0.015, p[3] = {r * 0.6, r * 0.64, r * -0.48};
        if (fabs(r - 1) > 0.01) assert_near(winding_at(&winding, p), r < 1, 0.01);
    }
    winding_free(&winding);
    cut->surface.index_count /= 2; // the upper half: seen from its middle, half of all directions
    winding_create(&winding, &cut->surface);
    assert_near(winding_at(&winding, (const double[3]){0, 0, 0}), 0.5, 0.01);
    winding_free(&winding);
}

/// So few triangles that they are no tree.
TEST(four_triangles_are_summed_one_by_one)
{
    static const uint32_t corners[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    struct surface surface = {0};
    struct winding winding;
    for (int v = 0; v < 4; v++) add_vertex(&surface, v == 1, v == 2, v == 3);
    for (int t = 0; t < 4; t++) add_triangle(&surface, (int)corners[t][0], (int)corners[t][1], (int)corners[t][2]);
    winding_create(&winding, &surface);
    assert_near(winding_at(&winding, (const double[3]){0.2, 0.2, 0.2}), 1, 1e-6);
    assert_near(winding_at(&winding, (const double[3]){0.5, 0.5, 0.5}), 0, 1e-6);
    winding_free(&winding);
    surface_free(&surface);
}

/// A bowl is closed by a flat lid, on which it takes up half of all directions.
CUT_TEST(a_hole_is_closed_by_winding_numbers, add_sphere(&cut->surface, 1))
{
    memmove(cut->surface.indices, cut->surface.indices + 3 * 2 * 64 * 10,
            sizeof *cut->surface.indices * (size_t)(cut->surface.index_count - 3 * 2 * 64 * 10));
    cut->surface.index_count -= 3 * 2 * 64 * 10;
    cut_into(cut, 1000);
    const double pi = acos(-1.0), height = 1 - cos(pi * 10 / 32), cap = pi * height * height * (3 - height) / 3;
    assert_near(filled_volume(&cut->lattice), 4 / 3.0 * pi - cap, 0.02 * 4 / 3.0 * pi);
    assert_non_null(strstr(cut->lattice.repair, "open at 64 edges"));
}

/// Appends a grid of ACROSS × UP squares over 0 ≤ u, v ≤ 1; places that meet are one vertex to the lattice.
static void add_sheet(struct surface *surface, void (*place)(double u, double v, double at[3]))
{
    enum { ACROSS = 48, UP = 12 };
    int first = surface->vertex_count;
    for (int i = 0; i < (ACROSS + 1) * (UP + 1); i++) {
        double at[3];
        place((double)(i % (ACROSS + 1)) / ACROSS, (double)(i / (ACROSS + 1)) / UP, at);
        add_vertex(surface, round(1e4 * at[0]) / 1e4, round(1e4 * at[1]) / 1e4, round(1e4 * at[2]) / 1e4);
    }
    for (int i = 0; i < ACROSS * UP; i++) {
        int a = first + i / ACROSS * (ACROSS + 1) + i % ACROSS, d = a + ACROSS + 1;
        add_triangle(surface, a, a + 1, d + 1);
        add_triangle(surface, a, d + 1, d);
    }
}

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
    static const struct sheet {
        void (*place)(double u, double v, double at[3]);
        bool closable, body;
        const char *thickness;
        bool needs_more; ///< tetrahedra, to be that thin: make test-all has them
    } sheets[] = {{flag, false, false, "0.05", false},
                  {moebius, false, false, "0.06", true},
                  {klein, false, false, "0.09", false},
                  {skirt, true, false, "0.04", false},
                  {bowl, true, true, "0.1", true}};
    for (const struct sheet *sheet = sheets; sheet < sheets + sizeof sheets / sizeof *sheets; sheet++) {
        struct cut cut = {0};
        struct error refusal = {0};
        char offer[80];
        add_sheet(&cut.surface, sheet->place);
        const struct surface *s = &cut.surface;
        snprintf(offer, sizeof offer, "x: the mesh has no clear inside: --thickness %s makes", sheet->thickness);
        for (int closes = 0; closes < 2; closes++) {
            const bool good =
                lattice_create(&cut.lattice, s, &(struct lattice_options){300, NAN, closes ? 0 : -1}, "x", &refusal);
            assert_int_equal(good, closes ? sheet->closable : sheet->body);
            if (!good) assert_ptr_equal(strstr(refusal.text, offer), refusal.text);
            if (!good) assert_int_equal(strstr(refusal.text, "--thickness 0 closes") != NULL, sheet->closable);
            lattice_free(&cut.lattice);
        }
        if (sheet->needs_more && !is_thorough()) {
            cut_free(&cut);
            continue;
        }
        const double thickness = atof(sheet->thickness);
        assert_done(lattice_create(&cut.lattice, s,
                                   &(struct lattice_options){quick_or_all(3000, 6000), NAN, thickness}, "x", &error));
        struct solid solid = solid_of(s);
        print_message("%s: volume %.3f of the sheet's\n", cut.lattice.repair,
                      filled_volume(&cut.lattice) / (solid.area * thickness));
        assert_int_equal(cut.lattice.part_count, 1);
        assert_near(filled_volume(&cut.lattice) / (solid.area * thickness), 1, 0.15);
        for (int i = 0; i < s->vertex_count; i++) {
            for (int a = 0; a < 4; a++) assert_true(cut.lattice.weight[i][a] > -0.5);
        }
        solid_free(&solid);
        cut_free(&cut);
    }
}

/// Vertices that no triangle has stay where they are, and do not widen the box.
CUT_TEST(strays_stay, add_vertex(&cut->surface, 1000, 0, 0))
{
    add_box(&cut->surface, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
    cut_into(cut, 500);
    assert_int_equal(cut->lattice.host[0], -1);
    assert_true(cut->lattice.cell < 0.5);
    float(*position)[3] = calloc((size_t)cut->surface.vertex_count, sizeof *position);
    assert_non_null(position);
    position[0][0] = 1000;
    lattice_embed(&cut->lattice, (const double(*)[3])cut->lattice.node, position);
    assert_near(position[0][0], 1000, 0);
    assert_near(position[8][0], 1, 1e-6);
    free(position);
}
