# What README and docs tell a reader to type works as it stands: every command line runs, every program compiles without a warning
# and runs, every scene is one, every text for the clipboard is pasted; every option, make target, file and link that they
# name is there. Options are listed by --help, and not here again.
#
# Blocks of code are fenced, with a language and, for a file, its name: sh, c NAME, json NAME, csv (the clipboard); math and
# mermaid are for the renderer, and test_python.sh runs python. They are taken in order, in a folder that looks like the root of a tree that was
# built. A function named in the text, `like_this()`, is one of src or of the library.
. tests/check.sh
root=$PWD
build=$(realpath "$B")
CC=${CC:-gcc}
sanitizers=""
[ -n "${SANITIZE:-}" ] && sanitizers="-fsanitize=address,undefined"
documents="README.md CONTRIBUTING.md docs/*.md tools/README.md"
commands=$("$build/wiggly" --help-all | sed -n '/^Commands:$/,/^$/s/^  \([a-z]*\) .*/\1/p' | tr '\n' ' ')
unset DISPLAY WAYLAND_DISPLAY

# --- what a command line finds, and how it is cut short where it would last

make=$(command -v make)
mkdir "$scratch/bin" "$scratch/place" "$scratch/place/build"
make BORROWED=yes B="$B" SANITIZE="${SANITIZE:-}" DESTDIR="$scratch/stage" PREFIX=/opt/wiggly install >"$scratch/log" 2>&1
ok "make install" $?
export PKG_CONFIG_PATH=$scratch/stage/opt/wiggly/lib/pkgconfig LD_LIBRARY_PATH=$scratch/stage/opt/wiggly/lib

cat >"$scratch/bin/wiggly" <<END
#!/bin/bash
# Films need ffmpeg, which not every machine has; small pictures do.
if [[ " \$* " =~ ^\ export\ .*\.(mp4|webm|gif|png)\  ]]; then
    [[ \${BASH_REMATCH[1]} = [gp]* ]] || { $(thorough && echo command -v ffmpeg || echo false) >/dev/null; } || exit 0
    set -- "\$@" --size 160x90 --frames 0:12
fi
# The live app lasts until somebody quits it: ten small frames do, or 70 where a log is read. A simulation takes 10 s: a coarse, short one does.
case \${1-live} in
simulate | flesh) set -- "\$@" --tets 300 --seconds 3 --substeps 1 ;;
solve | rig | export | check | analyze | log | -*) ;;
*)
    case " \$* " in
    *" --replay "*) ;;
    *" --frames "*) set -- "\$@" --frames 70 ;;
    *) set -- "\$@" --frames 10 ;;
    esac
    [[ " \$* " == *" --replay "* ]] || set -- "\$@" --size 320x320 --scale 0.5
    ;;
esac
exec "$build/wiggly" "\$@"
END
cat >"$scratch/bin/make" <<END
#!/bin/bash
# These two are made, but for the dog, which takes a while and nothing here needs. Of the others it is enough that there is something to do,
# which is asked for all at once: test is this suite, run and install have tests of their own, bench and regress take minutes, check
# installs packages, and clean would take the build away.
case \$1 in
models)
    $(thorough || echo "[ '$build/models/creature.obj' -nt '$build/creature_obj' ] && exit")
    set -- "$(thorough && echo models || echo "$B/models/creature.obj")"
    ;;
