/// Reads and writes replays, and parses their events.
#include "app/replay.h"
#include "base/file.h"
#include "base/need.h"
#include <ctype.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <wiggly/wiggly.h>

enum { MAX_REPLAY = 64 << 20, MAX_WORDS = 16, MIN_PIXELS = 64, MAX_PIXELS = 16384, MAX_FRAMES = 10000000 };

static const char first_line[] = "wiggly-replay 1";
static const char size_limits[] = "a width and a height from 64 to 16384";

struct replay {
    char *path, *text, *end;
    char *at;    ///< unread text
    int number;  ///< of the last line read
    char *event; ///< line of the next event, or NULL
    int line;    ///< current line, for messages
    struct replay_header header;
};

/// A line, split in place.
struct words {
    char *word[MAX_WORDS];
    int count;
};

static bool bad_line(const struct replay *replay, struct error *error, const char *expected, const char *got)
{
    return fail(error, ERROR_INPUT, "%s:%d: expected %s, got %s%.80s%s", replay->path, replay->line, expected,
                got ? "\"" : "", got ? got : "the end of the line", got ? "\"" : "");
}

/// The next line that is neither blank nor a `#` comment, or NULL.
static char *next_line(struct replay *replay)
{
    while (replay->at < replay->end) {
        char *line = replay->at, *end = line + strlen(line);
        replay->at = end + 1;
        replay->number++;
        line += strspn(line, " \t\r\v\f");
        while (end > line && isspace((unsigned char)end[-1])) *--end = '\0';
        if (*line && *line != '#') return line;
    }
    return NULL;
}

/// Splits at spaces, except inside a target's brackets.
static struct words split(char *line)
{
    struct words words = {0};
    int depth = 0;
    bool inside = false;
    for (; *line; line++) {
        depth += *line == '(' ? 1 : *line == ')' && depth > 0 ? -1 : 0;
        if (depth == 0 && isspace((unsigned char)*line)) {
            *line = '\0';
            inside = false;
        } else if (!inside && words.count < MAX_WORDS) {
            inside = true;
            words.word[words.count++] = line;
        }
    }
    return words;
}

static bool read_number(const char *word, double *value)
{
    char *end;
    if (!word) return false;
    *value = strtod(word, &end);
    return end != word && !*end && isfinite(*value);
}

static bool is_size(double width, double height)
{
    return fmin(width, height) >= MIN_PIXELS && fmax(width, height) <= MAX_PIXELS;
}

static bool read_header(struct replay *replay, struct error *error)
{
    struct replay_header *h = &replay->header;
    const char *first = next_line(replay);
    replay->line = replay->number;
    if (!first || strcmp(first, first_line) != 0) return bad_line(replay, error, "\"wiggly-replay 1\"", first);
    while ((replay->event = next_line(replay)) && !isdigit((unsigned char)*replay->event)) {
        const struct words words = split(replay->event), *w = &words;
        const char *name = w->word[0];
        double a = 0, b = 0;
        const bool one = w->count > 1 && read_number(w->word[1], &a);
        const bool two = one && w->count > 2 && read_number(w->word[2], &b);
        replay->line = replay->number;
        if (strcmp(name, "size") == 0) {
            if (!two || !is_size(a, b)) return bad_line(replay, error, size_limits, w->word[1]);
            h->width = (int)a, h->height = (int)b;
        } else if (strcmp(name, "scale") == 0 || strcmp(name, "ui-scale") == 0) {
            if (!one || a < 0.25 || a > 8) return bad_line(replay, error, "a scale from 0.25 to 8", w->word[1]);
            *(name[0] == 's' ? &h->scale : &h->ui_scale) = a;
        } else if (strcmp(name, "scene") == 0) {
            if (w->count < 2 || sscanf(w->word[1], "%16" SCNx64, &h->scene_hash) != 1)
                return bad_line(replay, error, "the scene's hash", w->word[1]);
        } else if (strcmp(name, "dt") == 0) {
            if (w->count < 2 || strcmp(w->word[1], "1/60") != 0)
                return bad_line(replay, error, "dt 1/60", w->word[1]);
        } else if (strcmp(name, "frames") == 0) {
            const bool whole = one && a >= 0 && a <= MAX_FRAMES && a == floor(a);
            if (!whole) return bad_line(replay, error, "a number of frames up to 10000000", w->word[1]);
            h->frames = (long)a;
        } else if (strcmp(name, "version") != 0) {
            return bad_line(replay, error, "version, size, scale, ui-scale, scene, dt, frames or an event", name);
        }
    }
    replay->line = replay->number;
    if (h->width > 0 && h->frames >= 0) return true;
    return fail(error, ERROR_INPUT, "%s:%d: expected a header with size and frames", replay->path, replay->line);
}

