#!/bin/sh
# Prints the size of the tree. --frames also prints the number of functions that run in a frame of a knot's drag but not in an idle frame.
# Usage: tools/bars.sh [--frames]. --frames builds an instrumented program in build/bars once.
set -eu
cd "$(dirname "$0")/.."
lines() { git ls-files "$@" | tr '\n' '\0' | xargs -0 cat | wc -l; }
short() { # EXTENSION LIMIT
    git ls-files "src/*.$1" | while read -r file; do
        [ "$(wc -l <"$file")" -ge "$2" ] || echo "$file"
    done | wc -l
}
echo "lines of src: $(lines src)"
echo "lines of src, tools and include: $(lines src tools include)"
echo "lines of tests: $(lines tests)"
echo "words of README: $(wc -w <README.md), with docs, CONTRIBUTING and CHANGELOG: $(cat README.md CONTRIBUTING.md CHANGELOG.md docs/*.md | wc -w)"
echo ".c files of src under 60 lines: $(short c 60)"
echo "headers of src under 30 lines: $(short h 30)"
# Counts a function's lines from its opening to its closing brace.
git ls-files 'src/*.c' | tr '\n' '\0' | xargs -0 awk '
    /^\{/ && before ~ /\)$/ { start = FNR }
    /^\}/ && start { print FNR - start + 1; start = 0 }
    { before = $0 }' | sort -n | awk '
    { length_of[NR] = $1 }
    END { printf "functions: %d, lines: median %d, nine of ten at most %d\n", NR, length_of[int((NR + 1) / 2)], length_of[int(NR * 0.9)] }'
[ "${1:-}" = --frames ] || exit 0

build=build/bars
make -s B=$build CFLAGS=-finstrument-functions $build/wiggly >/dev/null
cat >$build/calls.c <<'C'
/// Counts the functions that frame DRAGS runs and frame IDLE does not. Loaded before the C library, whose hooks do nothing.
#define _GNU_SOURCE
#include <link.h>
#include <stdio.h>
#include <stdlib.h>
#define DARK __attribute__((no_instrument_function))
enum { IDLE = 30, DRAGS = 70, SLOTS = 1 << 16 };
static struct { void *function; int idle, drags; } seen[SLOTS];
static char *first_code;
static int frame = -1;
static _Thread_local int inside;
DARK static int on_object(struct dl_phdr_info *info, size_t size, void *user)
{
    (void)size, (void)user;
    first_code = (char *)info->dlpi_addr;
    return 1;
}
DARK static void say(void)
{
    for (int i = 0; i < SLOTS; i++) {
        if (seen[i].drags && !seen[i].idle) fprintf(stderr, "@%lx\n", (long)((char *)seen[i].function - first_code));
    }
}
DARK void __cyg_profile_func_enter(void *function, void *site)
{
    static char *app_frame;
    (void)site;
    if (inside) return;
    inside = 1;
    if (!app_frame) {
        dl_iterate_phdr(on_object, NULL);
        app_frame = first_code + strtol(getenv("APP_FRAME"), NULL, 16);
        atexit(say);
    }
    if (function == app_frame) frame++;
    if (frame == IDLE || frame == DRAGS) {
        size_t i = ((size_t)function >> 2) % SLOTS;
        while (seen[i].function && seen[i].function != function) i = (i + 1) % SLOTS;
        seen[i].function = function;
        if (frame == IDLE) seen[i].idle = 1;
        if (frame == DRAGS) seen[i].drags = 1;
    }
    inside = 0;
}
DARK void __cyg_profile_func_exit(void *function, void *site) { (void)function, (void)site; }
C
cc -O1 -shared -fPIC -o $build/calls.so $build/calls.c
APP_FRAME=$(nm $build/wiggly | awk '$3 == "app_frame" { print $1 }') LD_PRELOAD=$PWD/$build/calls.so \
    $build/wiggly live tests/replays/session.json --no-draw --frames 80 --replay tests/replays/session.replay \
    2>$build/calls.txt >/dev/null || true
sed -n 's/^@/0x/p' $build/calls.txt | addr2line -e $build/wiggly | sort -u | grep -c "^\./src/" |
    sed 's/^/functions that frame 70 of the recorded session, a knot drag, runs and frame 30 does not: /'
