"""Render jobs: what is told in each, children that end in all kinds of ways, presets as files of Blender keep them."""

import os
import signal
import sys
import time

sys.path.insert(0, os.path.dirname(__file__))

import bpy

from in_blender import FOLDER, add, look_of, main, new_scene, render, told

from burin_blender import child, core, engine, presets, sheets
from burin_blender.look import Look

SHEET = ('style_version = 1\n[parameters]\nown = "{}mm"\n[[set]]\nname = "a"\nclasses = ["{}"]\nstyle = "b"\n'
         '[style.b]\nwidth = "=own"\n')


def each_job_tells_everything_once():
    scene = new_scene(32, 18)
    add("cube", "cube")
    scene.render.use_motion_blur = True
    scene.view_layers.new("second")
    scene.frame_start, scene.frame_end = 1, 3
    scene.render.filepath = str(FOLDER / "told_####")
    for job in (render, render, lambda: bpy.ops.render.render(animation=True)):
        said = told(job)[1]
        assert sum("motion blur" in text for text in said) == 1, said


def in_child(work):
    """What becomes of work() in a child: its result, or the error's text."""
    try:
        return child.work_in_child(lambda memory: work(), child.SharedMemory(8), lambda: False, lambda done: None)
    except child.ChildError as error:
        return str(error)


def progress_is_shown_as_the_child_tells_it():
    shown, told_values = [], (0.25, 0.5, 0.75)
    seen = {}

    def work(memory):
        for value in told_values:
            memory.set_progress(value)
            time.sleep(10 * child.WAIT_S)
        return "done"

    assert child.work_in_child(work, child.SharedMemory(8), lambda: False, shown.append) == "done"
    assert set(shown) <= {0, *told_values} and shown == sorted(shown), shown
    assert len(set(shown) & set(told_values)) >= 2, shown  # one may be missed where the machine is busy

    def drawn_in_child(work, memory, is_cancelled, show_progress):
        """As the engine has it done, but that each value is kept that Blender is told."""
        seen["told"] = repr(show_progress)

        def show(done):
            seen.setdefault("values", []).append(done)
            show_progress(done)

        return child.work_in_child(work, memory, is_cancelled, show)

    scene = new_scene(4096, 4096)
    scene.burin.samples = "8"
    scene.burin.threads = 1
    add("monkey", "monkey").modifiers.new("subdivided", "SUBSURF").render_levels = 4
    engine.work_in_child, original = drawn_in_child, engine.work_in_child
    try:
        bpy.ops.render.render()
    finally:
        engine.work_in_child = original
    values = seen["values"]
    assert "update_progress" in seen["told"], seen["told"]
    assert values == sorted(values) and 0 <= values[0] and values[-1] <= 1, values
    assert any(0 < value < 1 for value in values), values


def open_files():
    return len(os.listdir("/proc/self/fd"))


def children_end_in_all_kinds_of_ways():
    before = open_files()
    assert in_child(lambda: {"a": [1]}) == {"a": [1]}
    assert len(in_child(lambda: "x" * 1000000)) == 1000000
    assert in_child(lambda: 1 / 0) == "division by zero"
    assert "status 3" in in_child(lambda: os._exit(3))
    for number, name in ((signal.SIGKILL, "SIGKILL"), (signal.SIGTERM, "SIGTERM"),
                         (signal.SIGRTMIN + 3, f"signal {signal.SIGRTMIN + 3}")):
        assert f"ended by {name};" in in_child(lambda: os.kill(os.getpid(), number)), name
    assert open_files() == before


def a_dead_child_is_seen_though_its_pipe_is_open():
    """Another process, which the child has begun, lives on with it."""
    others = FOLDER / "others"

    def work():
        other = os.fork()
        if other == 0:
            time.sleep(60)
            os._exit(0)
        others.write_text(str(other))
        os.kill(os.getpid(), signal.SIGKILL)

    signal.alarm(30)  # ends Blender, should it hang
    before = open_files()
    assert "ended by SIGKILL" in in_child(work)
    signal.alarm(0)
    os.kill(int(others.read_text()), signal.SIGKILL)
    assert open_files() == before


def no_descriptor_is_left_where_there_is_no_child():
    before, original = open_files(), os.fork

    def fork():
        raise BlockingIOError("no process")

    os.fork = fork
    try:
        in_child(lambda: 0)
        raise AssertionError("no error")
    except BlockingIOError:
        pass
    finally:
        os.fork = original
    assert open_files() == before


def a_child_has_no_end_for_reading():
    assert in_child(lambda: open_files()) <= open_files() + 1


