"""Work in a process of its own, a fork of Blender: whatever happens there, Blender lives on.

The child has all that was gathered without a copy, and writes what it makes into memory that both share. It is killed
when the user stops the render, and when Blender ends. See docs/decisions/0030-blender-renders-in-a-fork.md."""

import ctypes
import gc
import json
import mmap
import os
import select
import signal
import struct

WAIT_S = 0.03  # between two looks at whether the user has stopped the render
PR_SET_PDEATHSIG = 1


class Cancelled(Exception):
    """The user has stopped the render."""


class ChildError(Exception):
    """The child has failed; the text says why."""


class SharedMemory:
    """Memory that a child of a fork shares: a number for its progress, and bytes for what it makes."""

    HEAD = 64

    def __init__(self, byte_count):
        self.memory = mmap.mmap(-1, self.HEAD + byte_count)
        self.begin = self.HEAD

    def set_progress(self, done):
        struct.pack_into("d", self.memory, 0, done)

    def progress(self):
        return struct.unpack_from("d", self.memory, 0)[0]


def leave_blender(parent):
    """Makes this process a renderer: no signal handler of Blender's runs (that for crashes writes a file), a Ctrl-C in
    the terminal is for Blender alone, and the system kills this process when the thread that made it ends."""
    libc = ctypes.CDLL(None)
    for number in (signal.SIGSEGV, signal.SIGABRT, signal.SIGBUS, signal.SIGFPE, signal.SIGILL):
        libc.signal(number, None)
    os.setsid()
    libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)
    if os.getppid() != parent:
        os._exit(1)


def run_child(parent, writer, work, memory):
    """What the child does; it never returns into Blender's code."""
    status = 1
    try:
        gc.disable()  # nothing of Blender's is to be freed here
        leave_blender(parent)
        try:
            said = {"result": work(memory)}
        except BaseException as error:
            said = {"error": str(error) or type(error).__name__}
        data = json.dumps(said).encode()
        while data:
            data = data[os.write(writer, data):]
        status = 0
    finally:
        os._exit(status)


def end_of(pid):
    """Waits for a child that has ended or is about to. Gives its wait status."""
    return os.waitpid(pid, 0)[1]


def work_in_child(work, memory, is_cancelled, show_progress):
    """Calls work(memory) in a child, and gives its result, which must be one that JSON has. Throws Cancelled, once
    is_cancelled() is true, and ChildError."""
    reader, writer = os.pipe()
    parent = os.getpid()
    pid = os.fork()
    if pid == 0:
        run_child(parent, writer, work, memory)
    os.close(writer)
    is_over = False
    try:
        data = b""
        while True:
            if is_cancelled():
                raise Cancelled()
            if not select.select([reader], [], [], WAIT_S)[0]:
                show_progress(memory.progress())
                continue
            part = os.read(reader, 65536)
            if not part:
                break
            data += part
        is_over = True
    finally:
        os.close(reader)
        if not is_over:
            os.kill(pid, signal.SIGKILL)
        status = end_of(pid)
    if os.WIFSIGNALED(status):
        name = signal.Signals(os.WTERMSIG(status)).name
        why = "there may be too little memory" if name == "SIGKILL" else "please report this"
        raise ChildError(f"the renderer was ended by {name}; {why}")
    if not data:
        raise ChildError(f"the renderer ended with status {os.WEXITSTATUS(status)} and no result; please report this")
    said = json.loads(data)
    if "error" in said:
        raise ChildError(said["error"])
    return said["result"]
