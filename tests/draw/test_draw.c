/// Pixels, offscreen: what a person would see of rectangles, lines, clips and text, and that redrawing only what changed gives
/// the same picture as redrawing all. Skipped where there is no EGL.
#include "near.h"

#include "draw/draw.h"
#include "draw/gl.h"
#include "platform/platform.h"
#include "ui/font.h"
#include "ui/theme.h"

enum { WIDTH = 320, HEIGHT = 240 };
static const uint32_t WHITE = 0xFFFFFFFFu, BLACK = 0x000000FFu;

static struct platform *platform;
static struct draw *draw;
static struct drawlist list;
static float stage_scale = 1.0f;
static unsigned char pixels[WIDTH * HEIGHT * 4], expected[WIDTH * HEIGHT * 4];

static int set_up(void **state)
{
    (void)state;
    struct error error;
    platform = platform_offscreen(WIDTH, HEIGHT, 1.0f, &error);
    if (!platform) {
        print_message("skip - %s\n", error.text);
        return 0;
    }
    font_init();
    draw = draw_create(1.0f, &error);
    drawlist_create(&list, 1024, 300000, 4096);
    if (draw) return 0;
    print_error("%s\n", error.text);
    return -1;
}

static int tear_down(void **state)
{
    (void)state;
    drawlist_destroy(&list);
    draw_destroy(draw);
    platform_destroy(platform);
    return 0;
}

static void begin(void)
{
    if (!platform) skip();
    drawlist_clear(&list, (struct rect){0.0f, 0.0f, WIDTH, HEIGHT});
}

/// Draws `list` and the stage and reads the picture.
static struct draw_cost show_on(const struct stage_view *stage, bool keeps, unsigned char *out)
{
    struct draw_input input = {WIDTH, HEIGHT, 1.0f, keeps, &list, stage, 0, stage_scale};
    struct draw_cost cost;
    draw_frame(draw, &input, &cost);
    platform_swap(platform);
    draw_read(WIDTH, HEIGHT, out);
    return cost;
}

static void show(void) { show_on(NULL, false, pixels); }

/// Red, green and blue at a pixel as 0xRRGGBB.
static unsigned at(int x, int y)
{
    const unsigned char *p = pixels + 4 * (y * WIDTH + x);
    return (unsigned)p[0] << 16 | (unsigned)p[1] << 8 | p[2];
}

/// How much of a white thing on black covers a pixel.
static double coverage(int x, int y) { return pixels[4 * (y * WIDTH + x)] / 255.0; }

TEST(test_rect_has_its_color_and_exact_edges)
{
    begin();
    drawlist_rect(&list, (struct rect){0.0f, 0.0f, WIDTH, HEIGHT}, BLACK);
    drawlist_rect(&list, (struct rect){10.0f, 20.0f, 30.0f, 40.0f}, theme()->accent);
    drawlist_rect(&list, (struct rect){100.25f, 50.5f, 20.5f, 10.0f}, WHITE);
    show();
    assert_int_equal(at(10, 20), theme()->accent >> 8);
    assert_int_equal(at(39, 59), theme()->accent >> 8);
    assert_int_equal(at(9, 20) | at(40, 20) | at(10, 19) | at(10, 60), 0);
    double sum = 0.0;
    for (int y = 45; y < 65; y++) {
        for (int x = 95; x < 125; x++) sum += coverage(x, y);
    }
    assert_near(sum, 20.5 * 10.0, 0.5);
    assert_near(coverage(100, 55), 0.75, 0.01);
    assert_near(coverage(110, 50), 0.5, 0.01);
}

