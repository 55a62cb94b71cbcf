# What surrounds the program: a locale with decimal commas, folders that may not be written to, full disks.
# And each limit that a user can meet is known: tests/limits.txt says which test is at it.
. tests/check.sh
unset DISPLAY WAYLAND_DISPLAY
scene=assets/scenes/tail.json

# --- a locale whose decimal sign is a comma

german() { LOCPATH=$B/locales LC_ALL=de_DE.UTF-8 "$@"; }
mkdir -p "$B/locales" # where the next run finds it
[ -d "$B/locales/de_DE.UTF-8" ] || { localedef -i de_DE -f UTF-8 "$scratch/de_DE.UTF-8" 2>/dev/null && mv "$scratch/de_DE.UTF-8" "$B/locales"; }
if [ "$(german bash -c 'printf %.1f 1,5' 2>/dev/null)" = "1,5" ]; then
    for name in tail figure4 follow; do
        "$WIGGLY" solve assets/scenes/$name.json -o "$scratch/plain.csv"
        german "$WIGGLY" solve assets/scenes/$name.json -o "$scratch/german.csv" && cmp "$scratch/plain.csv" "$scratch/german.csv"
        ok "decimal commas: $name is solved as elsewhere" $?
    done
    for ending in glb gltf usda bvh csv; do
        "$WIGGLY" export $scene -o "$scratch/tail.$ending" --quiet && mv "$scratch/tail.$ending" "$scratch/plain"
        german "$WIGGLY" export $scene -o "$scratch/tail.$ending" --quiet && cmp "$scratch/plain" "$scratch/tail.$ending"
        ok "decimal commas: .$ending is written as elsewhere" $?
    done
    replayed() { "$WIGGLY" live tests/replays/session.json --no-draw --replay tests/replays/session.replay $(quickly --frames 300) --result "$1"; }
    export -f replayed quickly thorough
    export WIGGLY
    replayed "$scratch/plain.json" >/dev/null
    german bash -c 'replayed "$0"' "$scratch/german.json" >/dev/null && cmp "$scratch/plain.json" "$scratch/german.json"
    ok "decimal commas: a replay edits and saves as elsewhere" $?
else
    echo "skip - there is no localedef, or no German"
fi

# --- where nothing can be written

# Each command that writes a file: status 3, one sentence that names it, the old file as it was and nothing beside it.
refused_everywhere() { # <what> <folder> <what the sentence says>
    local command ending before after
    before=$(cd "$2" && ls -A; cat "$2"/old.*)
    for command in "solve $scene" "export $scene" "rig assets/models/dog.glb --chain tail_1:tail_8"; do
        ending=csv
        [ "${command%% *}" = rig ] && ending=json
        expect 3 "$1: ${command%% *}" bash -c "set -o pipefail; (ulimit -f ${4:-unlimited}; exec \"$WIGGLY\" $command -o \"$2/old.$ending\") 2>&1 | cat >&2"
        says "$1: ${command%% *} says why" "$3" "$err"
        holds "$1: in one sentence" [ "$(printf '%s\n' "$err" | wc -l)" -eq 1 ]
    done
    after=$(cd "$2" && ls -A; cat "$2"/old.*)
    holds "$1: what was there is as it was, and nothing is left beside it" [ "$before" = "$after" ]
}

prepare() { mkdir -p "$1" && echo old >"$1/old.csv" && echo old >"$1/old.json"; }

prepare "$scratch/small"
refused_everywhere "a full disk" "$scratch/small" "File too large" 0
prepare "$scratch/locked"
if mkdir "$scratch/tiny" && mount -t tmpfs -o size=16k none "$scratch/tiny" 2>/dev/null; then
    at_end() { umount "$scratch/tiny"; umount "$scratch/locked" 2>/dev/null; }
    prepare "$scratch/tiny"
    yes >"$scratch/tiny/rest" 2>/dev/null
    refused_everywhere "a disk without room" "$scratch/tiny" "No space left on device"
    mount -t tmpfs none "$scratch/locked" && prepare "$scratch/locked" && mount -o remount,ro "$scratch/locked"
    refused_everywhere "a read-only disk" "$scratch/locked" "Read-only file system"
