#!/bin/sh
# Makes the pictures in assets/pictures, which README and docs show. Run it from the root of the tree.
# Usage: [BPY=PYTHON] tools/make-pictures.sh [wiggly]
set -eu
wiggly=${1:-build/wiggly}
out=assets/pictures
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$out"

# The app writes quickly; the repository keeps the same pixels in fewer bytes.
keep() { # <name> <picture> [option]...
    name=$1
    shift
    convert "$@" -alpha off -strip -define png:compression-level=9 -define png:compression-filter=1 \
        -define png:compression-strategy=0 "$out/$name"
    echo "$out/$name, $(($(wc -c <"$out/$name") / 1000)) kB"
}

picture() { # <name> <frames> [option]...
    name=$1 frames=$2
    shift 2
    "$wiggly" live --headless --frames "$frames" --screenshot "$scratch/$name" "$@" >"$scratch/log" 2>&1 || {
        cat "$scratch/log" >&2
        exit 1
    }
    keep "$name" "$scratch/$name"
}

# A replay on the built-in scene or another; its header (with the scene's hash) is one that the app itself records.
replay() { # <name> [scene], events on standard input
    "$wiggly" live --headless --frames 1 --record "$scratch/$1" ${2:+"$2"} >/dev/null 2>&1
    sed -i 's/^frames .*/frames 1200/' "$scratch/$1"
    cat >>"$scratch/$1"
}

# Drags a knot up, shakes it and brings it back, in a window of 960×600 that plays the scene in a loop.
drag_events() {
    echo "20 pointer @knot(sway,3)"
    echo "36 press left @knot(sway,3)"
    awk 'function ease(t) { return t < 0 ? 0 : t > 1 ? 1 : t * t * (3 - 2 * t) }
        BEGIN {
            for (f = 37; f <= 262; f++) {
                up = ease((f - 40) / 60) - ease((f - 190) / 60)
                shake = sin(0.07 * (f - 100)) * ease((f - 100) / 20) * (1 - ease((f - 180) / 15))
                printf "%d pointer @curve(sway,%.2f,%.4f)\n", f, 66 + 2 * shake, -1.1 + 0.9 * up + 0.35 * shake
            }
        }'
    echo "264 release left @curve(sway,66,-1.1)"
    echo "268 pointer @stage(0.02,0.95)"
}

# A scene at some frames, side by side.
row() { # <name> <scene> <part of a picture of 480x320> <frame>...
    name=$1 from=$2 part=$3 n=10
    shift 3
    for frame; do
        n=$((n + 1))
        "$wiggly" export "$from" -o "$scratch/$name-$n.png" --frames "$frame:$frame" --size 480x320 --quiet
    done
    keep "$name" "$scratch/$name"-*.png -crop "$part" +repage +append
}

# The result of a job of tests/replays.
job() { # <job>
    "$wiggly" live --no-draw --replay "tests/replays/$1.replay" --result "$scratch/$1.json" "tests/replays/$1.json" >"$scratch/log"
    echo "$scratch/$1.json"
}

# The start scene's tail while it is pulled, side by side.
pulled() { # <name> <way>...
    name=$1 n=0
    shift
    for way; do
        n=$((n + 1))
        sed "s/@pointer(-.*/@pointer($way)/" tests/replays/pull.replay >"$scratch/pull.replay"
        "$wiggly" live --headless --frames 50 --replay "$scratch/pull.replay" --screenshot "$scratch/pull-$n.png" \
            assets/scenes/tail.json >"$scratch/log"
    done
    keep "$name" "$scratch"/pull-*.png -crop 520x360+240+0 +repage +append
}

animation() { # <name>: every fourth of 300 frames, 15 a second
    "$wiggly" live --headless --frames 1 --size 960x600 --record "$scratch/loop.replay" >/dev/null 2>&1
    sed -i 's/^frames .*/frames 300/' "$scratch/loop.replay"
    drag_events >>"$scratch/loop.replay"
    "$wiggly" live --headless --replay "$scratch/loop.replay" --frames-dir "$scratch/frames" >/dev/null
    mkdir "$scratch/kept"
    find "$scratch/frames" -name '*.png' | sort | awk 'NR % 4 == 1' | xargs mv -t "$scratch/kept"
    convert -delay 7 -loop 0 "$scratch/kept/*.png" -crop 680x576+0+0 +repage +dither -colors 96 -fuzz 1.5% \
        -layers OptimizeTransparency "$out/$1"
    echo "$out/$1, $(($(wc -c <"$out/$1") / 1000)) kB"
}

# docs/first-swing.md, up to its second knot.
replay swing.replay <<'END'
10 key N ctrl
20 double left @curve(sway,20,0.6)
40 double left @curve(sway,50,-0.6)
60 pointer @curve(sway,56,-0.9)
END

animation drag.gif
replay bones.replay assets/models/dog.glb <<'END'
10 pointer @bone(tail_1)
12 press left @bone(tail_1)
13 release left @bone(tail_1)
20 key J shift
END

picture bones.png 60 --replay "$scratch/bones.replay" assets/models/dog.glb
picture dog.png 130 assets/scenes/dog.json
picture swing.png 100 --replay "$scratch/swing.replay"
pulled pull.png 0,0 0.175,0 0,0.175 -0.175,0
row flick.png "$(job idle)" 330x255+75+10 29 33 35 44 60
row held.png "$(job held)" 345x250+75+15 0 46 56 62 68 144
sed 's/"wind_up": 0.5/"wind_up": 0/' assets/scenes/tail.json >"$scratch/whole.json"
row accent.png assets/scenes/tail.json 300x225+85+15 98 104 110 116 2 8 14 20
row accent-whole.png "$scratch/whole.json" 300x225+85+15 98 104 110 116 2 8 14 20
picture figure7.png 60 assets/scenes/figure7.json

# A dog that is soft on its bones, in its walk two and a half times as much as it is; and when each part of it swings.
"$wiggly" flesh assets/models/dog.glb -o "$scratch/soft.glb" --scene "$scratch/soft.json" --tets 1000 --substeps 3 >"$scratch/log"
sed 's/"amplitude": 1,/"amplitude": 2.5,/' "$scratch/soft.json" >"$scratch/softer.json"
row flesh.png "$scratch/softer.json" 300x300+90+10 2 8 14 20
sed 's/"clip": "Walk",/"clip": "Walk", "phases": "y",/' "$scratch/soft.json" >"$scratch/phases.json"
row flesh-phases.png "$scratch/phases.json" 300x300+90+10 8

# docs/blender.md, with a Python that has bpy.
if [ -n "${BPY:-}" ]; then
    PYTHONPATH=python/src WIGGLY_LIBRARY=$(ls "$PWD/$(dirname "$wiggly")"/libwiggly.so.* | head -n 1) \
        "${BPY%% *}" blender/tests/pictures.py "$scratch" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; exit 1; }
    for name in blender-tail.png blender-curve.png; do keep $name "$scratch/$name" +dither -colors 96; done
fi
