#!/bin/sh
# Runs the fuzz targets of FOLDER/fuzzer, as many at once as there are processors, each for SECONDS_EACH or over RUNS inputs. What they
# find, the inputs that end them, is left in FOLDER/found; the inputs that reach something new in FOLDER/corpus, from where the next run
# goes on. Memory and time are limited far above what the largest input (8 KB) may need, so a reader that believes a file's counts fails.
# From an empty corpus a seed makes the same inputs in the same order on any machine: how fast that is decides only how far it comes.
# Usage: SECONDS_EACH=20 RUNS= SEED=1 run.sh <folder> [<reader>]
set -u
folder=$1
seeds=$(dirname "$0")/seeds
export ASAN_OPTIONS="quarantine_size_mb=16:allocator_may_return_null=1:${ASAN_OPTIONS:-}"
if [ $# -eq 1 ]; then # all of them; with a reader's name that one
    mkdir -p "$folder/found" "$folder/log"
    export SECONDS_EACH RUNS SEED
    readers=$("$folder/fuzzer") && [ -n "$readers" ] || exit 1
    echo "$readers" | xargs -P "$(nproc)" -n 1 "$0" "$folder" || exit 1
    exit
fi
export FUZZ_READER="$2"

same_addresses= # which are compared, too; the order of names is not the folder's
setarch -R true 2>/dev/null && same_addresses="setarch -R"
log=$folder/log/$FUZZ_READER.log
mkdir -p "$folder/corpus/$FUZZ_READER"
case $FUZZ_READER in
scene) from="assets/scenes tests/bad" ;;
export) from="$seeds/gltf $seeds/export" ;;
*) from=$seeds/$FUZZ_READER ;;
esac
if [ -n "${RUNS:-}" ]; then length=-runs=$RUNS; else length=-max_total_time=$SECONDS_EACH; fi
$same_addresses "$folder/fuzzer" "$length" -seed="$SEED" -max_len=8192 -rss_limit_mb=512 -malloc_limit_mb=200 -timeout=10 \
    -print_final_stats=1 -reload=0 -artifact_prefix="$folder/found/$FUZZ_READER-" \
    -seed_inputs="$(find $from -type f | LC_ALL=C sort | paste -sd,)" "$folder/corpus/$FUZZ_READER" >"$log" 2>&1
status=$?
stat() { sed -n "s/^stat::$1: *//p" "$log"; }
if [ $status -eq 0 ]; then
    echo "ok $FUZZ_READER: $(stat number_of_executed_units) inputs, $(stat average_exec_per_sec) a second"
else
    echo "FAIL $FUZZ_READER: FUZZ_READER=$FUZZ_READER $folder/fuzzer $(sed -n 's/.*Test unit written to //p' "$log" | tail -n 1)"
    grep -E 'ERROR|runtime error|not true|SUMMARY' "$log" | head -n 5
fi
exit $status
