# The Python package: its tests and the examples of its pages; and examples/farm.py: a farm's shots have the bits of one machine, also where
# a worker is killed. Where Python lacks NumPy, it is fetched into the build folder.
. tests/check.sh
[ -z "${SANITIZE:-}" ] || { echo "skip - Python loads no sanitized library"; exit 0; }
command -v python3 >/dev/null || { echo "skip - python3 is not installed"; exit 0; }
WIGGLY=$(realpath "$WIGGLY")
place=$(mkdir -p "$B/python" && realpath "$B/python")
fetch() { # <group of python/fetched.txt>...
    timeout 600 python/fetch.sh "$place" "$@" >"$scratch/fetch" 2>&1
}

# --- the farm

export WIGGLY
shots=$scratch/shots.txt one=$scratch/one
for i in {1..8}; do echo "shot$i assets/models/creature.glb --tets 300 --seconds 1 --substeps 1 --damping 0.0$i"; done >"$shots"
echo "bad assets/models/creature.glb --damping 9" >>"$shots"
shot() { python3 examples/farm.py "$shots" "$one" --only "$1"; } # <number>
expect 0 "one shot is made" shot 1
touch -d 2001-01-01 "$one/shot1.glb"
expect 0 "it is not made again" shot 1
holds "so that its file stays" [ ! "$one/shot1.glb" -nt Makefile ]
tells 1 "a shot that fails says why, with its name" "bad: wiggly simulate: " shot 9
holds "and leaves nothing" [ "$(ls -A "$one")" = shot1.glb ]
while IFS='|' read -r what only said list; do
    printf "$list" >"$scratch/wrong.txt"
    tells 1 "$what is refused" "$said" python3 examples/farm.py "$scratch/wrong.txt" "$one" --only "$only"
    holds "$what: in a sentence" not grep -q Traceback <<<"$err"
done <<'END'
a name that is there twice|1|wrong.txt: expected a name and a mesh in every line, and no name twice|a x.obj\n\na y.obj\n
a shot without a mesh|1|wrong.txt: expected a name and a mesh|a\n
a shot that the list lacks|0|expected 1 to 1, got 0|a x.obj\n
a mesh that is not there|1|a: x.obj: cannot be opened|a x.obj\n
END
groups=()
start() { setsid "$place/bin/python" -m dask "$@" >>"$scratch/dask" 2>&1 & groups+=($!); }
address() { sed -n 's/.*"address": "\([^"]*\)".*/\1/p' "$scratch/scheduler.json" 2>/dev/null | grep .; }
begun() { ls "$scratch/many" 2>/dev/null | grep -q .; }
if thorough && ! fetch farm; then
    echo "skip - dask.distributed could not be fetched: $(tail -n 1 "$scratch/fetch")"
elif thorough; then # two workers, of which one is killed
    for i in {2..8}; do shot $i >"$scratch/said"; done
    at_end() { kill -9 "${groups[@]/#/-}" 2>/dev/null; wait; }
    start scheduler --port 0 --no-dashboard --scheduler-file "$scratch/scheduler.json"
    await address >"$scratch/said"
    for _ in 1 2; do start worker "$(address)" --nthreads 1 --no-nanny --no-dashboard --local-directory "$scratch"; done
    timeout 600 "$place/bin/python" examples/farm.py "$shots" "$scratch/many" --scheduler "$(address)" >"$scratch/said" 2>&1 &
    farm=$!
    await begun
    kill -9 "-${groups[1]}" # with the command that it runs
    wait $farm
    holds "the farm ends although a worker was killed" [ $? = 1 ]
    holds "and names the shot that failed" grep -q "^bad: wiggly simulate" "$scratch/said"
    rm -rf "$scratch"/many/.*-* # what the killed worker left
    holds "all shots have the bits of one machine" diff -r "$one" "$scratch/many"
fi

# --- the package

python=python3
if ! python3 -c 'import numpy' 2>/dev/null; then
    python=$place/bin/python
    "$python" -c 'import numpy' 2>/dev/null || fetch numpy ||
        { echo "skip - NumPy could not be fetched: $(tail -n 1 "$scratch/fetch")"; exit 0; }
