/// Edits: what they do to the file, and what is refused. That any of them in any order gives a document that loads, and comes back, has
/// test_history.c.
#include "invariants.h"
#include "world.h"

#include "base/file.h"
#include "scene/evaluate.h"
#include "spline/desc.h"

// --- the scenes that rows are about

/// Three knots, the first with a key of its own; spring and friction; a loop that follows the first; a tail with two channels.
static const char small[] =
    "{'frames': [0, 48], 'splines': [{'name': 'sway', 'frequency': 1, 'damping': 0.1, 'knots': [{'frame': 0, "
    "'value': 0, 'tag': 1}, {'frame': 12, 'value': 1, 'slope': 0}, {'frame': 30, 'value': -1}]},{'name': 'pluck', "
    "'mode': 'real', 'spring': 40, 'friction': 1, 'start': 'rest'},{'name': 'loop', 'start': 'loop', 'equilibrium': "
    "{'spline': 'sway'}, 'knots': [{'frame': 3, 'value': 2}]}],'rigs': [{'type': 'tail', 'name': 't', 'joints': 3, "
    "'channels': [{'spline': 'sway'}, {'spline': 'loop', 'axis': 'up', 'gain': [1, 2, 3]}]}]}";

/// A tail with two pins on a base that moves; and one without.
static const char pinned[] =
    "{'frames': [0, 48], 'splines': [{'name': 'side', 'frequency': 1, 'knots': [{'frame': 0, 'value': 0}]},{'name': "
    "'up', 'frequency': 2, 'equilibrium': {'spline': 'base'}},{'name': 'base', 'mode': 'cubic'}],'rigs': [{'type': "
    "'tail', 'name': 't', 'joints': 12, 'position': [0, {'spline': 'base'}, 0],'channels': [{'spline': 'side'}, "
    "{'spline': 'up', 'axis': 'up'}],'pins': [{'frame': 30, 'joint': 11, 'to': [0, 1, 0.5], 'why': 'grip'},{'frame': "
    "12.25, 'joint': 5, 'to': [0.25, 0, 1]}]},{'type': 'tail', 'name': 'free'}]}";

/// A character between tails; what is not known of it is kept.
static const char soft[] =
    "{'frames': [0, 48], 'splines': [{'name': 's', 'frequency': 1}, {'name': 'u', 'frequency': 1}], 'rigs': "
    "[{'type': 'tail', "
    "'name': 'a'}, {'type': 'character', 'model': '../models/a.glb', 'glow': 3, 'floor': -1, 'paint': 'a.npy', "
    "'coordinates': [{'name': 'up', 'spline': 's', 'amplitude': 0.5, 'lag': 30, 'tint': 'red'}, {'name': 'side', "
    "'spline': 'u'}]}, {'type': 'tail', 'name': 'b'}]}";

/// Equilibria that follow a model's joints, by its name and by its file.
static const char jointed[] =
    "{'frames': [0, 48], 'splines': [{'name': 'wag', 'frequency': 1.5, 'equilibrium': {'model': 'dog', 'joint': "
    "'hips', 'of': 'across', 'gain': -2.5, 'chain': 'tail', 'why': 1}},{'name': 'ear', 'equilibrium': {'model': "
    "'dog.glb', 'joint': 'head', 'of': 'turn'}},{'name': 'tip', 'equilibrium': {'spline': 'wag'}},{'name': "
    "'alone'}],'rigs': [{'type': 'model', 'name': 'dog', 'model': 'dog.glb', 'clip': 'Walk'}, {'type': 'chain', "
    "'name': 'tail', 'model': 'dog', 'from': 'a', 'to': 'b'}]}";

/// A chain before its model, which it goes by the file.
static const char by_file[] =
    "{'frames': [0, 9], 'rigs': [{'type': 'chain', 'name': 'c', 'model': 'd.glb', 'from': 'a', 'to': 'b'}, {'type': "
    "'model', 'name': 'm', 'model': 'd.glb'}]}";

// --- what edits do

