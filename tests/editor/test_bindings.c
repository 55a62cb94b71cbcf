/// Keyboards of other countries: every action has a key there, and what is typed is what counts, not the key that types it.
#include "editor/state.h"
#include "panel_session.h"

static const char scene[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, \"knots\": "
    "[{\"frame\": 0, \"value\": 0}, {\"frame\": 36, \"value\": 1}, {\"frame\": 60, \"value\": 0}]}]}";

static const char three_splines[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [{\"name\": \"a\", \"knots\": []}, "
    "{\"name\": \"b\", \"knots\": []}, {\"name\": \"c\", \"knots\": []}]}";

/// The punctuation of a layout as xkb-data 2.35 has it. Letters, digits by their places and keys with a name are on all of them.
static const struct layout_of {
    const char *name;
    const char *printed; ///< on a key's lower left, but for the row of digits, which are bound by place
    const char *typed;   ///< with Shift or without, not with AltGr
} layouts[] = {
    {"us", "-=[];'`\\,./<", "!@#$%^&*()-_=+[{]};:'\"`~\\|,<.>/?"},
    {"fr", ")=$*,;:!<", "&\"'(-_)=+$%*,?;.:/!<>"},
    {"be", ")-$,;:=<", "&\"'(!)-_$*%,?;.:/=+<>"},
    {"de", "+#,.-<", "!\"$%&/()=?+*#',;.:-_<>"},
    {"ch", "'$,.-<", "+\"*%&/()='?!$,;.:-_<>"},
    {"no", "+\\|',.-<", "!\"#%&/()=+?\\|'*,;.:-_<>"},
    {"se", "+',.-<", "!\"#%&/()=+?'*,;.:-_<>"},
    {"dk", "+',.-<", "!\"#%&/()=+?'*,;.:-_<>"},
    {"ru", "-=\\./", "!\";%:?*()-_=+\\/.,|"},
};

static bool is_punctuation(int key) { return key < KEY_ESCAPE && key != KEY_SPACE && !isalnum(key); }

/// Whether a command can be reached: one of its keys is on the layout.
static bool is_reached(const struct command *command, const struct layout_of *layout)
{
    for (const struct chord *c = command->chords; c->key; c++) {
        const char *keys = c->mods & CHORD_TYPED ? layout->typed : layout->printed;
        if (!is_punctuation(c->key) || strchr(keys, c->key)) return true;
    }
    return command->chords[0].key == 0;
}

TEST(test_every_layout_has_a_key_for_every_command)
{
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++) {
        for (int c = 0; c < command_count; c++) {
            if (!is_reached(&commands[c], &layouts[i]))
                fail_msg("%s has no key for “%s”", layouts[i].name, commands[c].name);
        }
    }
}

TEST(test_no_key_is_bound_twice)
{
    for (int c = 0; c < command_count; c++) {
        for (const struct chord *chord = commands[c].chords; chord->key; chord++) {
            if (keys_command(chord->key, chord->mods) != &commands[c])
                fail_msg("%s with modifiers %u is bound twice", key_name(chord->key), chord->mods);
            assert_true(!is_punctuation(chord->key) ||
                        chord->mods); // it would act once more when its character comes
        }
    }
}

/// AZERTY has - on the key of the 6, and needs Shift for 1, 5 and the point.
SESSION_TEST(test_a_factor_is_what_is_typed, session_open(s, scene))
{
    session_key(s, 'A', MOD_CTRL);
    session_type(s, "sy");
    session_strike(s, '6', 0, '-');
    session_strike(s, '1', MOD_SHIFT, '1');
    session_strike(s, ';', MOD_SHIFT, '.');
    session_strike(s, '7', MOD_SHIFT, '7');
    session_key(s, KEY_BACKSPACE, 0);
    session_strike(s, '5', MOD_SHIFT, '5');
    session_key(s, KEY_ENTER, 0);
    const struct knot *knots = s->document->splines[0]->knots;
    assert_near(knots[0].value, 1.25, 1e-9);
    assert_near(knots[1].value, -0.25, 1e-9);
}

SESSION_TEST(test_punctuation_is_what_is_typed, session_open(s, scene))
{
    const struct playback *playback = playback_of(s->editor);
    session_strike(s, '6', 0, '-'); // AZERTY
    assert_near(playback->speed, 0.5, 0);
    session_strike(s, '0', MOD_SHIFT, '='); // QWERTZ
    assert_near(playback->speed, 1, 0);
    session_strike(s, '8', 0, '[');         // with AltGr
    session_strike(s, ';', MOD_SHIFT, '.'); // AZERTY
    assert_int_equal(selection_count(selection_of(s->editor), s->document->splines[0]), 1);
    session_strike(s, '<', MOD_SHIFT, '>');
    assert_int_equal(selection_count(selection_of(s->editor), s->document->splines[0]), 2);
}

SESSION_TEST(test_a_part_is_played_without_brackets, session_open(s, scene))
{
    const struct playback *playback = playback_of(s->editor);
    seek(s->editor, 20);
    session_key(s, KEY_HOME, MOD_CTRL);
    seek(s->editor, 50);
    session_key(s, KEY_END, MOD_CTRL);
    assert_true(plays_part(s->editor));
    assert_near(playback->range[0], 20, 0);
    assert_near(playback->range[1], 50, 0);
}

SESSION_TEST(test_a_key_kept_down_is_one_press_where_it_should, session_open(s, scene))
{
    session_hold(s, '6', ACTION_PRESS);
    for (int i = 0; i < 3; i++) {
        session_send(s, (struct event){.kind = EVENT_TEXT, .codepoint = '-'});
        session_frame(s);
        session_hold(s, '6', ACTION_REPEAT);
    }
    assert_near(playback_of(s->editor)->speed, 0.5, 0);
}

TEST(test_a_key_kept_down_goes_on_through_the_splines)
{
    static const struct {
        int key, after[3];
    } cases[] = {{KEY_PAGE_UP, {2, 1, 0}}, {KEY_PAGE_DOWN, {1, 2, 0}}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        struct session s;
        session_open(&s, three_splines);
        for (int i = 0; i < 3; i++) {
            session_hold(&s, cases[c].key, i ? ACTION_REPEAT : ACTION_PRESS);
            session_frame(&s);
            assert_int_equal(active(s.editor), cases[c].after[i]);
        }
        session_close(&s);
    }
}

SESSION_TEST(test_a_key_that_opens_something_types_nothing, session_open(s, scene))
{
    session_type(s, "a"); // the menu of what can be added
    assert_int_equal(inspector_of(s->editor)->popup.filter.typed[0], '\0');
    session_type(s, "tai");
    session_key(s, KEY_ENTER, 0);
    assert_int_equal(s->document->rigs[s->document->rig_count - 1]->kind, RIG_TAIL);
}
