// In the examples' folder, after npm install: checks that a spring from one value to another is that of motion and of react-spring, then prints
// the table of README.md. A spring from 0 to 1, made and read for 60 frames; 60 frames, each of which sends it to another value; its linear();
// and what it adds to a page.
import assert from 'node:assert/strict'
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

let now = 1, frame
Globals.assign({ now: () => now, requestAnimationFrame: () => 0 })
raf.now = Date.now = () => now
raf.frameLoop = 'demand'
globalThis.requestAnimationFrame = (run) => ((frame = run), 1)
globalThis.cancelAnimationFrame = () => {}
const tick = (run, time = 1000 / 60) => { now += time; run() }

const from = -3, to = 7, near = (t, is, right, options) => assert.ok(Math.abs(is - right) <= 1e-6, `${JSON.stringify(options)} at ${t} s: ${is}, not ${right}`)
for (const options of [
  { stiffness: 100, damping: 10 }, { stiffness: 170, damping: 26, mass: 1, velocity: 40 }, { stiffness: 400, damping: 60, mass: 0.5, velocity: -90 },
  { stiffness: 100, damping: 20, mass: 1 }, { stiffness: 280, damping: 120 }, { stiffness: 80, damping: 0, mass: 3 },
  ...[-1, -0.6, -0.1, -0.001, 0, 0.001, 0.3, 0.8, 1].flatMap((bounce) => [{ bounce, duration: 0.45 }, { bounce, duration: 2 }]),
  { bounce: 0.2 }, { duration: 1 },
]) {
  const ours = spring({ from, to, ...options }), { duration } = options, end = duration ?? (options.bounce ? 0.8 : 1.5) // where one of a duration goes to its end
  const theirs = motionSpring({ keyframes: [from, to], ...options, restDelta: 1e-12, restSpeed: 1e-12, duration: duration && 1000 * duration })
  for (let t = 0; t < end; t += 0.011) near(t, ours.at(t), theirs.next(1000 * t).value, options)
}

/** What react-spring shows t seconds after its start, of a spring that is so many times slower: its steps take a millisecond. */
function stepped({ stiffness, damping, mass, velocity }, t, slower) {
  const x = new SpringValue(from)
  x.start({ to, config: { tension: stiffness / slower ** 2, friction: damping / slower, mass, velocity: velocity / slower / 1000, precision: 1e-15 } })
  for (let left = Math.round(1000 * t * slower); left > 0; left -= 50) tick(raf.advance, Math.min(50, left))
  x.stop()
  return x.get()
}

raf.onFrame(() => true) // the loop goes on: its first frame has another length
tick(raf.advance, 1)
for (const options of [{ stiffness: 170, damping: 26, mass: 1, velocity: 0 }, { stiffness: 180, damping: 12, mass: 1, velocity: 30 }, { stiffness: 280, damping: 120, mass: 2, velocity: 0 }]) {
  for (const t of [0.1, 0.25, 0.6]) {
    const [a, b, c] = [1000, 2000, 4000].map((slower) => stepped(options, t, slower)), first = 2 * b - a, second = 2 * c - b // without the error of its steps
    near(t, spring({ from, to, ...options }).at(t), (4 * second - first) / 3, options)
  }
}

/** Microseconds, the least of many runs. */
function least(run) {
  let best = Infinity
  for (let round = 0; round < 1000; round++) {
    const begin = performance.now()
    for (let i = 0; i < 5; i++) run(i)
    best = Math.min(best, ((performance.now() - begin) / 5) * 1000)
  }
  return best.toFixed(1)
}

const reactStart = (x, to) => x.start({ to, config: { tension: config.stiffness, friction: config.damping, mass: 1 } })
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
  ...[['wiggly, from one value to another', "export { spring } from 'wiggly'", { from: 0, to: 1, ...config }, (value) => value],
    ['wiggly, through keys', '', { keys, frequency, damping }, (value) => [[0.3, value]]]].map(([name, entry, options, to]) => [name, entry,
    () => { const s = spring(options); for (const i of frames) s.at(i / 60) },
    (run) => { let s = spring(options); for (const i of frames) s = s.retarget(1 / 60, to(goal(i, run))) },
    () => spring(options).linear()]),
]) {
  const options = { stdin: { contents: entry, resolveDir: '.' }, bundle: true, minify: true, format: 'esm', write: false, external: ['react', 'react-dom'], define: { 'process.env.NODE_ENV': '"production"' } }
  const size = entry ? (gzipSync((await build(options)).outputFiles[0].contents, { level: 9 }).length / 1000).toFixed(1) : ''
  console.log(`| ${name} | ${least(read)} | ${least(retarget)} | ${easing ? least(easing) : '–'} | ${size} |`)
}
process.exit() // React Spring's loop goes on
