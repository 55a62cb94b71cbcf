# tools/check-arrows.sh and check-lengths.sh must fail where the house is broken; a check that cannot fail proves nothing.
. tests/check.sh

expect 0 "the tree itself follows the arrows" tools/check-arrows.sh

refuses() { # <file of src> <include line> <what it must say>
    local tree=$scratch/tree
    rm -rf "$tree"
    mkdir -p "$tree/include/wiggly" "$tree/src/$(dirname "$1")"
    echo '#include <stddef.h>' >"$tree/include/wiggly/wiggly.h"
    echo "$2" >"$tree/src/$1"
    expect 1 "$1 must not have $2" tools/check-arrows.sh "$tree"
    says "and the reason names the file" "src/$1:1: $3" "$out"
}

refuses spline/a.c '#include "scene/document.h"' "spline must not include scene/document.h"
refuses spline/a.c '#include <stdio.h>' "the spline core does no I/O"
refuses editor/a.c '#include "draw/draw.h"' "editor must not include draw/draw.h"
refuses draw/a.c '#include "editor/editor.h"' "draw must not include editor/editor.h"
refuses draw/a.c '#include <epoxy/gl.h>' "src/draw reaches GL through draw/gl.h alone"
refuses editor/a.c '#include <GLFW/glfw3.h>' "GLFW/glfw3.h belongs in src/draw and src/platform alone"
refuses model/a.c '#include <jansson.h>' "jansson.h belongs in src/scene and the .glb files of src/model alone"
refuses base/a.c '#include "error.h"' '"error.h" must be written with its folder'
refuses misc/a.c '#include "base/error.h"' "src/misc is not a room of the house"

{
    echo 'void long_one(void)'
    echo '{'
    for _ in $(seq 79); do echo '    ;'; done
    echo '}'
} >"$scratch/long.c"
expect 1 "a function of 81 lines is refused" tools/check-lengths.sh "$scratch/long.c"
seq 601 >"$scratch/long.h"
expect 1 "a file of 601 lines is refused" tools/check-lengths.sh "$scratch/long.h"
exit $((cases_failed > 0))