/// Edits of a scene, and what the file then says. The last one is taken back and done again, to the byte.
static const struct change {
    const char *scene, *edits, *facts;
} changes[] = {
    // a knot may pass others, and stays by sample; what is not known of it goes with it; a file has no −0
    {small, "move sway 0 20.5 7", "s0.k0.frame=12; s0.k1={'frame':20.5,'value':7,'tag':1}"},
    {small, "move sway 2 5 3", "s0.k0.frame=0; s0.k1.value=3; s0.k2.frame=12"},
    {small, "move sway 1 13 1", "s0.k1={'frame':13,'value':1,'slope':0}"},
    {small, "insert sway 4 0", "s0.k#=4; s0.k1={'frame':4,'value':0}"},
    {small, "insert sway 48 0", "s0.k3.frame=48"},
    {small, "remove sway 0; insert sway -0.4 0", "s0.k0.frame=-0.4"},
    {small, "remove sway 0", "s0.k#=2; s0.k0.frame=12"},
    {small, "remove sway 2", "s0.k#=2; s0.k1.frame=12"},
    {small, "knot sway 1 slope 2", "s0.k1.slope=2"},
    {small, "knot sway 1 im -3", "s0.k1.im=-3"},
    {small, "knot sway 1 stiffness 7", "s0.k1.stiffness=7"},
    {small, "knot sway 1 still 1", "s0.k1={'frame':12,'still':true}"},
    {small, "knot sway 0 settles 1", "s0.k0.settles=true; s0.k1.settles="},
    {small, "knot sway 1 still 1; settle sway 1", "s0.k0.settles=true; s0.k1.settles=; s0.k2.settles=true"},
    {small, "settle sway 1; settle sway 0", "s0.k0.settles="},
    {small, "knot sway 0 slope 1; knot sway 0 slope -0", "s0.k0.slope=0"},

    // parameters; the paper's pair (eq. 12) is read as what it is; a new mode clamps, so that what is saved loads
    {small, "set sway calm 0.25", "s0.calm=0.25; s1.frequency=1.006584242; s1.damping=0.0790569415"},
    {small, "set sway equilibrium 1; set sway equilibrium -0", "s0.equilibrium=0; s1.spring=; s1.friction="},
    {small, "set pluck damping 2.4; set pluck mode complex", "s1.damping=1; s1.mode='complex'"},
    {small, "set pluck damping 2.4; set pluck mode cubic", "s1.damping=2.4"},
    {small, "set loop start free; set sway start loop", "s0.start='loop'; s2.start='free'"},
    {small, "track pluck frequency loop", "s1.frequency={'spline':'loop'}"},
    {small, "track loop equilibrium pluck; set loop equilibrium 2", "s2.equilibrium=2"},
    {small, "set sway low -1", "s0.limits=[-1,null]"},
    {small, "set sway high 1; set sway high inf", "s0.limits="},
    {small, "set sway low -2; set sway high 1.5", "s0.limits=[-2,1.5]"},
    {small, "set sway seed 7; set sway variation 0.5", "s0.variation={'seed':7,'amount':0.5}"},

    // splines: what refers to one goes with it; a new one loops as others do, and has a free name
    {small, "add 1 - 7 0.5",
     "s#=4; "
     "s1={'name':'spline','mode':'complex','frequency':1,'damping':0.1,'bandwidth':0.1,'calm':1,'wind_up':0.5,'"
     "equilibrium':0,'start':'loop','knots':[{'frame':7,'value':0.5}]}; s3.equilibrium.spline='sway'; "
     "r0.c1.spline='loop'"},
    {small, "add -1 -; add 9 -", "s3.knots=[]; s4.name='spline 2'"},
    {small, "add -1 - 48 0.5", "s3.k0.frame=0"}, // of a loop, whose first frame it repeats
    {small, "set loop start free; add -1 - 48 0.5", "s3.k0.frame=48; s3.start='free'"},
    {small, "add 0 sweep 0 0; add 0 sweep-7", "s0.name='sweep-7'; s1.name='sweep'"},
    {small, "copy loop; copy 3; insert 3 9 9",
     "s3.name='loop 2'; s4.name='loop 3'; s2.k#=1; s3.k#=2; s3.equilibrium.spline='sway'; s3.start='loop'"},
    {small, "copy loop; copy loop", "s3.name='loop 3'; s4.name='loop 2'"},
    {small, "drop pluck", "s#=2; s1.equilibrium.spline='sway'; r0.c1.spline='loop'"},
    {small, "order sway 2",
     "s0.name='pluck'; s1.name='loop'; s2.name='sway'; s1.equilibrium.spline='sway'; r0.c0.spline='sway'; "
     "r0.c1.spline='loop'"},
    {small, "order loop 0", "s0.name='loop'; s1.name='sway'; r0.c1.spline='loop'"},
    {small, "name loop loop; name sway Schwung·1", "s0.name='Schwung·1'; s2.equilibrium.spline='Schwung·1'"},
    {small, "color pluck 0x4FA3E3", "s1.color='#4FA3E3'; s0.color="},
    {small, "color pluck 0; color sway 0xFFFFFF", "s1.color='#000000'; s0.color='#FFFFFF'"},
    {small, "color pluck 1; color pluck -1", "s1.color="},
    {small, "folder pluck ears; copy pluck; lock sway 1",
     "s1.folder='ears'; s2.folder='ears'; s3.folder=; s0.locked=true; s1.locked="},
    {small, "folder pluck ears; folder pluck; lock sway 1; lock sway 0", "s1.folder=; s0.locked="},

    // 24 to 30 frames a second: kept seconds put the knot of frame 12 on 15, and a slope per second stays what it is
    {small, "fps 30", "fps=30; frames=[0,48]; s0.k1.frame=12"},
    {small, "fps 30 keep", "frames=[0,60]; s0.k1={'frame':15,'value':1,'slope':0}; s0.k2.frame=37.5"},
    {small, "range -3 50 refuse; fps 25 keep", "frames=[-4,53]; s0.k1.frame=12.5"}, // outwards
    {small, "fps 25 keep; fps 24 keep", "s0.k1.frame=12"},
    {pinned, "fps 48 keep", "frames=[0,96]; r0.p0.frame=24.5; r0.p1.frame=60"},
    {small, "substeps 4; insert sway 12.25 0", "substeps=4; s0.k2.frame=12.25"},
    {small, "background a.png 3", "background={'file':'a.png','offset':3}"},
    {small, "background a.png 3; background b 0", "background={'file':'b'}"},
    {small, "background a.png 3; background", "background="},
    {small, "range -10 30 refuse", "frames=[-10,30]"},
    {small, "set loop start free; range -10 30 refuse; range -10 31 refuse; set sway start loop", "s0.start='loop'"},
    {small, "insert sway 28 4; range 2 28 trim", "s0.k#=2; s0.k0.frame=12; s0.k1.frame=28"},
    {small, "insert sway 28 4; range 2 28 move", // the knot at 28 makes room for the one from 30
     "s0.k0.frame=2; s0.k1.frame=12; s0.k2.frame=27; s0.k3.frame=28"},
    {small, "move sway 2 28.3 -1; range 2 28 move", "s0.k0.frame=2; s0.k2.frame=28.3"},
    {small, "range 13 40 move", "s0.k0={'frame':13,'value':0,'tag':1}; s0.k1.frame=14; s2.k0.frame=13"},
    {small, "range 0 2 move", "s0.k2.frame=2; s0.k1.frame=1; s2.k0.frame=1"},
    {pinned, "range 0 29 move", "r0.p1.frame=29; r0.p1.why='grip'"},
    {pinned, "range 13 40 move", "r0.p0.frame=13; r0.p1.frame=30; s0.k0.frame=13"},
    {pinned, "range 0 29 trim", "r0.p#=1"},
    {pinned, "range 0 30 trim", "r0.p#=2"},

    // tails and channels
    {small, "place t 0 0.5", "r0.position=[0.5,0,0]"},
    {small, "ride t 2 loop", "r0.position=[0,0,{'spline':'loop'}]"},
    {small, "length t 2.5", "r0.length=2.5"},
    {small, "offset t 2.37", "r0.offset=2.37"},
    {small, "offset t -3; tail t 0", "r0.offset=-3; r1.offset=-3"},
    {small, "offset t 3; offset t 0", "r0.offset="},
    {small, "offset t 3; fps 48 keep", "r0.offset=6"},
    {soft, "offset 1 1.5", "r1.offset=1.5"},
    {jointed, "offset tail 1.5", "r1.offset=1.5"},
    {small, "angles t 1 gain 4", "r0.c1.gain=4"},
    {small, "angles t 1 lag 1 2 9", "r0.c1.lag=[1,2,9]; r0.c0.lag=6.5"},
    {small, "angles t -1 rest 1 2 9", "r0.rest=[1,2,9]"},
    {small, "angles t 0 lag 0:1 0.5:2 1:-1", "r0.c0.lag={'ramp':[[0,1],[0.5,2],[1,-1]]}"},
    {small, "bend t 1 pluck - -", "r0.c1={'spline':'pluck','axis':'up','lag':6.5,'gain':[1,2,3]}"},
    {small, "bend t 1 - - displacement", "r0.c1.of='displacement'; r0.c1.spline='loop'"},
    {small, "bend t 1 - side -", "r0.c1.axis='side'"},
    {small, "channel t pluck up displacement",
     "r0.c#=3; r0.c2={'spline':'pluck','axis':'up','of':'displacement','lag':6.5,'gain':5}"},
    {small, "channel t pluck blink total", "r0.c2.gain=100"},
    {small, "channel t pluck up total; unchannel t 0", "r0.c#=2; r0.c1.spline='pluck'"},
    {small, "unchannel t 1", "r0.c#=1; r0.c0.spline='sway'"},
    {small, "tail t sway", "r1.name='tail'; r1.position=[1.2,0,0]; r1.c1.gain=[1,2,3]"},
    {small, "ride t 0 sway; tail t sway", "r1.position=[{'spline':'sway'},0,0]"},
    {small, "tail -1 pluck",
     "r1.joints=24; r1.position=[0,0.26,0]; r1.rest=1.5; "
     "r1.channels=[{'spline':'pluck','axis':'side','lag':6.5,'gain':5}]"},
    {small, "tail 9 -1", "r1.channels=[]"},
    {small, "tail t 0; rename 1 other; unrig t; angles other 1 lag 9", "r#=1; r0.name='other'; r0.c1.lag=9"},
    {soft, "tail b 0; unrig a; unrig b", "r0.type='model'; r1.name='tail'; r1.position.0=1.2"},
    {pinned, "tail t 0", "r2.pins="},

    // the gains of all joints together, and the lag from base to tip, stay; arrays are read at the same shares of the length
    {small, "joints t 5", "r0.joints=5; r0.c0.gain=3; r0.c0.lag=3.9; r0.c1.gain=[0.6,0.9,1.2,1.5,1.8]"},
    {small, "angles t 0 lag 1 2 9; joints t 2", "r0.c0.lag=[1,9]"},
    {small, "angles t -1 rest 2; angles t 0 lag 0:1 1:3; joints t 6", "r0.rest=1; r0.c0.lag.ramp=[[0,1],[1,3]]"},
    {small, "angles t 0 gain 0:1 1:3; joints t 6", "r0.c0.gain.ramp=[[0,0.5],[1,1.5]]"},
    {small, "bend t 1 - stretch -; joints t 5", "r0.c1.gain=[1,1.5,2,2.5,3]"}, // moves it as a whole
    {small, "joints t 1", "r0.c1.gain=[3]"},
    {small, "joints t 256", "r0.joints=256"},
    {pinned, "joints t 24", "r0.p0.joint=11; r0.p1.joint=23"},
    {pinned, "joints t 1", "r0.p0.joint=0; r0.p1.joint=0"},
    {pinned, "pin t 30 10 0 0 0; joints t 6",
     "r0.p#=2; r0.p0.joint=2; r0.p1={'frame':30,'joint':5,'to':[0,0,0]}"}, // the first stays

    // pins, sorted by frame; with what is not known of them
    {pinned, "place t 0 1",
     "r0.pins=[{'frame':12.25,'joint':5,'to':[0.25,0,1]},{'frame':30,'joint':11,'to':[0,1,0.5],'why':'grip'}]"},
    {pinned, "pin t 20 3 1 2 3", "r0.p#=3; r0.p1={'frame':20,'joint':3,'to':[1,2,3]}"},
    {pinned, "pin t 30 3 1 2 3", "r0.p1.joint=3; r0.p2.joint=11"},
    {pinned, "repin t 0 40 4 0 -2 0", "r0.p0.why='grip'; r0.p1={'frame':40,'joint':4,'to':[0,-2,0]}"},
    {pinned, "repin t 1 29 4 0 -2 0", "r0.p1={'frame':29,'joint':4,'to':[0,-2,0],'why':'grip'}"},
    {pinned, "unpin t 0", "r0.p#=1; r0.p0.frame=30"},

    // a character keeps its place among the rigs, and what moves it
    {soft, "unrig a", "r0.type='model'; r0.model='../models/a.glb'; r0.paint='a.npy'; r0.glow=3"},
    {soft, "drive 1 0 u -2 45", "r1.d0={'name':'up','spline':'u','amplitude':-2,'lag':45,'tint':'red'}"},
    {soft, "drive 1 -1 s 1 0 twist; undrive 1 0",
     "r1.d#=2; r1.d0.name='side'; r1.d1={'name':'twist','spline':'s','amplitude':1,'lag':0}"},
    {soft, "order s 1", "r1.d0.spline='s'; r1.d1.spline='u'"},
    {soft, "floor 1 -0.25", "r1.floor=-0.25"},
    {soft, "rename 1 creature", "r1.name='creature'"},

    // joints of clips; names that motions go by are renamed with what they name
    {jointed, "follow alone equilibrium dog spine up 3",
     "s3.equilibrium={'model':'dog','joint':'spine','of':'up','gain':3}"},
    {jointed, "follow alone equilibrium dog spine up 3; follow alone equilibrium dog spine up 4",
     "s3.equilibrium.gain=4"},
    {jointed, "follow alone equilibrium dog spine up 3 tail; follow alone equilibrium dog spine turn 3",
     "s3.equilibrium.chain="},
    {jointed, "follow alone equilibrium dog.glb spine up 3; set alone equilibrium 1", "s3.equilibrium=1"},
    {jointed, "track wag equilibrium alone", "s0.equilibrium={'spline':'alone'}"},
    {jointed, "rename dog wolf", "s0.equilibrium.model='wolf'; s1.equilibrium.model='dog.glb'; r1.model='wolf'"},
    {by_file, "rename m dog; rename c d.glb", "r0.name='d.glb'; r0.model='d.glb'; r1.name='dog'"},
    {jointed, "rename tail brush", "s0.equilibrium.chain='brush'; s0.equilibrium.why=1"},
    {jointed, "clip dog Run", "r0.clip='Run'"},
    {jointed, "turn tail 30", "r1.turn=30"},
    {jointed, "set ear equilibrium 0; track wag equilibrium alone; unrig tail; unrig dog", "rigs=[]"},
};

