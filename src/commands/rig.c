/// `wiggly rig`: adds chains to the bones of a glTF character and writes a scene or an animated glTF file.
#include "base/error.h"
#include "base/file.h"
#include "base/need.h"
#include "commands/commands.h"
#include "commands/report.h"
#include "export/export.h"
#include "rig/import.h"
#include "scene/load.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct job {
    const char *character, *output, *clip;
    struct option_list chains;
    struct chain_wish wish; ///< the settings of every chain
    bool plain, all_clips, loop, once;
};

/// Splits "A:B" or "A" in place. Names may contain colons, so the splitting colon is one between two existing bones.
static const char *split_chain(const struct gltf *gltf, char *text)
{
    char *last = NULL;
    if (gltf_find_node(gltf, text) >= 0) return NULL;
    for (char *colon = strchr(text, ':'); colon; colon = strchr(colon + 1, ':')) {
        if (last) *last = ':';
        last = colon;
        *colon = '\0';
        if (gltf_find_node(gltf, text) >= 0 && gltf_find_node(gltf, colon + 1) >= 0) break;
    }
    return last ? last + 1 : NULL;
}

int command_rig(int argc, char **argv)
{
    struct job job = {0};
    const struct option_spec options[] = {
        {"-c, --chain A:B", "make a chain of the bones from A to B, or to the tip below A; can be repeated",
         OPTION_LIST, &job.chains, 0, 0},
        {"-o, --output FILE", "scene to write (.json), or the character with its motion (.glb, …)", OPTION_OUTPUT,
         &job.output, 0, 0},
        {"--clip NAME", "clip to play (default: the first)", OPTION_TEXT, &job.clip, 0, 0},
        {"--loop", "let that clip begin again after its end (default: as its keys say)", OPTION_FLAG, &job.loop, 0,
         0},
        {"--once", "let that clip play once and stay at its end", OPTION_FLAG, &job.once, 0, 0},
        {"--all-clips", "put the chains on every clip of the file (.glb, .gltf)", OPTION_FLAG, &job.all_clips, 0, 0},
        {"--frequency HZ", "swings per second (default: by the chain's length)", OPTION_REAL, &job.wish.frequency,
         1e-3, 1e3},
        {"--damping RATIO", "damping ratio: 0 swings forever, 1 is critical (default: 0.12)", OPTION_REAL,
         &job.wish.damping, 1e-6, 1},
        {"--lag DEGREES", "how far each bone lags behind the one before", OPTION_REAL, &job.wish.lag, 1e-6, 360},
        {"--own-splines", "give every chain its own splines (default: left and right share them, mirrored)",
         OPTION_FLAG, &job.wish.own, 0, 0},
        {"--plain", "do not follow the clip: only knots move the chains", OPTION_FLAG, &job.plain, 0, 0},
        {0},
    };
    const struct usage usage = {
        .command = "rig",
        .operands = "character.glb",
        .summary = "Gives a character's tail, ears or hair follow-through. Without -o, lists its clips and bones.",
        .options = options,
    };
    const int result = options_parse(&usage, argc, argv, &job.character);
    if (result != OPTIONS_RUN) return result;

    const bool as_scene = job.output && path_has_end(job.output, ".json");
    const struct export_format *format = job.output ? export_format(job.output) : NULL;
    if (!import_suits(job.character))
        return options_wrong(&usage, "expected a character ending in .glb or .gltf, got '%s'", job.character);
    if (job.chains.count > 0 && !job.output)
        return options_wrong(&usage, "-o FILE is missing: name the file to write");
    if (job.output && !as_scene && (!format || format->film))
        return options_wrong(&usage, "--output: expected a scene (.json) or a character (.glb), got '%s'",
                             job.output);
    if (job.all_clips && (!job.output || as_scene))
        return options_wrong(&usage, "--all-clips: expected a character to write (-o FILE.glb)");
    if (job.loop && job.once) return options_wrong(&usage, "expected one of --loop and --once, got both");

    struct opened opened;
    struct error error;
    if (!opened_read(&opened, job.character, &error)) return options_end(false, &error);
    bool done = true;
    const struct imported *character = models_imported(opened.models, opened.document, 0);
    if (!job.output) {
        contents_print(character);
    } else {
        const struct gltf *gltf = &character->gltf;
        const enum clip_repeat repeat = job.loop ? REPEAT_LOOP : job.once ? REPEAT_ONCE : REPEAT_BY_CLIP;
        const char *clip = job.clip ? job.clip : opened.document->rigs[0]->model.clip;
        done = import_choose_clip(opened.document, 0, gltf, clip, repeat, &error);
        job.wish.follows = !job.plain && opened.document->rigs[0]->model.clip;
        for (int c = 0; done && c < job.chains.count; c++) {
            int rig;
            char *from = need_text(job.chains.text[c]);
            job.wish.to = split_chain(gltf, from);
            job.wish.from = from;
            done = chain_make(opened.document, opened.models, &job.wish, &rig, &error);
            free(from);
        }
        struct export_report report;
        done = done && models_update(opened.models, opened.document, &error);
        if (done && as_scene) {
            done = scene_save(opened.document, job.output, &error);
        } else if (done) {
            const struct export_options to = {.all_clips = job.all_clips};
            opened_solve(&opened, SOLVER_BY_LENGTH);
            const struct posing posing = opened_posing(&opened);
            done = export_write(&posing, job.output, &to, &report, &error);
            if (done && *report.note) print_line(stderr, "%s: warning: %s", job.output, report.note);
        }
        if (done) {
            // "; clip Walk loops"; the name of a nameless one, "clip 2", says it already.
            const struct model_rig *model = &opened.document->rigs[0]->model;
            gltf = &models_imported(opened.models, opened.document, 0)->gltf; // models_update() may have moved it
            const int number = gltf_find_clip(gltf, model->clip);
            const char *before = number < 0 ? "" : strncmp(model->clip, "clip ", 5) == 0 ? "; " : "; clip ";
            const char *name = number < 0 ? "" : model->clip;
            const char *plays = number < 0                                     ? ""
                                : clip_play(model, &gltf->clips[number]).loops ? " loops"
                                                                               : " plays once";
            if (as_scene) {
                print_line(stdout, "wrote %s: %d chain%s%s%s%s; wiggly %s shows it", job.output, job.chains.count,
                           job.chains.count == 1 ? "" : "s", before, name, plays, job.output);
            } else {
                print_line(stdout, "wrote %s: %s%s%s%s", job.output, report.text, before, name, plays);
            }
            if (job.wish.follows && job.chains.count > 0)
                printf(
                    "each chain has the gain with which the clip's largest swing turns its tip by up to %d degrees\n",
                    CHAIN_SWING);
        }
    }
    opened_free(&opened);
    return options_end(done, &error);
}
