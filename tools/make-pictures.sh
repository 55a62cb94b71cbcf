#!/bin/sh
# Makes the pictures in assets/pictures: the README's and the five that are looked at before a change of looks is accepted
# (assets/pictures/README.md says what for). Run it from the root of the tree.
# Usage: tools/make-pictures.sh [wiggly]
set -eu
wiggly=${1:-build/wiggly}
out=assets/pictures
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$out"

picture() { # <name> <frames> [option]...
    name=$1 frames=$2
    shift 2
    "$wiggly" live --headless --frames "$frames" --screenshot "$scratch/$name" "$@" >"$scratch/log" 2>&1 || {
        cat "$scratch/log" >&2
        exit 1
    }
    # The app writes quickly; the repository keeps the same pixels in fewer bytes.
    convert "$scratch/$name" -alpha off -strip -define png:compression-level=9 -define png:compression-filter=1 \
        "$out/$name"
    echo "$out/$name, $(($(wc -c <"$out/$name") / 1000)) kB"
}

# A replay on the built-in scene; its header (with the scene's hash) is one that the app itself records.
replay() { # <name>, events on standard input
    "$wiggly" live --headless --frames 1 --record "$scratch/$1" >/dev/null 2>&1
    sed -i 's/^frames .*/frames 1200/' "$scratch/$1"
    cat >>"$scratch/$1"
}

replay select.replay <<'END'
2 pointer @knot(sway,2)
3 press left @knot(sway,2)
4 release left @knot(sway,2)
6 pointer @curve(sway,50,1.2)
END
replay help.replay <<'END'
10 key F1
11 keyup F1
END

picture live.png 66 --replay "$scratch/select.replay"
picture start.png 20
picture drag.png 95 --replay tests/replays/session.replay tests/replays/session.json
picture help.png 20 --replay "$scratch/help.replay"
picture small.png 20 --size 960x600
picture scale2.png 20 --scale 2
picture figure7.png 60 assets/scenes/figure7.json
