#!/bin/sh
# Makes the sources that embed files in the program: embedded_data.S (the bytes) and embedded_table.c (their names).
# Usage: tools/embed.sh <output folder> <list of name, tab, file> <file>...
set -eu
export LC_ALL=C
out=$1
list=$2
shift 2

data=$out/embedded_data.S.new
table=$out/embedded_table.c.new
declarations=""
rows=""
count=0
cat >"$data" <<'END'
#ifdef __wasm__
#define OBJECT @object
    .section .rodata.embedded,"",@
#else
#define OBJECT %object
    .section .note.GNU-stack,"",%progbits
    .section .rodata
#endif
END

add() { # <name in the binary> <file>
    symbol=embedded_$count
    printf '    .globl %s\n    .type %s, OBJECT\n    .balign 16\n%s:\n    .incbin "%s"\n    .byte 0\n    .size %s, . - %s\n' \
        $symbol $symbol $symbol "$2" $symbol $symbol >>"$data"
    declarations="${declarations}extern const unsigned char embedded_$count[];
"
    rows="$rows    {\"$1\", embedded_$count, $(stat -L -c %s "$2")},
"
    count=$((count + 1))
}

tab=$(printf '\t')
while IFS=$tab read -r name file; do add "$name" "$file"; done <"$list"
for file in "$@"; do add "${file#assets/}" "$file"; done

{
    printf '#include "base/embedded.h"\n\n%s\n' "$declarations"
    printf 'extern const struct embedded embedded_files[];\nextern const size_t embedded_file_count;\n'
    printf 'const struct embedded embedded_files[] = {\n%s};\n' "$rows"
    printf 'const size_t embedded_file_count = %d;\n' $count
} >"$table"
mv "$data" "$out/embedded_data.S"
mv "$table" "$out/embedded_table.c"
