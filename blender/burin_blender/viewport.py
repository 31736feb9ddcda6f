"""The live viewport: Blender calls view_update() when something has changed and view_draw() when a viewport is drawn.

Whatever goes wrong is shown as text in the viewport, without a picture."""

import atexit
import textwrap
import traceback
import weakref

import blf
import bpy

from . import core
from .live_view import LOOK_S, LiveView

ASK_S = 0.02  # how often is looked whether a full picture is there
TEXT_SIZE, TEXT_LEFT, TEXT_TOP, LINE_HEIGHT, LONGEST_LINE = 14, 100, 100, 20, 90
TEXT_COLOR = (0.9, 0.1, 0.05, 1)

live_views = weakref.WeakSet()


def view_update(engine, context, depsgraph):
    try:
        engine.failure = ""
        live_view_of(engine).update(context, depsgraph)
    except Exception as error:
        engine.failure = sentence(error)


def view_draw(engine, context, depsgraph):
    try:
        if not hasattr(engine, "live"):
            view_update(engine, context, depsgraph)
        if engine.failure:
            raise core.BurinError(engine.failure)
        live = engine.live
        shown = live.picture(context, depsgraph)
        if shown is not None:
            shown.draw(engine, depsgraph.scene, context.region)
        engine.update_stats("Burin", "preview" if not live.is_final else "")
        if not live.is_final:
            wait_for(live)
    except Exception as error:
        draw_text(context.region, "Burin: " + sentence(error))


def live_view_of(engine):
    if not hasattr(engine, "live"):
        engine.live = LiveView()
        live_views.add(engine.live)
        reference = weakref.ref(engine.live)
        bpy.app.timers.register(lambda: watch_look(reference), first_interval=LOOK_S)
    return engine.live


def sentence(error):
    """What an exception says; one that nobody foresaw is printed in full, too."""
    if not isinstance(error, (core.BurinError, core.LibraryError)):
        traceback.print_exception(error)
        return f"{type(error).__name__}: {error}"
    return str(error)


def wait_for(live):
    """Has a timer begin the full picture and redraw the viewport when it is there."""
    if getattr(live, "is_waited_for", False):
        return
    live.is_waited_for = True
    reference = weakref.ref(live)
    bpy.app.timers.register(lambda: watch_picture(reference), first_interval=ASK_S)


def watch_picture(reference):
    live = reference()
    if live is None:
        return None
    if live.advance():
        redraw_viewports()
    elif not live.is_final:
        return ASK_S
    live.is_waited_for = False
    return None


def watch_look(reference):
    live = reference()
    if live is None:
        return None
    if live.has_other_look(bpy.data.scenes):
        redraw_viewports()
    return LOOK_S


def redraw_viewports():
    """Only what Blender says is there now is touched: a region that was kept may be gone."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D" and area.spaces.active.shading.type == "RENDERED":
                area.tag_redraw()


def draw_text(region, text):
    font = 0
    size = (font, TEXT_SIZE) if bpy.app.version >= (3, 4, 0) else (font, TEXT_SIZE, 72)
    blf.size(*size)
    blf.color(font, *TEXT_COLOR)
    for number, line in enumerate(textwrap.wrap(text, LONGEST_LINE)):
        blf.position(font, TEXT_LEFT, region.height - TEXT_TOP - number * LINE_HEIGHT, 0)
        blf.draw(font, line)


def stop_all():
    """No thread may draw when Blender ends."""
    for live in list(live_views):
        live.stop()


def register():
    atexit.register(stop_all)


def unregister():
    stop_all()
    atexit.unregister(stop_all)
