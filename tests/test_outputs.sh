# What commands write: never two things to one file, nothing left behind, and no control character of a name on the terminal.
. tests/check.sh
scene=assets/scenes/tail.json

# A process number that the system never gives, and one that lives.
touch "$scratch/.wiggly-999999999-0.tmp" "$scratch/.wiggly-$$-3.tmp" "$scratch/.wiggly-999999999-0.tmp.mine"
expect 0 "a table is written" "$WIGGLY" solve $scene --output "$scratch/out.csv"
holds "what a killed program was writing is removed" [ ! -e "$scratch/.wiggly-999999999-0.tmp" ]
[ -e "$scratch/.wiggly-$$-3.tmp" ] && [ -e "$scratch/.wiggly-999999999-0.tmp.mine" ]
ok "what a living one writes stays, and files of others" $?

# Pictures are moved out of their folder when all are there: whoever is killed before leaves it.
mkdir "$scratch/pictures" "$scratch/pictures/.wiggly-$$-0.tmp"
touch "$scratch/pictures/.wiggly-$$-0.tmp/1.png"
"$WIGGLY" export $scene --fps 2400 --size 640x360 -o "$scratch/pictures/a.png" >/dev/null 2>&1 &
exporting=$!
for _ in $(seq 600); do
    left=$(find "$scratch/pictures" -path "*.wiggly-*/*.png" ! -path "*-$$-0.tmp/*" 2>/dev/null | head -n 1)
    [ -z "$left" ] || break
    sleep 0.05
done
kill -9 "$exporting"
wait "$exporting" 2>/dev/null
[ -n "$left" ] && [ -e "$left" ]
ok "a killed export leaves pictures in a folder of its own" $?
touch "$scratch/pictures/a-0002.png"
chmod 600 "$scratch/pictures/a-0002.png"
expect 0 "the next one is made" "$WIGGLY" export $scene --frames 0:1 --size 64x36 -o "$scratch/pictures/a.png"
[ "$(find "$scratch/pictures" -type f -printf '%P\n' | sort | tr '\n' ' ')" = ".wiggly-$$-0.tmp/1.png a-0001.png a-0002.png " ]
ok "and takes that folder away, but none of a living program" $?
[ "$(stat -c '%a' "$scratch/pictures/a-0002.png")" = 600 ]
ok "and a picture that is replaced stays as private as it was" $?

# A pipe with a reader, or a device, is written where the command line names it. test_commands.c has pipes that nobody reads.
mkfifo "$scratch/pipe-0002.png"
expect 3 "no export goes to a pipe among its pictures" timeout 60 "$WIGGLY" export $scene --frames 0:1 --size 64x36 -o "$scratch/pipe-%04d.png"
says "says so" "expected a file, got something else (a device or a pipe)" "$err"
holds "which is there still" [ -p "$scratch/pipe-0002.png" ]
"$WIGGLY" solve $scene >"$scratch/plain.csv"
"$WIGGLY" solve $scene -o /dev/stdout | cmp - "$scratch/plain.csv" && "$WIGGLY" solve $scene -o >(cat >"$scratch/piped.csv")
wait $!
holds "a pipe with a reader gets the table" cmp "$scratch/piped.csv" "$scratch/plain.csv"

escape=$(printf '\033')
name="$scratch/${escape}[31mred"$'\n'"two.json"
raw() { case ${1-$err} in *"$escape"*) true ;; *) false ;; esac }
expect 1 "a name with control characters" "$WIGGLY" check "$name"
says "is shown escaped" '\x1b[31mred\ntwo.json' "$out$err"
name="$scratch/${escape}[31mred"
cp assets/scenes/tail.json "$name.json"
cp assets/models/dog.glb "$name.glb"
expect 0 "writing to such a name" "$WIGGLY" export "$name.json" --frames 0:2 -o "$name.bvh"
says "is told escaped" '\x1b[31mred.bvh' "$out$err"
holds "and nothing of it raw" not raw "$out$err"
expect 0 "rigging one" "$WIGGLY" rig "$name.glb" --chain tail_1:tail_8 -o "$name.rigged.json"
holds "is told escaped" not raw "$out$err"
expect 0 "what such a file holds" "$WIGGLY" check "$name.glb"
holds "is told escaped" not raw "$out$err"

# Names within files: a terminal gets them escaped, a file or a pipe as they are.
on_terminal() { # <command>...
    out=$(script -qec "$(printf '%q ' "$@")" /dev/null </dev/null 2>&1)
}
printf '{"wiggly": 1, "frames": [0, 2], "splines": [{"name": "\\u001b[31mred\\nsecond", "knots": []}]}' >"$scratch/named.json"
on_terminal "$WIGGLY" solve "$scratch/named.json"
says "a terminal gets a table with names escaped" 'frame,\x1b[31mred\nsecond,\x1b[31mred\nsecond.re,' "$out"
holds "and nothing of them raw" not raw "$out"
on_terminal "$WIGGLY" solve "$scratch/named.json" -o /dev/tty
says "so does the terminal as a file" 'frame,\x1b[31mred\nsecond,\x1b[31mred\nsecond.re,' "$out"
holds "and nothing of them raw" not raw "$out"
whole="frame,\"${escape}[31mred"$'\n'"second\",\"${escape}[31mred"$'\n'"second.re\","
says "a pipe gets them as they are" "$whole" "$("$WIGGLY" solve "$scratch/named.json")"
expect 0 "and a file" "$WIGGLY" solve "$scratch/named.json" -o "$scratch/named.csv"
says "too" "$whole" "$(cat "$scratch/named.csv")"
expect 0 "a timing log of such a name" "$WIGGLY" live --no-draw --frames 200 --log "$name.log" $scene
sed -i "s/^# solver: .*/# solver: ${escape}[31m/" "$name.log"
expect 0 "is summarised" "$WIGGLY" log "$name.log"
holds "and it is told escaped" not raw "$out$err"
