#!/usr/bin/env bash
# Installs a build into a temporary folder, moves it, and has programs that were built against it draw a cube.
#   install_test.sh BUILD_FOLDER SOURCE_FOLDER
set -euo pipefail
build=$1 page=$2/docs/library.md shaders=$2/docs/shading/native-shaders.md
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "install_test: $1" >&2; exit 1; }

cmake --install "$build" --prefix "$folder/first" >"$folder/log" || { cat "$folder/log" >&2; fail "it cannot be installed"; }
prefix=$folder/prefix
mv "$folder/first" "$prefix" # nothing may depend on where it was
library=$(find "$prefix" -name 'libburin.so.0')
[ -n "$library" ] || fail "there is no libburin.so.0"

# Nothing but the interface is to be seen.
others=$(nm -D --defined-only "$library" | awk '$2 != "W" && $2 != "V" && $3 !~ /^burin_/ { print $3 }')
[ -z "$others" ] || fail "the library shows $others"
functions=$(sed -n '/^BURIN_API/,/;/p' "$prefix/include/burin/burin.h" | grep -o 'burin_[a-z_]*(' | tr -d '(' | sort -u)
[ "$(wc -w <<<"$functions")" -ge 25 ] || fail "the header declares too little"
for name in $functions; do
    nm -D --defined-only "$library" | grep -q " $name\$" || fail "the library lacks $name"
done

# The examples of the page are the programs: find_package(burin) finds it.
source=$folder/source
mkdir "$source"
block() { awk -v kind="$1" '$0 == "```" { on = 0 } on { print } $0 == "```" kind { on = 1 }' "$2"; }
block c "$page" >"$source/cube.c"
block cpp "$page" >"$source/cube.cpp"
block cmake "$page" >"$source/CMakeLists.txt"
# A line shader, from the page of them.
block cpp "$shaders" >"$source/shaded.cpp"
block c "$shaders" >"$source/halve.c"
echo 'add_executable(shaded shaded.cpp halve.c)
target_link_libraries(shaded PRIVATE burin::burin)' >>"$source/CMakeLists.txt"
{ cmake -S "$source" -B "$folder/cube" -DCMAKE_PREFIX_PATH="$prefix" && cmake --build "$folder/cube"; } >"$folder/log" 2>&1 || { cat "$folder/log" >&2; fail "find_package"; }
"$folder/cube/cube_c" "$folder/c.png"
"$folder/cube/cube_cpp" "$folder/cpp.png"
"$folder/cube/shaded" "$folder/shaded.png" 2>"$folder/notes"
[ ! -s "$folder/notes" ] || fail "the line shader: $(cat "$folder/notes")"
size() { od -An -tx1 -j16 -N8 "$1"; } # of a PNG, as its header has it
[ "$(size "$folder/shaded.png")" = "$(size "$2/docs/pictures/shading/shaded.png")" ] || fail "the page of line shaders shows another size"

# pkg-config, and a header that a strict C compiler takes.
if command -v pkg-config >/dev/null; then
    export PKG_CONFIG_PATH=${library%/*}/pkgconfig
    # shellcheck disable=SC2046
    cc -std=c99 -pedantic-errors -Wall -Wextra -Wno-missing-field-initializers -Werror "$source/cube.c" $(pkg-config --cflags --libs burin) -o "$folder/cube_pc"
    # shellcheck disable=SC2046
    cc -std=c99 -pedantic-errors -Wall -Wextra -Werror -c "$source/halve.c" -o "$folder/halve.o" $(pkg-config --cflags burin)
    LD_LIBRARY_PATH=${library%/*} "$folder/cube_pc" "$folder/pc.png"
    cmp "$folder/c.png" "$folder/pc.png" || fail "pkg-config: another picture"
fi

# The program that was installed with it draws the same.
cat >"$folder/cube.obj" <<'END'
o cube
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
END
"$prefix/bin/burin" render -q "$folder/cube.obj" --size 320x240 --set lines.width=2 -o "$folder/program.png"
for picture in c cpp; do cmp "$folder/$picture.png" "$folder/program.png" || fail "cube_$picture: another picture than the program's"; done

# A line shader draws what expressions draw.
cat >"$folder/shaded.toml" <<'END'
[[set]]
name = "inner"
classes = ["crease"]
style = "inner"
[[set]]
name = "outline"
classes = ["silhouette", "border"]
style = "ink"
[let]
far = "=depth - 2"
[style.ink]
width = "=4 * (1.5 - far)"
color = "=rgb(1 - far, 0, far)"
taper = { start = 12, end = 12 }
[style.inner]
base = "ink"
opacity = "=1 - (N.x * N2.x + N.y * N2.y + N.z * N2.z)"
END
"$prefix/bin/burin" render -q "$folder/cube.obj" --size 320x240 --style "$folder/shaded.toml" -o "$folder/program_shaded.png"
cmp "$folder/shaded.png" "$folder/program_shaded.png" || fail "the line shader: another picture than that of expressions"

# Modules are found from the program and from the library, wherever the caller is.
"$prefix/bin/burin" render -q "$folder/cube.obj" --size 320x240 --set lines.width=2 -o "$folder/program.tif"
(cd / && "$folder/cube/cube_c" "$folder/c.tif")
cmp "$folder/c.tif" "$folder/program.tif" || fail "another TIFF than the program's"
echo "install_test: all is well"
