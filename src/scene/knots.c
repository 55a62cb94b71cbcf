/// Reads and writes knots as JSON, and reads them from CSV lines frame,value[,slope[,stiffness[,im]]].
#include "base/need.h"
#include "scene/fields.h"
#include "scene/load.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

void knot_list_free(struct knot_list *list)
{
    for (int i = 0; list->splines && i < list->count; i++) free(list->splines[i]);
    free(list->splines);
    free(list->knots);
    *list = (struct knot_list){0};
}

char *knots_print(const struct knot_list *list)
{
    struct text text = {0};
    for (int i = 0; i < list->count; i++) {
        struct members members = {&text, "{ ", ", ", false};
        text_string(&text, i > 0 ? ",\n  " : "[\n  ");
        if (list->splines && list->splines[i]) member_string(&members, "spline", list->splines[i]);
        fields_print(&members, NULL, knot_fields, &list->knots[i], NULL);
        text_string(&text, " }");
    }
    text_string(&text, list->count > 0 ? "\n]\n" : "[]\n");
    text_bytes(&text, "", 1);
    return text.data;
}

static bool parse_json(const char *name, const char *text, struct knot_list *list, struct error *error)
{
    struct reader reader = {.source = {.name = name, .text = text, .size = strlen(text)}, .error = error};
    reader.document = document_create();
    const struct value root = {.json = reader_parse(&reader)};
    const struct value array = json_is_object(root.json) ? reader_member(&root, "knots") : root;
    const int count = root.json ? reader_objects(&reader, array, SCENE_MAX_KNOTS) : -1;
    if (count == 0) reader_fail(&reader, &array.at, "expected at least one knot, got none");
    if (count > 0) {
        list->knots = need_zeroed((size_t)count, sizeof *list->knots);
        list->splines = need_zeroed((size_t)count, sizeof *list->splines);
        list->count = count;
    }
    for (int i = 0; i < count; i++) {
        const struct value object = reader_element(&array, i), spline = reader_member(&object, "spline");
        object_load(&reader, &object, knot_fields, &list->knots[i]);
        if (spline.json) list->splines[i] = reader_name(&reader, spline);
        list->knots[i].extra = NULL; // the reader's document goes
    }
    json_decref(root.json);
    document_destroy(reader.document);
    if (reader.errors > 0) knot_list_free(list);
    return reader.errors == 0;
}

enum { MAX_FIELDS = 64, MAX_FIELD = 64 };

enum column { COLUMN_FRAME, COLUMN_VALUE, COLUMN_SLOPE, COLUMN_STIFFNESS, COLUMN_IM, COLUMN_COUNT };

static const char *const column_names[] = {[COLUMN_FRAME] = "frame",
                                           [COLUMN_VALUE] = "value",
                                           [COLUMN_SLOPE] = "slope",
                                           [COLUMN_STIFFNESS] = "stiffness",
                                           [COLUMN_IM] = "im"};

static const char byte_order_mark[] = "\xEF\xBB\xBF", cut_off[] = "…"; // no number ends in this

/// A line's fields, without surrounding quotes and blanks.
struct line {
    int number;
    int count;
    char field[MAX_FIELDS][MAX_FIELD];
};

struct csv {
    const char *name;
    struct line line;
    int at[COLUMN_COUNT]; ///< index of each column's field, -1: none
    struct knot_list *list;
    struct error *error;
};

static bool csv_fail(const struct csv *csv, const char *expected, const char *got)
{
    return fail(csv->error, ERROR_INPUT, "%s:%d: expected %s, got %s%.60s%s", csv->name, csv->line.number, expected,
                got && *got ? "\"" : "", got && *got ? got : "nothing", got && *got ? "\"" : "");
}

static bool is_number(const char *field, double *number)
{
    char *end;
    *number = strtod(field, &end);
    return end != field && !*end && isfinite(*number);
}

/// Reads a field's number. A missing optional field is left unchanged.
static bool csv_read_field(const struct csv *csv, enum column column, bool *given, double *number)
{
    static const char *const expected[] = {
        [COLUMN_FRAME] = "a frame from -1000000000 to 1000000000",
        [COLUMN_VALUE] = "a value or still after the frame (frame,value[,slope[,stiffness[,im]]])",
        [COLUMN_SLOPE] = "a number as the slope",
        [COLUMN_STIFFNESS] = "a number above 0 as the stiffness",
        [COLUMN_IM] = "a number as im"};
    int at = csv->at[column];
    const char *field = at >= 0 && at < csv->line.count ? csv->line.field[at] : "";
    *given = *field;
    if (!*field && column > COLUMN_VALUE) return true;
    bool good = is_number(field, number);
    if (column == COLUMN_FRAME) good = good && fabs(*number) <= SCENE_MAX_FRAME;
    if (column == COLUMN_STIFFNESS) good = good && *number > 0;
    return good || csv_fail(csv, expected[column], field);
}

