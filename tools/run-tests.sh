#!/bin/bash
# Runs tests in the root of the tree, one more at once than there are processors: tests/ROOM/test_FILE.c by the program of its room (cmocka),
# with :CASE that case alone, and scripts. Prints a line for each in the given order, the end of the output of each failed test, the skipped tests, and "N passed, N failed" over all cases. Exit status 1 if any
# failed. Scripts report cases as lines "ok - what" and "not ok - what"; skipped tests say "skip - why", in cmocka's programs too.
# Environment: JOBS, number of parallel tests; TEST_OUT, a folder for logs and a folder per test to write in; TEST_TIMEOUT, seconds before a
# test counts as hanging (a loaded machine makes tests ten times as slow).
set -u
TEST_OUT=${TEST_OUT:-build/test-out}
JOBS=${JOBS:-$(($(nproc 2>/dev/null || echo 2) + 1))} # some of them wait for a window
times=$TEST_OUT/times # "milliseconds name" of every test's last run
passed=0
failed=0
skips=()
mkdir -p "$TEST_OUT"
touch "$times"

# gcc 12's LeakSanitizer mistakes the bytes before a library's thread-local storage for glibc 2.19's header if they end 16 bytes after a
# page's start, and crashes.
export ASAN_OPTIONS=${ASAN_OPTIONS:-intercept_tls_get_addr=0}
trap 'kill $(jobs -p) 2>/dev/null; wait; exit 130' INT TERM

B=${B:-build}

name_of() { # <test>
    local name=${1##*/}
    name=${name%:*}
    echo "${name%.c}"
}

# Runs one test and writes its exit status and time to its .result file.
run() { # <test>
    local name log started status room
    name=$(name_of "$1")
    log=$TEST_OUT/$name.log
    rm -rf "$TEST_OUT/$name"
    mkdir "$TEST_OUT/$name"
    started=$(date +%s%N)
    case $1 in
    *.sh) set -- bash "$1" ;;
    *.c:*) room=${1%/*} && set -- "$B/$room" "$name" "${1##*:}" ;;
    *) room=${1%/*} && set -- "$B/$room" "$name" ;;
    esac
    TEST_OUT=$TEST_OUT/$name timeout -k 10 "${TEST_TIMEOUT:-900}" "$@" >"$log" 2>&1 &
    trap "kill $! 2>/dev/null" TERM
    wait $!
    status=$?
    echo "$status $((($(date +%s%N) - started) / 1000000))" >"$TEST_OUT/$name.new"
    mv "$TEST_OUT/$name.new" "$TEST_OUT/$name.result"
}

report() { # <test>
    local name log status took good bad
    name=$(name_of "$1")
    log=$TEST_OUT/$name.log
    read -r status took <"$TEST_OUT/$name.result"
    good=$(grep -cE '^(\[       OK \]|ok - )' "$log")
    bad=$(grep -E '^(\[  FAILED  \] [a-z_0-9A-Z]+$|not ok - )' "$log" | sort -u | wc -l) # cmocka names a failed case twice
    # Count a crash, a time-out or a test without cases as a failure.
    mapfile -t skipped < <(grep -E '^skip - ' "$log" | sort -u)
    if [ "$status" -ne 0 ] && [ "$bad" -eq 0 ] || [ $((good + bad + ${#skipped[@]})) -eq 0 ]; then bad=$((bad + 1)); fi
    skips+=("${skipped[@]/#skip - /skip  $name: }")
    passed=$((passed + good))
    failed=$((failed + bad))
    if [ "$bad" -eq 0 ]; then
        printf 'ok    %-28s %4d cases %6d ms\n' "$name" "$good" "$took"
    else
        printf 'FAIL  %-28s %4d of %d cases, exit status %d; the end of %s:\n' "$name" "$bad" $((good + bad)) "$status" "$log"
        grep -vE '^\[( RUN      |       OK |  PASSED  |==========)\]|^ok - ' "$log" | tail -n 30 | sed 's/^/      /'
    fi
}

# Prints finished tests up to the first unfinished one.
reported=0
report_ended() {
    while [ $reported -lt ${#tests[@]} ] && [ -e "$TEST_OUT/$(name_of "${tests[reported]}").result" ]; do
        report "${tests[reported]}"
        reported=$((reported + 1))
    done
}

# Start the longest tests first, so that none runs alone at the end. A test without a known time may be long, these and scripts first.
long=" test_web.sh test_python.sh test_starve test_blender.sh test_monkey test_npm.sh "
longest_first() { # <test>...
    local test took name
    for test in "$@"; do
        name=$(name_of "$test")
        took=$(awk -v name="$name" '$2 == name { print $1 }' "$times")
        [[ $long != *" $name "* ]] || took=${took:-3000000}
        case $test in *.sh) echo "${took:-2000000} $test" ;; *) echo "${took:-1000000} $test" ;; esac
    done | sort -s -k1,1nr | cut -d' ' -f2-
}

tests=("$@")
mapfile -t order < <(longest_first "$@")
for test in "$@"; do rm -f "$TEST_OUT/$(name_of "$test").result"; done
running=0
for test in "${order[@]}"; do
    if [ $running -eq "$JOBS" ]; then
        wait -n
        running=$((running - 1))
        report_ended
    fi
    run "$test" &
    running=$((running + 1))
done
while [ $running -gt 0 ]; do
    wait -n
    running=$((running - 1))
    report_ended
done
for test in "$@"; do
    name=$(name_of "$test")
    awk -v name="$name" '{ print $2, name }' "$TEST_OUT/$name.result"
done | cat - "$times" | awk '!seen[$2]++' >"$times.new"
mv "$times.new" "$times"
[ ${#skips[@]} -eq 0 ] || printf '%s\n' "${skips[@]}"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
