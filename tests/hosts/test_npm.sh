# The npm package: its size, its promises under Node, the library's vectors of its kind, the springs of others, and its types.
. tests/check.sh
[ -z "${SANITIZE:-}" ] || { echo "skip - the npm package has no C"; exit 0; }
for tool in node python3; do
    command -v $tool >/dev/null || { echo "skip - $tool is not installed"; exit 0; }
done
place=$(mkdir -p "$B/npm" && realpath "$B/npm")
export WIGGLY_NPM=$place/wiggly NO_COLOR=1

expect 0 "the package is built" npm/build.sh "$B"
version=$(sed -n 's/.*define WIGGLY_VERSION "\(.*\)"/\1/p' include/wiggly/wiggly.h)
holds "with the library's version" grep -qF "\"version\": \"$version\"" "$WIGGLY_NPM/package.json"
expect 0 "it does what it promises, and meets the vectors" node --test npm/tests/spring.test.js npm/tests/vectors.test.js
{ # a comment that begins with numbers says what its line returns
    echo 'const check = (...pair) => { const [a, b] = pair.map((x) => JSON.stringify([x].flat().map((y) => +y.toFixed(2)))); if (a !== b) throw Error(`${a}, not ${b}`) }'
    sed -n '/^```js$/,/^```$/{/^```/!p;}' npm/README.md | sed -E 's#^([a-z]+\..*[^ ]) +// (\[[^]]*\]|[0-9.]+)(:.*)?$#check(\1, \2)#'
} >"$scratch/page.mjs"
holds "its page has numbers" [ "$(grep -c '^check' "$scratch/page.mjs")" -ge 4 ]
mkdir -p "$scratch/node_modules" && ln -s "$WIGGLY_NPM" "$scratch/node_modules/wiggly"
expect 0 "the programs of its page run" node "$scratch/page.mjs"
expect 0 "require() finds it" node -e "process.chdir('$scratch'); require('module').createRequire('$scratch/')('wiggly').spring({ from: 0, to: 1 }).at(1)"

# --- with what npm fetches

command -v npm >/dev/null || { echo "skip - npm is not installed"; exit $cases_failed; }
npm_has "$place/types" types || exit $cases_failed
cp tools/npm/fetch.sh "$scratch" && sed 's/sha512-\(.\)\(.\)/sha512-\2\1/' tools/npm/fetched.txt >"$scratch/fetched.txt"
expect 3 "another package than the list names is refused" "$scratch/fetch.sh" "$scratch/other" types
says "with both hashes" "expected sha512-lj" "$err"
for how in "mts node16 node16" "cts node16 node16" "ts esnext bundler"; do
    read -r ending module resolution <<<"$how"
    cp npm/tests/types.ts "$scratch/types.$ending"
    expect 0 "the types are right: .$ending, $resolution" node "$place/types/node_modules/typescript/bin/tsc" --strict --noEmit --target es2022 --module "$module" \
        --moduleResolution "$resolution" --skipLibCheck false "$scratch/types.$ending"
done

examples=$place/examples
mkdir -p "$examples" && cp npm/examples/* "$examples"
npm_has "$examples" examples || exit $cases_failed
ln -sfn ../../wiggly "$examples/node_modules/wiggly"
bundle() { (cd "$examples" && node node_modules/esbuild/bin/esbuild "$@" --bundle --log-level=warning); }
packed=$(bundle "$WIGGLY_NPM/index.js" --minify --format=esm | gzip -9 | wc -c)
echo "  what a page loads: $packed bytes gzipped"
holds "at most 6 kB are loaded" [ "$packed" -le 6000 ]
holds "nothing where nothing is used" [ "$(bundle --format=esm <<<"import { spring } from 'wiggly'" | grep -c function)" -eq 0 ]
cp npm/compare.mjs "$examples"
expect 0 "from one value to another it is Motion's spring and react-spring's; those of others are measured beside it" bash -c "cd '$examples' && node compare.mjs"
holds "and the page has all of them, with their sizes" [ -n "$out" -a -z "$(cut -d'|' -f2,6 <<<"$out" | grep -vxFf <(cut -d'|' -f2,6 npm/README.md))" ]
expect 0 "the examples are bundled" bash -c "cd '$examples' && node node_modules/esbuild/bin/$(node -p 'require("./npm/examples/package.json").scripts.start.replace(/--servedir=./, "--log-level=warning")')"
holds "of the versions that tools/npm/fetched.txt names" node -e '
    const named = require("fs").readFileSync("tools/npm/fetched.txt", "utf8"), { dependencies } = require("./npm/examples/package.json")
    process.exit(+!Object.entries(dependencies).every(([name, version]) => name === "wiggly" || named.includes(`${name} ${version} `)))'

PYTHONPATH=tests/web python3 -c 'import sys, chromium; sys.exit(not chromium.find())' || { echo "skip - chromium is not installed"; exit $cases_failed; }
timeout 800 python3 npm/tests/pages.py "$examples"
ok "the pages were looked at in Chromium" $?
