#!/bin/sh
# No file above 600 lines, no function above 80 (from the opening brace in the first column to the closing one).
# Usage: tools/check-lengths.sh <file.c or .h>...
exec awk '
FNR == 1 { opened = 0 }
FNR == 601 { printf "%s: more than 600 lines\n", FILENAME; bad = 1 }
/^\{/ { opened = FNR }
/^\}/ && opened {
    if (FNR - opened + 1 > 80) { printf "%s:%d: a function of %d lines\n", FILENAME, opened, FNR - opened + 1; bad = 1 }
    opened = 0
}
END { exit bad }' "$@"
