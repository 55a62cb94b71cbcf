# The Blender extension, in every Blender there is as a Python module (bpy): those of $BPY, Pythons that have it, or of `make proof`.
# They are fetched, 350 MB each, only by `make test-all`: those of $BPY_VERSIONS, or all.
. tests/check.sh
[ -z "${SANITIZE:-}" ] || { echo "skip - Blender loads no sanitized library"; exit 0; }
has_bpy() { "$1" -c "import importlib.util as u, sys; sys.exit(u.find_spec('bpy') is None)" 2>/dev/null; }

fetch() { # <version>
    place=$B/bpy/$1
    timeout 900 python/fetch.sh "$place" "bpy-$1" >"$scratch/fetch" 2>&1 ||
        { echo "skip - bpy $1 could not be fetched: $(tail -n 1 "$scratch/fetch")"; return; }
    pythons="$pythons $place/bin/python"
}

pythons=${BPY:-}
if [ -z "$pythons" ] && thorough; then
    for version in ${BPY_VERSIONS:-4.2.23 4.5.15 5.0.1}; do fetch "$version"; done
elif [ -z "$pythons" ]; then
    pythons=$B/proof/venv/bin/python
    has_bpy "$pythons" || { echo "skip - there is no bpy: name a Python that has it in BPY, or run make proof"; exit 0; }
fi
export PYTHONPATH=python/src PYTHONDONTWRITEBYTECODE=1 TMPDIR=$scratch
WIGGLY_LIBRARY=$PWD/$(ls "$B"/libwiggly.so.* | head -n 1)
[ "${B#/}" = "$B" ] || WIGGLY_LIBRARY=$(ls "$B"/libwiggly.so.* | head -n 1)
export WIGGLY_LIBRARY
wheels=("$B"/wheels/*manylinux*_x86_64.whl) # of make wheel
if [ -e "${wheels[0]}" ]; then
    version=$(sed -n 's/.*define WIGGLY_VERSION "\(.*\)"/\1/p' include/wiggly/wiggly.h)
    mkdir "$scratch/wheels"
    cp "${wheels[0]}" "$scratch/wheels"
    name=${wheels[0]##*-none-}
    expect 0 "the extension is packed" tools/pack-blender.sh "$scratch" "$version" "${name%.whl}"
    export ZIP=$scratch/wiggly-blender-$version.zip
fi
for python in $pythons; do
    for test in blender/tests/test_*.py; do
        expect 0 "$test" "$python" "$test"
        grep -E '^(not )?ok - |^skip - ' <<<"$out" | sed "s/^\(not ok\|ok\|skip\) - /&$(basename "$test" .py): /"
        tail -n 1 <<<"$out"
    done
    expect 0 "the table of tests/README.md" python3 blender/tests/table.py --check tests/README.md "$python"
done
