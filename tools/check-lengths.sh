#!/bin/sh
# No file above 1,200 lines, no function above 120 (from the opening brace in the first column to the closing one).
# Usage: tools/check-lengths.sh <file.c or .h>...
exec awk '
FNR == 1 { opened = 0 }
FNR == 1201 { printf "%s: more than 1,200 lines\n", FILENAME; bad = 1 }
/^\{/ { opened = FNR }
/^\}/ && opened {
    if (FNR - opened + 1 > 120) { printf "%s:%d: a function of %d lines\n", FILENAME, opened, FNR - opened + 1; bad = 1 }
    opened = 0
}
END { exit bad }' "$@"
