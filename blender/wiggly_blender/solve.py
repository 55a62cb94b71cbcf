"""Solves splines whose inputs differ, and writes their samples into the action."""
import json
import math
import warnings
import bpy
import wiggly
from bpy.app.handlers import persistent
from . import curves, settings as stored

solved = {}  # (ID, its name, spline) → the inputs solved last
SETTINGS = 'frequency', 'damping', 'wind_up', 'settle', 'bandwidth', 'calm', 'start', 'mode', 'more', 'equilibrium', 'follow'
LONGEST, LONGEST_HELD = 1_000_000, 20_000  # frames of a spline, and of one with limits
problems = {}  # the same → what is wrong with the answer
edits = [0]  # how many there were
cached = [None, []]  # how many IDs there were, and which have splines
KINDS = ('objects', 'shape_keys', 'materials', 'node_groups', 'lights', 'cameras', 'worlds', 'scenes', 'armatures', 'curves', 'lattices', 'speakers')
TREES = ('materials', 'lights', 'worlds')  # have node trees of their own


def fps_of(scene):
    return scene.render.fps / scene.render.fps_base


def possible():
    """All IDs that may have splines."""
    for kind in KINDS:
        for each in getattr(bpy.data, kind):
            yield each
            if kind in TREES and each.node_tree:
                yield each.node_tree


def owners():
    """All IDs with splines."""
    count = tuple(len(getattr(bpy.data, kind)) for kind in KINDS)
    if cached[0] != count:
        from . import chain as chains
        for each in bpy.data.objects:
            if each.pose and each.is_editable and not each.override_library:
                chains.mend(each)
        cached[:] = count, [each for each in possible() if stored.of(each)]
    return cached[1]


def forget():
    edits[0] += 1
    solved.clear()
    cached[0] = None


def range_of(spline, scene, curve, held):
    """First and last frame. The first is not the scene's: a part that is rendered alone moves as in the whole."""
    first, last = spline.first, spline.last
    if spline.start != 'loop':
        last = max(last, scene.frame_end)
        if curve and len(curve.keyframe_points):
            first = min(first, math.floor(curve.keyframe_points[0].co[0]))
            last = max(last, math.ceil(curve.keyframe_points[-1].co[0]))
    most = LONGEST_HELD if held else LONGEST
    if last - first >= most or max(-first, last) > stored.FARTHEST:
        raise ValueError(f'It has frames from {first:.7g} to {last:.7g}: expected {most} at most, and none beyond {stored.FARTHEST}')
    return first, max(last, first + 3)


def knots_of(curve, spline, first, last, fps, im):
    """A knot for each sample that has a key, and what is to be said of keys that share one."""
    found, said = {}, ''
    for point in curve.keyframe_points if curve else ():
        sample = math.floor(point.co[0] - first + 0.5)
        if spline.start == 'loop':
            sample %= last - first
        is_pose = point.type == 'EXTREME' or point.type == 'JITTER' and curves.held(point, curves.POSE)  # one that settles stays one
        if is_pose and not curves.held(point, curves.POSE):  # it has just become one: the phase that is seen now
            curves.hold(point, curves.POSE, im.evaluate(point.co[0]) if im else 0)
        elif not is_pose and curves.held(point, curves.POSE):
            curves.hold(point, curves.POSE, None)
        if point.type == 'MOVING_HOLD':
            knot = wiggly.Knot(sample / fps, still=True)
        else:
            slope = curves.slope(point)
            knot = wiggly.Knot(sample / fps, point.co[1], slope=None if slope is None else slope * fps, phase=point.back if is_pose else None,
                               stiffness=point.amplitude if curves.held(point, curves.STIFF) else None,
                               settles=curves.settles(spline, point))
        if found.setdefault(sample, (knot, point))[0] != knot:
            said = f'Keys at {found[sample][1].co[0]:g} and {point.co[0]:g} are at one frame: the later one counts'
        found[sample] = knot, point
    return [knot for knot, _ in found.values()], said


