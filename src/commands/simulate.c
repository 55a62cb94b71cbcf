/// `wiggly simulate`: shakes a mesh as a soft body.
#include "analysis/analysis.h"
#include "base/error.h"
#include "base/file.h"
#include "base/need.h"
#include "base/progress.h"
#include "commands/commands.h"
#include "commands/companion.h"
#include "commands/report.h"
#include "commands/shaking.h"
#include "model/motion.h"
#include "model/surface.h"
#include "simulation/soft.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double slow_warning = 1 / 8.0; ///< of the frequency asked for: a lowest mode below it causes a warning

struct job {
    const char *mesh, *output;
    struct mesh_options opening;
    char rest[COMPANION_PATH]; ///< path of the rest mesh beside the output
    const char *shake_text, *drive_text, *pin_text;
    struct shaking by;
    double floor; ///< height above the lowest point; below 0: none
    bool world;   ///< positions in the world, not relative to the base
};

/// Simulates, writes the motion and prints the cost. Of `soft` it changes only the body's scratch memory.
static bool simulate_shake(const struct job *job, struct soft *soft, const struct surface *surface,
                           struct error *error)
{
    const int frames = shaking_frames(&job->by), vertices = soft->lattice.vertex_count;
    const struct base_drive *drive = job->by.loads.drive;
    struct record record;
    struct file_output output;
    const double started = clock_now();
    if (!motion_start(&output, job->output, frames, vertices, error)) return false;
    bool good = record_create(&record, &job->by, soft, error);
    if (good) {
        float(*position)[3] = need_zeroed((size_t)vertices + 1, sizeof *position);
        memcpy(position, surface->position, (size_t)surface->vertex_count * sizeof *position);
        for (int frame = 0; frame < frames && !ferror(output.stream); frame++) {
            const double base = job->world && drive ? drive_place(drive, frame / job->by.fps) : 0;
            double offset[3] = {0};
            for (int c = 0; c < 3 && drive; c++) offset[c] = base * drive->direction[c];
            record_embed(&record, frame, soft, offset, position);
            fwrite(position, sizeof *position, (size_t)vertices, output.stream);
            progress_report("writing the motion", frame + 1, frames);
        }
        free(position);
        record_free(&record);
        good = file_output_commit(&output, error);
    } else {
        file_output_discard(&output);
    }
    if (!good) return false;
    const double left = record.left;

    print_line(stdout, "%s: %d frames of %d vertices at %g fps, in %.1f s", job->output, frames, vertices,
               job->by.fps, clock_now() - started);
    if (left < 0) {
        printf("  %d steps a frame; the error was not measured\n", record.substeps);
    } else {
        printf("  %d steps a frame; error of the motion %.2g %%\n", record.substeps, 100 * left);
    }
    if (drive && drive_end(drive) < job->by.seconds)
        printf("  the drive stops at %.4g s; then the body swings freely\n", drive_end(drive));
    if (left > job->by.accuracy) {
        fflush(stdout);
        print_line(
            stderr,
            "%s: warning: expected an error of the motion of at most %.3g %%, got %.2g %% when the search ended: "
            "--substeps %d or a larger --budget may come nearer, unless the motion is chaotic",
            job->output, 100 * job->by.accuracy, 100 * left, (int)fmin(2 * record.substeps, 1000));
    }
    return true;
}

// --- the command

/// Makes the body, tuned to what moves it. Where time is too short, the burst that nobody asked for gives way to a free swing.
static bool make_body(struct job *job, struct soft *soft, const struct surface *surface, struct error *error)
{
    if (!soft_create(soft, surface, job->mesh, &job->by.soft, error)) return false;

    // A burst ends in time for analyze a period before the end.
    bool fits;
    const struct base_drive *drive = &job->by.drive;
    const double seconds = shaking_seconds(&job->by, soft, &fits), period = 1 / soft_frequency(soft);
    const double end = drive_end(drive);
    if (!fits && drive->kind != DRIVE_NONE && !job->drive_text) {
        print_line(stdout,
                   "%s: swings freely, because a burst of %.4g s and a period of %.4g s do not fit into %.4g s",
                   job->mesh, end, period, seconds);
        soft_free(soft);
        shaking_drive(&job->by, DRIVE_NONE);
        return make_body(job, soft, surface, error);
    }
    if (!fits && drive->kind != DRIVE_NONE && isfinite(end) && period <= seconds)
        print_line(
            stderr,
            "%s: warning: a drive of %.4g s and a period of %.4g s do not fit into %.4g s, so analyze may take "
            "the drive for the body's swing; choose a longer time",
            job->mesh, end, period, seconds);
    job->by.seconds = seconds;
    return true;
}

