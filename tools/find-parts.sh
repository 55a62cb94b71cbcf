#!/bin/sh
# Finds other people's work in the program: fonts, and licences of fonts, header-only libraries and the named libraries. Prints a line for
# each: name in the program, tab, file. The layout is made for Inter and JetBrains Mono; without them it takes any sans and monospaced
# fonts.
set -eu
export LC_ALL=C
tab=$(printf '\t')

font() { # <name in the binary> <families, best first> <what else it must be>: a font's line, then its family's
    answer=$(fc-match -f '%{family[0]}\t%{file}\t%{fontformat}\t%{index}' "$2:$3:slant=0:width=100:scalable=true:variable=false")
    family=${answer%%"$tab"*} kind=${answer#*"$tab"}
    file=${kind%%"$tab"*} kind=${kind#*"$tab"}
    case $kind in
    "TrueType${tab}0" | "CFF${tab}0") ;;
    *)
        echo "wiggly needs an OpenType font such as $2 and found '$family'; install fonts-inter and fonts-jetbrains-mono" >&2
        exit 3
        ;;
    esac
    printf '%s\t%s\nlicenses/%s\t%s\n' "$1" "$file" "$family" "$file"
}

found=$(
    font font/label Inter,sans-serif weight=80
    font font/label-bold Inter,sans-serif weight=180
    font font/number 'JetBrains Mono,monospace' weight=80:spacing=100
    for module in cglm stb "$@"; do printf 'licenses/%s\t%s/%s.pc\n' "$module" "$(pkg-config --variable=pcfiledir "$module")" "$module"; done
)
# One question for all files, as each takes dpkg long.
files=$(echo "$found" | sed -n 's/^licenses.*\t//p' | sort -u)
owners=$(IFS='
' && dpkg-query -S $files 2>/dev/null || true)
echo "$found" | awk '!seen[$0]++' | while IFS=$tab read -r name file; do
    case $name in
    licenses/*) # the package's own text if any, else the file beside it
        package=$(echo "$owners" | sed -n "s|^\([^:]*\):.* $file\$|\1|p" | head -n 1)
        for text in "/usr/share/doc/$package/copyright" "$(dirname "$file")"/OFL* "$(dirname "$file")"/LICEN[CS]E*; do
            [ -s "$text" ] || continue
            printf '%s\t%s\n' "$name" "$text"
            break
        done
        ;;
    *) printf '%s\t%s\n' "$name" "$file" ;;
    esac
done | awk '!seen[$0]++'
