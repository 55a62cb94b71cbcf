/// Soft characters by what a person sees: the same picture as of a figure that already has the shape, the place or the colours that it
/// should be given.
#include "offscreen.h"
#include "puppet.h"

enum { WIDTH = 500, HEIGHT = 300 };

typedef unsigned char picture[HEIGHT][WIDTH][4];

static int set_up(void **state)
{
    (void)state;
    return offscreen_open(WIDTH, HEIGHT);
}

static struct stage_character shown(const struct figure *figure)
{
    return (struct stage_character){.figure = figure, .map_coordinate = -1};
}

static void draw_all(const struct stage_character *characters, int count, picture pixels)
{
    const float lo[3] = {-1, 0, -1}, hi[3] = {1, 1.5f, 1};
    offscreen_draw_characters(characters, count, lo, hi, WIDTH, HEIGHT, pixels);
}

static void draw(const struct stage_character *character, picture pixels) { draw_all(character, 1, pixels); }

/// Pixels that differ by more than `tolerance` in any channel.
static int differing(const picture a, const picture b, int tolerance)
{
    int count = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        bool differs = false;
        for (int k = 0; k < 3; k++)
            differs |= abs(a[i / WIDTH][i % WIDTH][k] - b[i / WIDTH][i % WIDTH][k]) > tolerance;
        count += differs;
    }
    return count;
}

static picture one, other;

/// Weights work on re and im with their signs: z Ñ = (3 + 4j)(0.12 − 0.16j) = 1 moves as far as another place does; the
/// second coordinate adds to it.
TEST(coordinates_move_it)
{
    if (!platform) skip();
    struct character character = puppet_character(0.05f, 3);
    for (int i = 0; i < character.vertex_count; i++) {
        character.coordinates[0].re[i][0] = 9; // not driven
        character.coordinates[1].re[i][0] = 0.12f;
        character.coordinates[1].im[i][0] = -0.16f;
        character.coordinates[2].re[i][1] = 0.5f;
    }
    struct figure figure = puppet_figure(&character);
    struct stage_character moved = shown(&figure), placed = shown(&figure), still = shown(&figure);
    moved.morph = (struct morph){2, {1, 2}, {{1.5f, 2.0f}, {0.5f, 9.0f}}};
    moved.position[0] = -0.5f;
    placed.morph = (struct morph){1, {2}, {{0.5f, 0}}};
    draw(&moved, one);
    draw(&placed, other);
    assert_true(differing(one, other, 2) < 20);
    draw(&still, other);
    assert_true(differing(one, other, 20) > 1000);
    figure_free(&figure);
}

/// Several rigs may show the same figure.
TEST(a_figure_stands_in_two_places)
{
    if (!platform) skip();
    static picture pair;
    struct character character = puppet_character(0.05f, 0);
    struct figure figure = puppet_figure(&character);
    struct stage_character both[2] = {shown(&figure), shown(&figure)};
    both[0].position[0] = -0.5f;
    both[1].position[0] = 0.5f;
    draw_all(both, 2, pair);
    for (int c = 0; c < 2; c++) {
        draw(&both[c], one);
        assert_true(differing(one, pair, 20) > 1000);
    }
    figure_free(&figure);
}

/// A ball that is stretched by its coordinate looks like one that was made so, light and all.
TEST(normals_follow_on_the_stage)
{
    if (!platform) skip();
    struct character soft = puppet_character(0.05f, 1), firm = puppet_character(0.05f, 0);
    for (int i = 0; i < soft.vertex_count; i++) {
        const float *p = soft.position[i], *n = soft.normal[i];
        soft.coordinates[0].im[i][0] = -0.8f * p[0] - 0.5f * p[1];
        firm.position[i][0] += 0.8f * p[0] + 0.5f * p[1];
        // Cofactors of ((1.8, 0.5, 0), (0, 1, 0), (0, 0, 1)).
        const float turned[3] = {n[0], 1.8f * n[1] - 0.5f * n[0], 1.8f * n[2]};
        const float length = sqrtf(turned[0] * turned[0] + turned[1] * turned[1] + turned[2] * turned[2]);
        for (int k = 0; k < 3; k++) firm.normal[i][k] = turned[k] / length;
    }
    struct figure soft_figure = puppet_figure(&soft), firm_figure = puppet_figure(&firm);
    struct stage_character moved = shown(&soft_figure), made = shown(&firm_figure);
    moved.morph = (struct morph){1, {0}, {{0, 1}}};
    draw(&moved, one);
    draw(&made, other);
    assert_true(differing(one, other, 6) < 60);
    figure_free(&soft_figure);
    figure_free(&firm_figure);
}

/// What is painted after a figure was drawn reaches the GPU: the picture is that of a figure which was made so, and of the plain
/// one when the paint is gone.
TEST(paint_shows_on_the_stage)
{
    if (!platform) skip();
    struct character plain = puppet_character(0.05f, 2), made = puppet_character(0.05f, 2);
    float(*paint)[2] = calloc(2 * (size_t)plain.vertex_count, sizeof *paint);
    assert_non_null(paint);
    for (int i = 0; i < plain.vertex_count; i++) {
        const float y = plain.position[i][1], turn = y > 0.6f ? 3 * (y - 0.6f) : 0;
        plain.coordinates[1].re[i][0] = 0.3f;
        made.coordinates[1].re[i][0] = 0.3f * cosf(turn);
        made.coordinates[1].im[i][0] = 0.3f * sinf(turn);
        paint[plain.vertex_count + i][1] = turn;
    }
    struct figure plain_figure = puppet_figure(&plain), made_figure = puppet_figure(&made);
    struct painted *painted = painted_create(&plain_figure);
    assert_non_null(painted);
    struct stage_character moved = shown(&painted->figure), expected = shown(&made_figure);
    static picture first;
    moved.morph = expected.morph = (struct morph){1, {1}, {{0.4f, 0.8f}}};
    draw(&moved, first);
    painted_update(painted, (const float(*)[2])paint);
    draw(&moved, one);
    draw(&expected, other);
    assert_true(differing(one, other, 2) < 20);
    assert_true(differing(one, first, 20) > 1000);
    painted_update(painted, NULL);
    draw(&moved, other);
    assert_int_equal(differing(other, first, 0), 0);
    painted_destroy(painted);
    figure_free(&plain_figure);
    figure_free(&made_figure);
    free(paint);
}

