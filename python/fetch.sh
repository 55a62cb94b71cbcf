#!/bin/sh
# Installs groups of fetched.txt into a virtual environment: fetch.sh FOLDER GROUP...
# A folder whose Python is elsewhere, as in a copied clone, or gone, is made anew. `pip` in it may be another clone's: call `python -m pip`.
set -eu
list=$(dirname "$0")/fetched.txt
mkdir -p "$1"
folder=$(realpath "$1") python=$(realpath "$1")/bin/python
shift
exec 9<"$folder"
flock 9 # one at a time, or pip breaks what another one is writing
grep -qF "$folder/bin/python" "$folder/bin/pip" 2>/dev/null && "$python" -c 'import pip' 2>/dev/null || python3 -m venv --clear "$folder"
awk -v groups=" $* " '/^[^#]/ { for (i = NF; $i != "#"; i--) if (index(groups, " " $i " ")) { print; break } }' "$list" |
    "$python" -m pip install --quiet --retries 0 --no-deps --only-binary :all: --require-hashes -r /dev/stdin
