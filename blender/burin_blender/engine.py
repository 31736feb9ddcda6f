"""The render engine that Blender calls: BURIN."""

import re

import bpy
import numpy as np

from . import camera, clip_range, core, line_sets, viewport
from .child import Cancelled, ChildError, work_in_child
from .cryptomatte import ranks_of
from .gather import gather
from .job import Job
from .passes import missing_passes, passes_of
from .properties import samples_of, settings_lines
from .result import give_to_blender
from .shown import NOTHING_SHOWN

_told = set()  # what was reported already: a job, of a frame or an animation, says each thing once


@bpy.app.handlers.persistent
def begin_job(*_):
    """Blender begins to render a frame or an animation."""
    _told.clear()


def size_of(render):
    """The whole picture's size in pixels, as Blender computes it."""
    return (render.resolution_x * render.resolution_percentage // 100,
            render.resolution_y * render.resolution_percentage // 100)


def crop_of(render, width, height):
    """x0 y0 x1 y1 from the upper left corner. Blender multiplies in single precision and cuts: in double precision
    0.7 x 640 would be 447, and the picture would be stretched."""
    if not render.use_border:
        return 0, 0, width, height
    single = np.float32
    x0, x1 = (int(single(x) * single(width)) for x in (render.border_min_x, render.border_max_x))
    y0, y1 = (int(single(y) * single(height)) for y in (render.border_min_y, render.border_max_y))
    return x0, height - y1, x1, height - y0


def is_of_freestyle(scene):
    """Freestyle renders its strokes as a scene of its own, with the engine of the scene that it draws."""
    return re.match(r"FRS\d+_", scene.name) is not None and bpy.data.scenes.get(scene.name) is None


def unsupported(scene, camera_object):
    """Settings that are on and mean nothing here."""
    notes = set()
    if scene.render.use_motion_blur:
        notes.add("motion blur is not drawn")
    if camera_object.type == "CAMERA" and camera_object.data.dof.use_dof:
        notes.add("depth of field is not drawn")
    return notes


def draws_marks(scene, view_layer):
    """Whether marked edges may be lines, whatever is shown. Of a sheet that is only named it is not known."""
    sheet, lines = line_sets.sheet_text(scene, view_layer, NOTHING_SHOWN), settings_lines(scene, NOTHING_SHOWN)
    if sheet is not None:
        return "mark" in sheet or "\n" not in sheet
    return any(line.startswith("lines.draw=") and ("mark" in line or "all" in line) for line in lines)


class BurinEngine(bpy.types.RenderEngine):
    bl_idname = "BURIN"
    bl_label = "Burin"
    bl_use_preview = False
    bl_use_postprocess = True  # compositor and sequencer
    bl_use_custom_freestyle = True

    def update_render_passes(self, scene=None, renderlayer=None):
        for p in passes_of(renderlayer):
            self.register_pass(scene, renderlayer, p.name, len(p.channels), p.channels, p.kind)

    def render(self, depsgraph):
        """Is called once for each view layer.

        In background mode of 3.4, an exception that leaves here, error_set() without a result, or no result at all ends
        Blender by SIGSEGV, and error_set() with a result saves an empty picture with status 0. report() and no result
        give status 1 and no file."""
        try:
            if is_of_freestyle(depsgraph.scene):
                self.give_nothing(depsgraph)
            else:
                self.render_view_layer(depsgraph)
        except Cancelled:
            pass
        except (core.BurinError, core.LibraryError, ChildError, OSError, MemoryError) as error:
            self.report({"ERROR"}, f"Burin: {error}")
        except Exception as error:
            self.report({"ERROR"}, f"Burin: {type(error).__name__}: {error}; please report this")

    def render_view_layer(self, depsgraph):
        core.burin()  # says at once that there is none
        self.update_stats("", "Burin: exporting")
        job = self.job_of(depsgraph)
        if self.test_break():
            raise Cancelled()
        self.update_stats("", "Burin: drawing")
        memory = job.new_memory()
        self.tell("INFO", work_in_child(job.draw, memory, self.test_break, self.update_progress))
        give_to_blender(self, job, memory, depsgraph.view_layer.name)
        self.update_progress(1.0)

    def job_of(self, depsgraph):
        """What is to be drawn. Reports what was not understood."""
        # Blender evaluates line styles and materials for the copies of a render alone.
        scene, view_layer = depsgraph.scene_eval, depsgraph.view_layer_eval
        camera_object = self.camera_override or scene.camera
        if camera_object is None:
            raise core.BurinError("the scene has no camera")
        if scene.render.use_multiview:
            raise core.BurinError("stereoscopic pictures are not drawn; switch Stereoscopy off in the output settings")
        width, height = size_of(scene.render)
        view = camera.view_of_camera(camera_object, depsgraph, width, height)
        view["crop"] = crop_of(scene.render, width, height)
        view["frame"] = scene.frame_current
        settings = scene.burin
        view["samples"] = samples_of(settings.samples)
        gathered = gather(depsgraph, draws_marks(scene, view_layer))
        camera_data = camera_object.evaluated_get(depsgraph).data
        clip_range.leave_out(gathered, view, camera_data.clip_start, camera_data.clip_end)
        shown = gathered.shown
        self.tell("WARNING", gathered.notes | missing_passes(view_layer) | unsupported(scene, camera_object))
        self.tell("WARNING", line_sets.not_drawn(scene, view_layer, shown))
        job = Job(gathered, view, passes_of(view_layer), line_sets.sheet_text(scene, view_layer, shown),
                  settings_lines(scene, shown))
        job.crypto_ranks = ranks_of(view_layer)
        job.threads = scene.render.threads if scene.render.threads_mode == "FIXED" else settings.threads
        job.memory_bytes = settings.memory_mb * 1000000
        if not scene.render.film_transparent:
            job.paper = tuple(settings.background)
        return job

    def tell(self, kind, notes):
        """Reports each note once in a job."""
        for note in sorted(set(notes) - _told):
            _told.add(note)
            self.report({kind}, f"Burin: {note}")

    def give_nothing(self, depsgraph):
        width, height = size_of(depsgraph.scene.render)
        self.end_result(self.begin_result(0, 0, width, height, layer=depsgraph.view_layer.name))

    def view_update(self, context, depsgraph):
        """Something has changed that a viewport shows."""
        viewport.view_update(self, context, depsgraph)

    def view_draw(self, context, depsgraph):
        """A viewport is drawn."""
        viewport.view_draw(self, context, depsgraph)


def register():
    bpy.utils.register_class(BurinEngine)
    bpy.app.handlers.render_init.append(begin_job)


def unregister():
    bpy.app.handlers.render_init.remove(begin_job)
    bpy.utils.unregister_class(BurinEngine)
