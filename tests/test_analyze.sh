# wiggly analyze: from simulated motions to a character and a scene. What it refuses has test_commands.c.
. tests/check.sh
. tests/box.sh

write_box "$scratch/box.obj"

simulate() { # <name> <options>...
    local name=$1
    shift
    expect 0 "simulate $name" "$WIGGLY" simulate "$scratch/box.obj" --tets 60 --seconds 2 --fps 30 --substeps 2 "$@" \
        -o "$scratch/$name"
}
simulate up.npy --shake up --drive none --frequency 7
simulate side.pc2 --shake side --impulse
[ "$(od -An -tf4 -j20 -N8 "$scratch/side.pc2" | xargs)" = "0 1" ]
ok "a .pc2 begins at frame 0 and has a sample a frame" $?

mkdir "$scratch/out"
analyze() { # <exit status> <what> <arguments>...
    local status=$1 what=$2
    shift 2
    expect "$status" "$what" "$WIGGLY" analyze "$@"
}
analyze 0 "two motions, two principal components each" "$scratch/up.npy" "$scratch/side.pc2" --rest "$scratch/up.rest.obj" --fps 30 \
    --method cpca --modes 2 --shake up:side -o "$scratch/out/box.glb" --scene "$scratch/box.json"
says "warns of what is too fast" "up.npy: warning: parts move faster than 30 fps can show" "$err"
case $err in *side.pc2*) false ;; esac
ok "and of nothing else" $?
says "says what was read" "up.npy: 60 frames of 8 vertices at 30 fps" "$out"
says "names coordinates after files" "  side: explains " "$out"
says "and further modes" "  up-2: explains " "$out"
says "compares with real principal components" "real PCA's first " "$out"
says "says what all of them leave" "  relative error of the motion with 2 coordinates: " "$out"
says "recommends a spline" '    spline: "mode": "complex", "frequency": ' "$out"
says "and a range of lags" "lag over the surface: from 0 to 0 degrees" "$out"
holds "and prints no -0" not grep -E -- '-0(\.0+)?[ ,)]' <<<"$out"
says "the file has the targets" '"targetNames":["up.re","up.im","up-2.re","up-2.im","side.re","side.im","side-2.re","side-2.im"]' \
    "$(tr -d '\0' <"$scratch/out/box.glb")"
says "the scene finds the file from where it is" '"model": "out/box.glb"' "$(cat "$scratch/box.json")"
says "the scene is as long as the motion" '"frames": [0, 59]' "$(cat "$scratch/box.json")"
expect 0 "the scene is one" "$WIGGLY" check "$scratch/box.json"
holds "without a complaint" [ -z "$out$err" ]
first=$(cksum <"$scratch/out/box.glb")
analyze 0 "one motion twice" "$scratch/up.npy" "$scratch/up.npy" --rest "$scratch/box.obj" --fps 20.6 -o "$scratch/out/box.glb" \
    --scene "$scratch/slow.json"
says "the scene has as many frames at any rate" '"frames": [0, 59]' "$(cat "$scratch/slow.json")"
says "gives names of their own" "  up-2: explains " "$out"
analyze 0 "the first again" "$scratch/up.npy" "$scratch/side.pc2" --rest "$scratch/up.rest.obj" --fps 30 --modes 2 \
    --method cpca --shake up:side -o "$scratch/out/box.glb" --scene "$scratch/box.json"
holds "gives the same bytes" [ "$first" = "$(cksum <"$scratch/out/box.glb")" ]

targets_turn_normals() { # <file>
    tr -d '\0' <"$1" | grep -aq '"targets":\[{"POSITION":[0-9]*,"NORMAL":'
}
holds "coordinates turn normals" targets_turn_normals "$scratch/out/box.glb"
analyze 0 "without" "$scratch/up.npy" --rest "$scratch/box.obj" --fps 30 --no-normals -o "$scratch/still.glb"
holds "they turn none" not targets_turn_normals "$scratch/still.glb"
"$WIGGLY" analyze --help | grep -q -- --no-normals
ok "the help says how" $?

analyze 0 "by poles, with scene and table" "$scratch/side.pc2" --rest "$scratch/box.obj" --fps 30 --modes 3 -o "$scratch/side.glb" \
    --scene "$scratch/side.json" --coordinates "$scratch/side.csv"
holds "without a warning" [ -z "$err" ]
says "says that there is one pole" "  1 of 3 coordinates: the motion has no more poles that matter" "$out"
says "finds the frequency that was asked for" "    frequency 1.99" "$out"
# No knot more than needed, and the error of the motion no more than a tenth above that of the coordinate itself.
printf '%s\n' "$out" | awk '/bandwidth/ && $(NF - 1) <= 5 { few = 1 }
    /relative error of its motion/ { near = $6 + 0 <= 1.1 * $10 } END { exit !(few && near) }'
