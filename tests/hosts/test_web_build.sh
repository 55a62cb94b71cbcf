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

mkdir -p "$scratch/bin" "$scratch/other/src" "$scratch/other/debian/patches"
touch "$scratch/other/src/jansson.h" "$scratch/other/src/jansson_config.h.in" "$scratch/other/debian/patches/series"
cat >"$scratch/bin/apt-get" <<END
#!/bin/sh
case "\$*" in *" source "*) tar -czf jansson_2.14.orig.tar.gz -C "$scratch" other && tar -czf jansson_2.14.debian.tar.gz -C "$scratch/other" debian ;; esac
END
chmod +x "$scratch/bin/apt-get"
expect 3 "another source of jansson is refused" env PATH="$scratch/bin:$PATH" tools/web-jansson.sh "$scratch/jansson"
holds "with both hashes" grep -qE "expected SHA-256 [0-9a-f]{64}, got [0-9a-f]{64}" <<<"$err"
holds "and leaves nothing" [ ! -e "$scratch/jansson" -a ! -e "$scratch/jansson.new" ]

cd "$page" || exit 1
holds "addresses are relative" not grep -nE "(src|href)=\"/|(fetch|register|from|import)\(? ?['\"]/|https?://[^w]" index.html page.js files.js store.js stopped.js input.js manifest.json
