# The real binary from the outside: usage, tables, logs, a headless run of the live app; what commands write, and where nothing can be
# written. What its commands say and refuse has test_commands.c.
. tests/check.sh
unset DISPLAY WAYLAND_DISPLAY

make_run() { DISPLAY=:987 make B="$B" SANITIZE="${SANITIZE:-}" LIVE_OUT="$scratch/shown" ARGS="--frames 2 --size 320x320 $*" run; }
# `make run` finds nothing out by itself: whatever became of the display, there is something to show for it.
mkdir "$scratch/shown" # not where the user's own `make run` has left something
tells 0 "make run with a display that does not open says where its picture and log are" \
    "Picture: $scratch/shown/live.png, timing log: $scratch/shown/live.csv" make_run
holds "it leaves a picture" [ -s "$scratch/shown/live.png" ]
holds "and a log" [ -s "$scratch/shown/live.csv" ]
if thorough; then
    expect 0 "make run ARGS=--help" make_run --help
    holds "promises no picture that it did not make" [ ! -e "$scratch/shown/live.png" -a "${out#*Picture:}" = "$out" ]
fi
version=$(sed -n 's/.*define WIGGLY_VERSION "\(.*\)"/\1/p' include/wiggly/wiggly.h)
go_to_scratch
scenes=$root/assets/scenes
tail=$scenes/tail.json

# --- usage: rows of an exit status, words, and a fragment of what is said

