# examples/farm.py: a farm's shots have the bits of one machine, also where a worker is killed and where the farm is stopped and goes on.
. tests/check.sh
command -v python3 >/dev/null || { echo "skip - python3 is not installed"; exit 0; }
WIGGLY=$(realpath "$WIGGLY")
export WIGGLY
shots=$scratch/shots.txt
for i in 1 2 3 4 5 6 7 8; do echo "shot$i assets/models/creature.glb --tets 300 --seconds 1 --substeps 1 --damping 0.0$i"; done >"$shots"
echo "bad assets/models/creature.glb --damping 9" >>"$shots"

expect 0 "one shot is made" python3 examples/farm.py "$shots" "$scratch/one" --only 1
touch -d 2001-01-01 "$scratch/one/shot1.glb"
expect 0 "it is not made again" python3 examples/farm.py "$shots" "$scratch/one" --only 1
holds "so that its file stays" [ ! "$scratch/one/shot1.glb" -nt Makefile ]
expect 1 "a shot that fails says why" python3 examples/farm.py "$shots" "$scratch/one" --only 9
says "with its name" "bad: wiggly simulate: " "$err"
holds "and leaves nothing" [ "$(ls -A "$scratch/one")" = shot1.glb ]

refuses() { # <what> <--only> <fragment> <list>
    printf "$4" >"$scratch/wrong.txt"
    expect 1 "$1 is refused" python3 examples/farm.py "$scratch/wrong.txt" "$scratch/one" --only "$2"
    says "in a sentence" "$3" "$err"
    holds "and only that" not grep -q Traceback "$scratch/stderr"
}
refuses "a name that is there twice" 1 "wrong.txt: expected a name and a mesh in every line, and no name twice" 'a x.obj\n\na y.obj\n'
refuses "a shot without a mesh" 1 "wrong.txt: expected a name and a mesh" 'a\n'
refuses "a shot that the list lacks" 0 "expected 1 to 1, got 0" 'a x.obj\n'
refuses "a mesh that is not there" 1 "a: x.obj: cannot be opened" 'a x.obj\n'
thorough || exit 0

# --- two workers, of which one is killed

. tests/venv.sh
fetch farm ||
    { echo "skip - dask.distributed could not be fetched: $(tail -n 1 "$scratch/fetch")"; exit 0; }
for i in 2 3 4 5 6 7 8; do python3 examples/farm.py "$shots" "$scratch/one" --only $i >/dev/null; done
groups=()
at_end() { kill -9 "${groups[@]/#/-}" 2>/dev/null; wait; }
start() { setsid "$place/bin/python" -m dask "$@" >>"$scratch/dask" 2>&1 & groups+=($!); }
start scheduler --port 0 --no-dashboard --scheduler-file "$scratch/scheduler.json"
address() { sed -n 's/.*"address": "\([^"]*\)".*/\1/p' "$scratch/scheduler.json" 2>/dev/null; }
for _ in $(seq 600); do [ -n "$(address)" ] && break; sleep 0.1; done
for _ in 1 2; do start worker "$(address)" --nthreads 1 --no-nanny --no-dashboard --local-directory "$scratch"; done
timeout 600 "$place/bin/python" examples/farm.py "$shots" "$scratch/many" --scheduler "$(address)" >"$scratch/said" 2>&1 &
farm=$!
for _ in $(seq 600); do [ -n "$(ls "$scratch/many" 2>/dev/null)" ] && break; sleep 0.1; done
kill -9 "-${groups[1]}" # with the command that it runs
status=0
wait $farm || status=$?
ok "the farm ends although a worker was killed" "$([ $status = 1 ]; echo $?)"
holds "and names the shot that failed" grep -q "^bad: wiggly simulate" "$scratch/said"
rm -rf "$scratch"/many/.*-* # what the killed worker left
holds "all shots have the bits of one machine" diff -r "$scratch/one" "$scratch/many"
