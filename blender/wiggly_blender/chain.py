"""Chains: constraints that bend bones on top of their own action, and the drivers of these constraints.

Bone n turns by q · C · Rz(side) · Rx(up) · Ry(twist) · C⁻¹, where q is what the action and earlier constraints say and C takes the
chain's axes into the bone. Each angle is gain · (y + o + Re(e^(-j·n·lag) x)), where o is what keys that settle add to the equilibrium y.
"""
import contextlib
import json
import math
from types import SimpleNamespace
import bpy
from mathutils import Matrix, Vector
from . import curves, settings, solve

ENDS = ' <', '', ' >'  # of the names of three constraints: into the chain's axes, the bend, and back
AXES = {'side': 'z', 'up': 'x', 'twist': 'y'}
USUAL_LENGTH, USUAL_FREQUENCY, SLOWEST, FASTEST = 0.5, 1.5, 0.8, 3.5  # longer chains swing slower, like a pendulum
USUAL_WIND_UP = 0.5  # of new splines, periods
SOLVED = {'frequency', 'damping', 'wind_up', 'settle', 'bandwidth', 'calm', 'start', 'first', 'last'}
SHARED = SOLVED | {'lag', 'gain'}
WHOLE = 110  # degrees: lag from the first bone to the tip, and the bend for a value of 1


def constraint_name(chain, end=''):
    return f'Wiggle {chain.name}{end}'


def rows_of(owner, chain):
    """Rows of bones that a chain bends, each from its first to its last: one row, or more after rigs with chains of this name were joined.
    Constraints that were copied to other bones have no drivers."""
    name, rows = constraint_name(chain), []
    driven = {driver.data_path.rpartition('.')[0] for driver in owner.animation_data.drivers} if owner.animation_data else ()
    bones = [bone for bone in owner.pose.bones if name in bone.constraints and bone.constraints[name].path_from_id() in driven]
    for bone in sorted(bones, key=lambda bone: len(bone.parent_recursive)):
        row = next((row for row in rows if row[-1] in bone.parent_recursive), None)
        if row:
            row.append(bone)
        else:
            rows.append([bone])
    return sorted(rows, key=lambda row: bones.index(row[0]))


def bones_of(owner, chain):
    """The bones of a chain's first row."""
    return next(iter(rows_of(owner, chain)), [])


def all_rows_of(owner, chain):
    rows = rows_of(owner, chain)
    if not rows:
        raise ValueError(f'"{chain.name}" has no bones any more: remove it')
    return rows


def of_selection(context):
    """The selected bones as rows; a bone selected alone is the first of its row."""
    selected = list(context.selected_pose_bones_from_active_object or ())
    if not selected:
        raise ValueError('Select the first bone of a chain, or all its bones')
    rows = []
    for head in selected:
        if head.parent in selected:
            continue
        row = [head]
        alone = not any(child in selected for child in head.children)
        while True:
            after = [child for child in row[-1].children if alone or child in selected]
            if len(after) > 1 and not alone:
                raise ValueError(f'"{row[-1].name}" has several selected children: select one row of bones')
            if len(after) != 1:
                break
            row += after
        rows.append(row)
    return rows


def points_at_rest(bones):
    """The ends of the bones in the armature's space, one more than bones; the tip as in wiggly, which knows no tails of bones."""
    heads, last = [bone.bone.head_local for bone in bones], bones[-1]
    if last.children:
        return heads + [last.children[0].bone.head_local]
    return heads + [2 * heads[-1] - heads[-2] if len(heads) > 1 else last.bone.tail_local]


def axes_at_rest(owner, chain, bones):
    """Columns up, along, side in the armature's space."""
    world = owner.matrix_world.to_3x3().normalized().inverted_safe()
    points = points_at_rest(bones)
    along = points[-1] - points[0]
    along = along.normalized() if along.length > 0 else Vector((0, 1, 0))
    up, front = world @ Vector((0, 0, 1)), world @ Vector((0, -1, 0))
    side = front if abs(along.dot(up)) > 0.98 else up
    side = (side - side.dot(along) * along).normalized()
    side = Matrix.Rotation(math.radians(chain.turn), 3, along) @ side
    return Matrix((along.cross(side), along, side)).transposed()


