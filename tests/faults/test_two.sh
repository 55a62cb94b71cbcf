# Two running programs: on one scene's file, with one settings file and one folder of recovery files.
. tests/check.sh
. tests/desktop.sh
window=1280x720 # room for larger text
first=""
second=""
at_end() { kill $app $first $second $server 2>/dev/null; wait 2>/dev/null; }
settings=$XDG_CONFIG_HOME/wiggly/settings
recovery=$XDG_STATE_HOME/wiggly/recovery
mine=$scratch/mine.json

knots() { grep -o '"frame":' "$1" | wc -l; }
window_of() { xdotool search --onlyvisible --pid "$1" | tail -n 1; }

# Gives a program's window the keyboard, and then types.
to() { # <pid> <keys>...
    local window=$(window_of "$1")
    xdotool windowraise "$window" windowfocus --sync "$window"
    xdotool key --delay 30 "${@:2}"
}
titled() { xdotool getwindowname "$(window_of "$1")" 2>/dev/null | grep -q "$2"; }

start_both() {
    start_app "^mine.json" "$mine"
    first=$app
    "$WIGGLY" live --size $window --stage-scale 0.25 --still "$mine" >"$scratch/second.out" 2>"$scratch/second.err" &
    second=$!
    both_open() { titled $second '^mine.json'; }
    eventually "and another" both_open
}

end_both() {
    kill -9 $first $second
    wait $first $second 2>/dev/null
    first=""
    second=""
    app=""
}

edit() { # <pid> <keys that go to a frame without a knot>
    to "$1" Escape Home "${@:2}" i
    edited() { titled $edits '^\*mine.json'; }
    edits=$1
    eventually "an edit that is not saved" edited
}

start_server
cp assets/scenes/tail.json "$mine"
start_both

# --- one scene's file
before=$(knots "$mine")
edit $first shift+Left Right Right Right
to $first ctrl+s
saved() { [ "$(knots "$mine")" -eq $((before + 1)) ]; }
eventually "the first saves" saved
edit $second shift+Left Right Right Right Right Right
cp "$mine" "$scratch/theirs.json"
to $second ctrl+s
sleep 1
holds "the second does not write over it: it asks" cmp "$mine" "$scratch/theirs.json"
xdotool key t
same() { titled $second '^mine.json'; }
eventually "take theirs: the second has what is on disk" same
to $second ctrl+z
edits=$second
eventually "undo brings its own work back" edited
to $second ctrl+s
xdotool key k
kept() { ! cmp -s "$mine" "$scratch/theirs.json" && [ "$(knots "$mine")" -eq $((before + 1)) ]; }
eventually "keep mine: the second's work is on disk" kept
"$WIGGLY" check "$mine" >/dev/null
ok "and whole" $?

# --- one settings file
to $first t # it has noticed the second's work
sleep 1
to $first F10
to $second ctrl+shift+equal
both() { grep -q '"theme": "light"' "$settings" && grep -qE '"ui_scale": 1\.[0-9]+' "$settings"; }
eventually "what one window has set stays when another sets something else" both
[ "$(grep -c "\"$mine\"" <(sed -n '/"recent"/,/]/p' "$settings"))" -eq 1 ]
ok "a file that both have open is a recent file once" $?

# --- one folder of recovery files
edit $first shift+Left Right
edit $second shift+Left Right Right
each() { [ -s "$recovery-1" ] && [ -s "$recovery-2" ]; }
eventually "each keeps its work in a file of its own" each
end_both
start_app wiggly
xdotool key r
recovered() { titled $app '^\*mine.json'; }
eventually "after both were killed the next start offers one of the two" recovered
first=$app
"$WIGGLY" live --size $window --stage-scale 0.25 --still >/dev/null 2>"$scratch/second.err" &
second=$!
app=$second
shown() { [ -n "$(window_of $second)" ]; }
eventually "while that runs, another starts" shown
to $second r
eventually "and is offered the other" recovered
[ -s "$recovery-1" ] && [ -s "$recovery-2" ] && ! cmp -s "$recovery-1" "$recovery-2"
ok "both are still kept, and differ" $?
holds "neither complains" silent "$(cat "$scratch/app.err" "$scratch/second.err")"