TEST(edits_do_what_they_say_and_can_be_undone)
{
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        const struct change *c = &changes[i];
        struct world world;
        world_open_scene(&world, json(c->scene));
        const bool done = world_do_all(&world, c->edits);
        if (!done) fail_msg("%s: %s", c->edits, world.error.text);
        assert_file_says(world.document, c->facts, c->edits);
        assert_reversible(&world, done);
        assert_invariants(world.document);
        assert_loads_again(world.document);
        world_close(&world);
    }
}

TEST(edits_without_effect_are_no_steps)
{
    assert_edits(json(small),
                 "move sway 0 0 0 | set sway frequency 1 | set loop start loop | track loop equilibrium sway | "
                 "name sway sway | order pluck 1 | color sway -1 | folder sway | lock sway 0 | fps 24 keep | "
                 "substeps 1 | range 0 48 trim | background",
                 "");
    assert_edits(json(small),
                 "joints t 3 | rename t t | angles t 1 gain 1 2 3 | bend t 0 - - - | length t 1.6 | "
                 "set sway low -inf | settle sway 0",
                 "");
    assert_edits(json(pinned), "repin t 1 30 11 0 1 0.5", "");
    assert_edits(json(soft), "drive 1 0 s 0.5 30", "");
    assert_edits(json(jointed), "follow ear equilibrium dog.glb head turn 1", "");
}

