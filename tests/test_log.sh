# wiggly log: what it says of a log. live --turns: two programs draw in turn.
. tests/check.sh
unset DISPLAY WAYLAND_DISPLAY

write_run() { # <file.csv> <ms of every frame but each tenth>
    {
        printf '# schema: wiggly-frames 2\n# warm_up_frames: 2\nframe,t_s,frame_ms,frame_interval_ms,solve_us,swap_us\n'
        for frame in $(seq 0 61); do
            ms=$2
            [ $((frame % 10)) -ne 5 ] || ms=40
            echo "$frame,$frame.5,$ms,$ms,100,$((ms * 1000 - 100))"
        done
    } >"$1"
}

write_run "$scratch/a.csv" 10
expect 0 "a log of one run" "$WIGGLY" log "$scratch/a.csv"
says "counts its frames without the warm-up" "a.csv: 60 frames of 1 run in 59.01 s, 1.0 fps on average," "$out"
says "frames over budget" "6 of 60 frames (10.0 %), up to 1 in a row" "$out"
says "where the slowest frame spent its time" "40.000 ms: swap_us 39900" "$out"
says "the percentiles of what was measured" "solve_us                100.0      100.0      100.0      100.0" "$out"
case $out in *gpu_us*) false ;; *) true ;; esac
ok "and nothing of what was not" $?

write_run "$scratch/b.csv" 20
cat "$scratch/a.csv" "$scratch/b.csv" >"$scratch/both.csv"
expect 0 "a log of two runs" "$WIGGLY" log "$scratch/both.csv"
says "counts both" "120 frames of 2 runs in " "$out"

cat "$scratch/b.csv" "$scratch/b.csv" >"$scratch/twice.csv"
expect 0 "a log of two slow runs" "$WIGGLY" log "$scratch/twice.csv"
says "frames in a row are of one run" "120 of 120 frames (100.0 %), up to 60 in a row" "$out"

# --- frames in turn

expect 2 "--turns without pipes" sh -c '"$0" live --headless --frames 2 --turns first 3<&- 4>&-' "$WIGGLY"
says "says what is missing" "descriptors 3 and 4" "$err"

"$WIGGLY" live --headless --frames 1 >/dev/null 2>&1 || { echo "skip - nothing is drawn here"; exit 0; }
mkfifo "$scratch/to-a" "$scratch/to-b"
"$WIGGLY" live --headless --size 320x320 --frames 30 --log "$scratch/turns-a.csv" --turns first 3<"$scratch/to-a" 4>"$scratch/to-b" >/dev/null &
timeout 60 "$WIGGLY" live --headless --size 320x320 --frames 40 --log "$scratch/turns-b.csv" --turns second 4>"$scratch/to-a" 3<"$scratch/to-b" >/dev/null
ok "the program that goes on is not held up when the other one has ended" $?
holds "which ended well" wait $!
[ "$(grep -c '^[0-9]' "$scratch/turns-a.csv")" -eq 30 ] && [ "$(grep -c '^[0-9]' "$scratch/turns-b.csv")" -eq 40 ]
ok "both drew all their frames" $?
[ "$(awk -F, '/^[0-9]/ && $4 == "NA"' "$scratch/turns-a.csv" | wc -l)" -eq 30 ]
ok "and the interval between frames of a program that waits for another is not measured" $?
