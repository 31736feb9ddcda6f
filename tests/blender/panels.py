"""Properties, panels and operators: what is drawn exists, what is set reaches the library, nothing is left behind."""

import json
import os
import subprocess
import sys
import types

sys.path.insert(0, os.path.dirname(__file__))

import addon_utils
import bpy

from in_blender import FOLDER, add, gathered, look_of, main, new_scene, paint, render

import burin_blender
from burin_blender import blender_panels, core, freestyle_panels, line_sets, panels, presets, sheets
from burin_blender.look import Look


class FakeLayout:
    """Stands for UILayout, which cannot be had without a window: all that is drawn must exist."""

    def __init__(self, seen):
        self.__dict__["seen"] = seen

    def __setattr__(self, name, value):
        assert name in bpy.types.UILayout.bl_rna.properties, name

    def prop(self, data, name, **options):
        if name.startswith("["):
            assert name[2:-2] in data, name
        else:
            assert name in data.bl_rna.properties, (data, name)
        self.seen.append(name)

    def label(self, text="", **options):
        self.seen.append(text)

    def operator(self, name, **options):
        module, function = name.split(".")
        getattr(getattr(bpy.ops, module), function).get_rna_type()
        self.seen.append(name)
        return types.SimpleNamespace()

    def __getattr__(self, name):
        """row(), column(), box(), template_list() and the others."""
        assert name in bpy.types.UILayout.bl_rna.functions, name
        return lambda *arguments, **options: FakeLayout(self.seen)


class PropertiesContext:
    """The context in the properties editor, which there is none of without a window."""

    def __getattr__(self, name):
        if name == "material":
            return bpy.context.object.active_material if bpy.context.object else None
        return getattr(bpy.context, name)


def drawn(panel):
    """What a panel draws, or None if it is not shown."""
    context = PropertiesContext()
    if not panel.poll(context):
        return None
    seen = []
    members = {name: getattr(panel, name) for name in dir(panel) if not name.startswith("_") and name != "layout"}
    fake = types.SimpleNamespace(layout=FakeLayout(seen))
    for name, member in members.items():
        if isinstance(member, types.FunctionType):
            setattr(fake, name, types.MethodType(member, fake))
    for name in ("draw_header", "draw"):
        if hasattr(fake, name):
            getattr(fake, name)(context)
    return seen


def own_panels():
    return [p for p in blender_panels.panels() if p.__name__.startswith("BURIN_PT_")]


def with_line_sets(scene):
    scene.burin.use_line_sets = True
    sets = bpy.context.view_layer.freestyle_settings.linesets
    style = sets.new("set").linestyle
    for kind in ("color", "alpha", "thickness"):
        modifiers = getattr(style, kind + "_modifiers")
        for item in modifiers.bl_rna.functions["new"].parameters["type"].enum_items:
            modifiers.new(item.identifier, item.identifier)
    sets.active_index = len(sets) - 1


def all_panels_draw():
    scene = new_scene()
    paint(add("cube", "cube"), "red", (1, 0, 0, 1))
    states = 0
    for source in ("NONE", "NAME", "TEXT", "FILE"):
        for shading in ("PAPER", "HATCH", "GOOCH"):
            scene.burin.sheet.source, scene.burin.shading = source, shading
            shown = [p for p in own_panels() if drawn(p) is not None]
            assert panels.BURIN_PT_lines in shown and panels.BURIN_PT_material in shown
            states += 1
    with_line_sets(scene)
    shown = [p.__name__ for p in own_panels() if drawn(p) is not None]
    assert len([name for name in shown if name.startswith(freestyle_panels.OWN_PREFIX)]) > 10, shown
    assert "BURIN_PT_hidden" not in shown and states == 12
    scene.render.engine = "CYCLES"
    assert all(not p.poll(PropertiesContext()) for p in own_panels())


def warnings_are_shown():
    scene = new_scene()
    scene.view_settings.view_transform = "Filmic"
    assert "burin.standard_view" in drawn(panels.BURIN_PT_surfaces)
    bpy.ops.burin.standard_view()
    assert scene.view_settings.view_transform == "Standard"
    assert "burin.standard_view" not in drawn(panels.BURIN_PT_surfaces)
    assert not any("Freestyle is on" in text for text in drawn(panels.BURIN_PT_lines))
    scene.render.use_freestyle = True
    assert any("Freestyle is on" in text for text in drawn(panels.BURIN_PT_lines))


def blender_shows_its_own_panels():
    from bl_ui import properties_data_camera, properties_freestyle, properties_output, properties_render
    for panel in (properties_output.RENDER_PT_format, properties_render.RENDER_PT_color_management,
                  properties_data_camera.DATA_PT_lens):
        assert "BURIN" in panel.COMPAT_ENGINES, panel
    assert "BURIN" not in properties_freestyle.RENDER_PT_freestyle.COMPAT_ENGINES


