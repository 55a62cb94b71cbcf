/// Equilibria that follow a joint: read, printed, edited, baked once and again when something has changed, and solved as tracks are.
#include "session.h"
#include "world.h"

#include "scene/evaluate.h"

#define MODELS                                                                                                       \
    "\"rigs\": [{\"type\": \"model\", \"name\": \"dog\", \"model\": \"dog.glb\", \"clip\": \"Walk\"},"               \
    " {\"type\": \"chain\", \"name\": \"tail\", \"model\": \"dog\", \"from\": \"a\", \"to\": \"b\"}]}"

static const char scene[] =
    "{\"frames\": [0, 48], \"substeps\": 2, \"splines\": ["
    "{\"name\": \"wag\", \"frequency\": 1.5, \"damping\": 0.1, \"knots\": [{\"frame\": 10, \"value\": 2}],"
    " \"equilibrium\": {\"model\": \"dog\", \"joint\": \"hips\", \"of\": \"across\", \"gain\": -2.5,"
    " \"chain\": \"tail\", \"why\": 1}},"
    "{\"name\": \"ear\", \"start\": \"loop\", \"frequency\": 2, \"damping\": 0.2,"
    " \"equilibrium\": {\"model\": \"dog.glb\", \"joint\": \"head\", \"of\": \"turn\"}},"
    "{\"name\": \"tip\", \"frequency\": 1, \"damping\": 0.3, \"equilibrium\": {\"spline\": \"wag\"}},"
    "{\"name\": \"alone\", \"knots\": [{\"frame\": 3, \"value\": 1}]}], " MODELS;

enum { WAG, EAR, TIP, ALONE, SPLINES };
enum { DOG, TAIL };

/// A scene under edit, and its solution.
struct stand {
    struct world world;
    struct evaluation evaluation;
    bool is_missing; ///< nothing can be read
    int reads;
};

/// A walk that depends on all that a reader may look at.
static bool read_walk(void *context, const struct document *document, const struct joint_motion *motion,
                      double *samples)
{
    struct stand *stand = context;
    const int model = document_find_model(document, motion->model, motion->by_file);
    stand->reads++;
    if (stand->is_missing || model < 0) return false;
    const char *clip = document->rigs[model]->model.clip;
    const double pace = clip ? (double)strlen(clip) : 0;
    for (int i = 0; i < document_samples(document); i++) {
        const double seconds = document_frame(document, i) / document->fps;
        samples[i] = sin(pace * seconds + (double)motion->of) + 0.01 * (double)strlen(motion->joint);
    }
    return true;
}

static void stand_open(struct stand *stand)
{
    *stand = (struct stand){.evaluation.models = {.follow = read_walk, .context = stand, .version = 1}};
    world_open_scene(&stand->world, scene);
}

static void stand_close(struct stand *stand)
{
    evaluation_free(&stand->evaluation);
    world_close(&stand->world);
}

#define STAND_TEST(name) TEST_OF(struct stand, stand, stand_open(stand), stand_close(stand), name)

/// Solves what the edits since the last call made out of date. Whether anything was.
static bool stand_update(struct stand *stand)
{
    evaluation_update(&stand->evaluation, stand->world.document, false);
    return stand->evaluation.solved_splines > 0;
}

