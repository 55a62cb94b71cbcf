// Runs the program under Node, in this folder, once for each line of standard input: node node.js WIGGLY.JS <command lines
const fs = require('fs')
const build = process.argv[2], create = require(build), code = new WebAssembly.Module(fs.readFileSync(build.replace(/js$/, 'wasm')))

const here = ({ FS }) => {
  FS.mkdir('/here')
  FS.mount(FS.filesystems.NODEFS, { root: '/' }, '/here')
  FS.chdir(`/here${process.cwd()}`)
}
process.setMaxListeners(0) // each run adds some
const instantiateWasm = (imports, done) => done(new WebAssembly.Instance(code, imports)) ?? {}

async function main() {
  for (const line of fs.readFileSync(0, 'utf8').trim().split('\n')) {
    const app = await create({ print() {}, printErr: console.error, preRun: [here], instantiateWasm })
    app.callMain(line.split(' '))
  }
}
main()
