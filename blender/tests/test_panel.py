"""The panel shows what a chain and a property have. Without a window a stand-in takes its rows, and knows the names that Blender knows."""
from types import SimpleNamespace
from common import *
from wiggly_blender import prop, ui

ICONS = bpy.types.UILayout.bl_rna.functions['label'].parameters['icon'].enum_items


class Layout:
    use_property_split = False

    def __init__(self, rows):
        self.rows = rows

    def part(self, **_):
        return Layout(self.rows)

    row = column = box = part

    def say(self, what, icon='NONE'):
        assert icon in ICONS, icon
        self.rows.append(what)

    def label(self, text, icon='NONE'):
        self.say(text, icon)

    def prop(self, data, name, text=None, icon='NONE', emboss=True):
        assert name in data.bl_rna.properties or data.path_resolve(name) is not None, name
        self.say(name, icon)

    def context_pointer_set(self, name, data):
        assert isinstance(data, bpy.types.bpy_struct), data

    def operator(self, name, text='', icon='NONE'):
        kind = getattr(bpy.ops.wiggly, name.split('.')[1]).get_rna_type()
        self.say(text or kind.name, icon)
        return SimpleNamespace()

    def operator_menu_enum(self, name, choice, icon='NONE'):
        assert choice in getattr(bpy.ops.wiggly, name.split('.')[1]).get_rna_type().properties, choice
        self.say(name, icon)

    def template_list(self, kind, _, data, listed, active_data, active, rows):
        assert hasattr(bpy.types, kind) and listed in data.bl_rna.properties and active in active_data.bl_rna.properties
        for each in getattr(data, listed):
            getattr(ui, kind).draw_item(None, bpy.context, self, data, each, 0, active_data, active)


def shown():
    rows = []
    panel = SimpleNamespace(layout=Layout(rows))
    panel.draw_chains = lambda *arguments: ui.WIGGLY_PT_panel.draw_chains(panel, *arguments)
    ui.WIGGLY_PT_panel.draw(panel, bpy.context)
    return rows


def panel():
    rig = fresh()
    ok('a rig without a chain is told what to select', 'Select the first bone of a chain in Pose Mode' in shown(), shown())
    add(rig, follow=False)
    rows = shown()
    ok('a chain has its settings', {'tail', 'wiggly.key', 'wiggly.preset', 'frequency', 'damping', 'wind_up', 'settle', 'lag', 'gain'} <= set(rows), rows)
    ok('those of both axes are one', rows.count('frequency') == 1, rows)
    rig.wiggly.chains[0].alike = False
    ok('until they are not', shown().count('frequency') == 2, shown())
    ok('nothing is stale', not any('Refresh' in row for row in shown()))
    bpy.context.scene.frame_start = 5
    ok('the panel offers to take other frames', any('Refresh' in row for row in shown()), shown())


def a_joined_rig():
    rig = fresh()
    add(rig, follow=False)
    rig.wiggly.chains[0].name = 'other'
    ok('bends without settings are named', any('"tail" was joined without its settings' in row for row in shown()), shown())


def a_property():
    rig = fresh()
    prop.add(rig, 'location', 0)
    rows = shown()
    ok('a property that wiggles has its settings', rows.count('frequency') == 1 and any('location' in row for row in rows), rows)


main(panel, a_joined_rig, a_property)
