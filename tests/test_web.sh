# The app in a browser: `make web`, and the page as a user meets it, in Chromium and Firefox.
. tests/check.sh
[ -z "${SANITIZE:-}" ] || { echo "skip - wasm is not built with sanitizers"; exit 0; }
for tool in emcc python3 brotli; do
    command -v $tool >/dev/null || { echo "skip - $tool is not installed"; exit 0; }
done
PYTHONPATH=tests/web python3 -c 'import sys, chromium; sys.exit(not chromium.find())' || { echo "skip - chromium is not installed"; exit 0; }
expect 0 "the page is built" flock "$B" env -u LDFLAGS make -s B="$B" web
mkdir -p "$TEST_OUT/looks"
timeout 600 python3 tests/web/app.py "$B/web" "$TEST_OUT/looks"
ok "the page is as users meet it" $?
