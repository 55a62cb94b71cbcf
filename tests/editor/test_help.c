/// The table of commands: what it says is true, F1 and the palette show all of it, docs/keys.md names the same keys, each has one on every
/// keyboard, and nothing needs a mouse.
#include "editor/state.h"
#include "hands.h"
#include "ui/theme.h"

static const char scene[] =
    "{'frames': [0, 96], 'splines': [{'name': 'sway', 'frequency': 1, 'knots': [{'frame': 0, 'value': 0, 'slope': "
    "1}, "
    "{'frame': 36, 'value': 1}]}], 'rigs': [{'type': 'tail', 'name': 'tail', 'spline': 'sway'}]}";

// --- F1 -----------------------------------------------------------------------------------------------------------------

static void open_help(struct session *s, float width, float height)
{
    panel_open(s, scene, width, height);
    hands(s, "key F1; is lookup keys");
}

static bool is_seen(const struct session *s, const char *text)
{
    const struct draw_command *c = shown_text(s->editor, text);
    return c && c->y > c->clip.y && c->y < c->clip.y + c->clip.h;
}

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
                if (!commands[c].name || seen[c]) continue;
                command_keys(&commands[c], false, keys);
                seen[c] = is_seen(&s, commands[c].name) && (!keys[0] || is_seen(&s, keys));
            }
            session_wheel(&s, -1);
        }
        for (int c = 0; !commands[c].heading || commands[c].heading[0]; c++) {
            if (!seen[c] && commands[c].name)
                fail_msg("“%s” is never to be seen whole at %g × %g", commands[c].name, (double)sizes[i][0],
                         (double)sizes[i][1]);
        }
        free(seen);
        session_close(&s);
    }
}

SESSION_TEST(test_small_windows_scroll, open_help(s, 500, 360))
{
    for (int end = 0; end < 3; end++) {
        if (end == 1) session_wheel(s, -1000);
        if (end == 2) hands(s, "key 40*PageUp");
        assert_int_equal(is_seen(s, "Drag the body"), end != 1);
        assert_int_equal(is_seen(s, "F12"), end == 1);
    }
}

/// As a finger does; it stays open, and no row is clicked.
SESSION_TEST(test_a_drag_scrolls_the_list, open_help(s, 390, 792))
{
    const float *offset = &lookup_of(s->editor)->list.offset;
    hands(s, "at 200 300");
    session_press(s, BUTTON_LEFT, 1);
    hands(s, "drag 0 -160 8");
    assert_near(*offset, 10, 0);
    hands(s, "drag 0 80 8; release; is lookup keys");
    assert_near(*offset, 5, 0);
    session_move(s, 5, 5);
    session_click_here(s, 1);
    hands(s, "is lookup none");
}

/// Esc, F1 and a click beside it close the help; Enter and a click run a row that can be run. What is typed searches it.
WALK(test_the_help_is_searched_and_closed, panel_open(s, scene, 1280, 720),
     "key F1; is lookup keys; key Escape; is lookup none; key F1; is lookup keys; key Enter; is lookup keys;"
     "key F1; is lookup none; key F1; is lookup keys; click stage(0.01,0.9); is lookup none;"
     "key F1; type V onion; hides Onion skin; key 7*Backspace; type onion; tap Onion skin; is onion 1;"
     "key F1; type scrub; key Enter; is lookup keys; key Escape; is look wiggly")

/// F1 begins with ten rows about what the pointer is over.
TEST(test_ten_keys_about_what_is_under_the_pointer)
{
    static const struct {
        const char *target, *title, *row;
        unsigned at;
    } rows[] = {{"knot(sway,1)", "Over a knot", "Slope on or off", ON_KNOT},
                {"curve(sway,20,0)", "Over the curves", "Fix the first warning", ON_CURVES},
                {"ruler(20)", "Over the ruler and the status line", "Scrub", ON_TIME},
                {"stage(0.05,0.1)", "Over the stage", "Onion skin", ON_STAGE},
                {"widget(spline.sway)", "Over the splines' list", "Put into a folder, or take out", ON_ROW},
                {"widget(section.feel)", "In the inspector", "Type a number, +5, *2, 12/24", ON_INSPECTOR}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct session s;
        int count = 0;
        panel_open(&s, scene, 1280, 720);
        hands(&s, "hover %s; key F1; shows %s", rows[i].target, rows[i].title);
        assert_true(is_seen(&s, rows[i].row));
        session_close(&s);
        for (int c = 0; c < command_count; c++) count += (commands[c].at & rows[i].at) != 0;
        if (count != 10) fail_msg("%s: %d rows", rows[i].title, count);
    }
}

