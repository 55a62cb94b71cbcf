/// The draw list (what the editor records), text layout and key names: all without a screen.
#include "near.h"

#include "ui/event.h"
#include "ui/font.h"
#include "ui/theme.h"

static const struct rect WHOLE = {0, 0, 200, 100};

static void open_list(struct drawlist *list)
{
    font_init();
    drawlist_create(list, 8, 16, 64);
    drawlist_clear(list, WHOLE);
}

#define LIST_TEST(name) TEST_OF(struct drawlist, list, open_list(list), drawlist_destroy(list), name)

/// A line of dashes or a text as told.
struct thing {
    const char *what, *text;
    float x, size; ///< `size`: of the text, or the line's width
    float on;
    enum font font;
    uint32_t color;
    struct rect clip;
};

static uint64_t hash_of(struct drawlist *list, const struct thing *thing)
{
    const float xy[4] = {10, 10, thing->x, 50};
    drawlist_clear(list, thing->clip);
    if (thing->text)
        drawlist_text(list, thing->x, 40, thing->font, thing->size, thing->color, thing->text);
    else
        drawlist_dashed(list, xy, 2, thing->size, thing->on, 4, thing->color);
    assert_int_equal(list->count, 1);
    return list->commands[0].hash;
}

/// A change that the hash does not see would stay invisible on the screen.
LIST_TEST(hashes_see_every_change)
{
    const uint32_t color = theme()->text;
    const struct thing rows[] = {
        {"the line itself", NULL, 60, 2, 6, FONT_LABEL, color, WHOLE},
        {"its end", NULL, 60.25f, 2, 6, FONT_LABEL, color, WHOLE},
        {"its width", NULL, 60, 2.5f, 6, FONT_LABEL, color, WHOLE},
        {"its dashes", NULL, 60, 2, 5, FONT_LABEL, color, WHOLE},
        {"its colour", NULL, 60, 2, 6, FONT_LABEL, theme_fade(color, 0.5f), WHOLE},
        {"its clip", NULL, 60, 2, 6, FONT_LABEL, color, {0, 0, 199, 100}},
        {"the text itself", "frame 36", 10, 13, 0, FONT_LABEL, color, WHOLE},
        {"another text", "frame 37", 10, 13, 0, FONT_LABEL, color, WHOLE},
        {"its place", "frame 36", 11, 13, 0, FONT_LABEL, color, WHOLE},
        {"its size", "frame 36", 10, 11, 0, FONT_LABEL, color, WHOLE},
        {"its font", "frame 36", 10, 13, 0, FONT_LABEL_BOLD, color, WHOLE},
    };
    enum { ROWS = sizeof rows / sizeof *rows };
    for (int i = 0; i < ROWS; i++)
        for (int j = 0; j < ROWS; j++)
            if ((hash_of(list, &rows[i]) == hash_of(list, &rows[j])) != (i == j))
                fail_msg("%s, %s", rows[i].what, rows[j].what);
}

LIST_TEST(bounds_are_clipped_and_the_unseen_left_out)
{
    struct rect before = drawlist_push_clip(list, (struct rect){20, 20, 30, 30});
    drawlist_rect(list, (struct rect){0, 0, 25, 90}, theme()->text);
    assert_int_equal(list->count, 1);
    assert_near(list->commands[0].bounds.x, 20, 0);
    assert_near(list->commands[0].bounds.w, 5, 0);
    assert_near(list->commands[0].bounds.h, 30, 0);
    drawlist_rect(list, (struct rect){60, 20, 10, 10}, theme()->text);
    drawlist_rect(list, (struct rect){25, 25, 10, 10}, 0xFFFFFF00u);
    drawlist_text(list, 25, 30, FONT_LABEL, 13, theme()->text, "");
    assert_int_equal(list->count, 1);
    drawlist_set_clip(list, before);
    drawlist_rect(list, (struct rect){60, 20, 10, 10}, theme()->text);
    assert_int_equal(list->count, 2);

    const float bad[6] = {10, 10, NAN, 20, 40, 50}, far[6] = {10, 10, 20, INFINITY, 40, 50};
    drawlist_clear(list, WHOLE); // and so are coordinates that are not finite
    drawlist_line(list, bad, 3, 1, theme()->text);
    drawlist_convex(list, far, 3, theme()->text);
    drawlist_rect(list, (struct rect){NAN, 1, 5, 5}, theme()->text);
    drawlist_line(list, (const float[]){0, 0, 5, 5}, 2, NAN, theme()->text);
    assert_int_equal(list->count, 0);
    assert_false(list->overflow);
}