// --- what is refused

#define PINS "t: pins: expected "
#define SWING PINS "splines with a swing of their own, got "
#define SOFT "../models/a.glb: "

/// Edits of a scene, or several with | between them, and the sentence with which the last one is refused.
static const struct refusal {
    const char *scene, *edits, *says;
} refusals[] = {
    {small, "insert sway 12.4 0", "sway: there is already a knot at frame 12.4"},
    {small, "move sway 0 30 0", "sway: there is already a knot at frame 30"},
    {small, "insert sway 48.5 0", "sway: frame 48.5 is outside 0 to 48"},
    {small, "insert sway -0.6 0", "sway: frame -0.6 is outside 0 to 48"},
    {small, "insert loop 48 0", "loop: frame 48 is outside 0 to 48; the last frame of a loop repeats the first"},
    {small, "insert sway 5 nan", "sway: a knot: the value must be finite"},
    {small, "insert sway inf 0", "sway: a knot: the frame must be finite"},
    {small, "knot sway 1 stiffness 0", "sway: a knot: the stiffness must be above 0 and finite"},
    {small, "set sway low -1; move sway 1 12 -1.5", "sway: a knot at -1.5 would be below the low limit, -1"},
    {small, "set sway high 1; insert sway 5 2", "sway: a knot at 2 would be above the high limit, 1"},
    {small, "remove sway 9 | move sway 9 1 1", "sway: this knot no longer exists"},
    {small, "insert 3 5 0 | insert -1 5 0 | remove 3 0 | set 3 calm 1 | copy 3 | drop 3", "there is no such spline"},
    {small, "settle 3 1", "there is no such spline"},
    {small, "set sway frequency -1", "sway: frequency must be at least 0"},
    {small, "set sway damping 1.5", "sway: damping must be at most 1"},
    {small, "set sway equilibrium nan", "sway: equilibrium must be finite"},
    {small, "set sway seed 1.5", "sway: seed must be a whole number"},
    {small, "set sway mode 3 | set sway mode -1", "there is no such mode"},
    {small, "set sway 13 1", "there is no such parameter"},
    {small, "track sway calm loop", "sway: calm must be a number"},
    {small, "track sway damping 3", "sway: there is no spline to follow"},
    {small, "track sway damping sway", "sway cannot follow sway, which already follows it"},
    {small, "track sway damping loop", "sway cannot follow loop, which already follows it"},
    {small, "track pluck frequency loop; track sway bandwidth pluck",
     "sway cannot follow pluck, which already follows it"},
    {small, "set sway low nan | set sway low inf", "sway: a limit must be finite"},
    {small, "set sway low -0.5", "sway: the knot at frame 30 is below that"},
    {small, "set sway high 0.5", "sway: the knot at frame 12 is above that"},
    {small, "set pluck low 1; set pluck high 1 | set pluck high 1; set pluck low 2",
     "pluck: the low limit must be below the high one"},
    {small, "range 1 48 refuse", "sway: the knot at frame 0 would fall outside the range"},
    {small, "range 0 29 refuse", "sway: the knot at frame 30 would fall outside the range"},
    {small, "set loop start free; set sway start loop; range -10 30 refuse",
     "sway: the knot at frame 30 would fall outside the range"},
    {small, "range 5 4 refuse", "the last frame must not be before the first"},
    {small, "range 0 1000000000 refuse", "at most 100000 samples a spline, got 1000000001"},
    {small, "range -2147483648 2147483647 refuse", "frames must be from -1000000000 to 1000000000"},
    {small, "range -10 30 refuse; set sway start loop",
     "sway: delete the knot at the last frame first; in a loop that frame repeats the first"},
    {small, "range 2 2 trim", "loop: a loop needs more than one frame"},

    {"{'frames': [3, 3], 'splines': [{'name': 'x'}]}", "set x start loop", "x: a loop needs more than one frame"},

    {small, "insert sway 28 4; range 2 4 move", "sway: 4 knots do not fit into 3 frames"},
    {small, "insert loop 9 1; range 0 2 move; range 0 1 move", "sway: 3 knots do not fit into 2 frames"},
    {small, "fps 0 | fps nan keep", "frames per second must be above 0 and at most 100000"},
    {small, "fps 100000 keep", "at most 100000 samples a spline, got 200001"},
    {small, "fps 30 keep; insert sway 16 0; fps 10 keep", "sway: two knots would land on frame 5.333333333"},
    {small, "substeps 4; insert sway 12.25 0; substeps 1", "sway: two knots would land on frame 12.25"},
    {small, "background a.png 1000000001", "the offset must be from -1e+09 to 1e+09"},
    {small, "background '' 0", "\"file\" must not be empty"},
    {small, "add -1 sway 0 0", "a spline called sway already exists"},
    {small, "add -1 '' | name sway ''", "a spline needs a name"},
    {small, "add -1 - 49 0", "frame 49 is outside 0 to 48"},
    {small, "add -1 - -1 0", "frame -1 is outside 0 to 48"},
    {small, "add -1 - 0 nan", "a knot's numbers must be finite"},
    {small, "drop sway", "sway: still used in 2 places; remove those first"},
    {small, "drop loop", "loop: still used in 1 place; remove those first"},
    {small, "order sway 3 | order sway -1", "there is no such place in the list"},
    {small, "name sway loop", "a spline called loop already exists"},
    {small, "color pluck 0x1000000 | color pluck -2", "there is no such colour"},
    {small, "place t 0 nan", "t: the position must be finite"},
    {small, "ride t 1 3", "t: there is no spline to follow"},
    {small, "length t 0", "t: the length must be above 0 and finite"},
    {small, "length 1 2", "there is no such tail"},
    {small, "angles t 1 lag nan", "t: angles must be finite"},
    {small, "angles t 1 lag 1 2", "t: there must be one angle for each of the 3 joints"},
    {small, "angles t 1 lag 0:1", "t: a ramp has from 2 to 32 points"},
    {small, "angles t 1 lag 0:1 1.5:2", "t: the places of a ramp are from 0 to 1"},
    {small, "angles t 1 lag 0:1 0:2", "t: the places of a ramp must ascend"},
    {small, "angles t 2 lag 1 | bend t 2 - - total | unchannel t 2 | unchannel t -1", "there is no such channel"},
    {small, "angles 1 2 lag 1 | channel 1 0 side total | unrig 1", "there is no such rig"},
    {small, "bend t 1 9 - - | channel t -1 side total", "t: there is no such spline"},
    {small, "tail t 0; rename 1 t", "there is a rig called t already"},
    {small, "rename t ''", "a tail needs a name"},
    {small, "joints t 0 | joints t 257", "t: joints must be from 1 to 256"},

    {soft, "joints 1 5", "there is no such tail"},

    {pinned, "pin t 30 11 0 0 0", PINS "one pin per point and sample, got another at frame 30"},
    {pinned, "repin t 1 49 11 0 0 0", PINS "a frame from 0 to 48, got 49"},
    {pinned, "repin t 1 30 11 0 nan 0", "t: a pin: the to must be finite"},
    {pinned, "pin t 2 12 0 0 0", PINS "a whole number from 0 to 11, got 12"},
    {pinned, "unpin t 2 | repin t 2 1 1 0 0 0", "t: this pin no longer exists"},
    {pinned, "set side mode cubic", SWING "\"side\", which is cubic"},
    {pinned, "set up frequency 0", SWING "\"up\", whose frequency is 0"},
    {pinned, "set up calm 0", SWING "\"up\", whose calm is 0"},
    {pinned, "track up equilibrium side",
     PINS "splines that do not follow each other, got \"up\", which follows \"side\""},
    {pinned, "track base equilibrium side", PINS "splines without a cycle, got \"up\", which follows \"base\""},
    {pinned, "bend t 1 base - -", SWING "\"base\", which is cubic"},
    {pinned, "range 0 20 refuse", PINS "a frame from 0 to 20, got 30"},
    {pinned, "pin t 48 1 0 0 0; set up start loop",
     PINS "a frame before 48, because the last frame of a loop repeats the first, got 48"},

    {soft, "drive 0 0 s 1 0 | undrive 0 0", "there is no such model"},
    {soft, "drive 1 2 s 1 0 | drive 1 -2 s 1 0 | undrive 1 -1 | undrive 1 2",
     "this character has no such coordinate"},
    {soft, "drive 1 0 2 1 0", SOFT "there is no such spline"},
    {soft, "drive 1 0 s inf 0", SOFT "the amplitude must be finite"},
    {soft, "drive 1 0 s 1 nan", SOFT "the lag must be finite"},
    {soft, "drive 1 -1 s 1 0 ''", SOFT "\"name\" must not be empty"},
    {soft, "drop s", "s: still used in 1 place; remove those first"},
    {soft, "pin 1 49 0 0 0 0", SOFT "pins: expected a frame from 0 to 48, got 49"},

    {jointed, "follow alone damping dog spine up 1", "alone: only the equilibrium follows a joint"},
    {jointed, "follow alone equilibrium dog spine up nan", "alone: the gain must be finite"},
    {jointed, "follow alone equilibrium dog '' up 1", "alone: \"joint\" must not be empty"},
    {jointed, "follow alone equilibrium dog spine up 1 cat", "alone: expected the name of a chain, got \"cat\""},
    {jointed, "follow alone equilibrium cat spine up 1",
     "alone: expected the name or file of a model rig, got \"cat\""},
    {jointed, "unrig dog", "dog: still needed by tail, wag, ear; remove those first"},
    {jointed, "unrig tail", "tail: still needed by wag; remove those first"},
    {jointed, "rename dog dog.glb", "expected a name that is no model's file, got dog.glb"},
    {jointed, "rename dog tail", "there is a rig called tail already"},
    {by_file, "rename m d.glb", "expected a name that is no model's file, got d.glb"},
    {jointed, "angles tail 0 rest 1", "only a tail has angles at rest"},
};

