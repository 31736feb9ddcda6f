"""Finds and loads libburin.so.0, and says what is wrong with it."""

import ctypes
import glob
import os
import shutil

SONAME = "libburin.so.0"
NEEDED_ABI = 6  # BURIN_ABI of the burin.h that interface.py is written after
VERSION = "0.1.0"  # of the add-on

_loaded = None


class LibraryError(Exception):
    """There is no library that this add-on can use; the text says why, and what to do."""


def folder_beside(program):
    """Where the library of an installed or built program may lie, the nearest place first."""
    folder = os.path.dirname(os.path.realpath(program))
    yield folder
    for lib in sorted(glob.glob(os.path.join(os.path.dirname(folder), "lib", "*-linux-gnu*"))):
        yield lib
    for lib in ("lib", "lib64"):
        yield os.path.join(os.path.dirname(folder), lib)


def library_of(named):
    """The library that a name given by the user stands for: itself, or a program or folder that has it beside it."""
    if os.path.isdir(named):
        named = os.path.join(named, "burin")
    elif os.path.isfile(named) and ".so" in os.path.basename(named):
        return named
    elif os.path.sep not in named:
        named = shutil.which(named) or named
    for folder in folder_beside(named):
        if os.path.isfile(os.path.join(folder, SONAME)):
            return os.path.join(folder, SONAME)
    return None


def find_library(preference=""):
    """The path of the library: that of the add-on's preference, of $BURIN, of the program `burin` in PATH, or one
    beside the add-on; else its name alone, for the system to find. What is named must be there."""
    of_environment = os.environ.get("BURIN", "")
    for named, of_what in ((preference, "the add-on's preferences name"), (of_environment, "$BURIN names")):
        if named:
            path = library_of(os.path.expanduser(named))
            if path is None:
                raise LibraryError(f"{of_what} {named}, but there is no {SONAME} beside it")
            return path
    program = shutil.which("burin")
    path = library_of(program) if program else None
    if path is not None:
        return path
    here = os.path.dirname(os.path.realpath(__file__))
    prefix = os.path.join(here, "..", "..", "..", "..")  # of share/burin/blender/burin_blender
    installed = [path for folder in ("lib*", os.path.join("lib", "*"))
                 for path in sorted(glob.glob(os.path.join(prefix, folder, SONAME)))]
    for path in [os.path.join(here, SONAME), os.path.join(here, "..", SONAME), *installed]:
        if os.path.isfile(path):
            return os.path.realpath(path)
    return SONAME


def check_version(library, path):
    """Refuses a library that is older than the add-on, and names both."""
    try:
        library.burin_version.restype = ctypes.c_char_p
        version, abi = library.burin_version().decode(), library.burin_abi()
    except AttributeError:
        raise LibraryError(f"{path} is no library of Burin")
    if abi < NEEDED_ABI:
        raise LibraryError(f"the add-on {VERSION} needs interface {NEEDED_ABI} of the library, but {path} is Burin "
                           f"{version} with interface {abi}; install the two from the same version")


def load_library(preference=""):
    """The library, loaded once in a process: another preference counts from the next start of Blender."""
    global _loaded
    if _loaded is None:
        path = find_library(preference)
        try:
            library = ctypes.CDLL(path)
        except OSError as error:
            raise LibraryError(f"Burin's library cannot be loaded ({error}); install Burin, or set its program in the "
                               "add-on's preferences or in $BURIN")
        check_version(library, path)
        _loaded = library
    return _loaded
