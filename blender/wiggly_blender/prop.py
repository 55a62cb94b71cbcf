"""Any property that has one number: its own keyframes become the knots, and a driver moves it."""
import json
from operator import getitem, setitem
import bpy
from . import bake, chain as chains, curves, settings, solve


def found(owner, path, index):
    """The spline that moves a property, by its driver: names of what has it may change."""
    wiggly = settings.of(owner)
    driver = owner.animation_data.drivers.find(path, index=index) if wiggly and owner.animation_data else None
    return next((spline for spline in wiggly.splines if spline.path and driver in chains.readers(owner, spline)), None) if driver else None


def holder(owner, path):
    """What has the property, its name, and how it is read and written: custom ones by item, to the last digit."""
    if path.endswith('"]'):
        at = path.rindex('["')
        return owner.path_resolve(path[:at]) if at else owner, bpy.utils.unescape_identifier(path[at + 2:-2]), getitem, setitem
    head, _, name = path.rpartition('.')
    return owner.path_resolve(head) if head else owner, name, getattr, setattr


def add(owner, path, index):
    """`index` is that of an array, else 0."""
    chains.check_local(owner)
    if not any(owner == each for each in solve.possible()):
        raise ValueError(f'"{path}" belongs to a {owner.id_type.lower()}, which cannot wiggle')
    target, name, get, _ = holder(owner, path)
    value = get(target, name)
    array = hasattr(value, '__len__') and not isinstance(value, str)
    value = value[index] if array else value
    if not isinstance(value, float):
        raise ValueError(f'"{path}" is not a decimal number')
    if owner.animation_data and owner.animation_data.drivers.find(path, index=index):
        raise ValueError(f'"{path}" has a driver')
    if path.startswith('key_blocks['):
        name = path.split('"')[1]
    spline = chains.add_spline(owner, chains.unique(f'wiggle {name}' + (f' {"XYZW"[index]}' if array and index < 4 else ''), set(owner.keys())))
    spline.path, spline.before, spline.equilibrium, spline.start = path, repr(value), value, 'free'
    curve = curves.find(owner, path, index)
    if curve:
        curve.data_path, curve.array_index = curves.path_of(spline.name), 0
        curve.update()
    else:
        curves.list_of(owner, make=True)
        solve.insert(owner, spline, bpy.context.scene.frame_current, 'KEYFRAME')
    spline.made = not curve
    chains.drive_by(owner, path, index if array else -1, [(spline, 're', 1.0)], spline.equilibrium)
    return spline


def wiggling(owner, path, index):
    spline = found(owner, path, index)
    if not spline:
        raise ValueError(f'"{path}" does not wiggle')
    return spline


def remove(owner, path, index):
    give_back(owner, wiggling(owner, path, index))


def give_back(owner, spline):
    """Leaves what a spline moves as it was before; it may be gone."""
    chains.check_local(owner)
    sliders, before = json.loads(spline.more or '{}').get('sliders', {}), float(spline.before)
    for driver in chains.readers(owner, spline):
        path, index = driver.data_path, driver.array_index
        owner.animation_data.drivers.remove(driver)
        curve = curves.find(owner, curves.path_of(spline.name))
        if curve and not spline.made:
            curve.data_path, curve.array_index = path, index
        try:
            target, name, get, put = holder(owner, path)
            value = get(target, name)
        except (ValueError, KeyError, AttributeError):
            continue
        if hasattr(value, '__len__'):
            value[index] = before
        else:
            put(target, name, before)
        if getattr(target, 'name', '') in sliders:
            target.slider_min, target.slider_max = sliders[target.name]
    chains.remove_spline(owner, spline.name)


