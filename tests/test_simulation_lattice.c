/// The lattice around a surface: what is inside, how much of it, what hangs together, and where the vertices are.
#include "near.h"
#include "simulation/closed.h"
#include "simulation/lattice.h"
#include "simulation/voxels.h"
#include <stdlib.h>
#include <string.h>

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

static struct lattice lattice_of(const struct surface *surface, int target)
{
    struct lattice lattice;
    struct error error = {0};
    if (!lattice_create(&lattice, surface, target, NAN, "test", &error)) fail_msg("%s", error.text);
    return lattice;
}

static double filled_volume(const struct lattice *lattice)
{
    double sum = 0;
    for (int e = 0; e < lattice->tet_count; e++) sum += lattice->fraction[e] * pow(lattice->cell, 3) / 12;
    return sum;
}

static void voxels_inside_a_sphere(void **state)
{
    (void)state;
    struct surface sphere = {0};
    add_sphere(&sphere, 1);
    for (int i = 0; i < sphere.vertex_count; i += 100) add_triangle(&sphere, i, i, i); // of no size: changes nothing
    // The grid's planes go through the poles and along edges: hits on vertices and edges are the rule here.
    struct voxels voxels = {.size = {41, 41, 41}, .origin = {-1.025, -1.025, -1.025}, .spacing = 0.05};
    assert_true(voxels_fill(&voxels, &sphere));
    for (int i = 0; i < 41 * 41 * 41; i++) {
        const int at[3] = {i / (41 * 41), i / 41 % 41, i % 41};
        double distance = 0.05 * sqrt(pow(at[0] - 20, 2) + pow(at[1] - 20, 2) + pow(at[2] - 20, 2));
        if (distance < 0.99) assert_int_equal(voxels.inside[i], 1);
        if (distance > 1.0001) assert_int_equal(voxels.inside[i], 0);
    }
    voxels_free(&voxels);
    surface_free(&sphere);
}

static void a_sphere_in_about_as_many_tetrahedra_as_asked(void **state)
{
    (void)state;
    struct surface sphere = {0};
    add_sphere(&sphere, 1);
    for (int target = 500; target <= 8000; target *= 4) {
        struct lattice lattice = lattice_of(&sphere, target);
        assert_near((double)lattice.tet_count / target, 1, 0.1);
        assert_near(filled_volume(&lattice) / (4 / 3.0 * acos(-1.0)), 1, 0.01);
        assert_int_equal(lattice.part_count, 1);
        lattice_free(&lattice);
    }
    surface_free(&sphere);
}

/// The vertices stay where they are at rest, and follow any affine map of the nodes exactly.
static void embedding_reproduces_linear_fields(void **state)
{
    (void)state;
    static const double map[3][4] = {{1.2, 0.3, -0.1, 5}, {-0.4, 0.8, 0.2, -1}, {0.1, 0.5, 1.5, 2}};
    struct surface sphere = {0};
    add_sphere(&sphere, 1);
    struct lattice lattice = lattice_of(&sphere, 1000);
    double(*x)[3] = calloc((size_t)lattice.node_count, sizeof *x);
    float(*position)[3] = calloc((size_t)lattice.vertex_count, sizeof *position);
    assert_true(x && position);
    for (int i = 0; i < lattice.node_count; i++) {
        for (int c = 0; c < 3; c++) {
            x[i][c] = map[c][3];
            for (int k = 0; k < 3; k++) x[i][c] += map[c][k] * lattice.node[i][k];
        }
    }
    lattice_embed(&lattice, (const double(*)[3])x, position);
    for (int i = 0; i < lattice.vertex_count; i++) {
        for (int c = 0; c < 3; c++) {
            double expected = map[c][3];
            for (int k = 0; k < 3; k++) expected += map[c][k] * (double)sphere.position[i][k];
            assert_near(position[i][c], expected, 1e-6);
        }
        for (int a = 0; a < 4; a++) assert_true(lattice.weight[i][a] > -0.5 && lattice.weight[i][a] < 1.5);
    }
    free(x);
    free(position);
    lattice_free(&lattice);
    surface_free(&sphere);
}

