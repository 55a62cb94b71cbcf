/// Widgets, driven by events as a person would: what is dragged, typed and chosen, and where the keyboard goes.
#include "near.h"
#include "ui/font.h"
#include "ui/theme.h"
#include "ui/widgets.h"

/// A panel with one of everything.
struct panel {
    struct ui ui;
    struct ui_list list;
    struct rect area;
    double speed, offset, before;
    bool on, pressed;
    int choice, rows;                        ///< rows: more buttons, to make the panel too long
    enum ui_change change;                   ///< of speed, in the last event
    int sets, drags, drops, cancels, nudges; ///< counted over all numbers
};

static const struct ui_number speed_number = {.name = "speed",
                                              .label = "speed",
                                              .unit = "Hz",
                                              .minimum = 0,
                                              .maximum = 12,
                                              .lowest = 0,
                                              .highest = 1e300,
                                              .fallback = 1,
                                              .step = 0.05,
                                              .decimals = 2};
static const struct ui_number offset_number = {
    .name = "offset", .label = "offset", .lowest = -5, .highest = 5, .fallback = NAN, .step = 0.01, .decimals = 2};
static const struct ui_choice choices[] = {{"a", "First"}, {"b", "Second"}, {"c", "Third"}};

static void count(struct panel *p, enum ui_change change)
{
    p->drags += change == UI_DRAG;
    p->drops += change == UI_DROP;
    p->cancels += change == UI_CANCEL;
    p->sets += change == UI_SET;
    p->nudges += change == UI_NUDGE;
}

static void build(struct panel *p)
{
    struct ui *ui = &p->ui;
    ui_list_begin(ui, &p->list, p->area);
    p->change = ui_value(ui, ui_row(ui, UI_ROW), &speed_number, &p->speed);
    count(p, p->change);
    count(p, ui_value(ui, ui_row(ui, UI_ROW), &offset_number, &p->offset));
    ui_segments(ui, ui_row(ui, UI_ROW), "kind", choices, 3, &p->choice);
    ui_toggle(ui, ui_row(ui, UI_ROW), "on", &p->on);
    if (ui_button(ui, ui_row(ui, UI_ROW), "go", "Go", true)) p->pressed = true;
    for (int i = 0; i < p->rows; i++) {
        char name[16];
        snprintf(name, sizeof name, "row.%d", i);
        ui_list_row(ui, ui_row(ui, UI_ROW), name, name, 0, false);
    }
    ui_list_end(ui);
}

static struct panel make_panel(void)
{
    return (struct panel){.area = {1000, 0, 280, 200}, .speed = 1, .offset = 0.5};
}

static bool send(struct panel *p, struct event event)
{
    ui_begin_event(&p->ui, p->area, &event);
    build(p);
    return ui_end(&p->ui);
}

static bool key(struct panel *p, int code, unsigned mods)
{
    return send(p, (struct event){.kind = EVENT_KEY, .key = code, .action = ACTION_PRESS, .mods = mods});
}

static void type(struct panel *p, const char *text)
{
    while (*text) send(p, (struct event){.kind = EVENT_TEXT, .codepoint = utf8_next(&text)});
}

static bool button(struct panel *p, enum event_button which, enum event_action action, int clicks, float x, float y)
{
    return send(
        p, (struct event){.kind = EVENT_BUTTON, .button = which, .action = action, .clicks = clicks, .x = x, .y = y});
}

static void move(struct panel *p, float x, float y, unsigned mods)
{
    send(p, (struct event){.kind = EVENT_POINTER, .x = x, .y = y, .mods = mods});
}

static void find(struct panel *p, const char *name, const double *value, float *x, float *y)
{
    ui_begin_find(&p->ui, p->area, name, value);
    build(p);
    assert_true(ui_end(&p->ui));
    *x = p->ui.found_x;
    *y = p->ui.found_y;
}

static void click(struct panel *p, const char *name, int clicks)
{
    float x, y;
    find(p, name, NULL, &x, &y);
    button(p, BUTTON_LEFT, ACTION_PRESS, clicks, x, y);
    button(p, BUTTON_LEFT, ACTION_RELEASE, clicks, x, y);
}