figures) ;;
*) printf '%s\n' "\$@" >>"$scratch/goals"; exit ;;
esac
exec $make --no-print-directory -C "$root" B="$B" SANITIZE="${SANITIZE:-}" "\$@"
END
cat >"$scratch/bin/timing_diff" <<END
#!/bin/bash
# 1 says that the second log is slower, which on a busy machine it may be.
"$build/timing_diff" "\$@" || [ \$? -eq 1 ]
END
printf '#!/bin/bash\nexec %s %s "$@"\n' "$CC" "$sanitizers" >"$scratch/bin/cc"
chmod +x "$scratch"/bin/*
mkdir -p "$build/models" # which the first of the commands fills
for file in "$build"/*; do ln -s "$file" "$scratch/place/build/"; done
ln -sf "$scratch/bin/wiggly" "$scratch/bin/timing_diff" "$scratch/place/build/"
for file in assets examples tests tools; do ln -s "$root/$file" "$scratch/place/$file"; done
export PATH=$scratch/bin:$PATH

# --- blocks

run() { # <where> <command lines>
    local line
    while IFS= read -r line; do
        [[ -n $line ]] || continue
        expect 0 "$1: $line" bash -c "cd '$scratch/place' && $line"
        printf '%s\n' "$out" "$err" >>"$scratch/place/said"
    done <<<"$2"
}

compile() { # <where> <name> <text>
    printf '%s' "$3" >"$scratch/place/$2"
    # shellcheck disable=SC2046
    expect 0 "$1: $2 compiles" cc -std=c11 -Wall -Wextra -Wconversion -Werror "$scratch/place/$2" \
        $(pkg-config --cflags --libs wiggly) -o "$scratch/program"
    expect 0 "$1: $2 runs" "$scratch/program"
}

# Onto a spline without knots, so that those at the end are those of the text.
paste() { # <where> <text>
    local encoded
    encoded=$(printf '%s' "$2" | od -An -v -tx1 | tr -d ' \n' | sed 's/../%&/g')
    rm -f "$scratch/pasted.json"
    (
        cd "$scratch" || exit
        echo '{"wiggly": 1, "frames": [0, 96], "splines": [{"name": "s"}]}' >empty.json
        "$build/wiggly" live --no-draw --size 640x360 --frames 1 --record header empty.json &&
            { sed '/^frames/d' header && echo "frames 5" && echo "2 paste $encoded"; } >paste.replay &&
            "$build/wiggly" live --no-draw --replay paste.replay --result pasted.json empty.json
    ) >/dev/null 2>&1
    holds "$1: is pasted" grep -q '"value": 1, "slope": 0, "stiffness": 50 }' "$scratch/pasted.json"
}

block() { # <where> <language> <name> <text>
    case "$2 ${3:+NAME}" in
    "sh ") run "$1" "$4" ;;
    "c NAME") compile "$1" "$3" "$4" ;;
    "json NAME")
        printf '%s' "$4" >"$scratch/place/$3"
        expect 0 "$1: $3 is a scene" "$build/wiggly" check "$scratch/place/$3"
        ;;
    "csv ") paste "$1" "$4" ;;
    "math " | "mermaid " | "python ") ;;
    *) ok "$1: a block of a language that is tested ($2 $3)" 1 ;;
    esac
}

for document in $documents; do
    number=0 language="" name="" text="" from=0
    while IFS= read -r line; do
        number=$((number + 1))
        if [[ -z $language && $line =~ ^\`\`\`([a-z]*)\ ?(.*)$ ]]; then
            language=${BASH_REMATCH[1]:-none} name=${BASH_REMATCH[2]} text="" from=$number
        elif [[ -n $language && $line == '```' ]]; then
            block "$document:$from" "$language" "$name" "$text"
            language=""
        elif [[ -n $language ]]; then
            text+=$line$'\n'
        elif [[ $line == "    "* ]]; then
            ok "$document:$number: code is fenced" 1
        fi
    done <"$document"
done

# --- what is named in the text

for command in $commands; do
    "$build/wiggly" "$command" --help-all | sed -nE 's/^  ((-.), )?(--[a-z-]+).*/\3 \2/p' >"$scratch/$command.options"