TEST(test_later_commands_cover_earlier_ones)
{
    begin();
    drawlist_rect(&list, (struct rect){0.0f, 0.0f, 200.0f, 200.0f}, theme()->accent); // large enough to be a fill
    drawlist_rect(&list, (struct rect){20.0f, 20.0f, 10.0f, 10.0f}, WHITE);
    drawlist_rect(&list, (struct rect){10.0f, 10.0f, 100.0f, 100.0f}, BLACK); // and a fill over triangles
    drawlist_rect(&list, (struct rect){30.0f, 30.0f, 10.0f, 10.0f}, 0xFFFFFF80u);
    show();
    assert_int_equal(at(5, 5), theme()->accent >> 8);
    assert_int_equal(at(25, 25), 0);
    assert_near(coverage(35, 35), 128.0 / 255.0, 0.005);
    assert_int_equal(at(250, 5), theme()->panel >> 8);
}

/// Sum of coverage over a rectangle of pixels.
static double ink(int x0, int y0, int x1, int y1)
{
    double sum = 0.0;
    for (int y = y0; y < y1; y++) {
        for (int x = x0; x < x1; x++) sum += coverage(x, y);
    }
    return sum;
}

// A line of width w crosses each pixel column with w / cos(slope) of ink, whatever its slope and thin ones included.
TEST(test_line_has_its_width_at_every_slope)
{
    const float widths[] = {0.5f, 1.0f, 1.25f, 2.5f, 6.0f}, slopes[] = {0.0f, 0.1f, 0.5f, 1.0f};
    for (int i = 0; i < 20; i++) {
        float width = widths[i % 5], slope = slopes[i / 5];
        const float xy[4] = {10.0f, 20.3f, 150.0f, 20.3f + 140.0f * slope};
        begin();
        drawlist_rect(&list, (struct rect){0.0f, 0.0f, WIDTH, HEIGHT}, BLACK);
        drawlist_line(&list, xy, 2, width, WHITE);
        show();
        assert_near(ink(30, 0, 130, HEIGHT) / 100.0, width * hypotf(1.0f, slope), 0.03 * width + 0.02);
    }
}

TEST(test_line_ends_where_it_is_told)
{
    begin();
    drawlist_rect(&list, (struct rect){0.0f, 0.0f, WIDTH, HEIGHT}, BLACK);
    drawlist_line(&list, (const float[]){20.0f, 30.5f, 60.0f, 30.5f}, 2, 1.0f, WHITE);
    drawlist_dashed(&list, (const float[]){20.0f, 40.5f, 60.0f, 40.5f}, 2, 1.0f, 6.0f, 4.0f, WHITE);
    show();
    assert_near(coverage(19, 30) + coverage(60, 30) + coverage(40, 29) + coverage(40, 31), 0.0, 0.0);
    assert_near(coverage(20, 30) + coverage(59, 30) + coverage(40, 30), 3.0, 0.01);
    for (int x = 20; x < 60; x++) assert_near(coverage(x, 40), (x - 20) % 10 < 6 ? 1.0 : 0.0, 0.01);
}

/// An end between two pixels covers its share of the last one, wherever on the screen and of however many points the line is.
TEST(test_line_ends_between_pixels)
{
    const float from[] = {20.25f, 220.25f};
    for (int i = 0; i < 2; i++) {
        const float x = from[i];
        const int first = (int)x;
        begin();
        drawlist_rect(&list, (struct rect){0.0f, 0.0f, WIDTH, HEIGHT}, BLACK);
        drawlist_line(&list, (const float[]){x, 30.5f, x + 40.0f, 30.5f}, 2, 1.0f, WHITE);
        drawlist_line(&list, (const float[]){x, 50.5f, x + 15.0f, 50.5f, x + 40.0f, 50.5f}, 3, 1.0f, WHITE);
        show();
        for (int y = 30; y <= 50; y += 20) {
            assert_near(coverage(first, y), 0.75, 0.03);
            assert_near(coverage(first + 40, y), 0.25, 0.03);
            assert_near(ink(first - 2, y, first + 43, y + 1), 40.0, 0.05);
        }
    }
}

