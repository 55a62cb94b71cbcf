// The program under Node: node node.js WIGGLY.JS [command] [option]..., in this folder.
const [, , build, ...line] = process.argv
const here = ({ FS }) => {
  FS.mkdir('/here')
  FS.mount(FS.filesystems.NODEFS, { root: '/' }, '/here')
  FS.chdir(`/here${process.cwd()}`)
}
require(build)({ print: console.log, printErr: console.error, preRun: [here] }).then(app => { process.exitCode = app.callMain(line) })
