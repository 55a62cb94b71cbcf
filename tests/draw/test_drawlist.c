/// The draw list (what the editor records), text layout and key names: all without a screen.
#include "near.h"

#include "ui/event.h"
#include "ui/font.h"
#include "ui/theme.h"

static const struct rect WHOLE = {0.0f, 0.0f, 200.0f, 100.0f};

struct fixture {
    struct drawlist list;
};

static int set_up(void **state)
{
    static struct fixture fixture;
    *state = &fixture;
    drawlist_create(&fixture.list, 8, 16, 64);
    font_init();
    return 0;
}

static int tear_down(void **state)
{
    struct fixture *fixture = *state;
    drawlist_destroy(&fixture->list);
    return 0;
}

static struct drawlist *fresh(void **state)
{
    struct fixture *fixture = *state;
    drawlist_clear(&fixture->list, WHOLE);
    return &fixture->list;
}

/// Hash of a line from (10, 10) to (x, 50) with everything else as told.
static uint64_t line_hash(struct drawlist *list, float x, float width, float on, uint32_t color, struct rect clip)
{
    const float xy[4] = {10.0f, 10.0f, x, 50.0f};
    drawlist_clear(list, clip);
    drawlist_dashed(list, xy, 2, width, on, 4.0f, color);
    assert_int_equal(list->count, 1);
    return list->commands[0].hash;
}

// A change that the hash does not see would stay invisible on the screen.
TEST(test_hash_sees_every_change)
{
    struct drawlist *list = fresh(state);
    uint64_t hash = line_hash(list, 60.0f, 2.0f, 6.0f, theme()->text, WHOLE);
    assert_true(hash == line_hash(list, 60.0f, 2.0f, 6.0f, theme()->text, WHOLE));
    assert_true(hash != line_hash(list, 60.25f, 2.0f, 6.0f, theme()->text, WHOLE));
    assert_true(hash != line_hash(list, 60.0f, 2.5f, 6.0f, theme()->text, WHOLE));
    assert_true(hash != line_hash(list, 60.0f, 2.0f, 5.0f, theme()->text, WHOLE));
    assert_true(hash != line_hash(list, 60.0f, 2.0f, 6.0f, theme_fade(theme()->text, 0.5f), WHOLE));
    assert_true(hash != line_hash(list, 60.0f, 2.0f, 6.0f, theme()->text, (struct rect){0.0f, 0.0f, 199.0f, 100.0f}));
}

static uint64_t text_hash(struct drawlist *list, float x, float size, enum font font, const char *text)
{
    drawlist_clear(list, WHOLE);
    drawlist_text(list, x, 40.0f, font, size, theme()->text, text);
    assert_int_equal(list->count, 1);
    return list->commands[0].hash;
}

TEST(test_text_hash_sees_every_change)
{
    struct drawlist *list = fresh(state);
    uint64_t hash = text_hash(list, 10.0f, 13.0f, FONT_LABEL, "frame 36");
    assert_true(hash == text_hash(list, 10.0f, 13.0f, FONT_LABEL, "frame 36"));
    assert_true(hash != text_hash(list, 10.0f, 13.0f, FONT_LABEL, "frame 37"));
    assert_true(hash != text_hash(list, 11.0f, 13.0f, FONT_LABEL, "frame 36"));
    assert_true(hash != text_hash(list, 10.0f, 11.0f, FONT_LABEL, "frame 36"));
    assert_true(hash != text_hash(list, 10.0f, 13.0f, FONT_LABEL_BOLD, "frame 36"));
}

TEST(test_bounds_are_clipped_and_the_unseen_left_out)
{
    struct drawlist *list = fresh(state);
    struct rect before = drawlist_push_clip(list, (struct rect){20.0f, 20.0f, 30.0f, 30.0f});
    drawlist_rect(list, (struct rect){0.0f, 0.0f, 25.0f, 90.0f}, theme()->text);
    assert_int_equal(list->count, 1);
    assert_near(list->commands[0].bounds.x, 20.0, 0.0);
    assert_near(list->commands[0].bounds.w, 5.0, 0.0);
    assert_near(list->commands[0].bounds.h, 30.0, 0.0);
    drawlist_rect(list, (struct rect){60.0f, 20.0f, 10.0f, 10.0f}, theme()->text);
    drawlist_rect(list, (struct rect){25.0f, 25.0f, 10.0f, 10.0f}, 0xFFFFFF00u);
    drawlist_text(list, 25.0f, 30.0f, FONT_LABEL, 13.0f, theme()->text, "");
    assert_int_equal(list->count, 1);
    drawlist_set_clip(list, before);
    drawlist_rect(list, (struct rect){60.0f, 20.0f, 10.0f, 10.0f}, theme()->text);
    assert_int_equal(list->count, 2);
}

TEST(test_coordinates_that_are_not_finite_are_left_out)
{
    struct drawlist *list = fresh(state);
    const float bad[6] = {10.0f, 10.0f, NAN, 20.0f, 40.0f, 50.0f},
                far[6] = {10.0f, 10.0f, 20.0f, INFINITY, 40.0f, 50.0f};
    drawlist_line(list, bad, 3, 1.0f, theme()->text);
    drawlist_convex(list, far, 3, theme()->text);
    drawlist_rect(list, (struct rect){NAN, 1.0f, 5.0f, 5.0f}, theme()->text);
    drawlist_line(list, (const float[]){0.0f, 0.0f, 5.0f, 5.0f}, 2, NAN, theme()->text);
    assert_int_equal(list->count, 0);
    assert_false(list->overflow);
}

