/// The verbs of walks: what a hand does, and what is to be seen after it.
#include "walks.h"

#include "export/export.h"
#include <jansson.h>

static const char *step; ///< as written, for failures

// --- asking -----------------------------------------------------------------------------------------------------------------

/// A member of the document by its path: names and indices with points between them; # is a list's length.
static bool find_saved(struct session *s, const char *path, char text[512])
{
    char *const saved = text_of_document(s->document);
    json_t *const root = json_loads(saved, 0, NULL), *value = root;
    assert_non_null(root);
    free(saved);
    text[0] = '\0';
    while (value && *path) {
        char name[64];
        const size_t length = strcspn(path, ".");
        snprintf(name, sizeof name, "%.*s", (int)length, path);
        if (name[0] == '#') sprintf(text, "%zu", json_array_size(value));
        value = json_is_array(value) ? json_array_get(value, (size_t)atoi(name)) : json_object_get(value, name);
        path += length + (path[length] == '.');
        if (name[0] == '#') value = NULL;
    }
    if (json_is_number(value)) snprintf(text, 512, "%.17g", json_number_value(value));
    if (json_is_string(value)) snprintf(text, 512, "%s", json_string_value(value));
    if (json_is_boolean(value)) snprintf(text, 512, "%s", json_is_true(value) ? "true" : "false");
    if (json_is_array(value) || json_is_object(value)) snprintf(text, 512, "list");
    json_decref(root);
    return text[0] != '\0';
}

/// In the order of enum dialog_kind.
static const char *const dialogs[] = {"none",    "open",    "add", "save-as", "unsaved",
                                      "recover", "changed", "ask", "export"};
static const char *const lookups[] = {"none", "keys", "palette"};
static const char *const looks[] = {[LOOK_WIGGLY] = "wiggly", [LOOK_STIFF] = "stiff", [LOOK_CUBIC] = "cubic"};
static const char *const cursors[] = {"arrow", "hand", "horizontal", "vertical", "move", "text"};

/// What a name means now, as text; false: nothing has it.
static bool find(struct session *s, const char *name, char text[512])
{
    struct editor *e = s->editor;
    const char *undo = history_undo_label(s->history);
    int model;
    const int at = active(e), node = bones_selected(&e->core, &model);
    const struct {
        const char *name, *text;
    } texts[] = {{"active.name", at < 0 ? "none" : s->document->splines[at]->name},
                 {"asked", dialogs[asked(e)]},
                 {"bone", node < 0 ? "" : bones_character(&e->core, model)->gltf.nodes[node].name},
                 {"cursor", cursors[editor_cursor(e)]},
                 {"export.ending", export_formats[e->dialogs->exporting.format].ending},
                 {"export.path", e->dialogs->exporting.memory.path},
                 {"field", inspector_of(e)->text.bytes},
                 {"hint", inspector_of(e)->hint ? inspector_of(e)->hint : "nothing"},
                 {"hovered", hovered(e) ? "a thing" : "nothing"},
                 {"look", looks[look(e)]},
                 {"lookup", lookups[lookup_of(e)->kind]},
                 {"refused", asked_error(e)},
                 {"said", said(e)},
                 {"typed", typed(e)},
                 {"undo", undo ? undo : "nothing"}};
    const struct {
        const char *name;
        double number;
    } numbers[] = {{"active", at},
                   {"body.x", posed(e)->matrix[0][12]},
                   {"body.y", posed(e)->matrix[0][13]},
                   {"body.z", posed(e)->matrix[0][14]},
                   {"camera.azimuth", camera_of(e)->azimuth},
                   {"camera.distance", camera_of(e)->distance},
                   {"camera.elevation", camera_of(e)->elevation},
                   {"channel", e->inspector->channel},
                   {"choice", dialog_of(e)->choice},
                   {"curves.others", e->curves->cache.other_count},
                   {"export.keys", e->dialogs->exporting.memory.wish.keys},
                   {"frame", shown_frame(e)},
                   {"history.done", (double)history_done(s->history)},
                   {"history.saved", history_is_saved(s->history)},
                   {"matches", dialog_of(e)->match_count},
                   {"onion", is_on(e, SWITCH_ONION)},
                   {"open", history_is_open(s->history)},
                   {"playing", playback_of(e)->playing},
                   {"plot.bottom", plot_of(e)->value0},
                   {"plot.left", plot_of(e)->frame0},
                   {"plot.right", plot_of(e)->frame1},
                   {"plot.top", plot_of(e)->value1},
                   {"popup", inspector_of(e)->popup.id != 0},
                   {"position", playback_of(e)->position},
                   {"recent", dialog_of(e)->recent_count},
                   {"record", is_on(e, SWITCH_RECORD)},
                   {"rig", e->inspector->rig},
                   {"scrolled", sections(e)->offset},
                   {"selected", selected(e)},
                   {"sliding", inspector_is_dragging(e->inspector)},
                   {"speed", playback_of(e)->speed},
                   {"stage.characters", editor_stage(e)->character_count},
                   {"stage.tails", e->stage->tail_count},
                   {"tip.behind", posed(e)->matrix[24][12] - posed(e)->matrix[0][12]},
                   {"trail", is_on(e, SWITCH_TRAIL)},
                   {"typing", inspector_of(e)->typing != 0},
                   {"welcoming", is_welcoming(e)},
                   {"wants.frames", editor_wants_frames(e)},
                   {"warnings", warnings_of(e)->count}};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        if (strcmp(name, texts[i].name) == 0) return snprintf(text, 512, "%s", texts[i].text) >= 0;
    }
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        if (strcmp(name, numbers[i].name) == 0) return snprintf(text, 512, "%.17g", numbers[i].number) > 0;
    }
    float x, y;
    if (strncmp(name, "y:", 2) == 0)
        return widget_at(e, name + 2, &x, &y) && snprintf(text, 512, "%.9g", (double)y) > 0;
    if (strncmp(name, "curve:", 6) == 0)
        return snprintf(text, 512, "%d", spline_list_shows(&e->core, atoi(name + 6))) > 0;
    return find_saved(s, name, text);
}

