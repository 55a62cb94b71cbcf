# What the scripts share that test the page: builds it in $page, or skips where it cannot be built. All build it alike, so that only the
# first one does. Sourced after check.sh with what else must be installed, not run.
[ -z "${SANITIZE:-}" ] || { echo "skip - wasm is not built with sanitizers"; exit 0; }
for tool in emcc "$@"; do
    command -v "$tool" >/dev/null || { echo "skip - $tool is not installed"; exit 0; }
done
page=$B/web
status=0
said=$(flock "$B" make -s -j"$(nproc)" B="$B" web 2>&1) || status=$?
case $said in *"could not fetch it"*) echo "skip - the page, because jansson could not be fetched"; exit 0 ;; esac
[ $status -eq 0 ] || echo "$said"
ok "the page is built" $status
[ $status -eq 0 ] || exit 1