def more(said):
    """What only a scene of wiggly can say of a spline."""
    varied = said.get('variation', {})
    return {'passive': said.get('passive', 'oscillator'), 'limits': said.get('limits'), 'variation': varied.get('amount', 0),
            'seed': varied.get('seed', 0)}


def key_of(owner, spline):
    return owner.as_pointer(), owner.name, spline.name


def note(owner, spline, curve, other):
    """What keeps a spline from being as its keys say, beside its own answer."""
    if spline.name not in owner:
        return f'Its property "{spline.name}" is gone: name it so again, or insert a key'
    if curve and any(not modifier.mute for modifier in curve.modifiers):
        return f'Modifiers of "{spline.name}" in the Graph Editor do nothing'
    return f'Its frames and their rate are those of the scene "{other.name}"' if other else ''


def direction(spline, settings, knots, fps):
    """What keeps the wind-up and keys that settle from having an effect."""
    if spline.mode == 'cubic' and any(knot.settles for knot in knots):
        return 'Its keys do not settle: a Cubic does not swing'
    if spline.mode != 'complex' or not spline.wind_up:
        return ''
    if settings['passive'] == 'filter':
        return "The wind-up has no effect: the paper's filter has none"
    if any(limit is not None for limit in settings['limits'] or ()):
        return 'The wind-up has no effect: limits need the whole curve'
    frames = spline.wind_up * fps / spline.frequency if spline.frequency else math.inf
    return f'The wind-up is {frames:.2g} frames long: below two, it is a jerk' if frames < 2 else ''


def solve(owner, spline, scene, known, other=None):
    """Solves a spline if its inputs differ from those solved last."""
    action = curves.action_of(owner)
    curve, im = known.get((curves.path_of(spline.name), 0)), known.get(curves.slot_path(spline, 'im'))
    y = known.get(curves.slot_path(spline, 'y')) if spline.follow != 'none' else None
    if not (curve or y) and owner.animation_data.nla_tracks:  # a strip may move it
        return
    said = note(owner, spline, curve, other)
    if curve and (curve.mute or curve.group and curve.group.mute):
        curve = None
    key, fps, now = key_of(owner, spline), fps_of(scene), None
    try:
        settings = more(json.loads(spline.more or '{}'))
        first, last = range_of(spline, scene, curve, settings['limits'])
        y_first, y = curves.samples(y)
        given = (*(getattr(spline, name) for name in SETTINGS), first, last, scene.frame_start, scene.frame_end, fps, y_first, y.tobytes(),
                 action.name_full, said)
        now = curves.read(curve), given
        if im and solved.get(key) == now:
            return
        knots, shared = knots_of(curve, spline, first, last, fps, im)
        now = curves.read(curve), given  # a pose may hold its phase now
        settles, has_offset = any(knot.settles for knot in knots), curves.has_offset(owner, spline)
        if settles and owner.override_library and not has_offset and not spline.path:  # its drivers cannot change
            knots, settles = [knot._replace(settles=False) for knot in knots], False
            said = said or 'Keys of a library override settle only if one does in the file that it comes from'
        middle = [y[min(max(frame - y_first, 0), len(y) - 1)] for frame in range(first, last + 1)] if y else spline.equilibrium
        described = wiggly.Spline(knots, frequency=spline.frequency, damping=spline.damping, bandwidth=spline.bandwidth, calm=spline.calm,
                                  wind_up=spline.wind_up, equilibrium=middle, start=spline.start, mode=spline.mode, **settings)
        with warnings.catch_warnings():
            warnings.simplefilter('ignore')
            answer = described.solve(last - first + 1, fps)
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as problem:
        problems[key] = str(problem) if isinstance(problem, ValueError) else f'It cannot be solved: {problem!r}'
        return
    finally:
        solved[key] = now
    problems[key] = said or shared or (answer.status.sentence if answer.status else direction(spline, settings, knots, fps))
    offset, parts = answer.y - middle, {'re': answer.re, 'im': answer.im}
    if spline.path:  # nothing lags
        parts['re'] = answer.re + offset
    elif settles or has_offset:
        parts['o'] = offset
    for part, values in parts.items():
        start, values = first, list(values)
        if spline.start == 'loop':  # through the scene's frames, and one more on either side for motion blur
            start = min(first, scene.frame_start) - 1
            values = [values[(frame - first) % (last - first)] for frame in range(start, max(last, scene.frame_end) + 2)]
        curves.write(owner, spline, part, start, values)
    if 'o' in parts and not has_offset:
        from . import chain as chains
        for chain in owner.wiggly.chains:
            chains.drive(owner, chain)


