"""Scenes among threads, signals, and at the end of the interpreter."""

import subprocess
import sys
import threading

import pytest

import burin


def box():
    scene = burin.Scene()
    scene.add_text("[[object]]\nshape = 'box'\n")
    return scene


def test_other_threads_run_and_may_cancel():
    scene = box()
    ran = []

    def cancel():
        ran.append(1)
        scene.cancel()

    with pytest.raises(burin.Cancelled):
        for _ in range(20):
            timer = threading.Timer(0.02, cancel)
            timer.start()
            try:
                scene.render((16000, 16000), layers="lines")
            finally:
                timer.cancel()
                timer.join()
    assert ran


def test_ctrl_c_is_a_keyboard_interrupt(tmp_path):
    script = tmp_path / "long.py"
    script.write_text(
        "import burin, numpy as np, os, signal, threading\n"
        "scene = burin.Scene((np.random.default_rng(1).random((3000, 3)), np.arange(3000).reshape(-1, 3)))\n"
        "threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()\n"
        "try:\n"
        "    while True: scene.render((6000, 6000), layers='lines')\n"
        "except KeyboardInterrupt: print('interrupted')\n"
    )
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=120)
    assert done.stdout == "interrupted\n", done.stderr


def test_a_scene_is_used_by_one_call_at_a_time():
    scene = box()
    refused = []

    def shade(columns, ink):
        for call in (scene.render, scene.clear, lambda: scene.add_line_shader("s", ["depth"], shade)):
            try:
                call()
            except burin.UsageError as error:
                refused.append(str(error))

    scene.add_line_shader("s", ["depth"], shade)
    scene.set_style("[style.a]\nshader = 's'\n[[set]]\nname = 's'\nclasses = ['crease']\nstyle = 'a'\n")
    scene.render((160, 120))
    assert refused and len(refused) % 3 == 0 and all("one call at a time" in text for text in refused)

    whole = scene.render((160, 120)).png()
    done = []

    def draw():
        for _ in range(20):
            try:
                done.append(scene.render((160, 120)).png() == whole)
            except burin.UsageError as error:
                assert "one call at a time" in str(error)

    threads = [threading.Thread(target=draw) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert done and all(done)


def test_threads_that_draw_end_with_the_interpreter(tmp_path):
    script = tmp_path / "daemon.py"
    script.write_text(
        "import burin, numpy as np, threading, time\n"
        "scene = burin.Scene((np.random.default_rng(1).random((3000, 3)), np.arange(3000).reshape(-1, 3)))\n"
        "def draw():\n"
        "    while True: scene.render((900, 900), threads=1, progress=lambda done: False)\n"
        "threading.Thread(target=draw, daemon=True).start()\n"
        "time.sleep(0.3)\n"
    )
    for _ in range(5):
        done = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=60)
        assert done.returncode == 0, done.stderr
