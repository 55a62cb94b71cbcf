# Displays that refuse: the app says so in one line and runs headless, as it does where there is none.
. tests/check.sh
. tests/desktop.sh

falls_back() { # <what>
    rm -f "$scratch/picture.png"
    expect 0 "$1: the app runs all the same" timeout 60 "$WIGGLY" live --frames 5 --size 640x400 --screenshot "$scratch/picture.png"
    holds "$1: and draws" [ -s "$scratch/picture.png" ]
    holds "$1: it says so in one line" [ "$(printf '%s\n' "$err" | grep -c '^wiggly')" = 1 ]
    says "$1: which tells what it does" "running headless" "$err"
}

DISPLAY=:6173 falls_back "a DISPLAY that nobody serves"
DISPLAY="" falls_back "an empty DISPLAY"

start_server -auth "$scratch/cookies"
mcookie=$(od -An -N16 -tx1 /dev/urandom | tr -d ' \n')
# One entry for the server: family 0x0100 (local), this host's name, the display's number, the cookie.
entry() { printf '\001\000'; field "$(uname -n)"; field "${DISPLAY#:}"; field MIT-MAGIC-COOKIE-1; printf '\000\020'; printf '%s' "$mcookie" | sed 's/../\\x&/g' | xargs -0 printf; }
field() { printf "\\$(printf %03o $((${#1} / 256)))\\$(printf %03o $((${#1} % 256)))%s" "$1"; }
entry >"$scratch/cookies"
kill -HUP $server
export XAUTHORITY=$scratch/none
falls_back "a display that wants a cookie"
XAUTHORITY=$scratch/cookies expect 0 "with the cookie it opens" timeout 60 "$WIGGLY" live --frames 5 --size 640x400
holds "in a window" silent "$err"
stop_server
unset XAUTHORITY

# As through ssh -X, where no socket of this machine answers.
start_server -listen tcp -nolisten unix -nolisten local -ac
DISPLAY=127.0.0.1$DISPLAY expect 0 "a display of another host opens" timeout 60 "$WIGGLY" live --frames 5 --size 640x400
holds "in a window, too" silent "$err"
stop_server

start_server -extension GLX
falls_back "a display without GLX"
stop_server
