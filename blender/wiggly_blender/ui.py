"""Operators, the panel, and menus."""
import os
import bpy
from bpy.props import BoolProperty, EnumProperty, StringProperty
from bpy_extras.io_utils import ExportHelper, ImportHelper
from . import bake, base, chain as chains, curves, exchange, prop, settings, solve

PRESETS = {'tail': ('Tail', 1.5, 0.12), 'ear': ('Ear', 3, 0.25), 'hair': ('Hair', 2, 0.2), 'rope': ('Rope', 1, 0.05),
           'antenna': ('Antenna', 5, 0.06), 'belly': ('Belly', 3, 0.35)}


class Operator(bpy.types.Operator):
    """Reports what run() raises as one sentence."""
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context):
        return context.object and context.object.type == 'ARMATURE' and context.object.is_editable

    def execute(self, context):
        try:
            self.run(context, context.object)
        except (ValueError, OSError) as problem:
            self.report({'ERROR'}, str(problem))
            return {'CANCELLED'}
        solve.solve_all(context.scene)
        return {'FINISHED'}


def active(owner):
    wiggly = settings.of(owner)
    if not wiggly or not wiggly.chains:
        raise ValueError(f'"{owner.name}" has no chain: select its first bone and choose Add Wiggle')
    return wiggly.chains[min(wiggly.active, len(wiggly.chains) - 1)]


class WIGGLY_OT_add(Operator):
    """Makes the selected bones swing. Select the first bone of a chain, or all its bones"""
    bl_idname, bl_label = 'wiggly.add', 'Add Wiggle'
    follow: BoolProperty(name='Follow Through', description='Lag behind the motion of the body and overshoot', default=True)
    loop: BoolProperty(name='Loop', description='The last frame repeats the first')

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.mode == 'POSE'

    def run(self, context, owner):
        action = curves.action_of(owner)
        loop = self.loop or bool(action and action.use_frame_range and action.use_cyclic)
        rows = chains.of_selection(context)
        for bones in rows:
            chains.check(owner, bones)
        for bones in rows:
            chains.make(owner, bones, self.follow, loop)
        curves.list_of(owner, make=True)
        base.refresh(context, owner)


class WIGGLY_OT_remove(Operator):
    """Takes the wiggle away. Bones and their keyframes stay as they were"""
    bl_idname, bl_label = 'wiggly.remove', 'Remove Wiggle'

    def run(self, context, owner):
        strays = chains.strays(owner)
        for each in strays:
            chains.check_local(owner)
            chains.unbend(owner, each)
        if not strays:
            chains.remove(owner, active(owner))


class WIGGLY_OT_refresh(Operator):
    """Reads the motion of the body again"""
    bl_idname, bl_label = 'wiggly.refresh', 'Refresh'

    def run(self, context, owner):
        active(owner)
        base.refresh(context, owner)


class WIGGLY_OT_key(Operator):
    """Sets keys of the active chain at this frame, as the chain is now. Edit them in the Graph Editor or Dope Sheet"""
    bl_idname, bl_label = 'wiggly.key', 'Insert Key'
    kind: EnumProperty(name='Kind', items=(
        ('KEYFRAME', 'Value', 'The first bone is where the key says'), ('EXTREME', 'Pose', 'All bones are where they are now'),
        ('MOVING_HOLD', 'Still', 'Comes to rest, and starts from rest'),
        ('JITTER', 'Settle', 'Overshoots, swings about the value and stays there')))

    def run(self, context, owner):
        frame = round(context.scene.frame_current_final)  # that of the action, if time is stretched
        for channel in active(owner).channels:
            solve.insert(owner, owner.wiggly.splines[channel.spline], frame, self.kind)


class WIGGLY_OT_bake(Operator):
    """Makes keyframes of the active chain in a copy of the action, one a frame, and mutes the chain. The action stays"""
    bl_idname, bl_label = 'wiggly.bake', 'Bake'

    def run(self, context, owner):
        bake.bake(context, owner, active(owner))


class Property(Operator):
    @classmethod
    def poll(cls, context):
        return getattr(context, 'property', None) and context.property[0].is_editable

    def run(self, context, _):
        owner, path, index = context.property
        self.change(owner, path, max(index, 0))


