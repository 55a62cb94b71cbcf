# The Blender extension, in every Blender there is as a Python module (bpy): those of $BPY, Pythons that have it, or of `make proof`.
# It is fetched, 350 MB, only by `make test-all`.
. tests/check.sh
[ -z "${SANITIZE:-}" ] || { echo "skip - Blender loads no sanitized library"; exit 0; }
place=$B/proof/venv
has_bpy() { "$1" -c "import importlib.util as u, sys; sys.exit(u.find_spec('bpy') is None)" 2>/dev/null; }
pythons=${BPY:-$place/bin/python}
if [ -z "${BPY:-}" ] && ! has_bpy "$place/bin/python"; then
    thorough || { echo "skip - there is no bpy: name a Python that has it in BPY, or run make proof"; exit 0; }
    { [ -x "$place/bin/python" ] || python3 -m venv "$place"; } >"$scratch/fetch" 2>&1 &&
        timeout 900 "$place/bin/pip" install --quiet --retries 0 numpy bpy==4.5.15 >"$scratch/fetch" 2>&1 ||
        { echo "skip - bpy could not be fetched: $(tail -n 1 "$scratch/fetch")"; exit 0; }
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
    expect 0 "the table of docs/blender.md" python3 blender/tests/table.py --check docs/blender.md "$python"
done
