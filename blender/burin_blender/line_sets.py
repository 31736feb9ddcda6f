"""Which style sheet a view layer is drawn with, and what of Freestyle's settings is not in it."""

from . import panel_look, sheets
from .core import BurinError
from .freestyle_sheet import FreestyleSheet


def sheet_text(scene, view_layer, shown):
    """The sheet as burin_set_style() takes it: that of the line sets, the one that was chosen, or one that says what
    the panels say where plain settings cannot; None: plain settings do. `shown`: what gather() has found."""
    settings = scene.burin
    if settings.use_line_sets:
        return FreestyleSheet(scene, view_layer, shown).sheet.text()
    if settings.sheet.source != "NONE":
        return sheets.sheet_of(settings.sheet)
    return panel_look.sheet_text(scene, shown)


def not_drawn(scene, view_layer, shown):
    """What of Freestyle's settings is not drawn as they say, each thing once."""
    notes = []
    if scene.render.use_freestyle:
        notes.append("Freestyle itself is on as well, and draws its strokes over the picture; switch it off in the "
                     "render properties")
    if scene.burin.use_line_sets:
        try:
            notes += FreestyleSheet(scene, view_layer, shown).notes
        except BurinError as error:  # what ends a render, too
            notes.append(str(error))
    elif scene.burin.sheet.source != "NONE":
        notes += sheets.not_drawn(scene.burin.sheet, shown)
    return list(dict.fromkeys(notes))
