/// Names that differ, and texts that are cut at a letter.
#include "near.h"

#include "base/names.h"
#include <string.h>

static bool is_utf8(const char *text)
{
    char *valid = name_from(text, strlen(text));
    const bool same = strcmp(valid, text) == 0;
    free(valid);
    return same;
}

TEST(the_next_number_that_is_free)
{
    static const char *const wanted[] = {"a", "a 3", "a", "a", "a 3", ""}, *const expected[] = {"a",   "a 3",   "a 2",
                                                                                                "a 4", "a 3 2", ""};
    struct names names = {0};
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++)
        assert_string_equal(names_add(&names, wanted[i]), expected[i]);
    assert_true(names_has(&names, "a 4"));
    assert_false(names_has(&names, "a 5"));
    names_free(&names);
}

/// Also where they are alike as far as they fit, and so that no letter is cut.
TEST(long_names_have_room_for_their_number)
{
    enum { COUNT = 2000, MOST = 24 };
    struct names names = {.between = "_", .most = MOST};
    const char *before = "";
    for (int i = 0; i < COUNT; i++) {
        char wanted[64];
        snprintf(wanted, sizeof wanted, "尻尾尻尾尻尾尻尾%s%d", i % 2 ? "尻尾" : "", i);
        const char *name = names_add(&names, wanted);
        assert_true(strlen(name) <= MOST && is_utf8(name));
        assert_string_not_equal(name, before);
        if (i > 0) assert_non_null(strchr(name, '_'));
        before = name;
    }
    names_free(&names);
}

TEST(a_cut_is_between_letters)
{
    static const char text[] = "é尻🦊";
    static const int expected[] = {0, 0, 2, 2, 2, 5, 5, 5, 5, 9, 9};
    for (size_t most = 0; most < sizeof expected / sizeof *expected; most++)
        assert_int_equal(name_fit(text, most), expected[most]);
    assert_int_equal(name_fit("\x80\x80\x80\x80\x80\x80", 5), 5); // nothing to go by
    assert_true(name_is_blank("\t \u3000\u00A0"));
    assert_false(name_is_blank(" \u3001"));
}
