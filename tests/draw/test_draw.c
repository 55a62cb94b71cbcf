/// Pixels, offscreen: what a person would see of rectangles, lines, clips and text; and that redrawing only what changed gives the same picture
/// as redrawing all, of made frames and of every scene. All that without a complaint of OpenGL. Skipped where there is no EGL.
#include "blind.h"
#include "questions.h"

#include "draw/draw.h"
#include "draw/gl.h"
#include "temporary.h"
#include "ui/theme.h"
#include <dirent.h>

enum { WIDTH = 320, HEIGHT = 240, APP_WIDTH = 480, APP_HEIGHT = 360 };
static const uint32_t WHITE = 0xFFFFFFFFu, BLACK = 0x000000FFu, HALF = 0xFFFFFF80u;

static struct platform *platform;
static struct draw *draw;
static struct drawlist list;
static float stage_scale = 1;
static unsigned char pixels[WIDTH * HEIGHT * 4], expected[WIDTH * HEIGHT * 4];

static int set_up(void **state)
{
    struct error error;
    (void)state;
    platform_debug_gl();
    platform = platform_offscreen(APP_WIDTH, APP_HEIGHT, 1, &error);
    if (!platform) {
        print_message("skip - %s\n", error.text);
        return 0;
    }
    font_init();
    draw = draw_create(1, &error);
    drawlist_create(&list, 1024, 300000, 4096);
    if (!draw) print_error("%s\n", error.text);
    return draw ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    drawlist_destroy(&list);
    draw_destroy(draw);
    platform_destroy(platform);
    return 0;
}

#define RECT(x, y, w, h, color) drawlist_rect(&list, (struct rect){x, y, w, h}, color)
#define LINE(width, color, ...)                                                                                      \
    drawlist_line(&list, (const float[]){__VA_ARGS__}, sizeof((const float[]){__VA_ARGS__}) / 8, width, color)
#define CONVEX(color, ...)                                                                                           \
    drawlist_convex(&list, (const float[]){__VA_ARGS__}, sizeof((const float[]){__VA_ARGS__}) / 8, color)

static void begin(void)
{
    if (!platform) skip();
    drawlist_clear(&list, (struct rect){0, 0, WIDTH, HEIGHT});
}

static void begin_black(void)
{
    begin();
    RECT(0, 0, WIDTH, HEIGHT, BLACK);
}

/// Draws `list` and the stage and reads the picture.
static struct draw_cost show_on(const struct stage_view *stage, bool keeps, unsigned char *out)
{
    struct draw_input input = {WIDTH, HEIGHT, 1, keeps, &list, stage, 0, stage_scale};
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

/// Sum of coverage over a rectangle of pixels.
static double ink(int x0, int y0, int x1, int y1)
{
    double sum = 0;
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++) sum += coverage(x, y);
    return sum;
}

