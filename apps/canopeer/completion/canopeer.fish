# Completion of canopeer for fish. The program itself says what may come: `canopeer complete WORD…`.

function __canopeer_complete
    set -l words (commandline -opc)
    $words[1] complete $words[2..-1] (commandline -ct) 2>/dev/null
end
complete -c canopeer -f -a '(__canopeer_complete | string match -v :files)'
complete -c canopeer -n '__canopeer_complete | string match -q :files' -F
