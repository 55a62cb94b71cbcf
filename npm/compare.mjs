// Prints the table of README.md: node compare.mjs, in the examples' folder after npm install. A spring from 0 to 1, made and read for 60
// frames; 60 frames, each of which sends it to another value; its linear(); and what it adds to a page.
import { build } from 'esbuild'
import { gzipSync } from 'node:zlib'
import { spring as motionSpring } from 'motion'
import { spring as popmotionSpring } from 'popmotion'
import { Globals, SpringValue } from '@react-spring/web'
import { raf } from '@react-spring/rafz'
import wobble from 'wobble'
import { spring } from 'wiggly'

const frequency = 2, damping = 0.2, natural = 2 * Math.PI * frequency, config = { stiffness: natural ** 2, damping: 2 * damping * natural, mass: 1 }
const frames = Array.from({ length: 60 }, (_, i) => i), goal = (i, run) => Math.sin(i + run), both = { ...config, keyframes: [0, 1] }, keys = [[0, 0], [0.3, 1], [0.9, 0.3]]

/** Microseconds, the least of many runs. */
function least(run) {
  let best = Infinity
  for (let round = 0; round < 300; round++) {
    const begin = performance.now()
    for (let i = 0; i < 50; i++) run(i)
    best = Math.min(best, ((performance.now() - begin) / 50) * 1000)
  }
  return best.toFixed(1)
}

let now = 1, frame
Globals.assign({ now: () => now, requestAnimationFrame: () => 0 })
raf.now = Date.now = () => now
raf.frameLoop = 'demand'
globalThis.requestAnimationFrame = (run) => ((frame = run), 1)
globalThis.cancelAnimationFrame = () => {}
const reactStart = (x, to) => x.start({ to, config: { tension: config.stiffness, friction: config.damping, mass: 1 } })
const tick = (run) => { now += 1000 / 60; run() }
for (const [name, entry, read, retarget, easing] of [
  ['motion', "export { spring } from 'motion'",
    () => { const s = motionSpring(both); for (const i of frames) s.next(i * 16) },
    (run) => { const s = motionSpring(both); let value = 0; for (const i of frames) s.retarget([value, goal(i, run)], s.velocity(16)), (value = s.next(16).value) },
    () => motionSpring(both).toString()],
  ['popmotion', "export { spring } from 'popmotion'",
    () => { const s = popmotionSpring(config); for (const i of frames) s.next(i * 16) },
    (run) => { let from = 0, velocity = 0; for (const i of frames) { const s = popmotionSpring({ ...config, from, to: goal(i, run), velocity }), before = s.next(15).value; from = s.next(16).value; velocity = (from - before) * 1000 } }],
  ['react-spring', "export { SpringValue } from '@react-spring/web'",
    () => { const x = new SpringValue(0); reactStart(x, 1); for (const _ of frames) tick(raf.advance), x.get(); x.stop() },
    (run) => { const x = new SpringValue(0); for (const i of frames) reactStart(x, goal(i, run)), tick(raf.advance); x.stop() }],
  ['wobble', "export { Spring } from 'wobble'",
    () => { const s = new wobble.Spring(config).start(); for (const _ of frames) tick(frame), s.currentValue; s.stop() },
    (run) => { const s = new wobble.Spring(config).start(); for (const i of frames) s.updateConfig({ toValue: goal(i, run) }), tick(frame); s.stop() }],
  ['wiggly, from one value to another', "export { spring } from 'wiggly'",
    () => { const s = spring({ from: 0, to: 1, ...config }); for (const i of frames) s.at(i / 60) },
    (run) => { let s = spring({ from: 0, to: 1, ...config }); for (const i of frames) s = s.retarget(1 / 60, goal(i, run)) },
    () => spring({ from: 0, to: 1, ...config }).linear()],
  ['wiggly, through keys', '',
    () => { const s = spring({ keys, frequency, damping }); for (const i of frames) s.at(i / 60) },
    (run) => { let s = spring({ keys, frequency, damping }); for (const i of frames) s = s.retarget(1 / 60, [[0.3, goal(i, run)]]) },
    () => spring({ keys, frequency, damping }).linear()],
]) {
  const options = { stdin: { contents: entry, resolveDir: '.' }, bundle: true, minify: true, format: 'esm', write: false, external: ['react', 'react-dom'], define: { 'process.env.NODE_ENV': '"production"' } }
  const size = entry ? (gzipSync((await build(options)).outputFiles[0].contents, { level: 9 }).length / 1000).toFixed(1) : ''
  console.log(`| ${name} | ${least(read)} | ${least(retarget)} | ${easing ? least(easing) : '–'} | ${size} |`)
}
process.exit() // React Spring's loop goes on