struct replay *replay_parse(const char *name, const char *text, size_t size, struct error *error)
{
    struct replay *replay = need_zeroed(1, sizeof *replay);
    *replay = (struct replay){.path = need_text(name), .header = {.scale = 1, .ui_scale = 1, .frames = -1}};
    replay->text = replay->at = memcpy(need_zeroed(size + 1, 1), text, size);
    replay->end = replay->text + size;
    const bool whole =
        strlen(replay->text) == size || fail(error, ERROR_INPUT, "%s: expected text, got a NUL byte", name);
    for (char *end = replay->text; (end = strchr(end, '\n'));) *end++ = '\0';
    bool good = whole && read_header(replay, error);

    // Frames must be in order and within the length, before the replay starts. A recording cut short has length 0 and ends with its last event.
    char *const at = replay->at;
    const int number = replay->number;
    long last = 0, limit = replay->header.frames ? replay->header.frames : MAX_FRAMES;
    for (char *line = replay->event; good && line; line = next_line(replay)) {
        char *end;
        const long frame = strtol(line, &end, 10);
        good = end > line && isspace((unsigned char)*end) && frame >= last && frame < limit;
        if (!good)
            fail(error, ERROR_INPUT, "%s:%d: expected an event in a frame from %ld to %ld, got \"%.40s\"", name,
                 replay->number, last, limit - 1, split(line).word[0]);
        if (good) last = frame;
    }
    if (replay->header.frames == 0) replay->header.frames = last + 1;
    replay->at = at;
    replay->number = number;
    if (good) return replay;
    replay_destroy(replay);
    return NULL;
}

struct replay *replay_load(const char *path, struct error *error)
{
    char *text;
    size_t size;
    if (!file_read_text(path, MAX_REPLAY, &text, &size, error)) return NULL;
    struct replay *replay = replay_parse(path, text, size, error);
    free(text);
    return replay;
}

void replay_destroy(struct replay *replay)
{
    if (!replay) return;
    free(replay->path);
    free(replay->text);
    free(replay);
}

const struct replay_header *replay_get_header(const struct replay *replay) { return &replay->header; }

static const char *const button_names[] = {
    [BUTTON_LEFT] = "left", [BUTTON_RIGHT] = "right", [BUTTON_MIDDLE] = "middle"};

static const struct {
    const char *name;
    unsigned mod;
} mod_names[] = {{"shift", MOD_SHIFT}, {"ctrl", MOD_CTRL}, {"alt", MOD_ALT}, {"super", MOD_SUPER}};

enum { MOD_COUNT = sizeof mod_names / sizeof mod_names[0] };

/// What follows an event's verb.
enum operands {
    WITH_KEY = 1,
    WITH_BUTTON = 2,
    WITH_POSITION = 4,
    WITH_WHEEL = 8,
    WITH_CODE = 16,
    WITH_PATH = 32,
    WITH_MODS = 64,
    WITH_TEXT = 128
};

static const struct verb {
    const char *name;
    enum event_kind kind;
    enum event_action action;
    int clicks;
    unsigned operands;
} verbs[] = {
    {"pointer", EVENT_POINTER, ACTION_PRESS, 0, WITH_POSITION | WITH_MODS},
    {"press", EVENT_BUTTON, ACTION_PRESS, 1, WITH_BUTTON | WITH_POSITION | WITH_MODS},
    {"double", EVENT_BUTTON, ACTION_PRESS, 2, WITH_BUTTON | WITH_POSITION | WITH_MODS},
    {"release", EVENT_BUTTON, ACTION_RELEASE, 0, WITH_BUTTON | WITH_POSITION | WITH_MODS},
    {"key", EVENT_KEY, ACTION_PRESS, 0, WITH_KEY | WITH_MODS},
    {"repeat", EVENT_KEY, ACTION_REPEAT, 0, WITH_KEY | WITH_MODS},
    {"keyup", EVENT_KEY, ACTION_RELEASE, 0, WITH_KEY | WITH_MODS},
    {"text", EVENT_TEXT, ACTION_PRESS, 0, WITH_CODE},
    {"wheel", EVENT_WHEEL, ACTION_PRESS, 0, WITH_WHEEL | WITH_POSITION | WITH_MODS},
    {"size", EVENT_SIZE, ACTION_PRESS, 0, WITH_POSITION},
    {"drop", EVENT_DROP, ACTION_PRESS, 0, WITH_PATH},
    {"paste", EVENT_PASTE, ACTION_PRESS, 0, WITH_TEXT},
    {"close", EVENT_CLOSE, ACTION_PRESS, 0, 0},
};

