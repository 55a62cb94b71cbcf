/// Reads and writes knots as JSON.
#include "scene/knots.h"
#include "base/need.h"
#include "scene/members.h"
#include "scene/reader.h"
#include <stdlib.h>
#include <string.h>

void knot_list_free(struct knot_list *list)
{
    for (int i = 0; list->splines && i < list->count; i++) free(list->splines[i]);
    free(list->splines);
    free(list->knots);
    *list = (struct knot_list){0};
}

void print_knot(struct text *text, const struct knot *knot, const char *spline)
{
    struct members members = {text, "{ ", ", ", false};
    if (spline) member_string(&members, "spline", spline);
    member_number(&members, "frame", knot->frame);
    member_number(&members, "value", knot->value);
    if (knot->has_slope) member_number(&members, "slope", knot->slope);
    if (knot->stiffness != KNOT_DEFAULT_STIFFNESS) member_number(&members, "stiffness", knot->stiffness);
    members_extra(&members, knot->extra, NULL);
    text_string(text, " }");
}

char *knots_print(const struct knot_list *list)
{
    struct text text = {0};
    for (int i = 0; i < list->count; i++) {
        text_string(&text, i > 0 ? ",\n  " : "[\n  ");
        print_knot(&text, &list->knots[i], list->splines ? list->splines[i] : NULL);
    }
    text_string(&text, list->count > 0 ? "\n]\n" : "[]\n");
    text_bytes(&text, "", 1);
    return text.data;
}

static void read_array(struct reader *reader, struct value array, struct knot_list *list)
{
    int count = reader_objects(reader, array, SCENE_MAX_KNOTS);
    if (count == 0) reader_fail(reader, &array.at, "expected at least one knot, got none");
    if (count <= 0) return;
    list->knots = need_zeroed((size_t)count, sizeof *list->knots);
    list->splines = need_zeroed((size_t)count, sizeof *list->splines);
    list->count = count;
    for (int i = 0; i < count; i++) {
        const struct value object = reader_element(&array, i), spline = reader_member(&object, "spline");
        reader_knot(reader, object, &list->knots[i]);
        if (spline.json) list->splines[i] = reader_name(reader, spline);
        list->knots[i].id = 0;
        list->knots[i].extra = NULL; /* the reader's document goes */
    }
}

static bool parse_json(const char *name, const char *text, struct knot_list *list, struct error *error)
{
    struct reader reader = {.source = {.name = name, .text = text, .size = strlen(text)}, .error = error};
    reader.document = document_create();
    const struct value root = {.json = reader_parse(&reader)};
    if (root.json) read_array(&reader, json_is_object(root.json) ? reader_member(&root, "knots") : root, list);
    json_decref(root.json);
    document_destroy(reader.document);
    if (reader.failed) knot_list_free(list);
    return !reader.failed;
}

bool knots_parse(const char *name, const char *text, struct knot_list *list, struct error *error)
{
    *list = (struct knot_list){0};
    char first = text[strspn(text, " \t\r\n")];
    bool is_json = first == '[' || first == '{';
    return is_json ? parse_json(name, text, list, error) : knots_parse_csv(name, text, list, error);
}
