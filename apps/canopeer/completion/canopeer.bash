# Completion of canopeer for bash. The program itself says what may come: `canopeer complete WORD…`.
# For a program of your own around the library, say also: complete -F _canopeer NAME

_canopeer() {
  local program=${COMP_WORDS[0]/#\~/$HOME} word=${COMP_WORDS[COMP_CWORD]} line
  [[ $word == = ]] && word=
  COMPREPLY=()
  while IFS= read -r line; do
    if [[ $line == :files ]]; then
      compopt -o filenames 2>/dev/null
      while IFS= read -r line; do COMPREPLY+=("$line"); done < <(compgen -f -- "$word")
    elif [[ $line == "$word"* ]]; then
      COMPREPLY+=("${line%%$'\t'*}")
    fi
  done < <("$program" complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
}
complete -F _canopeer canopeer