// --- the palette ----------------------------------------------------------------------------------------------------------

TEST(test_the_palette_runs_what_is_found)
{
    static const struct {
        const char *typed;
        int key; ///< what does the same
        unsigned mods;
    } rows[] = {{"select all knots of", 'A', MOD_CTRL},
                {"ONION", 'O', 0},
                {"ghst", KEY_F4, 0},
                {"ctrl+l", 'L', MOD_CTRL},
                {"scr", KEY_F12, 0},
                {"seconds", 'U', 0},
                {"knot insert play", 'I', 0}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct session s;
        session_open(&s, scene);
        hands(&s, "key F3; is lookup palette; type %s; shows %s; key Enter; is lookup none", rows[i].typed,
              keys_command(rows[i].key, rows[i].mods)->name);
        session_close(&s);
    }
}

/// What cannot be done now says why, and Enter leaves the palette open; Esc closes it and changes nothing. It does what the key does,
/// chooses a feel, and flips switches that have no key.
SESSION_TEST(test_the_palette_does_what_the_key_does, session_open(s, scene))
{
    static const char *const feels[] = {"cat 0.8", "whip 1.8", "heavy 0.5", "jelly 3", "antenna 5"};
    const struct core *core = &s->editor->core;
    hands(s, "key F3; type flat slope; wait; shows Select a knot first.; key Enter; is lookup palette;"
             "key Delete Escape; is lookup none; kept");
    for (int i = 0; i < 5; i++) {
        const int length = (int)strcspn(feels[i], " ");
        hands(s, "key F3; type feel %.*s; key Enter; is splines.0.frequency %s", length, feels[i],
              feels[i] + length + 1);
    }
    for (int on = 1; on >= 0; on--) {
        hands(s,
              "key F3; type solo; key Enter F3; type hide the spl; key Enter F3; type record the next; key Enter;"
              "is record %d",
              on);
        assert_int_equal(selection_has(&core->view.solo, s->document->splines[0]->id), on);
        assert_int_equal(selection_has(&core->view.hidden, s->document->splines[0]->id), on);
    }
    hands(s, "key F3; type select all knots of; key Enter; is selected 2;"
             "key F3; type delete sel; key Enter; is splines.0.knots.# 0;"
             "key F3; type add a spl; key Enter; is splines.# 2");
}

