/// Widgets, driven by events as a person would: what is dragged, typed, chosen and picked, and where the keyboard goes.
#include "near.h"
#include "ui/font.h"
#include "ui/theme.h"
#include "ui/widgets.h"

enum { ITEMS = 30 };

/// A panel with one of everything; as a `sorter`, three rows to drag, a button, and a drop-down at the bottom.
struct panel {
    struct ui ui;
    struct rect area;
    bool is_sorter, on;
    double speed, offset;
    int changes[8];      ///< of all numbers, by kind
    int pressed, choice; ///< `choice`: of the segments, or picked from the list
    struct ui_list list;
    int rows; ///< more of them, to make the panel too long
    int items, dropped;
    const char *stem; ///< of the items' names
    enum ui_line line;
    char typed[UI_TEXT_SIZE];
    bool used;            ///< the last event
    float from_x, from_y; ///< where the pointer was pressed or dragged to
};

static const struct ui_number speed_number = {.name = "speed",
                                              .label = "pace",
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

static void build_values(struct panel *p)
{
    static const struct ui_choice choices[] = {{"a", "First"}, {"b", "Second"}, {"c", "Third"}};
    struct ui *ui = &p->ui;
    ui_list_begin(ui, &p->list, p->area);
    p->changes[ui_value(ui, ui_row(ui, UI_ROW), &speed_number, &p->speed)]++;
    p->changes[ui_value(ui, ui_row(ui, UI_ROW), &offset_number, &p->offset)]++;
    ui_segments(ui, ui_row(ui, UI_ROW), "kind", choices, 3, &p->choice);
    ui_toggle(ui, ui_row(ui, UI_ROW), "on", &p->on);
    p->pressed += ui_button(ui, ui_row(ui, UI_ROW), "go", "Go", true);
    for (int i = 0; i < p->rows; i++) {
        char name[16];
        snprintf(name, sizeof name, "row.%d", i);
        ui_list_row(ui, ui_row(ui, UI_ROW), name, name, 0, false);
    }
    ui_list_end(ui);
}

static void build_sorter(struct panel *p)
{
    static struct ui_item items[ITEMS];
    static char labels[ITEMS][400];
    struct ui *ui = &p->ui;
    ui_value(ui, ui_row(ui, UI_ROW), &speed_number, &p->speed);
    p->pressed += ui_icon_button(ui, (struct rect){1200, 30, 24, 24}, "eye", UI_ICON_EYE, false, "See");
    for (int i = 0; i < 3; i++) {
        char name[16];
        snprintf(name, sizeof name, "row.%d", i);
        const struct rect r = ui_row(ui, UI_ROW);
        const enum ui_row_event event = ui_sort_row(ui, r, r, name, name, false);
        if (event == UI_ROW_DROPPED) p->dropped = i;
        if (event == UI_ROW_TWICE) ui_line_begin(ui, "line", "old");
    }
    const enum ui_line line = ui_line(ui, ui_row(ui, UI_ROW), "line");
    if (line != UI_LINE_NONE) {
        p->line = line;
        snprintf(p->typed, sizeof p->typed, "%s", ui->text.bytes);
    }
    ui->y = p->area.y + p->area.h - 40;
    ui_dropdown(ui, ui_row(ui, UI_ROW), "kind", 7, "Kind", 0);
    for (int i = 0; i < p->items; i++) {
        snprintf(labels[i], sizeof labels[i], "%s%d", p->stem, i);
        items[i] = (struct ui_item){labels[i], labels[i], 0, i};
    }
    const int picked = ui_popup_list(ui, "kind", items, p->items, p->choice);
    if (picked >= 0) p->choice = picked;
}

/// Builds it in the pass that has begun; returns what the pass does.
static bool build(struct panel *p)
{
    (p->is_sorter ? build_sorter : build_values)(p);
    return ui_end(&p->ui);
}

static void open_values(struct panel *p)
{
    *p = (struct panel){.area = {1000, 0, 280, 200}, .speed = 1, .offset = 0.5};
}

static void open_sorter(struct panel *p)
{
    *p = (struct panel){.area = {1000, 0, 280, 400},
                        .is_sorter = true,
                        .speed = 1,
                        .choice = 2,
                        .items = ITEMS,
                        .stem = "",
                        .dropped = -1};
}

// --- what a person does, in words

static void send(struct panel *p, struct event event)
{
    ui_begin_event(&p->ui, p->area, &event);
    p->used = build(p);
}

static void button(struct panel *p, enum event_button which, enum event_action action, int clicks, float x, float y)
{
    send(p,
         (struct event){.kind = EVENT_BUTTON, .button = which, .action = action, .clicks = clicks, .x = x, .y = y});
}

/// Whether a widget is to be seen, in found_x and found_y.
static bool is_seen(struct panel *p, const char *name, const double *value)
{
    ui_begin_find(&p->ui, p->area, name, value);
    return build(p);
}

/// A key with what is held: "Shift+Tab".
static void strike(struct panel *p, const char *chord)
{
    const char *plus = strchr(chord, '+');
    const unsigned mods = !plus ? 0 : *chord == 'S' ? MOD_SHIFT : *chord == 'C' ? MOD_CTRL : MOD_ALT;
    const int code = key_from_name(plus ? plus + 1 : chord);
    if (code == KEY_NONE) fail_msg("there is no key %s", chord);
    send(p, (struct event){.kind = EVENT_KEY, .key = code, .action = ACTION_PRESS, .mods = mods});
}

/// One step: "type 2 Hz"; "press go" at a widget or "press 10 10", like "twice" and "right"; "click go"; "drag 12", the bar's handle to where
/// that is, and "by 40 0" or "fine 40 0", with Shift, from there; "release"; "wheel -5 item.3"; a key, or "20*Down".
static void act(struct panel *p, const char *step)
{
    char verb[16] = "", name[32] = "";
    int skip = 0, times = 1;
    double by = 0, x = 0, y = 0;
    if (sscanf(step, "%d*%n", &times, &skip) == 1 && skip > 0) step += skip;
    const char *rest = step + strcspn(step, " ");
    rest += *rest == ' ';
    sscanf(step, "%15s %31s", verb, name);
    const bool is_wheel = strcmp(verb, "wheel") == 0;
    if (is_wheel && sscanf(rest, "%lf %31s", &by, name) == 2) rest = strchr(rest, ' ');
    const bool is_place = sscanf(rest, "%lf %lf", &x, &y) == 2;
    if (strcmp(verb, "type") == 0) {
        while (*rest) send(p, (struct event){.kind = EVENT_TEXT, .codepoint = utf8_next(&rest)});
    } else if (strcmp(verb, "release") == 0) {
        button(p, BUTTON_LEFT, ACTION_RELEASE, 1, p->ui.pointer_x, p->ui.pointer_y);
    } else if (strcmp(verb, "drag") == 0) {
        act(p, "press speed");
        by = atof(rest);
        assert_true(is_seen(p, "speed", &by));
        send(p, (struct event){.kind = EVENT_POINTER, .x = p->ui.found_x, .y = p->ui.found_y});
        p->from_x = p->ui.pointer_x, p->from_y = p->ui.pointer_y;
    } else if (strcmp(verb, "by") == 0 || strcmp(verb, "fine") == 0) {
        send(p, (struct event){.kind = EVENT_POINTER,
                               .x = p->from_x + (float)x,
                               .y = p->from_y + (float)y,
                               .mods = *verb == 'f' ? MOD_SHIFT : 0});
    } else if (strstr("press twice click right wheel", verb)) {
        if (!is_place) {
            if (!is_seen(p, name, NULL)) fail_msg("%s: it is not to be seen", step);
            x = (double)p->ui.found_x, y = (double)p->ui.found_y;
        }
        p->from_x = (float)x, p->from_y = (float)y;
        if (is_wheel) {
            send(p, (struct event){.kind = EVENT_WHEEL, .dy = (float)by, .x = p->from_x, .y = p->from_y});
        } else {
            button(p, *verb == 'r' ? BUTTON_RIGHT : BUTTON_LEFT, ACTION_PRESS, *verb == 't' ? 2 : 1, p->from_x,
                   p->from_y);
            if (*verb == 'c') act(p, "release");
        }
    } else {
        while (times-- > 0) strike(p, step);
    }
}

/// Whether a sentence is so: "speed 12", "focus go", "sees item.3", "typed new name".
static bool holds(struct panel *p, const char *fact)
{
    const char *what = strchr(fact, ' ') + 1;
    const struct {
        const char *name;
        double value;
    } numbers[] = {{"speed", p->speed},
                   {"offset", p->offset},
                   {"choice", p->choice},
                   {"pressed", p->pressed},
                   {"on", p->on},
                   {"used", p->used},
                   {"drags", p->changes[UI_DRAG]},
                   {"drops", p->changes[UI_DROP]},
                   {"cancels", p->changes[UI_CANCEL]},
                   {"sets", p->changes[UI_SET]},
                   {"nudges", p->changes[UI_NUDGE]},
                   {"typing", p->ui.typing != 0},
                   {"held", p->ui.held != 0},
                   {"dragged", ui_is_dragged(&p->ui, "row.0")},
                   {"dropped", p->dropped},
                   {"open", ui_popup_is_open(&p->ui, "kind")},
                   {"about", p->ui.popup.which},
                   {"scrolled", p->list.offset}};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (strncmp(fact, numbers[i].name, strcspn(fact, " ")) == 0) return numbers[i].value == atof(what);
    if (strncmp(fact, "focus", 5) == 0) { // an item of the list has an id of its own
        if (strcmp(what, "none") == 0) return p->ui.focus == 0;
        return p->ui.focus == ui_id(&p->ui, what) || (is_seen(p, what, NULL) && p->ui.focus == p->ui.found);
    }
    if (strncmp(fact, "sees", 4) == 0) // in the panel, above the drop-down of the sorter
        return is_seen(p, what, NULL) && p->ui.found_y > 0 && p->ui.found_y < p->area.h - (p->is_sorter ? 40 : 0);
    if (strncmp(fact, "hides", 5) == 0) return !is_seen(p, what, NULL);
    if (strncmp(fact, "typed", 5) == 0) return p->line == UI_LINE_DONE && strcmp(p->typed, what) == 0;
    if (strncmp(fact, "line cancelled", 5) == 0) return p->line == UI_LINE_CANCEL;
    if (strncmp(fact, "says", 4) == 0) return strcmp(p->ui.complaint, what) == 0;
    fail_msg("what is \"%s\"?", fact);
    return false;
}

/// Calls on each part of a text between "; ".
static void each_part(struct panel *p, const char *text, void (*call)(struct panel *p, const char *part))
{
    char copy[512], *end;
    snprintf(copy, sizeof copy, "%s", text);
    for (char *part = copy; part; part = end) {
        end = strstr(part, "; ");
        if (end) *end = '\0', end += 2;
        call(p, part);
    }
}

static const char *walk_name, *walk_acts;

static void expect(struct panel *p, const char *fact)
{
    if (!holds(p, fact)) fail_msg("%s: after \"%s\" it is not so: %s", walk_name, walk_acts, fact);
}

/// A step of a walk and what is so then; a name begins a walk in a new panel.
struct step {
    const char *name, *acts, *facts;
};

static void walk(const struct step *steps, size_t count, void (*opens)(struct panel *p))
{
    struct panel p;
    for (size_t i = 0; i < count; i++) {
        if (steps[i].name) opens(&p), walk_name = steps[i].name;
        walk_acts = steps[i].acts;
        each_part(&p, steps[i].acts, act);
        each_part(&p, steps[i].facts, expect);
    }
}

TEST(values_are_dragged_typed_and_stepped)
{
    static const struct step steps[] = {
        {"a bar reaches both ends", "drag 12", "speed 12"},
        {NULL, "by 4000 -300", "speed 12"}, // far outside the panel the drag goes on, and the bar ends
        {NULL, "by -9000 900", "speed 0"},
        {NULL, "release; drag 12; drag 0", "speed 0"},
        {NULL, "release; drag 2.5", "speed 2.5"}, // a replay's target is met, and what is saved is the short number
        {"a drag is many changes and one drop", "drag 3; by 20 0; release", "drags 2; drops 1"},
        {NULL, "click speed", "drags 2; drops 1; sets 0; nudges 0; cancels 0"}, // a click alone changes nothing
        {NULL, "drag 5; Escape", "cancels 1; used 1"},
        {NULL, "release", "drops 1; held 0"},
        {"right click goes to the default", "drag 9; release; right speed", "speed 1; sets 1"},
        {NULL, "right speed", "speed 1; sets 1"},
        {NULL, "right offset", "offset 0.5; sets 1"}, // has none
        {"a press elsewhere takes what was typed", "twice offset; release; type 2; click go", "offset 2; pressed 1"},
        {NULL, "twice offset; release; type 3; click speed", "offset 3; typing 0"}, // built before it: uses it first
        {NULL, "twice offset; release; type 4; press 10 10", "offset 4; used 0"},   // outside it stays to be used
        {"segments are found by name", "click kind.c", "choice 2; hides kind.d"},
        {NULL, "click kind.b", "choice 1"},
    };
    walk(steps, sizeof steps / sizeof *steps, open_values);
}

TEST(the_keyboard_goes_round)
{
    static const struct step steps[] = {
        {"Tab goes round", "Tab", "focus speed; used 1"},
        {NULL, "Tab", "focus offset"},
        {NULL, "Tab", "focus kind"},
        {NULL, "Tab", "focus on"},
        {NULL, "Tab", "focus go"},
        {NULL, "Tab", "focus speed; used 1"},
        {NULL, "Shift+Tab", "focus go"},
        {NULL, "Enter", "pressed 1; used 1"}, // what the focus takes does nothing else: Space would play, too
        {NULL, "Shift+Tab; Space", "on 1; used 1"},
        {NULL, "Shift+Tab; Right", "choice 1"},
        {NULL, "Escape", "focus none; used 1"},
        {NULL, "Escape", "used 0"},
        {NULL, "Tab; press 10 10", "focus none"},
        {"a focused bar takes arrows and digits only", "Tab; Right; Up", "speed 1.1"},
        {NULL, "Shift+Left", "speed 0.6; nudges 3"},
        {NULL, "30*Down", "speed 0"},
        {NULL, "V", "used 0"}, // letters, Space and chords stay the editor's
        {NULL, "Space", "used 0"},
        {NULL, "Ctrl+Z", "used 0"},
        {NULL, "Alt+Left", "used 0"},
        {NULL, "4", "used 1"},
        {NULL, "type ,5; Enter", "speed 0.5"}, // the comma of a keypad
        {NULL, "type 1,000.5; Enter", "speed 0.5; says pace: expected a number, got “1,000.5”"},
        {NULL, "Escape; type 4.2; Tab", "speed 4.2; focus offset"},
        {"typing takes all keys but chords and F keys", "twice speed; release; V", "used 1"},
        {NULL, "Space", "used 1"},
        {NULL, "Delete", "used 1"},
        {NULL, "Alt+Left", "used 1"},
        {NULL, "Ctrl+Z", "used 0"},
        {NULL, "F1", "used 0"},
        {NULL, "F12", "used 0"},
    };
    walk(steps, sizeof steps / sizeof *steps, open_values);
}

static void open_long(struct panel *p) // 25 rows of 24 in 200 pixels
{
    open_values(p);
    p->rows = 20;
}

TEST(scrolling_is_limited_and_follows_the_focus)
{
    static const struct step steps[] = {
        {"scrolled", "wheel -100 speed", "scrolled 400; used 1"},
        {NULL, "wheel 100 row.19", "scrolled 0; hides row.19"},
        {NULL, "Shift+Tab", "sees row.19"},
        {NULL, "press 1100 210", "used 0"}, // clipped
    };
    walk(steps, sizeof steps / sizeof *steps, open_long);
}

/// A drop-down hangs near the bottom, so that its list opens upwards and lies over other widgets.
TEST(lists_are_picked_from_and_rows_dragged)
{
    static const struct step steps[] = {
        {"the pointer picks", "press kind.7", "open 1; about 7"},
        {NULL, "release; press item.1", "choice 1; open 0; focus none"}, // the keyboard stays with the editor
        {"it lies over the panel", "press kind.7", "sees item.0; sees item.3"},
        {NULL, "press eye", "pressed 0; open 0"}, // outside: closes, and is for nothing else
        {NULL, "press eye", "pressed 1"},
        {"Escape and chords close", "press kind.7; Escape", "open 0; choice 2; used 1"},
        {NULL, "press kind.7; V", "open 1; used 1"}, // a letter does nothing behind the list's back
        {NULL, "Ctrl+Z", "open 0; used 0"},
        {"the keyboard picks", "Shift+Tab", "focus kind.7"},
        {NULL, "Enter", "open 1; focus item.2"}, // at what is chosen
        {NULL, "20*Down", "sees item.22"},
        {NULL, "Enter", "choice 22; open 0; focus kind.7"}, // and the field has the keyboard again
        {NULL, "Space; Shift+Tab", "focus item.21"},
        {"typing finds a row", "press kind.7; type 25; Enter", "choice 25; open 0"},
        {"the wheel scrolls the list alone", "press kind.7; wheel -5 item.3", "sees item.15; used 1"},
        {NULL, "wheel -5 1010 5", "sees item.15; used 1; speed 1"}, // not over the list
        {"a click is no drag", "click row.0", "dropped -1"},
        {NULL, "press row.0; by 0 2", "dragged 0"},
        {NULL, "by 0 50", "dragged 1"},
        {NULL, "release", "dropped 0"},
        {"Escape ends a drag", "press row.1; by 0 66; Escape; release", "dropped -1"},
        {"a line is edited in place", "twice row.0; type new name; Enter", "typed new name"},
        {NULL, "twice row.0; type x; Escape", "line cancelled"},
        {NULL, "twice row.0; type elsewhere; press eye", "typed elsewhere; pressed 1"}, // a press on what is there
    };
    walk(steps, sizeof steps / sizeof *steps, open_sorter);

    struct panel p; // names that are long, and alike at the beginning, are told apart
    char stem[301] = "";
    open_sorter(&p);
    for (int i = 0; i < 100; i++) strcat(stem, "尻");
    p.stem = stem;
    p.items = 5;
    each_part(&p, walk_acts = "press kind.7; Down; Enter", act);
    expect(&p, "choice 3");
    act(&p, "press kind.7"); // what the list is about may go while it is open (undo): it does not swallow all input
    ui_begin_event(&p.ui, p.area, &(struct event){.kind = EVENT_POINTER});
    ui_end(&p.ui);
    expect(&p, "open 0");
}

TEST(shift_drags_a_tenth)
{
    struct panel p;
    open_values(&p);
    each_part(&p, "drag 6; fine 0 0; fine 40 0", act);
    const double fine = p.speed - 6;
    each_part(&p, "by 0 0; by 40 0", act); // the coarse mapping starts where the pointer is
    assert_true(fine > 0);
    assert_near(fine, (p.speed - 6) / 10, 0.011);
}

/// Typed over 7 Hz: a number with or without its unit and a comma for a point, or the reason why it is not taken.
TEST(typing_takes_numbers_with_unit)
{
    static const struct {
        const char *text;
        double value; ///< NAN: refused
    } rows[] = {
        {"2.5", 2.5}, {" 3 ", 3},  {"4 Hz", 4},  {"5Hz", 5},     {"1e1", 10},      {"20", 20},   {".5", 0.5},
        {"0", 0},     {",5", 0.5}, {"abc", NAN}, {"1,25", 1.25}, {"1.2.3", NAN},   {"", NAN},    {"0x10", NAN},
        {"nan", NAN}, {"-1", NAN}, {"inf", NAN}, {"1e999", NAN}, {"2 Hz Hz", NAN}, {"3 m", NAN}, {"--2", NAN},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct panel p;
        const bool is_good = !isnan(rows[i].value);
        char typing[32];
        open_values(&p);
        p.speed = 7;
        snprintf(typing, sizeof typing, "type %s", rows[i].text);
        each_part(&p, "twice speed; release", act); // selects all: what is typed replaces it
        if (!is_good) act(&p, "Backspace");
        act(&p, walk_name = walk_acts = typing);
        act(&p, "Enter");
        expect(&p, is_good ? "sets 1; typing 0" : "sets 0; typing 1");
        if (!is_good && !strstr(p.ui.complaint, "pace: expected")) fail_msg("%s: no reason is given", typing);
        if (!is_good) act(&p, "Escape"); // or it is to be put right
        if (p.speed != (is_good ? rows[i].value : 7)) fail_msg("%s gives %g", typing, p.speed);
        expect(&p, "typing 0");
        expect(&p, "focus none"); // a double-click leaves no focus behind
    }
}

/// Buttons of one name: beside each other they are noticed, each in its own scope they are two.
TEST(test_a_name_is_free_again_in_another_scope)
{
    struct event event = {.kind = EVENT_KEY, .key = KEY_TAB, .action = ACTION_PRESS};
    for (int scoped = 0; scoped < 2; scoped++) {
        struct ui ui = {.focus = 0};
        ui_begin_event(&ui, (struct rect){0, 0, 100, 100}, &event);
        for (uint32_t row = 0; row < 3; row++) {
            if (scoped) ui_push(&ui, row);
            ui_button(&ui, ui_row(&ui, UI_ROW), "go", "Go", false);
            if (scoped) ui_pop(&ui);
        }
        ui_end(&ui);
        assert_int_equal(ui.twice.id != 0, !scoped);
    }
}

/// A line of text after each event: a key or, above that, a character.
TEST(test_text_is_edited_by_characters)
{
    enum { TYPED = 0x1000000 };
    static const struct {
        uint32_t what;
        const char *then;
    } rows[] = {{KEY_BACKSPACE, "aé"},
                {KEY_LEFT, "aé"},
                {TYPED | 0x1F600, "a\xF0\x9F\x98\x80é"},
                {KEY_HOME, "a\xF0\x9F\x98\x80é"},
                {KEY_DELETE, "\xF0\x9F\x98\x80é"},
                {KEY_DELETE, "é"},
                {KEY_END, "é"},
                {KEY_DELETE, "é"}};
    struct ui_text text;
    struct event event = {.kind = EVENT_TEXT, .codepoint = 'x'};
    ui_text_set(&text, "aé…");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const struct event key = {.kind = EVENT_KEY, .key = (int)rows[i].what, .action = ACTION_PRESS};
        const struct event typed = {.kind = EVENT_TEXT, .codepoint = rows[i].what & ~(uint32_t)TYPED};
        ui_text_event(&text, rows[i].what & TYPED ? &typed : &key, NULL);
        if (strcmp(text.bytes, rows[i].then) != 0) fail_msg("event %zu gives \"%s\"", i, text.bytes);
    }
    text.all = true;
    ui_text_event(&text, &event, NULL);
    assert_string_equal(text.bytes, "x");
    bool changed = true;
    event.codepoint = '\n';
    assert_true(ui_text_event(&text, &event, &changed));
    assert_false(changed);
    event.codepoint = 0xE9;
    for (int i = 0; i < 2 * UI_TEXT_SIZE; i++) ui_text_event(&text, &event, NULL);
    assert_true(text.length < UI_TEXT_SIZE);
    assert_int_equal(strlen(text.bytes), text.length);
}

