// wiggly beside other springs, in the examples' folder after npm install. node compare.mjs prints what chains of two-key springs do at
// three keys; node compare.mjs times, how long all take and what they add to a page. Both tables are in README.md.
import { build } from 'esbuild'
import { gzipSync } from 'node:zlib'
import { spring as motionSpring } from 'motion'
import { spring as popmotionSpring } from 'popmotion'
import { Globals, SpringValue } from '@react-spring/web'
import { raf } from '@react-spring/rafz'
import { spring as remotionSpring } from 'remotion'
import wobble from 'wobble'
import { spring } from 'wiggly'

const keys = [[0, 0], [0.3, 1], [0.9, 0.3]], frequency = 2, damping = 0.2
const natural = 2 * Math.PI * frequency, config = { stiffness: natural ** 2, damping: 2 * damping * natural, mass: 1 }
const step = 1e-3, end = 6

/** A curve made of one spring a key; each begins where the one before is when that is due. */
function chain(make) {
  const parts = []
  let value = keys[0][1], speed = 0
  for (let i = 1; i < keys.length; i++) {
    const begin = keys[i - 1][0], part = make(value, keys[i][1], speed, keys[i][0] - begin)
    parts.push([begin, part])
    const t = keys[i][0] - begin
    value = part(t)
    speed = (part(t - step) - part(t - 2 * step)) / step // that with which it arrives
  }
  return (t) => { const [begin, part] = parts.findLast(([begin]) => begin <= t); return part(t - begin) }
}

const played = (options) => { const s = motionSpring(options); return (t) => s.next(1000 * t).value }
const motion = chain((from, to, velocity) => played({ keyframes: [from, to], velocity, ...config, restDelta: 1e-6, restSpeed: 1e-6 }))
const inTime = chain((from, to, velocity, time) => played({ keyframes: [from, to], velocity, duration: 1000 * time, bounce: 1 - damping }))

/** React Spring's own loop, a millisecond a frame; its first frame is a sixtieth of a second. */
function reactSpring() {
  const first = 1 / 60, samples = [], place = (time) => Math.max(0, Math.round((time - first) / step))
  let now = 1
  Globals.assign({ now: () => now, requestAnimationFrame: () => 0 })
  raf.now = () => now
  raf.frameLoop = 'demand'
  const x = new SpringValue(keys[0][1])
  for (let i = 0; i * step < end; i++, now += 1000 * step) {
    const due = keys.slice(1).find((_, n) => place(keys[n][0]) === i)
    if (due) x.start({ to: due[1], config: { tension: config.stiffness, friction: config.damping, mass: 1, precision: 1e-6 } })
    raf.advance()
    samples.push(x.get())
  }
  return (t) => samples[Math.min(samples.length - 1, place(t))]
}

/** One of Remotion's springs a key, added. */
const remotion = (t) => keys.slice(1).reduce((sum, [, value], i) => sum + (value - keys[i][1]) * remotionSpring({ frame: (t - keys[i][0]) * 1000, fps: 1000, config }), keys[0][1])

function chains() {
  const own = spring({ keys, frequency, damping }), [, [time]] = keys
  for (const [name, x] of [
    ['Motion, a spring to the next key when one is due', motion],
    ['Motion, a spring of that duration to each key', inTime],
    ['React Spring, `start()` to the next key when one is due', reactSpring()],
    ['Remotion, the sum of a spring to each key', remotion],
    ['wiggly', (t) => own.at(t)],
  ]) {
    const missed = keys.slice(1).map(([time, value]) => Math.abs(x(time) - value).toFixed(2))
    const speed = (x(time - step) - x(time - 2 * step)) / step // before the last millisecond, in which Motion goes to the key
    console.log(`| ${name} | ${missed.join(' | ')} | ${speed.toFixed(1)} |`)
  }
}

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

/** A spring from 0 to 1: 60 frames of it; 60 frames, each of which goes for another value; and its linear(). */
async function times() {
  const frames = Array.from({ length: 60 }, (_, i) => i), goal = (i, run) => Math.sin(i + run), both = { ...config, keyframes: [0, 1] }
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
}

await (process.argv[2] === 'times' ? times() : chains())
process.exit() // React Spring's loop goes on