def axes_to_follow(owner, spline):
    chain = owner.wiggly.chains.get(spline.chain)
    if chain:
        return axes_at_rest(owner, chain, bones_of(owner, chain))
    world = owner.matrix_world.to_3x3().normalized().inverted_safe()
    return Matrix([world @ Vector(axis) for axis in ((-1, 0, 0), (0, -1, 0), (0, 0, 1))]).transposed()


def target_for(owner, first):
    """What the constraints of a chain name as target: they need one, but do not read it. It must not follow the chain."""
    above = first.parent_recursive
    if above:
        return owner, above[-1].name
    other = next((bone for bone in owner.pose.bones if not bone.parent and bone != first), None)
    if other:
        return owner, other.name
    others = [owner.parent] + [each for each in bpy.context.scene.objects if each.parent_type != 'BONE' and not each.constraints]
    found = next((each for each in others if each and each != owner), None)
    if not found:
        raise ValueError(f'"{first.name}" has no parent: add any object to the scene, or a bone above the chain')
    return found, ''


def constrain(owner, chain, bones):
    target, subtarget = target_for(owner, bones[0])
    axes = axes_at_rest(owner, chain, bones)
    for bone in bones:
        for con in [con for con in bone.constraints if con.type == 'TRANSFORM' and con.name.startswith('Wiggle ')]:  # copied from another bone
            bone.constraints.remove(con)
        into = (bone.bone.matrix_local.to_3x3().inverted() @ axes).to_quaternion()
        ends = ('',) if into.angle < 1e-4 else ENDS
        for end in ends:
            con = bone.constraints.new('TRANSFORM')
            con.name = constraint_name(chain, end)
            con.target, con.subtarget = target, subtarget
            con.owner_space, con.target_space = 'LOCAL', 'WORLD'
            con.map_to, con.mix_mode_rot, con.to_euler_order, con.show_expanded = 'ROTATION', 'AFTER', 'YXZ', False
            if end:
                turn = (into if end == ' <' else into.inverted()).to_euler('YXZ')
                con.to_min_x_rot, con.to_min_y_rot, con.to_min_z_rot = turn


def each_of(value, n, count):
    """A number, array or ramp at a bone."""
    if isinstance(value, list):
        return value[min(n, len(value) - 1)]
    if isinstance(value, dict):
        places, at = value['ramp'], n / max(count - 1, 1)
        for (a, low), (b, high) in zip(places, places[1:]):
            if at <= b:
                return low if at <= a else low + (high - low) * (at - a) / (b - a)
        return places[-1][1]
    return value


def weights(channel, n, count):
    """Gain, times cos and sin of the lag, in radians at bone n."""
    ramps = json.loads(channel.ramps) if channel.ramps else {}
    lag = each_of(ramps['lag'], n, count) if 'lag' in ramps else n * channel.lag
    gain = math.radians(each_of(ramps.get('gain', channel.gain), n, count))
    return gain, gain * math.cos(math.radians(lag)), gain * math.sin(math.radians(lag))


def drive(owner, chain, bones=None):
    """Writes the drivers of a chain anew."""
    rows = [bones] if bones else rows_of(owner, chain)
    undrive(owner, chain)
    for n, bone, bones in ((n, bone, row) for row in rows for n, bone in enumerate(row)):
        path = bone.constraints[constraint_name(chain)].path_from_id()
        for axis in sorted({channel.axis for channel in chain.channels}):
            sign, terms, rest = -1 if chain.mirror and axis != 'up' else 1, [], 0
            for channel in chain.channels:
                if channel.axis == axis:
                    gain, real, imaginary = weights(channel, n, len(bones))
                    spline = owner.wiggly.splines[channel.spline]
                    terms += [(spline, 're', sign * real), (spline, 'im', sign * imaginary)]
                    if curves.has_offset(owner, spline):
                        terms.append((spline, 'o', sign * gain))
                    if channel.of == 'total' and spline.follow != 'none':
                        terms.append((spline, 'y', sign * gain))
                    elif channel.of == 'total':
                        rest += sign * gain * spline.equilibrium
            drive_by(owner, f'{path}.to_min_{AXES[axis]}_rot', -1, terms, rest)
        for each in constraints_of(bone, chain):
            each.mute = chain.mute


