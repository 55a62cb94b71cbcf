# A box of 1 × 2 × 1 m as the scripts on simulation and characters use it. Sourced after check.sh, not run.
write_box() { # <file.obj>
    cat >"$1" <<'END'
v 0 0 0
v 1 0 0
v 1 0 1
v 0 0 1
v 0 2 0
v 1 2 0
v 1 2 1
v 0 2 1
f 1 2 3 4
f 8 7 6 5
f 1 5 6 2
f 2 6 7 3
f 3 7 8 4
f 4 8 5 1
END
}
