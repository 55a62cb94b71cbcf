# `make web`: the page is small, complete, and offline whatever it is served by.
. tests/check.sh
. tests/web/page.sh brotli

files=$(sed -n "s/.*'\(index.html [^']*\)'.*/\1/p" "$page/sw.js")
missing=$(cd "$page" && ls $files 2>&1 >/dev/null)
holds "what the worker keeps is there" [ -n "$files" -a -z "$missing" ]
besides=$(cd "$page" && for file in *.*; do case " $files sw.js " in *" $file "*) ;; *) echo "$file" ;; esac; done)
holds "and is all there is" [ -z "$besides" ]

size=0
for file in $files sw.js; do size=$((size + $(brotli -q 11 -c "$page/$file" | wc -c))); done
echo "  $size bytes over the wire"
holds "at most 1.0 MB go over the wire" [ "$size" -le 1000000 ]

cd "$page" || exit 1
holds "addresses are relative" not grep -nE "(src|href)=\"/|(fetch|register|from|import)\(? ?['\"]/|https?://[^w]" index.html page.js files.js store.js stopped.js input.js manifest.json