// Where the quads of a translucent curve overlapped, it would be brighter; where they gaped, darker.
TEST(test_translucent_curve_has_no_seams)
{
    float xy[600];
    for (int i = 0; i < 300; i++) {
        xy[2 * i] = 10.0f + (float)i;
        xy[2 * i + 1] = 120.0f + 60.0f * sinf(0.05f * (float)i);
    }
    begin();
    drawlist_rect(&list, (struct rect){0.0f, 0.0f, WIDTH, HEIGHT}, BLACK);
    drawlist_line(&list, xy, 300, 4.0f, 0xFFFFFF80u);
    show();
    double brightest = 0.0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) brightest = fmax(brightest, pixels[4 * i] / 255.0);
    assert_near(brightest, 128.0 / 255.0, 0.005);
    for (int i = 5; i < 295; i++) {
        assert_near(coverage((int)xy[2 * i], (int)floorf(xy[2 * i + 1])), 128.0 / 255.0, 0.01);
    }
}

TEST(test_closed_line_has_all_its_corners)
{
    begin();
    drawlist_rect(&list, (struct rect){0.0f, 0.0f, WIDTH, HEIGHT}, BLACK);
    drawlist_rounded_line(&list, (struct rect){20.0f, 20.0f, 40.0f, 30.0f}, 0.0f, 2.0f, WHITE);
    show();
    assert_near(coverage(20, 20) + coverage(59, 20) + coverage(20, 49) + coverage(59, 49), 4.0, 0.02);
    assert_near(ink(0, 0, 100, 100), 2.0 * 2.0 * (40.0 + 30.0) - 16.0, 1.0);
}

TEST(test_convex_covers_its_area)
{
    begin();
    drawlist_rect(&list, (struct rect){0.0f, 0.0f, WIDTH, HEIGHT}, BLACK);
    drawlist_convex(&list, (const float[]){60.0f, 40.0f, 75.0f, 55.0f, 60.0f, 70.0f, 45.0f, 55.0f}, 4, WHITE);
    drawlist_rounded(&list, (struct rect){100.0f, 40.0f, 60.0f, 20.0f}, 10.0f, WHITE);
    show();
    assert_near(ink(40, 30, 90, 80), 450.0, 9.0);
    assert_near(ink(95, 30, 170, 80), 60.0 * 20.0 - (4.0 - M_PI) * 100.0, 12.0);
    assert_near(coverage(60, 55), 1.0, 0.0);
}

TEST(test_nothing_shows_outside_its_clip)
{
    begin();
    drawlist_rect(&list, (struct rect){0.0f, 0.0f, WIDTH, HEIGHT}, BLACK);
    drawlist_push_clip(&list, (struct rect){40.0f, 40.0f, 60.0f, 50.0f});
    drawlist_line(&list, (const float[]){0.0f, 0.0f, 160.0f, 150.0f, 160.0f, 60.0f, 0.0f, 60.0f}, 4, 5.0f, WHITE);
    drawlist_convex(&list, (const float[]){70.0f, 20.0f, 140.0f, 60.0f, 70.0f, 120.0f}, 3, WHITE);
    drawlist_text(&list, 30.0f, 45.0f, FONT_LABEL_BOLD, THEME_TEXT_TITLE, WHITE, "clipped at four sides");
    drawlist_rect(&list, (struct rect){30.0f, 85.0f, 100.0f, 20.0f}, WHITE);
    show();
    double all = ink(0, 0, WIDTH, HEIGHT), inside = ink(40, 40, 100, 90);
    assert_true(inside > 500.0);
    assert_near(all, inside, 0.0);
}

TEST(test_text_is_where_layout_says)
{
    begin();
    drawlist_rect(&list, (struct rect){0.0f, 0.0f, WIDTH, HEIGHT}, BLACK);
    drawlist_text(&list, 50.0f, 100.0f, FONT_LABEL, THEME_TEXT_TITLE, WHITE, "HHHH");
    show();
    float width = font_width(FONT_LABEL, THEME_TEXT_TITLE, "HHHH"),
          cap = font_cap_height(FONT_LABEL, THEME_TEXT_TITLE);
    int x1 = 50 + (int)ceilf(width), top = 100 - (int)ceilf(cap);
    assert_true(ink(50, top, x1, 100) > 80.0);
    assert_near(ink(0, 0, WIDTH, HEIGHT), ink(49, top - 1, x1 + 1, 100), 0.0);
}

