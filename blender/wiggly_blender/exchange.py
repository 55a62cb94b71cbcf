"""Scenes of wiggly: a .json beside a .glb."""
import contextlib
import json
import math
import os
import tempfile
import bpy
import wiggly
from mathutils import Matrix
from . import base, chain as chains, curves, settings, solve

NUMBERS = ('frequency', 'damping', 'bandwidth', 'calm', 'wind_up')
DEFAULTS = {'frequency': 0, 'damping': 0, 'bandwidth': 0.1, 'calm': 1, 'wind_up': 0, 'mode': 'complex', 'start': 'free', 'axis': 'side', 'of': 'total', 'scale': 1, 'fps': 24}
OTHERS = ('passive', 'limits', 'variation', 'color')  # kept, and used where the solver knows them


def short(number):
    """The shortest number that is stored as this one, in single precision."""
    return next(x for x in (float(f'{number:.{digits}g}') for digits in range(1, 18)) if curves.single(x) == curves.single(number))


# --- export

def knot(spline, point, fps):
    frame = short(point.co[0])
    knot = {'frame': int(frame) if frame == int(frame) else frame}
    if point.type == 'MOVING_HOLD':
        return {**knot, 'still': True}
    knot['value'] = short(point.co[1])
    slope = curves.slope(point)
    if slope is not None:
        knot['slope'] = float(f'{slope * fps:.6g}')
    if curves.held(point, curves.STIFF):
        knot['stiffness'] = short(point.amplitude)
    if curves.held(point, curves.POSE):
        knot['im'] = short(point.back)
    if curves.settles(spline, point):
        knot['settles'] = True
    return knot


def spline_out(owner, spline, model, fps):
    curve = curves.find(owner, curves.path_of(spline.name))
    chain = chains.chain_of(owner, spline)
    out = {'name': spline.name, 'mode': spline.mode, **{name: short(getattr(spline, name)) for name in NUMBERS}}
    out['equilibrium'] = short(spline.equilibrium)
    if spline.follow != 'none':
        out['equilibrium'] = {'model': model, 'joint': spline.joint or chains.all_rows_of(owner, chain)[0][-1].name, 'of': spline.follow,
                              'gain': short(spline.follow_gain)}
        if spline.chain:
            out['equilibrium']['chain'] = spline.chain
    out['start'] = spline.start
    out.update(json.loads(spline.more or '{}'))
    out['knots'] = [knot(spline, point, fps) for point in curve.keyframe_points] if curve else []
    return out


def chain_out(owner, chain, model):
    """One a row: each is a chain of the scene, with the same splines."""
    for n, bones in enumerate(chains.all_rows_of(owner, chain), 1):
        name = chain.name if n == 1 else chains.unique(f'{chain.name} {n}', owner.wiggly.chains.keys())
        out = {'type': 'chain', 'name': name, 'model': model, 'from': bones[0].name, 'to': bones[-1].name,
               'turn': short(chain.turn), 'mirror': chain.mirror, 'channels': []}
        for channel in chain.channels:
            ramps = json.loads(channel.ramps or '{}')
            out['channels'].append({'spline': channel.spline, 'axis': channel.axis, 'of': channel.of,
                                    **{name: ramps.get(name, short(getattr(channel, name))) for name in ('lag', 'gain')}})
        yield out


def model_of(path):
    """The character beside a scene."""
    return os.path.splitext(path)[0] + '.glb'


