"""What a user sets: properties of scenes, view layers and materials, and the settings that follow.

What objects do with lines is said by Line Art's own settings of objects (object_rules.py)."""

import math

import bpy
from bpy.props import (BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, PointerProperty)

from . import panel_look, sheets
from .sheet_text import color_list

LINE_TYPES = (
    ("SILHOUETTE", "Silhouette", "Where a surface turns away from the eye"),
    ("BORDER", "Border", "Edges of open surfaces"),
    ("CREASE", "Crease", "Where two faces meet at more than the crease angle"),
    ("INTERSECTION", "Intersection", "Where surfaces pass through each other"),
    ("OBJECT", "Contact", "Where surfaces of different objects touch"),
    ("MATERIAL", "Material Boundary", "Where surfaces of different materials touch"),
    ("MARK", "Edge Mark", "Edges with a Freestyle edge mark"),
    ("POLYGON", "Wireframe", "Every edge between two faces"),
)
SURFACES = (
    ("PAPER", "Paper", "One colour"),
    ("LAMBERT", "Lambert", "Materials under a light at the eye"),
    ("FLAT", "Flat", "The colour of the material"),
    ("TOON", "Toon", "Tones in steps"),
    ("GOOCH", "Gooch", "From cool to warm"),
    ("HATCH", "Hatch", "Lines as dense as a tone needs"),
    ("NONE", "None", "Invisible, but still hiding what is behind"),
)
SAMPLES = (
    ("AUTO", "Automatic", "2, and 4 for lines on one side; lines thinner than samples are found as well"),
    ("2", "2 (Preview)", "2 by 2 samples in a pixel, without what lies between samples"),
    ("4", "4", "4 by 4 samples in a pixel"),
    ("8", "8", "8 by 8 samples in a pixel"),
)


def color_property(name, value, description, **options):
    return FloatVectorProperty(name=name, subtype="COLOR", size=3, min=0, max=1, default=value, description=description,
                               **options)


def material_changed(settings, context):
    """Has Blender evaluate the material again, also where a script has changed it."""
    settings.id_data.update_tag()


class BurinSceneSettings(bpy.types.PropertyGroup):
    """scene.burin"""

    use_line_sets: BoolProperty(
        name="Draw Freestyle Line Sets", default=False,
        description="Draw the line sets of the view layers, with their line styles; Freestyle itself stays off")
    sheet: PointerProperty(type=sheets.BurinSheetSettings)

    line_types: EnumProperty(
        name="Line Types", items=LINE_TYPES, options={"ENUM_FLAG"},
        default={"SILHOUETTE", "BORDER", "CREASE", "INTERSECTION", "OBJECT"})
    width: FloatProperty(name="Thickness", subtype="PIXEL", default=1.5, min=0.01, max=1024, soft_max=20,
                         description="Full width of lines")
    color: color_property("Color", (0, 0, 0), "Of lines whose material has no line colour of its own")
    crease_angle: FloatProperty(
        name="Crease Angle", subtype="ANGLE", default=math.radians(40), min=0, max=math.pi,
        description="Angle between the normals of two faces above which their edge is a line. 0 is flat: it is 180° "
        "less the crease angle of Freestyle and Line Art")
    crease_fade: FloatProperty(
        name="Fade In Over", subtype="ANGLE", default=0, min=0, max=math.pi / 2,
        description="Creases become stronger over so many degrees above the crease angle, so that they do not pop up "
        "in animations")
    contours: EnumProperty(
        name="Contours", items=(("MESH", "Edges of the Mesh", "Along the edges between faces"),
                                ("SMOOTH", "Smooth", "Along interpolated normals, across faces")),
        description="Where a smooth surface turns away")
    side: EnumProperty(
        name="Position", items=(("BOTH", "Center", "On both sides"), ("INSIDE", "Inside", "Only on the nearer surface"),
                                ("OUTSIDE", "Outside", "Only beside it")),
        description="On which side of silhouettes and borders ink lies")

    hidden: EnumProperty(
        name="Style", items=(("NONE", "None", "Hidden lines are not drawn"), ("SOLID", "Solid", ""),
                             ("DASHED", "Dashed", "")))
    use_hidden_width: BoolProperty(name="Own Thickness", default=False)
    hidden_width: FloatProperty(name="Thickness", subtype="PIXEL", default=1, min=0.01, max=1024, soft_max=20)
    hidden_color: color_property("Color", (0.215861, 0.215861, 0.215861), "Of hidden lines")
    dash: FloatProperty(name="Dash", subtype="PIXEL", default=6, min=0.1, max=65535, soft_max=50)
    gap: FloatProperty(name="Gap", subtype="PIXEL", default=4.5, min=0.1, max=65535, soft_max=50)

    shading: EnumProperty(name="Surfaces", items=SURFACES, description="How surfaces are filled")
    paper: color_property("Surface Color", (1, 1, 1), "Of paper surfaces, and between the lines of hatching")
    background: color_property("Background", (1, 1, 1), "Behind everything, unless the film is transparent")
    use_smooth_normals: BoolProperty(name="Smooth Normals", default=False,
                                     description="Normals are interpolated, but not across creases")
    use_shadows: BoolProperty(name="Shadows", default=False, description="The light casts shadows")

    samples: EnumProperty(name="Render", items=SAMPLES, description="Samples along either axis of a pixel at which is "
                          "decided what is seen; lines are antialiased finely whatever the samples")
    viewport_samples: EnumProperty(name="Viewport", items=SAMPLES, description="When the view has come to rest")
    filter: EnumProperty(
        name="Pixel Filter", items=(("BOX", "Box", "Its square"), ("GAUSSIAN", "Gaussian", "Softer"),
                                    ("MITCHELL", "Mitchell", "Sharper")),
        description="What a pixel sees of lines")
    threads: IntProperty(name="Threads", default=0, min=0, max=1024, description="0: as many as there are cores")
    memory_mb: IntProperty(name="Memory Cap", default=0, min=0, max=1 << 20, description="MB that drawing may take "
                           "beyond the scene and the picture; 0: no cap")


