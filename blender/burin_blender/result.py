"""What a view layer's render gives: passes as arrays in shared memory, made by the child and handed to Blender."""

import bpy
import numpy as np

from . import export
from .child import SharedMemory
from .passes import PassFiller, layers_for

# From 4.1 on foreach_set() of a pass takes a flat array, before rows of pixels; other ways take 20 times as long.
TAKES_FLAT = bpy.app.version >= (4, 1, 0)


class Job:
    """All that a picture is made of. Nothing in it refers to Blender's memory."""

    def __init__(self, gathered, view, passes, sheet, settings):
        self.gathered = gathered
        self.view = view
        self.passes = passes
        self.sheet = sheet  # text, name or file of a style sheet, or None
        self.settings = settings  # as burin_set() takes them
        self.threads = 0
        self.memory_bytes = 0
        self.paper = None  # three linear numbers: what is behind the picture; None: nothing
        x0, y0, x1, y1 = view["crop"]
        self.width, self.height = x1 - x0, y1 - y0

    def new_memory(self):
        """Shared memory for all passes, all 0."""
        channels = sum(len(p.channels) for p in self.passes)
        return SharedMemory(4 * channels * self.width * self.height)

    def arrays(self, memory):
        """For each pass its array (height, width, channels), rows from the bottom."""
        begin = memory.begin
        for wanted in self.passes:
            count = len(wanted.channels) * self.width * self.height
            array = np.frombuffer(memory.memory, np.float32, count, begin)
            yield wanted, array.reshape(self.height, self.width, len(wanted.channels))
            begin += 4 * count

    def draw(self, memory):
        """Draws, and fills the passes. Gives what the library has to say."""
        session = export.Session()
        session.apply(self.gathered)
        session.scene.set_style(self.sheet)
        for setting in self.settings:
            session.scene.set(setting)

        def progress(done):
            memory.set_progress(done)

        picture = session.scene.render(self.view, layers_for(self.passes, bool(self.gathered.holdouts)), self.threads,
                                       self.memory_bytes, progress)
        filler = PassFiller(picture, self.gathered, session)
        factor = self.not_held_out(filler)
        for wanted, array in self.arrays(memory):
            filler.fill(wanted, array)
            if factor is not None and wanted.name in {"Combined", "Lines", "LinesHidden"}:
                array *= factor[..., None]
            if wanted.name == "Combined" and self.paper is not None:
                put_on_paper(array, self.paper, factor)
        return picture.notes()

    def not_held_out(self, filler):
        """The part of each pixel's ink and surfaces that is left beside objects that cut a hole; None: all."""
        if not self.gathered.holdouts:
            return None
        alpha = filler.channel("A")
        held = filler.share_of(self.gathered.holdouts)
        return np.clip(1 - np.divide(held, alpha, out=np.zeros_like(held), where=alpha > 0), 0, 1)


def put_on_paper(array, paper, factor):
    """Puts paper behind premultiplied pixels, but not into holes."""
    free = 1 - array[..., 3]
    if factor is not None:
        free *= factor  # inside of a hole no paper is left
    for i in range(3):
        if paper[i] != 0:
            array[..., i] += free * paper[i]
    array[..., 3] += free


def give_to_blender(engine, job, memory, layer):
    """Makes the arrays the render's result."""
    result = engine.begin_result(0, 0, job.width, job.height, layer=layer)
    arrays = {wanted.name: array for wanted, array in job.arrays(memory)}
    for render_pass in result.layers[0].passes:
        array = arrays.get(render_pass.name)
        if array is not None:
            flat = array.reshape(-1) if TAKES_FLAT else array.reshape(-1, render_pass.channels)
            render_pass.rect.foreach_set(flat)
    engine.end_result(result)
