#!/usr/bin/env bash
# What a shell has of the program once it is installed: completion in bash and zsh, and manual pages.
#   shell_test.sh BUILD_FOLDER
set -euo pipefail
build=$1
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "shell_test: $1" >&2; exit 1; }

cmake --install "$build" --prefix "$folder/prefix" >"$folder/log" || { cat "$folder/log" >&2; fail "it cannot be installed"; }
export PATH=$folder/prefix/bin:$PATH
share=$folder/prefix/share
mkdir "$folder/files"
cd "$folder/files"
touch model.obj MODEL2.PLY notes.txt saved.lines mine.toml 'a b.obj' x.exr
mkdir models

# bash: "LINE" as it is typed, and what is offered, in any order.
expect_bash() {
    local offered
    offered=$(bash "$here/bash_completion.sh" "$share/bash-completion/completions/burin" "$1" | sort | paste -sd' ')
    [ "$offered" = "$2" ] || fail "bash: '$1' offers '$offered', not '$2'"
}
expect_bash 'burin re' 'render restyle'
expect_bash 'burin render --cr' '--crease-angle --crop'
expect_bash 'burin render --hidden ' 'dashed none solid'
expect_bash 'burin render --hidden=d' 'dashed'
expect_bash 'burin render --lines crease,si' 'crease,silhouette'
expect_bash 'burin render --style=pat' 'patent'
expect_bash 'burin render mod' 'model.obj models'
expect_bash 'burin render MOD' 'MODEL2.PLY'
expect_bash 'burin render a' 'a b.obj'
expect_bash 'burin restyle ' 'models saved.lines'
expect_bash 'burin render --style mi' 'mine.toml'
expect_bash 'burin compare -o ' 'models'
expect_bash 'burin render -o ' 'models x.exr'
expect_bash 'burin render --deep ' 'models x.exr'
expect_bash 'burin render --style pencil --set style.rou' 'style.roughness='
expect_bash 'burin render --style=pencil --set=style.rou' 'style.roughness='
expect_bash 'burin render --style pencil --set style.roughness=' ''
expect_bash 'burin render --style pencil --set style.roughness=3' ''
expect_bash 'burin nothing ' ''

if command -v zsh >/dev/null; then
    expect_zsh() {
        local line
        line=$(zsh -f "$here/zsh_completion.zsh" "$share/zsh/site-functions" "$1")
        [ "$line" = "$2" ] || fail "zsh: '$1' becomes '$line', not '$2'"
    }
    expect_zsh 'burin comp' 'burin compare '
    expect_zsh 'burin render --crea' 'burin render --crease-angle '
    expect_zsh 'burin render --hidden=da' 'burin render --hidden=dashed '
    expect_zsh 'burin render --lines crease,si' 'burin render --lines crease,silhouette '
    expect_zsh 'burin render model.' 'burin render model.obj '
    expect_zsh 'burin render --style pencil --set style.rou' 'burin render --style pencil --set style.roughness='
    expect_zsh 'burin restyle ../files/sa' 'burin restyle ../files/saved.lines '
fi

# Pages that messages and manual pages name, and what these link to. The site alone has an index of decisions, and a
# reference that is made of comments.
pages=$share/doc/burin
{ cat "$(command -v burin)"; cat "$share"/man/man1/*.1 | tr -d '\\'; } | grep -ao 'docs/[a-z/-]*\.md' | sort -u >"$folder/named"
[ "$(wc -l <"$folder/named")" -ge 4 ] || fail "messages name no pages: $(cat "$folder/named")"
while read -r page; do [ -f "$pages/$page" ] || fail "$page is not installed"; done <"$folder/named"
find "$pages" -name '*.md' -exec dirname {} + | sort -u >"$folder/folders"
while read -r of_pages; do
    cat "$of_pages"/*.md | grep -v '^    ' | grep -oP '\]\(\K[^)#\s]+' | grep -v '^[a-z]*:' | sort -u |
        grep -v '^api\.md$\|^decisions/index\.md$\|^index\.md$' >"$folder/links" || true
    while read -r link; do [ -e "$of_pages/$link" ] || fail "$of_pages links to $link"; done <"$folder/links"
done <"$folder/folders"

# Manual pages: one for each command, without a complaint of the formatter.
commands=$(burin --complete '' | cut -f1)
for page in burin $(for command in $commands; do echo "burin-$command"; done); do
    file=$share/man/man1/$page.1
    [ -f "$file" ] || fail "$page.1 is not there"
    complaints=$(man --warnings -l "$file" 2>&1 >"$folder/page")
    [ -z "$complaints" ] || fail "$page.1: $complaints"
    for heading in NAME SYNOPSIS OPTIONS 'EXIT STATUS' FILES 'SEE ALSO'; do
        grep -q "^$heading\$" "$folder/page" || fail "$page.1 lacks $heading"
    done
done
burin render --help | grep -o '^  [^ ]*--[a-z-]*' | grep -o -- '--.*' >"$folder/options"
MANWIDTH=200 man -l "$share/man/man1/burin-render.1" 2>/dev/null >"$folder/page"
while read -r option; do
    grep -q -- "$option\b" "$folder/page" || fail "burin-render.1 lacks $option"
done <"$folder/options"
echo "shell_test: all is well"
