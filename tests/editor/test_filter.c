/// What typing finds in a list.
#include "near.h"
#include "ui/widgets.h"
#include <string.h>

TEST(test_fits)
{
    static const struct {
        const char *typed, *text;
        enum fit fit;
    } cases[] = {
        {"", "tail_1", FIT_START},
        {"tail", "tail_1", FIT_START},
        {"TAIL", "tail_1", FIT_START},
        {"spl", "Add a spline", FIT_WORD},
        {"pli", "Add a spline", FIT_INSIDE},
        {"asp", "Add a spline", FIT_LETTERS},
        {"spline add", "Add a spline", FIT_WORD},
        {"add x", "Add a spline", FIT_NOT},
        {"enilps", "Add a spline", FIT_NOT},
        {"1", "tail_1", FIT_WORD},
        {"ü", "Schwänze über", FIT_WORD},
        {"nze", "Schwänze", FIT_INSIDE},
        {"  ", "tail_1", FIT_START},
        {"tail_12", "tail_1", FIT_NOT},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct ui_filter filter = {.typed = ""};
        strcpy(filter.typed, cases[i].typed);
        const enum fit fit = ui_filter_fit(&filter, cases[i].text);
        if (fit != cases[i].fit)
            fail_msg("“%s” in “%s”: expected %d, got %d", cases[i].typed, cases[i].text, (int)cases[i].fit, (int)fit);
    }
}

static bool type(struct ui_filter *filter, uint32_t codepoint)
{
    return ui_filter_event(filter, &(struct event){.kind = EVENT_TEXT, .codepoint = codepoint});
}

/// Characters of several bytes come and go whole; what is full stays as it is.
TEST(test_typing)
{
    const struct event back = {.kind = EVENT_KEY, .key = KEY_BACKSPACE, .action = ACTION_PRESS};
    struct ui_filter filter = {.typed = ""};
    assert_false(type(&filter, ' '));
    assert_false(ui_filter_event(&filter, &back));
    assert_true(type(&filter, 'a') && type(&filter, 0x2026) && type(&filter, ' '));
    assert_string_equal(filter.typed, "a… ");
    assert_true(ui_filter_event(&filter, &back) && ui_filter_event(&filter, &back));
    assert_string_equal(filter.typed, "a");
    while (type(&filter, 0x1F98A)) continue;
    assert_true(strlen(filter.typed) < sizeof filter.typed && strlen(filter.typed) % 4 == 1);
}