def write(context, owner, path, overwrite):
    """The chains of an armature, and the character beside them as its action alone moves it. Both are written in a folder of their own
    and then moved, so that no file is changed before both are whole, nor what a link names."""
    path = os.path.abspath(path)
    scene, model = context.scene, model_of(path)
    if os.path.splitext(path)[1].lower() != '.json':
        raise ValueError(f'"{path}": expected a name that ends in .json')
    if os.path.lexists(model) and not overwrite:
        raise ValueError(f'"{model}" is there already: choose another name, or tick Overwrite Character')
    for each in (path, model):
        if os.path.isdir(each):
            raise ValueError(f'"{each}" is a folder')
    fps = solve.fps_of(scene)
    names = {channel.spline for chain in owner.wiggly.chains for channel in chain.channels}
    action = curves.action_of(owner)
    rig = {'type': 'model', 'name': owner.name, 'model': os.path.basename(model)}
    if action:
        rig['clip'] = action.name
    out = {'wiggly': 1, 'fps': short(fps), 'frames': [scene.frame_start, scene.frame_end],
           'splines': [spline_out(owner, spline, owner.name, fps) for spline in owner.wiggly.splines if spline.name in names],
           'rigs': [rig] + [out for chain in owner.wiggly.chains for out in chain_out(owner, chain, owner.name)]}
    try:
        with tempfile.TemporaryDirectory(dir=os.path.dirname(path), prefix='.wiggly-') as folder:
            new_path, new_model = os.path.join(folder, 'new.json'), os.path.join(folder, 'new.glb')
            with open(new_path, 'w', encoding='utf-8') as file:
                json.dump(out, file, indent=2, ensure_ascii=False)
                file.write('\n')
            with chains.muted(owner):
                bpy.ops.export_scene.gltf(filepath=new_model, export_format='GLB')
            os.replace(new_model, model)
            os.replace(new_path, path)
    except OSError as problem:
        raise ValueError(f'{path}: {problem.strerror}') from problem
    except RuntimeError as problem:  # of the exporter
        raise ValueError(f'{model}: {last_line(problem)}') from problem


# --- import

def last_line(problem):
    return str(problem).strip().splitlines()[-1]


def number(what, data, name, low=-math.inf, high=math.inf, default=0):
    value = data.get(name, DEFAULTS.get(name, default))
    if isinstance(value, dict):
        raise ValueError(f'{what}: expected a number as its {name}, got a track, which Blender cannot follow')
    if not isinstance(value, (int, float)) or not math.isfinite(value) or not low <= value <= high:
        where = f' from {low} to {high}' if high < math.inf else ''
        raise ValueError(f'{what}: expected a number{where} as its {name}, got {json.dumps(value)}')
    return value


def choice(what, data, name, kind, setting):
    """A word, of those that a setting takes."""
    known = kind.bl_rna.properties[setting].enum_items.keys()
    value = data.get(name, DEFAULTS.get(name))
    if value not in known:
        raise ValueError(f'{what}: expected {", ".join(known)} as its {name}, got {json.dumps(value)}')
    return value


def check_spline(data, fps):
    """Raises what would keep a spline from being made or solved."""
    what, y = f'"{data["name"]}"', data.get('equilibrium', 0)
    if 'spring' in data or 'friction' in data:
        raise ValueError(f'{what}: expected frequency and damping, got spring and friction: open and save the scene in wiggly')
    if isinstance(y, dict) and 'joint' in y:
        choice(what, y, 'of', settings.Spline, 'follow')
        number(what, {'gain': 1, **y}, 'gain')
    else:
        number(what, data, 'equilibrium')
    for knot in data.get('knots', ()):
        number(f'{what}, a knot', knot, 'frame', -settings.FARTHEST, settings.FARTHEST, None)
        for name in ('value', 'slope', 'stiffness', 'im'):
            number(f'{what}, the knot at frame {knot["frame"]}', knot, name)
    numbers = {name: number(what, data, name) for name in NUMBERS}
    varied, limits = data.get('variation', {}), data.get('limits')
    if not isinstance(varied, dict):
        raise ValueError(f'{what}: expected an amount and a seed as its variation, got {json.dumps(varied)}')
    if limits is not None and (not isinstance(limits, list) or len(limits) != 2):
        raise ValueError(f'{what}: expected two numbers as its limits, got {json.dumps(limits)}')
    words = {name: choice(what, data, name, settings.Spline, name) for name in ('mode', 'start')}
    try:
        wiggly.Spline(**numbers, **words, **solve.more(data)).solve(4, fps)
    except (TypeError, ValueError) as problem:  # of what only the solver knows
        raise ValueError(f'{what}: {problem}') from None


def check_chain(data, splines):
    what = f'"{data["name"]}"'
    number(what, data, 'turn')
    for channel in channels_of(data):
        if channel['spline'] not in splines:
            raise ValueError(f'{what}: there is no spline "{channel["spline"]}"')
        for name in ('axis', 'of'):
            choice(what, channel, name, settings.Channel, name)
        for name in ('lag', 'gain'):
            value = channel.get(name, 0)
            for each in value if isinstance(value, list) else sum(value['ramp'], []) if isinstance(value, dict) else [value]:
                number(what, {name: each}, name)
            chains.each_of(value, 0, 2)


