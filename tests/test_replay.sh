# Replays, played by the real binary: the committed session, replays of a few lines, ones that do not fit, where a replay writes; and jobs
# of an animator, done by events. Lines that are refused has test_boundaries_files.c.
. tests/check.sh
unset DISPLAY WAYLAND_DISPLAY
go_to_scratch
replays=$root/tests/replays
session=$replays/session.json
header=$(sed '/^frames/q' "$replays/session.replay")

play() { # <replay> <scene> <name> [option]...
    wiggly live --no-draw --replay "$1" --log "$3.csv" --result "$3.json" "${@:4}" "$2"
}
plays() { play "$replays/$1.replay" "$replays/$1.json" "$1" "${@:2}"; } # <name> [option]...: a committed one
lines() { # <scene> <frames> <line>...: a replay of them
    printf '%s\n' "$header" "${@:3}" >lines.replay
    play lines.replay "$1" lines --frames "$2"
}

# --- the committed session: it ends in the same document byte by byte and solves the same splines and samples each time

# Rows without times: what was solved, keyed and edited in each frame that did any of it.
counters() { grep -v '^#' "$1" | cut -d, -f1,14-17 | grep -v ',0,0,0,0$'; } # <log>
# Frames that allocate though nothing is edited in them. Where a drag ends, the history keeps the document as it is: a handful.
wasteful() { grep -v '^[#f]' "$1" | awk -F, '$1 > 0 && $17 == 0 && $19 > 8' | wc -l; } # <log>

# Recording while it plays gives plain positions.
expect 0 "the session plays" plays session --record recorded.replay
holds "it ends in the committed document" cmp session.json "$replays/session.result.json"
holds "each frame solves what it solved when it was committed" cmp <(counters session.csv) "$replays/session.counters.csv"
holds "it has 1,200 frames" [ "$(grep -vc '^[#f]' session.csv)" -eq 1200 ]
expect 0 "what was recorded plays" play recorded.replay "$session" second
holds "to the same document" cmp second.json session.json
expect 0 "which is a scene" wiggly check session.json
# The one for the frame budget: eight splines, 200 knots, every panel, overlay and kind of drag. Drawn, too, with small pictures.
expect 0 "the full session plays" plays full $(quickly --frames 240)
! draws || expect 0 "and is drawn" wiggly live --headless --scale 0.5 --replay "$replays/full.replay" --log drawn.csv $(quickly --frames 45) "$replays/full.json"
# A hand of the creature goes round at its frame, the other one's pin goes to another frame.
expect 0 "pins are dragged" play "$replays/pins.replay" "$root/assets/scenes/hands.json" pins
holds "one of them in time" grep -q '"frame": 84, "vertex": 2711' pins.json
for log in session full drawn pins; do
    [ ! -e $log.csv ] || holds "no frame of $log without an edit allocates" [ "$(wasteful $log.csv)" -eq 0 ]
done

# --- replays of a few lines, and ones that do not fit

tells 1 "a replay of another scene" "recorded on another scene" play "$replays/session.replay" "$root/tests/vectors/figure1.json" other
sed 's/^0* *\(40 pointer\).*/40 pointer @knot(nobody,2)/' "$replays/session.replay" >nobody.replay
tells 1 "a target that is not there" "nobody.replay:9: @knot(nobody,2) is not on the screen: there is no spline \"nobody\"" play nobody.replay "$session" nobody
expect 0 "the smallest window, CRLF, blank lines, a wheel with all modifiers" \
    lines "$session" 40 $'5 size 64 64\r' "  " $'\t' "9 wheel 0 1 400 500 shift ctrl alt super"
expect 0 "a paste" lines "$session" 40 "5 key Escape" "6 paste 0,0.5%0a1,0.25%20"
holds "sets the knots of its text" grep -q '"value": 0.25 }' lines.json
# A recording whose program was killed has no length yet: it ends with its last event.
printf '%s\n' "${header%frames*}frames 0" "5 key A" "12 key Escape" >killed.replay
expect 0 "a recording that was cut short" play killed.replay "$session" killed
holds "plays to its last event" [ "$(grep -vc '^[#f]' killed.csv)" -eq 13 ]