/// White things on black: the ink of each, and how much of some pixels is covered.
TEST(shapes_cover_their_area)
{
    static const struct {
        const char *what;
        int x0, y0, x1, y1;
        double ink, tolerance;
    } areas[] = {
        {"a rectangle", 95, 45, 125, 65, 205, 0.5},
        {"a line", 10, 25, 70, 35, 40, 0.05},
        {"a closed line", 0, 70, 90, 130, 2 * 2 * (40 + 30) - 16, 1},
        {"a square on its corner", 140, 30, 190, 80, 450, 9},
        {"a rectangle with round ends", 195, 30, 270, 80, 60 * 20 - (4 - M_PI) * 100, 12},
        {"a line that ends between pixels", 18, 140, 63, 141, 40, 0.05},
        {"one of three points", 18, 150, 63, 151, 40, 0.05},
        {"one far to the right", 218, 140, 263, 141, 40, 0.05},
        {"one of three points there", 218, 150, 263, 151, 40, 0.05},
    };
    static const struct {
        int x, y;
        double covered, tolerance;
    } places[] = {
        {100, 55, 0.75, 0.01},  {110, 50, 0.5, 0.01},                                               // the rectangle
        {19, 30, 0, 0},         {60, 30, 0, 0},         {40, 29, 0, 0},         {40, 31, 0, 0},     // beside the line
        {20, 30, 1, 0.01},      {40, 30, 1, 0.01},      {59, 30, 1, 0.01},                          // on it
        {20, 80, 1, 0.01},      {59, 80, 1, 0.01},      {20, 109, 1, 0.01},     {59, 109, 1, 0.01}, // corners
        {160, 55, 1, 0},        {20, 140, 0.75, 0.03},  {60, 140, 0.25, 0.03},  {20, 150, 0.75, 0.03},  // shares of
        {60, 150, 0.25, 0.03},  {220, 140, 0.75, 0.03}, {260, 140, 0.25, 0.03}, {220, 150, 0.75, 0.03}, // the last
        {260, 150, 0.25, 0.03},                                                                         // pixel
    };
    begin_black();
    RECT(100.25f, 50.5f, 20.5f, 10, WHITE);
    LINE(1, WHITE, 20, 30.5f, 60, 30.5f);
    drawlist_dashed(&list, (const float[]){20, 40.5f, 60, 40.5f}, 2, 1, 6, 4, WHITE);
    drawlist_rounded_line(&list, (struct rect){20, 80, 40, 30}, 0, 2, WHITE);
    CONVEX(WHITE, 160, 40, 175, 55, 160, 70, 145, 55);
    drawlist_rounded(&list, (struct rect){200, 40, 60, 20}, 10, WHITE);
    for (float x = 20.25f; x < 230; x += 200) { // wherever on the screen
        LINE(1, WHITE, x, 140.5f, x + 40, 140.5f);
        LINE(1, WHITE, x, 150.5f, x + 15, 150.5f, x + 40, 150.5f);
    }
    show();
    for (size_t i = 0; i < sizeof areas / sizeof *areas; i++) {
        const double found = ink(areas[i].x0, areas[i].y0, areas[i].x1, areas[i].y1);
        if (!(fabs(found - areas[i].ink) <= areas[i].tolerance)) fail_msg("%s: %g of ink", areas[i].what, found);
    }
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const double covered = coverage(places[i].x, places[i].y);
        if (!(fabs(covered - places[i].covered) <= places[i].tolerance))
            fail_msg("%g of pixel %d, %d", covered, places[i].x, places[i].y);
    }
    for (int x = 20; x < 60; x++) assert_near(coverage(x, 40), (x - 20) % 10 < 6 ? 1 : 0, 0.01); // dashes
}

TEST(later_commands_cover_earlier_ones)
{
    begin();
    RECT(0, 0, 200, 200, theme()->accent); // large enough to be a fill
    RECT(20, 20, 10, 10, WHITE);
    RECT(10, 10, 100, 100, BLACK); // and a fill over triangles
    RECT(30, 30, 10, 10, HALF);
    RECT(210, 20, 30, 40, theme()->accent);
    show();
    const struct {
        int x, y;
        uint32_t color;
    } rows[] = {
        {5, 5, theme()->accent},    {25, 25, BLACK},           {250, 5, theme()->panel},  {210, 20, theme()->accent},
        {239, 59, theme()->accent}, {209, 20, theme()->panel}, {240, 20, theme()->panel}, {210, 19, theme()->panel},
        {210, 60, theme()->panel}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (at(rows[i].x, rows[i].y) != rows[i].color >> 8) fail_msg("pixel %d, %d", rows[i].x, rows[i].y);
    assert_near(coverage(35, 35), 128 / 255.0, 0.005);
}

/// A line of width w crosses each pixel column with w / cos(slope) of ink, whatever its slope and thin ones included.
TEST(line_has_its_width_at_every_slope)
{
    const float widths[] = {0.5f, 1, 1.25f, 2.5f, 6}, slopes[] = {0, 0.1f, 0.5f, 1};
    for (int i = 0; i < 20; i++) {
        float width = widths[i % 5], slope = slopes[i / 5];
        begin_black();
        LINE(width, WHITE, 10, 20.3f, 150, 20.3f + 140 * slope);
        show();
        assert_near(ink(30, 0, 130, HEIGHT) / 100, width * hypotf(1, slope), 0.03 * width + 0.02);
    }
}

/// Where the quads of a translucent curve overlapped, it would be brighter; where they gaped, darker.
TEST(translucent_curve_has_no_seams)
{
    float xy[300][2];
    for (int i = 0; i < 300; i++) xy[i][0] = 10 + (float)i, xy[i][1] = 120 + 60 * sinf(0.05f * (float)i);
    begin_black();
    drawlist_line(&list, &xy[0][0], 300, 4, HALF);
    show();
    double brightest = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) brightest = fmax(brightest, pixels[4 * i] / 255.0);
    assert_near(brightest, 128 / 255.0, 0.005);
    for (int i = 5; i < 295; i++) assert_near(coverage((int)xy[i][0], (int)floorf(xy[i][1])), 128 / 255.0, 0.01);
}

