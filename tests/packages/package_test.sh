#!/usr/bin/env bash
# Packages a build, installs the packages into a root of its own, which is this machine's with a layer above it, and
# uses them there as people do. Needs root, for the layer.
#   package_test.sh BUILD_FOLDER SOURCE_FOLDER
set -euo pipefail
build=$1 source=$2
skipped=77
fail() { echo "package_test: $1" >&2; exit 1; }
[ "$(id -u)" -eq 0 ] || { echo "package_test: only root can make the layer"; exit $skipped; }
grep -q '^CMAKE_INSTALL_PREFIX:.*=/usr$' "$build/CMakeCache.txt" || { echo "package_test: $build is not of the preset ci"; exit $skipped; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$source/scripts/package" --build-folder "$build" --output "$folder/packages" >"$folder/complaints" || { cat "$folder/complaints"; fail "they cannot be built"; }
# What lintian says stands above the list of packages.
[ "$(wc -l <"$folder/complaints")" -eq 6 ] || fail "lintian: $(cat "$folder/complaints")"

cat >"$folder/in_root" <<'END'
set -euo pipefail
fail() { echo "package_test: $1" >&2; exit 1; }
mount -t tmpfs layer "$1/layer"
mkdir "$1/layer/upper" "$1/layer/work"
mount -t overlay root -o "lowerdir=/,upperdir=$1/layer/upper,workdir=$1/layer/work" "$1/root"
for kernel in proc dev sys; do mount --rbind /$kernel "$1/root/$kernel"; done
mkdir -p "$1/root/tmp/packages"
cp "$1"/packages/*.deb "$2/debian/tests/draw" "$2/tests/packages/bash_completion.sh" "$1/root/tmp/packages"
here() { env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 chroot "$1/root" "${@:2}"; }
for name in burin libburin.so.0; do ! find "$1/root/usr/bin" "$1/root/usr/lib" -name "$name" | grep . || fail "$name is there before it is installed"; done

here "$1" sh -c 'dpkg --install /tmp/packages/*.deb' >"$1/log" 2>&1 || { cat "$1/log" >&2; fail "they cannot be installed"; }
here "$1" sh /tmp/packages/draw
# Messages name pages; README.md links to them.
for page in README.md docs/scene-format.md docs/pipeline/farm.md docs/compare.md docs/pictures/engine.png; do
    [ -s "$1/root/usr/share/doc/burin/$page" ] || fail "$page is not there"
done
here "$1" sh -c 'cd /usr/share/doc/burin && burin render -q scenes/engine.toml --size 64x48 -o /tmp/engine.png' || fail "the pages' scenes"
here "$1" man burin-render | grep -q -- --crease-angle || fail "man burin-render shows nothing"
here "$1" man -w burin >/dev/null || fail "man burin"
[ "$(here "$1" bash /tmp/packages/bash_completion.sh /usr/share/bash-completion/completions/burin 'burin render --cr' | paste -sd' ')" = '--crease-angle --crop' ] || fail "completion"
[ -f "$1/root/usr/share/zsh/vendor-completions/_burin" ] || fail "completion for zsh"
here "$1" blender -b --factory-startup --addons burin_blender --python-exit-code 3 --python-expr '
import addon_utils, burin_blender
print("add-on", burin_blender.__file__, addon_utils.check("burin_blender"))' >"$1/log" 2>&1 || { cat "$1/log" >&2; fail "Blender"; }
grep -q "^add-on /usr/share/blender/scripts/addons/burin_blender/__init__.py (.*, True)" "$1/log" || { cat "$1/log" >&2; fail "Blender does not load the add-on"; }
here "$1" blender -b --factory-startup --addons burin_blender -E BURIN -o /tmp/packages/blender_#### -f 1 >"$1/log" 2>&1 || { cat "$1/log" >&2; fail "Blender does not render"; }
[ -s "$1/root/tmp/packages/blender_0001.png" ] || fail "Blender rendered nothing"
here "$1" dpkg --purge burin burin-doc libburin0 libburin-dev python3-burin blender-burin >"$1/log" 2>&1 || { cat "$1/log" >&2; fail "they cannot be removed"; }
left=$(find "$1/layer/upper/usr" -path '*burin*' -not -type c)
[ -z "$left" ] || fail "what is left behind: $left"
END
mkdir "$folder/root" "$folder/layer"
unshare --mount true 2>/dev/null || { echo "package_test: no layer can be made here"; exit $skipped; }
unshare --mount --propagation private bash "$folder/in_root" "$folder" "$source"
echo "package_test: all is well"
