"""blender -b as a render farm uses it: frames, exit status, what is left when a render fails or is stopped.

    frames.py FOLDER

FOLDER is empty; the environment is that of run.sh.
"""

import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

import OpenImageIO as oiio

from stub_library import SOURCE, make_stub

FOLDER = pathlib.Path(sys.argv[1])
MARK = f"BURIN_FRAMES_TEST={os.getpid()}"
SCENE = FOLDER / "s.blend"

MAKE_SCENE = '''
import bpy, math
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
bpy.ops.mesh.primitive_monkey_add(size=2)
monkey = bpy.context.object
for frame, angle in ((1, 0), (4, 1.5)):
    monkey.rotation_euler = (0, 0, angle)
    monkey.keyframe_insert("rotation_euler", frame=frame)
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
scene.collection.objects.link(camera)
camera.location, camera.rotation_euler = (0, -6, 0), (math.pi / 2, 0, 0)
scene.camera = camera
scene.render.resolution_x, scene.render.resolution_y = 96, 64
scene.frame_start, scene.frame_end = 2, 4
bpy.ops.wm.save_as_mainfile(filepath=PATH)
'''


def start(*arguments, **environment):
    env = dict(os.environ, **environment)
    env[MARK.split("=")[0]] = MARK.split("=")[1]
    return subprocess.Popen(["blender", "-b", "--factory-startup", *map(str, arguments)], env=env, text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def blender(*arguments, **environment):
    """Runs Blender to its end. Gives its exit status and what it said."""
    process = start(*arguments, **environment)
    said = process.communicate(timeout=300)[0]
    return process.returncode, said


def left_processes():
    """Processes of this test's Blenders that still run."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        try:
            if entry.name.isdigit() and MARK.encode() in (entry / "environ").read_bytes().split(b"\0"):
                found.append(entry.name)
        except OSError:
            pass
    return found


SHARED = pathlib.Path("/dev/shm")
SHARED_BEFORE = set(SHARED.iterdir())


def left_shared_memory():
    """Files that have come into /dev/shm and that no process has mapped or open, as those of other programs are."""
    new = {str(path) for path in set(SHARED.iterdir()) - SHARED_BEFORE}
    for entry in pathlib.Path("/proc").iterdir() if new else ():
        try:
            if entry.name.isdigit():
                used = {os.readlink(fd) for fd in (entry / "fd").iterdir()}
                new -= used | {line.split()[-1] for line in (entry / "maps").read_text().splitlines()}
        except OSError:
            pass
    return sorted(path for path in new if os.path.exists(path))


def nothing_is_left(name):
    """No file, no process, no shared memory; a process that was killed may take a moment."""
    for _ in range(100):
        if not left_processes():
            break
        time.sleep(0.1)
    assert not left_processes(), (name, left_processes())
    files = [p.name for p in (FOLDER / name).iterdir() if not p.is_dir()]
    assert not files, (name, files)
    assert not left_shared_memory(), (name, left_shared_memory())


def frames(name, *what, **environment):
    """Renders into a folder of its own."""
    folder = FOLDER / name
    folder.mkdir()
    arguments = ["--addons", "burin_blender", SCENE, "-E", "BURIN", "-o", f"{folder}/####", "-F", "PNG", *what]
    return arguments, environment


def run_frames(name, *what, **environment):
    arguments, environment = frames(name, *what, **environment)
    return blender(*arguments, **environment)


def pixels_of(path):
    file = oiio.ImageInput.open(str(path))
    assert file, oiio.geterror()
    values = file.read_image("uint8").tobytes()
    file.close()
    return values


def pictures(name):
    """The pixels of a folder's files; the files have the time within."""
    return {p.name: pixels_of(p) for p in sorted((FOLDER / name).iterdir())}


def make_scene():
    status, said = blender("--python-exit-code", "9", "--python-expr", MAKE_SCENE.replace("PATH", repr(str(SCENE))))
    assert status == 0 and SCENE.exists(), said


def frames_are_files():
    status, said = run_frames("range", "-f", "1..3")
    assert status == 0 and "Error" not in said, said
    first = pictures("range")
    assert list(first) == ["0001.png", "0002.png", "0003.png"] and len(set(first.values())) == 3, list(first)
    status, said = run_frames("animation", "-a")
    assert status == 0, said
    again = pictures("animation")
    assert list(again) == ["0002.png", "0003.png", "0004.png"], list(again)
    assert again["0002.png"] == first["0002.png"] and again["0003.png"] == first["0003.png"]


def failures_end_with_status_1():
    """No picture, no process, a message; the next frames are not tried with -a."""
    old, faulty = make_stub(FOLDER / "lib-old", 1, ""), make_stub(FOLDER / "lib-fault", 99, "*(volatile int*)8 = 1;")
    for name, library, messages in (
            ("old", old, ("needs interface", "Burin 0.0.7 with interface 1")),
            ("fault", faulty, ("SIGSEGV",)),
            ("missing", FOLDER / "nothing", ("no libburin.so.0 beside it",))):
        status, said = run_frames(name, "-a", BURIN=str(library))
        assert status == 1 and all(message in said for message in messages), (name, status, said)
        assert "Fra:3" not in said, (name, said)
        nothing_is_left(name)
    assert not (FOLDER / "s.crash.txt").exists()  # Blender's own handler of crashes has not run


def wait_until_it_draws(process, mark):
    """Until Blender's child has made a file: others of its children draw nothing."""
    for _ in range(600):
        if mark.exists():
            return
        assert process.poll() is None, process.communicate()
        time.sleep(0.1)
    raise AssertionError("no child that draws")


def interrupts_stop_at_once():
    mark = FOLDER / "draws"
    library = make_stub(FOLDER / "lib-slow", 99, f'close(creat("{mark}", 0600)); for (;;) sleep(1000);')
    for name, number, status in (("sigint", signal.SIGINT, 1), ("sigkill", signal.SIGKILL, -9)):
        arguments, environment = frames(name, "-a", BURIN=str(library))
        process = start(*arguments, **environment)
        wait_until_it_draws(process, mark)
        mark.unlink()
        begin = time.monotonic()
        process.send_signal(number)
        process.communicate(timeout=60)  # the child would take for ever
        print(f"{name}: {time.monotonic() - begin:.2f} s")
        assert process.returncode == status, (name, process.returncode)
        nothing_is_left(name)


def python_package_is_no_matter():
    """A Python package `burin` in the way, as the project's own may be installed."""
    other = FOLDER / "packages"
    (other / "burin").mkdir(parents=True)
    (other / "burin" / "__init__.py").write_text("raise ImportError('the add-on is not to use this package')\n")
    folder = FOLDER / "package"
    folder.mkdir()
    status, said = blender("--python-use-system-env", "--addons", "burin_blender", SCENE, "-E", "BURIN", "-o",
                           f"{folder}/####", "-F", "PNG", "-f", "1", PYTHONPATH=str(other))
    assert status == 0 and pictures("package")["0001.png"] == pictures("range")["0001.png"], said


def zip_is_installed():
    """The file that scripts/blender-addon makes, into a Blender that has no add-on."""
    archive, scripts, folder = FOLDER / "burin_blender.zip", FOLDER / "scripts", FOLDER / "zip"
    (scripts / "addons").mkdir(parents=True)
    folder.mkdir()
    subprocess.run([SOURCE / "scripts" / "blender-addon", archive], check=True, stdout=subprocess.DEVNULL)
    steps = (f"import bpy; bpy.ops.preferences.addon_install(filepath={str(archive)!r}); "
             "bpy.ops.preferences.addon_enable(module='burin_blender')")
    status, said = blender(SCENE, "--python-exit-code", "9", "--python-expr", steps, "-E", "BURIN", "-o",
                           f"{folder}/####", "-F", "PNG", "-f", "1", BLENDER_USER_SCRIPTS=str(scripts))
    assert status == 0 and (scripts / "addons" / "burin_blender" / "engine.py").exists(), said
    assert pictures("zip")["0001.png"] == pictures("range")["0001.png"], said


def stamps_are_burned_in():
    folder = FOLDER / "stamped"
    folder.mkdir()
    status, said = blender("--addons", "burin_blender", SCENE, "-E", "BURIN", "--python-expr",
                           "import bpy; r = bpy.context.scene.render; r.use_stamp = r.use_stamp_note = True; "
                           "r.stamp_note_text = 'noted'", "-o", f"{folder}/####", "-F", "PNG", "-f", "1")
    assert status == 0, said
    assert b"noted" in (folder / "0001.png").read_bytes()
    assert pictures("stamped")["0001.png"] != pictures("range")["0001.png"]


def library_is_found():
    """The preference, $BURIN, PATH, beside the add-on, an installed tree, the system: in this order."""
    tree = FOLDER / "tree"
    addon = tree / "share/burin/blender/burin_blender"
    addon.mkdir(parents=True)
    shutil.copy(SOURCE / "blender/burin_blender/library.py", addon)
    code = ("import importlib.util as u, sys; s = u.spec_from_file_location('library', sys.argv[1]); "
            "m = u.module_from_spec(s); s.loader.exec_module(m); print(m.find_library(sys.argv[2]))")

    def found(preference="", **environment):
        env = {"PATH": "/nothing", **environment}
        done = subprocess.run([sys.executable, "-c", code, addon / "library.py", preference], env=env, check=True,
                              capture_output=True, text=True)
        return done.stdout.strip()

    def put(*places):
        for place in places:
            (tree / place).parent.mkdir(parents=True, exist_ok=True)
            (tree / place).touch(mode=0o755)
        return str(tree / places[-1])

    assert found() == "libburin.so.0"
    for place in ("lib/x86_64-linux-gnu", "lib", "share/burin/blender/burin_blender"):
        beside = put(f"{place}/libburin.so.0")
        assert found() == beside
    in_path = put("path/bin/burin", "path/lib/x86_64-linux-gnu/libburin.so.0")
    assert found(PATH=str(tree / "path/bin")) == in_path
    named = put("named/burin", "named/libburin.so.0")
    assert found(PATH=str(tree / "path/bin"), BURIN=str(tree / "named/burin")) == named
    preferred = put("preferred/libburin.so.0")
    for preference in ("preferred/libburin.so.0", "preferred", "preferred/burin"):
        assert found(str(tree / preference), BURIN=str(tree / "named/burin")) == preferred


for check in (library_is_found, make_scene, frames_are_files, failures_end_with_status_1, interrupts_stop_at_once,
              python_package_is_no_matter, zip_is_installed, stamps_are_burned_in):
    check()
    print(f"PASSED {check.__name__}", flush=True)