/// The pools are all the memory there is: what does not fit must be missing whole, not in part.
LIST_TEST(overflow_is_told_and_harmless)
{
    char text[65] = "";
    float xy[2 * 17] = {0};
    for (int i = 0; i < 17; i++) xy[2 * i] = (float)i;
    drawlist_line(list, xy, 17, 1, theme()->text);
    assert_true(list->overflow);
    assert_int_equal(list->count, 0);
    drawlist_line(list, xy, 16, 1, theme()->text);
    assert_int_equal(list->count, 1);
    drawlist_clear(list, WHOLE);
    memset(text, 'x', 64);
    drawlist_text(list, 10, 40, FONT_LABEL, 13, theme()->text, text);
    assert_true(list->overflow);
    assert_int_equal(list->count, 0);
    drawlist_clear(list, WHOLE);
    for (int i = 0; i < 9; i++) drawlist_rect(list, (struct rect){(float)i, 1, 5, 5}, theme()->text);
    assert_true(list->overflow);
    assert_int_equal(list->count, 8);
}

LIST_TEST(long_text_is_cut_at_a_character_with_an_ellipsis)
{
    drawlist_text_fit(list, 5, 40, 60, FONT_LABEL, 13, theme()->text, "Größenänderung zu groß");
    const char *cut = list->text + list->commands[0].first;
    size_t length = strlen(cut);
    assert_true(length > 6 && length < 20);
    assert_string_equal(cut + length - 3, "…");
    assert_true(font_width(FONT_LABEL, 13, cut) <= 60);
    for (const char *at = cut; *at;) assert_true(utf8_next(&at) != 0xFFFD);
    drawlist_clear(list, WHOLE);
    drawlist_text_fit(list, 5, 40, 60, FONT_LABEL, 13, theme()->text, "short");
    assert_string_equal(list->text, "short");
}

TEST(utf8_survives_broken_bytes)
{
    static const char *const broken[] = {"\x80", "\xC3", "\xE2\x82", "\xC0\x80", "\xED\xA0\x80", "\xF5\x80\x80\x80",
                                         "\xFF"};
    static const uint32_t codes[] = {0x3B6, 0x20AC, 0x1D11E, 0};
    for (size_t i = 0; i < sizeof broken / sizeof broken[0]; i++) {
        const char *at = broken[i];
        if (utf8_next(&at) != 0xFFFD || at != broken[i] + 1) fail_msg("row %zu", i);
    }
    const char *at = "ζ€𝄞";
    for (int i = 0; i < 4; i++) assert_int_equal(utf8_next(&at), codes[i]);
}

/// Layout and drawing agree on where a text ends, at every scale; numbers stand below each other; and every sign of the interface is more than
/// the '?' that stands for missing ones.
TEST(fonts_fit_the_interface)
{
    static const float sizes[] = {THEME_TEXT_SMALL, THEME_TEXT_NORMAL, THEME_TEXT_TITLE}, scales[] = {1, 1.5f, 2};
    font_init();
    const float one = font_width(FONT_NUMBER, 13, "1");
    for (const char *c = "0123456789.-+"; *c; c++)
        assert_near(font_width(FONT_NUMBER, 13, (char[]){*c, '\0'}), one, 1e-6);
    assert_near(font_width(FONT_NUMBER, 13, "-12.5"), 5 * one, 1e-4);
    assert_true(font_cap_height(FONT_LABEL, 10) > 6 && font_cap_height(FONT_LABEL, 10) < 8);
    for (int s = 0; s < 3; s++) {
        static const char sample[] = "Wζ° → 0.5…";
        struct atlas atlas;
        assert_done(atlas_build(scales[s], &atlas, &error));
        assert_int_equal(atlas.coverage[0], 255);
        for (int i = 0; i < 3; i++) {
            float sum = 0;
            for (const char *at = sample; *at;)
                sum += atlas_glyph(&atlas, FONT_LABEL, sizes[i], utf8_next(&at))->advance;
            assert_near(sum / scales[s], font_width(FONT_LABEL, sizes[i], sample), 0.01);
        }
        for (int font = 0; s == 0 && font < FONT_COUNT; font++) {
            const struct glyph *missing = atlas_glyph(&atlas, (enum font)font, 13, '?');
            for (const char *at = "←→↑↓−°·×²…–—ζβωλ±≤≥äÖß€•√∞"; *at;) {
                uint32_t c = utf8_next(&at);
                const struct glyph *glyph = atlas_glyph(&atlas, (enum font)font, 13, c);
                if (glyph == missing || glyph->x1 == glyph->x0) fail_msg("font %d has no U+%04X", font, c);
            }
            assert_ptr_equal(atlas_glyph(&atlas, (enum font)font, 13, 0x4E00), missing);
        }
        atlas_free(&atlas);
    }
}

TEST(key_names_read_back)
{
    int named = 0;
    for (int key = KEY_NONE; key < KEY_COUNT; key++) {
        const char *name = key_name(key);
        if (!name) continue;
        named++;
        assert_int_equal(key_from_name(name), key);
    }
    assert_int_equal(named, 65 + KEY_COUNT - KEY_ESCAPE);
    assert_string_equal(key_name('Z'), "Z");
    assert_string_equal(key_name(','), ",");
    assert_string_equal(key_name(KEY_F12), "F12");
    assert_int_equal(key_from_name("F13"), KEY_NONE);
    assert_int_equal(key_from_name(""), KEY_NONE);
}
