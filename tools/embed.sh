#!/bin/sh
# Makes the sources that put files into the binary: embedded_data.S (the bytes) and embedded_table.c (their names).
# Usage: tools/embed.sh <output folder> <shader or scene>...
# Fonts are found through fontconfig; a substitute family is an error, because the layout is made for these.
set -eu
export LC_ALL=C
out=$1
shift

font() { # <family> <style>
    answer=$(fc-match -f '%{family}\t%{style}\t%{file}' "$1:style=$2")
    family=$(printf '%s' "$answer" | cut -f1)
    style=$(printf '%s' "$answer" | cut -f2)
    case ",$family,/,$style," in
    *",$1,"*/*",$2,"*) printf '%s' "$answer" | cut -f3 ;;
    *)
        echo "embed.sh: the font '$1 $2' is not installed (fontconfig offers '$family $style');" \
            "install fonts-inter and fonts-jetbrains-mono" >&2
        exit 3
        ;;
    esac
}

label=$(font Inter Regular)
label_bold=$(font Inter "Semi Bold")
number=$(font "JetBrains Mono" Regular)

data=$out/embedded_data.S.new
table=$out/embedded_table.c.new
declarations=""
rows=""
count=0
echo '    .section .rodata' >"$data"

add() { # <name in the binary> <file>
    printf '    .balign 16\n    .global embedded_%d\nembedded_%d:\n    .incbin "%s"\n    .byte 0\n' \
        $count $count "$2" >>"$data"
    declarations="${declarations}extern const unsigned char embedded_$count[];
"
    rows="$rows    {\"$1\", embedded_$count, $(stat -L -c %s "$2")},
"
    count=$((count + 1))
}

add font/label "$label"
add font/label-bold "$label_bold"
add font/number "$number"
for file in "$@"; do add "${file#assets/}" "$file"; done
echo '    .section .note.GNU-stack,"",%progbits' >>"$data"

{
    printf '#include "base/embedded.h"\n\n%s\n' "$declarations"
    printf 'extern const struct embedded embedded_files[];\nextern const size_t embedded_file_count;\n'
    printf 'const struct embedded embedded_files[] = {\n%s};\n' "$rows"
    printf 'const size_t embedded_file_count = %d;\n' $count
} >"$table"
mv "$data" "$out/embedded_data.S"
mv "$table" "$out/embedded_table.c"
