"""What Blender shows as a scene of Burin's library."""

from . import core


class Session:
    """A scene of the library that follows what Blender shows. Meshes that have not changed are kept."""

    def __init__(self):
        self.scene = core.Scene()

    def update(self, depsgraph, view_layer=None):
        """Brings meshes, materials and objects up to date. Gives the names of what was not understood, as sentences
        for the user. Settings and style sheet are the caller's: session.scene.set(), session.scene.set_style()."""
        raise NotImplementedError