enum { VERB_COUNT = sizeof verbs / sizeof verbs[0] };

/// A position in an event's words.
struct event_line {
    struct replay *replay;
    struct words words;
    int next;
    replay_locate *locate;
    void *user;
    struct error *error;
};

static char *take_word(struct event_line *c) { return c->next < c->words.count ? c->words.word[c->next++] : NULL; }

static bool read_float(struct event_line *c, float *value)
{
    char *word = take_word(c);
    double number;
    if (!read_number(word, &number) || !isfinite((float)number))
        return bad_line(c->replay, c->error, "a number", word);
    *value = (float)number;
    return true;
}

/// Two numbers, or "@knot(sway,2)+4,-3": the target's position now plus an offset in logical pixels.
static bool read_position(struct event_line *c, struct event *event)
{
    if (c->next == c->words.count || c->words.word[c->next][0] != '@')
        return read_float(c, &event->x) && read_float(c, &event->y);
    char *word = take_word(c), *end = strrchr(word, ')');
    if (!end) return bad_line(c->replay, c->error, "a target such as @knot(sway,2)", word);
    float dx = 0, dy = 0;
    if (end[1] && (sscanf(end + 1, "%f,%f", &dx, &dy) != 2 || !isfinite(dx) || !isfinite(dy))) {
        return bad_line(c->replay, c->error, "an offset such as +4,-3 behind the target", end + 1);
    }
    end[1] = '\0';
    struct error reason = {0};
    if (!c->locate(c->user, word + 1, &event->x, &event->y, &reason)) {
        return fail(c->error, ERROR_INPUT, "%s:%d: %s is not on the screen: %s", c->replay->path, c->replay->line,
                    word, reason.text);
    }
    event->x += dx;
    event->y += dy;
    return true;
}

/// Decodes %20, %25 and the like in place. They keep a text one word.
static bool read_escaped(struct event_line *c, const char *expected, const char **text)
{
    char *word = take_word(c), *out = word;
    *text = word;
    if (!word) return bad_line(c->replay, c->error, expected, word);
    while (*word) {
        unsigned code;
        bool escaped = *word == '%' && isxdigit((unsigned char)word[1]) && isxdigit((unsigned char)word[2]) &&
                       sscanf(word + 1, "%2x", &code) == 1 && code > 0;
        *out++ = escaped ? (char)code : *word;
        word += escaped ? 3 : 1;
    }
    *out = '\0';
    return true;
}

bool replay_next(struct replay *replay, long frame, replay_locate *locate, void *user, struct event *event,
                 struct error *error)
{
    if (!replay->event || strtol(replay->event, NULL, 10) > frame) return false;
    replay->line = replay->number;
    struct event_line c = {
        .replay = replay, .words = split(replay->event), .next = 1, .locate = locate, .user = user, .error = error};
    replay->event = next_line(replay);

    char *word = take_word(&c);
    int v = 0;
    while (word && v < VERB_COUNT && strcmp(word, verbs[v].name) != 0) v++;
    if (!word || v == VERB_COUNT) return bad_line(replay, error, "an event (pointer, press, key, …)", word);
    *event = (struct event){.kind = verbs[v].kind, .action = verbs[v].action, .clicks = verbs[v].clicks};
    if (event->kind == EVENT_SIZE) event->scale = (float)replay->header.scale;
    const unsigned with = verbs[v].operands;
    if (with & WITH_KEY) {
        word = take_word(&c);
        event->key = word ? key_from_name(word) : KEY_NONE;
        if (event->key == KEY_NONE) return bad_line(replay, error, "the name of a key", word);
    }
    if (with & WITH_BUTTON) {
        word = take_word(&c);
        int b = 0;
        while (word && b <= BUTTON_MIDDLE && strcmp(word, button_names[b]) != 0) b++;
        if (!word || b > BUTTON_MIDDLE) return bad_line(replay, error, "left, right or middle", word);
        event->button = (enum event_button)b;
    }
    if (with & WITH_WHEEL && !(read_float(&c, &event->dx) && read_float(&c, &event->dy))) return false;
    if (with & WITH_CODE) {
        word = take_word(&c);
        if (!word || sscanf(word, "U+%" SCNx32, &event->codepoint) != 1)
            return bad_line(replay, error, "U+ and a code", word);
    }
    if (with & WITH_POSITION && !read_position(&c, event)) return false;
    if (with & WITH_PATH && !read_escaped(&c, "a path", &event->path)) return false;
    if (with & WITH_TEXT && !read_escaped(&c, "a text", &event->text)) return false;
    for (; with & WITH_MODS && (word = take_word(&c));) {
        int m = 0;
        while (m < MOD_COUNT && strcmp(word, mod_names[m].name) != 0) m++;
        if (m == MOD_COUNT) return bad_line(replay, error, "shift, ctrl, alt or super", word);
        event->mods |= mod_names[m].mod;
    }
    if (event->kind == EVENT_SIZE && !is_size((double)event->x, (double)event->y))
        return bad_line(replay, error, size_limits, c.words.word[2]);
    word = take_word(&c);
    return !word || bad_line(replay, error, "the end of the line", word);
}

