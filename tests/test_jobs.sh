# Jobs of an animator, done by events in the real app: an ear flicks once in an idle whose tail hits a pose, a tail is held up and falls, a
# walk and then a whole pack of clips get follow-through. What counts is the motion: degrees of every joint, a row a frame.
. tests/check.sh
unset DISPLAY WAYLAND_DISPLAY
: >"$scratch/none.csv"

play() { # <job> <name> [option]...
    local job=$1 name=$2
    shift 2
    "$WIGGLY" live --no-draw --replay tests/replays/$job.replay --result "$scratch/$name.json" "$@" "${scene:-tests/replays/$job.json}" &&
        motion "$name"
}
motion() { "$WIGGLY" export "$scratch/$1.json" -o "$scratch/$1.csv"; } # <name>

# The largest difference of joints, those whose column begins so, in frames from … to: from those of another motion, all from one frame
# of it if that is named; without one, from rest.
off() { # <name> <columns> <from> <to> [other name] [frame]
    awk -F, -v columns="$2" -v from="$3" -v to="$4" -v frame="${6-}" '
        FNR == 1 { for (i = 2; i <= NF; i++) counts[i] = index($i, columns) == 1; next }
        reads == "other" { for (i in counts) if (frame == "" || $1 == frame) at[frame == "" ? $1 : frame, i] = $i; next }
        $1 >= from && $1 <= to { for (i in counts) if (counts[i]) {
            seen++; d = $i - at[frame == "" ? $1 : frame, i]; d = d < 0 ? -d : d; most = d > most ? d : most } }
        END { print seen ? most + 0 : "nothing" }' reads=other "$scratch/${5:-none}.csv" reads=own "$scratch/$1.csv"
}
below() { awk -v value="$1" -v most="$2" 'BEGIN { exit !(value ~ /^[0-9.e-]+$/ && value <= most) }'; } # <value> <most>
above() { awk -v value="$1" -v least="$2" 'BEGIN { exit !(value ~ /^[0-9.e-]+$/ && value >= least) }'; }

# --- an idle, 120 frames around: still ears that flick once, and the tail in a pose at frame 60

expect 0 "an ear flicks and the tail is put in a pose" play idle posed --frames 125
holds "still knots stand before and after the flick" [ "$(grep -c '"still": true' "$scratch/posed.json")" = 2 ]
holds "both splines of the tail have a pose at frame 60" [ "$(grep -c '"frame": 60, .*"im"' "$scratch/posed.json")" = 2 ]
for ear in left right; do
    holds "the $ear ear is still until frame 30" below "$(off posed "$ear ear." 0 30)" 1e-6
    holds "flicks" above "$(off posed "$ear ear." 31 43)" 10
    holds "and is still again from frame 44 on" below "$(off posed "$ear ear." 44 120)" 1e-6
done
holds "the loop closes" below "$(off posed tail. 0 0 posed 120)" 1e-9

expect 0 "then other knots move and go, and the frequency rises" play idle changed
holds "by which the tail moves otherwise" above "$(off changed tail. 0 120 posed)" 5
holds "but at frame 60 each joint is where it was put" below "$(off changed tail. 60 60 posed)" 1e-9
holds "and the ears are as they were" below "$(off changed "left ear." 0 120 posed)" 1e-9
sed 's/"damping": 0.12/"damping": 0.4/; s/"bandwidth": 0.1/"bandwidth": 0.3/; s/"frame": 30, "value": 0.15/"frame": 57, "value": -0.5/' \
    "$scratch/changed.json" >"$scratch/more.json"
expect 0 "damping, bandwidth and a knot close by change, too" motion more
holds "which moves the tail elsewhere" above "$(off more tail. 0 120 changed)" 5
holds "not at frame 60" below "$(off more tail. 60 60 posed)" 1e-9

# --- a tail, held up until frame 48, that falls, overshoots and stays

