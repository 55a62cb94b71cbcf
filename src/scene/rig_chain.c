/// Chains as a kind of rig: loading, printing, references and memory.
#include "scene/rig_channels.h"
#include "scene/rig_kind.h"
#include <stdlib.h>

static const char *const chain_keys[] = {"type", "name",   "model",    "from", "to",
                                         "turn", "mirror", "channels", "pins", NULL};

static void load(struct reader *reader, const struct value *object, struct rig *rig)
{
    struct chain *chain = &rig->chain;
    const struct value name = reader_member(object, "name");
    if (name.json) rig->name = reader_name(reader, name);
    chain->model = reader_name(reader, reader_member(object, "model"));
    chain->from = reader_name(reader, reader_member(object, "from"));
    chain->to = reader_name(reader, reader_member(object, "to"));
    reader_number(reader, reader_member(object, "turn"), false, range_any, &chain->turn);
    reader_flag(reader, reader_member(object, "mirror"), &chain->mirror);
    chain->channels =
        load_channels(reader, reader_member(object, "channels"), chain_axes, JOINTS_UNKNOWN, &chain->channel_count);
    rig->extra = reader_keep(reader, reader_extra(reader, object, chain_keys));
}

static void resolve(struct reader *reader, const struct value *object, struct rig *rig)
{
    struct chain *chain = &rig->chain;
    const struct where at = {.parent = &object->at, .key = "model"};
    if (!chain->model) return;
    chain->by_file = document_find_model(reader->document, chain->model, false) < 0;
    if (!chain->by_file || document_find_model(reader->document, chain->model, true) >= 0) return;
    reader_fail(reader, &at, "expected the name or file of a model rig, got \"%s\"", chain->model);
}

static void print(struct members *members, const struct document *document, const struct rig *rig, const char *folder)
{
    const struct chain *chain = &rig->chain;
    if (chain->by_file) {
        member_path(members, "model", document, chain->model, folder);
    } else {
        member_string(members, "model", chain->model);
    }
    member_string(members, "from", chain->from);
    member_string(members, "to", chain->to);
    member_number(members, "turn", chain->turn);
    member_flag(members, "mirror", chain->mirror);
    print_channels(members, document, chain->channels, chain->channel_count);
}

static void copy(struct rig *copy)
{
    char **const texts[] = {&copy->chain.model, &copy->chain.from, &copy->chain.to};
    rig_own_texts(texts, 3);
}

static void release(struct rig *rig)
{
    free(rig->chain.model);
    free(rig->chain.from);
    free(rig->chain.to);
}

static size_t bytes(const struct rig *rig, const struct rig *other)
{
    (void)other;
    const struct chain *chain = &rig->chain;
    return text_size(chain->model) + text_size(chain->from) + text_size(chain->to);
}

static const char *title(const struct rig *rig) { return rig->chain.from; }

const struct rig_functions chain_functions = {.word = "chain",
                                              .load = load,
                                              .resolve = resolve,
                                              .print = print,
                                              .pin_key = "joint",
                                              .is_bent = true,
                                              .copy = copy,
                                              .release = release,
                                              .bytes = bytes,
                                              .title = title};