TEST(nothing_shows_outside_its_clip)
{
    begin_black();
    drawlist_push_clip(&list, (struct rect){40, 40, 60, 50});
    LINE(5, WHITE, 0, 0, 160, 150, 160, 60, 0, 60);
    CONVEX(WHITE, 70, 20, 140, 60, 70, 120);
    drawlist_text(&list, 30, 45, FONT_LABEL_BOLD, THEME_TEXT_TITLE, WHITE, "clipped at four sides");
    RECT(30, 85, 100, 20, WHITE);
    show();
    assert_true(ink(40, 40, 100, 90) > 500);
    assert_near(ink(0, 0, WIDTH, HEIGHT), ink(40, 40, 100, 90), 0);
}

TEST(text_is_where_layout_says)
{
    begin_black();
    drawlist_text(&list, 50, 100, FONT_LABEL, THEME_TEXT_TITLE, WHITE, "HHHH");
    show();
    const int x1 = 50 + (int)ceilf(font_width(FONT_LABEL, THEME_TEXT_TITLE, "HHHH")),
              top = 100 - (int)ceilf(font_cap_height(FONT_LABEL, THEME_TEXT_TITLE));
    assert_true(ink(50, top, x1, 100) > 80);
    assert_near(ink(0, 0, WIDTH, HEIGHT), ink(49, top - 1, x1 + 1, 100), 0);
}

/// Points in turn on an upper edge that rises and a lower one that jumps: everything between is covered once, and nothing beyond.
TEST(band_covers_what_its_line_swings_through)
{
    const double whole = 128 / 255.0;
    float xy[201][2];
    begin_black();
    for (int i = 0; i <= 200; i++) {
        xy[i][0] = (float)(60 + i);
        xy[i][1] = i % 2 ? (i < 100 ? 150 : 200) : 120 - 0.25f * (float)i;
    }
    drawlist_band(&list, &xy[0][0], 201, 4, HALF);
    show();
    for (int x = 62; x < 256; x++) {
        const double top = 118 - 0.25 * (x + 0.5 - 60);
        for (int y = 0; y < HEIGHT; y++) {
            const double bottom = x < 156 ? 152 : x > 164 ? 202 : y;
            const double inside = fmin(y + 0.5 - top, bottom - (y + 0.5));
            if (fabs(inside) > 1.5) assert_near(coverage(x, y), inside > 0 ? whole : 0, 0.01);
        }
        const int edge = (int)floor(top);
        assert_true(coverage(x, edge) > 0.01 * whole || coverage(x, edge + 1) < 0.99 * whole); // no stair
    }
    assert_near(coverage(50, 100), 0, 0.01);
    assert_near(coverage(270, 100), 0, 0.01);
}

/// More than a buffer holds at once, in one line: drawn in several goes, its last point as well as its first.
TEST(very_long_line_is_drawn_whole)
{
    enum { COUNT = 120000 };
    static float xy[COUNT][2];
    for (int i = 0; i < COUNT; i++) xy[i][0] = 10 + 300 * (float)i / COUNT, xy[i][1] = i % 2 ? 100 : 140;
    begin_black();
    drawlist_line(&list, &xy[0][0], COUNT, 1, WHITE);
    show();
    assert_false(list.overflow);
    for (int x = 11; x < 309; x++) assert_near(coverage(x, 120), 1, 0.01);
}

// --- redrawing in part

static uint64_t seed;

static float random_below(float limit)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (float)(seed >> 40) * 0x1p-24f * limit;
}

/// A thing of the frame: kind, place and colour; a frame is a few of them.
struct mark {
    int kind;
    struct rect place;
    uint32_t color;
    bool is_clipped;
};

static struct mark random_mark(void)
{
    struct mark thing = {.kind = (int)random_below(6)};
    thing.place = (struct rect){random_below(WIDTH), random_below(HEIGHT), 0, 0};
    thing.place.w = 4 + random_below(150);
    thing.place.h = 4 + random_below(100);
    thing.is_clipped = random_below(1) < 0.3f;
    thing.color = theme_fade(theme()->spline[(int)random_below(6)], 0.3f + random_below(0.9f));
    return thing;
}

static void record(const struct mark *thing)
{
    const struct rect r = thing->place, before = list.clip;
    const uint32_t color = thing->color;
    float xy[120];
    for (int i = 0; i < 60; i++) {
        xy[2 * i] = r.x + r.w * (float)i / 60;
        xy[2 * i + 1] = r.y + r.h * (0.5f + 0.5f * sinf(0.01f * r.w * (float)i * (float)i));
    }
    if (thing->is_clipped) drawlist_push_clip(&list, rect_inset(r, 0.2f * fminf(r.w, r.h)));
    if (thing->kind == 0) drawlist_rect(&list, r, color);
    if (thing->kind == 1) drawlist_line(&list, xy, 60, 0.5f + r.h / 30, color);
    if (thing->kind == 2) drawlist_dashed(&list, xy, 60, 1.25f, 6, 4, color);
    if (thing->kind == 3) drawlist_rounded(&list, r, 6, color);
    if (thing->kind == 4) drawlist_rounded_line(&list, r, 6, 1.5f, color);
    if (thing->kind == 5) drawlist_text(&list, r.x, r.y, FONT_LABEL, THEME_TEXT_NORMAL, color, "Ωverlapping, → text");
    drawlist_set_clip(&list, before);
}