double number(struct session *s, const char *name)
{
    char text[512];
    return find(s, name, text) ? strtod(text, NULL) : NAN;
}

static struct {
    char name[64];
    double number;
} kept[8];

/// "keep NAME": the number for "is NAME kept" and so on.
static void keep(struct session *s, const char *what)
{
    int i = 0;
    while (i < 7 && kept[i].name[0] && strcmp(kept[i].name, what) != 0) i++;
    snprintf(kept[i].name, sizeof kept[i].name, "%s", what);
    kept[i].number = number(s, what);
}

/// A number, or what was kept of a name and a number to add.
static double wanted_number(const char *name, const char *text, char **end)
{
    if (strncmp(text, "kept", 4) != 0) return strtod(text, end);
    for (int i = 0; i < 8; i++) {
        *end = (char *)(uintptr_t)text + 4;
        if (strcmp(kept[i].name, name) == 0) return kept[i].number + (**end ? strtod(text + 4, end) : 0);
    }
    fail_msg("“%s”: nothing was kept of it", step);
    return NAN;
}

/// "is NAME VALUE": a text, or a number; of numbers also >VALUE, <VALUE and VALUE±TOLERANCE.
/// "is NAME" alone: it is empty; "is NAME nothing": the document has none.
static void is(struct session *s, const char *what)
{
    char name[128] = "", text[512], *end, *end_of_text;
    int used = 0;
    sscanf(what, "%127s %n", name, &used);
    const char *expected = what + used, *tolerance = strstr(expected, "±");
    const bool found = find(s, name, text), compares = *expected == '>' || *expected == '<';
    const double wanted = wanted_number(name, expected + compares, &end), value = strtod(text, &end_of_text);
    const bool is_number = found && *text && !*end_of_text;
    if (compares && is_number && (*expected == '>' ? value > wanted : value < wanted)) return;
    if (tolerance && is_number && fabs(value - wanted) <= strtod(tolerance + strlen("±"), NULL)) return;
    if (!tolerance && is_number && *expected && !*end && value == wanted) return;
    if (strcmp(found ? text : "nothing", expected) == 0) return;
    fail_msg("“%s”: it is “%s”", step, found ? text : "nothing");
}

static void shows(struct session *s, const char *what)
{
    if (!panel_shows(s, what)) fail_msg("“%s”: the inspector does not", step);
}

