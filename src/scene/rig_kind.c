/// The table of rig kinds, and what all kinds share.
#include "scene/rig_kind.h"
#include "scene/rig_pins.h"
#include <stdlib.h>
#include <string.h>

#define RIG_ROW(constant, name) [constant] = &name##_functions,
static const struct rig_functions *const kinds[RIG_KINDS] = {RIG_KIND_LIST(RIG_ROW)};
#undef RIG_ROW

_Static_assert(offsetof(struct tail, channels) == 0 && offsetof(struct chain, channels) == 0,
               "rig.bent is their beginning");

const char *rig_word(enum rig_kind kind) { return kinds[kind]->word; }

const char *rig_title(const struct rig *rig) { return rig->name ? rig->name : kinds[rig->kind]->title(rig); }

int rig_input_count(const struct rig *rig)
{
    const struct rig_functions *kind = kinds[rig->kind];
    if (kind->is_bent) return rig->bent.channel_count;
    return kind->input_count ? kind->input_count(rig) : 0;
}

int rig_input(const struct rig *rig, int input)
{
    const struct rig_functions *kind = kinds[rig->kind];
    return kind->is_bent ? rig->bent.channels[input].spline : kind->input(rig, input);
}

int rig_point_input(const struct rig *rig, int input)
{
    const bool is_point = !kinds[rig->kind]->is_bent || axis_bends(rig->bent.channels[input].axis);
    return is_point ? rig_input(rig, input) : -1;
}

int rig_point_spline(const struct rig *rig)
{
    const int count = rig_input_count(rig);
    for (int i = 0; i < count; i++) {
        if (rig_point_input(rig, i) >= 0) return rig_point_input(rig, i);
    }
    return -1;
}

struct channel *rig_channels(const struct rig *rig, int *count)
{
    const bool is_bent = kinds[rig->kind]->is_bent;
    *count = is_bent ? rig->bent.channel_count : 0;
    return is_bent ? rig->bent.channels : NULL;
}

void rig_references(const struct rig *rig, int index, reference_visitor *visit, void *context)
{
    const struct rig_functions *kind = kinds[rig->kind];
    if (kind->references) kind->references(rig, index, visit, context);
    for (int i = 0; kind->is_bent && i < rig->bent.channel_count; i++)
        visit(&(struct reference){REFERENCE_CHANNEL, index, i, rig->bent.channels[i].spline}, context);
}

void rig_set_reference(struct rig *rig, const struct reference *reference, int spline)
{
    if (reference->kind == REFERENCE_CHANNEL) {
        rig->bent.channels[reference->which].spline = spline;
    } else {
        kinds[rig->kind]->set_reference(rig, reference, spline);
    }
}

bool rig_own_texts(char **const *texts, int count)
{
    for (int i = 0; i < count; i++) {
        if (!*texts[i]) continue;
        *texts[i] = strdup(*texts[i]);
        if (*texts[i]) continue;
        while (i > 0) free(*texts[--i]);
        return false;
    }
    return true;
}

static bool copy_channels(struct rig *copy)
{
    const size_t size = (size_t)copy->bent.channel_count * sizeof *copy->bent.channels;
    const struct channel *channels = copy->bent.channels;
    copy->bent.channels = malloc(size > 0 ? size : 1);
    if (copy->bent.channels && size > 0) memcpy(copy->bent.channels, channels, size);
    return copy->bent.channels != NULL;
}

const char *rig_pin_key(const struct rig *rig) { return kinds[rig->kind]->pin_key; }

static bool copy_pins(struct rig *copy)
{
    const struct pin *pins = copy->pins;
    const size_t size = (size_t)copy->pin_count * sizeof *pins;
    copy->pin_capacity = copy->pin_count;
    copy->pins = size > 0 ? malloc(size) : NULL;
    if (copy->pins) memcpy(copy->pins, pins, size);
    return size == 0 || copy->pins;
}

bool rig_copy(const struct rig *rig, struct rig *copy)
{
    const struct rig_functions *kind = kinds[rig->kind];
    *copy = *rig;
    if (!copy_pins(copy)) return false;
    copy->name = rig->name ? strdup(rig->name) : NULL;
    if ((rig->name && !copy->name) || (kind->copy && !kind->copy(copy))) {
        free(copy->name);
        free(copy->pins);
        return false;
    }
    if (!kind->is_bent || copy_channels(copy)) return true;
    rig_release(copy);
    return false;
}

