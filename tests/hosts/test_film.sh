# wiggly export to pictures and films: as many as asked for, of that size, showing the scene; and nothing left behind by a failure.
. tests/check.sh
tail=assets/scenes/tail.json
small="--size 160x90 --quiet"

count() { # <pattern>
    find "$scratch/out" -name "$1" | wc -l
}
is() { # <what> <expected> <got>
    [ "$2" = "$3" ] || printf '  expected %s, got %s\n' "$2" "$3"
    ok "$1" $(([ "$2" = "$3" ]); echo $?)
}
nothing_left() { # <what>
    is "$1" "" "$(ls -A "$scratch/out")"
}
fresh() {
    rm -rf "$scratch/out"
    mkdir "$scratch/out"
}

# One picture a second of a loop of five seconds.
fresh
expect 0 "a plain .png" "$WIGGLY" export $tail -o "$scratch/out/walk.png" --fps 1 $small
is "is a sequence, both ends among it" 6 "$(count 'walk-000[1-6].png')"
holds "a loop ends as it began" cmp -s "$scratch/out/walk-0001.png" "$scratch/out/walk-0006.png"
holds "and moves meanwhile" not cmp -s "$scratch/out/walk-0001.png" "$scratch/out/walk-0003.png"
expect 0 "two rounds" "$WIGGLY" export $tail -o "$scratch/out/round%03d.png" --fps 1 --loops 2 $small
is "have each frame once" 10 "$(count 'round0??.png')"
holds "the second is the first again" cmp -s "$scratch/out/round001.png" "$scratch/out/round006.png"
expect 0 "frames 24 to 48" "$WIGGLY" export $tail -o "$scratch/out/part.png" --fps 1 --frames 24:48 $small
holds "begin with what is there at frame 24" cmp -s "$scratch/out/part-0001.png" "$scratch/out/walk-0002.png"
expect 0 "two frames" "$WIGGLY" export $tail -o "$scratch/out/two.png" --frames 24:25 --size 160x90
says "say what they are" "two.png: 2 pictures of 160 × 90, 24 a second" "$out"
expect 0 "one frame" "$WIGGLY" export $tail -o "$scratch/out/one.png" --frames 24:24 $small
holds "keeps its name" cmp -s "$scratch/out/one.png" "$scratch/out/walk-0002.png"

if command -v convert >/dev/null; then
    brightness() { convert "$1" -crop "$2" -colorspace gray -format '%[fx:int(100*mean)]' info:; }
    is "of the size asked for" 160x90 "$(identify -format '%wx%h' "$scratch/out/one.png")"
    expect 0 "a transparent picture" "$WIGGLY" export assets/scenes/figure7.json -o "$scratch/out/bear.png" \
        --frames 24:24 --transparent $small
    read -r width height left top <<<"$(convert "$scratch/out/bear.png" -alpha extract -trim -format '%w %h %X %Y' info:)"
    [ $((2 * left + width)) -gt 140 ] && [ $((2 * left + width)) -lt 180 ] && [ $((2 * top + height)) -gt 70 ] &&
        [ $((2 * top + height)) -lt 110 ] && [ "$height" -gt 45 ]
    ok "shows the character in the middle: $width × $height at $left, $top" $?
    is "and nothing around it" 0 "$(convert "$scratch/out/bear.png" -alpha extract -crop 20x90+0+0 -format '%[fx:mean]' info:)"
    expect 0 "the light theme" "$WIGGLY" export $tail -o "$scratch/out/light.png" --frames 24:24 --theme light $small
    [ "$(brightness "$scratch/out/light.png" 20x10+0+0)" -gt 80 ] && [ "$(brightness "$scratch/out/one.png" 20x10+0+0)" -lt 20 ]
    ok "is light, the other one dark" $?
else
    echo "skip - pictures are not looked into, as ImageMagick is missing"
fi