def names_of_engine():
    """Names of panels that Blender knows and shows for Burin."""
    return [p.__name__ for p in blender_panels.panels()
            if getattr(p, "is_registered", False) and "BURIN" in getattr(p, "COMPAT_ENGINES", ())]


def comes_and_goes():
    """Twice off and on: the same as before, and nothing is left while it is off."""
    before = sorted(names_of_engine())
    for _ in range(2):
        addon_utils.disable("burin_blender")
        assert names_of_engine() == [], names_of_engine()
        for owner in (bpy.types.Scene, bpy.types.ViewLayer, bpy.types.Material):
            assert not hasattr(owner, "burin")
        assert not hasattr(bpy.types, "BURIN_PT_lines") and not hasattr(bpy.types, "BURIN_OT_edit_sheet")
        addon_utils.enable("burin_blender")
        assert sorted(names_of_engine()) == before
    assert bpy.context.scene.burin.width == 1.5


def every_choice_is_taken_by_the_library():
    """Each item of each property, one after the other on one scene, as a user would."""
    scene = new_scene()
    add("cube", "cube")
    settings, view_layer = scene.burin, bpy.context.view_layer
    drawing, look = core.Scene(), Look()

    def apply():
        nonlocal drawing, look
        lines, sheet = look_of(scene, view_layer)
        if not look.fits(lines):
            drawing, look = core.Scene(), Look()
        look.apply(drawing, lines, sheet)
        assert not look.apply(drawing, lines, sheet)  # nothing is given twice

    count = 0
    for name, kind in settings.bl_rna.properties.items():
        if kind.type == "ENUM" and not kind.is_enum_flag:
            for item in kind.enum_items:
                setattr(settings, name, item.identifier)
                apply()
                count += 1
        elif kind.type == "FLOAT" and not kind.is_array:
            for value in (kind.hard_min, kind.default, kind.hard_max):
                setattr(settings, name, value)
                apply()
                count += 1
        elif kind.type == "BOOLEAN":
            for value in (True, False):
                setattr(settings, name, value)
                apply()
                count += 1
    for item in settings.bl_rna.properties["line_types"].enum_items:
        settings.line_types = {item.identifier}
        apply()
    settings.line_types = set()
    apply()
    assert count > 40, count


def presets_have_sliders():
    scene = new_scene()
    sheet = scene.burin.sheet
    sheet.source = "NAME"
    program = presets.program()
    listed = json.loads(subprocess.run([program, "styles", "--json"], capture_output=True, check=True).stdout)["styles"]
    assert [s["name"] for s in listed] == list(presets.BUILT_IN)
    for entry in listed:
        sheet.name_of_sheet = entry["name"]
        assert sorted(sheet.values.keys()) == sorted(p["name"] for p in entry["parameters"])
        lines = look_of(scene, bpy.context.view_layer)[0]
        assert not any(line.startswith("style.") for line in lines), lines  # all is as in the sheet
        drawing = core.Scene()
        for parameter in sheets.parameters(sheet):
            sheet.values[parameter.name] = (0.5, 0.25, 0.125) if parameter.is_color else parameter.value * 0.5
        lines = look_of(scene, bpy.context.view_layer)[0]
        assert sum(line.startswith("style.") for line in lines) == len(entry["parameters"])
        Look().apply(drawing, lines, look_of(scene, bpy.context.view_layer)[1])
        shown = drawn(panels.BURIN_PT_lines)
        assert all(f'["{p["name"]}"]' in shown for p in entry["parameters"]), shown
        bpy.ops.burin.reset_sheet()
    sheet.name_of_sheet = "technical"
    hints = sheet.values.id_properties_ui("width").as_dict()
    assert sheet.values["width"] == 0.5 and (hints["min"], hints["max"], hints["default"]) == (0, 200, 0.5), hints
    sheet.values["width"] = 0.25
    assert "style.width=0.25mm" in look_of(scene, bpy.context.view_layer)[0]


def sheets_can_be_edited():
    scene = new_scene()
    sheet = scene.burin.sheet
    sheet.source, sheet.name_of_sheet = "NAME", "comic"
    sheet.values["width"] = 7.0
    assert bpy.ops.burin.edit_sheet() == {"FINISHED"}
    assert sheet.source == "TEXT" and sheet.text.name == "comic.toml" and sheet.values["width"] == 7
    assert "[style.brush]" in look_of(scene, bpy.context.view_layer)[1]
    sheet.text.from_string(sheet.text.as_string().replace("[parameters]", "[parameters]\nnew = 4"))
    bpy.ops.burin.read_sheet()
    assert sheet.values["new"] == 4 and sheet.values["width"] == 7
    path = FOLDER / "own.toml"
    path.write_text('[parameters]\nown = 2\n[[set]]\nname = "a"\nclasses = ["crease"]\nstyle = "b"\n[style.b]\n'
                    'width = "=own"\n')
    sheet.source, sheet.path = "FILE", str(path)
    assert list(sheet.values.keys()) == ["own"]
    Look().apply(core.Scene(), *look_of(scene, bpy.context.view_layer))