class BurinViewLayerSettings(bpy.types.PropertyGroup):
    """view_layer.burin"""

    use_pass_lines: BoolProperty(name="Lines", default=True, description="Visible lines alone, with alpha")
    use_pass_hidden: BoolProperty(name="Hidden Lines", default=False, description="Hidden lines alone, with alpha")
    use_pass_object_id: BoolProperty(name="Object Numbers", default=False)
    use_pass_material_id: BoolProperty(name="Material Numbers", default=False)


class BurinMaterialSettings(bpy.types.PropertyGroup):
    """material.burin"""

    use_line_color: BoolProperty(name="Line Color", default=False, update=material_changed,
                                 description="Lines on surfaces of this material have a colour of their own")
    line_color: color_property("Line Color", (0, 0, 0), "Of lines on surfaces of this material",
                               update=material_changed)


def samples_of(choice):
    """An item of SAMPLES as `samples` of burin_view."""
    return 0 if choice == "AUTO" else int(choice)


def surface_lines(settings):
    """Keys that a shading does not read are errors."""
    lines = [f"surfaces.shading={settings.shading.lower()}"]
    if settings.shading in {"PAPER", "HATCH"}:
        lines.append(f"surfaces.paper={color_list(settings.paper)}")
    if settings.shading in {"TOON", "GOOCH", "HATCH"}:
        lines += [f"surfaces.normals={'smooth' if settings.use_smooth_normals else 'flat'}",
                  f"surfaces.shadows={'true' if settings.use_shadows else 'false'}"]
    return lines


def settings_lines(scene, shown):
    """All settings, each as burin_set() takes it: beside a style sheet its parameters, else the look of lines.
    `shown`: what gather() has found."""
    settings = scene.burin
    found = [f"lines.filter={settings.filter.lower()}", f"lines.contours={settings.contours.lower()}",
             f"lines.crease_angle={panel_look.crease_angle_text(*panel_look.crease_degrees(settings))}",
             *surface_lines(settings)]
    if settings.use_line_sets:
        return found
    if settings.sheet.source != "NONE":
        return found + sheets.parameter_lines(settings.sheet)
    if panel_look.sheet_text(scene, shown) is not None:
        return found
    return found + panel_look.look_lines(settings)


CLASSES = (BurinSceneSettings, BurinViewLayerSettings, BurinMaterialSettings)
OWNERS = ((bpy.types.Scene, BurinSceneSettings), (bpy.types.ViewLayer, BurinViewLayerSettings),
          (bpy.types.Material, BurinMaterialSettings))


def register():
    sheets.register()
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    for owner, cls in OWNERS:
        owner.burin = PointerProperty(type=cls)


def unregister():
    for owner, _ in OWNERS:
        del owner.burin
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
    sheets.unregister()
