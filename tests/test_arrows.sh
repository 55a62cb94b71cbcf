# tools/check-arrows.sh, check-circles.sh and check-lengths.sh must fail where the house is broken; a check that cannot fail proves nothing.
. tests/check.sh

expect 0 "the tree itself follows the arrows" tools/check-arrows.sh

tree=$scratch/tree
plant() { # <file of src> <its only line>... into an empty tree
    rm -rf "$tree"
    mkdir -p "$tree/include/wiggly"
    echo '#include <stddef.h>' >"$tree/include/wiggly/wiggly.h"
    while [ $# -gt 0 ]; do
        mkdir -p "$tree/src/$(dirname "$1")"
        echo "$2" >"$tree/src/$1"
        shift 2
    done
}

refuses() { # <file of src> <include line> <what it must say>
    plant "$1" "$2"
    expect 1 "$1 must not have $2" tools/check-arrows.sh "$tree"
    says "and the reason names the file" "src/$1:1: $3" "$out"
}

refuses_through() { # <file of src> <header of src> <include line of that header> <what it must say>
    plant "$1" "#include \"$2\"" "$2" "$3"
    expect 1 "$1 must not get $3 through $2" tools/check-arrows.sh "$tree"
    says "and the reason names the header" "src/$1:1: $4 (through $2)" "$out"
}

refuses spline/a.c '#include "scene/document.h"' "spline must not include scene/document.h"
refuses spline/a.c '#include <stdio.h>' "the spline core does no I/O"
refuses editor/a.c '#include "draw/draw.h"' "editor must not include draw/draw.h"
refuses draw/a.c '#include "editor/editor.h"' "draw must not include editor/editor.h"
refuses draw/a.c '#include <epoxy/gl.h>' "src/draw reaches GL through draw/gl.h alone"
refuses editor/a.c '#include <GLFW/glfw3.h>' "GLFW/glfw3.h belongs in src/draw and src/platform alone"
refuses model/a.c '#include <jansson.h>' "jansson.h belongs in src/scene, src/base/json.h, src/app/settings.c, src/commands/companion.c and the glTF files of src/model and src/export alone"
refuses base/a.c '#include "error.h"' '"error.h" must be written with its folder'
refuses rig/a.c '#include <cglm/vec3.h>' "cglm comes through model/vector.h"
refuses_through draw/a.c ui/stage.h '#include "rig/posing.h"' "draw must not include rig/posing.h"
refuses_through commands/a.c model/glb.h '#include <jansson.h>' "jansson.h belongs in src/scene, src/base/json.h, src/app/settings.c, src/commands/companion.c and the glTF files of src/model and src/export alone"
refuses_through model/a.c model/glb.h '#include <jansson.h>' "jansson.h belongs in src/scene, src/base/json.h, src/app/settings.c, src/commands/companion.c and the glTF files of src/model and src/export alone"
refuses_through app/a.c draw/gl.h '#include <epoxy/gl.h>' "epoxy/gl.h belongs in src/draw and src/platform alone"
refuses_through model/a.c base/status.h '#include <wiggly/wiggly.h>' "model must not include wiggly/wiggly.h"
plant draw/a.c '#include "ui/stage.h"' ui/stage.h '#include "model/fox.h"' model/fox.h '#include "base/error.h"'
expect 0 "what follows the arrows through three headers is fine" tools/check-arrows.sh "$tree"

# The editor's walls: a panel sees core and itself, core no panel, the editor's own files the panels' doors alone.
refuses editor/curves/a.c '#include "editor/stage/stage.h"' "editor/curves must not include editor/stage/stage.h"
refuses editor/core/a.c '#include "editor/curves/curves.h"' "editor/core must not include editor/curves/curves.h"
refuses editor/stage/a.c '#include "editor/state.h"' "editor/stage must not include editor/state.h"
refuses editor/a.c '#include "editor/curves/state.h"' "editor/curves/state.h is private to editor/curves: the way in is editor/curves/curves.h"
refuses app/a.c '#include "editor/core/state.h"' "app must not include editor/core/state.h"
plant editor/a.c '#include "editor/curves/curves.h"' editor/curves/b.c '#include "editor/core/state.h"' editor/stage/c.c '#include "editor/stage/state.h"'
expect 0 "doors, core and one's own room are open" tools/check-arrows.sh "$tree"
refuses misc/a.c '#include "base/error.h"' "src/misc is not a room of the house"

expect 0 "no circle of includes in the tree is larger than those that are known" tools/check-circles.sh
plant ui/a.c '#include "ui/b.h"' ui/b.c '#include "ui/c.h"' ui/c.c '#include "ui/a.h"'
expect 0 "three files may include each other in a circle" tools/check-circles.sh "$tree"
says "which is named" "3 files: ui/" "$out"
plant ui/a.c '#include "ui/b.h"' ui/b.h '#include "ui/c.h"' ui/c.c '#include "ui/d.h"' ui/d.h '#include "ui/a.h"' draw/a.c '#include "ui/a.h"'
expect 1 "four are refused" tools/check-circles.sh "$tree"
says "and named, without those that only look in" "src: 4 files include each other in a circle: " "$out"

{
    echo 'void long_one(void)'
    echo '{'
    for _ in $(seq 119); do echo '    ;'; done
    echo '}'
} >"$scratch/long.c"
expect 1 "a function of 121 lines is refused" tools/check-lengths.sh "$scratch/long.c"
seq 1201 >"$scratch/long.h"
expect 1 "a file of 1,201 lines is refused" tools/check-lengths.sh "$scratch/long.h"