static void lacks(struct session *s, const char *what)
{
    if (panel_shows(s, what)) fail_msg("“%s”: the inspector shows it", step);
}

static void reads(struct session *s, const char *what)
{
    if (!shown_text(s->editor, what)) fail_msg("“%s”: it is not on the screen", step);
}

static void hides(struct session *s, const char *what)
{
    if (shown_text(s->editor, what)) fail_msg("“%s”: it is on the screen", step);
}

/// The first drawn text that has these words in it, or NULL.
static const char *mentioned(struct session *s, const char *what)
{
    const struct drawlist *list = drawn_by(s->editor);
    for (int i = 0; i < list->count; i++) {
        const struct draw_command *c = &list->commands[i];
        if (c->kind == DRAW_TEXT && strstr(list->text + c->first, what)) return list->text + c->first;
    }
    return NULL;
}

static void mentions(struct session *s, const char *what)
{
    if (!mentioned(s, what)) fail_msg("“%s”: no text on the screen does", step);
}

static void ignores(struct session *s, const char *what)
{
    const char *text = mentioned(s, what);
    if (text) fail_msg("“%s”: “%s” is on the screen", step, text);
}

static void says(struct session *s, const char *what) { assert_said(s->editor, what); }
static void errs(struct session *s, const char *what) { assert_said_error(s->editor, what); }

static void has(struct session *s, const char *what)
{
    if (!strstr(session_saved(s), quoted(what))) fail_msg("“%s”: the scene does not", step);
}

static void unchanged(struct session *s)
{
    if (strcmp(session_saved(s), s->mark) != 0) fail_msg("“%s”: the scene has changed", step);
}

// --- hands ------------------------------------------------------------------------------------------------------------------

static void key(struct session *s, const char *what)
{
    static const struct {
        const char *name;
        unsigned mod;
    } mods[] = {{"Ctrl+", MOD_CTRL}, {"Shift+", MOD_SHIFT}, {"Alt+", MOD_ALT}};
    char word[32];
    for (int used; sscanf(what, "%31s %n", word, &used) == 1; what += used) {
        const char *name = word;
        char *times = strchr(word + 1, '*');
        unsigned with = 0;
        for (int i = 0; i < 3; i++) {
            if (strncmp(name, mods[i].name, strlen(mods[i].name)) != 0) continue;
            name += strlen(mods[i].name);
            with |= mods[i].mod;
        }
        if (times) *times++ = '\0';
        const int code = key_from_name(name);
        if (code == KEY_NONE) fail_msg("“%s”: there is no key %s", step, name);
        for (int n = times ? atoi(times) : 1; n > 0; n--) session_key(s, code, with);
    }
}

static void type(struct session *s, const char *what) { panel_type(s, what); }
static void click(struct session *s, const char *what) { panel_click(s, what); }
static void press(struct session *s, const char *what) { panel_press(s, what, 1); }
static void on(struct session *s, const char *what) { session_click(s, what); }
static void over(struct session *s, const char *what) { session_hover(s, what); }

/// "wheel NOTCHES*TIMES".
static void wheel(struct session *s, const char *what)
{
    const char *times = strchr(what, '*');
    for (int n = times ? atoi(times + 1) : 1; n > 0; n--) session_wheel(s, strtof(what, NULL));
}

/// Goes on with Tab until a widget has the focus.
static void tab(struct session *s, const char *what)
{
    const struct ui *ui = inspector_of(s->editor);
    for (int i = 0; i < UI_MAX_FOCUS && (!ui->focus || ui->focus != panel_id(s, what)); i++)
        session_key(s, KEY_TAB, 0);
    if (!ui->focus || ui->focus != panel_id(s, what)) fail_msg("“%s”: Tab does not reach it", step);
}

static void twice(struct session *s, const char *what)
{
    panel_press(s, what, 2);
    session_release(s, BUTTON_LEFT);
}

/// A widget's or target's name, and numbers after it.
struct way {
    char name[128];
    double to[3];
};

static struct way way_of(const char *what)
{
    struct way way = {.to = {0, 0, 4}};
    if (sscanf(what, "%127s %lf %lf %lf", way.name, &way.to[0], &way.to[1], &way.to[2]) < 2)
        fail_msg("“%s”: expected numbers", step);
    return way;
}

