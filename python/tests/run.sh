#!/usr/bin/env bash
# Installs the package into an environment of its own, without network, and tests it there.
#   run.sh PYTHON BUILD_FOLDER BURIN
set -euo pipefail
python=$1 build=$2 program=$3
here=$(cd "$(dirname "$0")" && pwd)
package=$(dirname "$here")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "python/tests/run.sh: $1" >&2; exit 1; }

"$python" -m venv --system-site-packages "$folder/venv"
# setuptools writes beside what it builds: a copy keeps the sources as they are.
mkdir "$folder/source"
ln -s "$(dirname "$package")/CMakeLists.txt" "$folder/source/"
cp -r "$package" "$folder/source/python"
rm -rf "$folder/source/python/build" # of an earlier installation; its files would be taken for newer ones
BURIN_BUILD_FOLDER=$build "$folder/venv/bin/pip" install --quiet --no-build-isolation --no-index \
    --no-deps "$folder/source/python" || fail "it cannot be installed"

cd "$folder" # a test beside the package's sources would import these
venv=$folder/venv/bin/python
BURIN=$program "$venv" -m pytest -q -p no:cacheprovider --import-mode=importlib "$here" || fail "tests"
installed=$("$venv" -c 'import burin, os; print(os.path.dirname(burin.__file__))')
"$venv" -m mypy --strict --cache-dir "$folder/mypy" "$installed" || fail "types"
"$venv" -m mypy --strict --cache-dir "$folder/mypy" "$here/typed_calls.py" || fail "types of calls"
# Notebooks run with the package that is installed here.
"$venv" -m ipykernel install --sys-prefix --name python3 >/dev/null 2>&1 || fail "python3-ipykernel is not installed"
for notebook in "$package"/notebooks/*.ipynb; do
    "$venv" -m nbconvert --to notebook --execute --ExecutePreprocessor.timeout=300 --output-dir "$folder" "$notebook" \
        >"$folder/nbconvert" 2>&1 || { cat "$folder/nbconvert" >&2; fail "$notebook"; }
    "$venv" "$here/check_notebook.py" "$notebook" "$folder/$(basename "$notebook")" || fail "$notebook"
done
# Metaclasses of pybind11 are no part of what users see, nor how its classes without arguments are made: there must be
# no error but these, and an end as there is one when all was looked at.
"$venv" -m mypy.stubtest burin._core --ignore-missing-stub >"$folder/stubtest" 2>&1 || true
known=$(grep -c -e '^error: .* metaclass differs$' -e '^error: .*__init__ is inconsistent, stub does not have \*args' \
    "$folder/stubtest" || true)
grep -q -e "^Found $known errors\? (checked 1 module)$" -e '^Success: ' "$folder/stubtest" ||
    { cat "$folder/stubtest" >&2; fail "stubs"; }
