/// What --gl-debug counts: a wrong call is a complaint, good ones are none. It says each once.
#include "near.h"

#include "platform/platform.h"
#include <epoxy/gl.h>
#include <unistd.h>

TEST(wrong_calls_are_counted)
{
    struct error error = {0};
    platform_debug_gl();
    struct platform *platform = platform_offscreen(64, 64, 1, &error);
    if (!platform) {
        print_message("skip - %s\n", error.text);
        skip();
    }
    glClear(GL_COLOR_BUFFER_BIT);
    assert_int_equal(platform_gl_complaints(), 0);
    FILE *said = tmpfile();
    const int before = dup(STDERR_FILENO);
    assert_non_null(said);
    dup2(fileno(said), STDERR_FILENO);
    for (int i = 1; i <= 3; i++) {
        glEnable(0xDEAD);
        assert_int_equal(platform_gl_complaints(), i);
    }
    dup2(before, STDERR_FILENO);
    close(before);
    char line[512];
    rewind(said);
    assert_non_null(fgets(line, sizeof line, said));
    assert_non_null(strstr(line, "OpenGL, error"));
    assert_null(fgets(line, sizeof line, said)); // the same thing is said once
    fclose(said);
    platform_destroy(platform);
}