/// A stage that looks at its ground; `turn` moves the camera.
static struct stage_view some_stage(float turn)
{
    return (struct stage_view){.viewport = {0, 0, 200, 120},
                               .eye = {0, 0, 4},
                               .view = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, turn, -0.7f, -4, 1},
                               .projection = {2, 0, 0, 0, 0, 3.3f, 0, 0, 0, 0, -1.01f, -1, 0, 0, -0.2f, 0},
                               .colors = theme()->stage,
                               .hash = (uint64_t)(1000 * turn) + 1};
}

/// The promise of the damage grid, over frames in which things appear, vanish, move, and overlap each other and the stage.
TEST(partial_redraw_equals_full_redraw)
{
    enum { THINGS = 24, FRAMES = 120 };
    struct mark things[THINGS];
    struct stage_view stage = some_stage(0);
    long partial = 0;
    seed = 20251121;
    for (int i = 0; i < THINGS; i++) things[i] = random_mark();
    for (int frame = 0; frame < FRAMES; frame++) {
        for (int changes = (int)random_below(3); changes > 0; changes--)
            things[(int)random_below(THINGS)] = random_mark();
        if (random_below(1) < 0.2f) stage = some_stage(random_below(1));
        begin();
        for (int i = 0; i < THINGS; i++) record(&things[i]);
        partial += show_on(&stage, frame > 0, pixels).pixels;
        // The picture on the screen stays, so the next frame starts from the full one, which must be the same.
        show_on(&stage, false, expected);
        if (memcmp(pixels, expected, sizeof pixels) != 0) fail_msg("frame %d differs", frame);
    }
    assert_true(partial < (long)FRAMES * WIDTH * HEIGHT * 3 / 4);
}

/// While the stage is drawn smaller, what lies over it and beside it is as sharp as ever; afterwards every pixel is exact again.
TEST(only_the_stage_loses_resolution)
{
    static unsigned char reduced[sizeof pixels];
    struct stage_view stage = some_stage(0);
    for (int pass = 0; pass < 3; pass++) {
        begin();
        RECT(20, 20, 90, 60, theme()->panel);
        LINE(2.5f, theme()->accent, 30, 70, 100, 40);
        drawlist_text(&list, 30, 50, FONT_LABEL, THEME_TEXT_NORMAL, theme()->text, "sharp");
        drawlist_text(&list, 210, 60, FONT_LABEL, THEME_TEXT_NORMAL, theme()->text, "beside it");
        stage_scale = pass == 1 ? 0.5f : 1;
        show_on(&stage, pass > 0, pass == 0 ? expected : pass == 1 ? reduced : pixels);
    }
    assert_memory_equal(pixels, expected, sizeof pixels);
    int coarse = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int x = i % WIDTH, y = i / WIDTH;
        const bool is_bare = x < 200 && y < 120 && (x < 20 || x >= 110 || y < 20 || y >= 80);
        if (memcmp(reduced + 4 * (size_t)i, expected + 4 * (size_t)i, 4) == 0) continue;
        if (!is_bare) fail_msg("pixel %d, %d lost resolution", x, y);
        coarse++;
    }
    assert_true(coarse > 1000);
}

static void record_panel(float playhead)
{
    float xy[WIDTH][2];
    begin();
    RECT(0, 120, WIDTH, 120, theme()->panel);
    for (int i = 0; i < WIDTH; i++) xy[i][0] = (float)i, xy[i][1] = 180 + 40 * sinf(0.05f * (float)i);
    drawlist_line(&list, &xy[0][0], WIDTH, 2.5f, theme()->accent);
    RECT(playhead, 120, 1, 120, theme()->playhead);
}

/// Moves the playhead beside a stage; what that costs.
static struct draw_cost move_playhead(const struct stage_view *stage)
{
    record_panel(50);
    show_on(stage, false, pixels);
    record_panel(50);
    struct draw_cost cost = show_on(stage, true, pixels);
    assert_int_equal(cost.rectangles, 0);
    assert_int_equal(cost.pixels, 0);
    record_panel(200);
    return show_on(stage, true, pixels);
}