/// Press at the handle, drag to where the bar shows `value`, keep holding.
static void drag_to(struct panel *p, double value)
{
    float x, y;
    find(p, "speed", NULL, &x, &y);
    button(p, BUTTON_LEFT, ACTION_PRESS, 1, x, y);
    find(p, "speed", &value, &x, &y);
    move(p, x, y, 0);
}

static void release(struct panel *p) { button(p, BUTTON_LEFT, ACTION_RELEASE, 1, p->ui.pointer_x, p->ui.pointer_y); }

TEST(test_slider_reaches_both_ends)
{
    struct panel p = make_panel();
    drag_to(&p, 12);
    assert_near(p.speed, 12, 0);
    move(&p, 5000, -300, 0); // far outside the panel the drag goes on, and the bar ends
    assert_near(p.speed, 12, 0);
    move(&p, -5000, 900, 0);
    assert_near(p.speed, 0, 0);
    release(&p);
    drag_to(&p, 12);
    drag_to(&p, 0);
    assert_near(p.speed, 0, 0);
    release(&p);
    drag_to(&p, 2.5);
    assert_near(p.speed, 2.5, 0); // a replay's target is met, and what is saved is the short number
    release(&p);
}

TEST(test_drag_is_many_changes_and_one_drop)
{
    struct panel p = make_panel();
    drag_to(&p, 3);
    move(&p, p.ui.pointer_x + 20, 0, 0);
    release(&p);
    assert_int_equal(p.drags, 2);
    assert_int_equal(p.drops, 1);
    assert_int_equal(p.sets + p.nudges + p.cancels, 0);
    click(&p, "speed", 1); // a click alone changes nothing
    assert_int_equal(p.drags, 2);
    assert_int_equal(p.drops, 1);
    drag_to(&p, 5);
    assert_true(key(&p, KEY_ESCAPE, 0));
    assert_int_equal(p.cancels, 1);
    release(&p);
    assert_int_equal(p.drops, 1);
    assert_int_equal(p.ui.held, 0);
}

TEST(test_shift_drags_a_tenth)
{
    struct panel p = make_panel();
    drag_to(&p, 6);
    float x = p.ui.pointer_x, y = p.ui.pointer_y;
    move(&p, x, y, MOD_SHIFT);
    move(&p, x + 40, y, MOD_SHIFT);
    double fine = p.speed - 6;
    move(&p, x, y, 0); // the coarse mapping starts where the pointer is
    move(&p, x + 40, y, 0);
    double coarse = p.speed - 6;
    assert_true(fine > 0);
    assert_near(fine, coarse / 10, 0.011);
}

TEST(test_typing_takes_numbers_with_unit)
{
    static const struct {
        const char *text;
        double value;
    } good[] = {{"2.5", 2.5}, {" 3 ", 3}, {"4 Hz", 4}, {"5Hz", 5}, {"1e1", 10}, {"20", 20}, {".5", 0.5}, {"0", 0}};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        struct panel p = make_panel();
        p.speed = 7;
        click(&p, "speed", 2);
        assert_true(p.ui.typing != 0);
        type(&p, good[i].text);
        key(&p, KEY_ENTER, 0);
        assert_near(p.speed, good[i].value, 0);
        assert_int_equal(p.sets, 1);
        assert_int_equal(p.ui.typing, 0);
        assert_int_equal(p.ui.focus, 0); // a double-click leaves no focus behind
    }
}

TEST(test_nonsense_says_why_and_keeps_the_value)
{
    static const char *const bad[] = {"abc",   "",    "1.2.3", "0x10", "nan",    "inf",
                                      "1e999", "3 m", "-1",    "--2",  "2 Hz Hz"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct panel p = make_panel();
        click(&p, "speed", 2);
        key(&p, KEY_BACKSPACE, 0);
        type(&p, bad[i]);
        key(&p, KEY_ENTER, 0);
        assert_near(p.speed, 1, 0);
        assert_int_equal(p.sets, 0);
        assert_non_null(strstr(p.ui.complaint, "speed: expected"));
        assert_true(p.ui.typing != 0); // to be put right
        key(&p, KEY_ESCAPE, 0);
        assert_int_equal(p.ui.typing, 0);
        assert_near(p.speed, 1, 0);
    }
}