def check(data, folder):
    """Raises what is wrong with a scene before anything is made of it."""
    (first, last), fps = data['frames'], data.get('fps', DEFAULTS['fps'])
    if not isinstance(first, int) or not isinstance(last, int) or not -settings.FARTHEST <= first <= last <= settings.FARTHEST:
        raise ValueError(f'expected a scene of wiggly with frames from {-settings.FARTHEST} to {settings.FARTHEST}, got {json.dumps(data["frames"])}')
    if not isinstance(fps, (int, float)) or not 0.01 <= fps <= 30000:
        raise ValueError(f'expected a scene of wiggly with 0.01 to 30000 frames a second, got {json.dumps(fps)}')
    splines = {each['name']: each for each in data.get('splines', ())}
    for each in data.get('rigs', ()):
        if each['type'] == 'model':
            if not os.path.exists(os.path.join(folder, each['model'])):
                raise ValueError(f'"{each["model"]}" is not there')
            for name in ('turn', 'scale'):
                number(f'"{each["model"]}"', each, name)
        elif each['type'] == 'chain':
            check_chain(each, splines)
            for channel in channels_of(each):
                check_spline(splines[channel['spline']], fps)


def channels_of(data):
    return data['channels'] if 'channels' in data else [data]


def knots_in(owner, spline, knots, fps):
    curve = curves.ensure(owner, curves.path_of(spline.name))
    for each in knots:
        point = curve.keyframe_points.insert(each['frame'], each.get('value', 0))
        if each.get('still'):
            point.type = 'MOVING_HOLD'
        if 'im' in each:
            point.type = 'EXTREME'
            curves.hold(point, curves.POSE, each['im'])
        if each.get('settles'):
            point.type = 'JITTER'
        if 'slope' in each:
            point.handle_left_type = point.handle_right_type = 'FREE'
            rise = each['slope'] / fps
            point.handle_left, point.handle_right = (point.co[0] - 1, point.co[1] - rise), (point.co[0] + 1, point.co[1] + rise)
        if 'stiffness' in each:
            curves.hold(point, curves.STIFF, each['stiffness'])
    curve.update()


def spline_in(owner, data, fps):
    spline = chains.add_spline(owner, data['name'])
    for name in (*NUMBERS, 'mode', 'start'):
        setattr(spline, name, data.get(name, DEFAULTS[name]))
    y = data.get('equilibrium', 0)
    if isinstance(y, dict):
        spline.follow, spline.joint, spline.follow_gain = y['of'], y['joint'], y.get('gain', 1)
        spline.chain = y.get('chain', '')
    else:
        spline.equilibrium = y
    spline.more = json.dumps({name: data[name] for name in OTHERS if name in data})
    knots_in(owner, spline, data.get('knots', ()), fps)


def chain_in(owner, data):
    bone, row = owner.pose.bones.get(data['to']), []
    while bone and (not row or row[0].name != data['from']):
        row.insert(0, bone)
        bone = bone.parent
    if not row or row[0].name != data['from']:
        raise ValueError(f'"{data["name"]}": expected a row of bones from "{data["from"]}" to "{data["to"]}"')
    chain = owner.wiggly.chains.add()
    chain.name, chain.turn, chain.mirror = data['name'], data.get('turn', 0), data.get('mirror', False)
    chain.alike = False
    for each in channels_of(data):
        channel = chain.channels.add()
        channel.spline, channel.axis, channel.of = each['spline'], each.get('axis', DEFAULTS['axis']), each.get('of', DEFAULTS['of'])
        values = {'lag': each.get('lag', 6.5), 'gain': each.get('gain', 5)}
        for name, value in values.items():
            if isinstance(value, (int, float)):
                setattr(channel, name, value)
        channel.ramps = json.dumps({name: value for name, value in values.items() if not isinstance(value, (int, float))})
    chains.constrain(owner, chain, row)
    chains.drive(owner, chain, row)


