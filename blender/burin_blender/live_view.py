"""One viewport that Burin draws.

While the view moves, pictures are drawn at once with 2 samples. When it has come to rest, a thread draws the same in
full quality, and the viewport is drawn again with it; a change stops that thread. What is shown always belongs to what
Blender shows at that moment: its key names the version of the scene and the look, and the view."""

import time

from . import core, line_sets, properties
from .export import Session
from .full_picture import FullPicture
from .live_gather import KeptMeshes, LiveGatherer, visibility_of
from .look import Look
from .view_fields import fields_of
from .view_pixels import PixelMemory, ShownPicture

PREVIEW_SAMPLES = 2
REST_S = 0.15  # after so long without a change the full picture is made
LOOK_S = 0.25  # how often is looked whether line sets, texts or files are other ones; Blender does not tell
LOOK_SHARE = 0.05  # most of the time that this may take
LAYERS = "beauty"


class LiveView:
    """What one viewport shows."""

    def __init__(self):
        self.session, self.look = Session(), Look()
        self.kept, self.gathered = KeptMeshes(), None
        self.version = 0  # counts changes of scene and look
        self.wanted_look = None  # (lines, sheet) that was tried last, or why there is none
        self.look_error, self.error = "", ""
        self.visibility = None  # as it was when objects were gathered
        self.owner = ("", "")  # names of scene and view layer
        self.look_at = 0  # when the look is to be compared again
        self.key, self.shown, self.memory = None, None, PixelMemory()
        self.view, self.options = {}, (0, 0)  # samples of the full picture, threads
        self.full = None
        self.is_final = True  # nothing better will come
        self.rest_at = 0

    def __del__(self):
        self.stop()

    def stop(self):
        """Ends the thread, if there is one, so that the session may be used."""
        full, self.full = getattr(self, "full", None), None
        if full is not None:
            full.stop()

    def update(self, context, depsgraph):
        """Brings the session up to date with Blender: reads what is named as changed."""
        self.stop()
        self.version += 1
        self.kept.forget_changed(depsgraph)
        self.gathered = LiveGatherer(depsgraph, context.space_data, self.kept).gather()
        self.session.apply(self.gathered)
        self.visibility = visibility_of(context.space_data)
        self.owner = (depsgraph.scene.name, depsgraph.view_layer.name)
        self.update_look(depsgraph.scene, depsgraph.view_layer)

    def update_look(self, scene, view_layer):
        """Brings settings and style sheet up to date. What is wrong with them is kept, to be shown."""
        wanted = self.look_of(scene, view_layer)
        if wanted == self.wanted_look:
            return
        self.stop()
        self.version += 1
        self.wanted_look, self.look_error = wanted, ""
        try:
            if isinstance(wanted, str):
                raise core.BurinError(wanted)
            if not self.look.fits(wanted[0]):  # a scene that has none of the settings of the one before
                self.session, self.look = Session(), Look()
                self.session.apply(self.gathered)
            self.look.apply(self.session.scene, *wanted)
        except core.BurinError as error:
            self.look_error = str(error)

    def picture(self, context, depsgraph):
        """What is to be shown now: a ShownPicture, or None where there is nothing to draw. Throws BurinError."""
        scene = depsgraph.scene
        if visibility_of(context.space_data) != self.visibility:
            self.update(context, depsgraph)
        if time.monotonic() >= self.look_at:
            self.update_look(scene, depsgraph.view_layer)
        if self.look_error:
            raise core.BurinError(self.look_error)
        view = fields_of(context, depsgraph)
        settings = scene.burin
        self.options = (properties.samples_of(settings.viewport_samples), settings.threads)
        paper = None if scene.render.film_transparent else tuple(settings.background)
        key = (self.version, tuple(sorted(view.items())), self.options, paper)
        if key != self.key:
            self.draw_preview(view, key, paper)
        elif self.full is not None and self.full.is_done():
            self.take_full_picture(view, paper)
        if self.error:
            raise core.BurinError(self.error)
        return self.shown

    def draw_preview(self, view, key, paper):
        """Draws at once; the full picture is made when the view rests."""
        self.stop()
        self.key, self.shown, self.view, self.error, self.is_final = key, None, view, "", True
        if has_no_pixels(view):
            return
        try:
            picture = self.session.scene.render({**view, "samples": PREVIEW_SAMPLES}, LAYERS, self.options[1])
        except core.BurinError as error:
            self.error = str(error)
            return
        self.show(picture, view, paper)
        self.is_final = self.options[0] == PREVIEW_SAMPLES
        self.rest_at = time.monotonic() + REST_S

    def take_full_picture(self, view, paper):
        full, self.full = self.full, None
        self.is_final = True
        self.error = full.error
        if full.picture is not None:
            self.show(full.picture, view, paper)

    def show(self, picture, view, paper):
        x0, _, _, y1 = view.get("crop", (0, 0, view["width"], view["height"]))
        self.shown = ShownPicture(picture, x0, view["height"] - y1, paper, self.memory)

    def advance(self):
        """Begins the full picture when the view rests. Whether the viewport should be drawn again, for it is there."""
        if self.is_final:
            return False
        if self.full is None:
            if time.monotonic() >= self.rest_at:
                view = {**self.view, "samples": self.options[0]}
                self.full = FullPicture(self.session.scene, view, LAYERS, self.options[1])
            return False
        return self.full.is_done()

    def look_of(self, scene, view_layer):
        """Settings and style sheet, or why there are none."""
        begin = time.monotonic()
        try:
            shown = self.gathered.shown
            return properties.settings_lines(scene, shown), line_sets.sheet_text(scene, view_layer, shown)
        except core.BurinError as error:
            return str(error)
        finally:
            end = time.monotonic()
            self.look_at = end + max(LOOK_S, (end - begin) / LOOK_SHARE)

    def has_other_look(self, scenes):
        """Whether something has changed that Blender does not tell about. Asked often, it looks now and then."""
        if time.monotonic() < self.look_at:
            return False
        scene = scenes.get(self.owner[0])
        view_layer = scene.view_layers.get(self.owner[1]) if scene is not None else None
        if view_layer is None or self.look_of(scene, view_layer) == self.wanted_look:
            return False
        self.look_at = 0
        return True


def has_no_pixels(view):
    x0, y0, x1, y1 = view.get("crop", (0, 0, view["width"], view["height"]))
    return x0 >= x1 or y0 >= y1
