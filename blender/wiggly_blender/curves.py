"""F-Curves of any ID, in Blender 4.2 to 5.x."""
from array import array
import bpy

LAYERED = bpy.app.version >= (4, 4, 0)
SAMPLES, OFFSETS, PARTS, STAMP, MADE = 'wiggle samples', 'wiggle offsets', ('re', 'im', 'y'), 'wiggle stamp', 'wiggle made'
SAMPLES_PATH, OFFSETS_PATH = f'["{SAMPLES}"]', f'["{OFFSETS}"]'
HELD, POSE, STIFF = 240000, 1, 2  # in an unused number of a keyframe, `period`: HELD + 1 if `back` is the phase of a pose, + 2 if `amplitude` is a stiffness


def single(number):
    return array('f', [number])[0]


def path_of(name):
    return f'["{bpy.utils.escape_identifier(name)}"]'


def action_of(owner):
    """The action that moves an ID; none in which it has no slot."""
    animation = owner.animation_data
    return animation.action if animation and (not LAYERED or animation.action_slot) else None


def list_of(owner, make=False):
    """The F-Curves of an ID in its action, or None."""
    if make:
        animation = owner.animation_data_create()
        if not animation.action:
            animation.action = bpy.data.actions.new(owner.name + ' action')
            animation.action[MADE] = True
        if not animation.action.is_editable:
            raise ValueError(f'The action "{animation.action.name}" is linked: make it single-user to change it')
        if LAYERED and not animation.action_slot:
            suitable = animation.action_suitable_slots
            animation.action_slot = suitable[0] if suitable else animation.action.slots.new(owner.id_type, owner.name)
    action = action_of(owner)
    if not action or not LAYERED:
        return action and action.fcurves
    slot = owner.animation_data.action_slot
    if make:
        layer = action.layers[0] if action.layers else action.layers.new('Layer')
        strip = layer.strips[0] if layer.strips else layer.strips.new(type='KEYFRAME')
        return strip.channelbag(slot, ensure=True).fcurves
    bag = action.layers[0].strips[0].channelbag(slot) if action.layers and action.layers[0].strips else None
    return bag and bag.fcurves


def find(owner, path, index=0):
    curves = list_of(owner)
    return curves.find(path, index=index) if curves else None


def all_of(owner):
    """By path and index: Blender's own find() goes through all."""
    return {(curve.data_path, curve.array_index): curve for curve in list_of(owner) or ()}


def ensure(owner, path, index=0):
    curves = list_of(owner, make=True)
    return curves.find(path, index=index) or curves.new(path, index=index)


def drop(owner, path, index=0):
    curve = find(owner, path, index)
    if curve:
        list_of(owner).remove(curve)


SHAPE = (('co', 'f', 2), ('handle_left', 'f', 2), ('handle_right', 'f', 2))
ALL = SHAPE + (('back', 'f', 1), ('period', 'f', 1), ('amplitude', 'f', 1), ('type', 'i', 1), ('handle_left_type', 'i', 1),
               ('handle_right_type', 'i', 1))


def read(curve, what=ALL):
    """The keys as bytes: equal bytes are equal keys."""
    points = curve.keyframe_points if curve else ()
    parts = []
    for name, code, size in what if points else ():
        values = array(code, bytes(4 * size * len(points)))
        points.foreach_get(name, values)
        parts.append(values.tobytes())
    return b'|'.join(parts)


def held(point, what):
    """Whether a keyframe's unused numbers hold that."""
    return HELD <= point.period <= HELD + POSE + STIFF and bool(int(point.period) & what)


def hold(point, what, value):
    """Holds a number with a keyframe, so that it is moved and copied with it; None: no longer."""
    rest = HELD + sum(each for each in (POSE, STIFF) if each != what and held(point, each))
    if value is not None:
        setattr(point, 'back' if what == POSE else 'amplitude', value)
    point.period = rest + (what if value is not None else 0)


def slope(point):
    """Value per frame where a handle was set by hand, else None."""
    for kind, handle in ((point.handle_right_type, point.handle_right), (point.handle_left_type, point.handle_left)):
        if kind in {'FREE', 'ALIGNED'} and handle[0] != point.co[0]:
            return (handle[1] - point.co[1]) / (handle[0] - point.co[0])
    return None


def settles(spline, point):
    return spline.settle or point.type == 'JITTER'


def samples(curve):
    """First frame and values of a sampled curve."""
    points = curve.sampled_points if curve else ()
    flat = array('f', bytes(8 * len(points)))
    if points:
        points.foreach_get('co', flat)
    return (round(flat[0]) if points else 0), flat[1::2]


def slot_path(spline, part):
    """Where the samples of a spline are: one property holds those of all, because drivers look properties up one by one. Another holds by how
    much keys that settle move the equilibria ('o'): files without such keys lack it."""
    return (OFFSETS_PATH, spline.slot) if part == 'o' else (SAMPLES_PATH, 3 * spline.slot + PARTS.index(part))


def part(owner, spline, name):
    """The sampled curve of Re x ('re'), Im x ('im'), what the spline follows ('y') or the offset that settling keys add to that ('o')."""
    return find(owner, *slot_path(spline, name))


def drop_samples(owner, spline):
    for name in (*PARTS, 'o'):
        drop(owner, *slot_path(spline, name))
    curves = list_of(owner)
    if curves is not None and not any(curve.data_path in (SAMPLES_PATH, OFFSETS_PATH) for curve in curves):
        groups = groups_of(owner)
        if SAMPLES in groups:
            groups.remove(groups[SAMPLES])


def tidy(owner):
    """Leaves nothing of an action that was made for splines only."""
    animation, action = owner.animation_data, action_of(owner)
    if action:
        action.pop(STAMP, None)
    if action and MADE in action and not list_of(owner):
        animation.action = None
        if not action.users:
            bpy.data.actions.remove(action)
        if not animation.drivers and not animation.nla_tracks:
            owner.animation_data_clear()


def groups_of(owner):
    action = action_of(owner)
    return action.layers[0].strips[0].channelbag(owner.animation_data.action_slot).groups if LAYERED else action.groups


def has_offset(owner, spline):
    """Whether drivers add the spline's offset: those of all, once one has some."""
    return len(owner.get(OFFSETS, ())) > spline.slot


def make_room(owner, spline, part='re'):
    name, length = (OFFSETS, spline.slot + 1) if part == 'o' else (SAMPLES, 3 * spline.slot + 3)
    old = list(owner.get(name, ()))
    if len(old) < length:
        owner[name] = old + [0.0] * (length - len(old))


def write(owner, spline, name, first, values):
    """Samples of a spline, one per frame and at least two."""
    path, index = slot_path(spline, name)
    make_room(owner, spline, name)
    curve = ensure(owner, path, index)
    old_first, old = samples(curve)
    if len(old) != len(values) or old_first != first:
        if old:
            list_of(owner).remove(curve)
            curve = ensure(owner, path, index)
        for frame in (first, first + 1):
            curve.keyframe_points.insert(frame, 0, options={'FAST'})
        curve.convert_to_samples(first, first + len(values))
        curve.lock = curve.hide = True
        groups = groups_of(owner)
        curve.group = groups.get(SAMPLES) or groups.new(SAMPLES)
        old = None
    flat = array('f', bytes(8 * len(values)))
    flat[0::2] = array('f', range(first, first + len(values)))
    flat[1::2] = array('f', values)
    if old is None or flat[1::2] != old:
        curve.sampled_points.foreach_set('co', flat)
        curve.update()