static void enter(struct session *s, const char *what)
{
    char name[128];
    int used = 0;
    sscanf(what, "%127s %n", name, &used);
    panel_enter(s, name, what + used);
}

static void slide(struct session *s, const char *what)
{
    const struct way way = way_of(what);
    panel_drag(s, way.name, way.to[0]);
}

static void pull(struct session *s, const char *what)
{
    const struct way way = way_of(what);
    panel_pull(s, way.name, (float)way.to[0], (float)way.to[1], (int)way.to[2]);
}

static void hold(struct session *s, const char *what)
{
    const struct way way = way_of(what);
    session_pull(s, way.name, (float)way.to[0], (float)way.to[1], (int)way.to[2]);
}

static void carry(struct session *s, const char *what)
{
    hold(s, what);
    session_release(s, BUTTON_LEFT);
}

static void by(struct session *s, const char *what)
{
    float x, y;
    int moves = 4;
    if (sscanf(what, "%f %f %d", &x, &y, &moves) < 2) fail_msg("“%s”: expected two numbers", step);
    session_drag(s, x, y, moves);
}

static void at(struct session *s, const char *what)
{
    float x, y;
    if (sscanf(what, "%f %f", &x, &y) != 2) fail_msg("“%s”: expected two numbers", step);
    session_move(s, x, y);
    session_frame(s);
}

/// Moves the pointer to a widget.
static void point(struct session *s, const char *what)
{
    float x, y;
    shows(s, what);
    widget_at(s->editor, what, &x, &y);
    session_move(s, x, y);
    session_frame(s);
}

static void tap_times(struct session *s, const char *what, int clicks)
{
    const struct draw_command *text = shown_text(s->editor, what);
    if (!text) fail_msg("“%s”: it is not on the screen", step);
    session_move(s, text->x + 4, text->y - 4);
    for (int i = 1; i <= clicks; i++) session_click_here(s, i);
}

/// Clicks on a text, wherever it is drawn.
static void tap(struct session *s, const char *what) { tap_times(s, what, 1); }
static void tap_twice(struct session *s, const char *what) { tap_times(s, what, 2); }

static void frames(struct session *s, const char *what)
{
    for (int n = *what ? atoi(what) : 1; n > 0; n--) session_frame(s);
}

static void seek_it(struct session *s, const char *what) { seek(s->editor, strtod(what, NULL)); }
static void more(struct session *s, const char *what)
{
    show_more(s->editor, strcmp(what, "off") != 0);
    session_frame(s);
}

// --- the app ----------------------------------------------------------------------------------------------------------------

static enum request_kind request_named(const char *what, const char **rest)
{
    static const struct {
        const char *name;
        enum request_kind kind;
    } all[] = {{"nothing", REQUEST_NONE},
               {"open", REQUEST_OPEN},
               {"add", REQUEST_ADD},
               {"save", REQUEST_SAVE},
               {"save-as", REQUEST_SAVE_AS},
               {"quit", REQUEST_QUIT},
               {"recover", REQUEST_RECOVER},
               {"forget", REQUEST_FORGET},
               {"export", REQUEST_EXPORT},
               {"stop", REQUEST_EXPORT_STOP},
               {"screenshot", REQUEST_SCREENSHOT}};
    const size_t length = strcspn(what, " ");
    *rest = what + length + (what[length] == ' ');
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        if (strlen(all[i].name) == length && strncmp(all[i].name, what, length) == 0) return all[i].kind;
    }
    fail_msg("“%s”: there is no such request", step);
    return REQUEST_NONE;
}

/// "asks KIND PATH": the app was asked for this since the last one.
static void asks(struct session *s, const char *what)
{
    const char *path;
    const enum request_kind kind = request_named(what, &path);
    const struct request request = session_asked(s);
    if (request.kind != kind || strcmp(request.path, path) != 0)
        fail_msg("“%s”: it was asked for %d “%s”", step, (int)request.kind, request.path);
}

/// "answer KIND": it is done; "answer KIND WORDS": why it is not.
static void answer(struct session *s, const char *what)
{
    const char *words;
    const enum request_kind kind = request_named(what, &words);
    panel_answer(s, kind, !*words, words);
}

