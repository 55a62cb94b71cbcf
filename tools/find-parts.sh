#!/bin/sh
# Finds other people's work in the program: fonts, and licences of fonts, header-only libraries and the named libraries. Prints a line for
# each: name in the program, tab, file. The layout is made for Inter and JetBrains Mono; without them it takes any sans and monospaced
# fonts.
set -eu
export LC_ALL=C
tab=$(printf '\t')

font() { # <name in the binary> <families, best first> <what else it must be>
    answer=$(fc-match -f '%{family[0]}\t%{file}\t%{fontformat}\t%{index}' "$2:$3:slant=0:width=100:scalable=true:variable=false")
    family=$(printf '%s' "$answer" | cut -f 1)
    file=$(printf '%s' "$answer" | cut -f 2)
    case $(printf '%s' "$answer" | cut -f 3,4) in
    "TrueType${tab}0" | "CFF${tab}0") ;;
    *)
        echo "wiggly needs an OpenType font such as $2 and found '$family'; install fonts-inter and fonts-jetbrains-mono" >&2
        exit 3
        ;;
    esac
    printf '%s\t%s\n' "$1" "$file"
    licence "$family" "$file"
}

# The package's own text if any, else the file beside it.
licence() { # <whose> <file>
    package=$(dpkg-query -S "$2" 2>/dev/null | head -n 1 | cut -d : -f 1 || true)
    for text in "/usr/share/doc/$package/copyright" "$(dirname "$2")"/OFL* "$(dirname "$2")"/LICEN[CS]E*; do
        [ -s "$text" ] || continue
        printf 'licenses/%s\t%s\n' "$1" "$text"
        return
    done
}

included() { # <pkg-config module>
    licence "$1" "$(pkg-config --variable=pcfiledir "$1")/$1.pc"
}

{
    font font/label Inter,sans-serif weight=80
    font font/label-bold Inter,sans-serif weight=180
    font font/number 'JetBrains Mono,monospace' weight=80:spacing=100
    for module in cglm stb "$@"; do included "$module"; done
} | awk '!seen[$0]++'
