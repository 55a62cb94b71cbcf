/// Reports unmet parts of a solution, a glTF character's contents, and progress; and handles Ctrl+C.
#include "commands/report.h"
#include "base/error.h"
#include "base/file.h"
#include "base/progress.h"
#include "scene/pins.h"
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

static const double BELOW = 1e-4; ///< metres below a floor worth a report
static const double MET = 1e-4;   ///< of the rig's size; chains are posed in floats

/// Standard output is a list of warnings; on standard error a line starts with the file's name.
#define WARN(out, path, format, ...)                                                                                 \
    print_line(out, "%s%s: %s" format, (out) == stdout ? "warning: " : "", path,                                     \
               (out) == stdout ? "" : "warning: ", __VA_ARGS__)

void solution_warnings(const struct document *document, const struct evaluation *evaluation, const char *path,
                       FILE *out)
{
    char solved[EVALUATION_SENTENCE];
    for (int s = 0; s < evaluation->count; s++) {
        if (evaluation_sentence(evaluation, s, solved))
            WARN(out, path, "splines[%d]: \"%s\": %s", s, document->splines[s]->name, solved);
    }
    for (int r = 0; r < document->rig_count; r++) {
        for (int p = 0; p < document->rigs[r]->pin_count; p++) {
            const struct pin_left *left = evaluation_pin(evaluation, document, r, p);
            const double away = left ? hypot(hypot(left->way[0], left->way[1]), left->way[2]) : 0;
            if (left && !left->is_found)
                WARN(out, path, "rigs[%d].pins[%d]: there is no such point, so the pin has no effect", r, p);
            else if (left && !(away <= MET * left->size))
                WARN(out, path, "rigs[%d].pins[%d]: the point stays %.3g m from its place", r, p, away);
        }
    }
    for (int r = 0; r < document->rig_count; r++) {
        const struct floor_left *left = evaluation_floor(evaluation, r);
        if (!rig_has_floor(document->rigs[r]) || !left || left->depth < BELOW) continue;
        WARN(out, path,
             "rigs[%d].floor: knots and pins hold the character up to %.3g m below it, deepest at frame %.6g", r,
             left->depth, document_frame(document, left->sample) + document->rigs[r]->offset);
    }
    for (int s = 0; s < document->spline_count; s++) {
        if (pins_move_spline(document, s) && spline_is_limited(document->splines[s]))
            WARN(out, path, "splines[%d].limits: ignored, because pins or a floor move this spline", s);
    }
}

void contents_print(const struct imported *imported)
{
    enum { DEEPEST_INDENTED = 64 };
    const struct gltf *gltf = &imported->gltf;
    printf("clips:%s\n", gltf->clip_count > 0 ? "" : " none");
    for (int c = 0; c < gltf->clip_count; c++)
        print_line(stdout, "  %s (%.3g s, %s)", gltf->clips[c].name, gltf->clips[c].last - gltf->clips[c].first,
                   gltf->clips[c].loops ? "loops" : "plays once");
    printf("bones and other nodes:\n");
    for (int root = 0; root < gltf->node_count; root++) {
        const struct gltf_node *nodes = gltf->nodes;
        for (int n = nodes[root].parent < 0 ? root : -1, depth = 0; n >= 0;) {
            if (depth <= DEEPEST_INDENTED) {
                print_line(stdout, "%*s%s", 2 + 2 * depth, "", nodes[n].name);
            } else { // a number replaces the indentation
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
    bool any = false;
    for (int m = 0; m < gltf->mesh_count; m++) {
        for (int t = 0; t < gltf->meshes[m].target_count; t++) {
            const char *name = gltf_target_name(&gltf->meshes[m], t);
            if (name && !any) puts("shapes:");
            if (name) print_line(stdout, "  %s", name);
            any = any || name;
        }
    }
    any = false;
    for (int n = 0; n < gltf->node_count; n++) {
        struct chain_bones bones;
        struct error error;
        const int parent = gltf->nodes[n].parent,
                  last = imported->skeleton.leads[n] ? chain_end(imported, n, &error) : -1;
        if (last < 0) continue;
        if (parent >= 0 && chain_end(imported, parent, &error) >= 0) continue; // the chain starts further up
        if (!chain_find(gltf, gltf->nodes[n].name, gltf->nodes[last].name, &bones, &error)) continue;
        if (!any) puts("chains you can use with --chain:");
        print_line(stdout, "  %s%s%s (%d bone%s)", gltf->nodes[n].name, last == n ? "" : ":",
                   last == n ? "" : gltf->nodes[last].name, bones.count, last == n ? "" : "s");
        any = true;
    }
    if (gltf->not_shown) print_line(stdout, "not shown: %s", gltf->not_shown);
}

// --- progress

/// A signal handler: only async-signal-safe calls.
static void end_at_once(int signal_number)
{
    static const char text[] = "interrupted; nothing half-written is left\n";
    (void)signal_number;
    file_remove_unfinished();
    const ssize_t told = write(STDERR_FILENO, text, sizeof text - 1);
    (void)told; // nothing to do on failure
    _exit(ERROR_ENVIRONMENT);
}

void progress_end_when_interrupted(void)
{
    struct sigaction action = {.sa_handler = end_at_once, .sa_flags = (int)SA_RESETHAND};
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

void progress_clear(const struct progress *progress)
{
    if (progress->shown > 0 && isatty(STDERR_FILENO)) fputs("\r\033[K", stderr);
}

void progress_show(struct progress *progress, long done, long total)
{
    const bool terminal = isatty(STDERR_FILENO);
    const double now = clock_now(), left = (now - progress->started) * (double)(total - done) / (double)done;
    const bool tenth = done == 0 || done * 10 / total != progress->done * 10 / total;
    progress->done = done;
    if (terminal && done == total) progress_clear(progress);
    const bool due = terminal ? done > 0 && done < total && now - progress->started > 1 && now - progress->shown > 0.1
                              : progress->lines && tenth;
    if (!due) return;
    progress->shown = now;
    if (terminal) fputc('\r', stderr);
    if (progress->doing) {
        fprintf(stderr, "%s: %ld %%", progress->doing, 100 * done / total);
    } else {
        fprintf(stderr, "frame %ld of %ld", done, total);
    }
    if (done > 0) fprintf(stderr, ", %.0f s left", ceil(left));
    fputs(terminal ? "\033[K" : "\n", stderr);
    fflush(stderr);
}

static struct progress stage;

static void show_stage(const char *doing, long done, long total)
{
    if (doing != stage.doing || done < stage.done) {
        progress_clear(&stage);
        stage = (struct progress){.started = clock_now(), .lines = stage.lines, .doing = doing};
    }
    progress_show(&stage, done, total);
}

void progress_show_stages(bool lines)
{
    stage.lines = lines;
    progress_listen(show_stage);
}
