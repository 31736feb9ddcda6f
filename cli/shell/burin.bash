# Completion of `burin` for bash. The program itself says what may stand where (cli/completion.h).

# Adds names of folders, and of files with one of the suffixes, or of all files if there is none.
#   _burin_files TYPED [SUFFIX...]
_burin_files() {
    local typed=$1 file pattern
    shift
    pattern="*.@($(IFS='|'; echo "$*"))"
    [ $# -gt 0 ] || pattern='*'
    compopt -o filenames 2>/dev/null
    while IFS= read -r file; do
        # shellcheck disable=SC2053
        if [[ -d $file || ${file,,} == $pattern ]]; then COMPREPLY+=("$file"); fi
    done < <(compgen -f -- "$typed")
}

_burin() {
    local words=() word line option=
    # bash takes words apart at "=": --hidden = dashed, --set style.width = 3
    for word in "${COMP_WORDS[@]:1:COMP_CWORD}"; do
        if [[ ${#words[@]} -gt 0 && ($word == "=" || ${words[-1]} == --*= ||
            (${words[-1]} == *= && ${#words[@]} -gt 1 && ${words[-2]} == --set)) ]]; then
            words[-1]+=$word
        else
            words+=("$word")
        fi
    done
    # ... and replaces only what is behind it.
    if [[ ${words[-1]} == --*=* && $COMP_WORDBREAKS == *=* ]]; then option=${words[-1]%=*}=; fi
    COMPREPLY=()
    while IFS= read -r line; do
        case $line in
            # shellcheck disable=SC2086
            :files*) _burin_files "${words[-1]#"$option"}" ${line#:files} ;;
            :folders) mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -d -- "${words[-1]#"$option"}") ;;
            *) line=${line%%$'\t'*} && COMPREPLY+=("${line#"$option"}") ;;
        esac
    done < <("$1" --complete "${words[@]}" 2>/dev/null)
    # A value follows at once.
    if [[ ${COMPREPLY[0]-} == *= ]]; then compopt -o nospace 2>/dev/null; fi
}

complete -F _burin burin
