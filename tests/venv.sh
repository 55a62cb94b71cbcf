# What the scripts share that need packages of PyPI: a virtual environment in the build folder. Sourced after check.sh, not run.
place=$(mkdir -p "$B/python" && realpath "$B/python")
fetch() { # <group of python/fetched.txt>...
    timeout 600 python/fetch.sh "$place" "$@" >"$scratch/fetch" 2>&1
}
