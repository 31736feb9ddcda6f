# Prints what a line becomes when Tab is pressed in a zsh that finds its completions in a folder.
#   zsh -f zsh_completion.zsh FOLDER LINE
zmodload zsh/zpty
zpty shell zsh -f -i
zpty -w shell "PS1= PROMPT_EOL_MARK= RPS1=; fpath=($1 \$fpath); autoload -Uz compinit; compinit -u -D; setopt no_beep no_list_beep
show() { print -r -- \"<<\$BUFFER>>\"; BUFFER=; zle accept-line }; zle -N show; bindkey '^X' show; stty -echo; print rea''dy"
while zpty -r shell line; do [[ $line == ready* ]] && break; done
zpty -w -n shell "$2"$'\t\x18'
while zpty -r shell line; do
    if [[ $line == *'<<'*'>>'* ]]; then
        print -r -- "${${line##*<<}%%>>*}"
        break
    fi
done
zpty -d shell
