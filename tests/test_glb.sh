# The Khronos validator on a character that wiggly analyze wrote, and on the dog: no error, no warning. The validator comes from npm at a pinned
# version into the build folder; where there is no npm or no network they are skipped.
. tests/check.sh
. tests/box.sh
validator=gltf-validator@2.0.0-dev.3.10
folder=${B:-build}/gltf-validator

skip() { # <why>
    echo "skip - $1"
    exit 0
}
command -v node >/dev/null && command -v npm >/dev/null || skip "there is no npm, so no glTF validator"
if [ ! -e "$folder/node_modules/gltf-validator/package.json" ]; then
    mkdir -p "$folder"
    timeout 60 npm install --silent --no-audit --no-fund --no-save --prefix "$folder" "$validator" >"$scratch/npm" 2>&1 ||
        skip "npm could not fetch $validator"
fi

# A box with colours, shaken.
write_box "$scratch/plain.obj"
sed -e 's/^v 0 0 0$/& 1 0.5 0/' -e 's/^v 0 2 0$/& 0.2 0.1 0/' "$scratch/plain.obj" >"$scratch/box.obj"
expect 0 "simulate" "$WIGGLY" simulate "$scratch/box.obj" --tets 60 --seconds 1 --substeps 2 -o "$scratch/up.npy"
expect 0 "analyze" "$WIGGLY" analyze "$scratch/up.npy" --rest "$scratch/box.obj" --fps 24 --modes 2 -o "$scratch/box.glb"
cat >"$scratch/validate.js" <<'END'
const [folder, file] = process.argv.slice(2);
const validator = require(require('path').resolve(folder, 'node_modules/gltf-validator'));
validator.validateBytes(new Uint8Array(require('fs').readFileSync(file))).then((report) => {
  for (const message of report.issues.messages) console.log(message.code, message.pointer, message.message);
  console.log(report.issues.numErrors + ' errors, ' + report.issues.numWarnings + ' warnings; ' +
    report.info.totalVertexCount + ' vertices, morph targets: ' + report.info.hasMorphTargets);
});
END
expect 0 "the validator reads it" node "$scratch/validate.js" "$folder" "$scratch/box.glb"
says "without a complaint" "0 errors, 0 warnings; 8 vertices, morph targets: true" "$out"
expect 0 "it reads the dog of the tree" node "$scratch/validate.js" "$folder" assets/models/dog.glb
says "without a complaint" "0 errors, 0 warnings; " "$out"
