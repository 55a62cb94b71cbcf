# Whose a scene is: those that belong to the running binary open as untitled, by whatever path; all others under their own names.
. tests/check.sh
unset DISPLAY WAYLAND_DISPLAY

mkdir -p "$scratch"/tree/build "$scratch"/tree/assets "$scratch"/usr/bin "$scratch"/usr/share/wiggly "$scratch"/own/assets
cp "$WIGGLY" "$scratch/tree/build/wiggly"
cp "$WIGGLY" "$scratch/usr/bin/wiggly"
for folder in tree/assets usr/share/wiggly usr/assets own/assets own/share/wiggly; do
    mkdir -p "$scratch/$folder/scenes"
    cp assets/scenes/tail.json "$scratch/$folder/scenes/mine.json"
done
ln -s ../tree/assets/scenes/mine.json "$scratch/own/link.json"
ln -s ../tree/assets "$scratch/own/elsewhere"
cp assets/scenes/tail.json "$scratch/own/linked.json"
ln -s ../../../own/linked.json "$scratch/tree/assets/scenes/link.json"
cd "$scratch" || exit 1

# Opens a scene, sets a knot and presses Ctrl+S: without a question, the replay has saved something afterwards.
edit() { # <wiggly> <scene>
    "$1" live --no-draw --size 640x360 --frames 1 --record header "$2" || return
    { sed '/^frames/d' header; printf '%s\n' "frames 20" "5 key Right" "6 key I" "9 key S ctrl"; } >edit.replay
    "$1" live --no-draw --replay edit.replay --saves saves "$2"
}

is() { # <saved or untitled> <what> <wiggly> <scene>
    local wanted=$1 what=$2 found=untitled
    rm -rf saves
    expect 0 "$what opens" edit "$3" "$4"
    [ ! -e "saves/${4##*/}" ] || found=saved
    holds "$what: $wanted" [ $found = "$wanted" ]
}

is untitled "a scene of the tree's" tree/build/wiggly tree/assets/scenes/mine.json
is untitled "one by a link to it" tree/build/wiggly own/link.json
is untitled "one through a link to its folder" tree/build/wiggly own/elsewhere/scenes/mine.json
is untitled "a scene of the installation's" usr/bin/wiggly usr/share/wiggly/scenes/mine.json
is saved "a user's scene in a folder assets/scenes" tree/build/wiggly own/assets/scenes/mine.json
is saved "one in a folder share/wiggly/scenes" tree/build/wiggly own/share/wiggly/scenes/mine.json
is saved "one beside an installation" usr/bin/wiggly usr/assets/scenes/mine.json
is saved "a user's scene by a link among the tree's" tree/build/wiggly tree/assets/scenes/link.json