elif [ "$(id -u)" -ne 0 ]; then
    chmod a-w "$scratch/locked"
    refused_everywhere "a read-only folder" "$scratch/locked" "Permission denied"
    chmod u+w "$scratch/locked"
else
    echo "skip - this root may mount nothing"
fi

# --- files larger than any reader takes: sparse ones, a byte too long

too_large() { # <file> <limit> <arguments>...
    truncate -s $(($2 * 1048576 + 1)) "$scratch/$1"
    expect 1 "$1 of $2 MiB and a byte is refused" "$WIGGLY" "${@:3}"
    says "in a sentence" "$1: expected at most $2 MiB, got a larger file" "$err"
    rm "$scratch/$1"
}
for name in large.obj large.ply large.stl large.off; do
    too_large $name 1024 simulate "$scratch/$name" -o "$scratch/x.npy"
done
too_large large.glb 256 check "$scratch/large.glb"
too_large large.gltf 256 check "$scratch/large.gltf"
too_large large.glb 256 live --headless "$scratch/large.glb"
too_large large.replay 64 live --headless --replay "$scratch/large.replay"

# A triangle in a file that is large all the same.
truncate -s 24M "$scratch/large.bin"
printf '{"asset":{"version":"2.0"},"buffers":[{"uri":"large.bin","byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36}],
    "accessors":[{"componentType":5126,"type":"VEC3","count":3,"bufferView":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}]}' >"$scratch/large.gltf"
expect 0 "a large model opens" "$WIGGLY" live --headless --frames 1 "$scratch/large.gltf"
[ "$(grep -c "wiggly live: reading a glTF file of 24 MiB: this takes a while" <<<"$err")" -eq 1 ]
ok "and live says once that it takes a while" $?
rm "$scratch/large.bin"

# --- the limits in the source

listed() { grep -oE '^[A-Z0-9_]+' tests/limits.txt | LC_ALL=C sort -u; }
limits() {
    grep -rhoE '\b[A-Z0-9_]*_?(MAX|LIMIT|LARGEST|MOST)(_[A-Z0-9_]+)? = [0-9A-Z(]|#define [A-Z_]*(MAX|MOST|LIMIT)[A-Z_]* ' \
        src/{scene,base,model,export,app,commands} src/analysis/analysis.h src/simulation/{integrator,soft}.c include/wiggly |
        sed 's/#define //; s/ =.*//; s/ $//' | grep -vE '^(DRAG|HOVER|PARAMETER|WIGGLY_ERROR)_LIMIT$' | LC_ALL=C sort -u
}
unlisted=$(comm -13 <(listed) <(limits))
[ -z "$unlisted" ] || echo "  not in tests/limits.txt:" $unlisted
ok "tests/limits.txt has every limit in the source" ${#unlisted}
missing=0
there() { [ -n "$(find tests -maxdepth 2 -name "$1")" ]; } # <test>, in its room
while IFS=$'\t' read -r name where; do
    case $where in
        test_*) where=${where%%[, ]*}; there "$where" || { echo "  $name: no $where"; missing=1; } ;;
        room:*) ;;
        *) echo "  $name: $where"; missing=1 ;;
    esac
done < <(grep -v '^#' tests/limits.txt)
ok "and each names its test, or says why there is none" $missing

# --- each promise has its test
missing=$(grep -oE 'test_[a-z_0-9]+\.(c|sh)' docs/reliability.md | sort -u | while read -r name; do there "$name" || echo "$name"; done)
[ -z "$missing" ] || echo "  there is no" $missing
ok "docs/reliability.md names tests that are there" ${#missing}
unproven=$(grep -E '^\| [^*-]' docs/reliability.md | grep -vE '`test_|^\| Promise ')
[ -z "$unproven" ] || printf '%s\n' "$unproven"
ok "and one for each promise" ${#unproven}