def own_folder():
    """The folder of the user's sheets, empty."""
    home = FOLDER / "home"
    folder = home / ".config/burin/styles"
    folder.mkdir(parents=True, exist_ok=True)
    for path in folder.iterdir():
        path.unlink()
    os.environ["HOME"] = str(home)
    return folder


def names_of_presets():
    return [item[0] for item in presets.sheet_items()]


def presets_have_their_numbers_for_good():
    folder = own_folder()
    sheet = new_scene().burin.sheet
    # Those of files that were made before there was any other preset.
    for number, name in enumerate(("technical", "blueprint", "comic", "patent", "wireframe", "instructions", "pencil",
                                   "architect", "strata")):
        sheet["name_of_sheet"] = number
        assert sheet.name_of_sheet == name
    (folder / "mine.toml").write_text(SHEET.format(1, "crease"))
    sheet.source, sheet.name_of_sheet = "NAME", "mine"
    number = sheet["name_of_sheet"]
    for other in ("a", "zebra"):
        (folder / f"{other}.toml").write_text(SHEET.format(1, "border"))
        assert other in names_of_presets() and sheet.name_of_sheet == "mine" and sheet["name_of_sheet"] == number
    (folder / "mine.toml").unlink()
    try:
        sheets.sheet_of(sheet)
        raise AssertionError("a preset that is not there has a sheet")
    except core.BurinError as error:
        assert "not there" in str(error)
    (folder / "mine.toml").write_text(SHEET.format(1, "crease"))
    assert sheet.name_of_sheet == "mine" and "crease" in sheets.sheet_of(sheet)


def mended_presets_are_right():
    """In the same Blender, on the same scene of the library."""
    folder = own_folder()
    path = folder / "mine.toml"
    path.write_text(SHEET.format(1, "creese"))
    scene = new_scene()
    sheet = scene.burin.sheet
    sheet.source, sheet.name_of_sheet = "NAME", "mine"
    drawing, look = core.Scene(), Look()
    try:
        look.apply(drawing, *look_of(scene, bpy.context.view_layer))
        raise AssertionError("no error")
    except core.BurinError as error:
        assert "creese" in str(error), error
    path.write_text(SHEET.format(2, "crease"))
    os.utime(path, ns=(1, 1))
    assert look.apply(drawing, *look_of(scene, bpy.context.view_layer))
    assert [p.value for p in sheets.parameters(sheet)] == [2]


def without_program(work):
    """Calls work() while only the library can be found, as if Blender had just begun."""
    original = presets.program
    presets.program = lambda: None
    presets.answers.__init__()
    try:
        return work()
    finally:
        presets.program = original
        presets.answers.__init__()


def parameters_count_without_the_program():
    own_folder()
    scene = new_scene()
    sheet, view_layer = scene.burin.sheet, bpy.context.view_layer
    sheet.source, sheet.name_of_sheet = "NAME", "technical"
    sheet.values["width"], sheet.values["color"] = 0.25, (1, 0, 0)
    lines = look_of(scene, view_layer)[0]
    assert "style.width=0.25mm" in lines and any("style.color=" in line for line in lines), lines
    again = without_program(lambda: look_of(scene, view_layer)[0])
    assert again == lines, (again, lines)
    sheet.values["odd"] = 3.0  # a script's, of which nothing is known
    add("cube", "cube")
    said = without_program(lambda: told(render)[1])
    assert sum("parameter odd" in text for text in said) == 1, said

    def reset_and_choose():
        sheets.read_parameters(sheet, keep=False)
        assert sheet.values["width"] == 0.5 and sheet.values["hidden"] == 0.6
        sheet.name_of_sheet = "comic"
        assert not sheet.values.keys()

    without_program(reset_and_choose)


def a_program_that_failed_is_asked_again():
    original = presets.answer
    presets.answer = lambda *arguments: None
    presets.answers.__init__()
    try:
        assert presets.text_of_name("technical") is None
        presets.answer = original
        for key in presets.answers.failures:
            presets.answers.failures[key] -= presets.SECONDS_TO_ASK_AGAIN
        assert "[parameters]" in presets.text_of_name("technical")
    finally:
        presets.answer = original


main([each_job_tells_everything_once, progress_is_shown_as_the_child_tells_it, children_end_in_all_kinds_of_ways,
      a_dead_child_is_seen_though_its_pipe_is_open, no_descriptor_is_left_where_there_is_no_child,
      a_child_has_no_end_for_reading,
      presets_have_their_numbers_for_good, mended_presets_are_right, parameters_count_without_the_program,
      a_program_that_failed_is_asked_again])
