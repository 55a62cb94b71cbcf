# What the test scripts share: cases that are counted by tools/run-tests.sh. Sourced, not run.
cases_failed=0
B=${B:-build}
WIGGLY=${WIGGLY:-$B/wiggly}

ok() { # <what> <status of what was tried, 0 is good>
    if [ "$2" -eq 0 ]; then
        echo "ok - $1"
    else
        echo "not ok - $1"
        cases_failed=$((cases_failed + 1))
    fi
}

# A command that must succeed, such as [ or cmp; $out and $err stay.
holds() { # <what> <command>...
    local what=$1 status=0
    shift
    "$@" || status=$?
    ok "$what" $status
}

not() { ! "$@"; } # <command>...

# The events of a replay that open an example.
example() { # <frame> <words of its name>
    echo "$1 key F3"
    for words in examples "$2"; do
        for ((i = 0; i < ${#words}; i++)); do printf '%d text U+%04X\n' "$1" "'${words:i:1}"; done
        echo "$1 key Enter"
    done
}

# Whether groups of tools/npm/fetched.txt are in a folder; else says why not. A package that is another one than the list names is a failed case.
npm_has() { # <folder> <group>...
    local status=0
    timeout 180 tools/npm/fetch.sh "$@" 2>"$scratch/fetch" || status=$?
    [ $status -ne 3 ] || ok "npm sends what tools/npm/fetched.txt names" 1
    [ $status -eq 0 ] || echo "skip - $(tail -n 1 "$scratch/fetch")"
    return $status
}

# Runs a command and expects an exit status; its output is in $out and $err.
expect() { # <status> <what> <command>...
    local wanted=$1 what=$2 status=0
    shift 2
    "$@" >"$scratch/stdout" 2>"$scratch/stderr" || status=$?
    out=$(<"$scratch/stdout")
    err=$(<"$scratch/stderr")
    [ $status -eq "$wanted" ] || printf '  exit status %d, expected %d, from: %s\n%s\n' $status "$wanted" "$*" "$err"
    ok "$what" $((status != wanted))
}

says() { # <what> <fragment> <text>
    local status=0
    case $3 in *"$2"*) ;; *) status=1; printf '  expected "%s" in: %s\n' "$2" "$3" ;; esac
    ok "$1" $status
}

# A command that ends so and says that, on either output.
tells() { # <status> <what> <fragment> <command>...
    expect "$1" "$2" "${@:4}"
    says "$2: it says so" "$3" "$out$err"
}

# From here on the current folder is $scratch: all but $root/assets and the like is named without it.
go_to_scratch() {
    root=$PWD B=$(realpath "$B") WIGGLY=$(realpath "$WIGGLY")
    cd "$scratch" || exit 1
}
wiggly() { "$WIGGLY" "$@"; }
draws() {
    [ -n "${drawn:=$(wiggly live --headless --size 320x320 --frames 1 2>/dev/null)}" ] || { echo "skip - nothing is drawn here"; return 1; }
}

# Waits for a command to succeed, a minute at most.
await() { # <command>...
    local tries
    for tries in $(seq 1200); do "$@" && return; sleep 0.05; done
    return 1
}

write_box() { # <file.obj>: 1 × 2 × 1 m
    printf 'v %s\n' '0 0 0' '1 0 0' '1 0 1' '0 0 1' '0 2 0' '1 2 0' '1 2 1' '0 2 1' >"$1"
    printf 'f %s\n' '1 2 3 4' '8 7 6 5' '1 5 6 2' '2 6 7 3' '3 7 8 4' '4 8 5 1' >>"$1"
}

# Whether the program itself said nothing; libraries have words of their own (XDG_RUNTIME_DIR, an X server's cookie).
silent() { # <text>
    ! printf '%s\n' "$1" | grep -E '^wiggly|ERROR: |runtime error'
}

# Whether this is `make test-all`, where a test may take all the time that it needs. Otherwise it does less of the same.
thorough() { [ -n "${THOROUGH:-}" ]; }
quickly() { thorough || echo "$@"; } # <options that make it short>...

# A script may have more to do at its end, and then fails where one of its cases did.
at_end() { :; }
scratch=$(mktemp -d)
trap 'status=$?; at_end; rm -rf "$scratch"; exit $((status || cases_failed))' EXIT

# The tests leave the user's own files alone.
export XDG_CONFIG_HOME=$scratch/config XDG_STATE_HOME=$scratch/state
