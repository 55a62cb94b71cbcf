#!/bin/sh
# Prints wiggly(1) as a man page from the output of --help-all, so that it lists every option.
# Usage: tools/man-page.sh <wiggly>
set -eu
wiggly=$1

# Converts help to roff. "  TERM   text" becomes a tagged paragraph; a long term has its text on the next line, indented far. Headings such
# as "Options:" are left out.
as_roff() {
    awk '
    function roff(text) {
        gsub(/\\/, "\\e", text)
        gsub(/-/, "\\-", text)
        sub(/^[.\047]/, "\\\\\\&&", text)
        return text
    }
    /^[A-Z][a-z]*:$/ || /^$/ { next }
    /^Usage: / { print ".B " roff(substr($0, 8)); print ".PP"; next }
    /^  [^ ]/ {
        term = substr($0, 3)
        text = ""
        if (match(term, /  +/)) { text = substr(term, RSTART + RLENGTH); term = substr(term, 1, RSTART - 1) }
        print ".TP\n.B " roff(term)
        if (text != "") print roff(text)
        next
    }
    { sub(/^ +/, ""); print roff($0) }'
}

help=$("$wiggly" --help-all)
commands=$(printf '%s\n' "$help" | sed -n '/^Commands:$/,/^$/s/^  \([a-z]*\) .*/\1/p')
cat <<END
.\\" Made by tools/man-page.sh from wiggly --help-all.
.TH WIGGLY 1 "" "$("$wiggly" --version | sed 's/ (.*//')" "User Commands"
.SH NAME
wiggly \\- $(printf '%s\n' "$help" | sed -n '1s/^[^:]*: //p')
.SH SYNOPSIS
.B wiggly
.RI [ command ]
.RI [ options ]
.SH DESCRIPTION
A wiggly spline passes exactly through its knots and swings, overshoots and follows through like something with mass.
The live app shows a tail or a soft character that such splines drive, and solves them anew in every frame.
Its keys are shown by F1.
.SH COMMANDS
END
printf '%s\n' "$help" | sed -n '/^Commands:$/,/^Exit/{/^Exit/d;p}' | as_roff
for command in $commands; do
    printf '.SH WIGGLY %s\n' "$(printf '%s' "$command" | tr '[:lower:]' '[:upper:]')"
    "$wiggly" "$command" --help-all | as_roff
done
cat <<'END'
.SH EXIT STATUS
.TP
.B 0
done
.TP
.B 1
the input was bad
.TP
.B 2
wrong usage
.TP
.B 3
the environment failed: no OpenGL, disk full
.SH FILES
.TP
.I $XDG_CONFIG_HOME/wiggly/settings
(else
.IR ~/.config/wiggly/settings )
recent files, the theme, the panels' sizes
.TP
.I $XDG_STATE_HOME/wiggly/
(else
.IR ~/.local/state/wiggly/ )
unsaved work, offered at the next start
.TP
.I share/wiggly/scenes
beside the program's
.IR bin :
its own scenes
.SH EXAMPLES
.TP
.B wiggly
the live app with the tail
.TP
.B wiggly solve walk.json \-o walk.csv
every sample of every spline
.TP
.B wiggly live \-\-headless \-\-frames 60 \-\-screenshot walk.png walk.json
a picture, without a display
END