expect 0 "a tail is pulled up, and down, and settles at both" play held held
holds "in three drags and keys" [ "$(grep -cE '^[0-9]+ (key [AP]|press left @tail)' tests/replays/held.replay)" -le 5 ]
holds "both ways that it bends settle at frames 0 and 62" [ "$(grep -cE '"frame": (0|62), "settles": true' "$scratch/held.json")" = 4 ]
holds "it is up" above "$(off held tail.up. 0 0)" 1.5
holds "no joint moves until frame 48" below "$(off held tail. 0 48 held 0)" 1e-9
holds "then it falls" above "$(off held tail. 64 64 held 0)" 3
holds "beyond its new place" awk -F, '$1 == 62 { there = $2 } $1 == 68 { exit !($2 < 1.5 * there) }' "$scratch/held.csv"
holds "swings less each time" below "$(off held tail.up. 116 144 held 144)" 0.9
holds "and stays down" above "$(off held tail.up. 144 144)" 1.3

# --- a tail, pulled where it hardly moves

scene=assets/scenes/tail.json
expect 0 "a tail is pulled to where it cannot go" play pull pull
holds "both ways that it bends have a pose there" [ "$(grep -c '"frame": 80, .*"im"' "$scratch/pull.json")" = 2 ]
holds "which is not far" not grep -qE '"frame": 80, ("value": -?[1-9][^}]*"im"|.*"im": -?[1-9])' "$scratch/pull.json"

# --- a walk, and the other clips of its file

scene=assets/models/dog.glb
expect 0 "a walk gets follow-through" play walk walk
holds "in ten actions or fewer" [ "$(grep -cE '^[0-9]+ (key|press) ' tests/replays/walk.replay)" -le 10 ]
for chain in tail ear_1_L; do
    holds "$chain swings" above "$(off walk $chain. 0 24)" 2
    holds "and its loop closes" below "$(off walk $chain. 0 0 walk 24)" 1e-9
done
expect 0 "and so do all clips of the file" "$WIGGLY" export "$scratch/walk.json" --all-clips -o "$scratch/pack.glb"
says "which are there" "  Walk (1 s, loops)
  Trot (0.583 s, loops)
  Idle (5 s, loops)" "$("$WIGGLY" rig "$scratch/pack.glb")"
vertices() { "$WIGGLY" rig "$1" --chain tail_1 --plain --clip "$2" -o "$scratch/$3.pc2"; } # <file> <clip> <name>
numbers() { od -An -v -tf4 -w4; }
# The largest distance along an axis between the first and the last frame.
open_by() { # <name>
    local frame=$((12 * $(od -An -tu4 -j16 -N4 "$scratch/$1.pc2")))
    paste <(tail -c +33 "$scratch/$1.pc2" | head -c $frame | numbers) <(tail -c $frame "$scratch/$1.pc2" | numbers) |
        awk '{ d = $1 - $2; d = d < 0 ? -d : d; most = d > most ? d : most } END { print NR ? most + 0 : "nothing" }'
}
for clip in Walk Trot Idle; do
    expect 0 "$clip as it was" vertices $scene $clip before
    expect 0 "and as it is" vertices "$scratch/pack.glb" $clip after
    holds "are as long" [ "$(stat -c %s "$scratch/before.pc2")" = "$(stat -c %s "$scratch/after.pc2")" ]
    holds "and not the same" not cmp -s "$scratch/before.pc2" "$scratch/after.pc2"
    holds "the loop closes" below "$(open_by after)" 1e-5
done

if "$WIGGLY" live --headless --frames 1 >/dev/null 2>&1; then
    picture() { "$WIGGLY" export "$scratch/held.json" -o "$scratch/$1.png" --frames "$1:$1" --size 160x90 --quiet; } # <frame>
    expect 0 "a picture of the start" picture 0
    expect 0 "one of a frame before 48" picture 40
    expect 0 "and one of the fall" picture 66
    holds "the first two are the same" cmp -s "$scratch/0.png" "$scratch/40.png"
    holds "the third is not" not cmp -s "$scratch/0.png" "$scratch/66.png"
else
    echo "skip - nothing is drawn here"
fi
