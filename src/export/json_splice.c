/// Finds places in JSON texts, and changes them there.
#include "export/json_splice.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static size_t skip_space(const char *text, size_t at) { return at + strspn(text + at, " \t\r\n"); }

/// Behind the string that begins here.
static size_t skip_string(const char *text, size_t at)
{
    for (at++; text[at] && text[at] != '"'; at++) at += text[at] == '\\' && text[at + 1];
    return at + (text[at] == '"');
}

/// Behind the value that begins here.
static size_t skip_value(const char *text, size_t at)
{
    if (text[at] == '"') return skip_string(text, at);
    if (text[at] != '{' && text[at] != '[') return at + strcspn(text + at, ",]} \t\r\n");
    int depth = 0;
    do {
        at += strcspn(text + at, "\"{}[]");
        if (text[at] == '"') {
            at = skip_string(text, at);
        } else if (text[at]) {
            depth += text[at] == '{' || text[at] == '[' ? 1 : -1;
            at++;
        }
    } while (depth > 0 && text[at]);
    return at;
}

struct json_span json_span_of(const char *text)
{
    const size_t start = skip_space(text, 0);
    return (struct json_span){start, skip_value(text, start)};
}

/// The next element or member, from behind the bracket or the one before on; false at the closing bracket.
static bool next(const char *text, size_t *at, struct json_span *item)
{
    *at = skip_space(text, *at);
    if (text[*at] == ',') *at = skip_space(text, *at + 1);
    if (!text[*at] || text[*at] == ']' || text[*at] == '}') return false;
    *item = (struct json_span){*at, skip_value(text, *at)};
    *at = item->end;
    return true;
}

bool json_span_member(const char *text, struct json_span object, const char *key, struct json_span *value)
{
    const size_t length = strlen(key);
    size_t at = object.start + 1;
    for (struct json_span name; next(text, &at, &name);) {
        at = skip_space(text, at);
        at = skip_space(text, at + (text[at] == ':'));
        *value = (struct json_span){at, skip_value(text, at)};
        at = value->end;
        if (name.end - name.start == length + 2 && strncmp(text + name.start + 1, key, length) == 0) return true;
    }
    return false;
}

bool json_span_element(const char *text, struct json_span array, size_t index, struct json_span *value)
{
    size_t at = array.start + 1;
    for (size_t i = 0; next(text, &at, value); i++) {
        if (i == index) return true;
    }
    return false;
}

void json_replace(struct json_splices *splices, struct json_span span, char *text)
{
    if (!text || splices->count == JSON_MOST_SPLICES) {
        splices->failed = true;
        free(text);
        return;
    }
    splices->list[splices->count++] = (struct json_splice){span.start, span.end - span.start, text};
}

/// "before" "text" "after" in memory of its own.
static char *join(const char *before, char *text, const char *after)
{
    char *joined = NULL;
    if (text && asprintf(&joined, "%s%s%s", before, text, after) < 0) joined = NULL;
    free(text);
    return joined;
}

void json_append(struct json_splices *splices, const char *text, struct json_span array, char *elements)
{
    struct json_span first;
    const bool is_empty = !json_span_element(text, array, 0, &first);
    const struct json_span end = {array.end - 1, array.end - 1};
    json_replace(splices, end, join(is_empty ? "" : ",", elements, ""));
}

void json_prepend(struct json_splices *splices, const char *text, struct json_span object, char *members)
{
    const size_t at = object.start + 1;
    const bool is_empty = text[skip_space(text, at)] == '}';
    json_replace(splices, (struct json_span){at, at}, join("", members, is_empty ? "" : ","));
}

static int compare(const void *a, const void *b)
{
    const struct json_splice *left = a, *right = b;
    return left->at < right->at ? -1 : left->at > right->at;
}

char *json_spliced(const char *text, struct json_splices *splices, size_t *size)
{
    size_t capacity = strlen(text) + 1, from = 0;
    for (int i = 0; i < splices->count; i++) capacity += strlen(splices->list[i].text);
    char *changed = splices->failed ? NULL : malloc(capacity);
    if (!changed) return NULL;
    char *to = changed;
    qsort(splices->list, (size_t)splices->count, sizeof *splices->list, compare);
    for (int i = 0; i < splices->count; i++) {
        const struct json_splice *splice = &splices->list[i];
        to = mempcpy(to, text + from, splice->at - from);
        to = stpcpy(to, splice->text);
        from = splice->at + splice->removed;
    }
    to = stpcpy(to, text + from);
    *size = (size_t)(to - changed);
    return changed;
}

void json_splices_free(struct json_splices *splices)
{
    for (int i = 0; i < splices->count; i++) free(splices->list[i].text);
    splices->count = 0;
}
