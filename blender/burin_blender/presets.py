"""Style sheets that can be had by name: those that come with the program, and the user's."""

import functools
import json
import math
import os
import shutil
import subprocess
import time
import zlib

from . import core, library

# A file of Blender has a preset by its number. These have their places here as numbers, for good; all others, those of
# later versions, too, have numbers that follow from their names.
NUMBERED = ("technical", "blueprint", "comic", "patent", "wireframe", "instructions", "pencil", "architect", "strata")
BUILT_IN = NUMBERED  # sheets of the program, for when the program itself is not there
FIRST_OF_NAMES = 1 << 30
SECONDS_TO_ANSWER, SECONDS_TO_ASK_AGAIN = 10, 2


def program():
    """The path of the program `burin` that belongs to the library, or None: some things only the program tells."""
    named = [core.preference(), os.environ.get("BURIN", ""), shutil.which("burin") or ""]
    try:
        folder = os.path.dirname(os.path.realpath(library.find_library(core.preference())))
        named += [os.path.join(folder, *up, "burin") for up in ((), ("..", "bin"), ("..", "..", "bin"))]
    except library.LibraryError:
        pass
    for path in named:
        path = os.path.join(path, "burin") if os.path.isdir(path) else path
        if os.path.isfile(path) and ".so" not in os.path.basename(path) and os.access(path, os.X_OK):
            return path
    return None


def answer(*arguments):
    """What the program prints, or None."""
    path = program()
    if path is None:
        return None
    # Blender's own settings for Python are none of the program's business.
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    try:
        done = subprocess.run([path, *arguments], capture_output=True, env=environment, stdin=subprocess.DEVNULL,
                              timeout=SECONDS_TO_ANSWER)
    except (OSError, subprocess.TimeoutExpired):
        return None
    return done.stdout.decode(errors="replace") if done.returncode == 0 else None


class Answers:
    """What the program has said. What it could not say it is asked again after a while."""

    def __init__(self):
        self.texts = {}  # arguments and state: text
        self.failures = {}  # the same: when

    def text(self, *arguments, state=()):
        """What the program prints, or None. `state`: what its answer depends on."""
        key = (arguments, state)
        is_too_early = time.monotonic() - self.failures.get(key, -math.inf) < SECONDS_TO_ASK_AGAIN
        if key not in self.texts and not is_too_early:
            text = answer(*arguments)
            if text is None:
                self.failures[key] = time.monotonic()
            else:
                self.texts[key] = text
        return self.texts.get(key)


answers = Answers()


def own_folders():
    """The folders with the user's sheets, in the order in which the library looks into them."""
    home = os.environ.get("HOME", "")
    folders = [os.path.join(home, ".config/burin/styles")] if home else []
    return folders + [folder for folder in os.environ.get("BURIN_STYLES", "").split(":") if folder]


def own_files():
    """The user's sheets: path by name."""
    found = {}
    for folder in own_folders():
        try:
            names = sorted(os.listdir(folder))
        except OSError:
            continue
        for name in names:
            stem, suffix = os.path.splitext(name)
            if suffix == ".toml" and stem not in BUILT_IN:
                found.setdefault(stem, os.path.join(folder, name))
    return found


def time_of_change(path):
    try:
        return os.stat(path).st_mtime_ns
    except OSError:
        return 0


def number_of(name):
    """A preset's number in files of Blender."""
    return NUMBERED.index(name) if name in NUMBERED else FIRST_OF_NAMES | zlib.crc32(name.encode()) % FIRST_OF_NAMES


@functools.lru_cache(maxsize=None)  # Blender wants the texts of an EnumProperty to live on
def items_of(listed, own_names):
    """The items of presets: what the program lists, and the user's sheets that it leaves out as wrong."""
    try:
        summaries = {s["name"]: s["summary"] for s in json.loads(listed)["styles"]}
    except (KeyError, TypeError, ValueError):
        summaries = dict.fromkeys(BUILT_IN, "")
    for name in own_names:
        summaries.setdefault(name, "")
    by_number = {}
    for name, summary in summaries.items():
        by_number.setdefault(number_of(name), (name, name.replace("_", " ").title(), summary, number_of(name)))
    return list(by_number.values())


def sheet_items():
    """For an EnumProperty: the sheets that can be had by name."""
    own = own_files()
    state = tuple((path, time_of_change(path)) for path in own.values())
    return items_of(answers.text("styles", "--json", state=state), tuple(own))


@functools.lru_cache(maxsize=8)
def text_of_file(path, changed):
    """The text of a file, read again when it has changed."""
    with open(path, encoding="utf-8") as file:
        return file.read()


def text_of_name(name):
    """The text of a sheet that can be had by name; None if the program is not there to tell it."""
    path = own_files().get(name)
    if path is None:
        return answers.text("styles", name) if name else None
    try:
        return text_of_file(path, time_of_change(path))
    except (OSError, UnicodeDecodeError):
        return None
