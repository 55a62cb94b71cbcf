/// What edits share: trying one on the document, and what they may be about.
#include "scene/editing.h"
#include "scene/pins.h"

struct document *edit_begin(const struct document *document) { return document_copy(document); }

/// Whether the document's pins and floors are as a file may have them.
static bool suits_pins(const struct document *document, struct error *error)
{
    struct pin_trouble trouble;
    if (!pins_hold_any(document) || (pins_check(document, &trouble) && pins_check_order(document, &trouble)))
        return true;
    const struct rig *rig = document->rigs[trouble.rig];
    return fail(error, ERROR_INPUT, "%s: %s: %s", rig_title(rig), trouble.pin >= 0 ? "pins" : trouble.member,
                trouble.error.text);
}

bool edit_end(struct document *document, struct document *before, bool good, struct error *error)
{
    good = good && suits_pins(document, error);
    if (good) {
        document_destroy(before);
    } else {
        document_become(document, before);
    }
    return good;
}

bool edit_has_spline(const struct document *document, int spline, struct error *error)
{
    return (spline >= 0 && spline < document->spline_count) || fail(error, ERROR_INPUT, "there is no such spline");
}

/// What to call a rig of one of those kinds.
static const char *word_for(unsigned kinds)
{
    for (int k = 0; k < RIG_KINDS; k++) {
        if (kinds == EDIT_KIND(k)) return rig_word((enum rig_kind)k);
    }
    return "rig";
}

const struct rig *edit_find_rig(const struct document *document, int rig, unsigned kinds, struct error *error)
{
    const bool is_rig = rig >= 0 && rig < document->rig_count;
    if (is_rig && kinds & EDIT_KIND(document->rigs[rig]->kind)) return document->rigs[rig];
    fail(error, ERROR_INPUT, "there is no such %s", word_for(kinds));
    return NULL;
}

bool edit_replace_rig(struct document *document, int rig, struct rig *changed, struct error *error)
{
    const bool good = rig_check(changed, error);
    if (!good || rig_equals(document->rigs[rig], changed)) {
        rig_drop(changed);
        return good;
    }
    struct document *before = edit_begin(document);
    rig_drop(document->rigs[rig]);
    document->rigs[rig] = changed;
    document_touch(document);
    return edit_end(document, before, true, error);
}