/// Narrow strips are redrawn; and a stage out of the way is not uploaded.
TEST(moving_playhead_costs_little)
{
    struct stage_view stage = some_stage(0);
    struct draw_cost cost = move_playhead(&stage);
    assert_int_equal(cost.rectangles, 2);
    assert_true(cost.pixels <= 2 * 16 * 128);
    assert_int_equal(at(200, 130), theme()->playhead >> 8);
    assert_int_equal(at(50, 130), theme()->panel >> 8);
    stage.viewport.h = 90;
    long bytes = move_playhead(&stage).uploaded_bytes;
    stage.blob_count = 3; // shadows, which cost some bytes more
    assert_int_equal(move_playhead(&stage).uploaded_bytes, bytes);
}

TEST(gpu_times_come_back_with_their_frames)
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

// --- redrawing a scene's stage in part

/// Plays a scene, from some time on with onion skins: every frame is the picture that drawing all of it gives.
static void compare_frames(const char *scene)
{
    static unsigned char partial[APP_WIDTH * APP_HEIGHT * 4], whole[sizeof partial];
    struct blind blind;
    if (!platform) skip();
    blind_open(&blind, scene);
    struct app *app = &blind.app;
    struct platform *const without = app->platform;
    app->platform = platform;
    app->draw = draw;
    app_resize(app, APP_WIDTH, APP_HEIGHT, 1);
    for (int frame = 0; frame < quick_or_all(5, 45); frame++) {
        if (frame == quick_or_all(2, 5))
            blind_send(&blind, (struct event){.kind = EVENT_KEY, .key = 'O', .action = ACTION_PRESS});
        blind_frame(&blind);
        if (frame % quick_or_all(4, 9)) continue;
        draw_read(APP_WIDTH, APP_HEIGHT, partial);
        const struct draw_input input = {.width = APP_WIDTH,
                                         .height = APP_HEIGHT,
                                         .scale = 1,
                                         .list = drawn_by(app->work.editor),
                                         .stage = editor_stage(app->work.editor)};
        struct draw_cost cost;
        draw_frame(app->draw, &input, &cost);
        draw_read(APP_WIDTH, APP_HEIGHT, whole);
        if (memcmp(partial, whole, sizeof whole) != 0) fail_msg("%s: frame %d differs", scene, frame);
    }
    app->platform = without;
    app->draw = NULL;
    blind_close(&blind);
}

TEST(each_scene)
{
    DIR *folder = opendir("assets/scenes");
    assert_non_null(folder);
    int count = 0;
    for (struct dirent *entry; (entry = readdir(folder));) {
        char path[300];
        if (!strstr(entry->d_name, ".json")) continue;
        snprintf(path, sizeof path, "assets/scenes/%s", entry->d_name);
        compare_frames(path);
        count++;
    }
    closedir(folder);
    assert_true(count > 8);
}

/// Few joints bend the most: the skin between them is farthest from where they are.
TEST(tails_of_few_joints)
{
    static const char text[] = "{\"wiggly\": 1, \"frames\": [0, 60], \"loop\": true, \"splines\": [{\"name\": \"s\", "
                               "\"frequency\": 1, \"knots\": [{\"frame\": 0, \"value\": 3}, {\"frame\": 30, "
                               "\"value\": -3}]}], \"tails\": [{\"name\": \"t\", \"joints\": %d, \"channels\": "
                               "[{\"spline\": \"s\", \"axis\": \"side\", \"gain\": 50, \"lag\": 9}]}]}";
    for (int joints = 1; joints <= 5; joints++) {
        char scene[700];
        int length = snprintf(scene, sizeof scene, text, joints);
        compare_frames(temporary_file("extent.json", scene, (size_t)length));
    }
}

// --- what --gl-debug counts

/// All of the above is without a complaint; wrong calls are complaints, of which each is said once.
TEST(wrong_calls_are_counted)
{
    begin();
    glClear(GL_COLOR_BUFFER_BIT);
    assert_int_equal(platform_gl_complaints(), 0);
    FILE *said = tmpfile();
    const int before = dup(STDERR_FILENO);
    assert_non_null(said);
    dup2(fileno(said), STDERR_FILENO);
    for (int i = 1; i <= 3; i++) {
        glEnable(0xDEAD);
        assert_int_equal(platform_gl_complaints(), i);
    }
    dup2(before, STDERR_FILENO);
    close(before);
    char line[512];
    rewind(said);
    assert_non_null(fgets(line, sizeof line, said));
    assert_non_null(strstr(line, "OpenGL, error"));
    assert_null(fgets(line, sizeof line, said)); // the same thing is said once
    fclose(said);
}

TESTS_BETWEEN(set_up, tear_down)
