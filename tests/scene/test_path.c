/// Paths of files that are named from a folder.
#include "near.h"

#include "base/file.h"
#include <unistd.h>

static void assert_resolved(const char *folder, const char *path, const char *expected)
{
    char absolute[PATH_LIMIT];
    assert_true(path_resolve(folder, path, absolute));
    assert_string_equal(absolute, expected);
}

TEST(dots_and_slashes_go)
{
    assert_resolved("/", "a//b/./../c.glb", "/a/c.glb");
    assert_resolved("/", "../../a.glb", "/a.glb");
    assert_resolved("nowhere", "/a/..", "/");
}

/// Where somebody saves into a folder that is not there.
TEST(a_missing_folder_is_in_the_working_folder)
{
    char here[PATH_LIMIT], expected[PATH_LIMIT + 64], moved[PATH_LIMIT];
    assert_non_null(getcwd(here, sizeof here));
    snprintf(expected, sizeof expected, "%s/no such/models/a.glb", here);
    assert_resolved("no such/scenes", "../models/a.glb", expected);
    assert_true(path_rebase("models/a.glb", "", "no such/scenes", moved));
    assert_string_equal(moved, "../../models/a.glb");
    assert_true(path_rebase("a.glb", "no such", "", moved));
    assert_string_equal(moved, "no such/a.glb");
}

TEST(what_is_too_long_is_refused)
{
    static char longest[PATH_LIMIT + 1];
    char absolute[PATH_LIMIT];
    memset(longest, 'a', PATH_LIMIT);
    assert_false(path_resolve(longest, "a.glb", absolute));
    assert_false(path_resolve("", longest, absolute));
    longest[PATH_LIMIT - 4] = '\0';
    assert_false(path_resolve(longest, "a.glb", absolute));
}
