"""Scenes of wiggly: a .json beside a .glb."""
import json
import math
import os
import bpy
from mathutils import Matrix
from . import base, chain as chains, curves, settings, solve

NUMBERS = ('frequency', 'damping', 'bandwidth', 'calm')
DEFAULTS = {'frequency': 0, 'damping': 0, 'bandwidth': 0.1, 'calm': 1}
OTHERS = ('passive', 'limits', 'variation', 'color')  # kept, and used where the solver knows them


def short(number):
    """The shortest number that is stored as this one, in single precision."""
    return next(x for x in (float(f'{number:.{digits}g}') for digits in range(1, 18)) if curves.single(x) == curves.single(number))


# --- export

def knot(point, fps):
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
    out['knots'] = [knot(point, fps) for point in curve.keyframe_points] if curve else []
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


def write(context, owner, path):
    """The chains of an armature, and the character beside them as its action alone moves it."""
    scene = context.scene
    model = os.path.splitext(path)[0] + '.glb'
    fps = solve.fps_of(scene)
    names = {channel.spline for chain in owner.wiggly.chains for channel in chain.channels}
    action = curves.action_of(owner)
    rig = {'type': 'model', 'name': owner.name, 'model': os.path.basename(model)}
    if action:
        rig['clip'] = action.name
    out = {'wiggly': 1, 'fps': short(fps), 'frames': [scene.frame_start, scene.frame_end],
           'splines': [spline_out(owner, spline, owner.name, fps) for spline in owner.wiggly.splines if spline.name in names],
           'rigs': [rig] + [out for chain in owner.wiggly.chains for out in chain_out(owner, chain, owner.name)]}
    with open(path + '.new', 'w', encoding='utf-8') as file:
        json.dump(out, file, indent=2, ensure_ascii=False)
        file.write('\n')
    try:
        with chains.muted(owner):
            bpy.ops.export_scene.gltf(filepath=model, export_format='GLB')
        os.replace(path + '.new', path)
    except RuntimeError as problem:  # of the exporter
        os.remove(path + '.new')
        raise ValueError(f'{model}: {str(problem).strip().splitlines()[-1]}') from problem


# --- import

def number(spline, name):
    value = spline.get(name, DEFAULTS.get(name, 0))
    if not isinstance(value, (int, float)):
        raise ValueError(f'"{spline["name"]}": expected a number as its {name}, got a track, which Blender cannot follow')
    return value


def knots_in(owner, spline, knots, fps):
    curve = curves.ensure(owner, curves.path_of(spline.name))
    for each in knots:
        point = curve.keyframe_points.insert(each['frame'], each.get('value', 0))
        if each.get('still'):
            point.type = 'MOVING_HOLD'
        if 'im' in each:
            point.type = 'EXTREME'
            curves.hold(point, curves.POSE, each['im'])
        if 'slope' in each:
            point.handle_left_type = point.handle_right_type = 'FREE'
            rise = each['slope'] / fps
            point.handle_left, point.handle_right = (point.co[0] - 1, point.co[1] - rise), (point.co[0] + 1, point.co[1] + rise)
        if 'stiffness' in each:
            curves.hold(point, curves.STIFF, each['stiffness'])
    curve.update()


def spline_in(owner, data, fps):
    if 'spring' in data or 'friction' in data:
        raise ValueError(f'"{data["name"]}": expected frequency and damping, got spring and friction: open and save the scene in wiggly')
    spline = chains.add_spline(owner, data['name'])
    for name in NUMBERS:
        setattr(spline, name, number(data, name))
    spline.mode, spline.start = data.get('mode', 'complex'), data.get('start', 'free')
    y = data.get('equilibrium', 0)
    if isinstance(y, dict) and 'joint' in y:
        spline.follow, spline.joint, spline.follow_gain = y['of'], y['joint'], y.get('gain', 1)
        spline.chain = y.get('chain', '')
    else:
        spline.equilibrium = number(data, 'equilibrium')
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
    for each in data['channels'] if 'channels' in data else [data]:
        channel = chain.channels.add()
        channel.spline, channel.axis, channel.of = each['spline'], each.get('axis', 'side'), each.get('of', 'total')
        values = {'lag': each.get('lag', 6.5), 'gain': each.get('gain', 5)}
        for name, value in values.items():
            if isinstance(value, (int, float)):
                setattr(channel, name, value)
        channel.ramps = json.dumps({name: value for name, value in values.items() if not isinstance(value, (int, float))})
    chains.constrain(owner, chain, row)
    chains.drive(owner, chain, row)


def model_in(data, folder):
    """Imports a character and gives back its armature."""
    before = set(bpy.data.objects)
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
    action = next((each for each in bpy.data.actions if clip and (each.name == clip or each.name.startswith(clip + '_'))), None)
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
    try:
        with open(path, encoding='utf-8') as file:
            return build(context, json.load(file), os.path.dirname(path))
    except (OSError, json.JSONDecodeError, LookupError, TypeError, AttributeError, ArithmeticError) as problem:
        raise ValueError(f'{os.path.basename(path)}: expected a scene of wiggly, got {type(problem).__name__} {problem}') from problem
    except RuntimeError as problem:  # of the importer
        raise ValueError(str(problem)) from problem


def build(context, data, folder):
    rigs, splines = data['rigs'], {each['name']: each for each in data['splines']}
    models = [each for each in rigs if each['type'] == 'model']
    for each in models:
        if not os.path.exists(os.path.join(folder, each['model'])):
            raise ValueError(f'"{each["model"]}" is not there')
    fps, scene = data.get('fps', 24), context.scene
    scene.render.fps = max(1, round(fps))
    scene.render.fps_base = scene.render.fps / fps
    scene.frame_start, scene.frame_end = data['frames']
    owners = {each.get('name', each['model']): model_in(each, folder) for each in models}
    for rig in rigs:
        if rig['type'] == 'chain' and rig['model'] in owners:
            owner = owners[rig['model']]
            for channel in rig['channels'] if 'channels' in rig else [rig]:
                if not settings.of(owner) or channel['spline'] not in owner.wiggly.splines:
                    spline_in(owner, splines[channel['spline']], fps)
            chain_in(owner, rig)
    for owner in owners.values():
        if settings.of(owner):
            base.refresh(context, owner)
    return [each.get('name', each['type']) for each in rigs if each['type'] not in {'model', 'chain'}]