/// A word of any example finds the list of them; the palette itself has none of them.
SESSION_TEST(test_the_examples_are_one_list, session_open(s, scene))
{
    static const char *const words[] = {"figure 3",     "resonance", "poles and response",
                                        "it stretches", "editable",  "four knots",
                                        "phases of",    "dog",       "creature held"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        hands(s, "key F3; type %s; shows Examples; hides Figure; key Escape", words[i]);
    session_asked(s);
    hands(s, "key F3; type examples; key Enter; is lookup palette; shows Figure 1: resonance as a spline;"
             "shows A creature held by its hands; hides Undo; type dog; key Enter; is lookup none");
    const struct request asked = session_asked(s);
    assert_true(asked.kind == REQUEST_FIGURE && asked.number == 8);
}

/// What needs no key is there too: buttons and sections of the inspector.
TEST(test_the_palette_reaches_the_inspector)
{
    static const struct {
        const char *typed, *shows; ///< and the widget that is to be seen then
    } rows[] = {{"history", "section.history"},
                {"limits", "section.limits"},
                {"bandwidth", "section.advanced"},
                {"copy the r", "section.tail"},
                {"channels", "section.tail"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct session s;
        panel_open(&s, scene, 1280, 1400);
        hands(&s, "more off; lacks %s; key F3; type %s; key Enter; finds %s", rows[i].shows, rows[i].typed,
              rows[i].shows);
        session_close(&s);
    }
}

/// Arrows, pages and the wheel go through all rows, round the ends; a click runs one.
SESSION_TEST(test_the_palette_is_walked, session_open(s, scene))
{
    hands(s, "key F3 Up");
    const int last = lookup_of(s->editor)->choice;
    assert_true(last > 80);
    hands(s, "key Down");
    assert_int_equal(lookup_of(s->editor)->choice, 0);
    hands(s, "key 20*PageDown");
    assert_int_equal(lookup_of(s->editor)->choice, last);
    hands(s, "wheel 1000; type onion; tap Onion skin; is onion 1");
}

// --- the table ----------------------------------------------------------------------------------------------------------

/// Whatever can be done now is done without harm, in an empty scene and in one with everything selected.
TEST(test_every_command_runs)
{
    for (int c = 0; c < 2 * command_count; c++) {
        const struct command *command = &commands[c / 2];
        struct session s;
        session_open(&s, c % 2 ? scene : "{'frames': [0, 96]}");
        if (c % 2) session_key(&s, 'A', MOD_CTRL);
        const bool can = command_runs(command) && !missing(s.editor, command->needs);
        if (can) command_run(s.editor, command);
        session_frame(&s);
        if (can && said_error(s.editor)) fail_msg("“%s”: %s", command->name, said(s.editor));
        session_close(&s);
    }
}

/// No two rows are called the same, and no two headings. The last heading ends F1.
TEST(test_the_table_is_in_order)
{
    for (int c = 0; c < command_count; c++) {
        for (int other = 0; other < c; other++) {
            const bool alike = command_runs(&commands[c]) && command_runs(&commands[other]) && commands[c].name &&
                               commands[other].name && strcmp(commands[c].name, commands[other].name) == 0;
            if (alike) fail_msg("two are called %s", commands[c].name);
            const bool headed = commands[c].heading && commands[other].heading;
            if (headed && (!*commands[other].heading || strcmp(commands[c].heading, commands[other].heading) == 0))
                fail_msg("“%s” stands apart from its like", commands[c].heading);
        }
        assert_int_equal(command_runs(&commands[c]) + !!commands[c].gesture + !!commands[c].heading, 1);
    }
}

/// Whether a command can be done now follows the scene and the selection.
SESSION_TEST(test_what_can_be_done_now, session_open(s, scene))
{
    static const struct {
        const char *first; ///< what is done before
        int key;
        unsigned mods;
        const char *lacks; ///< NULL: nothing
    } rows[] = {
        {"", 'Z', MOD_CTRL, "There is nothing to undo."},
        {"", 'T', 0, "Select a knot first."},
        {"", 'J', 0, "Click a bone of a character first."},
        {"", 'B', MOD_SHIFT, "Select a soft character first."},
        {"", KEY_PAGE_UP, MOD_ALT, "Select a pin first."},
        {"", 'A', MOD_CTRL, NULL},
        {"", 'S', MOD_CTRL, NULL},
        {"key Ctrl+A", 'T', 0, NULL},
        {"key Delete", 'Z', MOD_CTRL, NULL},
        {"", 'A', MOD_CTRL, "Insert a knot first."},
        {"", 'Z', MOD_CTRL | MOD_SHIFT, "There is nothing to redo."},
        {"key Ctrl+Z", 'Z', MOD_CTRL | MOD_SHIFT, NULL},
        {"key Escape", KEY_END, 0, "Select a knot first."}, // undo has selected it again
        {"", 'H', 0, NULL},
        {"key Shift+Delete K", 'H', 0, "Add a tail, a chain or a soft character first."},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        hands(s, "%s", rows[i].first);
        const char *lacks = missing(s->editor, keys_command(rows[i].key, rows[i].mods)->needs);
        if (strcmp(lacks ? lacks : "", rows[i].lacks ? rows[i].lacks : "") != 0)
            fail_msg("row %zu, key %s: %s", i, key_name(rows[i].key), lacks);
    }
}

// --- docs/keys.md against the keys ----------------------------------------------------------------------------------------

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
    for (int key = KEY_SPACE; key < KEY_COUNT; key++) {
        const char *own = command_key_name(key);
        if (own && strcmp(own, name) == 0) return key;
    }
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
            for (int k = KEY_RIGHT; k <= KEY_UP; k++) add(chords, k, mods);
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

/// Keys that somebody else than keys.c answers: the inspector, a drag, a held letter.
static bool is_answered_elsewhere(int key)
{
    static const int elsewhere[] = {KEY_F1, 'F', 'Z', 'L', 'X', 'Y', 'R', KEY_TAB, KEY_ENTER};
    for (size_t e = 0; e < sizeof elsewhere / sizeof *elsewhere; e++) {
        if (elsewhere[e] == key) return true;
    }
    return false;
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

/// The first cell of the next row; the page names several keys in one as the help does, signs in backticks.
static bool next_page_row(FILE *page, char cell[256])
{
    char line[1024];
    while (fgets(line, sizeof line, page)) {
        size_t length = 0;
        if (strncmp(line, "| ", 2) != 0) continue;
        for (const char *c = line + 2; *c && strncmp(c, " |", 2) != 0 && length < 255; c++) {
            if (*c != '`') cell[length++] = *c;
        }
        cell[length] = '\0';
        return true;
    }
    return false;
}

TEST(test_the_page_of_keys_names_every_key_and_no_others)
{
    struct chords chords = {.count = 0};
    char cell[256];
    int rows = 0, bound = 0;
    FILE *page = fopen("docs/keys.md", "r");
    assert_non_null(page);
    for (; next_page_row(page, cell); rows++) {
        assert_does_something(cell);
        read_row(cell, &chords);
    }
    fclose(page);
    assert_true(rows > 60);
    for (int k = 8 * KEY_SPACE; k < 8 * KEY_COUNT; k++) {
        const int key = k / 8;
        const unsigned mods = (unsigned)k % 8;
        if (!is_bound(key, mods)) continue;
        bound++;
        if (!has(&chords, key, mods)) fail_msg("docs/keys.md lacks %s with modifiers %u", key_name(key), mods);
    }
    assert_true(bound > 80);
}

// --- keyboards of other countries: every action has a key there, and what is typed is what counts, not the key that types it ---------

/// The punctuation of a layout as xkb-data 2.35 has it. Letters, digits by their places and keys with a name are on all of them.
static const struct layout_of {
    const char *name;
    const char *printed; ///< on a key's lower left, but for the row of digits, which are bound by place
    const char *typed;   ///< with Shift or without, not with AltGr
} layouts[] = {
    {"us", "-=[];'`\\,./<", "!@#$%^&*()-_=+[{]};:'\"`~\\|,<.>/?"},
    {"fr", ")=$*,;:!<", "&\"'(-_)=+$%*,?;.:/!<>"},
    {"be", ")-$,;:=<", "&\"'(!)-_$*%,?;.:/=+<>"},
    {"de", "+#,.-<", "!\"$%&/()=?+*#',;.:-_<>"},
    {"ch", "'$,.-<", "+\"*%&/()='?!$,;.:-_<>"},
    {"no", "+\\|',.-<", "!\"#%&/()=+?\\|'*,;.:-_<>"},
    {"se", "+',.-<", "!\"#%&/()=+?'*,;.:-_<>"},
    {"dk", "+',.-<", "!\"#%&/()=+?'*,;.:-_<>"},
    {"ru", "-=\\./", "!\";%:?*()-_=+\\/.,|"},
};

static bool is_punctuation(int key) { return key < KEY_ESCAPE && key != KEY_SPACE && !isalnum(key); }

/// Whether a command can be reached: its key is on the layout, or it has none.
static bool is_reached(const struct command *command, const struct layout_of *layout)
{
    const struct chord *c = &command->chord;
    return !is_punctuation(c->key) || strchr(c->mods & CHORD_TYPED ? layout->typed : layout->printed, c->key);
}

TEST(test_every_layout_has_a_key_for_every_command)
{
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++) {
        for (int c = 0; c < command_count; c++) {
            if (!is_reached(&commands[c], &layouts[i]))
                fail_msg("%s has no key for “%s”", layouts[i].name, commands[c].name);
        }
    }
}

TEST(test_no_key_is_bound_twice)
{
    for (int c = 0; c < command_count; c++) {
        const struct chord *chord = &commands[c].chord;
        if (!chord->key) continue;
        if (keys_command(chord->key, chord->mods) != &commands[c])
            fail_msg("%s with modifiers %u is bound twice", key_name(chord->key), chord->mods);
        assert_true(!is_punctuation(chord->key) || chord->mods); // it would act once more when its character comes
    }
}

static const char three_knots[] =
    "{'frames': [0, 96], 'splines': [{'name': 'sway', 'frequency': 0.5, 'damping': 0.01, 'knots': [{'frame': 0, "
    "'value': 0}, {'frame': 36, 'value': 1}, {'frame': 60, 'value': 0}]}], 'rigs': [{'type': 'tail', 'name': 'tail', "
    "'spline': 'sway'}]}";

/// AZERTY has - on the key of the 6, and needs Shift for 1, 5 and the point.
SESSION_TEST(test_a_factor_is_what_is_typed, session_open(s, three_knots))
{
    static const int struck[][2] = {{'6', '-'}, {'1', '1'}, {';', '.'}, {'7', '7'}, {KEY_BACKSPACE, 0}, {'5', '5'}};
    hands(s, "key Ctrl+A");
    session_type(s, "sy");
    for (int i = 0; i < 6; i++) {
        if (!struck[i][1]) session_key(s, struck[i][0], 0);
        if (struck[i][1]) session_strike(s, struck[i][0], i == 0 ? 0 : MOD_SHIFT, (uint32_t)struck[i][1]);
    }
    hands(s, "key Enter; is splines.0.knots.0.value 1.25 ~1e-9; is splines.0.knots.1.value -0.25 ~1e-9");
}

/// On AZERTY, too. A key kept down is one press where it should be.
SESSION_TEST(test_punctuation_is_what_is_typed, session_open(s, three_knots))
{
    session_strike(s, '6', 0, '-'); // AZERTY
    hands(s, "is speed 0.5");
    session_strike(s, '=', MOD_SHIFT, '+');
    hands(s, "is speed 1");
    session_strike(s, ';', MOD_SHIFT, '.'); // AZERTY
    hands(s, "is selected 1; key Shift+PageDown; is selected 2; seek 20; key Ctrl+Home; seek 50; key Ctrl+End");
    assert_true(plays_part(s->editor));
    assert_near(playback_of(s->editor)->range[0], 20, 0);
    assert_near(playback_of(s->editor)->range[1], 50, 0);
    session_hold(s, '6', ACTION_PRESS);
    for (int i = 0; i < 3; i++) {
        session_send(s, (struct event){.kind = EVENT_TEXT, .codepoint = '-'});
        session_frame(s);
        session_hold(s, '6', ACTION_REPEAT);
    }
    hands(s, "is speed 0.5");
}

TEST(test_a_key_kept_down_goes_on_through_the_splines)
{
    for (int down = 0; down < 2; down++) {
        struct session s;
        session_open(&s, "{'frames': [0, 96], 'splines': [{'name': 'a', 'knots': []}, {'name': 'b', 'knots': "
                         "[]}, {'name': 'c', 'knots': []}]}");
        for (int i = 1; i <= 3; i++) {
            session_hold(&s, down ? KEY_PAGE_DOWN : KEY_PAGE_UP, i > 1 ? ACTION_REPEAT : ACTION_PRESS);
            session_frame(&s);
            hands(&s, "is active %d", down ? i % 3 : 3 - i);
        }
        session_close(&s);
    }
}

SESSION_TEST(test_a_key_that_opens_something_types_nothing, session_open(s, three_knots))
{
    session_type(s, "a"); // the menu of what can be added
    assert_int_equal(inspector_of(s->editor)->popup.filter.typed[0], '\0');
    session_type(s, "tai");
    hands(s, "key Enter; is rigs.# 2; is rigs.1.type tail");
}

// --- nothing needs a mouse: what it does to selection, views, panels and warnings, the keyboard does too ------------------------

/// There is nothing before the first.
SESSION_TEST(test_the_selection_grows_by_neighbours, session_open(s, three_knots))
{
    static const struct {
        const char *keys, *selected; ///< a letter a knot
    } rows[] = {
        {"Shift+PageDown", "-x-"}, {"Shift+PageUp", "xx-"}, {"Shift+PageDown", "xxx"}, {"3*Shift+PageUp", "xxx"}};
    hands(s, "key Shift+Left"); // to the first frame
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        hands(s, "key %s", rows[i].keys);
        for (int k = 0; k < 3; k++) {
            const bool is = selection_has(selection_of(s->editor), s->document->splines[0]->knots[k].id);
            if (is != (rows[i].selected[k] == 'x')) fail_msg("row %zu, %s: knot %d", i, rows[i].keys, k);
        }
    }
}

SESSION_TEST(test_curves_camera_and_panels, session_open(s, three_knots))
{
    const struct layout *layout = layout_of(s->editor), first = *layout;
    const struct camera before = *camera_of(s->editor);
    hands(s, "keep plot.left; keep plot.right; keep plot.bottom; keep plot.top;"
             "key Ctrl+Right Ctrl+Up; is plot.left > kept; is plot.bottom > kept;"
             "key Ctrl+Left Ctrl+Down; is plot.left kept ~1e-3; is plot.top kept ~1e-3");
    const double width = number(s, "plot.right") - number(s, "plot.left");
    hands(s, "key Ctrl+PageUp");
    assert_near(number(s, "plot.right") - number(s, "plot.left"), 0.8 * width, 1e-3);
    hands(
        s,
        "key Ctrl+PageDown; is plot.right kept ~1e-3;"
        "keep camera.azimuth; keep camera.elevation; keep camera.distance;"
        "key Ctrl+Shift+Right Ctrl+Shift+Up Ctrl+Shift+PageUp; is camera.azimuth > kept; is camera.elevation > kept;"
        "is camera.distance < kept; key Shift+Home");
    assert_memory_equal(&before, camera_of(s->editor), sizeof before);
    hands(s, "key F6 Shift+F6");
    assert_true(layout->stage_share > first.stage_share && layout->inspector_width > first.inspector_width);
    hands(s, "key F6 Shift+F6");
    assert_true(layout->stage_share < first.stage_share);
    assert_true(layout->inspector_width < 480 && layout->inspector_width > first.inspector_width);
}

/// A jump within two frames.
WALK(test_a_warning_is_done_away_with,
     panel_open(s,
                "{'frames': [0, 72], 'splines': [{'name': 'sway', 'frequency': 1, 'damping': 0.05, 'bandwidth': "
                "0.05, 'knots': "
                "[{'frame': 10, 'value': 0}, {'frame': 12, 'value': 1}, {'frame': 24, 'value': 1}]}]}",
                1280, 720),
     "is warnings 1; key W; wait; is warnings 0; key Ctrl+Z; is warnings 1")

/// Whether a line of the accent's colour, as the focus is drawn, lies around a widget or the part of it that is set.
static bool is_ringed(const struct session *s, struct rect r)
{
    const struct drawlist *list = drawn_by(s->editor);
    for (int i = 0; i < list->count; i++) {
        const struct draw_command *c = &list->commands[i];
        const struct rect both = rect_intersect(c->bounds, r);
        const bool around = both.w * both.h > 0.6f * fminf(r.w * r.h, c->bounds.w * c->bounds.h);
        const bool near = c->bounds.h < r.h + 20; // a handle has a ring of 18 pixels
        if (c->kind == DRAW_LINE && c->color == theme()->accent && around && near) return true;
    }
    return false;
}

static void assert_ringed(const struct session *s, const struct ui *ui)
{
    int i = 0;
    while (i < ui->stop_count && ui->stop[i].id != ui->focus) i++;
    if (i == ui->stop_count) fail_msg("what has the focus is not shown");
    const struct rect r = ui->stop[i].rect;
    if (!is_ringed(s, r))
        fail_msg("what is at %g, %g and %g × %g has no ring", (double)r.x, (double)r.y, (double)r.w, (double)r.h);
}

/// Goes round with Tab, and sees the focus wherever it is: each stop once, and after the last comes the first.
static void assert_goes_round(struct session *s)
{
    const struct ui *ui = inspector_of(s->editor);
    int count = 0;
    panel_unfold(s);
    hands(s, "key Tab; wait");
    const int stops = ui->stop_count; // with those that the active row has for the keyboard
    assert_true(stops > 60 && stops < UI_MAX_FOCUS);
    const uint32_t first = ui->focus;
    do {
        assert_ringed(s, ui);
        hands(s, "key Tab");
    } while (++count < UI_MAX_FOCUS && ui->focus != first);
    assert_int_equal(count, stops);
}

/// A knot is selected, so that its fields are there. The start scene has a spline with the name of a button: up. A tail and a character
/// have each their own switches for onion skin, motion arc and ghost.
TEST(test_tab_goes_round)
{
    static const char both[] =
        "{'frames': [0, 48], 'splines': [{'name': 'down', 'knots': [{'frame': 9, 'value': 1}]}], 'rigs': [{'type': "
        "'tail', 'name': 'tail', 'spline': 'down'}, {'type': 'character', 'model': 'none.glb', 'coordinates': "
        "[{'name': 'a', 'spline': 'down'}]}]}";
    for (int i = 0; i < 3; i++) {
        struct session s;
        if (i == 0) session_open_file(&s, "assets/scenes/tail.json");
        if (i > 0) session_open(&s, i == 1 ? both : three_knots);
        if (i == 2) hands(&s, "click knot(sway,1)");
        assert_goes_round(&s);
        session_close(&s);
    }
}
