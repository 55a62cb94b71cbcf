#!/bin/sh
# Installs missing Debian packages of the named sets. Quick and silent if nothing is missing.
# "a|b": a, or b if the system has no a. "a|": optional, never installed alone, so that a build without it stays quiet.
# Usage: tools/install-missing.sh [build] [test] [bench] [check] [clang] [web] [bare] [whole]
set -eu

packages_of() {
    case $1 in
    build) echo gcc libc6-dev pkg-config libglfw3-dev libepoxy-dev libegl-dev libcglm-dev libjansson-dev libstb-dev \
        fontconfig fonts-inter "fonts-jetbrains-mono|fonts-dejavu-core" libegl1 libgl1-mesa-dri \
        "g++|" "libdraco-dev|" "libmeshoptimizer-dev|" ;;
    test) echo g++ liblapacke-dev libopenblas-dev libcmocka-dev xvfb x11-xkb-utils xdotool imagemagick ;;
    bench) echo liblapacke-dev libopenblas-dev ;;
    check) echo clang-format-14 cppcheck ;;
    clang) echo clang "libclang-rt-dev|libclang-rt-14-dev" ;; # with its sanitizers and its fuzzer
    web) echo emscripten nodejs brotli python3-fonttools patch xz-utils pkg-config libcglm-dev libstb-dev fontconfig fonts-inter \
        "fonts-jetbrains-mono|fonts-dejavu-core" ;;
    bare) echo debootstrap ;;
    whole) # what parts of the suite are skipped without; Debian's npm, with hundreds of packages, only where there is no other
        echo ffmpeg weston cmake assimp-testmodels assimp-utils libdraco-dev libmeshoptimizer-dev gcc-mingw-w64-x86-64 gcc-aarch64-linux-gnu libc6-dev-arm64-cross \
            qemu-user brotli "minetest-data|" "minetest-mod-maidroid|" "chromium|" "firefox-esr|" "$(command -v npm >/dev/null || echo nodejs npm)" ;;
    *)
        echo "install-missing.sh: unknown set '$1'; the sets are build, test, bench, check, clang, web, bare and whole" >&2
        exit 2
        ;;
    esac
}

# Other systems name packages differently; check that these commands and pkg-config modules work.
probes_of() {
    case $1 in
    build) echo gcc pkg-config fc-match glfw3.pc epoxy.pc egl.pc cglm.pc jansson.pc stb.pc ;;
    test) echo g++ Xvfb setxkbmap xdotool convert cmocka.pc lapacke.pc openblas.pc ;;
    bench) echo lapacke.pc openblas.pc ;;
    check) echo clang-format-14 cppcheck ;;
    clang) echo clang ;;
    web) echo emcc node python3 patch xz pkg-config fc-match cglm.pc stb.pc ;;
    bare) echo debootstrap ;;
    whole) echo ffmpeg weston cmake x86_64-w64-mingw32-gcc aarch64-linux-gnu-gcc qemu-aarch64 npm ;;
    esac
}

probe() {
    case $1 in
    *.pc) pkg-config --exists "${1%.pc}" 2>/dev/null ;;
    *) command -v "$1" >/dev/null ;;
    esac
}

wanted=""
for set in "$@"; do wanted="$wanted $(packages_of "$set")"; done
[ -n "$wanted" ] || exit 0

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    missing=""
    for set in "$@"; do
        for item in $(probes_of "$set"); do probe "$item" || missing="$missing ${item%.pc}"; done
    done
    [ -z "$missing" ] && exit 0
    echo "wiggly needs:$missing" >&2
    echo "This system has no apt-get; install the counterparts of these Debian packages:$wanted" >&2
    exit 3
fi

names=""
for choice in $wanted; do names="$names ${choice%|*} ${choice#*|}"; done
# shellcheck disable=SC2086 # the list is split on purpose
installed=" $(dpkg-query -W -f '${Package} ${db:Status-Status} ' $names 2>/dev/null || true)"
missing=""
besides=""
for choice in $wanted; do
    there=""
    for package in "${choice%|*}" "${choice#*|}"; do
        case "$installed" in *" $package installed "*) there=yes ;; esac
    done
    case $there$choice in yes*) ;; *"|") besides="$besides $choice" ;; *) missing="$missing $choice" ;; esac
done
[ -z "$missing" ] && exit 0

# The first available package of each choice, else the last.
chosen() {
    for choice in $missing $besides; do
        for package in "${choice%|*}" "${choice#*|}"; do
            apt-cache show "$package" >/dev/null 2>&1 && break
        done
        echo "$package"
    done
}

if [ "$(id -u)" = 0 ]; then
    as_root="env"
elif command -v sudo >/dev/null; then
    as_root="sudo env"
else
    echo "wiggly needs packages that only root can install; run this as root: apt-get install$missing" >&2
    exit 3
fi

quietly="DEBIAN_FRONTEND=noninteractive"
# Another apt may be at work: this one waits its turn, ten minutes at most.
install() { # shellcheck disable=SC2046,SC2086
    $as_root $quietly apt-get install -y -qq -o DPkg::Lock::Timeout=600 --no-install-recommends $(chosen) >/dev/null
}
echo "Installing:" $missing
# A fresh system has no package lists yet.
if ! install 2>/dev/null; then
    $as_root $quietly apt-get update -qq -o DPkg::Lock::Timeout=600 || true # the installation says what is wrong
    install || {
        echo "apt-get could not install:" $missing >&2
        exit 3
    }
fi