TEST(test_press_elsewhere_takes_what_was_typed)
{
    struct panel p = make_panel();
    click(&p, "offset", 2);
    type(&p, "2");
    click(&p, "go", 1); // built after the field
    assert_near(p.offset, 2, 0);
    assert_true(p.pressed);
    click(&p, "offset", 2);
    type(&p, "3");
    click(&p, "speed", 1); // built before it, so it uses the press first
    assert_near(p.offset, 3, 0);
    assert_int_equal(p.ui.typing, 0);
    click(&p, "offset", 2);
    type(&p, "4");
    assert_false(button(&p, BUTTON_LEFT, ACTION_PRESS, 1, 10, 10)); // and outside of the panel it stays to be used
    assert_near(p.offset, 4, 0);
}

TEST(test_tab_moves_the_focus_round)
{
    static const char *const order[] = {"speed", "offset", "kind", "on", "go", "speed"};
    struct panel p = make_panel();
    for (size_t i = 0; i < sizeof order / sizeof order[0]; i++) {
        assert_true(key(&p, KEY_TAB, 0));
        assert_int_equal(p.ui.focus, ui_id(&p.ui, order[i]));
    }
    key(&p, KEY_TAB, MOD_SHIFT);
    assert_int_equal(p.ui.focus, ui_id(&p.ui, "go"));
    assert_true(key(&p, KEY_ENTER, 0)); // what the focus takes does nothing else: Space would play, too
    assert_true(p.pressed);
    key(&p, KEY_TAB, MOD_SHIFT);
    assert_true(key(&p, KEY_SPACE, 0));
    assert_true(p.on);
    key(&p, KEY_TAB, MOD_SHIFT);
    key(&p, KEY_RIGHT, 0);
    assert_int_equal(p.choice, 1);
    assert_true(key(&p, KEY_ESCAPE, 0));
    assert_int_equal(p.ui.focus, 0);
    assert_false(key(&p, KEY_ESCAPE, 0));
    key(&p, KEY_TAB, 0);
    button(&p, BUTTON_LEFT, ACTION_PRESS, 1, 10, 10);
    assert_int_equal(p.ui.focus, 0);
}

/// Buttons of one name: beside each other they are noticed, each in its own scope they are two.
TEST(test_a_name_is_free_again_in_another_scope)
{
    static const struct rect area = {0, 0, 100, 100};
    struct event event = {.kind = EVENT_KEY, .key = KEY_TAB, .action = ACTION_PRESS};
    for (int scoped = 0; scoped < 2; scoped++) {
        struct ui ui = {.focus = 0};
        ui_begin_event(&ui, area, &event);
        for (uint32_t row = 0; row < 3; row++) {
            if (scoped) ui_push(&ui, row);
            ui_button(&ui, ui_row(&ui, UI_ROW), "go", "Go", false);
            if (scoped) ui_pop(&ui);
        }
        ui_end(&ui);
        assert_int_equal(ui.twice.id != 0, !scoped);
    }
}

TEST(test_focused_slider_takes_arrows_and_digits_only)
{
    struct panel p = make_panel();
    key(&p, KEY_TAB, 0);
    key(&p, KEY_RIGHT, 0);
    key(&p, KEY_UP, 0);
    assert_near(p.speed, 1.1, 0);
    key(&p, KEY_LEFT, MOD_SHIFT);
    assert_near(p.speed, 0.6, 0);
    assert_int_equal(p.nudges, 3);
    for (int i = 0; i < 30; i++) key(&p, KEY_DOWN, 0);
    assert_near(p.speed, 0, 0);
    assert_false(key(&p, 'V', 0)); // letters, Space and chords stay the editor's
    assert_false(key(&p, KEY_SPACE, 0));
    assert_false(key(&p, 'Z', MOD_CTRL));
    assert_false(key(&p, KEY_LEFT, MOD_ALT));
    assert_true(key(&p, '4', 0));
    type(&p, "4.2");
    key(&p, KEY_TAB, 0);
    assert_near(p.speed, 4.2, 0);
    assert_int_equal(p.ui.focus, ui_id(&p.ui, "offset"));
}

TEST(test_the_comma_of_a_keypad_is_a_point)
{
    struct panel p = make_panel();
    key(&p, KEY_TAB, 0);
    type(&p, ",5");
    key(&p, KEY_ENTER, 0);
    assert_near(p.speed, 0.5, 0);
    type(&p, "1,25");
    key(&p, KEY_ENTER, 0);
    assert_near(p.speed, 1.25, 0);
    type(&p, "1,000.5");
    key(&p, KEY_ENTER, 0);
    assert_near(p.speed, 1.25, 0);
    assert_string_equal(p.ui.complaint, "speed: expected a number, got “1,000.5”");
}

