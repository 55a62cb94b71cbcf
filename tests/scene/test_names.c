/// Names that differ, texts that are cut at a letter, and paths of files that are named from a folder.
#include "near.h"

#include "base/file.h"
#include "base/names.h"
#include <unistd.h>

// --- names

TEST(the_next_number_that_is_free)
{
    static const char *const rows[][2] = {{"a", "a"},   {"a 3", "a 3"},   {"a", "a 2"},
                                          {"a", "a 4"}, {"a 3", "a 3 2"}, {"", ""}};
    struct names names = {0};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        assert_string_equal(names_add(&names, rows[i][0]), rows[i][1]);
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
        char *valid = name_from(name, strlen(name)); // UTF-8
        assert_string_equal(valid, name);
        assert_true(strlen(name) <= MOST && strcmp(name, before) != 0 && (i == 0 || strchr(name, '_')));
        before = name;
        free(valid);
    }
    names_free(&names);
}

TEST(a_cut_is_between_letters)
{
    static const int expected[] = {0, 0, 2, 2, 2, 5, 5, 5, 5, 9, 9};
    for (size_t most = 0; most < sizeof expected / sizeof *expected; most++)
        assert_int_equal(name_fit("é尻🦊", most), expected[most]);
    assert_int_equal(name_fit("\x80\x80\x80\x80\x80\x80", 5), 5); // nothing to go by
    assert_true(name_is_blank("\t \u3000\u00A0"));
    assert_false(name_is_blank(" \u3001"));
}

// --- paths; %s is the working folder

TEST(paths_from_a_folder)
{
    static const char *const rows[][3] = {
        {"/", "a//b/./../c.glb", "/a/c.glb"},
        {"/", "../../a.glb", "/a.glb"},
        {"nowhere", "/a/..", "/"},
        {"no such/scenes", "../models/a.glb", "%s/no such/models/a.glb"},
    };
    char here[PATH_LIMIT], expected[PATH_LIMIT + 64], absolute[PATH_LIMIT];
    assert_non_null(getcwd(here, sizeof here));
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        snprintf(expected, sizeof expected, rows[i][2], here); // NOLINT: a format of the table above
        assert_true(path_resolve(rows[i][0], rows[i][1], absolute));
        assert_string_equal(absolute, expected);
    }
}

/// A path from one folder as a path from another; also where somebody saves into a folder that is not there.
TEST(paths_are_rebased)
{
    static const struct {
        const char *path, *from, *to, *moved; ///< NULL: it stays
    } rows[] = {
        {"a.glb", "/x/y", "/x/y/z", "../a.glb"},
        {"a.glb", "/x/y", "/x", "y/a.glb"},
        {"../m/a.glb", "/x/y", "/", "x/m/a.glb"},
        {"a.glb", "/x/yy", "/x/y", "../yy/a.glb"},
        {"./b/../a.glb", "/x", "/y", "../x/a.glb"},
        {"models/a.glb", "", "no such/scenes", "../../models/a.glb"},
        {"a.glb", "no such", "", "no such/a.glb"},
        {"/x/a.glb", "/x", "/y", NULL},
        {"a.glb", "/x", "/x", NULL},
        {"a.glb", "/x/", "/x", NULL},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char moved[PATH_LIMIT];
        assert_int_equal(path_rebase(rows[i].path, rows[i].from, rows[i].to, moved), rows[i].moved != NULL);
        if (rows[i].moved) assert_string_equal(moved, rows[i].moved);
    }
}

TEST(paths_that_are_too_long_are_refused)
{
    static char longest[PATH_LIMIT + 1];
    char absolute[PATH_LIMIT];
    memset(longest, 'a', PATH_LIMIT);
    assert_false(path_resolve(longest, "a.glb", absolute));
    assert_false(path_resolve("", longest, absolute));
    longest[PATH_LIMIT - 4] = '\0';
    assert_false(path_resolve(longest, "a.glb", absolute));
}
