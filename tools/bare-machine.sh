#!/bin/sh
# Runs a command on this tree in a system that has only make, to test a newcomer's first command.
# Usage: tools/bare-machine.sh <bookworm | trixie | jammy | noble> <command>...   as root, e.g. tools/bare-machine.sh noble make test
# debootstrap makes the bare system once, in build/bare/SUITE.tar. Each run unpacks it and removes the copy.
# BARE_OUT=FOLDER keeps the command's build folder. Exits with the command's status.
set -eu
[ $# -ge 2 ] || { sed -n '2,5s/^# //p' "$0" >&2; exit 2; }
suite=$1
shift
cd "$(dirname "$0")/.."

case $suite in
bookworm | trixie) components=main script="" ;;
# Debian's debootstrap may not know the suite; all Ubuntu suites share one script.
jammy | noble) components=main,universe script=/usr/share/debootstrap/scripts/gutsy ;;
*)
    echo "bare-machine: unknown suite '$suite'; expected bookworm, trixie, jammy or noble" >&2
    exit 2
    ;;
esac
[ "$(id -u)" = 0 ] || { echo "bare-machine: a system in a folder needs root" >&2; exit 3; }
tools/install-missing.sh bare

mkdir -p build/bare
base=build/bare/$suite.tar
root=$(mktemp -d "$PWD/build/bare/$suite.XXXXXX")
trap 'rm -rf "$root"' EXIT INT TERM
if [ ! -s "$base" ]; then
    # the suite's default mirror, which debootstrap uses by itself only for Debian
    mirror=""
    [ -z "$script" ] || mirror=$(sed -n 's/.*default_mirror \(.*archive.*\)/\1/p' "$script" | head -n 1)
    # shellcheck disable=SC2086 # script may be empty
    debootstrap --variant=minbase --include=make --components="$components" "$suite" "$root" "$mirror" $script \
        >"build/bare/$suite.log" 2>&1 || {
        tail -n 5 "build/bare/$suite.log" >&2
        echo "bare-machine: debootstrap could not make $suite; all it said is in build/bare/$suite.log" >&2
        exit 3
    }
    rm -rf "$root"/var/cache/apt/archives/*.deb
    tar -C "$root" -cf "$base.new" .
    mv "$base.new" "$base"
else
    tar -C "$root" -xf "$base"
fi

chmod 755 "$root" # mktemp keeps it from everybody else, who live there too
mkdir "$root/wiggly"
# Root may run it in another user's clone.
git -c safe.directory='*' ls-files -z --cached --others --exclude-standard | tar --null -T - -cf - | tar -C "$root/wiggly" -xf -
cp /etc/resolv.conf "$root/etc/resolv.conf"

started=$(date +%s)
status=0
# Mounts and processes end with the run's namespaces.
# shellcheck disable=SC2016 # expanded inside
unshare --mount --pid --fork sh -c '
    root=$1
    shift
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    exec chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin \
        sh -c "cd /wiggly && exec \"\$@\"" sh "$@"
' sh "$root" "$@" </dev/null || status=$?
echo "bare-machine: $suite, $*: exit status $status after $(($(date +%s) - started)) s"
if [ -n "${BARE_OUT:-}" ] && [ -d "$root/wiggly/build" ]; then
    rm -rf "$BARE_OUT"
    cp -r "$root/wiggly/build" "$BARE_OUT"
fi
exit $status