ok "at most five knots move the character as the simulation did" $?
[ "$(head -n 1 "$scratch/side.csv")" = "frame,side.re,side.im,side.fit.re,side.fit.im" ] && [ "$(wc -l <"$scratch/side.csv")" -eq 61 ]
ok "the table has a row a frame" $?
"$WIGGLY" solve "$scratch/side.json" | tr , ' ' >"$scratch/solved"
tr , ' ' <"$scratch/side.csv" | paste -d ' ' - "$scratch/solved" |
    awk 'NR > 1 { d = $4 - $7; e = $5 - $9; if (d * d + e * e > 1e-12 || NF != 9) bad = 1 } END { exit bad || NR != 61 }'
ok "and its fit is what the scene solves to" $?

# Parts of a character follow one after another without an option, and not if it swings freely. `make test` takes a coarse body.
tets=500 later=8
thorough && tets=1500 later=20
"$B/creature_obj" "$scratch/creature.obj" >/dev/null
creature() { # <name> <options>...
    local name=$1
    shift
    expect 0 "the creature's $name" "$WIGGLY" simulate "$scratch/creature.obj" --tets $tets --substeps 1 "$@" -o "$scratch/$name.npy"
}
spread() { # <degrees>...: lags from the least to the most, in order of the motions
    printf '%s\n' "$out" | awk -v wanted="$*" 'BEGIN { count = split(wanted, least) }
        /lag over/ { n++; all += $8 - $6 > least[n] } END { exit all != count }'
}
creature rises
creature sways --shake side
analyze 0 "both" "$scratch/rises.npy" "$scratch/sways.npy" -o "$scratch/creature.glb"
holds "have lags" spread 40 $later
creature free --shake side --drive none
analyze 0 "a free swing" "$scratch/free.npy" -o "$scratch/creature.glb"
holds "has none" not spread 5

expect 0 "a driven base" "$WIGGLY" simulate "$scratch/box.obj" --tets 60 --seconds 3 --fps 48 --substeps 4 --drive burst \
    --drive-frequency 2.75 --damping 0.1 --shake side -o "$scratch/burst.npy"
says "says since when it swings freely" "the drive stops at 1.091 s" "$out"
swings() { # <name> [times slower]: whether it does as the box does by itself
    printf '%s\n' "$out" | awk -v slower="${2:-1}" '/Hz, damping/ {
        good = $2 * slower > 1.99 && $2 * slower < 2.01 && $6 + 0 > 0.098 && $6 + 0 < 0.102 } END { exit !good }'
    ok "$1 swings as the box does by itself" $?
}
analyze 0 "nothing is told twice: analyze knows mesh, frame rate, direction and where the drive ends" "$scratch/burst.npy" -o "$scratch/burst.glb"
swings "what a burst leaves"
from_base=$(grep -v burst.npy <<<"$out" | sed 's/burst/world/')
expect 0 "the same burst, seen from outside" "$WIGGLY" simulate "$scratch/box.obj" --tets 60 --seconds 3 --fps 48 --substeps 4 --drive burst \
    --drive-frequency 2.75 --damping 0.1 --shake side --world -o "$scratch/world.npy"
analyze 0 "its base's motion is removed" "$scratch/world.npy" -o "$scratch/burst.glb"
says "and said" "  removed the motion of the base: up to 0.0882 m and 0 degrees" "$out"
holds "the rest is as seen from the base" [ "$(grep -v 'world.npy\|removed' <<<"$out")" = "$from_base" ]
analyze 0 "at another frame rate the drive ends with the same frame" "$scratch/world.npy" --fps 192 -o "$scratch/burst.glb"
swings "it" 0.25
mkdir "$scratch/found" && cp "$scratch/world.npy" "$scratch/found"
analyze 0 "a motion of somebody else's, with what holds it" "$scratch/found/world.npy" --rest "$scratch/box.obj" --fps 48 --from 1.091 \
    --pin 0.1 -o "$scratch/burst.glb"
swings "it"
analyze 0 "without" "$scratch/found/world.npy" --rest "$scratch/box.obj" --fps 48 -o "$scratch/burst.glb"
says "is warned of" " % of coordinate 1 is a rigid motion of the whole mesh; name what holds it with --pin" "$err"
cp "$scratch/burst.simulation.json" "$scratch/up.simulation.json"
analyze 0 "what simulate wrote for another motion" "$scratch/up.npy" --fps 30 -o "$scratch/burst.glb"
says "is left out" "up.simulation.json: warning: ignored, as it describes another motion (144 frames of 8 vertices)" "$err"
rm "$scratch/up.simulation.json"

awk '/^v/ { print $1, $2, -$4, $3; next } { print }' "$scratch/box.obj" >"$scratch/z-up.obj"
analyze 0 "a mesh with z up" "$scratch/up.npy" --rest "$scratch/z-up.obj" --fps 30 -o "$scratch/out/z-up.glb"
says "is warned of" "up.npy: warning: the motion is not centred on the rest mesh" "$err"
if command -v ldd >/dev/null; then
    ! ldd "$WIGGLY" | grep -qE 'lapack|blas'
    ok "the program does without LAPACKE until it analyses" $?
fi