/// Solved by hand, with the same samples as a track.
static void assert_solved(struct stand *stand, int index, double gain)
{
    const struct document *document = stand->world.document;
    const struct spline *spline = document->splines[index];
    const struct joint_motion *motion = spline->parameter[PARAMETER_EQUILIBRIUM].motion;
    const int count = document_samples(document);
    double *track = calloc((size_t)count, sizeof *track), *rows = calloc(5 * (size_t)count, sizeof *rows);
    const int reads = stand->reads;
    if (!read_walk(stand, document, motion, track)) memset(track, 0, (size_t)count * sizeof *track);
    stand->reads = reads;
    for (int i = 0; i < count; i++) track[i] *= gain;
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = count;
    desc.step = document_step(document);
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++)
        parameter_describe(p, spline->parameter[p].value, p == PARAMETER_EQUILIBRIUM ? track : NULL, &desc);
    wiggly_knot knot = {.stiffness = KNOT_DEFAULT_STIFFNESS};
    desc.knot_count = spline->knot_count;
    desc.knots = &knot;
    if (spline->knot_count > 0) {
        knot.sample = document_sample(document, spline->knots[0].frame);
        knot.value = spline->knots[0].value;
    }
    wiggly_curve curve = {
        .size = sizeof curve, .total = rows, .y = rows + count, .re = rows + 2 * count, .im = rows + 3 * count};
    wiggly_solver *solver;
    assert_int_equal(wiggly_create(count, 1, &solver), WIGGLY_OK);
    wiggly_set_method(solver, evaluation_method(&stand->evaluation));
    assert_int_equal(wiggly_solve(solver, &desc, &curve), WIGGLY_OK);
    const wiggly_curve *own = &stand->evaluation.curves[index];
    assert_memory_equal(own->y, curve.y, (size_t)count * sizeof *curve.y);
    assert_memory_equal(own->total, curve.total, (size_t)count * sizeof *curve.total);
    wiggly_destroy(solver);
    free(track);
    free(rows);
}

TEST(motions_are_printed_as_they_were_read)
{
    struct document *document = document_of_text(scene);
    char *first = text_of_document(document);
    assert_non_null(strstr(first, "\"equilibrium\": { \"model\": \"dog\", \"joint\": \"hips\", \"of\": \"across\", "
                                  "\"gain\": -2.5, \"chain\": \"tail\", \"why\": 1 }"));
    assert_non_null(strstr(first, "{ \"model\": \"dog.glb\", \"joint\": \"head\", \"of\": \"turn\", \"gain\": 1 }"));
    assert_loads_again(document);
    free(first);
    document_destroy(document);
}

STAND_TEST(a_motion_is_solved_as_a_track_is)
{
    assert_true(stand_update(stand));
    assert_solved(stand, WAG, -2.5);
    assert_solved(stand, EAR, 1);
    const wiggly_curve *ear = &stand->evaluation.curves[EAR];
    assert_near(ear->y[0], ear->y[ear->samples - 1], 0);
    assert_true(fabs(ear->y[0] - ear->y[1]) > 1e-6);
}

/// Each motion is read again only when something that it depends on has changed; then its splines and their followers are solved.
STAND_TEST(a_motion_is_read_when_it_has_changed)
{
    struct world *world = &stand->world;
    stand_update(stand);
    assert_int_equal(stand->reads, 2);
    assert_false(stand_update(stand));
    assert_int_equal(stand->evaluation.solved_splines, 0);
    world_must(world, edit_insert(world, ALONE, 7, 1));
    assert_true(stand_update(stand));
    assert_int_equal(stand->reads, 2);
    assert_int_equal(stand->evaluation.solved_splines, 1);
    char gallop[] = "Gallop";
    struct rig galloping = *world->document->rigs[DOG];
    galloping.model.clip = gallop;
    world_must(world, EDIT(edit_rig_set, DOG, &galloping));
    assert_true(stand_update(stand));
    assert_int_equal(stand->reads, 4);
    assert_int_equal(stand->evaluation.solved_splines, 3); // wag, its follower, ear
    assert_solved(stand, WAG, -2.5);
    assert_true(history_undo(world->history));
    assert_true(stand_update(stand));
    assert_solved(stand, WAG, -2.5);
    struct rig ends = *world->document->rigs[TAIL];
    ends.chain.turn = 30;
    world_must(world, EDIT(edit_rig_set, TAIL, &ends));
    assert_true(stand_update(stand));
    assert_int_equal(stand->reads, 7); // only wag's goes by the chain
    assert_int_equal(stand->evaluation.solved_splines, 2);
    world_must(world, edit_frames(world, -10, 60));
    assert_true(stand_update(stand));
    assert_int_equal(stand->reads, 9);
    assert_solved(stand, WAG, -2.5);
    assert_solved(stand, EAR, 1);
    stand->is_missing = true;
    assert_false(stand_update(stand));
    stand->evaluation.models.version++;
    assert_true(stand_update(stand));
    for (int i = 0; i < stand->evaluation.samples; i++) assert_near(stand->evaluation.curves[WAG].y[i], 0, 0);
    assert_solved(stand, WAG, -2.5);
}

