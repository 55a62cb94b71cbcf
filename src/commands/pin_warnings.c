/// Puts what pins do not reach into words.
#include "commands/pin_warnings.h"
#include "scene/pins.h"
#include <math.h>
#include <stdio.h>

static const double BELOW = 1e-4; ///< metres below a floor that are told
static const double MET = 1e-4;   ///< of the rig's size: a chain is posed in floats

static void tell_pin(const struct pin_left *left, int rig, int pin, void (*tell)(void *user, const char *sentence),
                     void *user)
{
    char sentence[160];
    const double away = left ? hypot(hypot(left->way[0], left->way[1]), left->way[2]) : 0;
    if (!left || (left->is_found && away <= MET * left->size)) return;
    if (left->is_found) {
        snprintf(sentence, sizeof sentence, "rigs[%d].pins[%d]: the point stays %.3g m from its place", rig, pin,
                 away);
    } else {
        snprintf(sentence, sizeof sentence, "rigs[%d].pins[%d]: there is no such point, so nothing is held", rig,
                 pin);
    }
    tell(user, sentence);
}

static void tell_floor(const struct document *document, const struct floor_left *left, int rig,
                       void (*tell)(void *user, const char *sentence), void *user)
{
    char sentence[160];
    if (!rig_has_floor(document->rigs[rig]) || !left || left->depth < BELOW) return;
    snprintf(sentence, sizeof sentence,
             "rigs[%d].floor: knots and pins hold the character up to %.3g m below it, deepest at frame %.6g", rig,
             left->depth, document_frame(document, left->sample));
    tell(user, sentence);
}

static void tell_passed_over(int spline, const char *what, void (*tell)(void *user, const char *sentence), void *user)
{
    char sentence[80];
    snprintf(sentence, sizeof sentence, "splines[%d].%s", spline, what);
    tell(user, sentence);
}

void pin_warnings(const struct document *document, const struct evaluation *evaluation,
                  void (*tell)(void *user, const char *sentence), void *user)
{
    for (int r = 0; r < document->rig_count; r++) {
        for (int i = 0; i < document->rigs[r]->pin_count; i++)
            tell_pin(evaluation_pin(evaluation, document, r, i), r, i, tell, user);
    }
    for (int r = 0; r < document->rig_count; r++)
        tell_floor(document, evaluation_floor(evaluation, r), r, tell, user);
    for (int s = 0; s < document->spline_count; s++) {
        if (!pins_move_spline(document, s)) continue;
        const struct param *parameter = document->splines[s]->parameter;
        if (isfinite(parameter[PARAMETER_LOW].value) || isfinite(parameter[PARAMETER_HIGH].value))
            tell_passed_over(s, "limits: pins and floors pass over them", tell, user);
    }
}