def drive_by(owner, path, index, terms, rest=0):
    """Drives a property by a sum of parts of splines, each with its weight, and a number."""
    driver = owner.driver_add(path, index).driver
    words = [f'{rest:.9g}'] if rest else []
    for spline, part, weight in terms:
        if weight:
            variable = driver.variables.new()
            variable.name = f'v{len(driver.variables)}'
            target = variable.targets[0]
            target.id_type, target.id = owner.id_type, owner
            path, index = curves.slot_path(spline, part)
            target.data_path = f'{path}[{index}]'
            words.append(f'{weight:.9g}*{variable.name}')
    driver.expression = '+'.join(words or ['0']).replace('+-', '-')
    return driver


def readers(owner, spline):
    """The drivers that a spline is part of."""
    paths = ['{}[{}]'.format(*curves.slot_path(spline, part)) for part in (*curves.PARTS, 'o')]
    return [each for each in owner.animation_data.drivers if any(variable.targets[0].data_path in paths for variable in each.driver.variables)
            ] if owner.animation_data else []


def undrive(owner, chain):
    """Removes the drivers of a chain, and those of bones that were deleted."""
    name = f'.constraints{curves.path_of(constraint_name(chain))}.to_min_'
    for driver in [each for each in owner.animation_data.drivers if name in each.data_path] if owner.animation_data else ():
        owner.animation_data.drivers.remove(driver)


def constraints_of(bone, chain):
    return [con for con in (bone.constraints.get(constraint_name(chain, end)) for end in ENDS) if con]


def unbend(owner, chain):
    """Removes the drivers and constraints of a chain."""
    undrive(owner, chain)
    for bone in owner.pose.bones:
        for con in constraints_of(bone, chain):
            bone.constraints.remove(con)


def strays(owner):
    """Chains, known by name only, that came with a rig which was joined: Blender keeps their bends, which then follow the samples of other chains."""
    chains = owner.wiggly.chains if settings.of(owner) else ()
    known = {constraint_name(chain, end) for chain in chains for end in ENDS}
    names = {con.name for bone in owner.pose.bones for con in bone.constraints if con.type == 'TRANSFORM' and con.name.startswith('Wiggle ')} - known
    driven = ''.join(driver.data_path for driver in owner.animation_data.drivers) if names and owner.animation_data else ''
    return [SimpleNamespace(name=name[7:]) for name in sorted(names) if f'.constraints{curves.path_of(name)}.to_min_' in driven]


def mend(owner):
    """After rigs were joined: the lag begins anew in each row, and what follows samples of other chains rests."""
    for chain in strays(owner):
        for bone in owner.pose.bones:
            for con in constraints_of(bone, chain):
                con.mute = True
    for chain in owner.wiggly.chains if settings.of(owner) else ():
        if len(rows_of(owner, chain)) > 1:
            drive(owner, chain)


@contextlib.contextmanager
def muted(owner):
    """Within this, nothing bends an armature."""
    cons = [con for bone in owner.pose.bones for con in bone.constraints if con.name.startswith('Wiggle ') and not con.mute]
    for con in cons:
        con.mute = True
    try:
        yield
    finally:
        for con in cons:
            con.mute = False


def chain_of(owner, spline):
    """The first chain that a spline bends."""
    return next((chain for chain in owner.wiggly.chains if any(channel.spline == spline.name for channel in chain.channels)), None)


def unique(name, taken):
    return next(each for each in (name if n == 1 else f'{name} {n}' for n in range(1, len(taken) + 2)) if each not in taken)


def check_local(owner):
    if owner.override_library:
        raise ValueError(f'"{owner.name}" is a library override: add or remove the wiggle in the file that it comes from')


def check(owner, bones):
    """Raises what keeps a chain from being made."""
    check_local(owner)
    taken = [bone for chain in owner.wiggly.chains for row in rows_of(owner, chain) for bone in row]
    taken += [bone for chain in strays(owner) for bone in owner.pose.bones if constraints_of(bone, chain)]
    for bone in bones:
        if bone in taken:
            raise ValueError(f'"{bone.name}" already wiggles: remove that first')
    target_for(owner, bones[0])