class WIGGLY_OT_property(Property):
    """Lets this property swing through its keyframes"""
    bl_idname, bl_label = 'wiggly.property', 'Wiggle This Property'
    change = staticmethod(prop.add)


class WIGGLY_OT_property_remove(Property):
    """Gives this property its keyframes back"""
    bl_idname, bl_label = 'wiggly.property_remove', 'Remove Wiggle'
    change = staticmethod(prop.remove)
    spline: StringProperty()

    @classmethod
    def poll(cls, context):
        return getattr(context, 'wiggly_owner', None) or super().poll(context)

    def run(self, context, _):
        if self.spline:  # of the panel: the property may be gone
            prop.give_back(context.wiggly_owner, context.wiggly_owner.wiggly.splines[self.spline])
        else:
            super().run(context, None)


class WIGGLY_OT_property_bake(Property):
    """Makes a keyframe of this property at every frame, in a copy of the action"""
    bl_idname, bl_label = 'wiggly.property_bake', 'Bake Wiggle'
    change = staticmethod(prop.make_keys)


class WIGGLY_OT_shapes(Operator):
    """Moves pairs of shape keys, such as up.re and up.im of a soft character of wiggly, by a spline each"""
    bl_idname, bl_label = 'wiggly.shapes', 'Wiggle Shape Keys'
    remove: BoolProperty()

    @classmethod
    def poll(cls, context):
        return context.object and getattr(context.object.data, 'shape_keys', None)

    def run(self, context, owner):
        keys, found = owner.data.shape_keys, owner.data.get('wiggly', {}).get('coordinates', ())
        if self.remove:
            prop.remove_pairs(keys)
        else:
            prop.add_pairs(keys, {each['name']: dict(each) for each in found})


class WIGGLY_OT_preset(Operator):
    """Sets frequency and damping of the active chain"""
    bl_idname, bl_label = 'wiggly.preset', 'Preset'
    preset: EnumProperty(name='Preset', items=[(key, name, f'{f:g} Hz, damping {d:g}') for key, (name, f, d) in PRESETS.items()])

    def run(self, context, owner):
        for channel in active(owner).channels:
            spline = owner.wiggly.splines[channel.spline]
            spline.frequency, spline.damping = PRESETS[self.preset][1:]


class WIGGLY_OT_import(Operator, ImportHelper):
    """Opens a scene of wiggly with its characters"""
    bl_idname, bl_label, filename_ext = 'wiggly.import_scene', 'Wiggly Scene (.json)', '.json'
    filter_glob: StringProperty(default='*.json', options={'HIDDEN'})

    @classmethod
    def poll(cls, context):
        return context.mode == 'OBJECT'

    def run(self, context, _):
        left = exchange.read(context, bpy.path.abspath(self.filepath))
        if left:
            self.report({'WARNING'}, 'Left out: ' + ', '.join(left))


class WIGGLY_OT_export(Operator, ExportHelper):
    """Writes the active armature as a scene of wiggly, and everything as a .glb beside it"""
    bl_idname, bl_label, filename_ext = 'wiggly.export_scene', 'Wiggly Scene (.json, .glb)', '.json'
    bl_options = {'REGISTER'}
    overwrite: BoolProperty(name='Overwrite Character', description='Replaces the .glb that is there already', options={'SKIP_SAVE'})

    def draw(self, _):
        model = exchange.model_of(self.filepath)
        if os.path.lexists(model):
            self.layout.label(text=f'{os.path.basename(model)} is there already')
            self.layout.prop(self, 'overwrite')

    def run(self, context, owner):
        active(owner)
        exchange.write(context, owner, bpy.path.abspath(self.filepath), self.overwrite)


class WIGGLY_UL_chains(bpy.types.UIList):
    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index=0, flag=0):
        layout.label(text=item.name, icon='CON_TRANSFORM')
        layout.prop(item, 'mute', text='', emboss=False, icon='HIDE_ON' if item.mute else 'HIDE_OFF')


def draw_spline(layout, owner, spline, title):
    problem = solve.problems.get(solve.key_of(owner, spline))
    if problem:
        layout.label(text=problem, icon='ERROR')
    column = layout.column(align=True)
    if title:
        column.label(text=title)
    for name in ('frequency', 'damping', 'wind_up', 'settle', 'bandwidth', 'calm', 'start', 'first', 'last'):
        column.prop(spline, name)