def model_in(data, folder):
    """Imports a character and gives back its armature."""
    before = {*bpy.data.objects, *bpy.data.actions}
    bpy.ops.import_scene.gltf(filepath=os.path.join(folder, data['model']))
    new = [each for each in bpy.data.objects if each not in before]
    owner = next((each for each in new if each.type == 'ARMATURE'), None)
    if not owner:
        raise ValueError(f'"{data["model"]}" has no bones')
    x, y, z = (each if isinstance(each, (int, float)) else 0 for each in data.get('position', (0, 0, 0)))
    place = Matrix.Translation((x, -z, y)) @ Matrix.Rotation(math.radians(data.get('turn', 0)), 4, 'Z') @ Matrix.Scale(data.get('scale', 1), 4)
    for each in new:
        if not each.parent:
            each.matrix_world = place @ each.matrix_world
    clip = data.get('clip')
    actions = [each for each in bpy.data.actions if each not in before]  # their names differ where there were such before
    action = next((each for each in actions if clip and (each.name == clip or each.name.startswith((clip + '_', clip + '.')))), None)
    if action:
        owner.animation_data_create().action = action
        if curves.LAYERED:
            owner.animation_data.action_slot = owner.animation_data.action_suitable_slots[0]
        for curve in curves.list_of(owner) or ():
            curve.modifiers.new('CYCLES')  # wiggly repeats clips
    owner.name = data['name'] if 'name' in data else owner.name
    return owner


def read(context, path):
    """Opens a scene: its characters, their chains, and the splines of these. Gives back names of what it left out."""
    name, folder = os.path.basename(path), os.path.dirname(path)
    try:
        with open(path, encoding='utf-8-sig') as file:
            data = json.load(file)
        check(data, folder)
        with all_or_nothing(context):
            return build(context, data, folder)
    except (OSError, UnicodeDecodeError, json.JSONDecodeError, RecursionError, LookupError, TypeError, AttributeError, ArithmeticError) as problem:
        raise ValueError(f'{name}: expected a scene of wiggly, got {type(problem).__name__} {problem}') from problem
    except ValueError as problem:
        raise ValueError(f'{name}: {problem}') from problem
    except RuntimeError as problem:  # of the importer
        raise ValueError(f'{name}: {last_line(problem)}') from problem


@contextlib.contextmanager
def all_or_nothing(context):
    """After an error within this, the file is as it was: nothing new is in it, and the scene's frames and the selection are those of before."""
    scene, layer = context.scene, context.view_layer
    kinds = [getattr(bpy.data, each.identifier) for each in bpy.data.bl_rna.properties if each.type == 'COLLECTION' and each.identifier != 'shape_keys']
    before, selected, active = {each for kind in kinds for each in kind}, set(context.selected_objects), layer.objects.active
    frames = scene.frame_start, scene.frame_end, scene.frame_current, scene.frame_subframe, scene.render.fps, scene.render.fps_base
    try:
        yield
    except BaseException:
        bpy.data.batch_remove([each for kind in kinds for each in kind if each not in before])
        solve.forget()
        scene.render.fps, scene.render.fps_base = frames[4:]
        scene.frame_start, scene.frame_end = frames[:2]
        scene.frame_set(frames[2], subframe=frames[3])
        for each in layer.objects:
            each.select_set(each in selected)
        layer.objects.active = active
        raise


def build(context, data, folder):
    fps, scene, owners, left = data.get('fps', DEFAULTS['fps']), context.scene, {}, []
    scene.render.fps = max(1, round(fps))
    scene.render.fps_base = scene.render.fps / fps
    scene.frame_start, scene.frame_end = data['frames']
    rigs, splines = data.get('rigs', ()), {each['name']: each for each in data.get('splines', ())}
    for rig in rigs:
        if rig['type'] == 'model':
            owners[rig.get('name', rig['model'])] = model_in(rig, folder)
    for rig in rigs:
        if rig['type'] == 'chain' and rig['model'] in owners:
            owner = owners[rig['model']]
            for channel in channels_of(rig):
                if not settings.of(owner) or channel['spline'] not in owner.wiggly.splines:
                    spline_in(owner, splines[channel['spline']], fps)
            chain_in(owner, rig)
            if rig.get('offset'):
                left.append(f'the offset of {rig["name"]}')  # no driver reads another frame
        elif rig['type'] != 'model':
            left.append(rig.get('name', rig['type']))
    for owner in owners.values():
        if settings.of(owner):
            base.refresh(context, owner)
    return left
