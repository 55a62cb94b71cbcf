# What the scripts share that need packages of PyPI: a virtual environment in the build folder. Sourced after check.sh, not run.
place=$(mkdir -p "$B/python" && realpath "$B/python")
pip_install() { # <package>...: one script at a time, or pip breaks what another one is writing
    # shellcheck disable=SC2016 # expanded inside
    timeout 600 flock "$place" bash -c '[ -x "$0/bin/pip" ] || python3 -m venv "$0" || exit
        exec "$0/bin/pip" install --quiet --retries 0 "$@"' "$place" "$@" >"$scratch/fetch" 2>&1
}