TEST(impossible_edits_are_refused_in_a_sentence)
{
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++)
        assert_edits(json(refusals[i].scene), refusals[i].edits, refusals[i].says);
}

/// Angles as edits say them, and what a joint of how many has: a ramp is linear between its points, and constant outside.
WORLD_TEST(angles_of_joints, world_open_scene(world, json(small)))
{
    static const struct {
        const char *said;
        int joint, joints;
        double angle, lag;
    } rows[] = {{"3", 4, 9, 3, 12},           {"1 2 9", 1, 3, 2, 2},         {"1 2 9", 2, 3, 9, 9},
                {"1 2 9", 7, 9, 9, 9},        {"0:1 1:3", 0, 5, 1, 1},       {"0:1 1:3", 4, 5, 3, 3},
                {"0:1 1:3", 1, 5, 1.5, 1.5},  {"0:1 1:3", 0, 1, 1, 1},       {"0.5:1 0.75:3", 1, 5, 1, 1},
                {"0.5:1 0.75:3", 4, 5, 3, 3}, {"0:0 0.5:2 1:-2", 3, 5, 0, 0}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char edit[64];
        snprintf(edit, sizeof edit, "angles t 1 lag %s", rows[i].said);
        world_must(world, world_do(world, edit));
        const struct angles *lag = &document_tail(world->document, 0)->channels[1].lag;
        assert_near(angles_at(lag, rows[i].joint, rows[i].joints), rows[i].angle, 1e-12);
        assert_near(angles_lag(lag, rows[i].joint, rows[i].joints), rows[i].lag, 1e-12);
    }
}