# A .gif needs no other program. ImageMagick reads it back.
fresh
while read -r scene theme rate size delays; do
    options="--loops 1 --theme $theme --fps $rate --size $size --quiet"
    expect 0 "a .gif of $scene, $theme" env PATH="$scratch/none" "$(realpath "$WIGGLY")" export assets/scenes/$scene.json -o "$scratch/out/$scene.gif" $options
    command -v convert >/dev/null || continue
    "$WIGGLY" export assets/scenes/$scene.json -o "$scratch/out/$scene-%d.png" $options
    rm -f "$scratch"/out/seen-*
    convert "$scratch/out/$scene.gif" -coalesce "$scratch/out/seen-%d.png"
    is "has as many pictures" "$(count "$scene-*.png")" "$(count 'seen-*.png')"
    is "of the size, the delays in turn" "$size $delays" \
        "$(identify -format '%wx%h\n' "$scratch/out/seen-0.png") $(identify -format '%T ' "$scratch/out/$scene.gif" | cut -d ' ' -f 1-6)"
    is "which repeat forever" "Iterations: 0" "$(identify -verbose "$scratch/out/$scene.gif" | grep -o 'Iterations: .*' | uniq)"
    worst=$(for ((i = 1; i <= $(count "$scene-*.png"); i++)); do
        compare -metric RMSE "$scratch/out/$scene-$i.png" "$scratch/out/seen-$((i - 1)).png" null: 2>&1 | sed 's/.*(\(.*\))/\1\n/'
    done | sort -g | tail -1)
    holds "and look as the pictures do: off by $worst" awk -v off="$worst" 'BEGIN { exit !(off > 0 && off < 0.006) }'
done <<END
tail dark 3 161x91 33 34 33 33 34 33
character light 2 160x90 50 50 50 50 50 50
END
sed 's/"fps": *[0-9.]*/"fps": 60/' $tail >"$scratch/fast.json"
expect 0 "no more pictures a second than players show, of a faster scene" "$WIGGLY" export "$scratch/fast.json" -o "$scratch/out/tail.gif" --frames 0:6 --size 32x18
says "but as many" "5 pictures of 32 × 18, 50 a second" "$out"

