/// What a hand reaches for daily: pause, undo, the palette.
#include "panel_session.h"

static const char scene[] =
    "{\"frames\": [0, 100], \"substeps\": 2, \"splines\": [{\"name\": \"sway\", \"frequency\": 1, "
    "\"damping\": 0.1, \"knots\": [{\"frame\": 0, \"value\": 0}, {\"frame\": 40, \"value\": 1}]}]}";

/// What the status line shows is where the playhead is, so that the next edit moves nothing.
SESSION_TEST(test_pause_stops_on_a_frame, panel_open(s, scene, 1280, 720))
{
    seek(s->editor, 20);
    session_key(s, KEY_SPACE, 0);
    for (double dt = 0.01; dt < 0.05; dt += 0.01) {
        editor_advance(s->editor, dt);
        const double frame = shown_frame(s->editor);
        session_key(s, KEY_SPACE, 0);
        assert_near(shown_frame(s->editor), round(frame), 0);
        session_key(s, KEY_SPACE, 0);
    }
}