static uint64_t seed;

static float random_below(float limit)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (float)(seed >> 40) * 0x1p-24f * limit;
}

/// A thing of the frame: kind, place and colour; a frame is a few of them.
struct thing {
    int kind;
    float x, y, w, h;
    uint32_t color;
    bool is_clipped;
};

static struct thing random_thing(void)
{
    struct thing thing = {(int)random_below(6.0f),     random_below(WIDTH),         random_below(HEIGHT),
                          4.0f + random_below(150.0f), 4.0f + random_below(100.0f), 0,
                          random_below(1.0f) < 0.3f};
    thing.color = theme_fade(theme()->spline[(int)random_below(6.0f)], 0.3f + random_below(0.9f));
    return thing;
}

static void record(const struct thing *thing)
{
    struct rect r = {thing->x, thing->y, thing->w, thing->h}, before = list.clip;
    float xy[120];
    for (int i = 0; i < 60; i++) {
        xy[2 * i] = r.x + r.w * (float)i / 60.0f;
        xy[2 * i + 1] = r.y + r.h * (0.5f + 0.5f * sinf(0.01f * r.w * (float)i * (float)i));
    }
    if (thing->is_clipped) drawlist_push_clip(&list, rect_inset(r, 0.2f * fminf(r.w, r.h)));
    switch (thing->kind) {
    case 0:
        drawlist_rect(&list, r, thing->color);
        break;
    case 1:
        drawlist_line(&list, xy, 60, 0.5f + r.h / 30.0f, thing->color);
        break;
    case 2:
        drawlist_dashed(&list, xy, 60, 1.25f, 6.0f, 4.0f, thing->color);
        break;
    case 3:
        drawlist_rounded(&list, r, 6.0f, thing->color);
        break;
    case 4:
        drawlist_rounded_line(&list, r, 6.0f, 1.5f, thing->color);
        break;
    default:
        drawlist_text(&list, r.x, r.y, FONT_LABEL, THEME_TEXT_NORMAL, thing->color, "Ωverlapping, → text");
        break;
    }
    drawlist_set_clip(&list, before);
}

/// A stage that looks at its ground; `turn` moves the camera.
static struct stage_view some_stage(float turn)
{
    struct stage_view stage = {.viewport = {0.0f, 0.0f, 200.0f, 120.0f}, .eye = {0.0f, 0.0f, 4.0f}};
    for (int i = 0; i < 4; i++) stage.view[5 * i] = 1.0f;
    stage.view[12] = turn;
    stage.view[13] = -0.7f;
    stage.view[14] = -4.0f;
    stage.projection[0] = 2.0f;
    stage.projection[5] = 3.3f;
    stage.projection[10] = -1.01f;
    stage.projection[11] = -1.0f;
    stage.projection[14] = -0.2f;
    stage.colors = theme()->stage;
    stage.hash = (uint64_t)(1000.0f * turn) + 1;
    return stage;
}

// The promise of the damage grid, over frames in which things appear, vanish, move, and overlap each other and the stage.
TEST(test_partial_redraw_equals_full_redraw)
{
    enum { THINGS = 24, FRAMES = 120 };
    struct thing things[THINGS];
    struct stage_view stage = some_stage(0.0f);
    long partial = 0;
    seed = 20251121;
    for (int i = 0; i < THINGS; i++) things[i] = random_thing();
    for (int frame = 0; frame < FRAMES; frame++) {
        int changes = (int)random_below(3.0f);
        for (int i = 0; i < changes; i++) things[(int)random_below(THINGS)] = random_thing();
        if (random_below(1.0f) < 0.2f) stage = some_stage(random_below(1.0f));
        begin();
        for (int i = 0; i < THINGS; i++) record(&things[i]);
        struct draw_cost cost = show_on(&stage, frame > 0, pixels);
        partial += cost.pixels;
        // The picture on the screen stays, so the next frame starts from the full one, which must be the same.
        show_on(&stage, false, expected);
        if (memcmp(pixels, expected, sizeof pixels) != 0) fail_msg("frame %d differs", frame);
    }
    assert_true(partial < (long)FRAMES * WIDTH * HEIGHT * 3 / 4);
}

