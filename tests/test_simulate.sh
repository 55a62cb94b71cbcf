# wiggly simulate: what it writes and says. What it refuses has test_commands.c.
. tests/check.sh
. tests/box.sh

write_box "$scratch/box.obj"
quick=(--tets 60 --seconds 0.25 --fps 24 --substeps 2)

expect 0 "a box is shaken" "$WIGGLY" simulate "$scratch/box.obj" --shake side "${quick[@]}" -o "$scratch/box.npy"
says "says what was written" "box.npy: 6 frames of 8 vertices at 24 fps" "$out"
holds "the .npy holds 6 × 8 × 3 floats" [ "$(stat -c %s "$scratch/box.npy")" -eq $((128 + 6 * 8 * 3 * 4)) ]
holds "the rest mesh has the same vertices" [ "$(grep -c '^v ' "$scratch/box.rest.obj")" -eq 8 ]
says "what was done is beside it" '"fps": 24.0' "$(<"$scratch/box.simulation.json")"
first=$(cat "$scratch/box.npy" | cksum)
expect 0 "again" "$WIGGLY" simulate "$scratch/box.obj" --shake side "${quick[@]}" -o "$scratch/box.npy" --verbose
holds "the same command gives the same bytes" [ "$first" = "$(cat "$scratch/box.npy" | cksum)" ]
says "--verbose tells how far it is" "frame 6 of 6" "$err"

# Without options a burst shakes the base, and the motion lasts as long as the body needs. Where it cannot, the body swings freely.
short=(--tets 60 --substeps 1)
swings() { # <what> <what is said> <what is not> <arguments>...
    local what=$1 said=$2 other=$3
    shift 3
    expect 0 "$what" "$WIGGLY" simulate "$scratch/box.obj" "${short[@]}" "$@" -o "$scratch/swing.npy"
    says "says so" "$said" "$out$err"
    holds "and nothing else" not grep -q "$other" <<<"$out$err"
}
burst="the drive stops at" free="swings freely, because"
swings "a burst by default" "$burst 1.091 s; then the body swings freely" "because" --seconds 2
mv "$scratch/swing.npy" "$scratch/burst.npy"
swings "the same with what help calls its defaults" "$burst" "because" --seconds 2 --drive burst --drive-frequency 2.75 \
    --amplitude 0.05 --damping 0.2 --soft distance
holds "is the same motion" cmp "$scratch/swing.npy" "$scratch/burst.npy"
swings "no drive" "swing.npy: 48 frames" "$burst\|because" --drive none --seconds 2
mv "$scratch/swing.npy" "$scratch/free.npy"
swings "the same with its defaults" "swing.npy: 48 frames" "$burst" --drive none --seconds 2 --amplitude 0.2 --damping 0.03 --softness 1
holds "is the same motion" cmp "$scratch/swing.npy" "$scratch/free.npy"
swings "a push" "$free of --impulse" "$burst" --impulse --seconds 1
swings "a body that nothing holds" "$free of --pin none" "$burst" --pin none --seconds 1
swings "a time too short" "$free a burst of 1.091 s and a period of 0.5 s do not fit into 1 s" "$burst" --seconds 1
swings "a body too slow for it" "do not fit into 1 s" "$burst" --seconds 1 --young 1e4
says "whose frequency nobody can tell" "warning: 1 s show less than a period, 2." "$err"
swings "a burst that is asked for, however short the time" "swing.npy: 24 frames" "because" --seconds 1 --drive burst
says "that analyze may misread" "warning: a drive of 1.091 s and a period of 0.5 s do not fit into 1 s" "$err"
swings "eight periods of a slow body" "swing.npy: 384 frames" "because" --frequency 0.5
swings "the same by its material" "then the body swings freely" "because" --young 1e4
thorough && swings "a thousand frames a second" "swing.npy: 4000 frames" "because" --fps 1000
swings "more than fits into as many frames as analyze takes" "do not fit into 4.096 s" "$burst" --fps 1000 --frequency 0.7
swings "a slow burst" "swing.npy: 192 frames" "because" --drive-frequency 0.5
thorough && swings "a body of sixteen minutes a swing" "show less than a period, 1000 s, so analyze cannot find the frequency" "$burst" --frequency 0.001

