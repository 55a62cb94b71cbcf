// What the Khronos validator says of glTF files. Usage: node validate.js FOLDER-WITH-node_modules file...
const [folder, ...files] = process.argv.slice(2);
const validator = require(require('path').resolve(folder, 'node_modules/gltf-validator'));
(async () => {
  for (const file of files) {
    const report = await validator.validateBytes(new Uint8Array(require('fs').readFileSync(file)));
    const issues = report.issues;
    for (const message of issues.messages) console.log(message.code, message.pointer, message.message);
    console.log(`${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings, ${issues.numInfos} infos, ${issues.numHints} hints`);
  }
})();