def insert(owner, spline, frame, kind):
    """A key at the value that the curve has there."""
    total = spline.equilibrium if spline.follow == 'none' else 0
    for part in ('re', 'y', 'o'):
        curve, (path, index) = curves.part(owner, spline, part), curves.slot_path(spline, part)
        moved = owner.get(path[2:-2], ())  # a strip may move it
        total += curve.evaluate(frame) if curve else moved[index] if len(moved) > index else 0
    if spline.name not in owner:
        owner[spline.name] = 0.0
    curve = curves.ensure(owner, curves.path_of(spline.name))
    if curve.lock:
        raise ValueError(f'"{spline.name}" is locked: unlock it in the Graph Editor')
    point = curve.keyframe_points.insert(frame, total)
    point.type = kind
    curve.update()


def rest(owner):
    """Ends the bends of an action that was taken away: its last samples would stay. A strip may move them."""
    tracks = owner.animation_data.nla_tracks if owner.animation_data else ()
    for name in (curves.SAMPLES, curves.OFFSETS):
        samples = owner.get(name, ())
        if any(samples) and not any(not strip.mute for track in tracks if not track.mute for strip in track.strips):
            owner[name] = [0.0] * len(samples)
            owner.update_tag()


def home_of(owner, scene):
    """The scene whose frames count: the first one that an object is in. Two windows would else solve it in turn, without end."""
    if len(bpy.data.scenes) == 1 or not isinstance(owner, bpy.types.Object):
        return scene
    return next((each for each in bpy.data.scenes if owner.name in each.objects), scene)


def solve_all(scene):
    rulers = {}
    for owner in owners():
        action = curves.action_of(owner)
        if stored.of(owner) and owner.is_editable and not action:
            rest(owner)
        elif stored.of(owner) and owner.is_editable and action.is_editable:
            muted = {channel.spline for chain in owner.wiggly.chains if chain.mute for channel in chain.channels}
            known, home = curves.all_of(owner), home_of(owner, scene)
            differs = fps_of(home) != fps_of(scene) or (home.frame_start, home.frame_end) != (scene.frame_start, scene.frame_end)
            slot = owner.animation_data.action_slot.handle if curves.LAYERED else 0
            for spline in owner.wiggly.splines:
                ruler = rulers.setdefault((action.name_full, slot, spline.slot), owner)
                if ruler != owner:
                    solved.pop(key_of(owner, spline), None)
                    problems[key_of(owner, spline)] = f'The action is shared: its keys swing with the settings of "{ruler.name}"'
                elif spline.name not in muted:
                    solve(owner, spline, home, known, home if differs else None)


@persistent
def guard(scene, depsgraph):
    """After each edit: solves what it changed."""
    if bpy.app.is_job_running('RENDER') or not any(
            isinstance(update.id, (bpy.types.Action, bpy.types.Object, bpy.types.Scene, bpy.types.Key)) for update in depsgraph.updates):
        return
    edits[0] += 1
    try:
        solve_all(scene)
    except ReferenceError:  # an ID has gone
        forget()
        solve_all(scene)


@persistent
def start_over(*_):
    forget()


def handlers():
    app = bpy.app.handlers
    return (app.depsgraph_update_post, guard), (app.load_post, start_over), (app.undo_post, start_over), (app.redo_post, start_over)


def register():
    for where, what in handlers():
        where.append(what)


def unregister():
    for where, what in handlers():
        where.remove(what)
