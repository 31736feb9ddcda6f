"""Buttons of the panels."""

import bpy

from . import sheets

STANDARD = "Standard"


class BURIN_OT_standard_view(bpy.types.Operator):
    """Show colours as they are: Filmic, Blender's default, turns white paper grey"""
    bl_idname = "burin.standard_view"
    bl_label = "Use Standard View Transform"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        view = context.scene.view_settings
        view.view_transform = STANDARD
        view.look = "None"
        return {"FINISHED"}


class BURIN_OT_edit_sheet(bpy.types.Operator):
    """Copy the style sheet into a text of this file, to be changed in a text editor"""
    bl_idname = "burin.edit_sheet"
    bl_label = "Edit Sheet"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        settings = context.scene.burin.sheet
        if settings.source != "TEXT":
            text = sheets.text_of(settings)
            if text is None:
                self.report({"ERROR"}, "Burin: the text of the sheet is not known; the program burin tells it, and it "
                            "is not found (see the add-on's preferences)")
                return {"CANCELLED"}
            name = settings.name_of_sheet if settings.source == "NAME" else bpy.path.basename(settings.path)
            datablock = bpy.data.texts.new(name if name.endswith(".toml") else name + ".toml")
            datablock.write(text)
            datablock.cursor_set(0)
            kept = {name: sheets.plain(value) for name, value in settings.values.items()}
            settings.text = datablock
            settings.source = "TEXT"
            for parameter, value in kept.items():
                if parameter in settings.values:
                    settings.values[parameter] = value
        show_in_editor(context, settings.text)
        return {"FINISHED"}


class ReadsParameters:
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        sheets.read_parameters(context.scene.burin.sheet, self.keep)
        return {"FINISHED"}


class BURIN_OT_read_sheet(ReadsParameters, bpy.types.Operator):
    """Look at the style sheet again: it may have other parameters now"""
    bl_idname = "burin.read_sheet"
    bl_label = "Update Parameters"
    keep = True


class BURIN_OT_reset_sheet(ReadsParameters, bpy.types.Operator):
    """Give all parameters the values of the style sheet"""
    bl_idname = "burin.reset_sheet"
    bl_label = "Reset Parameters"
    keep = False


def show_in_editor(context, text):
    """Shows a text in the first text editor that is open, if one is."""
    if context.screen is None or text is None:
        return
    for area in context.screen.areas:
        if area.type == "TEXT_EDITOR":
            area.spaces.active.text = text
            return


CLASSES = (BURIN_OT_standard_view, BURIN_OT_edit_sheet, BURIN_OT_read_sheet, BURIN_OT_reset_sheet)
register, unregister = bpy.utils.register_classes_factory(CLASSES)
