"""Freestyle's line sets as a style sheet.

Each line set draws all lines that it selects, whatever the others do, so every set of the sheet lets the search go on
(`also`). Freestyle asks for the nature of an edge, which may be several at once, so sets ask for all classes that any
of them needs, and select by `is_silhouette`, `is_crease` and so on."""

import math

from .core import BurinError
from .freestyle_modifiers import StyleValues
from .object_rules import ObjectRules
from .sheet_text import SheetText, key, list_text, number_text, quoted

SIDED = "(is_silhouette or is_border)"
# Nature of an edge: condition, and the classes that have to be looked for.
EDGE_TYPES = {
    "silhouette": ("is_silhouette", ("silhouette",)),
    "border": ("is_border", ("border",)),
    "crease": ("is_crease", ("crease",)),
    "edge_mark": ("is_mark", ("mark",)),
    "material_boundary": ("is_material", ("material",)),
    "contour": (f"({SIDED} and object2 != object)", ("silhouette", "border")),
    "external_contour": (f"({SIDED} and object2 == 0)", ("silhouette", "border")),
}
OTHER_EDGE_TYPES = {"suggestive_contour": "suggestive contours", "ridge_valley": "ridges and valleys"}
# What Freestyle's view map has always.
ALL_CLASSES = ("silhouette", "border", "crease", "mark")
MOST_SURFACES_IN_FRONT = 255
MOST_SETS = 64  # a sheet has no room for more styles


class FreestyleSheet:
    """The sheet of one view layer, and what of its line sets is not in it."""

    def __init__(self, scene, view_layer, shown):
        self.scene, self.settings, self.shown = scene, view_layer.freestyle_settings, shown
        self.notes = []
        self.classes = set()
        self.sets = []  # (line set, condition)
        if view_layer.use_freestyle and self.can_be_read():
            for line_set in self.settings.linesets:
                if line_set.show_render and line_set.linestyle is not None:
                    self.select(line_set)
        if len(self.sets) > MOST_SETS:
            raise BurinError(f"view layer {view_layer.name} has {len(self.sets)} line sets; {MOST_SETS} can be drawn")
        self.rules = ObjectRules(shown)
        # Freestyle's angle is between faces, Burin's between their normals.
        self.crease_degrees = round(180 - math.degrees(self.settings.crease_angle), 4)
        top = [f"crease_angle = {self.rules.crease_angle(self.crease_degrees)!r}"]
        if self.settings.use_smoothness:
            top.append('contours = "smooth"')
        self.sheet = SheetText(top)
        self.write()

    def can_be_read(self):
        if self.settings.mode == "SCRIPT":
            self.notes.append("Freestyle's style modules are Python programs; nothing of them is drawn")
            return False
        if self.settings.as_render_pass:
            self.notes.append("Freestyle's As Render Pass: lines are in the picture and in the pass Lines")
        return True

    def note(self, line_set, what):
        self.notes.append(f"line set {line_set.name}, not drawn: {what}")

    def select(self, line_set):
        """Keeps a set with the condition of its edge types."""
        condition, classes = self.edge_condition(line_set)
        if line_set.select_by_face_marks:
            self.note(line_set, "selection by face marks")
        if line_set.select_by_collection and line_set.collection is not None:
            if line_set.collection_negation == "INCLUSIVE" and not any(objects_of(line_set.collection)):
                return  # nothing can be in it
        if condition is not None:
            self.classes.update(classes)
            self.sets.append((line_set, condition))

    def edge_condition(self, line_set):
        """Which natures a set takes, as a condition, or None if there are none; and the classes that it needs."""
        if not line_set.select_by_edge_types:
            return "", ALL_CLASSES
        terms, classes, is_open, others = [], set(), line_set.edge_type_negation == "EXCLUSIVE", 0
        for name, words in OTHER_EDGE_TYPES.items():
            if getattr(line_set, "select_" + name):
                self.note(line_set, words)
                others += 1
        for name, (condition, needed) in EDGE_TYPES.items():
            if getattr(line_set, "select_" + name):
                excluded = getattr(line_set, "exclude_" + name)
                terms.append(f"not {condition}" if excluded else condition)
                classes.update(needed)
                is_open = is_open or excluded
        if not terms:
            return (None, ()) if others else ("", ALL_CLASSES)
        if is_open:
            classes.update(ALL_CLASSES)
        joined = (" or " if line_set.edge_type_combination == "OR" else " and ").join(terms)
        return (f"not ({joined})" if line_set.edge_type_negation == "EXCLUSIVE" else f"({joined})"), classes

    def write(self):
        if not self.sets:
            self.sheet.table("[[set]]", ['name = "nothing"', 'classes = ["mark"]', "enabled = false", 'style = "none"'])
            self.sheet.table("[style.none]", [])
            return
        rules = self.rules.conditions(self.sheet, self.crease_degrees)
        for number, (line_set, condition) in enumerate(self.sets):
            conditions = [c for c in (condition, self.collection_condition(line_set), *rules) if c]
            entries = [f"name = {quoted(f'{number} {line_set.name}')}", f"classes = {list_text(sorted(self.classes))}",
                       f"qi = {visibility(line_set)}", "also = true", f'style = "style_{number}"']
            if conditions:
                entries.append(f"select = {quoted(' and '.join(conditions))}")
            self.sheet.table("[[set]]", entries)
        for number, (line_set, _) in enumerate(self.sets):
            self.sheet.table(f"[style.style_{number}]", self.style(line_set, number))

    def collection_condition(self, line_set):
        if not line_set.select_by_collection or line_set.collection is None:
            return ""
        names = self.shown.names_in(objects_of(line_set.collection))
        is_negated = line_set.collection_negation == "EXCLUSIVE"
        if not names:  # the numbers of objects begin with 1
            return "" if is_negated else "object == 0"
        group = self.sheet.group("objects", names)
        return f"not (object in {group})" if is_negated else f"object in {group}"

    def style(self, line_set, number):
        """The keys of a line style."""
        line_style = line_set.linestyle
        place = "(run_s / max(run_length, 0.001))" if line_set.select_by_visibility else "t"
        values = StyleValues(self.sheet, line_style, place, list(self.shown.materials.values()))
        for what in values.notes + not_carried(line_style):
            self.note(line_set, what)
        width = self.sheet.let(f"{values.thickness} * {number_text(thickness_unit(self.scene))}")
        # In Freestyle, too, the first line set lies above the others.
        entries = [f"priority = {len(self.sets) - number}", key("opacity", opacity(self.sheet, values.alpha)),
                   key("color", values.color),
                   *side_keys(line_style, width)]
        pattern = dash_pattern(line_style)
        if pattern:
            entries.append(f"dash = {pattern}")
        # Freestyle's strokes go on around corners, where Burin's lines may end: round ends close the corner. Dashes
        # have straight ends there.
        entries.append(f"caps = {quoted('butt' if pattern else 'round')}")
        if line_style.use_length_min:
            entries.append(f"min_length = {float(line_style.length_min)!r}")
        return entries