usage() {
    local status words fragment
    while IFS='|' read -r status words fragment; do
        # shellcheck disable=SC2086
        tells "$status" "wiggly $words" "$fragment" wiggly $words </dev/null
        [ "$status" = 0 ] || holds "wiggly $words: in one line" [ "$(wc -l <<<"$err")" -eq 1 ]
    done
}
usage <<END_OF_ROWS
0|--version|wiggly $version (
0|-V|wiggly $version (
0|help export|Usage: wiggly export
2|help exprot|did you mean export?
2|slove|unknown command slove (did you mean solve?)
2|xyzzyxyzzy|unknown command xyzzyxyzzy; see
2|$(printf '\033')check|unknown command \x1bcheck
2|--hlep|unknown option --hlep (did you mean --help?)
END_OF_ROWS
expect 0 "--help-all" wiggly --help-all
for command in live solve rig export check simulate analyze flesh; do says "--help-all lists $command" "  $command " "$out"; done
tells 0 "--help lists export" "  export " wiggly --help
holds "--help leaves out what few need" not grep -q "  solve " <<<"$out"
holds "help is --help" [ "$out" = "$(wiggly help)" ]

# --- a table; --solver: solve and live take chain or band; the curves are the same, and the log says which one ran

vectors=$root/tests/vectors/complex_default
tells 0 "solve of a good scene writes the header" "frame,$(sed -n '1s/^frame,\([^,]*\),.*/\1/p' "$vectors.csv")" wiggly solve "$vectors.json"
expect 0 "solve -o" wiggly solve "$vectors.json" -o out.csv
holds "the file has a line a sample and stdout nothing" [ "$out" = "" -a "$(wc -l <out.csv)" -eq "$(wc -l <"$vectors.csv")" ]
expect 1 "a broken scene" wiggly solve "$vectors.csv"
expect 3 "standard output that is full" sh -c '"$0" solve "$1" >/dev/full' "$WIGGLY" "$vectors.json"

replays=$root/tests/replays
for solver in chain band; do
    expect 0 "solve by the $solver" wiggly solve --solver $solver -o $solver.csv "$scenes/figure4.json"
    expect 0 "a session plays by the $solver" wiggly live --no-draw --replay "$replays/session.replay" --frames 300 --solver $solver \
        --log $solver.log --result $solver.json "$replays/session.json"
    holds "its log says so, and of no other" [ "$(grep '^# solver' $solver.log)" = "# solver: $solver" ]
done
holds "the band is the default" cmp -s band.csv <(wiggly solve "$scenes/figure4.json")
for last in "4095 band" "4096 chain"; do
    printf '{"frames": [0, %s], "splines": [{"name": "s", "frequency": 1, "knots": [{"frame": 9, "value": 1}, {"frame": 99, "value": 2}]}]}' "${last% *}" >long.json
    holds "up to frame ${last% *} it is the ${last#* }" cmp -s <(wiggly solve long.json) <(wiggly solve --solver "${last#* }" long.json)
done
holds "the band is another way" not cmp -s chain.csv band.csv
paste -d, chain.csv band.csv | awk -F, 'NR > 1 { n = NF / 2; for (i = 1; i <= n; i++) if (($i - $(n + i)) ^ 2 > 1e-18) exit 1 }'
ok "to the same curves" $?
counters() { grep -v '^#' "$1" | cut -d, -f1,14-17; } # <log>
holds "in each frame the band solved what the chain did" cmp <(counters band.log) <(counters chain.log)
holds "to the same document" cmp band.json chain.json

# --- the live app without a display, and its log

holds "the built-in tail is found from any folder" wiggly live --no-draw --frames 2
expect 0 "live --headless" wiggly live --headless --size 320x320 --frames 70 --log live.csv --screenshot live.png --result end.json
says "prints the summary" "fps on average" "$out"
holds "the picture is a PNG of the size asked for" [ "$(identify -format '%m %wx%h' live.png 2>&1)" = "PNG 320x320" ]
holds "the picture is not empty" [ "$(identify -format '%k' live.png 2>/dev/null || echo 0)" -gt 100 ]
holds "the log has a row a frame" [ "$(grep -cvE '^(#|frame)' live.csv)" -eq 70 ]
allocations=$(awk -F, 'BEGIN { total = 0 }
    /^frame/ { for (c = 1; c <= NF; c++) if ($c == "allocations") column = c; next }
    !/^#/ && $1 >= 60 { if ($column == "NA") unknown = 1; total += $column }
    END { print unknown ? "NA" : total }' live.csv)
holds "playing allocates nothing after frame 60: $allocations" [ "$allocations" = 0 ]
expect 0 "the document at the end is a good scene" wiggly check end.json
expect 0 "it opens again" wiggly live --no-draw --frames 2 end.json

# Two programs draw in turn.
tells 2 "--turns without pipes" "descriptors 3 and 4" sh -c '"$0" live --headless --frames 2 --turns first 3<&- 4>&-' "$WIGGLY"
if draws; then
    mkfifo to-a to-b
    turns="--headless --size 320x320 --scale 0.5"
    "$WIGGLY" live $turns --frames 6 --log turns-a.csv --turns first 3<to-a 4>to-b >said &
    timeout 60 "$WIGGLY" live $turns --frames 9 --log turns-b.csv --turns second 4>to-a 3<to-b >said
    ok "the program that goes on is not held up when the other one has ended" $?
    holds "which ended well" wait $!
    holds "both drew all their frames" [ "$(grep -c '^[0-9]' turns-a.csv) $(grep -c '^[0-9]' turns-b.csv)" = "6 9" ]
    holds "the interval between frames of a program that waits for another is not measured" \
        [ "$(awk -F, '/^[0-9]/ && $4 == "NA"' turns-a.csv | wc -l)" -eq 6 ]
fi

# --- whose a scene is: those that belong to the running binary open as untitled, by whatever path; all others under their own names

mkdir -p tree/build usr/bin own
ln "$WIGGLY" tree/build/wiggly 2>/dev/null || cp "$WIGGLY" tree/build/wiggly
ln tree/build/wiggly usr/bin/wiggly
for folder in tree/assets usr/share/wiggly usr/assets own/assets own/share/wiggly; do
    mkdir -p $folder/scenes
    cp "$tail" $folder/scenes/mine.json
done
cp "$tail" own/linked.json
ln -s ../tree/assets/scenes/mine.json own/link.json
ln -s ../tree/assets own/elsewhere
ln -s ../../../own/linked.json tree/assets/scenes/link.json
# Opens a scene, sets a knot and presses Ctrl+S: without a question, the replay has saved something afterwards.
edit() { # <wiggly> <scene>
    "$1" live --no-draw --size 640x360 --frames 1 --record header "$2" || return
    { sed '/^frames/d' header; printf '%s\n' "frames 20" "5 key Right" "6 key I" "9 key S ctrl"; } >edit.replay
    "$1" live --no-draw --replay edit.replay --saves saves "$2"
}
while IFS='|' read -r wanted what program scene; do
    rm -rf saves
    expect 0 "$what opens" edit $program $scene
    holds "$what: $wanted" [ "$([ -e "saves/${scene##*/}" ] && echo saved || echo untitled)" = "$wanted" ]
done <<'END_OF_ROWS'
untitled|a scene of the tree's|tree/build/wiggly|tree/assets/scenes/mine.json
untitled|one by a link to it|tree/build/wiggly|own/link.json
untitled|one through a link to its folder|tree/build/wiggly|own/elsewhere/scenes/mine.json
untitled|a scene of the installation's|usr/bin/wiggly|usr/share/wiggly/scenes/mine.json
saved|a user's scene in a folder assets/scenes|tree/build/wiggly|own/assets/scenes/mine.json
saved|one in a folder share/wiggly/scenes|tree/build/wiggly|own/share/wiggly/scenes/mine.json
saved|one beside an installation|usr/bin/wiggly|usr/assets/scenes/mine.json
saved|a user's scene by a link among the tree's|tree/build/wiggly|tree/assets/scenes/link.json
END_OF_ROWS

# --- what commands write: never two things to one file, nothing left behind

# A process number that the system never gives, and one that lives.
touch .wiggly-999999999-0.tmp ".wiggly-$$-3.tmp" .wiggly-999999999-0.tmp.mine
expect 0 "a table is written" wiggly solve "$tail" --output plain.csv
holds "what a killed program was writing is removed" [ ! -e .wiggly-999999999-0.tmp ]
holds "what a living one writes stays, and files of others" [ -e ".wiggly-$$-3.tmp" -a -e .wiggly-999999999-0.tmp.mine ]

mkdir pictures
touch pictures/a-0002.png
chmod 600 pictures/a-0002.png
expect 0 "pictures are written" wiggly export "$tail" --frames 0:1 --size 64x36 -o pictures/a.png
holds "and a picture that is replaced stays as private as it was" [ "$(stat -c '%a' pictures/a-0002.png)" = 600 ]

# A pipe with a reader, or a device, is written where the command line names it. test_commands.c has pipes that nobody reads.
mkfifo pipe-0002.png
tells 3 "no export goes to a pipe among its pictures" "expected a file, got something else (a device or a pipe)" \
    timeout 60 "$WIGGLY" export "$tail" --frames 0:1 --size 64x36 -o pipe-%04d.png
holds "which is there still" [ -p pipe-0002.png ]
holds "a device is written" cmp plain.csv <(wiggly solve "$tail" -o /dev/stdout)
wiggly solve "$tail" -o >(cat >piped.csv)
wait $!
holds "a pipe with a reader gets the table" cmp piped.csv plain.csv

# --- no control character of a name on the terminal

escape=$(printf '\033')
red="$scratch/${escape}[31mred"
raw() { case $out$err in *"$escape"*) true ;; *) false ;; esac; }
escaped() { # <status> <what> <how it is shown> <command>...
    tells "$@"
    holds "$2: and nothing raw" not raw
}
cp "$tail" "$red.json"
cp "$root/assets/models/dog.glb" "$red.glb"
tells 1 "a name with control characters" '\x1b[31mred\ntwo.json' wiggly check "$red"$'\n'"two.json"
escaped 0 "writing to such a name" '\x1b[31mred.bvh' wiggly export "$red.json" --frames 0:2 -o "$red.bvh"
escaped 0 "rigging one" 'red.rigged.json' wiggly rig "$red.glb" --chain tail_1:tail_8 -o "$red.rigged.json"
escaped 0 "what such a file holds" '' wiggly check "$red.glb"
# Names within files: a terminal gets them escaped, a file or a pipe as they are.
printf '{"wiggly": 1, "frames": [0, 2], "splines": [{"name": "\\u001b[31mred\\nsecond", "knots": []}]}' >named.json
on_terminal() { script -qec "$(printf '%q ' "$@")" /dev/null </dev/null; } # <command>...
for to in "" "-o /dev/tty"; do
    escaped 0 "a terminal gets a table with names escaped $to" 'frame,\x1b[31mred\nsecond,\x1b[31mred\nsecond.re,' on_terminal "$WIGGLY" solve named.json $to
done
whole="frame,\"${escape}[31mred"$'\n'"second\",\"${escape}[31mred"$'\n'"second.re\","
tells 0 "a pipe gets them as they are" "$whole" wiggly solve named.json
expect 0 "and a file" wiggly solve named.json -o named.csv
says "too" "$whole" "$(<named.csv)"

# --- a locale whose decimal sign is a comma

german() { LOCPATH=$B/locales LC_ALL=de_DE.UTF-8 "$@"; }
mkdir -p "$B/locales" # where the next run finds it
[ -d "$B/locales/de_DE.UTF-8" ] || { localedef -i de_DE -f UTF-8 "$scratch/de_DE.UTF-8" 2>/dev/null && mv "$scratch/de_DE.UTF-8" "$B/locales"; }
if [ "$(german bash -c 'printf %.1f 1,5' 2>/dev/null)" = "1,5" ]; then
    for name in tail figure4 follow; do
        holds "decimal commas: $name is solved as elsewhere" cmp <(wiggly solve "$scenes/$name.json") <(german "$WIGGLY" solve "$scenes/$name.json")
    done
    for ending in glb gltf usda bvh csv; do
        wiggly export "$tail" -o there.$ending --quiet && mv there.$ending elsewhere
        german "$WIGGLY" export "$tail" -o there.$ending --quiet && cmp elsewhere there.$ending
        ok "decimal commas: .$ending is written as elsewhere" $?
    done
    expect 0 "decimal commas: a session" german "$WIGGLY" live --no-draw --replay "$replays/session.replay" --frames 300 --result german.json "$replays/session.json"
    holds "edits and saves as elsewhere" cmp german.json band.json
else
    echo "skip - there is no localedef, or no German"
fi

# --- where nothing can be written

# Each command that writes a file: status 3, one sentence that names it, the old file as it was and nothing beside it.
limited() { (ulimit -f "$1"; shift; exec "$WIGGLY" "$@") 2>&1 | cat >&2; } # <blocks of a file> <wiggly's arguments>...
refused_everywhere() { # <what> <folder> <what the sentence says>
    local command before
    set -o pipefail
    before=$(ls -A "$2"; cat "$2"/old.*)
    for command in "solve $tail -o $2/old.csv" "export $tail -o $2/old.csv" "rig $root/assets/models/dog.glb --chain tail_1:tail_8 -o $2/old.json"; do
        # shellcheck disable=SC2086
        tells 3 "$1: ${command%% *}" "$3" limited "${4:-unlimited}" $command
        holds "$1: ${command%% *} in one sentence" [ "$(printf '%s\n' "$err" | wc -l)" -eq 1 ]
    done
    holds "$1: what was there is as it was, and nothing is left beside it" [ "$before" = "$(ls -A "$2"; cat "$2"/old.*)" ]
}
prepare() { mkdir -p "$1" && echo old >"$1/old.csv" && echo old >"$1/old.json"; }

prepare small
refused_everywhere "a full disk" small "File too large" 0
prepare locked
if mkdir tiny && mount -t tmpfs -o size=16k none tiny 2>/dev/null; then
    at_end() { umount "$scratch/tiny"; umount "$scratch/locked" 2>/dev/null; }
    prepare tiny
    yes >tiny/rest 2>/dev/null
    refused_everywhere "a disk without room" tiny "No space left on device"
    mount -t tmpfs none locked && prepare locked && mount -o remount,ro locked
    refused_everywhere "a read-only disk" locked "Read-only file system"
elif [ "$(id -u)" -ne 0 ]; then
    chmod a-w locked
    refused_everywhere "a read-only folder" locked "Permission denied"
    chmod u+w locked
else
    echo "skip - this root may mount nothing"
fi

# --- files larger than any reader takes: sparse ones, a byte too long

while read -r file limit words; do
    truncate -s $((limit * 1048576 + 1)) "$file"
    tells 1 "$file of $limit MiB and a byte is refused by $words" "$file: expected at most $limit MiB, got a larger file" wiggly $words
    rm "$file"
done <<'END_OF_ROWS'
large.obj 1024 simulate large.obj -o x.npy
large.ply 1024 simulate large.ply -o x.npy
large.stl 1024 simulate large.stl -o x.npy
large.off 1024 simulate large.off -o x.npy
large.glb 256 check large.glb
large.gltf 256 check large.gltf
large.glb 256 live --no-draw large.glb
large.replay 64 live --no-draw --replay large.replay
END_OF_ROWS
# A triangle in a file that is large all the same.
truncate -s 24M large.bin
printf '{"asset":{"version":"2.0"},"buffers":[{"uri":"large.bin","byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36}],
    "accessors":[{"componentType":5126,"type":"VEC3","count":3,"bufferView":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}]}' >large.gltf
expect 0 "a large model opens" wiggly live --no-draw --frames 1 large.gltf
holds "and live says once that it takes a while" [ "$(grep -c "wiggly live: reading a glTF file of 24 MiB: this takes a while" <<<"$err")" -eq 1 ]
