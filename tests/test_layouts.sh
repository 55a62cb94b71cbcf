# The live app under keyboards of other countries: the same board, with other letters and signs on its keys. Each is struck
# where that layout has it.
. tests/check.sh
. tests/desktop.sh
start_server

# Keys by name, or by the number that X gives to their place.
strike() { xdotool key --delay 10 "$@"; }

# Saves until the file has a text so many times: the app gets to keys and files when it gets to them.
saves() { # <what> <pattern> <times>
    local tries bad=1
    for tries in $(seq 0 199); do
        [ $((tries % 20)) -eq 0 ] && strike "ctrl+$S"
        [ "$(grep -c "$2" "$scratch/mine.json")" -eq "$3" ] && bad=0 && break
        sleep 0.03
    done
    ok "$layout: $1" $bad
}

cat >"$scratch/mine.json" <<'END'
{"wiggly": 1, "frames": [0, 48], "splines": [{"name": "sway", "frequency": 1, "knots": [
{"frame": 6, "value": 0}, {"frame": 24, "value": 1}, {"frame": 48, "value": 0}]}]}
END
start_app mine.json "$scratch/mine.json"

# `make test` takes the last three. Where the layout has: A, S, Y, Z, "-", "1", ".", "5", and what selects one more knot.
while read -r layout A S Y Z minus one point five more; do
    setxkbmap -layout "$layout" -model pc105
    strike "ctrl+$A" "$S" "$Y" "$minus" "$one" "$point" "$five" Return
    saves "S, Y and -1.5 scale the values by that" '"value": \(1.25\|-0.25\)' 3
    strike "ctrl+$Z"
    saves "Ctrl+Z takes it back" '"value": [01]' 3
    strike Escape shift+Left "$point" "$more" Delete
    saves "a knot, then one more, and both are deleted" '"frame":' 1
    strike "ctrl+$Z"
    saves "and brought back" '"frame":' 3
done < <(tail -n "$(thorough && echo 7 || echo 3)" <<'END'
us 38 39 29 52 20 10       60       14       shift+60
de 38 39 52 29 61 10       60       14       shift+94
no 38 39 29 52 61 10       60       14       shift+94
se 38 39 29 52 61 10       60       14       shift+94
fr 24 39 29 25 15 shift+10 shift+59 shift+14 shift+94
ru 38 39 29 52 20 10       61       14       shift+Next
gr 38 39 29 52 20 10       60       14       shift+60
END
)

# In Greek the key of Q has a semicolon on it.
strike ctrl+24
for _ in $(seq 1200); do kill -0 $app 2>/dev/null || break; sleep 0.05; done
if kill -0 $app 2>/dev/null; then
    ok "gr: Ctrl+Q quits" 1
else
    holds "gr: Ctrl+Q quits" wait $app
    app=""
fi
