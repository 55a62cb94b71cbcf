#!/bin/sh
# Proves that includes follow the arrows of the house: each folder of src/ sees only the folders listed here, GL stays in
# draw and platform, JSON in scene and the glTF files of model, and the spline core does no I/O. Usage: tools/check-arrows.sh [root of the tree]
set -eu
cd "${1:-.}"
grep -rnE '^[[:space:]]*#[[:space:]]*include' --include='*.[ch]' src include | awk '
BEGIN {
    sees["base"]     = "base"
    sees["spline"]   = "spline"
    sees["model"]    = "model base"
    sees["simulation"] = "simulation model base"
    sees["scene"]    = "scene spline base"
    sees["rig"]      = "rig scene model spline base"
    sees["ui"]       = "ui rig scene model spline base"
    sees["editor"]   = "editor ui rig scene model spline base"
    sees["draw"]     = "draw ui model base"
    sees["platform"] = "platform ui rig scene model spline base"
    sees["timing"]   = "timing ui rig scene model spline base"
    sees["analysis"] = "analysis model base"
    sees["app"]      = "app editor draw platform timing ui rig scene model spline base"
    sees["commands"] = "commands simulation analysis " sees["app"]
    sees["main"]     = "commands base"
    sees["include"]  = ""
}
function complain(what) {
    printf "%s:%s: %s\n", file, line, what
    bad = 1
}
{
    split($0, part, ":")
    file = part[1]; line = part[2]
    split(file, folder, "/")
    room = file == "src/main.c" ? "main" : folder[1] == "include" ? "include" : folder[2]
    header = $0
    sub(/^[^"<]*["<]/, "", header)
    sub(/[">].*$/, "", header)
    if (!(room in sees)) {
        complain("src/" room " is not a room of the house (tools/check-arrows.sh lists them)")
    } else if ($0 ~ /include[[:space:]]*"/) {
        if (header !~ /\//) complain("\"" header "\" must be written with its folder")
        split(header, target, "/")
        if (index(" " sees[room] " ", " " target[1] " ") == 0) complain(room " must not include " header)
    }
    if (header ~ /^(epoxy|GL|GLES[0-9]*|EGL|GLFW)\// && room != "draw" && room != "platform")
        complain(header " belongs in src/draw and src/platform alone")
    if (header ~ /^(epoxy|GL)\// && room == "draw" && file != "src/draw/gl.h")
        complain("src/draw reaches GL through draw/gl.h alone")
    if (header ~ /^jansson/ && room != "scene" && file !~ /^src\/model\/glb/)
        complain(header " belongs in src/scene and the .glb files of src/model alone")
    if (header ~ /^(stdio|unistd|fcntl)\.h$/ && room == "spline") complain("the spline core does no I/O: " header)
}
END { exit bad }'
