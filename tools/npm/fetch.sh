#!/bin/sh
# Installs groups of fetched.txt into FOLDER/node_modules, unless they are there: fetch.sh FOLDER GROUP... One sentence says what went wrong;
# the exit status is 3 if a package is another one than the list names. No script of a package runs.
set -eu
list=$(dirname "$0")/fetched.txt
mkdir -p "$1"
folder=$1
shift
node -e '
    const [list, folder, ...groups] = process.argv.slice(1), fs = require("fs"), packages = {}, dependencies = {}
    for (const line of fs.readFileSync(list, "utf8").split("\n")) {
        const [name, version, integrity, , ...its] = line.split(" ")
        if (name === "#" || !its.some(group => groups.includes(group))) continue
        packages[`node_modules/${name}`] = { version, integrity }
        dependencies[name] = version
    }
    const write = (name, what) => fs.writeFileSync(`${folder}/${name}`, JSON.stringify(what))
    write("package.json", { private: true, dependencies })
    write("package-lock.json", { lockfileVersion: 3, packages: { "": { dependencies }, ...packages } })
' "$list" "$folder" "$@"
cmp -s "$folder/package-lock.json" "$folder/fetched.json" && exit 0
said=$(cd "$folder" && npm ci --ignore-scripts --legacy-peer-deps --no-audit --no-fund 2>&1) && exec cp "$folder/package-lock.json" "$folder/fetched.json"
case $said in
*EINTEGRITY*)
    echo "npm sent another package than tools/npm/fetched.txt names: expected $(echo "$said" | grep -o 'sha512-.*' | head -n 1)" >&2
    exit 3 ;;
esac
echo "npm could not fetch $*: $(echo "$said" | head -n 1)" >&2
exit 1