# A figure of the paper opens as an untitled scene, without a question unless work would be lost.
cp "$session" own.json
for n in 1 2 3 4 5 6; do
    expect 0 "figure $n opens" lines own.json 20 "$(example 5 "figure $n")"
    holds "it is the scene of assets" cmp lines.json <(wiggly live --no-draw --frames 1 --result /dev/stdout "$root/assets/scenes/figure$n.json" | sed '/^}$/q')
done
expect 0 "a figure is no file's" lines own.json 40 "$(example 2 "figure 4")" "4 key S ctrl"
holds "saving one leaves the file that was open before alone" cmp own.json "$session"

# --- where a replay writes: into the folder of --saves, by names alone, else nowhere. One from anyone must be safe to play

mkdir scenes victims before
cat >scenes/scene.json <<'END_OF_SCENE'
{"wiggly": 1, "frames": [0, 4], "splines": [{"name": "sway", "knots": [{"frame": 0, "value": 0}]}],
"rigs": [{"type": "tail", "name": "tail", "position": [0, 0.26, 0], "rest": 2, "spline": "sway"}]}
END_OF_SCENE
for name in package.json out.csv out.usda out.gif; do echo victim >victims/$name; done
wiggly live --no-draw --size 640x360 --frames 1 --record header scenes/scene.json >said 2>&1

