#!/bin/sh
# Checks that every C file starts with a line or two (///) about its purpose, and that comments cite only pages and headings that exist:
# docs/NAME.md, and the heading in "docs/NAME.md, Heading". Run it in the root of the tree.
# Usage: tools/check-heads.sh <file.c or .h>...
bad=0
complain() {
    echo "$1"
    bad=1
}

for file in "$@"; do
    case $(head -n 1 "$file") in "/// "*) ;; *) complain "$file:1: opens without a /// line that says what it is for" ;; esac
done
pages=$(grep -ohE '[A-Za-z_/-]+\.md\b(, [A-Z][a-z-]+)?' "$@" /dev/null | sort -u | tr ' ' '@')
for cited in $pages; do
    page=${cited%%,*}
    heading=${cited#*,@}
    if [ ! -e "$page" ]; then
        complain "$page: cited in $(grep -lF "$page" "$@" | head -n 1), not in the repository"
    elif [ "$heading" != "$cited" ] && ! grep -qx "## $heading" "$page"; then
        complain "$page: no heading \"$heading\", which $(grep -lF "$page, $heading" "$@" | head -n 1) cites"
    fi
done
exit $bad
