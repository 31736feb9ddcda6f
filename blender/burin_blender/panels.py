"""Burin's panels in the render, view layer, material and object properties."""

import textwrap

import bpy

from . import blender_panels, freestyle_panels, line_sets, operators, sheets
from .shown import NOTHING_SHOWN

LONGEST_LINE = 48


class BurinPanel:
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    COMPAT_ENGINES = {"BURIN"}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES

    def column(self):
        """Where properties go, with their names to the left of them."""
        self.layout.use_property_split = True
        self.layout.use_property_decorate = True
        return self.layout.column()


def draws_by_panels(settings):
    """Whether the panels say how lines look: not line sets, and not a style sheet."""
    return not settings.use_line_sets and settings.sheet.source == "NONE"


def warning(layout, text, icon="ERROR"):
    """A text of several lines."""
    box = layout.column(align=True)
    for number, line in enumerate(textwrap.wrap(text, LONGEST_LINE)):
        box.label(text=line, icon=icon if number == 0 else "BLANK1")
    return box


def active_if(is_active, layout):
    """Where properties go that count only then."""
    layout.active = is_active
    return layout


def switched(layout, heading, owner, switch, name, **options):
    """A property beside the switch that has it count."""
    row = layout.row(heading=heading)
    row.prop(owner, switch, text="")
    active_if(getattr(owner, switch), row.row()).prop(owner, name, text="", **options)


class BURIN_PT_lines(BurinPanel, bpy.types.Panel):
    bl_label = "Lines"

    def draw(self, context):
        scene, settings = context.scene, context.scene.burin
        column = self.column()
        if scene.render.use_freestyle:
            box = warning(column, "Freestyle is on as well, and draws its strokes over the picture")
            box.prop(scene.render, "use_freestyle", text="Freestyle", toggle=True)
        column.prop(settings, "use_line_sets")
        if settings.use_line_sets:
            self.draw_line_sets(column, context)
            return
        column.prop(settings.sheet, "source")
        if settings.sheet.source != "NONE":
            self.draw_sheet(column, settings.sheet)
            return
        column.prop(settings, "width")
        column.prop(settings, "color")
        column.prop(settings, "side")
        column.separator()
        column.column(heading="Line Types").prop(settings, "line_types")

    def draw_line_sets(self, column, context):
        render = context.scene.render
        column.row().prop(render, "line_thickness_mode", expand=True, text="Thickness")
        if render.line_thickness_mode == "ABSOLUTE":
            column.prop(render, "line_thickness")
        for note in line_sets.not_drawn(context.scene, context.view_layer, NOTHING_SHOWN):
            warning(column, note, "INFO")

    def draw_sheet(self, column, sheet):
        column.prop(sheet, {"NAME": "name_of_sheet", "TEXT": "text", "FILE": "path"}[sheet.source])
        row = column.row(align=True)
        row.operator("burin.edit_sheet", icon="TEXT")
        row.operator("burin.read_sheet", text="", icon="FILE_REFRESH")
        row.operator("burin.reset_sheet", text="", icon="LOOP_BACK")
        for parameter in sheets.parameters(sheet):
            if parameter.name in sheet.values:
                name = parameter.name.replace("_", " ").title()
                unit = f" ({parameter.unit})" if parameter.unit else ""
                column.prop(sheet.values, f'["{bpy.utils.escape_identifier(parameter.name)}"]', text=name + unit)


class BURIN_PT_detection(BurinPanel, bpy.types.Panel):
    bl_label = "Detection"
    bl_parent_id = "BURIN_PT_lines"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and not context.scene.burin.use_line_sets

    def draw(self, context):
        settings = context.scene.burin
        column = self.column()
        column.prop(settings, "crease_angle")
        column.prop(settings, "crease_fade")
        column.prop(settings, "contours")


class BURIN_PT_hidden(BurinPanel, bpy.types.Panel):
    bl_label = "Hidden Lines"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and draws_by_panels(context.scene.burin)

    def draw(self, context):
        settings = context.scene.burin
        column = self.column()
        column.prop(settings, "hidden")
        column = active_if(settings.hidden != "NONE", column.column())
        column.prop(settings, "hidden_color")
        column.prop(settings, "use_hidden_width")
        active_if(settings.use_hidden_width, column.column()).prop(settings, "hidden_width")
        dashes = active_if(settings.hidden == "DASHED", column.column(align=True))
        dashes.prop(settings, "dash")
        dashes.prop(settings, "gap")