/// The app names the document's file.
static void path(struct session *s, const char *what) { set_path(s->editor, what); }
static void tell_it(struct session *s, const char *what) { tell(s->editor, false, "%s", what); }

static const struct {
    const char *word;
    void (*takes)(struct session *s, const char *what);
} verbs[] = {{"answer", answer},       {"asks", asks},     {"at", at},        {"by", by},
             {"carry", carry},         {"click", click},   {"keep", keep},    {"mentions", mentions},
             {"ignores", ignores},     {"point", point},   {"seek", seek_it}, {"enter", enter},
             {"errs", errs},           {"frames", frames}, {"has", has},      {"hides", hides},
             {"hold", hold},           {"is", is},         {"key", key},      {"lacks", lacks},
             {"more", more},           {"on", on},         {"over", over},    {"path", path},
             {"press", press},         {"pull", pull},     {"reads", reads},  {"says", says},
             {"shows", shows},         {"slide", slide},   {"tab", tab},      {"tap", tap},
             {"tap-twice", tap_twice}, {"tell", tell_it},  {"twice", twice},  {"type", type},
             {"wheel", wheel}};

/// A sentence of one word; false: there is no such.
static bool take_word(struct session *s, const char *word)
{
    static const struct recovery_offer unsaved = {"walk.json", "21 November 2026, 10:00:00", 1};
    const bool undone = strcmp(word, "undone") == 0; // all of it, which gives what there was at the mark
    while (undone && history_undo_label(s->history)) session_key(s, 'Z', MOD_CTRL);
    if (undone || strcmp(word, "unchanged") == 0)
        unchanged(s);
    else if (strcmp(word, "step") == 0) // all since the mark is one
        assert_one_step(s, s->mark);
    else if (strcmp(word, "mark") == 0)
        s->mark = session_saved(s);
    else if (strcmp(word, "release") == 0)
        session_release(s, BUTTON_LEFT);
    else if (strcmp(word, "close") == 0)
        session_send(s, (struct event){.kind = EVENT_CLOSE});
    else if (strcmp(word, "opened") == 0) // by the app
        editor_open(s->editor, &s->world);
    else if (strcmp(word, "offer") == 0)
        offer_recovery(s->editor, &unsaved);
    else if (strcmp(word, "welcome") == 0)
        welcome(s->editor);
    else
        return false;
    if (strcmp(word, "offer") == 0 || strcmp(word, "welcome") == 0) session_frame(s);
    return true;
}

static void take(struct session *s, char *sentence)
{
    const size_t length = strcspn(sentence, " ");
    const bool alone = sentence[length] == '\0';
    step = sentence;
    if (alone && take_word(s, sentence)) return;
    for (size_t i = 0; i < sizeof verbs / sizeof *verbs; i++) {
        if (strlen(verbs[i].word) != length || strncmp(verbs[i].word, sentence, length) != 0) continue;
        verbs[i].takes(s, sentence + length + !alone);
        return;
    }
    fail_msg("“%s”: there is no such verb", sentence);
}

void walk(struct session *s, const char *steps, ...)
{
    char text[4096], *sentence = text;
    va_list arguments;
    va_start(arguments, steps);
    const int size = vsnprintf(text, sizeof text, steps, arguments);
    va_end(arguments);
    assert_in_range(size, 0, sizeof text - 1);
    if (!s->mark) { // the first walk of this session
        s->mark = session_saved(s);
        memset(kept, 0, sizeof kept);
    }
    while (*sentence) {
        const size_t length = strcspn(sentence, ";");
        const bool more_follow = sentence[length] == ';';
        sentence[length] = '\0';
        sentence += strspn(sentence, " ");
        if (*sentence) take(s, sentence);
        sentence += strlen(sentence) + more_follow;
    }
}

const char *quoted(const char *scene)
{
    static char texts[4][16384];
    static int next;
    char *text = texts[next = (next + 1) % 4];
    assert_true(strlen(scene) < sizeof *texts);
    for (size_t i = 0; i <= strlen(scene); i++) text[i] = scene[i] == '\'' ? '"' : scene[i];
    return text;
}
