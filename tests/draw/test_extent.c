/// Of the stage only what moves is drawn again: every frame of every scene is the picture that drawing all of it gives.
#include "blind.h"
#include "questions.h"

#include "draw/draw.h"
#include "temporary.h"
#include <dirent.h>

enum { WIDTH = 480, HEIGHT = 360 };
static unsigned char partial[WIDTH * HEIGHT * 4], whole[WIDTH * HEIGHT * 4];

static struct platform *platform; ///< one for all scenes, as the app has; NULL: there is none here
static struct draw *renderer;

static int open_picture(void **state)
{
    struct error error = {0};
    (void)state;
    font_init();
    platform = platform_offscreen(WIDTH, HEIGHT, 1, &error);
    renderer = platform ? draw_create(1, &error) : NULL;
    if (!renderer) print_message("skip - %s\n", error.text);
    return 0;
}

static int close_picture(void **state)
{
    (void)state;
    draw_destroy(renderer);
    platform_destroy(platform);
    return 0;
}

static void draw_whole(struct app *app)
{
    struct draw_cost cost;
    const struct draw_input input = {.width = WIDTH,
                                     .height = HEIGHT,
                                     .scale = 1,
                                     .list = drawn_by(app->work.editor),
                                     .stage = editor_stage(app->work.editor)};
    draw_frame(app->draw, &input, &cost);
    draw_read(WIDTH, HEIGHT, whole);
}

/// Plays a scene, from some time on with onion skins.
static void compare_frames(const char *scene)
{
    if (!renderer) skip();
    struct blind blind;
    blind_open(&blind, scene);
    struct app *app = &blind.app;
    struct platform *const without = app->platform;
    app->platform = platform;
    app->draw = renderer;
    app_resize(app, WIDTH, HEIGHT, 1);
    const int stride = quick_or_all(4, 9);
    for (int frame = 0; frame < quick_or_all(5, 45); frame++) {
        if (frame == quick_or_all(2, 5))
            blind_send(&blind, (struct event){.kind = EVENT_KEY, .key = 'O', .action = ACTION_PRESS});
        blind_frame(&blind);
        if (frame % stride) continue;
        draw_read(WIDTH, HEIGHT, partial);
        draw_whole(app);
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

TESTS_BETWEEN(open_picture, close_picture)
