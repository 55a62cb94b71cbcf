/// Popups and the widgets of lists: who gets an event while one is open, and where the keyboard goes.
#include "near.h"
#include "ui/font.h"
#include "ui/widgets.h"

enum { ITEMS = 30 };

/// A drop-down at the panel's bottom, a number and a button above, and three rows that can be dragged.
struct panel {
    struct ui ui;
    struct rect area;
    double speed;
    const char *stem; ///< of the items' names
    int chosen, items, pressed, dropped;
    enum ui_line line;
    char typed[UI_TEXT_SIZE];
};

static const struct ui_number speed_number = {
    .name = "speed", .label = "speed", .maximum = 12, .highest = 12, .fallback = 1, .step = 0.05, .decimals = 2};

static void build_rows(struct panel *p)
{
    for (int i = 0; i < 3; i++) {
        char name[16];
        snprintf(name, sizeof name, "row.%d", i);
        struct rect r = ui_row(&p->ui, UI_ROW);
        enum ui_row_event event = ui_sort_row(&p->ui, r, r, name, name, false);
        if (event == UI_ROW_DROPPED) p->dropped = i;
        if (event == UI_ROW_TWICE) ui_line_begin(&p->ui, "line", "old");
    }
    enum ui_line line = ui_line(&p->ui, ui_row(&p->ui, UI_ROW), "line");
    if (line == UI_LINE_NONE) return;
    p->line = line;
    snprintf(p->typed, sizeof p->typed, "%s", p->ui.text.bytes);
}

static void build(struct panel *p)
{
    struct ui *ui = &p->ui;
    struct ui_item items[ITEMS];
    char labels[ITEMS][400];
    ui_value(ui, ui_row(ui, UI_ROW), &speed_number, &p->speed);
    if (ui_icon_button(ui, (struct rect){1200, 30, 24, 24}, "eye", UI_ICON_EYE, false, "See")) p->pressed++;
    build_rows(p);
    ui->y = p->area.y + p->area.h - 40;
    ui_dropdown(ui, ui_row(ui, UI_ROW), "kind", 7, "Kind", 0);
    for (int i = 0; i < p->items; i++) {
        snprintf(labels[i], sizeof labels[i], "%s%d", p->stem, i);
        items[i] = (struct ui_item){labels[i], labels[i], 0};
    }
    int picked = ui_popup_list(ui, "kind", items, p->items, p->chosen);
    if (picked >= 0) p->chosen = picked;
}