/// Paint is on a character's coordinates and vertices, within limits; where a dab is refused nothing is painted.
WORLD_TEST(paint_is_bounded, world_open_scene(world, json(soft)))
{
    static const struct {
        int coordinate, vertex;
        float swell, lead;
        const char *says; ///< NULL: painted
    } rows[] = {
        {0, 0, 10, 0, NULL},
        {1, 2, -10, 1000, NULL},
        {-1, 0, 0, 0, "there is no such coordinate in the paint"},
        {2, 0, 0, 0, "there is no such coordinate in the paint"},
        {0, 3, 0, 0, "paint must be finite, and on the model"},
        {0, -1, 0, 0, "paint must be finite, and on the model"},
        {0, 0, 10.5f, 0, "paint must be finite, and on the model"},
        {0, 0, 0, -1001, "paint must be finite, and on the model"},
        {0, 0, NAN, 0, "paint must be finite, and on the model"},
    };
    struct dab dab = {.count = 1};
    assert_refused(world, EDIT(edit_paint, 1, &dab), "this character has no paint yet");
    assert_refused(world, EDIT(edit_paint, 0, &dab), "there is no such model");
    assert_refused(world, EDIT(edit_paint_new, 0, 2, 3), "there is no such model");
    assert_refused(world, EDIT(edit_paint_new, 1, 0, 3), "there is nothing to paint on this character");
    assert_refused(world, EDIT(edit_paint_new, 1, 2, 0), "there is nothing to paint on this character");
    world_must(world, EDIT(edit_paint_new, 1, 2, 3));
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const float value[1][2] = {{rows[i].swell, rows[i].lead}};
        dab = (struct dab){rows[i].coordinate, 1, &rows[i].vertex, value};
        const bool done = EDIT(edit_paint, 1, &dab);
        if (rows[i].says) assert_refused(world, done, rows[i].says);
        if (!rows[i].says) world_must(world, done);
    }
    const struct paint *paint = first_model(world->document)->painted;
    for (int n = 0; n < 6; n++) {
        assert_near(paint->values[n][0], n == 0 ? 10 : n == 5 ? -10 : 0, 0);
        assert_near(paint->values[n][1], n == 5 ? 1000 : 0, 0);
    }
    assert_true(history_undo(world->history) && history_undo(world->history));
    assert_true(paint_is_plain(first_model(world->document)->painted));
}

