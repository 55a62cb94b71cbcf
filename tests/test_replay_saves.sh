# Where a replay writes: into the folder of --saves, by names alone, else nowhere. A recording from anyone must be safe to play.
. tests/check.sh
mkdir "$scratch/scenes" "$scratch/victims"
cat >"$scratch/scenes/scene.json" <<'END'
{"wiggly": 1, "frames": [0, 4], "splines": [{"name": "sway", "knots": [{"frame": 0, "value": 0}]}],
"rigs": [{"type": "tail", "name": "tail", "position": [0, 0.26, 0], "rest": 2, "spline": "sway"}]}
END
for name in package.json out.csv out.usda out.gif; do echo victim >"$scratch/victims/$name"; done
scene=$scratch/scenes/scene.json
"$WIGGLY" live --no-draw --size 640x360 --frames 1 --record "$scratch/header" "$scene" >/dev/null 2>&1

frame=0
press() { # <key> [modifier]...
    frame=$((frame + 2))
    echo "$frame key $*"
    echo "$frame keyup $1"
}
type_over() { # <text>
    press A ctrl
    for ((i = 0; i < ${#1}; i++)); do printf '%d text U+%04X\n' "$frame" "'${1:i:1}"; done
    for _ in 1 2 3; do press Enter; done # whatever the dialog asks about
    press Escape
}
# Edits, saves, saves as, exports in every way and takes a picture.
{
    press Home
    press Right
    press I
    press S ctrl
    for name in out.csv out.usda out.gif; do
        press E ctrl
        type_over "$scratch/victims/$name"
    done
    press S ctrl shift
    type_over "$scratch/victims/package.json"
    press I
    press S ctrl
    press F12
} >"$scratch/events"
{ sed '/^frames/d' "$scratch/header"; echo "frames $((frame + 20))"; cat "$scratch/events"; } >"$scratch/all.replay"
cp -r "$scratch/scenes" "$scratch/victims" "$(mkdir "$scratch/before" && echo "$scratch/before")"
untouched() { diff -r "$scratch/before/scenes" "$scratch/scenes" && diff -r "$scratch/before/victims" "$scratch/victims"; }
program=$(realpath "$WIGGLY")
play() { (cd "$scratch/scenes" && "$program" live ${draw:---headless} --replay ../all.replay "$@" scene.json); }

expect 0 "a replay that saves, exports and takes a picture" play --result "$scratch/nowhere.json"
holds "writes nothing" untouched
expect 0 "with --saves" play --result "$scratch/somewhere.json" --saves "$scratch/saves"
holds "it writes there" [ "$(cd "$scratch/saves" && ls)" = "out.csv
out.gif
out.usda
package.json
scene.json
wiggly-0001.png" ]
holds "and nowhere else" untouched
knots() { grep -o '"frame":' "$1" | wc -l; }
holds "with the knot that it made" [ "$(knots "$scratch/saves/package.json")" -gt "$(knots "$scene")" ]
expect 0 "which is whole" "$WIGGLY" check "$scratch/saves/package.json"
holds "and goes on as without" cmp "$scratch/nowhere.json" "$scratch/somewhere.json"
draw=--no-draw expect 0 "a folder with the scene itself" play --saves .
holds "keeps the scene" cmp "$scratch/before/scenes/scene.json" "$scene"
expect 2 "--saves without a replay" "$WIGGLY" live --no-draw --frames 2 --saves "$scratch/saves" "$scene"
says "is refused" "--saves is for what a replay writes: expected --replay, too" "$err"
