# wiggly solve and wiggly check: what they write, and what they say of scenes that are odd but not wrong.
. tests/check.sh

# Names with commas, quotes and line ends, frames before zero and between frames, few digits and many.
cat >"$scratch/names.json" <<'END'
{"frames": [-1, 0], "substeps": 3, "splines": [
  {"name": "a,b", "mode": "cubic", "knots": [{"frame": 0, "value": 0.1}]},
  {"name": "say \"hi\"", "mode": "cubic"},
  {"name": "two\nlines", "mode": "cubic"}]}
END
expect 0 "solve of odd names" "$WIGGLY" solve "$scratch/names.json"
expected='frame,"a,b","a,b.re","a,b.im","say ""hi""","say ""hi"".re","say ""hi"".im","two
lines","two
lines.re","two
lines.im"
-1,0.10000000000000001,0.10000000000000001,0,0,0,0,0,0,0
-0.6666666666666667,'
says "quotes as RFC 4180 wants, 17 digits, frames as short as they can be" "$expected" "$out"

printf '{"frames": [0, 1]}' >"$scratch/none.json"
expect 0 "solve of no splines" "$WIGGLY" solve "$scratch/none.json"
says "writes the frames" "frame
0
1" "$out"

# Undamped, no calm, knots at half periods: only last digits hold it.
{
    printf '{"fps": 15, "frames": [0, 610], "splines": [{"name": "chain", "frequency": 0.75, "bandwidth": 0, "calm": 1e-6, "knots": ['
    for k in {0..60}; do printf '%s{"frame": %d, "value": 0.%d}' "${comma-}" $((10 * k)) $((k * k * 7 % 10)) && comma=,; done
    printf ']}]}'
} >"$scratch/chain.json"
expect 0 "solve of an undamped chain without calm" "$WIGGLY" solve "$scratch/chain.json"
grep -qE '"chain": solved, but the estimated error exceeds the tolerance: [0-9.]+e-[0-9]+ of the curve'"'"'s size$' <<<"$err"
ok "says that it is inexact, and by how much" $?

for scene in assets/scenes/*.json; do
    expect 0 "check of $scene" "$WIGGLY" check "$scene"
    holds "has nothing to say about $scene" [ -z "$out$err" ]
done