WORLD_TEST(a_place_follows_no_joint, world_open_scene(world, json(small)))
{
    struct rig riding = *world->document->rigs[0];
    riding.tail.position[2] = (struct param){.track = -1, .motion = &(struct joint_motion){.gain = 1}};
    assert_refused(world, EDIT(edit_rig_set, 0, &riding), "t: only an equilibrium follows a joint");
}

// --- ids, which no file has

static unsigned knot_id(const struct world *world, int spline, int knot)
{
    return world->document->splines[spline]->knots[knot].id;
}

/// They stay through moves, and come back with what was removed or added.
WORLD_TEST(ids_are_kept, world_open_scene(world, json(small)))
{
    const unsigned first = knot_id(world, SWAY, 0), pluck = world->document->splines[PLUCK]->id;
    world_must(world, world_do(world, "move sway 0 20.5 7"));
    assert_int_equal(knot_id(world, SWAY, 1), first);
    world_must(world, world_do(world, "remove sway 1"));
    assert_int_equal(spline_find_id(world->document->splines[SWAY], first), -1);
    assert_true(history_undo(world->history));
    assert_int_equal(spline_find_id(world->document->splines[SWAY], first), 1);
    world_must(world, world_do(world, "drop pluck"));
    assert_int_equal(document_find_spline_id(world->document, pluck), -1);
    assert_true(history_undo(world->history));
    assert_int_equal(document_find_spline_id(world->document, pluck), PLUCK);
    world_must(world, world_do(world, "add 0 - 7 1"));
    const unsigned added = world->document->splines[0]->id, knot = knot_id(world, 0, 0);
    assert_true(history_undo(world->history) && history_redo(world->history));
    assert_int_equal(world->document->splines[0]->id, added);
    assert_int_equal(knot_id(world, 0, 0), knot);
    world_must(world, world_do(world, "copy 0"));
    assert_true(world->document->splines[1]->id != added && knot_id(world, 1, 0) != knot);
    struct knot again = {.frame = 9, .stiffness = 1, .id = knot};
    assert_refused(world, EDIT(edit_knot_insert, SWAY + 2, &again), "sway: this knot already exists");
    again.id = 5000;
    world_must(world, EDIT(edit_knot_insert, SWAY + 2, &again));
    world_must(world, world_do(world, "insert sway 10 1"));
    assert_int_equal(knot_id(world, SWAY + 2, 1), 5001);
}

WORLD_TEST(ids_of_pins_are_kept, world_open_scene(world, json(pinned)))
{
    const unsigned moved = world->document->rigs[0]->pins[0].id;
    world_must(world, world_do(world, "repin t 0 40 3 0 0 0"));
    assert_int_equal(world->document->rigs[0]->pins[1].id, moved);
    world_must(world, world_do(world, "pin t 50 3 0 0 0") || world_do(world, "pin t 41 3 0 0 0"));
    assert_true(world->document->rigs[0]->pins[2].id > moved);
}

/// A drag takes its step back at every movement: what it adds then has the same ids again.
WORLD_TEST(ids_of_a_restarted_step, world_open_scene(world, json(small)))
{
    unsigned id[2], knot[2];
    history_begin(world->history, "Copy", 0);
    for (int i = 0; i < 2; i++) {
        history_restart(world->history);
        assert_int_equal(world->document->spline_count, 3);
        assert_true(world_do(world, "copy sway"));
        id[i] = world->document->splines[1]->id, knot[i] = knot_id(world, 1, 0);
    }
    history_end(world->history);
    assert_true(id[0] == id[1] && knot[0] == knot[1]);
}

// --- the table of parameters: each is one that the solver knows; an edit of it is seen in the curve, saved and loaded again

static const char varied[] =
    "{'wiggly': 1, 'frames': [0, 240], 'splines': [{'name': 'a', 'frequency': 1.1, 'damping': 0.1, 'calm': 0.5, "
    "'variation': {'seed': 4, 'amount': 0.2}, 'knots': [{'frame': 8, 'value': 1}, {'frame': 40, 'value': 0, 'slope': "
    "1}, {'frame': 90, 'value': 2}]}, {'name': 'b', 'mode': 'real', 'spring': 40, 'friction': 1, 'variation': "
    "{'amount': 0.2}, 'knots': [{'frame': 8, 'value': 1}, {'frame': 40, 'value': 0, 'slope': 1}]}, {'name': 'c', "
    "'mode': 'cubic', 'frequency': 0.5, 'start': 'rest', 'knots': [{'frame': 8, 'value': 0.4}, {'frame': 40, "
    "'value': 0.5}]}]}";