def make_keys(owner, path, index):
    """A copy of the action in which the property has a key at every frame of the scene, and wiggles no more."""
    scene, spline = bpy.context.scene, wiggling(owner, path, index)
    frames, curve = range(scene.frame_start, scene.frame_end + 1), curves.part(owner, spline, 're')
    if not curve:
        raise ValueError(f'"{path}" has no keys to bake')
    values = [curve.evaluate(frame) + spline.equilibrium for frame in frames]
    bake.copy_action(owner)
    give_back(owner, spline)
    bake.write(owner, path, index, frames, values)


# --- complex shapes: pairs of shape keys such as up.re and up.im, perhaps with curves, up.sq, up.re2 and up.im2, and with mirrored ones, up.-re and
# up.-im, because values may be kept ≥ 0

PAIRS = 'key_blocks'  # as the path of a spline that moves a pair; `joint` is the pair's name


CURVES = {'sq': 'v1*v1+v2*v2', 're2': 'v1*v1-v2*v2', 'im2': '-2*v1*v2'}  # |z|², Re z² and −Im z²


def pairs_of(keys):
    return [block.name[:-3] for block in keys.key_blocks if block.name.endswith('.re') and block.name[:-3] + '.im' in keys.key_blocks]


def parts_of(keys, name):
    """Shape keys of a pair: part of the spline or its curves, sign, key, whether the other sign has its own."""
    for part in ('re', 'im', *(CURVES if all(f'{name}.{part}' in keys.key_blocks for part in CURVES) else ())):
        plus, minus = keys.key_blocks[f'{name}.{part}'], keys.key_blocks.get(f'{name}.-{part}')
        yield part, 1, plus, bool(minus)
        if minus:
            yield part, -1, minus, True


def curve_by(keys, path, spline, part, known):
    """Drives a curve's key: beyond `most` it grows linearly. Keys of an export are `scale` times as large as those of a character's own file."""
    scale, most = known.get('scale', 1), known.get('most', 0)
    straight = f'*(1-pow(max(0,1-{most / scale:.9g}/max(1e-9,sqrt(v1*v1+v2*v2))),2))' if most else ''
    driver = chains.drive_by(keys, path, -1, [(spline, 're', 1), (spline, 'im', 1)])
    driver.expression = f'{scale:.9g}*({CURVES[part]}){straight}'
    return driver


def add_pairs(keys, measured=()):
    """A spline for each pair; `measured` is what wiggly found, by name: frequency, damping."""
    if not pairs_of(keys):
        raise ValueError('Expected shape keys in pairs, such as "up.re" and "up.im"')
    driven = [driver.data_path for driver in keys.animation_data.drivers] if keys.animation_data and not settings.of(keys) else ()
    for name in pairs_of(keys):
        for _, _, block, _ in parts_of(keys, name):
            if block.path_from_id('value') in driven:
                raise ValueError(f'"{block.name}" has a driver')
    for name in pairs_of(keys):
        if any(spline.joint == name for spline in keys.wiggly.splines):
            continue
        spline = chains.add_spline(keys, chains.unique(f'wiggle {name}', set(keys.keys())))
        spline.path, spline.joint, spline.start, spline.before, spline.made = PAIRS, name, 'free', '0', True
        known = dict(measured).get(name, {})
        spline.frequency, spline.damping = known.get('frequency', spline.frequency), known.get('damping', spline.damping)
        sliders = {}
        for part, sign, block, halved in parts_of(keys, name):
            path = block.path_from_id('value')
            driver = curve_by(keys, path, spline, part, known) if part in CURVES else chains.drive_by(keys, path, -1, [(spline, part, 1)])
            if sign < 0:
                driver.expression = f'-({driver.expression})'
            if halved:
                driver.expression = f'max(0,{driver.expression})'
            sliders[block.name] = block.slider_min, block.slider_max
            block.slider_min, block.slider_max = 0 if halved else -10, 10
        spline.more = json.dumps({'sliders': sliders})
        curves.list_of(keys, make=True)


def remove_pairs(keys):
    for name in [spline.name for spline in keys.wiggly.splines if spline.path == PAIRS]:
        give_back(keys, keys.wiggly.splines[name])
