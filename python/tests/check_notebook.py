"""Checks a notebook as it is committed, and the same one executed: check_notebook.py COMMITTED EXECUTED."""

import base64
import json
import sys

committed, executed = (json.load(open(path, encoding="utf-8")) for path in sys.argv[1:])


def outputs(notebook):
    return [output for cell in notebook["cells"] for output in cell.get("outputs", [])]


def fail(text):
    sys.exit(f"{sys.argv[1]}: {text}")


if outputs(committed) or any(cell.get("execution_count") for cell in committed["cells"]):
    fail("has outputs; take them away: jupyter nbconvert --clear-output --inplace")
pictures = [o["data"]["image/png"] for o in outputs(executed) if "image/png" in o.get("data", {})]
if not pictures or not all(base64.b64decode(p).startswith(b"\x89PNG\r\n\x1a\n") for p in pictures):
    fail("shows no picture")