static enum desc_kind kind_in_desc(enum parameter_kind kind)
{
    if (kind == PARAMETER_CHOICE) return DESC_CHOICE;
    if (kind == PARAMETER_WHOLE) return DESC_COUNT;
    return kind == PARAMETER_TRACK ? DESC_PARAM : DESC_NUMBER;
}

static const struct parameter_row *row_at(size_t place)
{
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        if (parameter_rows[p].place == place) return &parameter_rows[p];
    }
    return NULL;
}

TEST(every_setting_of_the_solver_has_a_row)
{
    int found = 0;
    for (const desc_member *m = desc_members; m->name; m++) {
        if (strncmp(m->name, "has_", 4) == 0) continue; // whether another one is read; the next two are the scene's
        if (strcmp(m->name, "samples") == 0 || strcmp(m->name, "step") == 0) continue;
        const struct parameter_row *row = row_at(m->offset);
        if (!row) fail_msg("%s has no row", m->name);
        assert_int_equal(kind_in_desc(row->kind), m->kind);
        if (row->kind == PARAMETER_CHOICE) assert_int_equal(m->size, sizeof(unsigned));
        found++;
    }
    assert_int_equal(found, PARAMETER_COUNT);
}

TEST(every_row_is_whole_and_described)
{
    char *text, quoted[64];
    size_t size;
    assert_done(file_read("docs/scene-format.md", 1 << 20, &text, &size, &error));
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        const struct parameter_row *row = &parameter_rows[p];
        const bool is_second = p == PARAMETER_HIGH || p == PARAMETER_SEED; // one member of the file for two
        assert_true(row->name && row->hint && row->undo && row->modes);
        assert_int_equal(parameter_find(parameter_key(p)), is_second ? p - 1 : p);
        assert_true(row->standard >= row->minimum && row->standard <= row->maximum);
        assert_true(row->fresh >= row->minimum && row->fresh <= row->maximum);
        assert_true(row->kind == PARAMETER_CHOICE || row->step > 0);
        int words = 0;
        while (row->words[words]) assert_non_null(row->labels[words++]);
        assert_int_equal(words, row->kind == PARAMETER_CHOICE ? (int)row->maximum + 1 : 0);
        snprintf(quoted, sizeof quoted, "`%s`", parameter_key(p));
        if (!strstr(text, quoted)) fail_msg("docs/scene-format.md does not name %s", quoted);
    }
    free(text);
}

/// Another number than it has, inside its range, or another word.
static double another(const struct spline *spline, enum parameter p)
{
    const double value = spline->parameter[p].value;
    double range[2]; // a limit just beyond the knots, which the curve overshoots
    spline_values(spline, 0, spline->knot_count, range);
    if (p == PARAMETER_LOW) return range[0] - 0.001;
    if (p == PARAMETER_HIGH) return range[1] + 0.001;
    if (parameter_rows[p].kind == PARAMETER_CHOICE) return value < parameter_rows[p].maximum ? value + 1 : 0;
    if (parameter_rows[p].kind == PARAMETER_WHOLE) return value + 1;
    return value > 0 ? 0.75 * value : 0.25;
}

static bool same_curve(const wiggly_curve *a, const double *total, const double *im)
{
    const size_t size = sizeof(double) * (size_t)a->samples;
    return memcmp(a->total, total, size) == 0 && (!im || memcmp(a->im, im, size) == 0);
}

/// Makes a parameter another with an evaluation that has solved what was there before, and compares with one that has not.
static void try_edit(int spline, enum parameter parameter, struct param param)
{
    const char *name = parameter_key(parameter);
    struct world world;
    struct evaluation was = {0}, kept = {0}, fresh = {0};
    world_open_scene(&world, json(varied));
    evaluation_update(&was, world.document, false);
    evaluation_update(&kept, world.document, false);
    world_must(&world, edit_parameter(world_edit(&world), spline, parameter, &param, &world.error));
    evaluation_update(&kept, world.document, false);
    evaluation_update(&fresh, world.document, false);
    for (int s = 0; s < fresh.count; s++) {
        if (kept.status[s] != fresh.status[s] ||
            !same_curve(&kept.curves[s], fresh.curves[s].total, fresh.curves[s].im))
            fail_msg("%s: spline %d is not solved anew", name, s);
    }
    if (same_curve(&kept.curves[spline], was.curves[spline].total, NULL))
        fail_msg("%s: spline %d does not change", name, spline);
    struct document *again = document_of_text(world_print(&world));
    for (int s = 0; s < again->spline_count; s++) {
        for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
            const struct param *a = &world.document->splines[s]->parameter[p], *b = &again->splines[s]->parameter[p];
            if (a->value != b->value || a->track != b->track)
                fail_msg("%s: %s is not loaded", name, parameter_key(p));
        }
    }
    document_destroy(again);
    evaluation_free(&was);
    evaluation_free(&kept);
    evaluation_free(&fresh);
    world_close(&world);
}

TEST(an_edit_of_each_is_seen_and_saved)
{
    struct document *document = document_of_text(json(varied));
    for (int s = 0; s < document->spline_count; s++) {
        for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
            const struct spline *spline = document->splines[s];
            const bool is_still = (p == PARAMETER_CALM && spline_start(spline) != WIGGLY_FREE) || // still before it
                                  (p == PARAMETER_HIGH && s == 1);                                // it only falls
            if (!spline_uses(spline, p, false) || is_still) continue;
            try_edit(s, p, param_number(another(spline, p)));
            if (parameter_rows[p].kind == PARAMETER_TRACK) try_edit(s, p, param_track(s == 2 ? 1 : 2));
        }
    }
    document_destroy(document);
}
