# Unsaved work outlives kill -9, signals and a lost display: the next start offers it, and neither the scene's own file nor another running
# app is touched. Two programs work on one scene's file, with one settings file and one folder of recovery files.
. tests/check.sh
. tests/desktop.sh
state=$XDG_STATE_HOME/wiggly
recovery=$state/recovery
settings=$XDG_CONFIG_HOME/wiggly/settings
mine=$scratch/mine.json
first=""
second=""
at_end() { kill $app $first $second $server 2>/dev/null; wait 2>/dev/null; }

knots() { grep -o '"frame":' "$1" | wc -l; }
is_set() { grep -qE "$1" "$settings"; }
start_afresh() { # <argument>...: with a user's empty folders, on a fresh scene
    rm -rf "$XDG_STATE_HOME" "$XDG_CONFIG_HOME"
    start_mine "$@"
}
start_mine() {
    cp assets/scenes/tail.json "$mine"
    start_app '^mine.json' "$mine" "$@"
}
# Inserts a knot at a frame without one, as many to the right.
edit() { # <key to the right>...
    xdotool key --delay 30 Home shift+Left "$@" i
    eventually "the title shows unsaved work" opened '^\*mine.json'
}
edit_and_kill() {
    edit "$@"
    eventually "unsaved work is kept soon after the edit" [ -s "$recovery-1" ]
    kill -9 $app
    wait $app 2>/dev/null
    app=""
}

expect 0 "a headless run" "$WIGGLY" live --no-draw --frames 2
[ ! -e "$XDG_STATE_HOME" ] && [ ! -e "$XDG_CONFIG_HOME" ]
ok "a headless run makes no files of the user's" $?

# --- kill -9
window=1280x720 # room for larger text
start_server
start_mine
before=$(knots "$mine")
xdotool key F1 Escape
eventually "what to try first is said once" is_set '"welcomed": true'
xdotool key F10
eventually "the theme is remembered" is_set '"theme": "light"'
xdotool key F8
eventually "how large everything is, is remembered" is_set '"ui_scale": 1\.[0-9]+'
xdotool key ctrl+shift+0
edit_and_kill Right Right Right
holds "the scene's own file is as it was" cmp "$mine" assets/scenes/tail.json
says "it says whose work it is" "\"file\": \"$mine\"" "$(grep recovers "$recovery-1")"

start_app wiggly
xdotool key l # later
quit_app
holds "later: it stays" [ -s "$recovery-1" ]

start_app wiggly
xdotool key r
eventually "recover: the title shows the scene with unsaved work" opened '^\*mine.json'
holds "it is still kept while it is not saved" [ -s "$recovery-1" ]
first=$app
start_app '^tail.json|^untitled'
xdotool key r # would recover what is offered, and insert nothing
quit_app
holds "what a running app works on is not offered to another" [ -s "$recovery-1" ]
app=$first
first=""
xdotool key ctrl+s
eventually "saved: nothing is left to recover" gone "$recovery-1"
quit_app
holds "the work is in the scene's own file" [ "$(knots "$mine")" -eq $((before + 1)) ]
says "and that is a recent file" "\"$mine\"" "$(grep -A1 recent "$settings")"

start_mine
edit_and_kill Right Right Right Right Right
start_app wiggly
xdotool key d
eventually "discard: it is deleted" gone "$recovery-1"
quit_app

start_mine
edit Right Right Right Right
eventually "kept again" [ -s "$recovery-1" ]
xdotool key --delay 30 ctrl+q d
await_end
holds "quitting without saving deletes it" gone "$recovery-1"

# Nor is work lost where names are not UTF-8, of a folder, a file and its character.
bytes=$scratch/caf$'\xe9'
mkdir "$bytes"
cp assets/models/dog.glb "$bytes/d"$'\xf6'g.glb
expect 0 "a character in a folder that is not UTF-8" "$WIGGLY" rig "$bytes/d"$'\xf6'g.glb --chain tail_1 -o "$bytes/mine.json"
start_app mine.json "$bytes/mine.json"
edit_and_kill Right Right Right
expect 0 "the recovery file can be read" "$WIGGLY" check "$recovery-1"
start_app wiggly
xdotool key r
eventually "recover: it is the same scene" opened '^\*mine.json'
xdotool key ctrl+s
eventually "saved: nothing is left to recover" gone "$recovery-1"
quit_app
holds "the work is in that file" [ "$(knots "$bytes/mine.json")" -eq 1 ]
expect 0 "which finds its character" "$WIGGLY" export "$bytes/mine.json" -o "$bytes/mine.pc2" --frames 0:1
expect 0 "and can be read" "$WIGGLY" check "$bytes/mine.json"
holds "without a warning" [ -z "$err" ]

echo '{"theme" "dark"}' >"$settings"
start_app wiggly
quit_app
holds "broken settings keep nobody from working" silent "$(cat "$scratch/app.err")"