fi

export PYTHONPATH=python/src PYTHONDONTWRITEBYTECODE=1
WIGGLY_LIBRARY=$(ls "$B"/libwiggly.so.*)
export WIGGLY_LIBRARY
expect 0 "the package does what its pages say" "$python" -W error::DeprecationWarning -m unittest discover -s python/tests
thorough || exit 0

# --- what is fetched: by its hash, and into this clone

mkdir -p "$scratch/fetch.d/links" "$scratch/clone/build"
cp python/fetch.sh "$scratch/fetch.d"
python3 - "$scratch/fetch.d/links/thing-1.0-py3-none-any.whl" <<'END'
import sys, zipfile
with zipfile.ZipFile(sys.argv[1], 'w') as wheel:
    wheel.writestr('thing.py', '')
    wheel.writestr('thing-1.0.dist-info/METADATA', 'Metadata-Version: 2.1\nName: thing\nVersion: 1.0\n')
    wheel.writestr('thing-1.0.dist-info/WHEEL', 'Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n')
    wheel.writestr('thing-1.0.dist-info/RECORD', 'thing.py,,\n')
END
hash=$(sha256sum <"$scratch/fetch.d/links/thing-1.0-py3-none-any.whl")
own_fetch() { # <folder> <group>
    env PIP_NO_INDEX=1 PIP_FIND_LINKS="$scratch/fetch.d/links" "$scratch/fetch.d/fetch.sh" "$@"
}
has_thing() { "$1/bin/python" -c 'import thing' 2>/dev/null; }
echo "thing==1.0 --hash=sha256:${hash%% *} # some more" >"$scratch/fetch.d/fetched.txt"
sed 's/:..../:0000/; s/some/wrong/' "$scratch/fetch.d/fetched.txt" >"$scratch/wrong" && cat "$scratch/wrong" >>"$scratch/fetch.d/fetched.txt"
first=$scratch/clone/build/python
tells 1 "a package whose hash is not the one that is listed is refused" "DO NOT MATCH THE HASHES" own_fetch "$first" wrong
holds "and is not there" not has_thing "$first"
cp -a "$scratch/clone" "$scratch/copied clone"
expect 0 "one with its hash is installed in a copied clone" own_fetch "$scratch/copied clone/build/python" some
holds "where it is" has_thing "$scratch/copied clone/build/python"
holds "and not in the one that was copied" not has_thing "$first"
tells 0 "pip there is its own" "$scratch/copied clone" "$scratch/copied clone/build/python/bin/pip" --version
ln -sf /nowhere/python "$first/bin/python3"
expect 0 "where Python is gone, the folder is made anew" own_fetch "$first" more
holds "and has the package" has_thing "$first"

# --- wheels: what is in them, what leaves their library, what they need

