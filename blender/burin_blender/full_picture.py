"""A picture that a thread draws while Blender goes on."""

import threading

from . import core

STOP_S = 0.005  # how often a thread is told to stop until it does


class FullPicture:
    """A picture on its way. The thread knows nothing of Blender; until it has ended, nobody else may use the scene."""

    def __init__(self, scene, view, layers, threads):
        self.scene, self.arguments = scene, (view, layers, threads)
        self.picture, self.error, self.is_stopped = None, "", False
        self.thread = threading.Thread(target=self.run, name="burin viewport", daemon=True)
        self.thread.start()

    def run(self):
        try:
            if not self.is_stopped:
                self.picture = self.scene.render(*self.arguments, progress=lambda done: self.is_stopped)
        except core.Stopped:
            pass
        except Exception as error:  # told by whoever asks for the picture
            self.error = str(error)

    def is_done(self):
        return not self.thread.is_alive()

    def stop(self):
        """Returns when the scene is free. To cancel once is not enough: the call may be about to begin."""
        self.is_stopped = True
        while self.thread.is_alive():
            self.scene.cancel()
            self.thread.join(STOP_S)