# --- two programs
window_of() { xdotool search --onlyvisible --pid "$1" | tail -n 1; }
titled() { xdotool getwindowname "$(window_of "$1")" 2>/dev/null | grep -q "$2"; }
to() { # <pid> <keys>...: gives a program's window the keyboard, and then types
    local window=$(window_of "$1")
    xdotool windowraise "$window" windowfocus --sync "$window"
    xdotool key --delay 30 "${@:2}"
}
edit_in() { # <pid> <key to the right>...
    to "$1" Escape Home shift+Left "${@:2}" i
    eventually "an edit that is not saved" titled "$1" '^\*mine.json'
}
start_second() { # <argument>...
    "$WIGGLY" live --size $window --stage-scale 0.25 --still "$@" >"$scratch/second.out" 2>"$scratch/second.err" &
    second=$!
}

start_afresh
first=$app
start_second "$mine"
eventually "and another" titled $second '^mine.json'
edit_in $first Right Right Right
to $first ctrl+s
saved() { [ "$(knots "$mine")" -eq $((before + 1)) ]; }
eventually "the first saves" saved
edit_in $second Right Right Right Right Right
cp "$mine" "$scratch/theirs.json"
to $second ctrl+s
sleep 1
holds "the second does not write over it: it asks" cmp "$mine" "$scratch/theirs.json"
xdotool key t
eventually "take theirs: the second has what is on disk" titled $second '^mine.json'
to $second ctrl+z
eventually "undo brings its own work back" titled $second '^\*mine.json'
to $second ctrl+s
xdotool key k
kept() { ! cmp -s "$mine" "$scratch/theirs.json" && saved; }
eventually "keep mine: the second's work is on disk" kept
expect 0 "and whole" "$WIGGLY" check "$mine"

to $first t # it has noticed the second's work
sleep 1
to $first F10
to $second F8
both() { is_set '"theme": "light"' && is_set '"ui_scale": 1\.[0-9]+'; }
eventually "what one window has set stays when another sets something else" both
holds "a file that both have open is a recent file once" [ "$(sed -n '/"recent"/,/]/p' "$settings" | grep -c "\"$mine\"")" -eq 1 ]

edit_in $first Right
edit_in $second Right Right
each() { [ -s "$recovery-1" ] && [ -s "$recovery-2" ]; }
eventually "each keeps its work in a file of its own" each
kill -9 $first $second
wait $first $second 2>/dev/null
app=""
start_app wiggly
xdotool key r
first=$app
eventually "after both were killed the next start offers one of the two" titled $first '^\*mine.json'
start_second
shown() { [ -n "$(window_of $second)" ]; }
eventually "while that runs, another starts" shown
to $second r
eventually "and is offered the other" titled $second '^\*mine.json'
each && ! cmp -s "$recovery-1" "$recovery-2"
ok "both are still kept, and differ" $?
holds "neither complains" silent "$(cat "$scratch/app.err" "$scratch/second.err")"
kill -9 $first $second
wait $first $second 2>/dev/null
first=""
second=""
app=""

# --- the program cannot go on: a signal, a lost display, a destroyed window
window=""

# Waits for the app's own end and looks at what it left.
check_rescue() { # <cause> <file with the work> <what the sentence says>
    await_end
    holds "$1: exit status 3" [ $status -eq 3 ]
    says "$1: one sentence says where the work is" "$3" "$(cat "$scratch/app.err")"
    [ "$(grep -c ^wiggly "$scratch/app.err")" -eq 1 ] && cmp "$mine" assets/scenes/tail.json
    ok "$1: the scene's own file is as it was" $?
    [ "$(knots "$2")" -eq $((before + 1)) ] && "$WIGGLY" check "$2" >/dev/null
    ok "$1: the work is whole" $?
}
check_kept() { check_rescue "$1" "$recovery-1" "$recovery-1, and the next start offers to recover it"; }

start_server
for signal in TERM HUP INT; do # the session's manager, a lost terminal, Ctrl+C
    start_afresh
    edit Right Right Right
    kill -$signal $app
    check_kept "SIG$signal"
done
start_afresh
edit Right Right Right
disown $server
kill -9 $server
check_kept "a lost display"
start_server
for moves in "" yes; do # destroyed while nothing moves, and while it draws
    start_afresh --record "$scratch/mine.replay"
    edit Right Right Right
    [ -z "$moves" ] || xdotool key space
    sleep 0.3
    xdotool search --onlyvisible --name wiggly windowclose
    check_kept "a destroyed window"
done
holds "the recording has its length" grep -q '^frames [1-9]' "$scratch/mine.replay"

start_server
rm -rf "$XDG_STATE_HOME"
touch "$XDG_STATE_HOME" # nobody can write in it, not even root
HOME=$scratch start_mine
edit Right Right Right
kill $app
await ended
rescued=$(echo "$scratch"/wiggly-recovered-*/untitled.json)
check_rescue "no place for recovery files" "$rescued" "$rescued: open it to continue"