STAND_TEST(without_a_source_it_stays_at_0)
{
    stand->evaluation.models = (struct model_source){0};
    stand_update(stand);
    for (int i = 0; i < stand->evaluation.samples; i++) assert_near(stand->evaluation.curves[EAR].total[i], 0, 0);
}

static bool follow(struct world *world, enum parameter parameter, struct joint_motion *motion, double gain)
{
    struct joint_motion followed = *motion;
    const struct param param = {.track = -1, .motion = &followed};
    followed.gain = gain;
    return EDIT(edit_parameter, ALONE, parameter, &param);
}

STAND_TEST(following_is_edited_and_undone)
{
    struct world *world = &stand->world;
    char model[] = "dog", joint[] = "spine", nobody[] = "cat", nothing[] = "";
    struct joint_motion motion = {.model = model, .joint = joint, .of = MOTION_UP};
    stand_update(stand);
    assert_reversible(world, follow(world, PARAMETER_EQUILIBRIUM, &motion, 3));
    memset(joint, 'x', sizeof joint - 1);
    assert_string_equal(world->document->splines[ALONE]->parameter[PARAMETER_EQUILIBRIUM].motion->joint, "spine");
    stand_update(stand);
    assert_solved(stand, ALONE, 3);
    const int reads = stand->reads;
    assert_reversible(world, follow(world, PARAMETER_EQUILIBRIUM,
                                    world->document->splines[ALONE]->parameter[PARAMETER_EQUILIBRIUM].motion, 4));
    stand_update(stand);
    assert_solved(stand, ALONE, 4);
    assert_int_equal(stand->reads, reads); // a gain alone reads nothing
    assert_reversible(world, edit_number(world, ALONE, PARAMETER_EQUILIBRIUM, 1));
    stand_update(stand);
    assert_near(stand->evaluation.curves[ALONE].y[5], 1, 0);
    assert_reversible(world, edit_track(world, WAG, PARAMETER_EQUILIBRIUM, ALONE));
    assert_refused(world, follow(world, PARAMETER_DAMPING, &motion, 1),
                   "alone: only the equilibrium follows a joint");
    assert_refused(world, follow(world, PARAMETER_EQUILIBRIUM, &motion, NAN), "alone: the gain must be finite");
    motion.joint = nothing;
    assert_refused(world, follow(world, PARAMETER_EQUILIBRIUM, &motion, 1), "alone: \"joint\" must not be empty");
    motion.joint = joint;
    motion.chain = nobody;
    assert_refused(world, follow(world, PARAMETER_EQUILIBRIUM, &motion, 1),
                   "alone: expected the name of a chain, got \"cat\"");
    motion.model = nobody;
    assert_refused(world, follow(world, PARAMETER_EQUILIBRIUM, &motion, 1),
                   "alone: expected the name or file of a model rig, got \"cat\"");
}

/// Names that motions go by are renamed with what they name, which is not removed before them; files move with the scene.
STAND_TEST(a_motion_keeps_to_its_joint)
{
    struct world *world = &stand->world;
    struct document *document = world->document;
    assert_refused(world, EDIT(edit_rig_remove, DOG), "dog: still needed by tail, wag, ear; remove those first");
    assert_refused(world, EDIT(edit_rig_remove, TAIL), "tail: still needed by wag; remove those first");
    assert_reversible(world, EDIT(edit_rig_name, DOG, "wolf"));
    assert_reversible(world, EDIT(edit_rig_name, TAIL, "brush"));
    const struct param *wag = &document->splines[WAG]->parameter[PARAMETER_EQUILIBRIUM];
    assert_string_equal(wag->motion->model, "wolf");
    assert_string_equal(wag->motion->chain, "brush");
    assert_refused(world, EDIT(edit_rig_name, DOG, "dog.glb"),
                   "expected a name that is no model's file, got dog.glb");
    document->folder = strdup("/films");
    size_t size;
    char *text = scene_print_for(document, "/films/deeper", NULL, &size);
    assert_non_null(strstr(text, "{ \"model\": \"../dog.glb\", \"joint\": \"head\""));
    free(text);
}