// While the stage is drawn smaller, what lies over it and beside it is as sharp as ever; afterwards every pixel is exact again.
TEST(test_only_the_stage_loses_resolution)
{
    static unsigned char reduced[sizeof pixels];
    struct stage_view stage = some_stage(0.0f);
    for (int pass = 0; pass < 3; pass++) {
        begin();
        drawlist_rect(&list, (struct rect){20.0f, 20.0f, 90.0f, 60.0f}, theme()->panel);
        drawlist_line(&list, (const float[]){30.0f, 70.0f, 100.0f, 40.0f}, 2, 2.5f, theme()->accent);
        drawlist_text(&list, 30.0f, 50.0f, FONT_LABEL, THEME_TEXT_NORMAL, theme()->text, "sharp");
        drawlist_text(&list, 210.0f, 60.0f, FONT_LABEL, THEME_TEXT_NORMAL, theme()->text, "beside it");
        stage_scale = pass == 1 ? 0.5f : 1.0f;
        show_on(&stage, pass > 0, pass == 0 ? expected : pass == 1 ? reduced : pixels);
    }
    assert_memory_equal(pixels, expected, sizeof pixels);
    int coarse = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        int x = i % WIDTH, y = i / WIDTH;
        bool bare_stage = x < 200 && y < 120 && (x < 20 || x >= 110 || y < 20 || y >= 80);
        bool same = memcmp(reduced + 4 * (size_t)i, expected + 4 * (size_t)i, 4) == 0;
        if (!bare_stage && !same) fail_msg("pixel %d, %d lost resolution", x, y);
        if (!same) coarse++;
    }
    assert_true(coarse > 1000);
}

static void record_panel(float playhead)
{
    begin();
    drawlist_rect(&list, (struct rect){0.0f, 120.0f, WIDTH, 120.0f}, theme()->panel);
    float xy[2 * WIDTH];
    for (int i = 0; i < WIDTH; i++) {
        xy[2 * i] = (float)i;
        xy[2 * i + 1] = 180.0f + 40.0f * sinf(0.05f * (float)i);
    }
    drawlist_line(&list, xy, WIDTH, 2.5f, theme()->accent);
    drawlist_rect(&list, (struct rect){playhead, 120.0f, 1.0f, 120.0f}, theme()->playhead);
}

/// Moves the playhead beside a stage; what that costs.
static struct draw_cost move_playhead(const struct stage_view *stage)
{
    record_panel(50.0f);
    show_on(stage, false, pixels);
    record_panel(50.0f);
    struct draw_cost cost = show_on(stage, true, pixels);
    assert_int_equal(cost.rectangles, 0);
    assert_int_equal(cost.pixels, 0);
    record_panel(200.0f);
    return show_on(stage, true, pixels);
}

TEST(test_moving_playhead_redraws_narrow_strips)
{
    struct stage_view stage = some_stage(0.0f);
    struct draw_cost cost = move_playhead(&stage);
    assert_int_equal(cost.rectangles, 2);
    assert_true(cost.pixels <= 2 * 16 * 128);
    assert_int_equal(at(200, 130), theme()->playhead >> 8);
    assert_int_equal(at(50, 130), theme()->panel >> 8);
}

TEST(test_a_stage_out_of_the_way_is_not_uploaded)
{
    struct stage_view stage = some_stage(0.0f);
    stage.viewport.h = 90.0f;
    long bytes = move_playhead(&stage).uploaded_bytes;
    stage.blob_count = 3; // shadows, which cost some bytes more
    assert_int_equal(move_playhead(&stage).uploaded_bytes, bytes);
}

