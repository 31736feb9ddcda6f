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


def name_of_signal(number):
    """Real-time signals have no names."""
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


def wait_status(pid, options=0):
    """The wait status of a child that has ended, or, without WNOHANG, is about to; None: it has not. Who else has
    waited for it has taken its status, which is 0 then."""
    try:
        ended, status = os.waitpid(pid, options)
    except ChildProcessError:
        return 0
    return status if ended == pid else None


def fork(work, memory):
    """Begins a child. Gives its number and the descriptor from which its result is read."""
    reader, writer = os.pipe()
    try:
        parent = os.getpid()
        pid = os.fork()
        if pid == 0:
            os.close(reader)
            run_child(parent, writer, work, memory)
    except OSError:  # there can be no other process
        os.close(reader)
        raise
    finally:
        os.close(writer)
    return pid, reader


def work_in_child(work, memory, is_cancelled, show_progress):
    """Calls work(memory) in a child, and gives its result, which must be one that JSON has. Throws Cancelled, once
    is_cancelled() is true, and ChildError."""
    pid, reader = fork(work, memory)
    data, status, is_over = b"", None, False
    try:
        while True:
            if is_cancelled():
                raise Cancelled()
            if select.select([reader], [], [], WAIT_S)[0]:
                part = os.read(reader, 65536)
                if not part:
                    break
                data += part
            elif status is not None:  # all is read; another process may still have the other end of the pipe
                break
            else:
                show_progress(memory.progress())
                status = wait_status(pid, os.WNOHANG)
        is_over = True
    finally:
        os.close(reader)
        if status is None:
            if not is_over:
                os.kill(pid, signal.SIGKILL)
            status = wait_status(pid)
    return result_of(data, status)


def result_of(data, status):
    """What a child has made, by what it wrote and its wait status."""
    if os.WIFSIGNALED(status):
        name = name_of_signal(os.WTERMSIG(status))
        why = "there may be too little memory" if name == "SIGKILL" else "please report this"
        raise ChildError(f"the renderer was ended by {name}; {why}")
    if not data:
        raise ChildError(f"the renderer ended with status {os.WEXITSTATUS(status)} and no result; please report this")
    said = json.loads(data)
    if "error" in said:
        raise ChildError(said["error"])
    return said["result"]