static struct panel make_panel(void)
{
    return (struct panel){.area = {1000, 0, 280, 400},
                          .speed = 1,
                          .stem = "",
                          .chosen = 2,
                          .items = ITEMS,
                          .dropped = -1,
                          .line = UI_LINE_NONE};
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

static uint32_t find(struct panel *p, const char *name, float *x, float *y)
{
    ui_begin_find(&p->ui, p->area, name, NULL);
    build(p);
    if (!ui_end(&p->ui)) fail_msg("%s is not to be seen", name);
    *x = p->ui.found_x;
    *y = p->ui.found_y;
    return p->ui.found;
}

static bool press(struct panel *p, const char *name, int clicks)
{
    float x, y;
    find(p, name, &x, &y);
    struct event event = {.kind = EVENT_BUTTON, .action = ACTION_PRESS, .clicks = clicks, .x = x, .y = y};
    return send(p, event);
}

static void release(struct panel *p)
{
    send(p,
         (struct event){.kind = EVENT_BUTTON, .action = ACTION_RELEASE, .x = p->ui.pointer_x, .y = p->ui.pointer_y});
}

static void move(struct panel *p, float x, float y)
{
    send(p, (struct event){.kind = EVENT_POINTER, .x = x, .y = y});
}

static bool is_open(const struct panel *p) { return ui_popup_is_open(&p->ui, "kind"); }

/// Picking closes the list and hands the choice over; the list knows what it was opened about.
TEST(test_a_list_is_picked_from)
{
    struct panel p = make_panel();
    press(&p, "kind.7", 1);
    assert_true(is_open(&p));
    assert_int_equal(p.ui.popup.which, 7);
    release(&p);
    press(&p, "item.1", 1);
    assert_int_equal(p.chosen, 1);
    assert_false(is_open(&p));
    assert_true(p.ui.focus == 0); // opened by the pointer: the keyboard stays with the editor
}

/// However long the names of its rows are, and alike at the beginning.
TEST(test_rows_of_long_names_are_told_apart)
{
    struct panel p = make_panel();
    char stem[301] = "";
    for (int i = 0; i < 100; i++) strcat(stem, "尻");
    p.stem = stem;
    p.items = 5;
    press(&p, "kind.7", 1);
    key(&p, KEY_DOWN, 0);
    key(&p, KEY_ENTER, 0);
    assert_int_equal(p.chosen, 3);
}

/// It is not clipped by the panel's bottom, near which it hangs: it opens upwards, and its rows lie over other widgets.
TEST(test_a_list_lies_over_the_panel)
{
    struct panel p = make_panel();
    float x, y;
    p.items = 10;
    press(&p, "kind.7", 1);
    find(&p, "item.0", &x, &y);
    assert_true(y < 360 && y > 0);
    find(&p, "item.9", &x, &y);
    assert_true(y < 360);
    p.items = 3;
    find(&p, "item.2", &x, &y);
    press(&p, "eye", 1); // outside: closes, and is for nothing else
    assert_int_equal(p.pressed, 0);
    assert_false(is_open(&p));
    press(&p, "eye", 1);
    assert_int_equal(p.pressed, 1);
}

TEST(test_escape_and_chords_close)
{
    struct panel p = make_panel();
    press(&p, "kind.7", 1);
    assert_true(key(&p, KEY_ESCAPE, 0));
    assert_false(is_open(&p));
    assert_int_equal(p.chosen, 2);
    press(&p, "kind.7", 1);
    assert_true(key(&p, 'V', 0)); // a letter does nothing behind the list's back
    assert_true(is_open(&p));
    assert_false(key(&p, 'Z', MOD_CTRL));
    assert_false(is_open(&p));
}

/// By keyboard alone: the list opens at what is chosen, arrows go through it and scroll it, Enter picks, and the field has
/// the keyboard again.
TEST(test_a_list_by_keyboard)
{
    struct panel p = make_panel();
    p.ui.focus = ui_id(&p.ui, "kind.7");
    key(&p, KEY_ENTER, 0);
    assert_true(is_open(&p));
    float x, y;
    assert_true(p.ui.focus == find(&p, "item.2", &x, &y));
    for (int i = 0; i < 20; i++) key(&p, KEY_DOWN, 0);
    find(&p, "item.22", &x, &y); // scrolled into sight
    key(&p, KEY_ENTER, 0);
    assert_int_equal(p.chosen, 22);
    assert_false(is_open(&p));
    assert_true(p.ui.focus == ui_id(&p.ui, "kind.7"));
    key(&p, KEY_SPACE, 0);
    key(&p, KEY_TAB, MOD_SHIFT);
    assert_true(p.ui.focus == find(&p, "item.21", &x, &y));
}

TEST(test_the_wheel_scrolls_the_list_alone)
{
    struct panel p = make_panel();
    press(&p, "kind.7", 1);
    float x, y;
    find(&p, "item.3", &x, &y);
    assert_true(send(&p, (struct event){.kind = EVENT_WHEEL, .dy = -5, .x = x, .y = y}));
    find(&p, "item.15", &x, &y);
    assert_true(send(&p, (struct event){.kind = EVENT_WHEEL, .dy = -5, .x = 1010, .y = 5})); // not over the list
    find(&p, "item.15", &x, &y);
    assert_near(p.speed, 1, 0);
}

/// What the list was about may go while it is open (undo): it does not stay behind and swallow all input.
TEST(test_a_list_that_is_not_built_closes)
{
    struct panel p = make_panel();
    press(&p, "kind.7", 1);
    struct event event = {.kind = EVENT_POINTER};
    ui_begin_event(&p.ui, p.area, &event);
    ui_end(&p.ui);
    assert_false(is_open(&p));
}

TEST(test_rows_are_dragged)
{
    struct panel p = make_panel();
    press(&p, "row.0", 1);
    release(&p);
    assert_int_equal(p.dropped, -1); // a click is no drag
    press(&p, "row.0", 1);
    float x = p.ui.pointer_x, y = p.ui.pointer_y;
    move(&p, x, y + 50);
    assert_true(ui_is_dragged(&p.ui, "row.0"));
    release(&p);
    assert_int_equal(p.dropped, 0);
    p.dropped = -1;
    press(&p, "row.1", 1);
    move(&p, x, y + 90);
    key(&p, KEY_ESCAPE, 0);
    release(&p);
    assert_int_equal(p.dropped, -1);
}

static void type(struct panel *p, const char *text)
{
    while (*text) send(p, (struct event){.kind = EVENT_TEXT, .codepoint = utf8_next(&text)});
}

TEST(test_a_line_is_edited_in_place)
{
    struct panel p = make_panel();
    press(&p, "row.0", 2);
    type(&p, "new name");
    key(&p, KEY_ENTER, 0);
    assert_int_equal(p.line, UI_LINE_DONE);
    assert_string_equal(p.typed, "new name");
    press(&p, "row.0", 2);
    type(&p, "x");
    key(&p, KEY_ESCAPE, 0);
    assert_int_equal(p.line, UI_LINE_CANCEL);
    press(&p, "row.0", 2);
    type(&p, "elsewhere");
    press(&p, "eye", 1); // ends the typing and is a press on what is there
    assert_int_equal(p.line, UI_LINE_DONE);
    assert_string_equal(p.typed, "elsewhere");
    assert_int_equal(p.pressed, 1);
}