// The pools are all the memory there is: what does not fit must be missing whole, not in part.
TEST(test_overflow_is_told_and_harmless)
{
    struct drawlist *list = fresh(state);
    float xy[2 * 17] = {0};
    for (int i = 0; i < 17; i++) xy[2 * i] = (float)i;
    drawlist_line(list, xy, 17, 1.0f, theme()->text);
    assert_true(list->overflow);
    assert_int_equal(list->count, 0);
    drawlist_line(list, xy, 16, 1.0f, theme()->text);
    assert_int_equal(list->count, 1);
    drawlist_clear(list, WHOLE);
    char text[65] = "";
    memset(text, 'x', 64);
    drawlist_text(list, 10.0f, 40.0f, FONT_LABEL, 13.0f, theme()->text, text);
    assert_true(list->overflow);
    assert_int_equal(list->count, 0);
    drawlist_clear(list, WHOLE);
    for (int i = 0; i < 9; i++) drawlist_rect(list, (struct rect){(float)i, 1.0f, 5.0f, 5.0f}, theme()->text);
    assert_true(list->overflow);
    assert_int_equal(list->count, 8);
}

TEST(test_long_text_is_cut_at_a_character_with_an_ellipsis)
{
    struct drawlist *list = fresh(state);
    const float width = 60.0f;
    drawlist_text_fit(list, 5.0f, 40.0f, width, FONT_LABEL, 13.0f, theme()->text, "Größenänderung zu groß");
    const char *cut = list->text + list->commands[0].first;
    size_t length = strlen(cut);
    assert_true(length > 6 && length < 20);
    assert_string_equal(cut + length - 3, "…");
    assert_true(font_width(FONT_LABEL, 13.0f, cut) <= width);
    for (const char *at = cut; *at;) assert_true(utf8_next(&at) != 0xFFFD);
    drawlist_clear(list, WHOLE);
    drawlist_text_fit(list, 5.0f, 40.0f, width, FONT_LABEL, 13.0f, theme()->text, "short");
    assert_string_equal(list->text, "short");
}

TEST(test_utf8_survives_broken_bytes)
{
    const char *broken[] = {"\x80", "\xC3", "\xE2\x82", "\xC0\x80", "\xED\xA0\x80", "\xF5\x80\x80\x80", "\xFF"};
    for (size_t i = 0; i < sizeof broken / sizeof broken[0]; i++) {
        const char *at = broken[i];
        assert_int_equal(utf8_next(&at), 0xFFFD);
        assert_ptr_equal(at, broken[i] + 1);
    }
    const char *at = "ζ€𝄞";
    assert_int_equal(utf8_next(&at), 0x3B6);
    assert_int_equal(utf8_next(&at), 0x20AC);
    assert_int_equal(utf8_next(&at), 0x1D11E);
    assert_int_equal(utf8_next(&at), 0);
}

TEST(test_number_font_is_tabular)
{
    float one = font_width(FONT_NUMBER, 13.0f, "1");
    for (const char *c = "0123456789.-+"; *c; c++) {
        assert_near(font_width(FONT_NUMBER, 13.0f, (char[]){*c, '\0'}), one, 1.0e-6);
    }
    assert_near(font_width(FONT_NUMBER, 13.0f, "-12.5"), 5.0f * one, 1.0e-4);
    assert_true(font_cap_height(FONT_LABEL, 10.0f) > 6.0f && font_cap_height(FONT_LABEL, 10.0f) < 8.0f);
}

// Layout and drawing must agree on where a text ends, at every scale.
TEST(test_atlas_advances_match_layout)
{
    const char *sample = "Wζ° → 0.5…";
    const float sizes[] = {THEME_TEXT_SMALL, THEME_TEXT_NORMAL, THEME_TEXT_TITLE}, scales[] = {1.0f, 1.5f, 2.0f};
    for (int i = 0; i < 9; i++) {
        struct atlas atlas;
        float size = sizes[i % 3], scale = scales[i / 3], sum = 0.0f;
        assert_done(atlas_build(scale, &atlas, &error));
        for (const char *at = sample; *at;) sum += atlas_glyph(&atlas, FONT_LABEL, size, utf8_next(&at))->advance;
        assert_near(sum / scale, font_width(FONT_LABEL, size, sample), 0.01);
        assert_int_equal(atlas.coverage[0], 255);
        atlas_free(&atlas);
    }
}

// Every sign of the interface must be more than the '?' that stands for missing ones.
TEST(test_atlas_has_the_signs_of_the_interface)
{
    struct atlas atlas;
    assert_done(atlas_build(1.0f, &atlas, &error));
    for (int font = 0; font < FONT_COUNT; font++) {
        const struct glyph *missing = atlas_glyph(&atlas, (enum font)font, 13.0f, '?');
        for (const char *at = "←→↑↓−°·×²…–—ζβωλ±≤≥äÖß€•√∞"; *at;) {
            uint32_t c = utf8_next(&at);
            const struct glyph *glyph = atlas_glyph(&atlas, (enum font)font, 13.0f, c);
            if (glyph == missing || glyph->x1 == glyph->x0) fail_msg("font %d has no U+%04X", font, c);
        }
        assert_ptr_equal(atlas_glyph(&atlas, (enum font)font, 13.0f, 0x4E00), missing);
    }
    atlas_free(&atlas);
}

TEST(test_key_names_read_back)
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

TESTS_BETWEEN(set_up, tear_down)
