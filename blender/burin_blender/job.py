"""What a picture is made of, and how a child draws it into shared memory."""

import numpy as np

from . import cryptomatte, export
from .child import SharedMemory
from .passes import channels_of, layers_for, type_of


class Job:
    """A picture to be drawn. Nothing in it refers to Blender's memory."""

    def __init__(self, gathered, view, passes, sheet, settings):
        self.gathered = gathered
        self.view = view  # fields of burin_view, with a crop
        self.passes = passes
        self.sheet = sheet  # text, name or file of a style sheet, or None
        self.settings = settings  # as burin_set() takes them
        self.crypto_ranks = cryptomatte.FEWEST_RANKS
        self.threads = 0
        self.memory_bytes = 0
        self.paper = None  # three linear numbers: what is behind the picture; None: nothing
        x0, y0, x1, y1 = view["crop"]
        self.width, self.height = x1 - x0, y1 - y0

    def channel_names(self):
        """The channels that the child gives, each once."""
        names = dict.fromkeys(name for wanted in self.passes for name in channels_of(wanted))
        if self.gathered.holdouts:
            names.update(dict.fromkeys(cryptomatte.channels_of(self.crypto_ranks)))
        return list(names)

    def new_memory(self):
        """Shared memory for all channels, all 0."""
        bytes_of_pixel = sum(type_of(name).itemsize for name in self.channel_names())
        return SharedMemory(bytes_of_pixel * self.width * self.height)

    def arrays(self, memory):
        """The arrays of all channels by name, (height, width), rows from the top. The widest come first, so that all
        are aligned."""
        found, begin, count = {}, memory.begin, self.width * self.height
        for name in sorted(self.channel_names(), key=lambda n: -type_of(n).itemsize):
            kind = type_of(name)
            found[name] = np.frombuffer(memory.memory, kind, count, begin).reshape(self.height, self.width)
            begin += kind.itemsize * count
        return found

    def draw(self, memory):
        """Draws into the shared memory: the child's work. Channels that the picture does not have stay 0. Gives what
        the library has to say."""
        session = export.Session()
        session.apply(self.gathered)
        session.scene.set_style(self.sheet)
        for setting in (*self.settings, f"crypto.ranks={self.crypto_ranks}"):
            session.scene.set(setting)
        layers = layers_for(self.passes, bool(self.gathered.holdouts))
        picture = session.scene.render(self.view, layers, self.threads, memory.set_progress, self.memory_bytes)
        there = set(picture.channel_names())
        for name, array in self.arrays(memory).items():
            if name.startswith("index."):
                index_of = self.object_index if name == "index.object" else self.material_index
                fill_indices(picture.channel(name.replace("index", "id")), index_of, session, array)
            elif name in there:
                array[...] = picture.channel(name)
        return picture.notes()

    def object_index(self, session, number):
        first = session.numbers[0]
        return self.gathered.objects[session.scene.object_of_id(number) - first].pass_index

    def material_index(self, session, number):
        return next((look.pass_index for look, known in session.materials.items() if known == number), 0)


def fill_indices(ids, index_of, session, out):
    """Blender's pass indices of the library's numbers."""
    indices = np.zeros(int(ids.max(initial=0)) + 1, np.float32)
    for number in np.unique(ids[ids > 0]):
        indices[number] = index_of(session, int(number))
    out[...] = indices[ids]
