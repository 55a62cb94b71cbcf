// A spring from one value to another is that of motion and of react-spring: node --test, where those two are.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { spring as motionSpring } from 'motion'
import { Globals, SpringValue } from '@react-spring/web'
import { raf } from '@react-spring/rafz'
import { spring } from 'wiggly'

const from = -3, to = 7, exact = { restDelta: 1e-12, restSpeed: 1e-12 }

for (const options of [
  { stiffness: 100, damping: 10 }, { stiffness: 170, damping: 26, mass: 1, velocity: 40 }, { stiffness: 400, damping: 60, mass: 0.5, velocity: -90 },
  { stiffness: 100, damping: 20, mass: 1 }, { stiffness: 280, damping: 120 }, { stiffness: 80, damping: 0, mass: 3 },
  ...[-1, -0.6, -0.1, -0.001, 0, 0.001, 0.3, 0.8, 1].flatMap((bounce) => [{ bounce, duration: 0.45 }, { bounce, duration: 2 }]),
  { bounce: 0.2 }, { duration: 1 },
]) {
  test(`motion's, of ${JSON.stringify(options)}`, () => {
    const ours = spring({ from, to, ...options }), { duration, velocity } = options
    const theirs = motionSpring({ keyframes: [from, to], ...options, velocity, ...exact, duration: duration && 1000 * duration })
    const end = duration ?? (options.bounce ? 0.8 : 1.5) // where a spring of a duration goes to its end
    for (let t = 0; t < end; t += 0.011) assert.ok(Math.abs(ours.at(t) - theirs.next(1000 * t).value) <= 1e-6, `${t} s: ${ours.at(t)}, not ${theirs.next(1000 * t).value}`)
  })
}

let now = 1
Globals.assign({ now: () => now, requestAnimationFrame: () => 0 })
raf.now = () => now
raf.frameLoop = 'demand'

/** react-spring's own loop, in milliseconds. */
function play(left) {
  for (; left > 0; left -= 50) {
    now += Math.min(50, left)
    raf.advance()
  }
}

new SpringValue(0).start({ to: 1, config: { tension: 1e-9, friction: 0, precision: 1e-15 } }) // the loop goes on: its first frame has another length
play(1)

/** What react-spring shows t seconds after its start, of a spring that is so many times slower: its steps take a millisecond. */
function stepped({ stiffness, damping, mass, velocity }, t, slower) {
  const x = new SpringValue(from)
  x.start({ to, config: { tension: stiffness / slower ** 2, friction: damping / slower, mass, velocity: velocity / slower / 1000, precision: 1e-15 } })
  play(Math.round(1000 * t * slower))
  x.stop()
  return x.get()
}

for (const options of [{ stiffness: 170, damping: 26, mass: 1, velocity: 0 }, { stiffness: 180, damping: 12, mass: 1, velocity: 30 }, { stiffness: 280, damping: 120, mass: 2, velocity: 0 }]) {
  test(`react-spring's, of ${JSON.stringify(options)}`, () => {
    const ours = spring({ from, to, ...options })
    for (const t of [0.1, 0.25, 0.6]) {
      const [a, b, c] = [1000, 2000, 4000].map((slower) => stepped(options, t, slower)), first = 2 * b - a, second = 2 * c - b // without the error of its steps
      const limit = (4 * second - first) / 3
      assert.ok(Math.abs(ours.at(t) - limit) <= 1e-6, `${t} s: ${ours.at(t)}, not ${limit}`)
    }
  })
}
