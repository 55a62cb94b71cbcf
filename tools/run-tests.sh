#!/bin/bash
# Runs test programs (cmocka) and test scripts one after the other, from the root of the tree. Prints a line for each and, for
# one that failed, the end of what it said; then "N passed, N failed" over all cases. Exit status 1 where any failed.
# Scripts report their cases as lines "ok - what" and "not ok - what".
# Environment: TEST_OUT, a folder for logs and for what tests write; TEST_TIMEOUT in seconds.
set -u
TEST_OUT=${TEST_OUT:-build/test-out}
mkdir -p "$TEST_OUT"
passed=0
failed=0

for test in "$@"; do
    name=$(basename "$test")
    log=$TEST_OUT/$name.log
    started=$(date +%s%N)
    case $test in
    *.sh) timeout "${TEST_TIMEOUT:-300}" bash "$test" >"$log" 2>&1 ;;
    *) timeout "${TEST_TIMEOUT:-300}" "$test" >"$log" 2>&1 ;;
    esac
    status=$?
    took=$((($(date +%s%N) - started) / 1000000))
    good=$(grep -cE '^(\[       OK \]|ok - )' "$log")
    bad=$(grep -E '^(\[  FAILED  \] [a-z_0-9A-Z]+$|not ok - )' "$log" | sort -u | wc -l) # cmocka names a failed case twice
    # A crash, a time-out or a test without cases is a failure that no case reports.
    if [ $status -ne 0 ] && [ "$bad" -eq 0 ] || [ $((good + bad)) -eq 0 ]; then bad=$((bad + 1)); fi
    passed=$((passed + good))
    failed=$((failed + bad))
    if [ "$bad" -eq 0 ]; then
        printf 'ok    %-28s %4d cases %6d ms\n' "$name" "$good" "$took"
    else
        printf 'FAIL  %-28s %4d of %d cases, exit status %d; the end of %s:\n' "$name" "$bad" $((good + bad)) $status "$log"
        grep -vE '^\[( RUN      |       OK |  PASSED  |==========)\]|^ok - ' "$log" | tail -n 30 | sed 's/^/      /'
    fi
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