/// A puppet whose phase along z is `phase` at its feet and grows by `more` a metre upwards.
static struct character phased(float phase, float more)
{
    struct character character = puppet_character(0.05f, 2);
    for (int i = 0; i < character.vertex_count; i++) {
        const float y = character.position[i][1], angle = phase + more * y;
        character.coordinates[1].re[i][2] = y * cosf(angle);
        character.coordinates[1].im[i][2] = y * sinf(angle);
    }
    return character;
}

/// Draws a figure twice: by the shader's phase map into `one`, painted with the legend's colours into `other`.
static void draw_mapped(const struct figure *figure)
{
    struct character painted = puppet_character(0.05f, 0);
    const struct coordinate *c = &figure->character.coordinates[1];
    const float largest = figure->largest[1][2];
    for (int i = 0; i < painted.vertex_count; i++)
        phase_color_linear(c->re[i][2] / largest, c->im[i][2] / largest, painted.color[i]);
    struct figure painted_figure = puppet_figure(&painted);
    struct stage_character by_shader = shown(figure), by_hand = shown(&painted_figure);
    by_shader.map_coordinate = 1;
    by_shader.map_axis = 2;
    draw(&by_shader, one);
    draw(&by_hand, other);
    figure_free(&painted_figure);
}

/// The shader's phase map has the legend's colours, all around; where nothing moves it is grey.
TEST(phases_are_the_legends_colours)
{
    if (!platform) skip();
    for (int eighth = 0; eighth < 8; eighth++) {
        struct character mapped = phased((float)eighth * 0.785398163f - 0.15f, 0.3f);
        struct figure figure = puppet_figure(&mapped);
        draw_mapped(&figure);
        assert_int_equal(differing(one, other, 2), 0);
        struct stage_character still = shown(&figure);
        still.map_coordinate = 1;
        still.map_axis = 0;
        draw(&still, one);
        assert_true(differing(one, other, 20) > 1000);
        figure_free(&figure);
    }
}

/// Draws a figure's phase map and its own colours: a coat, and eyes where it is high up.
static void draw_with_eyes(float coat, float eyes, picture map, picture plain)
{
    struct character character = phased(0.5f, 0.3f);
    for (int i = 0; i < character.vertex_count; i++) {
        for (int k = 0; k < 3; k++) character.color[i][k] = character.position[i][1] > 0.9f ? eyes : coat;
    }
    struct figure figure = puppet_figure(&character);
    struct stage_character mapped = shown(&figure), own = shown(&figure);
    mapped.map_coordinate = 1;
    mapped.map_axis = 2;
    draw(&mapped, map);
    draw(&own, plain);
    figure_free(&figure);
}

/// Dark eyes on a coat stay as they are; a coat that is dark all over has phases all over.
TEST(eyes_stay_on_the_phase_map)
{
    if (!platform) skip();
    static picture bare;
    draw_with_eyes(0.4f, 0.4f, bare, other);
    draw_with_eyes(0.01f, 0.01f, one, other);
    assert_int_equal(differing(one, bare, 2), 0);
    draw_with_eyes(0.4f, 0.01f, one, other);
    int kept = 0, changed = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int mapped = one[i / WIDTH][i % WIDTH][0], own = other[i / WIDTH][i % WIDTH][0];
        const bool is_eye = mapped + 90 < bare[i / WIDTH][i % WIDTH][0];
        kept += is_eye && abs(mapped - own) <= 2;
        changed += is_eye && abs(mapped - own) > 2; // at their rim
    }
    assert_true(kept > 500);
    assert_true(changed < kept / 10);
}

/// Between two eighths of a turn there is a thin dark line, wherever on the circle; it has no gap to either side of where half
/// a turn ahead is half a turn behind.
TEST(a_line_divides_eighths_of_a_turn)
{
    if (!platform) skip();
    for (int eighth = 0; eighth < 8; eighth++) {
        struct character mapped = phased(((float)eighth + 0.5f) * 0.785398163f - 0.45f, 0.7f);
        struct figure figure = puppet_figure(&mapped);
        draw_mapped(&figure);
        int rows = 0, lit = 0;
        for (int y = 0; y < HEIGHT; y++) {
            int dark = 0;
            for (int x = 0; x < WIDTH; x++) {
                dark += other[y][x][1] - one[y][x][1] > 15;
                lit += one[y][x][1] - other[y][x][1] > 2;
            }
            rows += dark > 0;
        }
        assert_int_equal(lit, 0);
        assert_in_range(differing(one, other, 15), 20, 1000);
        assert_in_range(rows, 1, HEIGHT / 4);
        figure_free(&figure);
    }
}

TESTS_BETWEEN(set_up, offscreen_close)
