# What surrounds the program: the range of each option, a locale with decimal commas, folders that may not be written to, full disks.
# And each limit that a user can meet is known: tests/limits.txt says which test is at it.
. tests/check.sh
unset DISPLAY WAYLAND_DISPLAY
scene=assets/scenes/tail.json

# --- options: the ends of a range are taken (the option that comes after is what is wrong), what lies beyond is not

range() { # <command> <option> <one below> <least> <most> <one above>
    local value name="$1 $2" refused=1
    for value in "$4" "$5"; do
        case $("$WIGGLY" "$1" "$2=$value" --nonsense 2>&1) in *"--nonsense"*) ;; *) refused=0; echo "  $name=$value" ;; esac
    done
    for value in "$3" "$6" nan inf 1e999 "" 1,5; do
        "$WIGGLY" "$1" "$2=$value" --nonsense >/dev/null 2>"$scratch/stderr"
        [ $? -eq 2 ] && grep -q -- "$2: expected" "$scratch/stderr" || { refused=0; echo "  $name=$value"; }
    done
    ok "$name takes $4 and $5, and nothing beyond" $((refused == 0))
}

range live --frames 0 1 10000000 10000001
range live --size 319x320 320x320 8192x8192 8192x8193
range live --scale 0.49999 0.5 4 4.00001
range live --ui-scale 0.7499 0.75 3 3.001
range export --fps 0.00099 0.001 100000 100000.1
range export --substeps 0 1 1024 1025
range export --size 15x16 16x16 8192x8192 8193x16
range export --loops 0 1 10000 10001
range rig --frequency 0.00099 0.001 1000 1000.1
range rig --damping 0 0.000001 1 1.00001
range analyze --fps 0.00099 0.001 100000 100000.1
range analyze --modes 0 1 8 9
range analyze --from -0.1 0 1000000 1000001
range simulate --amplitude -2.01 -2 2 2.01
range simulate --drive-frequency 0.00099 0.001 1000 1000.1
range simulate --seconds 0.00099 0.001 3600 3600.1
range simulate --fps 0.99 1 1000 1000.1
range simulate --accuracy 0.000099 0.0001 1 1.01
range simulate --substeps 0 1 1000 1001
range simulate --tets 49 50 200000 200001
range simulate --frequency 0.00099 0.001 1000 1000.1
range simulate --softness 0.00099 0.001 1000 1000.1
range simulate --poisson -0.01 0 0.49 0.4901
range simulate --damping -0.01 0 1 1.01
range simulate --gravity -0.1 0 10000 10000.1
range simulate --floor -0.1 0 1000000 1000001
range simulate --modal 0 1 200 201

many() { # <command> <times> <argument>...
    local command=$1 times=$2
    shift 2
    "$WIGGLY" "$command" $(for i in $(seq "$times"); do echo "$@"; done) --nonsense 2>&1
}
for times in 31 32 33; do
    says "rig with $times chains" "$([ $times -gt 32 ] && echo "at most 32 times" || echo --nonsense)" "$(many rig $times --chain a:b)"
done
for times in 15 16 17; do
    says "analyze with $times motions" "$([ $times -gt 16 ] && echo motion.npy || echo "-o creature.glb")" \
        "$("$WIGGLY" analyze --rest mesh.obj $(yes motion.npy | head -n $times) 2>&1)"
done
for size in 63 64 16384 16385; do
    printf 'wiggly-replay 1\nsize %d %d\nscale 1\n' $size $size >"$scratch/size.replay"
    error=$("$WIGGLY" live --no-draw --frames 1 --replay "$scratch/size.replay" $scene 2>&1)
    case $error in *"from 64 to 16384"*) [ $size -lt 64 ] || [ $size -gt 16384 ] ;; *) [ $size -ge 64 ] && [ $size -le 16384 ] ;; esac
    ok "a replay of $size pixels" $?
done

# Keys and pictures of an export: at the limit it is the folder that is wrong.
lengthy() { # <frames> <export's options>...
    printf '{"wiggly": 1, "fps": 1, "frames": [0, %d], "splines": [{"name": "s"}], "rigs": [{"type": "tail", "name": "t", "spline": "s"}]}' \
        "$1" >"$scratch/long.json"
    "$WIGGLY" export "$scratch/long.json" "${@:2}" 2>&1
}
says "export of 100,000,000 keys" "/nowhere/x.csv: cannot be written" "$(lengthy 90009 --fps 1111 -o /nowhere/x.csv)"
says "and of one more" "at most 100000000 keys, got 100000001" "$(lengthy 90009 --fps 1111.00002 -o /nowhere/x.csv)"
case $(lengthy 41841 --fps 239 -o /nowhere/x.mp4) in *"at most"*) false ;; *nowhere* | *ffmpeg*) ;; *) false ;; esac
ok "a film of 10,000,000 pictures" $?
says "and of one more" "at most 10000000 pictures, got 10000001" "$(lengthy 41841 --fps 239.00003 -o /nowhere/x.mp4)"

# --- a locale whose decimal sign is a comma

german() { LOCPATH=$scratch/locales LC_ALL=de_DE.UTF-8 "$@"; }
mkdir "$scratch/locales"
localedef -i de_DE -f UTF-8 "$scratch/locales/de_DE.UTF-8" 2>/dev/null
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
    replayed() { "$WIGGLY" live tests/replays/session.json --no-draw --replay tests/replays/session.replay --result "$1"; }
    export -f replayed
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
while IFS=$'\t' read -r name where; do
    case $where in
        test_*) where=${where%%[, ]*}; [ -e "tests/$where" ] || { echo "  $name: no $where"; missing=1; } ;;
        room:*) ;;
        *) echo "  $name: $where"; missing=1 ;;
    esac
done < <(grep -v '^#' tests/limits.txt)
ok "and each names its test, or says why there is none" $missing

# --- each promise has its test
missing=$(grep -oE 'test_[a-z_0-9]+\.(c|sh)' docs/reliability.md | sort -u | while read -r name; do [ -e "tests/$name" ] || echo "$name"; done)
[ -z "$missing" ] || echo "  there is no" $missing
ok "docs/reliability.md names tests that are there" ${#missing}
unproven=$(grep -E '^\| [^*-]' docs/reliability.md | grep -vE '`test_|^\| Promise ')
[ -z "$unproven" ] || printf '%s\n' "$unproven"
ok "and one for each promise" ${#unproven}