def wrong_sheets_are_errors():
    scene = new_scene()
    sheet = scene.burin.sheet

    def message():
        try:
            text = look_of(scene, bpy.context.view_layer)[1]
            core.Scene().set_style(text)
        except core.BurinError as error:
            return str(error)
        raise AssertionError("no error")

    sheet.source = "TEXT"
    assert "no text" in message()
    sheet.text = bpy.data.texts.new("mine")
    sheet.text.write('[[set]]\nname = "a"\nclasses = ["creese"]\nstyle = "b"\n[style.b]\n')
    assert "did you mean 'crease'" in message()
    assert drawn(panels.BURIN_PT_lines) is not None
    sheet.text.from_string("comic")  # one line is no name here
    assert message()
    sheet.source = "FILE"
    assert "no file" in message()
    sheet.path = str(FOLDER / "missing.toml")
    assert "missing.toml" in message()


def too_many_are_told():
    """More than a sheet has room for: a message that says of what, and how many are possible."""
    scene, view_layer = new_scene(), bpy.context.view_layer
    cube = add("cube", "cube")
    for most, is_error in ((100, False), (101, True)):
        while len(cube.data.materials) < most:
            material = paint(cube, "many", (1, 1, 1, 1))
            material.burin.use_line_color = True
            material.burin.line_color = (len(cube.data.materials) / 128, 0.5, 0)
        try:
            core.Scene().set_style(look_of(scene, view_layer)[1])
            assert not is_error
        except core.BurinError as error:
            assert is_error and "101 line colours" in str(error), error
    scene.burin.use_line_sets = True
    sets = view_layer.freestyle_settings.linesets
    while len(sets) < 65:
        sets.new("many")
    sets.remove(sets[0])  # that of a new scene, without a style
    core.Scene().set_style(look_of(scene, view_layer)[1])
    sets.new("one more")
    try:
        look_of(scene, view_layer)[1]
        raise AssertionError("no error")
    except core.BurinError as error:
        told = line_sets.not_drawn(scene, view_layer, gathered().shown)
        assert "65 line sets" in str(error) and str(error) in told, error


def a_sheet_only_where_it_is_needed():
    scene = new_scene()
    cube, other = add("cube", "cube"), add("cube", "other", location=(3, 0, 0))
    red = paint(cube, 'red "1"', (1, 0, 0, 1))
    view_layer = bpy.context.view_layer
    assert look_of(scene, view_layer)[1] is None
    red.burin.use_line_color, red.burin.line_color = True, (1, 0, 0)
    text = look_of(scene, view_layer)[1]
    assert "rgb(1.0, 0.0, 0.0)" in text and "hidden" not in text
    scene.burin.hidden = "DASHED"
    other.lineart.usage = "OCCLUSION_ONLY"
    cube.lineart.use_crease_override, cube.lineart.crease_threshold = True, 2.0
    text = look_of(scene, view_layer)[1]
    core.Scene().set_style(text)
    assert "[style.hidden]" in text and "not (object in" in text and "dihedral" in text
    scene.burin.sheet.source = "NAME"
    assert len(line_sets.not_drawn(scene, view_layer, gathered().shown)) == 2


def ink(channels, letter="A"):
    return float(next(v for n, v in channels.items() if n.endswith("Lines." + letter)).sum())


def materials_and_objects_have_a_say():
    """In the picture: lines of a material in its colour, none of an object that only hides, creases by object."""
    scene = new_scene()
    cube, other = add("cube", "cube", size=2), add("cube", "other", size=2, location=(3, 0, 0))
    plain = ink(render())
    red = paint(cube, "red", (1, 1, 1, 1))
    red.burin.use_line_color, red.burin.line_color = True, (1, 0, 0)
    colored = render()
    assert abs(ink(colored) - plain) < 0.01 * plain
    assert 0.4 * plain < ink(colored, "R") < 0.6 * plain and ink(colored, "G") == 0
    other.lineart.usage = "OCCLUSION_ONLY"
    silent = render()
    assert abs(ink(silent) - ink(silent, "R")) < 1e-3 * plain  # red alone is left
    other.lineart.usage = "EXCLUDE"
    assert abs(ink(render()) - ink(silent)) > 1  # what it hid
    other.lineart.usage = "INHERIT"
    cube.lineart.use_crease_override, cube.lineart.crease_threshold = True, 1.5  # 86 degrees: no edge is that sharp
    smoother = render()
    assert ink(smoother, "R") < 0.9 * ink(colored, "R")
    assert abs((ink(smoother) - ink(smoother, "R")) - (ink(colored) - ink(colored, "R"))) < 0.02 * plain


main((
    materials_and_objects_have_a_say,
    all_panels_draw,
    warnings_are_shown,
    blender_shows_its_own_panels,
    every_choice_is_taken_by_the_library,
    presets_have_sliders,
    sheets_can_be_edited,
    wrong_sheets_are_errors,
    too_many_are_told,
    a_sheet_only_where_it_is_needed,
    comes_and_goes,
))