def make(owner, bones, follow, loop=False):
    """Adds a chain with a spline for each of two axes."""
    wiggly = owner.wiggly
    name = bones[0].name
    bare = name.rstrip('0123456789').rstrip('_-. ') or name
    bare = bare.encode()[:48].decode(errors='ignore')  # the name of a constraint has room for 63 bytes
    chain = wiggly.chains.add()
    used = [spline.name for spline in wiggly.splines] + [curve.data_path[2:-2] for curve in curves.list_of(owner) or ()]
    chain.name = unique(bare, set(wiggly.chains.keys()) | {each[:-5] for each in used if each.endswith(' side')})
    points = points_at_rest(bones)
    length = max(sum((b - a).length for a, b in zip(points, points[1:])) * owner.matrix_world.median_scale, 1e-3)
    count = len(bones)
    for axis in ('side', 'up'):
        spline = add_spline(owner, f'{chain.name} {axis}')
        spline.frequency = round(min(max(USUAL_FREQUENCY * math.sqrt(USUAL_LENGTH / length), SLOWEST), FASTEST), 1)
        spline.start = 'loop' if loop else 'rest'
        spline.follow = ('across' if axis == 'side' else 'up') if follow else 'none'
        spline.chain = chain.name
        channel = chain.channels.add()
        channel.spline, channel.axis, channel.of = spline.name, axis, 'displacement' if follow else 'total'
        channel.lag = round(WHOLE / count)
        channel.gain = round(math.degrees(2 / (length * (count + 1))) if follow else WHOLE / count, 1)
    wiggly.active = len(wiggly.chains) - 1
    constrain(owner, chain, bones)
    drive(owner, chain, bones)
    return chain


def remove(owner, chain):
    """Takes a chain away, with all that it added."""
    check_local(owner)
    unbend(owner, chain)
    wiggly = owner.wiggly
    wiggly.active = max(0, min(wiggly.active, len(wiggly.chains) - 2))
    names = {channel.spline for channel in chain.channels}
    wiggly.chains.remove(wiggly.chains.find(chain.name))
    for name in names - {channel.spline for each in wiggly.chains for channel in each.channels}:
        remove_spline(owner, name)


def add_spline(owner, name):
    splines = owner.wiggly.splines
    taken = {spline.slot for spline in splines} | {index // 3 for path, index in curves.all_of(owner) if path == curves.SAMPLES_PATH}
    slot = next(slot for slot in range(len(taken) + 1) if slot not in taken)  # nor in use by another ID with this action
    spline = splines.add()
    spline.name, spline.slot, spline.wind_up = name, slot, USUAL_WIND_UP
    spline.first, spline.last = bpy.context.scene.frame_start, bpy.context.scene.frame_end
    owner[name] = 0.0
    curves.make_room(owner, spline)
    solve.forget()
    return spline


def remove_spline(owner, name):
    spline = owner.wiggly.splines[name]
    curves.drop(owner, curves.path_of(name))
    curves.drop_samples(owner, spline)
    if name in owner:
        del owner[name]
    owner.wiggly.splines.remove(owner.wiggly.splines.find(name))
    if not owner.wiggly.splines:
        for each in (curves.SAMPLES, curves.OFFSETS):
            owner.pop(each, None)
        curves.tidy(owner)
        owner.property_unset('wiggly')


def settings_changed(setting, name):
    """After an edit in the panel: the chain's other axes get the same, and the drivers follow."""
    owner = setting.id_data
    for chain in owner.wiggly.chains if getattr(owner, 'pose', None) else ():
        channels = list(chain.channels)
        rows = [chain], channels, [owner.wiggly.splines[channel.spline] for channel in channels if channel.spline in owner.wiggly.splines]
        row = next((row for row in rows if setting in row), ())
        if row and name not in SOLVED:
            drive(owner, chain)
        for each in row if chain.alike and name in SHARED else ():
            if getattr(each, name) != getattr(setting, name):
                setattr(each, name, getattr(setting, name))