struct recording {
    FILE *file;
    char *path;
    long length_at; ///< file offset of the header's number of frames
};

struct recording *recording_open(const char *path, const struct replay_header *header, struct error *error)
{
    struct recording *recording = need_zeroed(1, sizeof *recording);
    recording->path = need_text(path);
    recording->file = file_open_growing(path, error);
    if (!recording->file) {
        free(recording->path);
        free(recording);
        return NULL;
    }
    setvbuf(recording->file, NULL, _IOLBF, 0); // a crash loses no events
    fprintf(recording->file, "%s\nversion %s\nsize %d %d\nscale %g\n", first_line, WIGGLY_VERSION, header->width,
            header->height, header->scale);
    if (header->ui_scale != 1) fprintf(recording->file, "ui-scale %g\n", header->ui_scale);
    fprintf(recording->file, "scene %016" PRIx64 "\ndt 1/60\nframes ", header->scene_hash);
    recording->length_at = ftell(recording->file);
    fprintf(recording->file, "%-10d\n", 0);
    return recording;
}

/// Escapes characters that end a word or open brackets.
static void write_escaped(FILE *f, const char *text)
{
    fputc(' ', f);
    for (; *text; text++) {
        bool plain = isgraph((unsigned char)*text) && !strchr("%()", *text);
        fprintf(f, plain ? "%c" : "%%%02x", (unsigned char)*text);
    }
}

void recording_event(struct recording *recording, long frame, const struct event *event)
{
    FILE *f = recording->file;
    const bool by_action = event->kind == EVENT_KEY || event->kind == EVENT_BUTTON;
    const bool by_clicks = event->kind == EVENT_BUTTON && event->action == ACTION_PRESS;
    const struct verb *verb = verbs, *end = verbs + VERB_COUNT;
    while (verb < end && (verb->kind != event->kind || (by_action && verb->action != event->action) ||
                          (by_clicks && verb->clicks != event->clicks)))
        verb++;
    if (verb == end || (event->kind == EVENT_KEY && !key_name(event->key))) return;
    fprintf(f, "%ld %s", frame, verb->name);
    if (verb->operands & WITH_KEY) fprintf(f, " %s", key_name(event->key));
    if (verb->operands & WITH_BUTTON) fprintf(f, " %s", button_names[event->button]);
    if (verb->operands & WITH_WHEEL) fprintf(f, " %.9g %.9g", (double)event->dx, (double)event->dy);
    if (verb->operands & WITH_CODE) fprintf(f, " U+%04" PRIX32, event->codepoint);
    if (verb->operands & WITH_POSITION) fprintf(f, " %.9g %.9g", (double)event->x, (double)event->y);
    if (verb->operands & WITH_PATH) write_escaped(f, event->path);
    if (verb->operands & WITH_TEXT) write_escaped(f, event->text);
    for (int m = 0; m < MOD_COUNT && verb->operands & WITH_MODS; m++) {
        if (event->mods & mod_names[m].mod) fprintf(f, " %s", mod_names[m].name);
    }
    fputc('\n', f);
}

bool recording_close(struct recording *recording, long frames, struct error *error)
{
    if (!recording) return true;
    FILE *f = recording->file;
    bool good = fseek(f, recording->length_at, SEEK_SET) == 0 && fprintf(f, "%-10ld", frames) > 0 && !ferror(f);
    good = fclose(f) == 0 && good;
    if (!good)
        fail(error, ERROR_ENVIRONMENT, "%s: the recording could not be written whole: is the disk full?",
             recording->path);
    free(recording->path);
    free(recording);
    return good;
}