expect 0 "PC2, a push along a vector" "$WIGGLY" simulate "$scratch/box.obj" --shake 1,0,1 --impulse "${quick[@]}" -o "$scratch/box.pc2"
holds "is PC2" [ "$(head -c 11 "$scratch/box.pc2")" = POINTCACHE2 ]
expect 0 "normal modes" "$WIGGLY" simulate "$scratch/box.obj" --modal 3 --tets 60 --frequency 1.5 -o "$scratch/modes.npy"
says "prints their frequencies, the lowest as asked for" "   1          1.5" "$out"
holds "writes three shapes" [ "$(stat -c %s "$scratch/modes.npy")" -eq $((128 + 3 * 8 * 3 * 4)) ]

# A heavy block with a light arm: what is seen of a shake up is the arm.
{ sed 's/^v \(.\) \(.\) /v \1 0.75*\2 /; s/0.75\*0/0/; s/0.75\*2/1.5/' "$scratch/box.obj" && sed -n '/^v/p' "$scratch/box.obj" |
    awk '{ print "v", 0.8 + 1.4 * $2, 1.1 + 0.15 * $3, 0.35 + 0.3 * $4 }' && sed -n '/^f/p' "$scratch/box.obj" |
    awk '{ print "f", $2 + 8, $3 + 8, $4 + 8, $5 + 8 }'; } >"$scratch/arm.obj"
expect 0 "a block with an arm" "$WIGGLY" simulate "$scratch/arm.obj" --tets 300 --seconds 0.5 --substeps 1 -o "$scratch/arm.npy"
says "swings its arm as fast as asked for" "seen most: mode 2, 2 Hz" "$out"
holds "without a warning" [ -z "$err" ]
awk '/^v/ { print "v", $2 / 5, 2 * $3, $4 / 5; next } 1' "$scratch/box.obj" >"$scratch/rod.obj"
expect 0 "a rod that is pulled" "$WIGGLY" simulate "$scratch/rod.obj" --tets 300 --seconds 0.1 --substeps 1 -o "$scratch/rod.npy"
says "is told how slowly it sways" "rod.obj: warning: the lowest mode, of 0." "$err"

{ echo "v 90 90 90" && awk '/^v/ { print $1, 1000 * $2, -1000 * $4, 1000 * $3; next } /^f/ { print $1, $2 + 1, $3 + 1, $4 + 1, $5 + 1 }' \
    "$scratch/box.obj"; } >"$scratch/z.obj"
expect 0 "a mesh in millimetres with z up" "$WIGGLY" simulate "$scratch/z.obj" --up z --scale 0.001 --shake side "${quick[@]}" -o "$scratch/z.npy"
says "with a vertex too many" "z.obj: warning: 1 vertex is part of no triangle" "$err"
tail -n +2 "$scratch/z.rest.obj" | sed -n '/^v/p' | sed 's/-0\b/0/g' | diff -q - <(sed -n '/^v/p' "$scratch/box.rest.obj") >/dev/null
ok "stands as the box does" $?
# A flag is a sheet from its mesh to the character, whose back is drawn, too.
{ printf 'v %s\n' '0 0 0' '.5 0 0' '1 0 0' '0 1 0' '.5 1 0' '1 1 0' && printf 'f %s\n' '1 2 5 4' '2 3 6 5'; } >"$scratch/flag.obj"
pole=(--thickness 0.1 --pin plane:.1,0,0,1,0,0 --shake front --amplitude 0.1)
expect 0 "a flag at its pole" "$WIGGLY" simulate "$scratch/flag.obj" "${pole[@]}" "${quick[@]}" --seconds 2 -o "$scratch/flag.npy"
says "is a sheet" "flag.obj: a sheet 0." "$out"
expect 0 "becomes a character" "$WIGGLY" analyze "$scratch/flag.npy" -o "$scratch/flag.gltf"
holds "that swings to the front" grep -q "along (-\?0.0., -\?0.0., -\?1.00)" <<<"$out"
holds "and has a back" grep -q '"doubleSided": *true' "$scratch/flag.gltf"

