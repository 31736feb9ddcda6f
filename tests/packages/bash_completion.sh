# Prints what the completion in a file offers at the end of a line, as bash would ask it.
#   bash bash_completion.sh FILE LINE
set -u
source "$1"
# Words as bash takes them apart: "=" is a word of its own.
read -ra COMP_WORDS <<<"${2//=/ = }"
[[ $2 != *' ' ]] || COMP_WORDS+=("")
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
_burin burin
[ ${#COMPREPLY[@]} -eq 0 ] || printf '%s\n' "${COMPREPLY[@]}"
