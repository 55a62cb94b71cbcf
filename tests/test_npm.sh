# The npm package: its size, its promises under Node, the library's vectors by the same compiler, and its types.
. tests/check.sh
[ -z "${SANITIZE:-}" ] || { echo "skip - wasm is not built with sanitizers"; exit 0; }
for tool in node emcc python3; do
    command -v $tool >/dev/null || { echo "skip - $tool is not installed"; exit 0; }
done
place=$(mkdir -p "$B/npm" && realpath "$B/npm")
export WIGGLY_NPM=$place/wiggly VECTORS_WASM=$place/vectors.wasm NO_COLOR=1

newest() { # <file>: whether it is newer than what it is made of
    [ -e "$1" ] && [ -z "$(find npm src/maths src/spline include/wiggly -type f -newer "$1" | head -n 1)" ]
}
newest "$WIGGLY_NPM/wasm.js" || expect 0 "the package is built" npm/build.sh "$B"
newest "$VECTORS_WASM" || expect 0 "and the whole solver" npm/tests/build-vectors.sh "$VECTORS_WASM"

packed=$(cat "$WIGGLY_NPM"/* | gzip -9 | wc -c)
echo "  all that is shipped: $packed bytes gzipped"
holds "at most 45 KB are shipped" [ "$packed" -le 45000 ]
version=$(sed -n 's/.*define WIGGLY_VERSION "\(.*\)"/\1/p' include/wiggly/wiggly.h)
holds "with the library's version" grep -qF "\"version\": \"$version\"" "$WIGGLY_NPM/package.json"
expect 0 "it does what it promises" node --test npm/tests/spring.test.js
expect 0 "the vectors are met under Node" node --test npm/tests/vectors.test.js
{ # a comment that begins with numbers says what its line returns
    echo 'const check = (...pair) => { const [a, b] = pair.map((x) => JSON.stringify([x].flat().map((y) => +y.toFixed(2)))); if (a !== b) throw Error(`${a}, not ${b}`) }'
    sed -n '/^```js$/,/^```$/{/^```/!p;}' npm/README.md | sed -E 's#^([a-z]+\..*[^ ]) +// (\[[^]]*\]|[0-9.]+)(:.*)?$#check(\1, \2)#'
} >"$scratch/page.mjs"
holds "its page has numbers" [ "$(grep -c '^check' "$scratch/page.mjs")" -ge 4 ]
mkdir -p "$scratch/node_modules" && ln -s "$WIGGLY_NPM" "$scratch/node_modules/wiggly"
expect 0 "the programs of its page run" node "$scratch/page.mjs"

# --- with what npm fetches

command -v npm >/dev/null || { echo "skip - npm is not installed"; exit $cases_failed; }
npm_has "$place/types" types || exit $cases_failed
cp npm/fetch.sh "$scratch" && sed 's/sha512-\(.\)\(.\)/sha512-\2\1/' npm/fetched.txt >"$scratch/fetched.txt"
expect 3 "another package than the list names is refused" "$scratch/fetch.sh" "$scratch/other" types
says "with both hashes" "expected sha512-lj" "$err"
cp npm/tests/types.ts "$scratch"
expect 0 "the types are right" node "$place/types/node_modules/typescript/bin/tsc" --strict --noEmit --target es2022 --module nodenext --moduleResolution nodenext --skipLibCheck false "$scratch/types.ts"

PYTHONPATH=tests/web python3 -c 'import sys, chromium; sys.exit(not chromium.find())' || { echo "skip - chromium is not installed"; exit $cases_failed; }
examples=$place/examples
mkdir -p "$examples" && cp npm/examples/* "$examples"
sed -i 's|https://esm.sh/wiggly|../wiggly/index.js|' "$examples/waapi.html"
npm_has "$examples" examples || exit $cases_failed
ln -sfn ../../wiggly "$examples/node_modules/wiggly"
bundle=$(node -p 'require("./npm/examples/package.json").scripts.start.replace(/--servedir=./, "--log-level=warning")')
expect 0 "the examples are bundled" bash -c "cd '$examples' && node node_modules/esbuild/bin/$bundle"
holds "of the versions that npm/fetched.txt names" node -e '
    const named = require("fs").readFileSync("npm/fetched.txt", "utf8"), { dependencies } = require("./npm/examples/package.json")
    process.exit(+!Object.entries(dependencies).every(([name, version]) => name === "wiggly" || named.includes(`${name} ${version} `)))'
cp npm/compare.mjs "$examples"
expect 0 "springs of two keys are compared" bash -c "cd '$examples' && node compare.mjs"
holds "and the page says how they do" [ -n "$out" -a -z "$(grep -vxFf npm/README.md <<<"$out")" ]
timeout 800 python3 npm/tests/pages.py "$examples"
ok "the pages were looked at in Chromium" $?
