#!/bin/sh
# Checks that includes, headers' own ones too, follow the directions listed here. GL stays in draw and platform, JSON in scene, the glTF
# files of model and export, app/settings.c and commands/companion.c; cglm is included through model/vector.h; the spline core does no I/O. In the editor
# a panel may include core and itself, core no panel, and the editor's own files only the panels' interfaces (curves/curves.h).
# Usage: tools/check-arrows.sh [root of the tree]
set -eu
cd "${1:-.}"
grep -rnE '^[[:space:]]*#[[:space:]]*include' --include='*.[ch]' src include | awk '
BEGIN {
    sees["include"]  = "include"
    sees["base"]     = "base maths include"
    sees["maths"]    = "maths"
    sees["spline"]   = "spline maths include"
    sees["model"]    = "model maths base"
    sees["simulation"] = "simulation model maths base"
    sees["scene"]    = "scene spline maths base include"
    sees["rig"]      = "rig scene model spline maths base include"
    sees["export"]   = "export rig scene model spline maths base include"
    sees["ui"]       = "ui model maths base"
    sees["editor"]   = "editor ui export rig scene model spline maths base include"
    sees["draw"]     = "draw ui model maths base"
    sees["platform"] = "platform ui model base"
    sees["timing"]   = "timing base maths include"
    sees["analysis"] = "analysis model spline maths base include"
    sees["app"]      = "app draw platform timing " sees["editor"]
    sees["commands"] = "commands simulation analysis " sees["app"]
    sees["main"]     = "commands base include"
}
function room_of(file,    folder) {
    split(file, folder, "/")
    return file == "src/main.c" ? "main" : folder[1] == "include" ? "include" : folder[2]
}
function short(header) { return substr(header, index(header, "/") + 1) }
function complain(what) {
    printf "%s:%s: %s\n", file, line, what
    bad = 1
}
# Why a file must not include a header, directly or indirectly; empty if it may.
function reason(file, header,    room) {
    room = room_of(file)
    if (header ~ /^(src|include)\//)
        return index(" " sees[room] " ", " " room_of(header) " ") ? "" : room " must not include " short(header)
    if (header ~ /^(epoxy|GL|GLES[0-9]*|EGL|GLFW)\// && room != "draw" && room != "platform")
        return header " belongs in src/draw and src/platform alone"
    if (header ~ /^jansson/ && room != "scene" && file !~ /^src\/(model\/gl(b|tf)|export\/gltf|base\/json|app\/settings|commands\/companion)/)
        return header " belongs in src/scene, src/base/json.h, src/app/settings.c, src/commands/companion.c and the glTF files of src/model and src/export alone"
    if (header ~ /^(stdio|unistd|fcntl)\.h$/ && room == "spline") return "the spline core does no I/O: " header
    return ""
}
# The part of the editor that a file belongs to: core, a panel, or "" for the editor itself.
function part_of(file,    folder, depth) {
    depth = split(file, folder, "/")
    return file ~ /^src\/editor\// && depth > 3 ? folder[3] : ""
}
# Why the rules of the editor forbid an include.
function wall(file, header,    from, to) {
    if (header !~ /^src\/editor\//) return ""
    from = part_of(file)
    to = part_of(header)
    if (header == "src/editor/editor.h") return ""
    if (file !~ /^src\/editor\//) return room_of(file) " must not include " short(header) ": the editor is reached through editor/editor.h"
    if (from != "" && to != from && to != "core") return "editor/" from " must not include " short(header)
    if (from == "" && to != "" && to != "core" && header != "src/editor/" to "/" to ".h")
        return short(header) " is private to editor/" to ": the way in is editor/" to "/" to ".h"
    return ""
}
# Why the includes of a header are forbidden, unless the check of its own folder says so.
function reason_through(file, header,    queue, count, next_one, seen, i, why) {
    queue[count = 1] = header
    for (next_one = 1; next_one <= count; next_one++) {
        for (i = 1; i <= includes[queue[next_one]]; i++) {
            found = included[queue[next_one], i]
            if (found in seen) continue
            seen[found] = 1
            queue[++count] = found
            why = reason(file, found)
            if (why != "" && (room_of(header) != room_of(file) || reason(header, found) == "")) return why
        }
    }
    return ""
}
{
    split($0, part, ":")
    file = part[1]; line = part[2]
    header = $0
    sub(/^[^"<]*["<]/, "", header)
    sub(/[">].*$/, "", header)
    if (!(room_of(file) in sees)) {
        complain("src/" room_of(file) " is not a room of the house (tools/check-arrows.sh lists them)")
        next
    }
    own = $0 ~ /include[[:space:]]*"/
    if (own && header !~ /\//) complain("\"" header "\" must be written with its folder")
    if (header ~ /^(epoxy|GL)\// && room_of(file) == "draw" && file != "src/draw/gl.h")
        complain("src/draw reaches GL through draw/gl.h alone")
    if (header ~ /^cglm\// && file != "src/model/vector.h") complain("cglm comes through model/vector.h")
    if (own) header = "src/" header
    if (header ~ /^wiggly\//) header = "include/" header
    if (!(file in includes)) files[++file_count] = file
    included[file, ++includes[file]] = header
    place[file, includes[file]] = line
}
END {
    for (f = 1; f <= file_count; f++) {
        file = files[f]
        for (n = 1; n <= includes[file]; n++) {
            line = place[file, n]
            header = included[file, n]
            why = reason(file, header)
            if (why == "") why = wall(file, header)
            if (why != "") complain(why)
            else if ((why = reason_through(file, header)) != "") complain(why " (through " short(header) ")")
        }
    }
    exit bad
}'