void rig_release(struct rig *rig)
{
    const struct rig_functions *kind = kinds[rig->kind];
    if (kind->release) kind->release(rig);
    if (kind->is_bent) free(rig->bent.channels);
    free(rig->pins);
    free(rig->name);
}

size_t rig_bytes(const struct rig *rig)
{
    const struct rig_functions *kind = kinds[rig->kind];
    size_t size = sizeof *rig + text_size(rig->name) + (size_t)rig->pin_capacity * sizeof *rig->pins;
    if (kind->bytes) size += kind->bytes(rig);
    if (kind->is_bent) size += (size_t)rig->bent.channel_count * sizeof *rig->bent.channels;
    return size;
}

bool rig_rebase(struct rig *rig, const char *from, const char *to)
{
    const struct rig_functions *kind = kinds[rig->kind];
    return !kind->rebase || kind->rebase(rig, from, to);
}

/// Reports an earlier rig with the same name.
static void check_name(struct reader *reader, const struct where *rig_at, int index)
{
    const struct rig *rigs = reader->document->rigs;
    struct where at = {.parent = rig_at, .key = "name"};
    for (int i = 0; i < index && rigs[index].name; i++) {
        if (!rigs[i].name || strcmp(rigs[i].name, rigs[index].name) != 0) continue;
        reader_fail(reader, &at, "expected a name of its own, got \"%s\" as rigs[%d] has", rigs[i].name, i);
        return;
    }
}

/// Which kind a rig is, -1 after an error.
static int load_kind(struct reader *reader, struct value type)
{
    const char *words[RIG_KINDS + 1] = {NULL};
    for (int k = 0; k < RIG_KINDS; k++) words[k] = kinds[k]->word;
    return reader_word(reader, type, words, -1);
}

void load_rigs(struct reader *reader, const struct value *scene)
{
    const struct value rigs = reader_member(scene, "rigs");
    int count = reader_objects(reader, rigs, SCENE_MAX_RIGS);
    struct document *document = reader->document;
    if (count <= 0) return;
    if (!document_reserve_rigs(document, count)) {
        reader_no_memory(reader);
        return;
    }
    for (int i = 0; i < count; i++) {
        const struct value object = reader_element(&rigs, i);
        int kind = load_kind(reader, reader_member(&object, "type"));
        struct rig *rig = &document->rigs[document->rig_count++];
        memset(rig, 0, sizeof *rig);
        rig->kind = kind < 0 ? RIG_TAIL : (enum rig_kind)kind; // any will do: the scene is refused
        if (kind >= 0) kinds[kind]->load(reader, &object, rig);
        if (kind >= 0 && kinds[kind]->pin_key) load_pins(reader, &object, kinds[kind]->pin_key, rig);
        check_name(reader, &object.at, i);
    }
    for (int i = 0; i < count; i++) {
        const struct value object = reader_element(&rigs, i);
        struct rig *rig = &document->rigs[i];
        if (kinds[rig->kind]->resolve) kinds[rig->kind]->resolve(reader, &object, rig);
    }
}

static void print_rig(struct text *text, const struct document *document, const struct rig *rig, const char *folder)
{
    const struct rig_functions *kind = kinds[rig->kind];
    struct members members = {text, "    {\n      ", ",\n      ", false};
    member_string(&members, "type", kind->word);
    if (rig->name) member_string(&members, "name", rig->name);
    kind->print(&members, document, rig, folder);
    if (kind->pin_key) print_pins(&members, rig, kind->pin_key);
    members_extra(&members, rig->extra, kind->has_tracks);
    text_string(text, "\n    }");
}

void print_rigs(struct text *text, const struct document *document, const char *folder)
{
    for (int r = 0; r < document->rig_count; r++) {
        text_string(text, r > 0 ? ",\n" : "[\n");
        print_rig(text, document, &document->rigs[r], folder);
    }
    text_string(text, document->rig_count > 0 ? "\n  ]" : "[]");
}