# All that make wheel builds only where it has: the first one for Windows takes minutes.
case $(uname -m) in x86_64 | aarch64) own=manylinux_2_17_$(uname -m) ;; *) echo "skip - there is no wheel for this machine"; exit 0 ;; esac
platforms=("$own" macosx_11_0_arm64)
! ls "$B"/wheels/*-win_amd64.whl >/dev/null 2>&1 || platforms=()
rm -rf "$B/wheels"
fetch wheel check ||
    { echo "skip - the wheels, because zig could not be fetched: $(tail -n 1 "$scratch/fetch")"; exit 0; }
expect 0 "the types are right" "$place/bin/python" -m mypy --cache-dir "$scratch/mypy" --config-file python/pyproject.toml python/src/wiggly
sed -n '/^```python$/,/^```$/{/^```/!p;}' docs/python.md >"$scratch/page.py"
expect 0 "and those of a strict user" env MYPYPATH=python/src "$place/bin/python" -m mypy --cache-dir "$scratch/mypy" --strict "$scratch/page.py"
hatch() { (cd python && "$place/bin/python" -m hatchling build -t "$1" -d "$scratch"); } # <kind>
CC=/nowhere/cc tells 1 "without a C compiler nothing is built" "the compiler '/nowhere/cc' was not found" hatch wheel
CFLAGS='-include /nowhere.h' tells 1 "CFLAGS are heard by the compiler" "/nowhere.h" hatch wheel
expect 0 "wheels are built" python/wheels.sh "$B" "${platforms[@]}"
exports() { # <library>: the names that leave it, but for the runtimes'
    case $1 in
    *.so) nm -D --defined-only "$1" | awk '{ print $3 }' ;;
    *.dll) objdump -p "$1" | awk '/Ordinal\/Name/ { on = 1; next } on && NF == 0 { exit } on { print $NF }' ;;
    *.dylib) llvm-nm -g --defined-only "$1" | sed 's/.* _//' ;;
    esac | grep -v '^_\|^atexit$' | sort
}
sed -nE 's/^[a-z].*[ *](wiggly_[a-z_]+)\(.*/\1/p' include/wiggly/*.h | sort >"$scratch/promised"
for wheel in "$B"/wheels/*.whl; do
    platform=${wheel##*-none-}
    holds "$platform has at most 300 KB" [ "$(stat -c %s "$wheel")" -le 300000 ]
    rm -rf "$scratch/wheel" && "$python" -m zipfile -e "$wheel" "$scratch/wheel"
    holds "and types and a licence" [ -e "$scratch/wheel/wiggly/py.typed" -a -e "$scratch/wheel/wiggly/LICENSE" ]
    library=$(ls "$scratch"/wheel/wiggly/{libwiggly.*,wiggly.dll} 2>/dev/null)
    [[ $library != *.dylib ]] || command -v llvm-nm >/dev/null || { echo "skip - the names in a .dylib, because llvm-nm is not installed"; continue; }
    exports "$library" >"$scratch/names"
    holds "and only the headers' names leave its library" diff "$scratch/promised" "$scratch/names"
done
for wheel in "$B"/wheels/*-manylinux*.whl; do
    platform=${wheel##*-none-}
    tells 0 "auditwheel finds $platform to be what it says" "\"${platform%.whl}\"" "$place/bin/python" -m auditwheel show "$wheel"
done

# --- the wheel of this machine, without the tree

unset WIGGLY_LIBRARY PYTHONPATH
python/fetch.sh "$scratch/venv" numpy wheel
pip=("$scratch/venv/bin/python" -m pip install --quiet --force-reinstall --no-deps --no-build-isolation)
expect 0 "it installs" "${pip[@]}" "$B/wheels/"*-"$own".whl
expect 0 "and does the same" "$scratch/venv/bin/python" -m unittest discover -s python/tests
if python/fetch.sh "$scratch/venv" freeze >"$scratch/fetch" 2>&1; then
    echo 'from wiggly import Spline; print(Spline([(0, 0), (1, 0.25)]).solve(49).total[24])' >"$scratch/app.py"
    freeze=("$scratch/venv/bin/pyinstaller" --log-level ERROR --distpath "$scratch" --workpath "$scratch/work" --specpath "$scratch")
    expect 0 "PyInstaller takes it along" "${freeze[@]}" --onefile "$scratch/app.py"
    tells 0 "and the program runs alone, as it should" 0.25 "$scratch/app"
else
    echo "skip - PyInstaller could not be fetched: $(tail -n 1 "$scratch/fetch")"
fi
for free in python3.13t python3.14t; do # without the GIL
    command -v $free >/dev/null || { echo "skip - $free is not installed"; continue; }
    $free -m venv "$scratch/$free" && python/fetch.sh "$scratch/$free" numpy wheel
    expect 0 "it installs in $free" "$scratch/$free/bin/python" -m pip install --quiet --no-deps "$B/wheels/"*-"$own".whl
    expect 0 "and does the same" "$scratch/$free/bin/python" -m unittest discover -s python/tests
    expect 0 "without the GIL" "$scratch/$free/bin/python" -c 'import sys, wiggly; sys.exit(sys._is_gil_enabled())'
done
expect 0 "a source distribution is made" hatch sdist
expect 0 "and installs with a C compiler" "${pip[@]}" "$scratch"/wiggly-*.tar.gz
expect 0 "and does the same, too" "$scratch/venv/bin/python" -m unittest discover -s python/tests
