/// Reports unmet parts of a solution, and a glTF character's contents.
#include "commands/report.h"
#include "base/error.h"
#include "scene/pins.h"
#include <math.h>
#include <stdio.h>

static const double BELOW = 1e-4; ///< metres below a floor worth a report
static const double MET = 1e-4;   ///< of the rig's size; chains are posed in floats

static void tell_pin(const struct pin_left *left, int rig, int pin, report_tell *tell, void *user)
{
    char sentence[160];
    const double away = left ? hypot(hypot(left->way[0], left->way[1]), left->way[2]) : 0;
    if (!left || (left->is_found && away <= MET * left->size)) return;
    if (left->is_found) {
        snprintf(sentence, sizeof sentence, "rigs[%d].pins[%d]: the point stays %.3g m from its place", rig, pin,
                 away);
    } else {
        snprintf(sentence, sizeof sentence, "rigs[%d].pins[%d]: there is no such point, so the pin has no effect",
                 rig, pin);
    }
    tell(user, sentence);
}

static void tell_floor(const struct document *document, const struct floor_left *left, int rig, report_tell *tell,
                       void *user)
{
    char sentence[160];
    if (!rig_has_floor(document->rigs[rig]) || !left || left->depth < BELOW) return;
    snprintf(sentence, sizeof sentence,
             "rigs[%d].floor: knots and pins hold the character up to %.3g m below it, deepest at frame %.6g", rig,
             left->depth, document_frame(document, left->sample));
    tell(user, sentence);
}

static void tell_spline(const struct document *document, const struct evaluation *evaluation, int spline,
                        report_tell *tell, void *user)
{
    char sentence[EVALUATION_SENTENCE];
    struct error warning; // fail() makes any name printable
    if (!evaluation_sentence(evaluation, spline, sentence)) return;
    fail(&warning, ERROR_INPUT, "splines[%d]: \"%s\": %s", spline, document->splines[spline]->name, sentence);
    tell(user, warning.text);
}

static void tell_passed_over(const struct document *document, int spline, report_tell *tell, void *user)
{
    char sentence[96];
    if (!pins_move_spline(document, spline) || !spline_is_limited(document->splines[spline])) return;
    snprintf(sentence, sizeof sentence, "splines[%d].limits: ignored, because pins or a floor move this spline",
             spline);
    tell(user, sentence);
}

void solution_warnings(const struct document *document, const struct evaluation *evaluation, report_tell *tell,
                       void *user)
{
    for (int s = 0; s < evaluation->count; s++) tell_spline(document, evaluation, s, tell, user);
    for (int r = 0; r < document->rig_count; r++) {
        for (int i = 0; i < document->rigs[r]->pin_count; i++)
            tell_pin(evaluation_pin(evaluation, document, r, i), r, i, tell, user);
    }
    for (int r = 0; r < document->rig_count; r++)
        tell_floor(document, evaluation_floor(evaluation, r), r, tell, user);
    for (int s = 0; s < document->spline_count; s++) tell_passed_over(document, s, tell, user);
}

enum { DEEPEST_INDENTED = 64 };

/// Prints a tree of nodes. Below a certain depth a number replaces the indentation.
static void print_tree(const struct gltf *gltf, int root)
{
    const struct gltf_node *nodes = gltf->nodes;
    for (int n = root, depth = 0; n >= 0;) {
        if (depth <= DEEPEST_INDENTED) {
            print_line(stdout, "%*s%s", 2 + 2 * depth, "", nodes[n].name);
        } else {
            print_line(stdout, "%*s(%d deep) %s", 2 + 2 * DEEPEST_INDENTED, "", depth, nodes[n].name);
        }
        if (nodes[n].child >= 0) {
            n = nodes[n].child;
            depth++;
            continue;
        }
        for (; n >= 0 && nodes[n].next < 0; depth--) n = nodes[n].parent;
        if (n >= 0) n = nodes[n].next;
    }
}

/// Whether a chain to a tip starts at this node, not further up.
static bool begins_chain(const struct imported *imported, int node)
{
    const int parent = imported->gltf.nodes[node].parent;
    struct error branches;
    return imported->skeleton.leads[node] && chain_end(imported, node, &branches) >= 0 &&
           (parent < 0 || chain_end(imported, parent, &branches) < 0);
}

static void print_chains(const struct imported *imported)
{
    const struct gltf *gltf = &imported->gltf;
    bool any = false;
    for (int n = 0; n < gltf->node_count; n++) {
        struct chain_bones bones;
        struct error error;
        const int last = begins_chain(imported, n) ? chain_end(imported, n, &error) : -1;
        if (last < 0 || last == n) continue;
        if (!chain_find(gltf, gltf->nodes[n].name, gltf->nodes[last].name, &bones, &error)) continue;
        if (!any) puts("chains you can use with --chain:");
        print_line(stdout, "  %s:%s (%d bones)", gltf->nodes[n].name, gltf->nodes[last].name, bones.count);
        any = true;
    }
}

void contents_print(const struct imported *imported)
{
    const struct gltf *gltf = &imported->gltf;
    printf("clips:%s\n", gltf->clip_count > 0 ? "" : " none");
    for (int c = 0; c < gltf->clip_count; c++)
        print_line(stdout, "  %s (%.3g s, %s)", gltf->clips[c].name, gltf->clips[c].last - gltf->clips[c].first,
                   gltf->clips[c].loops ? "loops" : "plays once");
    printf("bones and other nodes:\n");
    for (int n = 0; n < gltf->node_count; n++) {
        if (gltf->nodes[n].parent < 0) print_tree(gltf, n);
    }
    print_chains(imported);
    if (gltf->not_shown) print_line(stdout, "not shown: %s", gltf->not_shown);
}