frame=0
press() { # <key> [modifier]...
    frame=$((frame + 2))
    printf '%s\n' "$frame key $*" "$frame keyup $1"
}
type_over() { # <text>
    press A ctrl
    for ((i = 0; i < ${#1}; i++)); do printf '%d text U+%04X\n' "$frame" "'${1:i:1}"; done
    for _ in 1 2 3; do press Enter; done # whatever the dialog asks about
    press Escape
}
{ # edits, saves, exports in every way, saves as, and takes a picture
    for key in Home Right I "S ctrl"; do press $key; done
    for name in out.csv out.usda out.gif; do press E ctrl && type_over "$scratch/victims/$name"; done
    press S ctrl shift
    type_over "$scratch/victims/package.json"
    for key in I "S ctrl" F12; do press $key; done
} >events
{ sed '/^frames/d' header; echo "frames $((frame + 20))"; cat events; } >all.replay
cp -r scenes victims before
untouched() { diff -r before/scenes scenes && diff -r before/victims victims; }
all() { (cd scenes && wiggly live "$1" --replay ../all.replay "${@:2}" scene.json); } # <how it is drawn> <option>...

expect 0 "a replay that saves, exports and takes a picture" all --headless --result ../nowhere.json
holds "writes nothing" untouched
expect 0 "with --saves" all --headless --result ../somewhere.json --saves ../saves
holds "it writes there" [ "$(ls saves | xargs)" = "out.csv out.gif out.usda package.json scene.json wiggly-0001.png" ]
holds "and nowhere else" untouched
holds "with the knot that it made" [ "$(grep -o '"frame":' saves/package.json | wc -l)" -gt 1 ]
expect 0 "which is whole" wiggly check saves/package.json
holds "and goes on as without" cmp nowhere.json somewhere.json
expect 0 "a folder with the scene itself" all --no-draw --saves .
holds "keeps the scene" cmp before/scenes/scene.json scenes/scene.json
tells 2 "--saves without a replay" "--saves is for what a replay writes: expected --replay, too" \
    wiggly live --no-draw --frames 2 --saves saves scenes/scene.json

# --- jobs of an animator: what counts is the motion, degrees of every joint, a row a frame

motion() { wiggly export "$1.json" -o "$1.csv"; } # <name>
from_root() { (cd "$root" && wiggly "$@"); } # a recording knows a character by its name
job() { # <what> <job> <name> <scene> [option]...
    expect 0 "$1" from_root live --no-draw --replay "tests/replays/$2.replay" --result "$scratch/$3.json" "${@:5}" "$4"
    expect 0 "$1: its motion" motion "$3"
}
# The largest difference of joints, those whose column begins so, in frames from … to: from those of another motion, all from one frame
# of it if that is named; without one, from rest.
: >none.csv
off() { # <name> <columns> <from> <to> [other name] [frame]
    awk -F, -v columns="$2" -v from="$3" -v to="$4" -v frame="${6-}" '
        FNR == 1 { for (i = 2; i <= NF; i++) counts[i] = index($i, columns) == 1; next }
        reads == "other" { for (i in counts) if (frame == "" || $1 == frame) at[frame == "" ? $1 : frame, i] = $i; next }
        $1 >= from && $1 <= to { for (i in counts) if (counts[i]) {
            seen++; d = $i - at[frame == "" ? $1 : frame, i]; d = d < 0 ? -d : d; most = d > most ? d : most } }
        END { print seen ? most + 0 : "nothing" }' reads=other "${5:-none}.csv" reads=own "$1.csv"
}
actions() { sed "/^${2:-no more} /q" "$replays/$1.replay" | grep -E '^[0-9]+ (key|press) ' | grep -cvE ' key (Space|Left|Home|O)\b'; } # <job> [last frame]: without keys that only look
below() { awk -v value="$1" -v most="$2" 'BEGIN { exit !(value ~ /^[0-9.e-]+$/ && value <= most) }'; } # <value> <most>
above() { awk -v value="$1" -v least="$2" 'BEGIN { exit !(value ~ /^[0-9.e-]+$/ && value >= least) }'; } # <value> <least>
moves() { # rows: what~above or below~how many degrees~off's arguments
    local what how degrees arguments
    while IFS='~' read -r what how degrees arguments; do holds "$what" "$how" "$(eval "off $arguments")" "$degrees"; done
}

# An idle, 120 frames around: still ears that flick once, and the tail in a pose at frame 60.
job "an ear flicks and the tail is put in a pose" idle posed tests/replays/idle.json --frames 125
holds "in 14 actions" [ "$(actions idle 120)" = 14 ]
holds "still knots stand before and after the flick" [ "$(grep -c '"still": true' posed.json)" = 2 ]
holds "both splines of the tail have a pose at frame 60" [ "$(grep -c '"frame": 60, .*"im"' posed.json)" = 2 ]
job "then other knots move and go, and the frequency rises" idle changed tests/replays/idle.json
sed 's/"damping": 0.12/"damping": 0.4/; s/"bandwidth": 0.1/"bandwidth": 0.3/; s/"frame": 30, "value": 0.15/"frame": 57, "value": -0.5/' changed.json >more.json
expect 0 "damping, bandwidth and a knot close by change, too" motion more
moves <<'END_OF_ROWS'
the left ear is still until frame 30~below~1e-6~posed "left ear." 0 30
the right ear is still until frame 30~below~1e-6~posed "right ear." 0 30
the left ear flicks~above~10~posed "left ear." 31 43
the right ear flicks~above~10~posed "right ear." 31 43
the left ear is still again from frame 44 on~below~1e-6~posed "left ear." 44 120
the right ear is still again from frame 44 on~below~1e-6~posed "right ear." 44 120
the loop closes~below~1e-9~posed tail. 0 0 posed 120
by the change the tail moves otherwise~above~5~changed tail. 0 120 posed
but at frame 60 each joint is where it was put~below~1e-9~changed tail. 60 60 posed
and the ears are as they were~below~1e-9~changed "left ear." 0 120 posed
more changes move the tail elsewhere~above~5~more tail. 0 120 changed
not at frame 60~below~1e-9~more tail. 60 60 posed
END_OF_ROWS

# A tail, held up until frame 48, that falls, overshoots and stays.
job "a tail is pulled up, and down, and settles at both" held held tests/replays/held.json
holds "in four actions" [ "$(actions held)" = 4 ]
holds "both ways that it bends settle at frames 0 and 62" [ "$(grep -cE '"frame": (0|62), "settles": true' held.json)" = 4 ]
moves <<'END_OF_ROWS'
it is up~above~1.5~held tail.up. 0 0
no joint moves until frame 48~below~1e-9~held tail. 0 48 held 0
then it falls~above~3~held tail. 64 64 held 0
swings less each time~below~0.9~held tail.up. 116 144 held 144
and stays down~above~1.3~held tail.up. 144 144
END_OF_ROWS
holds "it falls beyond its new place" awk -F, '$1 == 62 { there = $2 } $1 == 68 { exit !($2 < 1.5 * there) }' held.csv

job "twenty noisy knots become few" messy messy tests/replays/messy.json
holds "in one action" [ "$(actions messy)" = 1 ]
holds "at most five" [ "$(grep -c '"frame":' messy.json)" -le 5 ]
job "six splines get one feel" six six tests/replays/six.json
holds "in two actions" [ "$(actions six)" = 2 ]
holds "which all have" [ "$(grep -c '"damping": 0.35' six.json)" = 6 ]

holds "a soft body is posed through two frames in two actions" [ "$(actions pins)" = 2 ]

job "a tail is pulled to where it cannot go" pull pull assets/scenes/tail.json
holds "both ways that it bends have a pose there" [ "$(grep -c '"frame": 80, .*"im"' pull.json)" = 2 ]
holds "which is not far" not grep -qE '"frame": 80, ("value": -?[1-9][^}]*"im"|.*"im": -?[1-9])' pull.json

# A walk, and the other clips of its file.
dog=$root/assets/models/dog.glb
job "a walk gets follow-through" walk walk assets/models/dog.glb
holds "in five actions" [ "$(actions walk)" = 5 ]
moves <<'END_OF_ROWS'
the tail swings~above~2~walk tail. 0 24
and its loop closes~below~1e-9~walk tail. 0 0 walk 24
an ear swings~above~2~walk ear_1_L. 0 24
and its loop closes~below~1e-9~walk ear_1_L. 0 0 walk 24
END_OF_ROWS
expect 0 "and so do all clips of the file" wiggly export walk.json --all-clips -o pack.glb
says "which are there" "  Walk (1 s, loops)
  Trot (0.583 s, loops)
  Idle (5 s, loops)" "$(wiggly rig pack.glb)"
numbers() { od -An -v -tf4 -w4; }
open_by() { # <name>: the largest distance along an axis between the first and the last frame
    local frame=$((12 * $(od -An -tu4 -j16 -N4 "$1.pc2")))
    paste <(tail -c +33 "$1.pc2" | head -c $frame | numbers) <(tail -c $frame "$1.pc2" | numbers) |
        awk '{ d = $1 - $2; d = d < 0 ? -d : d; most = d > most ? d : most } END { print NR ? most + 0 : "nothing" }'
}
for clip in Walk Trot Idle; do
    expect 0 "$clip as it was" wiggly rig "$dog" --chain tail_1 --plain --clip $clip -o before.pc2
    expect 0 "$clip as it is" wiggly rig pack.glb --chain tail_1 --plain --clip $clip -o after.pc2
    holds "are as long" [ "$(stat -c %s before.pc2)" = "$(stat -c %s after.pc2)" ]
    holds "and not the same" not cmp -s before.pc2 after.pc2
    holds "the loop closes" below "$(open_by after)" 1e-5
done

draws || exit $cases_failed
for frame in 0 40 66; do expect 0 "a picture of frame $frame" wiggly export held.json -o $frame.png --frames $frame:$frame --size 160x90 --quiet; done
holds "before frame 48 it stands still" cmp -s 0.png 40.png
holds "then it falls" not cmp -s 0.png 66.png
