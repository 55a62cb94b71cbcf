#!/bin/sh
# Runs fuzz targets, as many at once as there are processors, each for SECONDS_EACH or over RUNS inputs. What they find, the inputs that
# end them, is left in FOLDER/found; the inputs that reach something new in FOLDER/corpus, from where the next run goes on.
# Memory and time are limited far above what the largest input (8 KB) may need, so a reader that believes a file's counts fails.
# From an empty corpus a seed makes the same inputs in the same order on any machine: how fast that is decides only how far it comes.
# Usage: SECONDS_EACH=20 RUNS= SEED=1 run.sh <folder> <target>...
set -u
folder=$1
shift
seeds=$(dirname "$0")/seeds
same_addresses=
setarch -R true 2>/dev/null && same_addresses="setarch -R"
export ASAN_OPTIONS="quarantine_size_mb=16:allocator_may_return_null=1:${ASAN_OPTIONS:-}"
mkdir -p "$folder/found" "$folder/log"

one() { # <target>
    reader=${1#fuzz_}
    corpus=$folder/corpus/$reader
    log=$folder/log/$reader.log
    mkdir -p "$corpus"
    from=$seeds/$reader
    [ "$reader" = scene ] && from="assets/scenes tests/bad"
    [ "$reader" = export ] && from="$seeds/gltf $seeds/export"
    if [ -n "${RUNS:-}" ]; then length=-runs=$RUNS; else length=-max_total_time=$SECONDS_EACH; fi
    # The order of names is not the folder's; and addresses, which are compared too, stay the same.
    $same_addresses "$folder/$1" "$length" -seed="$SEED" -max_len=8192 -rss_limit_mb=512 -malloc_limit_mb=200 -timeout=10 \
        -print_final_stats=1 -reload=0 -artifact_prefix="$folder/found/$reader-" \
        -seed_inputs="$(find $from -type f | LC_ALL=C sort | paste -sd,)" "$corpus" >"$log" 2>&1
    status=$?
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
    if [ $status -eq 0 ]; then
        echo "ok $reader: $runs inputs, $(sed -n 's/^stat::average_exec_per_sec: *//p' "$log") a second"
    else
        echo "FAIL $reader: $folder/$1 $(sed -n 's/.*Test unit written to //p' "$log" | tail -n 1)"
        grep -E 'ERROR|runtime error|not true|SUMMARY' "$log" | head -n 5
    fi
    return $status
}

[ "${ONE:-}" ] && { one "$1"; exit; }
ONE=yes
export ONE SECONDS_EACH RUNS SEED
printf '%s\n' "$@" | xargs -P "$(nproc)" -n 1 "$0" "$folder" || exit 1
