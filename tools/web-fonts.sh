#!/bin/sh
# Reads find-parts.sh's lines and prints them with smaller fonts, which it writes to FOLDER: without hints, layouts, names, and the
# characters that src/ui/font.c has no slot for. Usage: tools/web-fonts.sh FOLDER
set -eu
tab=$(printf '\t')
characters=$(sed -n '/^} runs/,/^};/p' src/ui/font.c | grep -o '0x[0-9A-F]*, 0x[0-9A-F]*' | sed 's/, 0x/-/; s/0x//' | paste -s -d ,)
python=/usr/bin/python3 # Debian's packages are for Debian's Python
[ -x $python ] || python=python3
while IFS=$tab read -r name file; do
    case $name in font/*)
        $python -m fontTools.subset "$file" --unicodes="$characters" --output-file="$1/${name#*/}" --notdef-outline --no-hinting \
            --desubroutinize --layout-features= --name-IDs= --drop-tables+=GSUB,GPOS,GDEF,kern,OS/2,post,name,DSIG,FFTM,gasp,STAT
        file=$1/${name#*/}
        ;;
    esac
    printf '%s\t%s\n' "$name" "$file"
done
