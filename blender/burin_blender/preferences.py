"""The add-on's preferences: where Burin is."""

import bpy

from . import core


def tell_core(preferences, context=None):
    core.set_preference(preferences.program)


class BurinPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: bpy.props.StringProperty(
        name="Program or Library", subtype="FILE_PATH", update=tell_core,
        description="Where the program burin, or libburin.so.0, is. Empty: $BURIN, the program in PATH, the library "
                    "beside the add-on, or that of the system. Counts until Blender is started again once it is loaded")

    def draw(self, context):
        self.layout.prop(self, "program")
        try:
            core.burin()
        except core.LibraryError as error:
            self.layout.label(text=str(error), icon="ERROR")


def register():
    bpy.utils.register_class(BurinPreferences)
    addon = bpy.context.preferences.addons.get(__package__)
    if addon is not None and addon.preferences is not None:
        tell_core(addon.preferences)


def unregister():
    bpy.utils.unregister_class(BurinPreferences)