def objects_of(collection):
    """The objects that a line set's collection means: those that are in it, not those of collections below, but those
    of collections that an object of it is an instance of."""
    for thing in collection.objects:
        if thing.instance_type == "COLLECTION" and thing.instance_collection is not None:
            yield from objects_of(thing.instance_collection)
        else:
            yield thing


def visibility(line_set):
    """The numbers of surfaces in front that a set takes."""
    first, last = {"VISIBLE": (0, 0), "HIDDEN": (1, MOST_SURFACES_IN_FRONT),
                   "RANGE": (line_set.qi_start, line_set.qi_end)}[line_set.visibility]
    if not line_set.select_by_visibility:
        first, last = 0, MOST_SURFACES_IN_FRONT
    return f"[{min(first, MOST_SURFACES_IN_FRONT)}, {min(max(first, last), MOST_SURFACES_IN_FRONT)}]"


def thickness_unit(scene):
    """Pixels of a thickness of 1."""
    render = scene.render
    if render.line_thickness_mode == "ABSOLUTE":
        return render.line_thickness * render.resolution_percentage / 100
    return int(render.resolution_y * render.resolution_percentage / 100) / 480


def side_keys(line_style, width):
    """Width and place of strokes. Only silhouettes and borders have an inside and an outside."""
    position = line_style.thickness_position
    if line_style.use_chaining and not (line_style.chaining == "PLAIN" and line_style.use_same_object):
        position = "CENTER"  # as in Freestyle
    if position == "CENTER":
        return [key("width", width)]
    if position == "RELATIVE":
        shift = number_text(line_style.thickness_ratio - 0.5)
        return [key("width", width), key("offset", f"{SIDED} ? {shift} * {width} : 0")]
    # A side is one half of a stroke.
    return [key("width", f"{SIDED} ? 2 * {width} : {width}"), f"side = {quoted(position.lower())}"]


def opacity(sheet, alpha):
    """How much a stroke covers. Freestyle's strokes have their alpha in a colour attribute, which Blender takes to be
    sRGB: an alpha of 0.5 covers 21 %."""
    if alpha == "1.0":
        return alpha
    name = sheet.let(f"clamp({alpha}, 0, 1)")
    return sheet.let(f"({name} <= 0.04045 ? {name} / 12.92 : (({name} + 0.055) / 1.055) ^ 2.4)")


def dash_pattern(line_style):
    if not line_style.use_dashed_line:
        return ""
    pairs = ((line_style.dash1, line_style.gap1), (line_style.dash2, line_style.gap2),
             (line_style.dash3, line_style.gap3))
    lengths = [length for dash, gap in pairs if dash > 0 and gap > 0 for length in (dash, gap)]
    return repr(lengths) if lengths else ""


def not_carried(style):
    """What of a line style a sheet cannot say."""
    wanted = (
        (style.caps == "SQUARE", "square caps (round ones instead)"),
        (style.use_chaining and style.chaining == "SKETCHY", "sketchy chaining"),
        (style.use_angle_min or style.use_angle_max, "splitting by angle"),
        (style.use_split_length, "splitting by length"),
        (style.use_split_pattern, "the split pattern"),
        (style.material_boundary, "splitting at material boundaries"),
        (style.use_length_max, "selection by the greatest length"),
        (style.use_chain_count, "selection by the count of chains"),
        (style.use_sorting, "sorting"),
        (style.use_nodes and style.node_tree is not None, "textures"),
    )
    # Resampling alone changes nothing that can be seen.
    geometry = [f"geometry modifier {m.type.replace('_', ' ').title()} ({m.name})"
                for m in style.geometry_modifiers if m.use and m.type != "SAMPLING"]
    return [words for is_wanted, words in wanted if is_wanted] + geometry