# An undamped body that is thrown far needs any number of steps. The two simulations that say how large the error is are made in any case.
expect 0 "an accuracy that is out of reach" "$WIGGLY" simulate "$scratch/box.obj" --tets 60 --seconds 0.5 --damping 0 --amplitude 0.4 \
    --accuracy 1e-4 --budget 0 -o "$scratch/far.npy" --verbose
holds "is searched for within the budget" [ "$(grep -c 'steps a frame: error' <<<"$err")" -eq 1 ]
says "and the error that was reached is said" "far.npy: warning: expected an error of the motion of at most 0.01 %, got " "$err"
says "with what gives less" "--substeps 16 or a larger --budget may come nearer" "$err"

colored() { awk -v a="$1" -v b="$2" '/^v/ { c = $3 > 0 ? a : b; print $0, c, c, c; next } 1' "$scratch/box.obj"; }
colored 9 -9 >"$scratch/white.obj"
colored 90 -90 >"$scratch/whiter.obj"
for name in white whiter; do
    expect 0 "softness where vertices are $name" "$WIGGLY" simulate "$scratch/$name.obj" --soft color "${quick[@]}" -o "$scratch/$name.npy"
done
holds "white is as soft as it gets" cmp -s "$scratch/white.npy" "$scratch/whiter.npy"
# A disk of one block: the old file stays, nothing half-written beside it.
(
    ulimit -f 2
    trap '' XFSZ
    "$WIGGLY" simulate "$scratch/box.obj" --tets 60 --seconds 4 -o "$scratch/box.npy" >"$scratch/full" 2>&1
)
holds "a file that cannot grow is exit status 3" [ $? -eq 3 ]
says "and a sentence" "box.npy" "$(grep -v tetrahedra "$scratch/full")"
holds "the old file is intact" [ "$first" = "$(cat "$scratch/box.npy" | cksum)" ]
holds "no temporary file stays" [ "$(find "$scratch" -name '*box.npy*' | wc -l)" -eq 1 ]

"$WIGGLY" simulate "$scratch/box.obj" --tets 300 --seconds 3000 -o "$scratch/stopped.npy" >"$scratch/begun" 2>/dev/null &
for _ in $(seq 1200); do [ -s "$scratch/begun" ] && break; sleep 0.05; done
kill -INT $!
wait $!
holds "Ctrl+C ends it in order" [ $? -eq 3 ]
holds "and leaves no half a file" [ -z "$(find "$scratch" -name '*stopped*' -o -name '.wiggly*')" ]

# Finding 200 modes of so large a body takes minutes.
"$WIGGLY" simulate "$scratch/box.obj" --tets 8000 --modal 200 --verbose -o "$scratch/stopped.npy" >"$scratch/begun" 2>&1 &
preparing=$!
for _ in $(seq 1200); do grep -q "finding the modes" "$scratch/begun" && break; sleep 0.05; done
says "says what it does before it has a body" "finding the modes" "$(<"$scratch/begun")"
kill -TERM $preparing
for _ in $(seq 200); do kill -0 $preparing 2>/dev/null || break; sleep 0.05; done
! kill -KILL $preparing 2>/dev/null
ok "SIGTERM ends it then, too" $?
wait $preparing
[ $? -eq 3 ] && [ -z "$(find "$scratch" -name '*stopped*' -o -name '.wiggly*')" ]
ok "in order" $?
says "and says so" "interrupted; nothing half-written is left" "$(<"$scratch/begun")"
