#!/bin/sh
# Installs the Debian packages that the named sets need and that are not there. Fast and silent when nothing is missing.
# Usage: tools/install-missing.sh [build] [test] [bench] [check]
set -eu

packages_of() {
    case $1 in
    build) echo gcc libc6-dev pkg-config libglfw3-dev libepoxy-dev libegl-dev libcglm-dev libjansson-dev libstb-dev \
        fontconfig fonts-inter fonts-jetbrains-mono libegl1 libgl1-mesa-dri ;;
    test) echo g++ liblapacke-dev libopenblas-dev libcmocka-dev xvfb xdotool imagemagick ;;
    bench) echo liblapacke-dev libopenblas-dev ;;
    check) echo clang-format-14 cppcheck ;;
    *)
        echo "install-missing.sh: unknown set '$1'; the sets are build, test, bench and check" >&2
        exit 2
        ;;
    esac
}

# On other systems the packages have other names; these are commands and pkg-config modules that must answer.
probes_of() {
    case $1 in
    build) echo gcc pkg-config fc-match glfw3.pc epoxy.pc egl.pc cglm.pc jansson.pc stb.pc ;;
    test) echo g++ Xvfb xdotool convert cmocka.pc lapacke.pc openblas.pc ;;
    bench) echo lapacke.pc openblas.pc ;;
    check) echo clang-format-14 cppcheck ;;
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

# shellcheck disable=SC2086 # the list is split on purpose
installed=$(dpkg-query -W -f '${Package} ${db:Status-Status} \n' $wanted 2>/dev/null || true)
missing=""
for package in $wanted; do
    case "$installed" in
    *"$package installed "*) ;;
    *) missing="$missing $package" ;;
    esac
done
[ -z "$missing" ] && exit 0

if [ "$(id -u)" = 0 ]; then
    as_root="env"
elif command -v sudo >/dev/null; then
    as_root="sudo env"
else
    echo "wiggly needs packages that only root can install; run this as root: apt-get install$missing" >&2
    exit 3
fi

echo "Installing:$missing"
quietly="DEBIAN_FRONTEND=noninteractive"
# shellcheck disable=SC2086
if ! $as_root $quietly apt-get install -y -qq --no-install-recommends $missing >/dev/null 2>&1; then
    $as_root $quietly apt-get update -qq || true # the installation says what is wrong
    $as_root $quietly apt-get install -y -qq --no-install-recommends $missing >/dev/null || {
        echo "apt-get could not install:$missing" >&2
        exit 3
    }
fi