fresh
# ffmpeg missing, dying, and waited for: stand-ins.
mkdir "$scratch/empty" "$scratch/dying" "$scratch/slow"
expect 3 "without ffmpeg there is no film" env PATH="$scratch/empty" "$(realpath "$WIGGLY")" export $tail -o "$scratch/out/walk.mp4" $small
says "the package is named, and what works without" "install the package ffmpeg, or write .gif or .png" "$err"
printf '#!/bin/sh\nhead -c 1000 >/dev/null\necho "no room for this film" >&2\nexit 1\n' >"$scratch/dying/ffmpeg"
printf '#!/bin/sh\necho begun\nfor i in $(seq 300); do sleep 0.1; done\necho late >%s/late\n' "$scratch" >"$scratch/slow/ffmpeg"
chmod +x "$scratch"/*/ffmpeg
expect 3 "if ffmpeg gives up there is none either" env PATH="$scratch/dying:$PATH" "$WIGGLY" export $tail -o "$scratch/out/walk.mp4" $small
says "in its own words" "ffmpeg cannot write it: no room for this film" "$err"
echo old >"$scratch/out/walk.mp4"
PATH="$scratch/slow:$PATH" "$WIGGLY" export $tail --size 640x360 -o "$scratch/out/walk.mp4" 2>"$scratch/stderr" &
program=$!
until find "$scratch/out" -name '.wiggly*' -size +0 | grep -q . || ! kill -0 $program 2>/dev/null; do sleep 0.05; done
kill -TERM $program
status=0
wait $program || status=$?
is "a film that is interrupted ends at once" 3 $status
holds "without waiting for ffmpeg" [ ! -e "$scratch/late" ]
is "and leaves what was there before" "walk.mp4 old" "$(ls -A "$scratch/out") $(cat "$scratch/out/walk.mp4")"
"$WIGGLY" export $tail --fps 2400 --size 640x360 -o "$scratch/out/walk.png" 2>"$scratch/stderr" &
program=$!
until find "$scratch/out" -name walk-0002.png | grep -q . || ! kill -0 $program 2>/dev/null; do sleep 0.05; done
kill -TERM $program
status=0
wait $program || status=$?
is "so does a sequence" "3 walk.mp4" "$status $(ls -A "$scratch/out")"

# The same from the app: Ctrl+E, a name, Enter. The document is the one on the table, edits and all.
fresh
expect 0 "a recording to go on from" "$WIGGLY" live $tail --no-draw --frames 1 --record "$scratch/begin.txt"
keys() { # <name>: a replay that exports to it
    sed 's/^frames .*/frames 12/' "$scratch/begin.txt"
    printf '1 key E ctrl\n1 keyup E\n'
    for ((i = 0; i < ${#1}; i++)); do printf '2 text U+%04X\n' "'${1:i:1}"; done
    printf '3 key Enter\n3 keyup Enter\n'
}
keys from_app.csv >"$scratch/export.txt"
expect 0 "the app exports a table" "$WIGGLY" live $tail --no-draw --replay "$scratch/export.txt" --saves "$scratch/out"
"$WIGGLY" export $tail -o "$scratch/out/from_command.csv" --quiet
holds "which is the one that the command writes" cmp "$scratch/out/from_app.csv" "$scratch/out/from_command.csv"
"$WIGGLY" live assets/scenes/dog.json --no-draw --frames 1 --record "$scratch/begin.txt" >/dev/null 2>&1
keys dog_from_app.glb >"$scratch/export.txt"
expect 0 "the app exports the dog" "$WIGGLY" live assets/scenes/dog.json --no-draw --replay "$scratch/export.txt" --saves "$scratch/out"
"$WIGGLY" export assets/scenes/dog.json -o "$scratch/out/dog_from_command.glb" --quiet
cmp "$scratch/out/dog_from_app.glb" "$scratch/out/dog_from_command.glb"
ok "whose tail follows the clip as the command has it" $?
"$WIGGLY" live $tail --no-draw --frames 1 --record "$scratch/begin.txt" >/dev/null 2>&1
keys walk.glb >"$scratch/export.txt"
expect 0 "a folder that is not there stops nothing" "$WIGGLY" live $tail --no-draw --replay "$scratch/export.txt" --saves "$scratch/no/ne"

if ! command -v ffmpeg >/dev/null || ! command -v ffprobe >/dev/null; then
    echo "skip - no films are made, as ffmpeg is missing"
    exit 0
fi
fresh
probe() { # <file>
    ffprobe -loglevel error -count_frames -show_entries stream=width,height,nb_read_frames,r_frame_rate -of csv=p=0 "$1"
}
for ending in mp4 $(thorough && echo webm); do
    expect 0 ".$ending" "$WIGGLY" export $tail -o "$scratch/out/walk.$ending" --size 161x91 --frames 0:24 --fps 12
    is ".$ending: the next even size, all frames, the rate" 162,92,12/1,13 "$(probe "$scratch/out/walk.$ending")"
    says ".$ending: says so" "pictures of 16" "$out"
done
is "and nothing besides" $(thorough && echo 2 || echo 1) "$(ls -A "$scratch/out" | wc -l)"
if command -v convert >/dev/null; then
    "$WIGGLY" export $tail -o "$scratch/out/last.png" --frames 24:24 --size 162x92 --quiet
    ffmpeg -loglevel error -i "$scratch/out/walk.mp4" -vf 'select=eq(n\,12)' -frames:v 1 "$scratch/out/seen.png"
    off=$(compare -metric RMSE "$scratch/out/last.png" "$scratch/out/seen.png" null: 2>&1 | sed 's/.*(\(.*\))/\1/')
    holds "its last frame looks as the picture does: off by $off" awk -v off="$off" 'BEGIN { exit !(off < 0.02) }'
fi