TEST(test_typing_takes_all_keys_but_chords_and_f_keys)
{
    struct panel p = make_panel();
    click(&p, "speed", 2);
    assert_true(key(&p, 'V', 0));
    assert_true(key(&p, KEY_SPACE, 0));
    assert_true(key(&p, KEY_DELETE, 0));
    assert_true(key(&p, KEY_LEFT, MOD_ALT));
    assert_false(key(&p, 'Z', MOD_CTRL));
    assert_false(key(&p, KEY_F1, 0));
    assert_false(key(&p, KEY_F12, 0));
}

TEST(test_right_click_goes_to_the_default)
{
    struct panel p = make_panel();
    p.speed = 9;
    float x, y;
    find(&p, "speed", NULL, &x, &y);
    button(&p, BUTTON_RIGHT, ACTION_PRESS, 1, x, y);
    assert_near(p.speed, 1, 0);
    assert_int_equal(p.sets, 1);
    button(&p, BUTTON_RIGHT, ACTION_PRESS, 1, x, y);
    assert_int_equal(p.sets, 1);
    find(&p, "offset", NULL, &x, &y); // has none
    button(&p, BUTTON_RIGHT, ACTION_PRESS, 1, x, y);
    assert_near(p.offset, 0.5, 0);
}

TEST(test_segments_are_found_by_name)
{
    struct panel p = make_panel();
    click(&p, "kind.c", 1);
    assert_int_equal(p.choice, 2);
    click(&p, "kind.b", 1);
    assert_int_equal(p.choice, 1);
    ui_begin_find(&p.ui, p.area, "kind.d", NULL);
    build(&p);
    assert_false(ui_end(&p.ui));
}

TEST(test_scrolling_is_limited_and_follows_the_focus)
{
    struct panel p = make_panel();
    p.rows = 20; // 25 rows of 24 in 200 pixels
    move(&p, 1100, 100, 0);
    struct event wheel = {.kind = EVENT_WHEEL, .dy = -100, .x = 1100, .y = 100};
    assert_true(send(&p, wheel));
    assert_near(p.list.offset, 25 * UI_ROW - 200, 0);
    wheel.dy = 100;
    send(&p, wheel);
    assert_near(p.list.offset, 0, 0);
    ui_begin_find(&p.ui, p.area, "row.19", NULL);
    build(&p);
    assert_false(ui_end(&p.ui)); // scrolled out of sight
    key(&p, KEY_TAB, MOD_SHIFT);
    float x, y;
    find(&p, "row.19", NULL, &x, &y);
    assert_true(y < 200);
    assert_false(button(&p, BUTTON_LEFT, ACTION_PRESS, 1, 1100, 210)); // what is clipped cannot be pressed
}

static void press_text(struct ui_text *text, int code)
{
    ui_text_event(text, &(struct event){.kind = EVENT_KEY, .key = code, .action = ACTION_PRESS}, NULL);
}

TEST(test_text_is_edited_by_characters)
{
    struct ui_text text;
    ui_text_set(&text, "aé…");
    press_text(&text, KEY_BACKSPACE);
    assert_string_equal(text.bytes, "aé");
    press_text(&text, KEY_LEFT);
    ui_text_event(&text, &(struct event){.kind = EVENT_TEXT, .codepoint = 0x1F600}, NULL);
    assert_string_equal(text.bytes, "a\xF0\x9F\x98\x80é");
    press_text(&text, KEY_HOME);
    press_text(&text, KEY_DELETE);
    press_text(&text, KEY_DELETE);
    assert_string_equal(text.bytes, "é");
    press_text(&text, KEY_END);
    press_text(&text, KEY_DELETE);
    assert_string_equal(text.bytes, "é");
    text.all = true;
    ui_text_event(&text, &(struct event){.kind = EVENT_TEXT, .codepoint = 'x'}, NULL);
    assert_string_equal(text.bytes, "x");
    bool changed = true;
    assert_true(ui_text_event(&text, &(struct event){.kind = EVENT_TEXT, .codepoint = '\n'}, &changed));
    assert_false(changed);
    for (int i = 0; i < 2 * UI_TEXT_SIZE; i++) {
        ui_text_event(&text, &(struct event){.kind = EVENT_TEXT, .codepoint = 0xE9}, NULL);
    }
    assert_true(text.length < UI_TEXT_SIZE);
    assert_int_equal(strlen(text.bytes), text.length);
}

