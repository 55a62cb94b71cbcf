# The app as a web page: `make web` is small, complete, and offline whatever it is served by; the program in WebAssembly ends recorded
# sessions in the native documents byte for byte, and solves every scene to the same bits; and the page as a user meets it, in Chromium and
# Firefox.
. tests/check.sh
[ -z "${SANITIZE:-}" ] || { echo "skip - wasm is not built with sanitizers"; exit 0; }
needs() { # <program>...
    for tool in "$@"; do command -v "$tool" >/dev/null || { echo "skip - $tool is not installed"; return 1; }; done
}
needs emcc || exit 0
page=$B/web
expect 0 "the page is built" make -s -j"$(nproc)" B="$B" web
case $out$err in *"could not fetch it"*) echo "skip - the page, because jansson could not be fetched"; exit 0 ;; esac
[ $cases_failed -eq 0 ] || { printf '%s\n' "$out" "$err"; exit 1; }

# --- small, complete, offline

files=$(sed -n "s/.*'\(index.html [^']*\)'.*/\1/p" "$page/sw.js")
holds "what the worker keeps is there" [ -n "$files" -a -z "$(cd "$page" && ls $files 2>&1 >/dev/null)" ]
holds "and is all there is" [ -z "$(cd "$page" && ls -d *.* | grep -vxF "$(tr ' ' '\n' <<<"$files sw.js")")" ]
if needs brotli; then
    size=$(for file in $files sw.js; do brotli -q 11 -c "$page/$file"; done | wc -c)
    holds "at most 1.0 MB go over the wire: $size bytes" [ "$size" -le 1000000 ]
fi
holds "addresses are relative" not grep -nE "(src|href)=\"/|(fetch|register|from|import)\(? ?['\"]/|https?://[^w]" \
    "$page"/{index.html,page.js,files.js,store.js,stopped.js,input.js,manifest.json}

mkdir -p "$scratch/bin" "$scratch/other/src" "$scratch/other/debian/patches"
touch "$scratch/other/src/jansson.h" "$scratch/other/src/jansson_config.h.in" "$scratch/other/debian/patches/series"
cat >"$scratch/bin/apt-get" <<END_OF_SCRIPT
#!/bin/sh
case "\$*" in *" source "*) tar -czf jansson_2.14.orig.tar.gz -C "$scratch" other && tar -czf jansson_2.14.debian.tar.gz -C "$scratch/other" debian ;; esac
END_OF_SCRIPT
chmod +x "$scratch/bin/apt-get"
expect 3 "another source of jansson is refused" env PATH="$scratch/bin:$PATH" tools/web-jansson.sh "$scratch/jansson"
holds "with both hashes" grep -qE "expected SHA-256 [0-9a-f]{64}, got [0-9a-f]{64}" <<<"$err"
holds "and leaves nothing" [ ! -e "$scratch/jansson" -a ! -e "$scratch/jansson.new" ]

# --- the same bits

if needs node; then
    mkdir -p "$scratch/native" "$scratch/wasm"
    for replay in tests/replays/*.replay; do
        name=$(basename "$replay" .replay)
        case $name in pull) scene=assets/scenes/tail.json ;; pins) scene=assets/scenes/hands.json ;; walk) scene=assets/models/dog.glb ;; *) scene=tests/replays/$name.json ;; esac
        echo "live --no-draw --replay $replay $scene --result OUT/$name.json"
    done >"$scratch/commands"
    grep -l '"wiggly"' assets/scenes/*.json tests/vectors/*.json | sed -E 's|.*/(.*)\.json|solve & -o OUT/\1.csv|' >>"$scratch/commands"
    sed "s|OUT|$scratch/native|" "$scratch/commands" | while read -r line; do "$WIGGLY" $line >/dev/null 2>&1 </dev/null; done
    sed "s|OUT|/here$scratch/wasm|" "$scratch/commands" | node --no-experimental-fetch tests/web/node.js "$(realpath "$page/wiggly.js")"
    holds "there are sessions and scenes" [ "$(ls "$scratch/native" | wc -l)" -gt 100 ]
    for file in "$scratch/native"/*; do holds "$(basename "$file") is the same" cmp "$file" "$scratch/wasm/$(basename "$file")"; done
fi

# --- in browsers

needs python3 || exit $cases_failed
PYTHONPATH=tests/web python3 -c 'import sys, chromium; sys.exit(not chromium.find())' || { echo "skip - chromium is not installed"; exit $cases_failed; }
mkdir -p "$TEST_OUT/looks"
timeout 600 python3 tests/web/app.py "$page" "$TEST_OUT/looks"
ok "the page is as users meet it" $?