done
# shellcheck disable=SC2086
all=$(cat $documents)
# shellcheck disable=SC2086
unknown=$(grep -ohE '`[^`]*`' $documents | grep -oE -- '--[a-z][a-z-]*' | sort -u |
    grep -vxFf <(cut -d' ' -f1 "$scratch"/*.options; grep -ohE -- '--[a-z-]+' tools/*.py tools/wiggly-bench.c; printf '%s\n' --help --help-all --version --cflags --libs))
[ -z "$unknown" ] || echo "  unknown option $unknown"
holds "every option that is named is there" [ -z "$unknown" ]

missing=$(for command in $commands; do [[ $all =~ \`wiggly\ \[?$command[^a-z] ]] || echo "$command"; done)
[ -z "$missing" ] || echo "  not in README or docs: $missing"
[ -n "$commands" ] && [ -z "$missing" ]
ok "every command is named" $?
missing=$("$build/wiggly" export --help | sed -n 's/.* required: //p' | grep -o '\.[a-z0-9]*' | grep -vxFf <(grep -oE '\.[a-z0-9]+' docs/export.md))
[ -z "$missing" ] || echo "  not in docs/export.md: $missing"
holds "every format is named" [ -z "$missing" ]

# shellcheck disable=SC2086
unknown=$(grep -ohE '`wiggly [a-z]+' $documents | cut -d' ' -f2 | sort -u | grep -vxFf <(tr ' ' '\n' <<<"$commands help"))
[ -z "$unknown" ] || echo "  unknown command $unknown"
holds "every command that is named is there" [ -z "$unknown" ]

# shellcheck disable=SC2086
while read -r line; do bash -c "$line"; done < <(
    { grep -ohE '`make [^`]*`' $documents | tr -d '`' | grep -vE 'make (models|figures)' && sed -n 's/^ *- run: \(make .*\)/\1/p' .github/workflows/*.yml; } | sort -u
)
mapfile -t goals < <(sort -u "$scratch/goals")
slow=$(quickly '|^web$|compile_commands') # these two ask make once more
# shellcheck disable=SC2046
expect 0 "there is something to do for: ${goals[*]}" "$make" --no-print-directory -n B="$B" $(printf '%s\n' "${goals[@]}" | grep -vE "=$slow")
missing=$(printf '%s\n' "${goals[@]}" | sed -n 's/^TESTS=//p' | tr ' ' '\n' | while read -r test; do tools/find-tests.sh "$test" >/dev/null 2>&1 || echo "$test"; done)
variables=$(printf '%s\n' "${goals[@]}" | sed -n 's/=.*//p' | while read -r name; do grep -qE "\b$name\b" Makefile tools/*.mk tools/*.sh || echo "$name"; done)
holds "and each test and variable is there" [ -z "$missing$variables" ]

grep -rohIE "[a-z_][a-z0-9_]*\(" src include tests python/src | sort -u >"$scratch/called"
for document in $documents CHANGELOG.md {assets,src/*,tests}/README.md; do
    missing=$(
        grep -oE '\]\([^)]*\)' "$document" | tr -d '[]()' | while read -r link; do
            target=$(dirname "$document")/${link%%#*} heading=${link#*#}
            [[ $link == http* || -e $target ]] || echo "$link"
            [[ $link != *#* ]] || grep -qi "^#* ${heading//-/[ -]}\$" "$target" || echo "$link"
        done
        grep -oE '`(assets|docs|examples|include|src|shaders|tests|tools)/[^` *]*`' "$document" | tr -d '`' |
            while read -r path; do [ -e "$path" ] || echo "$path"; done
        grep -oE '`test_[a-z0-9_]+`' "$document" | tr -d '`' | while read -r test; do ls tests/*/"$test.c" >/dev/null 2>&1 || echo "$test"; done
        grep -oE '[a-z_]+[a-z0-9_]*\(\)' "$document" | tr -d ')' | sort -u | comm -23 - "$scratch/called"
    )
    [ -z "$missing" ] || echo "  not there:" $missing
    holds "$document: files and links are there" [ -z "$missing" ]
done

# --- numbers: what a page says, and what says so in the source or in what the program wrote

cat >"$scratch/least.json" <<'END'
{"wiggly": 1, "frames": [0, 96], "splines": [{"name": "s", "knots": []}],
 "rigs": [{"type": "tail", "name": "t", "channels": [{"spline": "s"}]}]}
END
expect 0 "a scene with the least" "$build/wiggly" live --no-draw --frames 1 --result "$scratch/place/saved.json" "$scratch/least.json"
tr -s ' \n' ' ' <"$scratch/place/saved.json" >"$scratch/place/saved"
while IFS='~' read -r page words file proof; do
    [ -e "$file" ] || file=$scratch/place/$file
    tr -s ' \n' ' ' <"$page" | grep -qF -e "$words" && grep -qF -e "$proof" "$file"
    ok "$page: $words" $?
done <<'END'
README.md~Debian 12 and 13 and Ubuntu 22.04 and 24.04~tools/bare-machine.sh~<bookworm | trixie | jammy | noble>
CONTRIBUTING.md~up to 1,200 lines; a function is one thought, up to 120~tools/check-lengths.sh~No file above 1,200 lines, no function above 120
docs/app.md~more than twice as far~src/scene/warnings.c~FAR = 2;
docs/app.md~Within two seconds~src/app/recovery.c~INTERVAL = 1;
docs/app.md~from 75 % to 300 %~src/app/state.h~UI_SCALE_LEAST 0.75
docs/app.md~from 75 % to 300 %~src/app/state.h~UI_SCALE_MOST 3.0
docs/app.md~four knots~include/wiggly/more.h~WIGGLY_FEWEST_EXPLAINED 4
docs/keys.md~75 … 300 %~src/app/state.h~UI_SCALE_MOST 3.0
docs/keys.md~0.1 … 4×~src/editor/core/view.c~{0.1, 0.25, 0.5, 1, 2, 4}
docs/keys.md~by 1 % of the view~src/editor/stage/overlays.c~NUDGE = 0.01;
docs/keys.md~1 % of the visible values~src/editor/curves/knots.c~0.01 * hundredths * plot_height(core)
docs/characters.md~the lowest twentieth of the height~src/commands/simulate.c~pin below a height (1/20 of the mesh)
docs/export.md~within 1e-6~tests/README.md~| `.glb` | Blender | 1e-6 |
docs/export.md~within 5e-4~tests/README.md~| `.usda`, scaled bones | usd-core | 5e-4 |
docs/export.md~11 bits~src/export/usda.c~with 11 bits
docs/export.md~up to eight joints per vertex~src/model/gltf.h~GLTF_INFLUENCES = 8
docs/your-character.md~more than 256 MiB~src/model/glb.h~GLB_FILE_LIMIT = 1 << 28
docs/your-character.md~more than 16,777,216 vertices~src/model/gltf_read.c~VERTEX_LIMIT = 1 << 24
docs/your-character.md~up to eight joints per vertex~src/model/gltf.h~GLTF_INFLUENCES = 8
docs/library.md~to 1e-9 of their range~tests/spline/test_vectors.c~agree to 1e-9 of the range
docs/library.md~24 a second~src/spline/desc.c~to->step = 1.0 / 24
docs/library.md~144 frames a second~examples/game_loop.c~1.0 / 144
tools/README.md~frames over 16.7~said~over 16.7 ms
tools/README.md~and 33.3 ms~said~over 33.3 ms
tools/README.md~eleven times~tools/regress.sh~PAIRS:-11
tools/README.md~a 99 % bootstrap~said~99 % interval
tools/README.md~a loop of 10,000,000 samples~tools/wiggly-bench.c~SAMPLES = 10000000
docs/scene-format.md~at most 100,000 samples~src/scene/document.h~SPLINE_MAX_SAMPLES = 100000,
docs/scene-format.md~20,000 with `limits`~src/scene/document.h~LIMITED_MAX_SAMPLES = 20000,
docs/scene-format.md~200,000 of them with `limits`~src/scene/document.h~SCENE_MAX_LIMITED = 200000,
docs/scene-format.md~at most 1,048,576~src/scene/rig.h~SCENE_MAX_PINNED = 1 << 20,
docs/scene-format.md~A floor counts as 50 pins~src/scene/rig.h~FLOOR_PINS = 50,
docs/scene-format.md~at most 200,000 joints~src/scene/rig.h~SCENE_MAX_JOINTS = 200000,
docs/scene-format.md~1,000,000 samples~src/scene/document.h~SCENE_MAX_SAMPLES = 1000000,
docs/scene-format.md~100,000 knots~src/scene/document.h~SCENE_MAX_KNOTS = 100000,
docs/scene-format.md~frames per second (24); samples per frame (1)~saved~"fps": 24, "substeps": 1,
docs/scene-format.md~classical cubic | 0~saved~"frequency": 0,
docs/scene-format.md~overdamped | 0~saved~"damping": 0,
docs/scene-format.md~(complex mode only) | 0.1~saved~"bandwidth": 0.1,
docs/scene-format.md~the paper's formula | 1~saved~"calm": 1,
docs/scene-format.md~swings about | 0~saved~"equilibrium": 0,
docs/scene-format.md~the slope holds (1000)~src/scene/document.h~KNOT_DEFAULT_STIFFNESS 1000.0
docs/scene-format.md~joints 24, length 1.6, position [0, 0, 0], rest 0~saved~"joints": 24, "length": 1.6, "position": [0, 0, 0], "rest": 0,
docs/scene-format.md~axis "side", lag 6.5 and gain 5~saved~"axis": "side", "lag": 6.5, "gain": 5
docs/scene-format.md~2 to 32 places~src/scene/rig.h~RAMP_MAX_POINTS = 32, ///< and at least 2
docs/scene-format.md~Up to four coordinates~src/scene/rig.h~MODEL_MAX_DRIVES = 4
docs/mathematics.md~at most 1e−9 (cubic) or 1e−8 (other modes)~tests/spline/test_vectors.c~WIGGLY_CUBIC ? 1e-9 : 1e-8
docs/mathematics.md~exceeds 10⁴ times~src/spline/spline.c~implausible = 1e4
docs/mathematics.md~again with c = 0.05~src/spline/problem.h~FALLBACK_CALM 0.05
docs/mathematics.md~at least 0.05·c~src/spline/poles.h~LEAST_DAMPING 0.05
docs/mathematics.md~\ge 10^{-4}~src/spline/pins.c~out_of_reach = 1e-4, firm = 0.04
docs/mathematics.md~(0.04/\varepsilon)~src/spline/pins.c~firm = 0.04
docs/mathematics.md~10⁻⁵ of the character's size~src/scene/evaluate.c~DEEP = 1e-5
docs/mathematics.md~an eighth of a period~src/spline/pose.c~CELLS = 8
docs/mathematics.md~+ 30\,~src/spline/explain.c~pluck = 30;
docs/mathematics.md~(0.03\,~src/spline/explain.c~blur = 0.03;
docs/mathematics.md~to 1.25 times~src/spline/explain.c~headroom = 1.25;
docs/mathematics.md~ζ from 0.01 to 0.6~src/spline/explain.c~{0.01, 0.02, 0.035, 0.05, 0.08, 0.12, 0.18, 0.27, 0.4, 0.6}
tests/README.md~makes 200 small faults~tools/mutate.py~"--count", type=int, default=200
tools/README.md~a knot every 24 samples~tools/bench/input.c~KNOT_EVERY = 24
tools/README.md~gaps of 12 to 36~tools/bench/input.c~LEAST_GAP = 12, GAPS = 25
tools/README.md~ten thousand splines~tools/bench/batch.c~CROWD = 10000
END

# --- assets: a licence for each, and no picture that no page shows

# shellcheck disable=SC2086
missing=$(
    find assets -type f ! -name README.md | sed 's|^assets/||' | while read -r file; do
        grep -qE "^\| \`(${file//./\\.}|${file%/*}/\*(\.${file##*.})?)\` \| [A-Z]" assets/README.md || echo "$file"
    done
    find assets/pictures -type f | while read -r picture; do grep -qF "$picture" $documents || echo "$picture"; done
)
[ -z "$missing" ] || echo "  no licence, or on no page:" $missing
holds "every asset has a licence, every picture a page" [ -z "$missing" ]

# --- the hosted page: a workflow publishes it, and README links it as soon as its maintainer has put a name there

workflows=$(echo .github/workflows/*.yml)
if python3 -c 'import yaml' 2>/dev/null; then
    # shellcheck disable=SC2086
    expect 0 "every workflow is YAML, and its actions are pinned" python3 -c '
import re, sys, yaml
for path in sys.argv[1:]:
    for job in yaml.safe_load(open(path))["jobs"].values():
        for step in job["steps"]:
            assert "run" in step or re.fullmatch(r"actions/[a-z-]+@[0-9a-f]{40}", step["uses"]), (path, step)' $workflows
fi
holds "what is published is what make web makes" \
    grep -qx " *path: build/$(sed -n 's|.*Page: $(B)/\(.*\)/index.html.*|\1|p' src/platform/web/web.mk)" .github/workflows/pages.yml
link() { head -n 1 | sed 's/<!--.*-->//' | grep -oE '\]\(https://[^)]*\)'; } # as the first line is shown
holds "README links no page that has no name" not grep -q NAME <<<"$(link <README.md)"
sed '1s/^<!-- \(.*\)NAME\(.*\) -->$/\1somebody\2/' README.md >"$scratch/named"
holds "and the page once it has one" [ -n "$(link <"$scratch/named")" ]