/// Two frames without an event between them are the same commands: nothing is redrawn.
TEST(test_drawing_is_steady_and_fits)
{
    struct panel p = make_panel();
    struct drawlist list;
    uint64_t hash[2] = {0, 0};
    drawlist_create(&list, 1000, 10000, 10000);
    for (int frame = 0; frame < 2; frame++) {
        drawlist_clear(&list, (struct rect){0, 0, 1280, 720});
        ui_begin_draw(&p.ui, p.area, &list);
        build(&p);
        ui_end(&p.ui);
        assert_false(list.overflow);
        assert_true(list.count > 10);
        for (int i = 0; i < list.count; i++) {
            hash[frame] = hash[frame] * 31 + list.commands[i].hash;
            struct rect inside = rect_intersect(list.commands[i].bounds, p.area);
            assert_near(inside.w, list.commands[i].bounds.w, 0);
        }
    }
    assert_true(hash[0] == hash[1]);
    drawlist_destroy(&list);
}

/// Whether a small shape lies in the middle of an icon.
static bool has_middle(enum ui_icon icon)
{
    struct ui ui = {0};
    struct drawlist list;
    const struct rect area = {0, 0, 100, 100}, r = {40, 40, 24, 24};
    bool found = false;
    drawlist_create(&list, 100, 1000, 1000);
    drawlist_clear(&list, area);
    ui_begin_draw(&ui, area, &list);
    ui_icon_button(&ui, r, "icon", icon, false, "Icon");
    ui_end(&ui);
    for (int i = 0; i < list.count; i++) {
        const struct rect *b = &list.commands[i].bounds;
        found |= fabsf(b->x + b->w / 2 - 52) < 1.5f && fabsf(b->y + b->h / 2 - 52) < 1.5f && b->w < 10 && b->h < 10;
    }
    drawlist_destroy(&list);
    return found;
}

TEST(test_an_open_eye_has_a_pupil)
{
    assert_true(has_middle(UI_ICON_EYE));
    assert_false(has_middle(UI_ICON_EYE_CLOSED));
    assert_true(has_middle(UI_ICON_PICK));
}

/// Whether something goes around, or fills, all of `r` with a contrast of 3:1 against the panel.
static bool is_seen(const struct drawlist *list, struct rect r)
{
    for (int i = 0; i < list->count; i++) {
        const struct draw_command *c = &list->commands[i];
        const struct rect inside = rect_intersect(c->bounds, r);
        if (c->kind == DRAW_TEXT || inside.w < r.w - 1 || inside.h < r.h - 1) continue;
        if ((c->color & 0xFFu) == 0xFFu && theme_contrast(c->color, theme()->panel) >= 3) return true;
    }
    return false;
}

/// At rest, off and unfocused, each control has an outline or a fill of its own in both themes.
TEST(test_controls_are_seen_where_they_are)
{
    static const char *const names[] = {"speed", "offset", "kind", "on", "go"};
    struct drawlist list;
    drawlist_create(&list, 1000, 10000, 10000);
    for (int kind = 0; kind < THEME_COUNT; kind++) {
        struct panel p = make_panel();
        theme_use((enum theme_kind)kind);
        drawlist_clear(&list, (struct rect){0, 0, 1280, 720});
        ui_begin_draw(&p.ui, p.area, &list);
        build(&p);
        ui_end(&p.ui);
        for (int i = 0; i < 5; i++) {
            assert_true(p.ui.stop[i].id == ui_id(&p.ui, names[i]));
            if (!is_seen(&list, p.ui.stop[i].rect)) fail_msg("%s theme: \"%s\" is not seen", theme()->name, names[i]);
        }
    }
    theme_use(THEME_DARK);
    drawlist_destroy(&list);
}

static int start(void **state)
{
    (void)state;
    font_init();
    return 0;
}

TESTS_BETWEEN(start, NULL)
