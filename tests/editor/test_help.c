/// The table of commands: what it says is true, F1 shows all of it, and docs/keys.md names the same keys.
#include "editor/state.h"
#include "panel_session.h"
#include "shown.h"

static const char scene[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, \"knots\": "
    "[{\"frame\": 0, \"value\": 0, \"slope\": 1}, {\"frame\": 36, \"value\": 1}]}],"
    "\"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", \"spline\": \"sway\"}]}";

static void open_help(struct session *s, float width, float height)
{
    panel_open(s, scene, width, height);
    session_key(s, KEY_F1, 0);
    assert_true(looked_up(s->editor) == LOOKUP_KEYS);
}

static bool is_seen(const struct draw_command *c) { return c && c->y > c->clip.y && c->y < c->clip.y + c->clip.h; }

/// A row that is added must be reached by scrolling in every usual window, and nothing of it may be cut.
TEST(test_every_row_is_reached_whole)
{
    static const float sizes[][2] = {{960, 600}, {1280, 720}, {1920, 1080}, {3840, 2160}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        struct session s;
        bool *seen = calloc((size_t)command_count, sizeof *seen);
        open_help(&s, sizes[i][0], sizes[i][1]);
        for (int page = 0; page < 60; page++) {
            for (int c = 0; c < command_count; c++) {
                char keys[COMMAND_KEYS];
                if (!commands[c].name) continue;
                command_keys(&commands[c], keys);
                seen[c] |= is_seen(shown_text(s.editor, commands[c].name)) &&
                           (!keys[0] || is_seen(shown_text(s.editor, keys)));
            }
            session_wheel(&s, -1);
        }
        for (int c = 0; c < command_count; c++) {
            if (!seen[c] && commands[c].about != ABOUT_NOTHING)
                fail_msg("“%s” is never to be seen whole at %g × %g", commands[c].name, (double)sizes[i][0],
                         (double)sizes[i][1]);
        }
        free(seen);
        session_close(&s);
    }
}

SESSION_TEST(test_small_windows_scroll, open_help(s, 500, 360))
{
    assert_true(is_seen(shown_text(s->editor, "Drag the body")));
    assert_false(is_seen(shown_text(s->editor, "Ctrl+9")));
    session_wheel(s, -1000);
    assert_true(is_seen(shown_text(s->editor, "Ctrl+9")));
    assert_false(is_seen(shown_text(s->editor, "Drag the body")));
    for (int i = 0; i < 40; i++) session_key(s, KEY_PAGE_UP, 0);
    assert_true(is_seen(shown_text(s->editor, "Drag the body")));
}

SESSION_TEST(test_esc_enter_f1_and_a_click_close_the_help, panel_open(s, scene, 1280, 720))
{
    static const int closing[] = {KEY_ESCAPE, KEY_ENTER, KEY_F1};
    for (size_t i = 0; i < sizeof closing / sizeof closing[0]; i++) {
        session_key(s, KEY_F1, 0);
        assert_true(looked_up(s->editor) == LOOKUP_KEYS);
        session_key(s, closing[i], 0);
        assert_false(looked_up(s->editor) == LOOKUP_KEYS);
    }
    session_key(s, KEY_F1, 0);
    session_move(s, 500, 500);
    session_click_here(s, 1);
    assert_false(looked_up(s->editor) == LOOKUP_KEYS);
}

/// As a finger does; it stays open, and no row is clicked.
SESSION_TEST(test_a_drag_scrolls_the_lists, open_help(s, 390, 792))
{
    static const float from[] = {200, 300};
    session_move(s, from[0], from[1]);
    session_press(s, BUTTON_LEFT, 1);
    session_drag(s, 0, -160, 8);
    session_release(s, BUTTON_LEFT);
    assert_near(lookup_of(s->editor)->list.offset, 160, 1);
    session_key(s, KEY_F3, 0);
    session_move(s, from[0], from[1]);
    session_press(s, BUTTON_LEFT, 1);
    session_drag(s, 0, -160, 8);
    assert_near(lookup_of(s->editor)->list.offset, 10, 0);
    session_drag(s, 0, 80, 8);
    session_release(s, BUTTON_LEFT);
    assert_near(lookup_of(s->editor)->list.offset, 5, 0);
    assert_true(looked_up(s->editor) == LOOKUP_PALETTE);
    session_move(s, 5, 5);
    session_click_here(s, 1);
    assert_false(looked_up(s->editor) == LOOKUP_PALETTE);
}

SESSION_TEST(test_typing_searches_the_help, panel_open(s, scene, 1280, 720))
{
    session_key(s, KEY_F1, 0);
    panel_type(s, "V onion");
    assert_null(shown_text(s->editor, "Onion skin"));
    for (int i = 0; i < 7; i++) session_key(s, KEY_BACKSPACE, 0);
    panel_type(s, "onion");
    assert_true(is_seen(shown_text(s->editor, "Onion skin")));
    assert_null(shown_text(s->editor, "Double-click"));
    assert_int_equal(look(s->editor), LOOK_WIGGLY);
}

/// F1 begins with ten rows about what the pointer is over.
TEST(test_ten_keys_about_what_is_under_the_pointer)
{
    static const struct {
        const char *target, *title, *row;
        unsigned at;
    } cases[] = {{"knot(sway,1)", "Over a knot", "Slope on or off", ON_KNOT},
                 {"curve(sway,20,0)", "Over the curves", "Fix the first warning", ON_CURVES},
                 {"ruler(20)", "Over the ruler and the status line", "Scrub", ON_TIME},
                 {"stage(0.05,0.1)", "Over the stage", "Onion skin", ON_STAGE},
                 {"widget(section.feel)", "In the inspector", "Type a number", ON_INSPECTOR}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct session s;
        int count = 0;
        panel_open(&s, scene, 1280, 720);
        session_hover(&s, cases[i].target);
        session_key(&s, KEY_F1, 0);
        assert_non_null(shown_text(s.editor, cases[i].title));
        assert_true(is_seen(shown_text(s.editor, cases[i].row)));
        session_close(&s);
        for (int c = 0; c < command_count; c++) count += (commands[c].at & cases[i].at) != 0;
        assert_int_equal(count, 10);
    }
}

// --- the palette ----------------------------------------------------------------------------------------------------------

/// Opens it and types.
static void search(struct session *s, const char *text)
{
    session_key(s, KEY_F3, 0);
    assert_true(looked_up(s->editor) == LOOKUP_PALETTE);
    panel_type(s, text);
}

TEST(test_the_palette_runs_what_is_found)
{
    static const struct {
        const char *typed;
        int key; ///< what does the same
        unsigned mods;
    } cases[] = {{"select all knots of", 'A', MOD_CTRL},
                 {"ONION", 'O', 0},
                 {"ghst", KEY_F4, 0},
                 {"ctrl+l", 'L', MOD_CTRL},
                 {"scr", KEY_F12, 0},
                 {"seconds", 'U', 0},
                 {"knot insert play", 'I', 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct session s;
        const struct command *expected = keys_command(cases[i].key, cases[i].mods);
        session_open(&s, scene);
        search(&s, cases[i].typed);
        if (!shown_text(s.editor, expected->name)) fail_msg("%s: not found by %s", expected->name, cases[i].typed);
        session_key(&s, KEY_ENTER, 0);
        assert_false(looked_up(s.editor) == LOOKUP_PALETTE);
        session_close(&s);
    }
}

SESSION_TEST(test_the_palette_does_what_the_key_does, session_open(s, scene))
{
    search(s, "select all knots of");
    session_key(s, KEY_ENTER, 0);
    assert_int_equal(selection_count(selection_of(s->editor), s->document->splines[0]), 2);
    search(s, "delete sel");
    session_key(s, KEY_ENTER, 0);
    assert_int_equal(s->document->splines[0]->knot_count, 0);
    search(s, "add a spl");
    session_key(s, KEY_ENTER, 0);
    assert_int_equal(s->document->spline_count, 2);
}

/// What cannot be done now says why, and Enter leaves the palette open; Esc closes it and changes nothing.
SESSION_TEST(test_the_palette_says_what_is_missing, session_open(s, scene))
{
    const char *before = session_saved(s);
    search(s, "flat slope");
    session_frame(s);
    assert_non_null(shown_text(s->editor, "Select a knot first."));
    session_key(s, KEY_ENTER, 0);
    assert_true(looked_up(s->editor) == LOOKUP_PALETTE);
    session_key(s, KEY_DELETE, 0);
    session_key(s, KEY_ESCAPE, 0);
    assert_false(looked_up(s->editor) == LOOKUP_PALETTE);
    assert_saved(s, before);
}

/// What needs no key is there too: buttons and sections of the inspector.
TEST(test_the_palette_reaches_the_inspector)
{
    static const struct {
        const char *typed, *shows; ///< and the widget that is to be seen then
    } cases[] = {{"history", "section.history"},  {"limits", "section.limits"},   {"bandwidth", "section.advanced"},
                 {"frame rate", "section.scene"}, {"copy the r", "section.tail"}, {"channels", "section.tail"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct session s;
        panel_open(&s, scene, 1280, 1400);
        show_more(s.editor, false);
        assert_false(panel_shows(&s, cases[i].shows));
        search(&s, cases[i].typed);
        session_key(&s, KEY_ENTER, 0);
        if (!panel_shows(&s, cases[i].shows)) fail_msg("%s does not show %s", cases[i].typed, cases[i].shows);
        session_close(&s);
    }
}

SESSION_TEST(test_the_palette_chooses_a_feel, session_open(s, scene))
{
    static const struct {
        const char *typed;
        double frequency;
    } cases[] = {{"cat", 0.8}, {"whip", 1.8}, {"heavy", 0.5}, {"jelly", 3}, {"antenna", 5}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char typed[32];
        snprintf(typed, sizeof typed, "feel %s", cases[i].typed);
        search(s, typed);
        session_key(s, KEY_ENTER, 0);
        assert_near(s->document->splines[0]->parameter[PARAMETER_FREQUENCY].value, cases[i].frequency, 0);
    }
}

/// Switches that have no key.
SESSION_TEST(test_the_palette_flips_switches, session_open(s, scene))
{
    const struct core *core = &s->editor->core;
    for (int on = 1; on >= 0; on--) {
        static const char *const typed[] = {"solo", "hide the spl", "record the next"};
        for (size_t i = 0; i < sizeof typed / sizeof typed[0]; i++) {
            search(s, typed[i]);
            session_key(s, KEY_ENTER, 0);
        }
        assert_int_equal(selection_has(&core->view.solo, s->document->splines[0]->id), on);
        assert_int_equal(selection_has(&core->view.hidden, s->document->splines[0]->id), on);
        assert_int_equal(core->view.on[SWITCH_RECORD], on);
    }
}

/// Whatever can be done now is done without harm, in an empty scene and in one with everything selected.
TEST(test_every_command_runs)
{
    static const char empty[] = "{\"wiggly\": 1, \"frames\": [0, 96]}";
    for (int c = 0; c < command_count; c++) {
        for (int rich = 0; rich < 2; rich++) {
            struct session s;
            session_open(&s, rich ? scene : empty);
            if (rich) session_key(&s, 'A', MOD_CTRL);
            const bool can = command_runs(&commands[c]) && !missing(s.editor, commands[c].needs);
            if (can) command_run(s.editor, &commands[c]);
            session_frame(&s);
            if (can && said_error(s.editor)) fail_msg("“%s”: %s", commands[c].name, said(s.editor));
            session_close(&s);
        }
    }
}

/// Arrows, pages and the wheel go through all rows, round the ends; a click runs one.
SESSION_TEST(test_the_palette_is_walked, session_open(s, scene))
{
    search(s, "");
    session_key(s, KEY_UP, 0);
    const int last = lookup_of(s->editor)->choice;
    assert_true(last > 80);
    session_key(s, KEY_DOWN, 0);
    assert_int_equal(lookup_of(s->editor)->choice, 0);
    for (int i = 0; i < 20; i++) session_key(s, KEY_PAGE_DOWN, 0);
    assert_int_equal(lookup_of(s->editor)->choice, last);
    session_wheel(s, 1000);
    panel_type(s, "onion");
    const struct draw_command *row = shown_text(s->editor, "Onion skin");
    assert_non_null(row);
    session_move(s, row->x + 4, row->y - 4);
    session_click_here(s, 1);
    assert_true(is_on(s->editor, SWITCH_ONION));
}

// --- the table -------------------------------------------------------------------------------------------

/// Rows under a heading stand together, and no two are called the same.
TEST(test_the_table_is_in_order)
{
    for (int c = 0; c < command_count; c++) {
        for (int other = 0; other < c; other++) {
            const bool alike = command_runs(&commands[c]) && command_runs(&commands[other]) && commands[c].name &&
                               commands[other].name && strcmp(commands[c].name, commands[other].name) == 0;
            if (alike) fail_msg("two are called %s", commands[c].name);
            if (commands[other].about == commands[c].about && commands[c - 1].about != commands[c].about)
                fail_msg("“%s” stands apart from its like", commands[c].name);
        }
        assert_true(command_runs(&commands[c]) != (commands[c].gesture != NULL));
    }
}

TEST(test_every_letter_to_hold_is_in_the_help)
{
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        char gesture[64];
        bool found = !parameter_rows[p].letter;
        if (!found) snprintf(gesture, sizeof gesture, "Hold %s, press ↑ ↓", parameter_rows[p].letter);
        for (int c = 0; c < command_count && !found; c++) {
            found = commands[c].gesture && strcmp(commands[c].gesture, gesture) == 0 &&
                    strcasecmp(commands[c].name, parameter_rows[p].name) == 0;
        }
        if (!found) fail_msg("the help lacks “%s” for %s", gesture, parameter_rows[p].name);
    }
}

static const char *lacks(const struct session *s, int key, unsigned mods)
{
    return missing(s->editor, keys_command(key, mods)->needs);
}

/// Whether a command can be done now follows the scene and the selection.
SESSION_TEST(test_what_can_be_done_now, session_open(s, scene))
{
    assert_string_equal(lacks(s, 'Z', MOD_CTRL), "There is nothing to undo.");
    assert_string_equal(lacks(s, 'T', 0), "Select a knot first.");
    assert_string_equal(lacks(s, 'J', 0), "Click a bone of an imported character first.");
    assert_string_equal(lacks(s, 'B', MOD_SHIFT), "Select a soft character first.");
    assert_string_equal(lacks(s, KEY_PAGE_UP, MOD_ALT), "Select a pin first.");
    assert_null(lacks(s, 'A', MOD_CTRL));
    assert_null(lacks(s, 'S', MOD_CTRL));
    session_key(s, 'A', MOD_CTRL);
    assert_null(lacks(s, 'T', 0));
    session_key(s, KEY_DELETE, 0);
    assert_null(lacks(s, 'Z', MOD_CTRL));
    assert_string_equal(lacks(s, 'A', MOD_CTRL), "Insert a knot first.");
    assert_string_equal(lacks(s, 'Y', MOD_CTRL), "There is nothing to redo.");
    session_key(s, 'Z', MOD_CTRL);
    assert_null(lacks(s, 'Y', MOD_CTRL));
    assert_string_equal(lacks(s, KEY_END, 0), "Select a knot first.");
    assert_null(lacks(s, 'H', 0));
    for (int i = s->document->rig_count; i > 0; i--) assert_done(edit_rig_remove(s->document, i - 1, &error));
    assert_string_equal(lacks(s, 'H', 0), "Add a tail, a chain or a soft character first.");
}

enum { MAX_CHORDS = 256 };

struct chords {
    struct chord list[MAX_CHORDS];
    int count;
};

static void add(struct chords *chords, int key, unsigned mods)
{
    assert_true(chords->count < MAX_CHORDS);
    chords->list[chords->count++] = (struct chord){key, mods};
}

static bool has(const struct chords *chords, int key, unsigned mods)
{
    for (int i = 0; i < chords->count; i++) {
        if (chords->list[i].key == key && chords->list[i].mods == mods) return true;
    }
    return false;
}

/// The key of that name, as the help writes it; 0 where it is none (but a mouse button, say).
static int key_of(const char *name)
{
    static const struct {
        const char *name;
        int key;
    } names[] = {{"Del", KEY_DELETE}, {"Esc", KEY_ESCAPE}, {"PgUp", KEY_PAGE_UP}, {"PgDn", KEY_PAGE_DOWN},
                 {"Home", KEY_HOME},  {"End", KEY_END},    {"Enter", KEY_ENTER},  {"Space", KEY_SPACE},
                 {"←", KEY_LEFT},     {"→", KEY_RIGHT},    {"Tab", KEY_TAB},      {"Backspace", KEY_BACKSPACE},
                 {"↑", KEY_UP},       {"↓", KEY_DOWN}};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (strcmp(names[i].name, name) == 0) return names[i].key;
    }
    if (name[0] == 'F' && name[1] >= '0' && name[1] <= '9') return KEY_F1 + atoi(name + 1) - 1;
    return name[0] && !name[1] ? name[0] : 0;
}

/// Takes "Ctrl+Shift+" off the beginning of a text.
static unsigned take_mods(const char **text)
{
    static const struct {
        const char *name;
        unsigned mod;
    } mods[] = {{"Ctrl+", MOD_CTRL}, {"Shift+", MOD_SHIFT}, {"Alt+", MOD_ALT}};
    unsigned taken = 0;
    for (size_t i = 0; i < sizeof mods / sizeof *mods; i++) {
        size_t length = strlen(mods[i].name);
        if (strncmp(*text, mods[i].name, length) != 0) continue;
        *text += length;
        taken |= mods[i].mod;
    }
    return taken;
}

/// Where the next of several keys begins, and where this one ends.
static const char *next_key(const char *text, size_t *length)
{
    static const char *const separators[] = {", ", "; ", "  "};
    const char *end = text + strlen(text), *next = end;
    for (size_t i = 0; i < 3; i++) {
        const char *found = *text ? strstr(text + 1, separators[i]) : NULL;
        if (!found || found >= end) continue;
        end = found;
        next = found + 2;
    }
    *length = (size_t)(end - text);
    return next;
}

/// All that a row may mean: a key without modifiers of its own stands for itself and with those of the one before it.
static void read_row(const char *text, struct chords *chords)
{
    unsigned before = 0;
    while (*text) {
        char name[32];
        size_t length;
        const char *next = next_key(text, &length), *key = name;
        snprintf(name, sizeof name, "%.*s", (int)length, text);
        unsigned mods = take_mods(&key);
        if (strcmp(key, "arrows") == 0) {
            for (int k = KEY_LEFT; k <= KEY_DOWN; k++) add(chords, k, mods);
        } else if (strcmp(key, "1 … 9") == 0) {
            for (int k = '1'; k <= '9'; k++) add(chords, k, mods);
        } else if (key_of(key)) {
            add(chords, key_of(key), mods);
            if (!mods) add(chords, key_of(key), before);
        }
        if (mods) before = mods;
        text = next;
    }
}

/// Whether the editor does something for a chord, or for the character that a key without modifiers is named after. A session in
/// which nothing was done serves for the next one, too.
static bool try_chord(int key, unsigned mods)
{
    static struct session s;
    static bool is_open;
    if (!is_open) session_open(&s, scene);
    const struct event press = {.kind = EVENT_KEY, .key = key, .mods = mods, .action = ACTION_PRESS};
    const struct event text = {.kind = EVENT_TEXT, .codepoint = (uint32_t)key};
    bool bound = keys_event(s.editor, &press) || (mods == 0 && keys_event(s.editor, &text));
    is_open = !bound;
    if (bound) session_close(&s);
    return bound;
}

static bool is_bound(int key, unsigned mods)
{
    static enum { UNKNOWN, BOUND, FREE } known[KEY_COUNT][8];
    if (known[key][mods] == UNKNOWN) known[key][mods] = try_chord(key, mods) ? BOUND : FREE;
    return known[key][mods] == BOUND;
}

static void assert_has_every_key(const struct chords *chords, const char *where)
{
    int bound = 0;
    for (int key = KEY_SPACE; key < KEY_COUNT; key++) {
        for (unsigned mods = 0; mods < 8; mods++) {
            if (!is_bound(key, mods)) continue;
            bound++;
            if (!has(chords, key, mods)) fail_msg("%s lacks %s with modifiers %u", where, key_name(key), mods);
        }
    }
    assert_true(bound > 80);
}

/// Keys that somebody else than keys.c answers: the inspector, a drag, a held letter.
static bool is_answered_elsewhere(int key)
{
    static const int elsewhere[] = {KEY_F1, 'L', 'X', 'Y', 'R', KEY_TAB, KEY_ENTER};
    for (size_t e = 0; e < sizeof elsewhere / sizeof *elsewhere; e++) {
        if (elsewhere[e] == key) return true;
    }
    return parameter_of_letter(key) != PARAMETER_COUNT;
}

static void assert_does_something(const char *keys)
{
    struct chords chords = {.count = 0};
    bool any = false;
    read_row(keys, &chords);
    for (int k = 0; k < chords.count; k++) {
        any |= is_bound(chords.list[k].key, chords.list[k].mods) || is_answered_elsewhere(chords.list[k].key);
    }
    if (chords.count > 0 && !any) fail_msg("%s does nothing", keys);
}

// --- docs/keys.md against the keys ----------------------------------------------------------------------------------------

/// The page names several keys in one cell as the help does, signs in backticks.
static void page_cell(const char *line, char *cell, size_t size)
{
    size_t length = 0;
    for (const char *c = line + 2; *c && strncmp(c, " |", 2) != 0 && length + 1 < size; c++) {
        if (*c != '`') cell[length++] = *c;
    }
    cell[length] = '\0';
}

static bool next_page_row(FILE *page, char *cell, size_t size)
{
    char line[1024];
    while (fgets(line, sizeof line, page)) {
        if (strncmp(line, "| ", 2) != 0) continue;
        page_cell(line, cell, size);
        return true;
    }
    return false;
}

TEST(test_every_key_is_in_the_page_of_keys)
{
    FILE *page = fopen("docs/keys.md", "r");
    assert_non_null(page);
    struct chords chords = {.count = 0};
    char cell[256];
    while (next_page_row(page, cell, sizeof cell)) read_row(cell, &chords);
    fclose(page);
    assert_has_every_key(&chords, "docs/keys.md");
}

TEST(test_the_page_of_keys_names_no_others)
{
    FILE *page = fopen("docs/keys.md", "r");
    assert_non_null(page);
    char cell[256];
    int rows = 0;
    for (; next_page_row(page, cell, sizeof cell); rows++) assert_does_something(cell);
    fclose(page);
    assert_true(rows > 60);
}
