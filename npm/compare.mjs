// What chains of two-key springs do at three keys, against one spring through them: node compare.mjs, in the examples' folder after npm
// install. Prints the table of README.md.
import { spring as motionSpring } from 'motion'
import { Globals, SpringValue } from '@react-spring/web'
import { raf } from '@react-spring/rafz'
import { spring as remotionSpring } from 'remotion'
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
process.exit() // React Spring's loop goes on