class BURIN_PT_surfaces(BurinPanel, bpy.types.Panel):
    bl_label = "Surfaces and Paper"

    def draw(self, context):
        scene, settings = context.scene, context.scene.burin
        column = self.column()
        view = scene.view_settings
        if view.view_transform != operators.STANDARD:
            box = warning(column, f"The view transform {view.view_transform} changes colours: white paper gets grey")
            box.operator("burin.standard_view")
        column.prop(settings, "shading")
        if settings.shading in {"PAPER", "HATCH"}:
            column.prop(settings, "paper")
        if settings.shading in {"TOON", "GOOCH", "HATCH"}:
            column.prop(settings, "use_smooth_normals")
            column.prop(settings, "use_shadows")
        column.separator()
        column.prop(scene.render, "film_transparent", text="Transparent Background")
        active_if(not scene.render.film_transparent, column.column()).prop(settings, "background")


class BURIN_PT_sampling(BurinPanel, bpy.types.Panel):
    bl_label = "Sampling"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        settings = context.scene.burin
        column = self.column()
        column.prop(settings, "samples")
        column.prop(settings, "viewport_samples")
        column.prop(settings, "filter")


class BURIN_PT_performance(BurinPanel, bpy.types.Panel):
    bl_label = "Performance"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        settings = context.scene.burin
        column = self.column()
        column.prop(settings, "threads")
        column.prop(settings, "memory_mb")


class BURIN_PT_passes(BurinPanel, bpy.types.Panel):
    bl_label = "Passes"
    bl_context = "view_layer"

    def draw(self, context):
        view_layer = context.view_layer
        column = self.column()
        own = column.column(heading="Lines", align=True)
        own.prop(view_layer.burin, "use_pass_lines")
        own.prop(view_layer.burin, "use_pass_hidden")
        data = column.column(heading="Data", align=True)
        for name in ("use_pass_z", "use_pass_normal", "use_pass_object_index", "use_pass_material_index"):
            data.prop(view_layer, name)
        data.prop(view_layer.burin, "use_pass_object_id")
        data.prop(view_layer.burin, "use_pass_material_id")
        mattes = column.column(heading="Cryptomatte", align=True)
        mattes.prop(view_layer, "use_pass_cryptomatte_object", text="Object")
        mattes.prop(view_layer, "use_pass_cryptomatte_material", text="Material")
        mattes.prop(view_layer, "pass_cryptomatte_depth", text="Levels")


class BURIN_PT_material(BurinPanel, bpy.types.Panel):
    bl_label = "Lines and Surface"
    bl_context = "material"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.material is not None and not context.material.grease_pencil

    def draw(self, context):
        material, settings = context.material, context.scene.burin
        column = self.column()
        switched(column, "Line Color", material.burin, "use_line_color", "line_color")
        if material.burin.use_line_color and not draws_by_panels(settings):
            warning(column, "Line sets and style sheets have colours of their own", "INFO")
        column.prop(material, "diffuse_color", text="Viewport Color")


class BURIN_PT_object(BurinPanel, bpy.types.Panel):
    bl_label = "Lines"
    bl_context = "object"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.object is not None and hasattr(context.object, "lineart")

    def draw(self, context):
        settings = context.object.lineart
        column = self.column()
        column.prop(settings, "usage")
        switched(column, "Crease Angle", settings, "use_crease_override", "crease_threshold", slider=True)


CLASSES = (BURIN_PT_lines, BURIN_PT_detection, BURIN_PT_hidden, BURIN_PT_surfaces, BURIN_PT_sampling,
           BURIN_PT_performance, BURIN_PT_passes, BURIN_PT_material, BURIN_PT_object)


def register():
    operators.register()
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    freestyle_panels.register()
    blender_panels.register()


def unregister():
    blender_panels.unregister()
    freestyle_panels.unregister()
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
    operators.unregister()