/// Two prongs closer together than a cube's edge share no node above the base that joins them. The fork is made of three
/// boxes that run into each other, which are one solid.
static void prongs_closer_than_a_cell_are_not_glued(void **state)
{
    (void)state;
    const double gap = 0.1;
    struct surface fork = {0};
    add_box(&fork, (const double[3]){0, 0, 0}, (const double[3]){2 + gap, 1, 1});
    add_box(&fork, (const double[3]){0, 0.5, 0}, (const double[3]){1, 4, 1});
    add_box(&fork, (const double[3]){1 + gap, 0.5, 0}, (const double[3]){2 + gap, 4, 1});
    struct lattice lattice = lattice_of(&fork, 1000);
    assert_true(lattice.cell > 3 * gap);
    assert_int_equal(lattice.part_count, 1);
    assert_near(filled_volume(&lattice), 1 * (2 + gap) + 2 * 3, 0.6);
    int *side = calloc((size_t)lattice.node_count, sizeof *side);
    assert_non_null(side);
    // Colour the nodes of either prong from its top, going from element to element as long as they lie above the base.
    for (int i = 8; i < 24; i++) {
        if ((double)fork.position[i][1] < 3.9) continue;
        for (int a = 0; a < 4; a++) side[lattice.tet[lattice.host[i]][a]] |= i < 16 ? 1 : 2;
    }
    for (int round = 0; round < 100; round++) {
        for (int e = 0; e < lattice.tet_count; e++) {
            const int *tet = lattice.tet[e];
            int reached = 0;
            bool above = true;
            for (int a = 0; a < 4; a++) {
                reached |= side[tet[a]];
                above = above && lattice.node[tet[a]][1] > 1 + lattice.cell;
            }
            for (int a = 0; above && a < 4; a++) side[tet[a]] |= reached;
        }
    }
    int seen[4] = {0};
    for (int i = 0; i < lattice.node_count; i++) seen[side[i]]++;
    assert_true(seen[1] > 20 && seen[2] > 20);
    assert_int_equal(seen[3], 0);
    free(side);
    lattice_free(&lattice);
    surface_free(&fork);
}

static void separate_solids_are_separate_parts(void **state)
{
    (void)state;
    struct surface two = {0};
    add_box(&two, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
    add_box(&two, (const double[3]){1.1, 0, 0}, (const double[3]){2.1, 1, 1});
    struct lattice lattice = lattice_of(&two, 500);
    assert_int_equal(lattice.part_count, 2);
    for (int i = 0; i < 16; i++) {
        assert_int_equal(lattice.part[lattice.host[i]], lattice.part[lattice.host[i < 8 ? 0 : 8]]);
    }
    lattice_free(&lattice);
    surface_free(&two);
}

/// A mesh that is symmetric left and right gets a lattice that is.
static void the_lattice_is_as_symmetric_as_the_mesh(void **state)
{
    (void)state;
    struct surface sphere = {0};
    add_sphere(&sphere, 1);
    struct lattice lattice = lattice_of(&sphere, 700);
    for (int i = 0; i < lattice.node_count; i++) {
        bool found = false;
        for (int j = 0; j < lattice.node_count && !found; j++) {
            const double *p = lattice.node[i], *q = lattice.node[j];
            found = fabs(p[0] + q[0]) < 1e-6 && fabs(p[1] - q[1]) < 1e-6 && fabs(p[2] - q[2]) < 1e-6;
        }
        assert_true(found);
    }
    lattice_free(&lattice);
    surface_free(&sphere);
}

/// However thin it is, cutting it takes bounded memory, and where nothing is left of it that is said.
static void a_needle_is_cut_within_bounds(void **state)
{
    (void)state;
    struct lattice lattice;
    struct error error = {0};
    struct surface needle = {0}, hair = {0};
    add_box(&needle, (const double[3]){0, 0, 0}, (const double[3]){1e-3, 2, 1e-3});
    lattice = lattice_of(&needle, 3000);
    assert_true(lattice.tet_count > 100);
    lattice_free(&lattice);
    add_box(&hair, (const double[3]){0, 0, 0}, (const double[3]){1e-9, 2, 1e-9});
    assert_false(lattice_create(&lattice, &hair, 3000, NAN, "hair.obj", &error));
    assert_string_equal(error.text, "hair.obj: the mesh is too thin for a lattice of 3000 tetrahedra");
    surface_free(&needle);
    surface_free(&hair);
}

static void open_edges_are_counted(void **state)
{
    (void)state;
    struct surface box = {0};
    add_box(&box, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
    assert_int_equal(surface_open_edges(&box), 0);
    box.index_count -= 3;
    assert_int_equal(surface_open_edges(&box), 3);
    box.index_count += 3;
    uint32_t swap = box.indices[0]; // one triangle seen from inside
    box.indices[0] = box.indices[1];
    box.indices[1] = swap;
    assert_int_equal(surface_open_edges(&box), 3);
    surface_free(&box);

    struct surface split = {0}; // every corner there three times, as exporters write them for normals
    for (int i = 0; i < 3; i++) add_box(&split, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
    split.index_count /= 3;
    for (int i = 0; i < split.index_count; i++) split.indices[i] += 8 * (uint32_t)(i % 3);
    assert_int_equal(surface_open_edges(&split), 0);
    surface_free(&split);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(voxels_inside_a_sphere),
        cmocka_unit_test(a_sphere_in_about_as_many_tetrahedra_as_asked),
        cmocka_unit_test(embedding_reproduces_linear_fields),
        cmocka_unit_test(prongs_closer_than_a_cell_are_not_glued),
        cmocka_unit_test(separate_solids_are_separate_parts),
        cmocka_unit_test(the_lattice_is_as_symmetric_as_the_mesh),
        cmocka_unit_test(a_needle_is_cut_within_bounds),
        cmocka_unit_test(open_edges_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
