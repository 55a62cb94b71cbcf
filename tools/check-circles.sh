#!/bin/sh
# Finds files that include each other in a circle (a .c and its .h count as one), prints the largest circle, and fails if it has more than
# CIRCLE (3) files. Usage: tools/check-circles.sh [root]
set -eu
cd "${1:-.}"
grep -rE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' --include='*.[ch]' src |
    awk -v most="${CIRCLE:-3}" '
{
    file = substr($0, 5, index($0, ":") - 7)
    header = $0
    sub(/^[^"]*"/, "", header)
    sub(/\.h".*$/, "", header)
    if (file == header || (file, header) in known) next
    known[file, header] = 1
    if (!(file in edges)) files[++count] = file
    edge[file, ++edges[file]] = header
}
# Marks all files reached from one.
function walk(from,    queue, last, n, i, to) {
    queue[last = 1] = from
    for (n = 1; n <= last; n++) {
        for (i = 1; i <= edges[queue[n]]; i++) {
            to = edge[queue[n], i]
            if ((from, to) in reached) continue
            reached[from, to] = 1
            queue[++last] = to
        }
    }
}
END {
    for (f = 1; f <= count; f++) walk(files[f])
    for (f = 1; f <= count; f++) {
        if (files[f] in placed) continue
        size = 0
        list = ""
        for (g = f; g <= count; g++) {
            if (!((files[f], files[g]) in reached && (files[g], files[f]) in reached)) continue
            placed[files[g]] = 1
            size++
            list = list " " files[g]
        }
        if (size > largest) { largest = size; where = list }
        if (size > most) {
            printf "src: %d files include each other in a circle:%s\n", size, list
            bad = 1
        }
    }
    printf "largest circle of includes: %d files%s%s\n", largest, where == "" ? "" : ":", where
    exit bad
}'
