"""Libraries that are there in place of Burin's: too old ones, and ones that crash, or take for ever, when they draw."""

import pathlib
import re
import subprocess

SOURCE = pathlib.Path(__file__).resolve().parents[2]


def make_stub(folder, abi, when_drawing):
    """Compiles libburin.so.0 into a folder. `when_drawing`: statements in C. Gives the folder."""
    folder.mkdir()
    names = re.findall(r'"(burin_\w+)": \(', (SOURCE / "blender/burin_blender/interface.py").read_text())
    assert len(names) > 10, names
    code = ["#include <fcntl.h>", "#include <stdlib.h>", "#include <unistd.h>",
            f"int burin_abi(void) {{ return {abi}; }}", 'const char* burin_version(void) { return "0.0.7"; }',
            f"void* burin_scene_new(void) {{ {when_drawing} return 0; }}"]
    code += [f"void* {name}(void) {{ return 0; }}" for name in names if name != "burin_scene_new"]
    subprocess.run(["cc", "-shared", "-fPIC", "-w", "-o", str(folder / "libburin.so.0"), "-x", "c", "-"],
                   input="\n".join(code), text=True, check=True)
    return folder