/// Reads a knot, or a header: its columns have names; frame and value default to the first and second column.
static bool csv_read_line(struct csv *csv, const char *text, size_t length, bool *started)
{
    static const char around[] = " \t\r\"";
    struct line *line = &csv->line;
    double number;
    size_t blank = strspn(text, " \t\r");
    if (blank >= length || text[blank] == '#') return true;

    // Its fields lie between semicolons, else tabs, else commas. With semicolons or tabs, a comma in a number is the decimal point.
    char separator = memchr(text, ';', length) ? ';' : memchr(text, '\t', length) ? '\t' : ',';
    line->count = 0;
    for (const char *at = text, *end = text + length; at <= end;) {
        const char *next = memchr(at, separator, (size_t)(end - at));
        if (!next) next = end;
        const char *from = at, *to = next;
        while (from < to && strchr(around, *from)) from++;
        while (from < to && strchr(around, to[-1])) to--;
        at = next + 1;
        if (line->count == MAX_FIELDS) continue;
        char *field = line->field[line->count++];
        const bool fits = to - from < MAX_FIELD;
        const size_t kept = fits ? (size_t)(to - from) : MAX_FIELD - sizeof cut_off;
        memcpy(field, from, kept);
        strcpy(field + kept, fits ? "" : cut_off);
    }
    for (int i = 0; i < line->count && separator != ','; i++) {
        char *comma = strchr(line->field[i], ',');
        if (comma) *comma = '.';
    }
    bool is_header =
        !*started && line->count > 1 && !is_number(line->field[0], &number) && !is_number(line->field[1], &number);
    *started = true;
    if (is_header) {
        for (int c = 0; c < COLUMN_COUNT; c++) {
            csv->at[c] = c <= COLUMN_VALUE ? c : -1;
            for (int i = 0; i < line->count; i++) {
                if (strcasecmp(line->field[i], column_names[c]) == 0) csv->at[c] = i;
            }
        }
        return true;
    }

    struct knot knot = {.stiffness = KNOT_DEFAULT_STIFFNESS};
    bool given;
    const int at = csv->at[COLUMN_VALUE];
    knot.still = at < line->count && strcasecmp(line->field[at], "still") == 0;
    if (knot.still) knot.value = NAN;
    bool good = csv_read_field(csv, COLUMN_FRAME, &given, &knot.frame);
    if (!knot.still)
        good = good && csv_read_field(csv, COLUMN_VALUE, &given, &knot.value) &&
               csv_read_field(csv, COLUMN_STIFFNESS, &given, &knot.stiffness) &&
               csv_read_field(csv, COLUMN_SLOPE, &knot.has_slope, &knot.slope) &&
               csv_read_field(csv, COLUMN_IM, &knot.has_phase, &knot.phase);
    if (!good) return false;
    struct knot_list *list = csv->list;
    if (list->count == SCENE_MAX_KNOTS) return csv_fail(csv, "at most 100000 knots", "more");
    list->knots = need_more(list->knots, (size_t)list->count + 1, sizeof *list->knots);
    list->knots[list->count++] = knot;
    return true;
}

bool knots_parse(const char *name, const char *text, struct knot_list *list, struct error *error)
{
    *list = (struct knot_list){0};
    char first = text[strspn(text, " \t\r\n")];
    if (first == '[' || first == '{') return parse_json(name, text, list, error);

    struct csv csv = {.name = name, .at = {0, 1, 2, 3, 4}, .list = list, .error = error};
    bool started = false, good = true;
    if (strncmp(text, byte_order_mark, sizeof byte_order_mark - 1) == 0) text += sizeof byte_order_mark - 1;
    while (good && *text) {
        size_t length = strcspn(text, "\n");
        csv.line.number++;
        good = csv_read_line(&csv, text, length, &started);
        text += length + (text[length] == '\n');
    }
    if (good && list->count == 0) good = csv_fail(&csv, "knots as JSON or as lines frame,value", "");
    if (!good) knot_list_free(list);
    return good;
}
