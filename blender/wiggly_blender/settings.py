"""What is stored with an ID: its splines, and an armature's chains."""
import bpy
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

FARTHEST = 1_048_574  # Blender's last frame
# Drivers of a library override cannot differ from the library's, so what they are written from has no override.
SAME = {'LIBRARY_OVERRIDABLE'}
MANY = {'LIBRARY_OVERRIDABLE', 'USE_INSERTION'}


def changed(name):
    def update(self, context):
        from . import chain
        chain.settings_changed(self, name)
    return update


def of(owner):
    """The settings of an ID, or None: reading them where there are none would make them."""
    stored = owner.bl_system_properties_get() if hasattr(owner, 'bl_system_properties_get') else owner
    return owner.wiggly if stored and 'wiggly' in stored else None


class Spline(bpy.types.PropertyGroup):
    """A curve through keyframes that swings between them."""
    frequency: FloatProperty(name='Frequency', description='Swings per second', default=1.5, min=0, soft_max=10, override=SAME, update=changed('frequency'))
    damping: FloatProperty(name='Damping', description='0 swings forever, 1 does not swing at all', default=0.12, min=0, max=1, override=SAME, update=changed('damping'))
    bandwidth: FloatProperty(name='Bandwidth', description='How far the frequency may shift to meet keys, as a fraction of it', default=0.1,
                             min=0, max=1, override=SAME, update=changed('bandwidth'))
    calm: FloatProperty(name='Calm', description='How much a swing at the start costs. Less is livelier', default=1, min=0, max=1, override=SAME, update=changed('calm'))
    wind_up: FloatProperty(name='Wind-up', description='How long before a key the motion is pushed, in periods; after it, it swings freely. 0: the whole '
                           'curve is shaped at once', min=0, max=100, soft_max=2, override=SAME, update=changed('wind_up'))
    settle: BoolProperty(name='Keys Settle', description='After each key the motion swings about its value and stays there. To let a single key settle, '
                         'make it a Jitter: press R in the Dope Sheet', override=SAME, update=changed('settle'))
    mode: EnumProperty(name='Kind', default='complex', override=SAME, items=(
        ('complex', 'Wiggly', 'Swings at a frequency that may shift'), ('real', 'Spring', 'Swings as a damped spring'),
        ('cubic', 'Cubic', 'Does not swing')))
    more: StringProperty(override=SAME)  # JSON: what else a scene of wiggly said
    start: EnumProperty(name='Start', default='rest', override=SAME, update=changed('start'), items=(
        ('free', 'Free', 'Starts in mid-swing'), ('rest', 'Rest', 'Starts at rest on the first frame'),
        ('loop', 'Loop', 'The last frame repeats the first')))
    equilibrium: FloatProperty(name='Equilibrium', description='The value it swings about', update=changed('equilibrium'))
    follow: EnumProperty(name='Follow', default='none', override=SAME, items=(
        ('none', 'Nothing', 'Swings about a number'), ('across', 'Across', 'Follows the motion across the chain'),
        ('up', 'Up', 'Follows the motion up and down'), ('turn', 'Turn', 'Follows the turning')))
    joint: StringProperty(name='Bone', description='The bone it follows; empty is the last one of the chain', override=SAME)
    chain: StringProperty(override=SAME)  # whose direction counts; empty: as of one that points to the front
    follow_gain: FloatProperty(name='Strength', default=1, override=SAME)
    first: IntProperty(name='First Frame', description='Where the motion starts', min=-FARTHEST, max=FARTHEST, override=SAME, update=changed('first'))
    last: IntProperty(name='Last', description='Where the motion ends. Of a loop, this frame repeats the first', min=-FARTHEST, max=FARTHEST, override=SAME, update=changed('last'))
    slot: IntProperty(override=SAME)  # of its samples
    path: StringProperty(override=SAME)  # of a property that it moves
    before: StringProperty()  # its value before that, to the last digit
    made: BoolProperty()  # its keys were made for the spline


class Channel(bpy.types.PropertyGroup):
    """How a spline bends the bones of a chain."""
    spline: StringProperty()
    axis: EnumProperty(name='Axis', default='side', items=(
        ('side', 'Side', 'Turns about world up'), ('up', 'Up', 'Lifts'), ('twist', 'Twist', 'Turns about the chain')))
    of: EnumProperty(default='total', items=(('total', 'Total', ''), ('displacement', 'Displacement', '')))
    lag: FloatProperty(name='Lag', description='Degrees by which each bone lags behind the one before', default=15, update=changed('lag'))
    gain: FloatProperty(name='Gain', description='Degrees that each bone turns for a value of 1', default=10, update=changed('gain'))
    ramps: StringProperty()  # JSON: lag and gain that are not plain numbers


class Chain(bpy.types.PropertyGroup):
    """A row of bones that splines bend."""
    channels: CollectionProperty(type=Channel)
    alike: BoolProperty(name='Same for All Axes', description='Settings of one axis are those of the others', default=True)
    mute: BoolProperty(name='Mute', description='Shows the action alone', update=changed('mute'))
    turn: FloatProperty(name='Turn', description='Turns the axes about the chain, in degrees', update=changed('turn'))
    mirror: BoolProperty(name='Mirror', description='Bends to the other side', update=changed('mirror'))


class Wiggly(bpy.types.PropertyGroup):
    splines: CollectionProperty(type=Spline, override=MANY)
    chains: CollectionProperty(type=Chain, override=MANY)
    active: IntProperty(override=SAME)


classes = (Spline, Channel, Chain, Wiggly)


def register():
    for each in classes:
        bpy.utils.register_class(each)
    bpy.types.ID.wiggly = PointerProperty(type=Wiggly, override=SAME)


def unregister():
    del bpy.types.ID.wiggly
    for each in reversed(classes):
        bpy.utils.unregister_class(each)
