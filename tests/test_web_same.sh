# The same program in WebAssembly: recorded sessions end in the native documents byte for byte, and every scene solves to the same bits.
. tests/check.sh
[ -z "${SANITIZE:-}" ] || { echo "skip - wasm is not built with sanitizers"; exit 0; }
for tool in emcc node; do
    command -v $tool >/dev/null || { echo "skip - $tool is not installed"; exit 0; }
done
expect 0 "the page is built" flock "$B" env -u LDFLAGS make -s B="$B" web
page=$(realpath "$B/web/wiggly.js")
mkdir -p "$scratch/native" "$scratch/wasm"

in_wasm() { node --no-experimental-fetch tests/web/node.js "$page" "$@"; }

same() { # <what> <ending> <command, with OUT for its file>...
    local what=$1 native=$scratch/native/$1$2 wasm=$scratch/wasm/$1$2
    shift 2
    "$WIGGLY" "${@//OUT/$native}" >/dev/null 2>&1
    in_wasm "${@//OUT//here$wasm}" >"$scratch/said" 2>&1 || cat "$scratch/said"
    holds "$what is the same" cmp "$native" "$wasm"
}

for replay in tests/replays/*.replay; do
    name=$(basename "$replay" .replay)
    scene=tests/replays/$name.json
    case $name in
    pins) scene=assets/scenes/hands.json ;;
    walk) scene=assets/models/dog.glb ;;
    esac
    same "$name" .json live --no-draw --replay "$replay" --result OUT "$scene"
done
for scene in assets/scenes/*.json tests/vectors/*.json; do
    [ "$(head -c 1 "$scene")" = "{" ] && grep -q '"wiggly"' "$scene" || continue
    same "$(basename "$scene" .json)" .csv solve "$scene" -o OUT
done
[ $cases_failed -eq 0 ]
