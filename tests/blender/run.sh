#!/usr/bin/env bash
# The add-on in Debian's Blender, without a display.
#   run.sh BURIN [CHECK...]
# CHECK: cameras, layers, objects, frames ...; all unless named.
# Without Blender the test fails: scripts/install-dependencies installs it.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
burin=$(realpath "$1")
shift
checks=("$@")
[ ${#checks[@]} -gt 0 ] || checks=(layers objects shown jobs frames cameras panels line_sets viewport)

run=$(mktemp -d)
trap 'rm -rf "$run"' EXIT
# Nothing of the user's takes part, and nothing is written into the source.
mkdir -p "$run/scripts/addons" "$run/config" "$run/files"
ln -s "$here/../../blender/burin_blender" "$run/scripts/addons/burin_blender"
export BLENDER_USER_SCRIPTS=$run/scripts BLENDER_USER_CONFIG=$run/config XDG_CONFIG_HOME=$run/config
export PYTHONDONTWRITEBYTECODE=1 BURIN=$burin BURIN_PROGRAM=$burin BURIN_TEST_FOLDER=$run/files
export PATH=/usr/bin:$PATH # the system's Blender looks for its Python by the one in PATH
unset DISPLAY WAYLAND_DISPLAY BURIN_STYLES

for check in "${checks[@]}"; do
    echo "== $check"
    if grep -q "Needs a display" "$here/$check.py"; then
        LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 900x700x24" blender --factory-startup --window-geometry 0 0 \
            900 700 --addons burin_blender -P "$here/$check.py" >"$run/said" 2>&1 ||
            { cat "$run/said"; echo "$check: FAILED"; exit 1; }
        grep -a "PASSED" "$run/said"
        if grep -q "Traceback" "$run/said"; then # panels and handlers print their errors, and Blender goes on
            cat "$run/said"; echo "$check: FAILED"; exit 1
        fi
    elif grep -q "^from in_blender import" "$here/$check.py"; then
        blender -b --factory-startup --python-exit-code 9 --addons burin_blender -P "$here/$check.py" >"$run/said" 2>&1 ||
            { cat "$run/said"; echo "$check: FAILED"; exit 1; }
        grep -a "PASSED\|offset" "$run/said"
    else
        mkdir "$run/$check"
        /usr/bin/python3 "$here/$check.py" "$run/$check"
    fi
done
echo "OK"