class WIGGLY_PT_panel(bpy.types.Panel):
    bl_label, bl_category, bl_space_type, bl_region_type = 'Wiggle', 'Wiggle', 'VIEW_3D', 'UI'

    @classmethod
    def poll(cls, context):
        return context.object

    def draw(self, context):
        owner = context.object
        if owner.type == 'ARMATURE':
            self.draw_chains(context, self.layout, owner)
        data = owner.data
        keys = getattr(data, 'shape_keys', None)
        if keys and prop.pairs_of(keys):
            bound = settings.of(keys)
            self.layout.operator('wiggly.shapes', text='Remove Wiggle' if bound else 'Wiggle Shape Keys').remove = bool(bound)
        for each in (owner, data, keys, owner.active_material):
            wiggly = each and settings.of(each)
            for spline in wiggly.splines if wiggly else ():
                if spline.path:
                    box = self.layout.box()
                    box.use_property_split = True
                    row = box.row(align=True)
                    row.context_pointer_set('wiggly_owner', each)
                    if spline.name in each:
                        row.prop(each, curves.path_of(spline.name), text='Key')
                    row.operator('wiggly.property_remove', text='', icon='X').spline = spline.name
                    draw_spline(box, each, spline, f'{each.name}: {spline.name}')

    def draw_chains(self, context, layout, owner):
        wiggly = settings.of(owner)
        row = layout.row(align=True)
        row.operator('wiggly.add', icon='ADD')
        row.operator('wiggly.remove', text='', icon='REMOVE')
        for each in chains.strays(owner):
            layout.label(text=f'"{each.name}" was joined without its settings: remove it, then add it', icon='ERROR')
        if not wiggly or not wiggly.chains:
            layout.label(text='Select the first bone of a chain in Pose Mode')
            return
        layout.template_list('WIGGLY_UL_chains', '', wiggly, 'chains', wiggly, 'active', rows=2)
        chain = active(owner)
        if base.stale(owner, context.scene):
            layout.operator('wiggly.refresh', text='Body or Frames Have Changed: Refresh', icon='ERROR')
        layout.operator_menu_enum('wiggly.key', 'kind', icon='KEY_HLT')
        layout.operator_menu_enum('wiggly.preset', 'preset', icon='PRESET')
        layout.operator('wiggly.bake', icon='RENDER_ANIMATION')
        layout.prop(chain, 'alike')
        layout.use_property_split = True
        for channel in list(chain.channels)[:1 if chain.alike else None]:
            if channel.spline in wiggly.splines:
                draw_spline(layout, owner, wiggly.splines[channel.spline], '' if chain.alike else channel.spline)
                layout.prop(channel, 'lag')
                layout.prop(channel, 'gain')


def button_menu(self, context):
    if getattr(context, 'property', None):
        owner, path, index = context.property
        self.layout.separator()
        wiggles = prop.found(owner, path, max(index, 0))
        for name in ('wiggly.property_remove', 'wiggly.property_bake') if wiggles else ('wiggly.property',):
            self.layout.operator(name)


def pose_menu(self, context):
    self.layout.separator()
    self.layout.operator('wiggly.add')


classes = (WIGGLY_OT_add, WIGGLY_OT_remove, WIGGLY_OT_refresh, WIGGLY_OT_key, WIGGLY_OT_preset, WIGGLY_OT_bake, WIGGLY_OT_property,
           WIGGLY_OT_property_remove, WIGGLY_OT_property_bake, WIGGLY_OT_shapes, WIGGLY_OT_import, WIGGLY_OT_export, WIGGLY_UL_chains, WIGGLY_PT_panel)


menus = (('VIEW3D_MT_pose', pose_menu), ('UI_MT_button_context_menu', button_menu),
         ('TOPBAR_MT_file_import', lambda self, context: self.layout.operator('wiggly.import_scene')),
         ('TOPBAR_MT_file_export', lambda self, context: self.layout.operator('wiggly.export_scene')))


def register():
    for each in classes:
        bpy.utils.register_class(each)
    for menu, draw in menus:
        getattr(bpy.types, menu).append(draw)


def unregister():
    for menu, draw in menus:
        getattr(bpy.types, menu).remove(draw)
    for each in reversed(classes):
        bpy.utils.unregister_class(each)
