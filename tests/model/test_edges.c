/// Which triangles are across edges, and where a mesh ends: outlines are softened there, and nowhere else.
#include "model/adjacency.h"
#include "near.h"

static const float square[][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

/// Two triangles of a square, whose diagonal goes from vertex 0 to 2; `other` are the second one's corners.
static void find(const float (*position)[3], int vertices, const uint32_t other[3], int neighbours[6])
{
    const uint32_t indices[6] = {0, 1, 2, other[0], other[1], other[2]};
    neighbours_find(position, vertices, indices, 6, neighbours);
}

TEST(a_sheet_ends_at_its_border)
{
    static const int expected[6] = {NEIGHBOUR_NONE, NEIGHBOUR_NONE, 1, 0, NEIGHBOUR_NONE, NEIGHBOUR_NONE};
    int neighbours[6];
    find(square, 4, (const uint32_t[]){0, 2, 3}, neighbours);
    assert_memory_equal(neighbours, expected, sizeof neighbours);
}

TEST(vertices_at_one_place_are_one)
{
    static const float split[][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1.7e-7f, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    int neighbours[6];
    find(split, 6, (const uint32_t[]){3, 4, 5}, neighbours);
    assert_int_equal(neighbours[2], 1);
    assert_int_equal(neighbours[3], 0);
}

/// The square's two triangles, and the same from behind.
TEST(sheets_back_to_back_go_on_in_themselves)
{
    static const uint32_t indices[12] = {0, 1, 2, 0, 2, 1, 0, 2, 3, 0, 3, 2};
    int neighbours[12];
    neighbours_find(square, 4, indices, 12, neighbours);
    assert_int_equal(neighbours[2], 2); // the diagonal, from 2 to 0: to the other front, not to its own back
    assert_int_equal(neighbours[3], 3);
    assert_int_equal(neighbours[0], 1); // the border: round to the back
}

/// A fan of more triangles than are looked at, around its middle.
TEST(large_fans_are_whole)
{
    enum { MANY = 500 };
    static float position[MANY + 1][3];
    static uint32_t indices[3 * MANY];
    static int neighbours[3 * MANY];
    for (int i = 0; i < MANY; i++) {
        position[i + 1][0] = cosf(6.2831853f * (float)i / MANY);
        position[i + 1][1] = sinf(6.2831853f * (float)i / MANY);
        indices[3 * i + 1] = (uint32_t)i + 1;
        indices[3 * i + 2] = (uint32_t)(i + 1) % MANY + 1;
    }
    neighbours_find((const float(*)[3])position, MANY + 1, indices, 3 * MANY, neighbours);
    for (int i = 0; i < MANY; i++) assert_int_equal(neighbours[3 * i + 2], (i + 1) % MANY);
}

/// The later of two triangles ends where materials or colours change, the earlier one goes on.
TEST(looks_cut)
{
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    static const float red[3] = {1, 0, 0}, blue[3] = {0, 0, 1};
    const uint32_t one = neighbours_look(0, red), others[] = {neighbours_look(1, red), neighbours_look(0, blue)};
    int neighbours[6];
    for (int o = 0; o < 2; o++) {
        const uint32_t same[6] = {one, one, one, one, one, one};
        const uint32_t changed[6] = {one, one, one, others[o], others[o], others[o]};
        find(square, 4, indices + 3, neighbours);
        neighbours_cut(square, indices, same, 6, neighbours);
        assert_int_equal(neighbours[3], 0);
        neighbours_cut(square, indices, changed, 6, neighbours);
        assert_int_equal(neighbours[3], NEIGHBOUR_CUT);
        assert_int_equal(neighbours[2], 1);
    }
}