static bool simulate_mesh(struct job *job, struct error *error)
{
    struct surface surface = {0};
    struct soft soft;
    progress_end_when_interrupted();
    progress_show_stages(job->by.verbose);
    if (job->by.drive.kind == DRIVE_TRACK && !drive_read_track(&job->by.drive, job->drive_text, error)) return false;
    bool good = file_check_unread(job->rest, error) && open_mesh(job->mesh, &job->opening, &surface, error) &&
                make_body(job, &soft, &surface, error);
    if (good) {
        print_line(stdout,
                   "%s: %d tetrahedra, %d nodes, %d of them pinned; Young's modulus %.4g Pa, lowest mode %.4g Hz",
                   job->mesh, soft.lattice.tet_count, soft.body.node_count, soft.pinned, soft.young,
                   soft.modes.count ? soft.modes.frequency[0] : 0);
        printf("  seen most: mode %d, %.4g Hz, with %.0f %% of the motion\n", soft.seen + 1, soft_frequency(&soft),
               100 * soft.share);
        if (!job->drive_text && (job->by.shake.impulse || soft.pinned == 0))
            printf("  swings freely, because of %s\n", job->by.shake.impulse ? "--impulse" : "--pin none");
        if (soft.lattice.repair[0]) print_line(stdout, "%s: %s", job->mesh, soft.lattice.repair);
        fflush(stdout);
        const double lowest = soft.modes.count ? soft.modes.frequency[0] : 0, period = 1 / soft_frequency(&soft);
        if (period > job->by.seconds) {
            print_line(
                stderr,
                "%s: warning: %.4g s show less than a period, %.4g s, so analyze cannot find the frequency; choose a "
                "longer time, of at most %d frames, or a stiffer body",
                job->mesh, job->by.seconds, period, ANALYSIS_FRAMES_MAX);
        }
        if (lowest < slow_warning * soft_frequency(&soft)) {
            print_line(stderr,
                       "%s: warning: the lowest mode, of %.2g Hz, is far below the %.2g Hz of the one that is seen "
                       "most; if it sways slowly, --pin more of it",
                       job->mesh, lowest, soft_frequency(&soft));
        }
        if (soft.unpinned_parts > 0 && soft.pinned > 0) {
            print_line(stderr, "%s: warning: %d of %d separate parts are not pinned and will drift", job->mesh,
                       soft.unpinned_parts, soft.lattice.part_count);
        }

        struct base_drive *drive = &job->by.drive;
        struct floor floor = {0};
        if (drive->kind != DRIVE_NONE) { // it moves the base along the shake
            memcpy(drive->direction, job->by.shake.direction, sizeof drive->direction);
            drive->size = drive->kind == DRIVE_TRACK ? 1 : job->by.shake.amplitude * soft.size;
            drive->seconds = job->by.seconds;
            job->by.loads.drive = drive;
        }
        if (job->floor >= 0) {
            floor_create(&floor, &soft.lattice, &surface, soft.bottom + job->floor, soft.young, job->by.soft.density);
            job->by.loads.floor = &floor;
        }
        good = simulate_shake(job, &soft, &surface, error);
        pool_free(&floor.pool);

        // What analyze needs to know of the motion.
        struct companion made = {
            .frames = shaking_frames(&job->by), .vertices = surface.vertex_count, .fps = job->by.fps};
        const double end = job->by.loads.drive ? drive_end(drive) : 0;
        made.from = end < job->by.seconds ? end : 0;
        made.world = job->world;
        memcpy(made.shake, job->by.shake.direction, sizeof made.shake);
        if (job->pin_text)
            snprintf(made.pin, sizeof made.pin, "%s", job->pin_text);
        else
            snprintf(made.pin, sizeof made.pin, "%.6g", 0.05 * soft.height);
        good = good && companion_write(job->output, &made, error);
        good = good && obj_write(job->rest, &surface, error);
        if (good) print_line(stdout, "%s: the mesh at rest", job->rest);
        soft_free(&soft);
    }
    surface_free(&surface);
    pool_free(&job->by.drive.pool);
    return good;
}