// More than a buffer holds at once, in one line: drawn in several goes, its last point as well as its first.
TEST(test_very_long_line_is_drawn_whole)
{
    enum { COUNT = 120000 };
    float *xy = calloc(2 * COUNT, sizeof *xy);
    assert_non_null(xy);
    for (int i = 0; i < COUNT; i++) {
        xy[2 * i] = 10.0f + 300.0f * (float)i / COUNT;
        xy[2 * i + 1] = i % 2 ? 100.0f : 140.0f;
    }
    begin();
    drawlist_rect(&list, (struct rect){0.0f, 0.0f, WIDTH, HEIGHT}, BLACK);
    drawlist_line(&list, xy, COUNT, 1.0f, WHITE);
    free(xy);
    show();
    assert_false(list.overflow);
    for (int x = 11; x < 309; x++) assert_near(coverage(x, 120), 1.0, 0.01);
}

TEST(test_reference_frame_does_not_depend_on_the_scene)
{
    begin();
    assert_true(draw_reference_ms(draw, WIDTH, HEIGHT, 1.0f, 3) > 0.0);
    draw_read(WIDTH, HEIGHT, expected);
    record_panel(10.0f);
    show();
    assert_true(draw_reference_ms(draw, WIDTH, HEIGHT, 1.0f, 3) > 0.0);
    draw_read(WIDTH, HEIGHT, pixels);
    assert_memory_equal(pixels, expected, sizeof pixels);
}

TEST(test_gpu_times_come_back_with_their_frames)
{
    begin();
    struct gpu_timer timer;
    long frame = 0;
    gpu_timer_create(&timer, false); // software renderers have the queries, too; only their numbers mislead
    if (!timer.usable) skip();
    for (long n = 7; n < 14; n += 2) {
        gpu_timer_begin(&timer, n);
        glClear(GL_COLOR_BUFFER_BIT);
        gpu_timer_end(&timer);
    }
    gpu_timer_begin(&timer, 99); // all queries are out: this frame is not timed
    gpu_timer_end(&timer);
    glFinish();
    for (long n = 7; n < 14; n += 2) {
        assert_true(gpu_timer_take(&timer, &frame) >= 0);
        assert_int_equal(frame, n);
    }
    assert_true(gpu_timer_take(&timer, &frame) < 0);
    gpu_timer_destroy(&timer);
}

/// Points in turn on an upper edge that rises and a lower one that jumps: everything between is covered once, and nothing beyond.
TEST(test_band_covers_what_its_line_swings_through)
{
    static const uint32_t half = 0xFFFFFF80u;
    float xy[201][2];
    begin();
    for (int i = 0; i <= 200; i++) {
        xy[i][0] = (float)(60 + i);
        xy[i][1] = i % 2 ? (i < 100 ? 150.0f : 200.0f) : 120.0f - 0.25f * (float)i;
    }
    drawlist_rect(&list, (struct rect){0.0f, 0.0f, WIDTH, HEIGHT}, BLACK);
    drawlist_band(&list, &xy[0][0], 201, 4.0f, half);
    show();
    const double whole = 128 / 255.0;
    for (int x = 62; x < 256; x++) {
        const double top = 118.0 - 0.25 * (x + 0.5 - 60);
        for (int y = 0; y < HEIGHT; y++) {
            const double bottom = x < 156 ? 152 : x > 164 ? 202 : y;
            const double inside = fmin(y + 0.5 - top, bottom - (y + 0.5));
            if (inside > 1.5) assert_near(coverage(x, y), whole, 0.01);
            if (inside < -1.5) assert_near(coverage(x, y), 0, 0.01);
        }
        const int edge = (int)floor(top);
        assert_true(coverage(x, edge) > 0.01 * whole || coverage(x, edge + 1) < 0.99 * whole); // no stair
    }
    assert_near(coverage(50, 100), 0, 0.01);
    assert_near(coverage(270, 100), 0, 0.01);
}

TESTS_BETWEEN(set_up, tear_down)