// --- what is drawn

static void open_list(struct drawlist *list) { drawlist_create(list, 1000, 10000, 10000); }

#define DRAWING_TEST(name) TEST_OF(struct drawlist, list, open_list(list), drawlist_destroy(list), name)

static void draw(struct panel *p, struct drawlist *list)
{
    drawlist_clear(list, (struct rect){0, 0, 1280, 720});
    ui_begin_draw(&p->ui, p->area, list);
    build(p);
}

/// Two frames without an event between them are the same commands: nothing is redrawn.
DRAWING_TEST(test_drawing_is_steady_and_fits)
{
    struct panel panel;
    uint64_t hash[2] = {0, 0};
    open_values(&panel);
    for (int frame = 0; frame < 2; frame++) {
        draw(&panel, list);
        assert_false(list->overflow);
        assert_true(list->count > 10);
        for (int i = 0; i < list->count; i++) {
            hash[frame] = hash[frame] * 31 + list->commands[i].hash;
            struct rect inside = rect_intersect(list->commands[i].bounds, panel.area);
            assert_near(inside.w, list->commands[i].bounds.w, 0);
        }
    }
    assert_true(hash[0] == hash[1]);
}

/// A small shape lies in the middle of an icon, or none.
DRAWING_TEST(test_an_open_eye_has_a_pupil)
{
    static const struct {
        enum ui_icon icon;
        bool has_middle;
    } rows[] = {{UI_ICON_EYE, true}, {UI_ICON_EYE_CLOSED, false}, {UI_ICON_PICK, true}};
    const struct rect area = {0, 0, 100, 100}, r = {40, 40, 24, 24};
    for (int row = 0; row < 3; row++) {
        struct ui ui = {0};
        bool found = false;
        drawlist_clear(list, area);
        ui_begin_draw(&ui, area, list);
        ui_icon_button(&ui, r, "icon", rows[row].icon, false, "Icon");
        ui_end(&ui);
        for (int i = 0; i < list->count; i++) {
            const struct rect *b = &list->commands[i].bounds;
            found |=
                fabsf(b->x + b->w / 2 - 52) < 1.5f && fabsf(b->y + b->h / 2 - 52) < 1.5f && b->w < 10 && b->h < 10;
        }
        if (found != rows[row].has_middle) fail_msg("icon %d", (int)rows[row].icon);
    }
}

/// Whether something goes around, or fills, all of `r` with a contrast of 3:1 against the panel.
static bool stands_out(const struct drawlist *list, struct rect r)
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
DRAWING_TEST(test_controls_are_seen_where_they_are)
{
    static const char *const names[] = {"speed", "offset", "kind", "on", "go"};
    for (int kind = 0; kind < THEME_COUNT; kind++) {
        struct panel p;
        open_values(&p);
        theme_use((enum theme_kind)kind);
        draw(&p, list);
        for (int i = 0; i < 5; i++) {
            assert_true(p.ui.stop[i].id == ui_id(&p.ui, names[i]));
            if (!stands_out(list, p.ui.stop[i].rect))
                fail_msg("%s theme: \"%s\" is not seen", theme()->name, names[i]);
        }
    }
    theme_use(THEME_DARK);
}

static int start(void **state)
{
    (void)state;
    font_init();
    return 0;
}

TESTS_BETWEEN(start, NULL)
