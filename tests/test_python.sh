# The Python package: its tests and the examples of its pages. Where Python lacks NumPy, it is fetched into the build folder.
. tests/check.sh
[ -z "${SANITIZE:-}" ] || { echo "skip - Python loads no sanitized library"; exit 0; }
command -v python3 >/dev/null || { echo "skip - python3 is not installed"; exit 0; }
place=$B/python
python=python3
if ! python3 -c 'import numpy' 2>/dev/null; then
    python=$place/bin/python
    "$python" -c 'import numpy' 2>/dev/null || {
        python3 -m venv "$place" && timeout 120 "$place/bin/pip" install --quiet --retries 0 numpy
    } >"$scratch/fetch" 2>&1 || { echo "skip - NumPy could not be fetched: $(tail -n 1 "$scratch/fetch")"; exit 0; }
fi

export PYTHONPATH=python/src PYTHONDONTWRITEBYTECODE=1 WIGGLY
WIGGLY_LIBRARY=$(ls "$B"/libwiggly.so.*)
export WIGGLY_LIBRARY
expect 0 "the package does what its pages say" "$python" -W error::DeprecationWarning -m unittest discover -s python/tests