/// Checks what the option table cannot; NULL or an error text.
static const char *check_job(struct job *job)
{
    if (!job->output) return "-o FILE is missing: name the file to write";
    if (!path_has_end(job->output, ".npy") && !path_has_end(job->output, ".pc2"))
        return "--output: expected a name ending in .npy or .pc2";
    if (!companion_path(job->output, ".rest.obj", job->rest)) return "--output: the name is too long";
    if (!options_direction(job->shake_text, job->by.shake.direction))
        return "--shake: expected up, side, front or a vector x,y,z";
    if (job->pin_text && !region_parse(job->pin_text, &job->by.soft.pin)) return "--pin: expected " REGION_FORMS;
    if (job->pin_text && strlen(job->pin_text) >= COMPANION_PIN) return "--pin: expected fewer than 128 characters";
    static const char *const kinds[] = {"none", "sine", "burst", "sweep"}; // as in enum drive_kind
    const bool impulse = job->by.shake.impulse, unpinned = job->by.soft.pin.kind == REGION_NONE;
    const bool adjusted = job->by.drive.frequency > 0 || job->world;
    enum drive_kind kind = DRIVE_NONE;
    if (!job->drive_text && adjusted) job->drive_text = "burst";
    const char *text = job->drive_text ? job->drive_text : impulse || unpinned ? "none" : "burst";
    while (kind < DRIVE_TRACK && strcmp(text, kinds[kind]) != 0) kind++;
    shaking_drive(&job->by, kind);
    if (kind == DRIVE_NONE && adjusted) return "--drive-frequency and --world need a drive, got none";
    if (kind != DRIVE_NONE && impulse) return "--impulse and a drive both start the motion: give one";
    if (kind != DRIVE_NONE && unpinned) return "--drive moves the pinned part, but --pin none pins nothing";
    if (kind == DRIVE_TRACK && !path_has_end(text, ".csv"))
        return "--drive: expected burst, sine, sweep, a track's FILE.csv or none";
    if (kind == DRIVE_TRACK && (isfinite(job->by.amplitude) || job->by.drive.frequency > 0))
        return "--drive: a track has its own size in metres and time: leave out --amplitude and "
               "--drive-frequency";
    return shaking_check(&job->by);
}

int command_simulate(int argc, char **argv)
{
    struct job job = {.opening = {.scale = 1}, .by = shaking_default(), .shake_text = "up", .floor = -1};
    struct option_spec options[OPTIONS_MOST + 1] = {
        {"-o, --output FILE", "required: NAME.npy or NAME.pc2; beside it NAME.rest.obj, NAME.simulation.json",
         OPTION_OUTPUT, &job.output, 0, 0},
        MESH_OPTIONS(&job.opening),
        {"--shake DIR", "up, side, front or a vector x,y,z (up)", OPTION_TEXT, &job.shake_text, 0, 0},
        {"--amplitude A",
         "how far the base moves, relative to the height (0.05); swinging freely, how far the top moves (0.2)",
         OPTION_REAL, &job.by.amplitude, -2, 2},
        {"--impulse", "swing freely from a push, not deformed", OPTION_FLAG, &job.by.shake.impulse, 0, 0},
        {"--drive WHAT",
         "what shakes the pinned base: burst (default), sine, sweep, a track of seconds,metres in FILE.csv, or "
         "none: swing freely",
         OPTION_TEXT, &job.drive_text, 0, 0},
        {"--world", "write the motion as seen from outside, not from the base", OPTION_FLAG, &job.world, 0, 0},
        {"--fps N", "frames per second (24)", OPTION_REAL, &job.by.fps, 1, 1000},
        {"--pin WHERE",
         "pin below a height (1/20 of the mesh), none, plane:x,y,z,nx,ny,nz, sphere:x,y,z,r, color:RRGGBB",
         OPTION_TEXT, &job.pin_text, 0, 0},
        {"--soft MAP",
         "soften by distance (from the pin, the default with a drive), color (brightness) or FILE.npy (0 to 1 "
         "per vertex)",
         OPTION_TEXT, &job.by.soft_text, 0, 0},
        {"--damping Z", "damping ratio of that mode (0.2; swinging freely 0.03)", OPTION_REAL, &job.by.damping, 0, 1},
        {"--gravity G", "gravity in m/s^2 (0); a pinned body starts at rest under it", OPTION_REAL,
         &job.by.loads.gravity, 0, 1e4},
        {"--floor H", "a smooth floor at H above the lowest point", OPTION_REAL, &job.floor, 0, 1e6},
    };
    shaking_options(&job.by, options);
    const struct usage usage = {
        .command = "simulate",
        .operands = "MESH",
        .summary = "Shakes a mesh (OBJ, STL, PLY, OFF, glTF) as a soft body (finite elements) and writes its "
                   "vertices in every frame.",
        .options = options,
    };
    const int result = options_parse(&usage, argc, argv, &job.mesh);
    if (result != OPTIONS_RUN) return result;
    job.by.name = job.mesh;
    job.by.soft.shake = &job.by.shake;
    const char *wrong = check_job(&job);
    if (wrong) return options_wrong(&usage, "%s", wrong);
    struct error error;
    return options_end(simulate_mesh(&job, &error), &error);
}
