/// Where a mesh stands in the scene: the product of the matrices from the root to its node, columns first as in the file.
#include "model/glb.h"
#include <stdlib.h>
#include <string.h>

static const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// Reads up to `count` numbers of an array; missing ones keep their value.
static void read_array(const json_t *object, const char *key, double *numbers, size_t count)
{
    const json_t *array = json_object_get(object, key);
    for (size_t i = 0; i < count && i < json_array_size(array); i++)
        numbers[i] = json_number_value(json_array_get(array, i));
}

/// T R S of a node: the unit quaternion (x, y, z, w) as a matrix, its columns scaled.
static void local_matrix(const json_t *node, double m[16])
{
    double t[3] = {0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    memcpy(m, identity, sizeof identity);
    read_array(node, "matrix", m, 16);
    if (json_object_get(node, "matrix")) return;
    read_array(node, "translation", t, 3);
    read_array(node, "rotation", q, 4);
    read_array(node, "scale", s, 3);
    for (int column = 0; column < 3; column++) {
        int next = (column + 1) % 3, last = (column + 2) % 3;
        m[4 * column + column] = s[column] * (1 - 2 * (q[next] * q[next] + q[last] * q[last]));
        m[4 * column + next] = s[column] * 2 * (q[column] * q[next] + q[last] * q[3]);
        m[4 * column + last] = s[column] * 2 * (q[column] * q[last] - q[next] * q[3]);
        m[12 + column] = t[column];
    }
}

/// m ← a m
static void multiply_left(const double a[16], double m[16])
{
    double product[16] = {0};
    for (int n = 0; n < 64; n++) product[n / 4 % 4 * 4 + n % 4] += a[n / 16 * 4 + n % 4] * m[n / 4 % 4 * 4 + n / 16];
    memcpy(m, product, sizeof product);
}

/// The first node that shows this mesh, −1 where none does, and of each node one more than the first whose child it is.
static int64_t read_tree(const json_t *nodes, int64_t mesh, size_t *above)
{
    size_t i, k;
    const json_t *node, *child;
    int64_t shows = -1;
    json_array_foreach(nodes, i, node)
    {
        if (shows < 0 && glb_integer(node, "mesh", -1) == mesh) shows = (int64_t)i;
        json_array_foreach(json_object_get(node, "children"), k, child)
        {
            const json_int_t number = json_is_integer(child) ? json_integer_value(child) : -1;
            if (number >= 0 && number < (json_int_t)json_array_size(nodes) && above[number] == 0)
                above[number] = i + 1;
        }
    }
    return shows;
}

bool glb_mesh_matrix(const struct glb *glb, int64_t mesh, double matrix[16], struct error *error)
{
    const json_t *nodes = json_object_get(glb->json, "nodes");
    const size_t count = json_array_size(nodes);
    size_t *above = calloc(count + 1, sizeof *above);
    if (!above) return fail_no_memory(error, glb->path);
    size_t node = (size_t)(read_tree(nodes, mesh, above) + 1);
    memcpy(matrix, identity, sizeof identity);
    for (size_t steps = 0; node > 0 && steps < count; steps++, node = above[node - 1]) { // a cycle ends too
        double local[16];
        local_matrix(json_array_get(nodes, node - 1), local);
        multiply_left(local, matrix);
    }
    free(above);
    return true;
}
