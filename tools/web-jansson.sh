#!/bin/sh
# Fetches the source of Debian's jansson, which Emscripten compiles, into FOLDER, with Debian's patches. apt-get checks what it gets, with
# lists of sources of its own: the system's stay as they are. Sources other than those that were reviewed are refused.
# Usage: tools/web-jansson.sh FOLDER
set -eu
export LC_ALL=C
reviewed=4b7f17dca9e33ecb7c42cbad6dac0fc731d44776acddc6449d2b59dc1eb8c66d # SHA-256 of 2.14's, with Debian's patch
folder=$1
work=$folder.new
lists=$work/lists
rm -rf "$work"
mkdir -p "$lists/partial" "$work/parts" "$work/cache/archives/partial"

# The system's own sources, as sources of source packages.
for file in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
    [ -f "$file" ] || continue
    case $file in
    *.list) sed -n 's/^ *deb \(.*\)$/deb-src \1/p' "$file" >"$work/parts/${file##*/}" ;;
    *.sources) sed 's/^Types:.*/Types: deb-src/; s/^Components:.* main\( .*\)*$/Components: main/' "$file" >"$work/parts/${file##*/}" ;;
    esac
done

apt() {
    apt-get -qq -o Dir::Etc::sourcelist=/dev/null -o Dir::Etc::sourceparts="$work/parts" -o Dir::State::lists="$lists" \
        -o Dir::Cache="$work/cache" -o APT::Sandbox::User=root -o Acquire::Languages=none "$@"
}

fetch() { # other people's archives may have no sources: what counts is whether jansson is there
    command -v apt-get >/dev/null || { echo "there is no apt-get" && return 1; }
    apt update 2>&1 || true
    (cd "$work" && apt source --download-only jansson 2>&1)
}

work=$(cd "$work" && pwd)
lists=$work/lists
said=$(fetch) || {
    echo "wiggly needs the source of jansson, and apt-get could not fetch it: $(echo "$said" | grep '^[EW]: ' | head -n 1)" >&2
    echo "Or name its folder: make web JANSSON=path/to/jansson" >&2
    rm -rf "$work"
    exit 3
}
mkdir "$work/source"
tar -xf "$work"/jansson_*.orig.tar.* -C "$work/source" --strip-components=1
tar -xf "$work"/jansson_*.debian.tar.* -C "$work/source"
for patch in $(sed 's/[ #].*//' "$work/source/debian/patches/series" 2>/dev/null); do
    patch -s -p1 -d "$work/source" <"$work/source/debian/patches/$patch"
done
got=$(cat "$work"/source/src/*.[ch] "$work/source/src/jansson_config.h.in" | sha256sum | cut -d ' ' -f 1)
[ "$got" = "$reviewed" ] || {
    echo "the source of jansson is another one than was reviewed: expected SHA-256 $reviewed, got $got. Name a folder: make web JANSSON=path/to/jansson" >&2
    rm -rf "$work"
    exit 3
}
rm -rf "$folder"
mv "$work/source" "$folder"
rm -rf "$work"
