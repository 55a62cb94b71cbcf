// What the package promises; WIGGLY_NPM is its folder.
import assert from 'node:assert/strict'
import { once } from 'node:events'
import { createRequire } from 'node:module'
import { test } from 'node:test'
import { Worker } from 'node:worker_threads'

const folder = process.env.WIGGLY_NPM
const { spring } = await import(`${folder}/index.js`)

const example = { keys: [[0, 0], [0.4, 1], [1.2, 0.3]], frequency: 2, damping: 0.2 }
const near = (actual, expected, error, what) => {
  if (!(Math.abs(actual - expected) <= error)) assert.fail(`${typeof what === 'string' ? what : JSON.stringify(what)}: ${actual}, expected ${expected}`)
}

const between = (from, to, count) => Array.from({ length: count + 1 }, (_, i) => from + (i / count) * (to - from))

/** Springs of every kind, always the same ones. */
function* springs(count) {
  let seed = 1
  const random = (low, high) => low + (high - low) * ((seed = (seed * 48271) % 2147483647) / 2147483647)
  for (let i = 0; i < count; i++) {
    const keys = [[random(-1, 1), random(-1, 1)]]
    for (let n = Math.floor(random(1, 7)); n > 0; n--) keys.push([keys.at(-1)[0] + random(0.02, 1.2), random(-100, 100)])
    yield { keys, frequency: 10 ** random(-1, 1), damping: i % 7 ? random(0.02, 1.5) : 1, velocity: random(-50, 50) }
  }
}

test('passes through every key, whenever it is, begins with its speed and settles at the last key', () => {
  for (const options of springs(300)) {
    const s = spring(options), { keys, velocity } = options, last = keys.at(-1)[1], values = keys.map(([, value]) => value), range = Math.max(...values) - Math.min(...values)
    for (const [time, value] of keys) {
      assert.equal(s.at(time), value)
      near(s.at(time - 1e-9), value, 1e-4, options)
    }
    for (const settles of [true, false]) near(spring({ ...options, settles }).velocity(keys[0][0]), velocity, 1e-9, 'velocity')
    for (let i = 0; i < 50; i++) near(s.at(s.duration + i * 0.05), last, 0.00101 * range, options)
    assert.ok(s.duration >= keys.at(-1)[0] && s.duration < Infinity)
    assert.deepEqual([s.at(Infinity), s.velocity(Infinity)], [last, 0])
  }
  const one = spring({ keys: [[0.5, 2]] }), s = spring({ ...example, velocity: 5 })
  assert.deepEqual([one.duration, one.at(7), spring({ keys: [[0, 0], [1, 1]], damping: 0 }).duration], [0.5, 2, Infinity])
  assert.deepEqual([s.at(-1), s.velocity(-1), s.velocity(0), s.at(NaN)], [0, 0, 5, NaN]) // it stands still before the first key
  assert.deepEqual([false, [true, false, true], [true, true, false]].map((settles) => spring({ ...example, settles }).at(Infinity)), [0, 0.3, 1])
})

test('moves without a jump of value or speed, and little where a key moves a little', () => {
  const moved = (time) => spring({ keys: [[0, 0], [time, 1], [0.6, 0.2]], frequency: 0.712, damping: 0.23 }).at(0.45)
  for (let i = 0; i < 200; i++) near(moved(0.2 + (i + 1) * 1e-5), moved(0.2 + i * 1e-5), 2e-5, `${i}`)
  for (const options of [example, ...springs(40)]) for (const settles of [true, false]) {
    const s = spring({ ...options, settles }), begin = options.keys[0][0], end = options.keys.at(-1)[0] + 1, dt = 1e-5
    let fastest = 0, jump = 0, off = 0
    for (const t of between(begin, end, 3000).slice(1, -1)) {
      const change = (s.at(t + dt) - s.at(t - dt)) / (2 * dt)
      fastest = Math.max(fastest, Math.abs(change))
      off = Math.max(off, Math.abs(change - s.velocity(t)))
      jump = Math.max(jump, Math.abs(s.velocity(t + dt) - s.velocity(t - dt)))
    }
    assert.ok(off < 0.01 * fastest && jump < 0.01 * fastest, `${JSON.stringify(options)}: ${off}, ${jump} of ${fastest}`)
  }
})

test('has samples enough for 1e-4 of the range', () => {
  for (const options of springs(60)) for (const changes of [{}, { windUp: 0.1 }, { windUp: 3 }, { settles: false, velocity: 0 }]) {
    const s = spring({ ...options, velocity: 0, ...changes }), { frequency, keys } = options
    const exact = spring({ ...options, velocity: 0, ...changes, rate: 800 * frequency * Math.max(1, 0.5 / (changes.windUp ?? 0.5)) })
    const times = between(keys[0][0], keys.at(-1)[0] + 1 / frequency, 500), right = times.map((time) => exact.at(time))
    const range = Math.max(...right) - Math.min(...right)
    times.forEach((time, i) => near(s.at(time), right[i], 1e-4 * range, [options, changes, time]))
  }
})

test('from one value to another is the textbook\'s oscillator, and so is what follows the last key', () => {
  const d = 0.1 * 4 * Math.PI, w = 4 * Math.PI * Math.sqrt(0.99), feel = { frequency: 2, damping: 0.1 }
  const s = spring({ from: 0, to: 1, velocity: 3, ...feel })
  for (const t of [0, 0.1, 0.7, 2]) near(s.at(t), 1 + Math.exp(-d * t) * (((3 - d) / w) * Math.sin(w * t) - Math.cos(w * t)), 1e-12, `at ${t}`)
  const through = spring({ from: 0, to: 1, velocity: 3, ...feel, keys: [[2, 5]] })
  for (const t of [0, 0.1, 0.7, 1.74]) assert.equal(through.at(t), s.at(t))
  assert.deepEqual([through.at(2), through.at(Infinity), s.at(Infinity), spring({ from: 4, keys: [[1, 5]] }).at(0.2)], [5, 5, 1, 4])
  const k = spring(example), natural = 4 * Math.PI, dt = 1e-3
  for (const t of [1.3, 1.7, 2.5]) {
    const bend = (k.velocity(t + dt) - k.velocity(t - dt)) / (2 * dt)
    near(bend, -2 * 0.2 * natural * k.velocity(t) - natural ** 2 * (k.at(t) - 0.3), 2e-3 * natural, `force at ${t}`)
  }
})

test('a key that is appended changes nothing up to its wind-up', () => {
  for (const options of springs(60)) {
    const s = spring(options), last = options.keys.at(-1)[0], reach = 0.5 / options.frequency, next = [last + 1.5 * reach, 7]
    const longer = spring({ ...options, keys: [...options.keys, next] }), from = options.keys[0][0]
    for (const time of between(from - 1e-9, next[0] - reach - 1e-9, 200)) assert.equal(longer.at(time), s.at(time))
    const now = last + 0.3 * reach, retargeted = s.retarget(now, [[next[0] - now, 7]])
    for (const time of between(0, 2 * reach, 100)) near(retargeted.at(time), longer.at(now + time), 1e-9 * (100 + Math.abs(options.velocity) * reach), options)
  }
})

test('retargets with its value and speed', () => {
  for (const settles of [true, false]) for (const time of [-1, 0, 0.2, 0.35, 0.4, 1.1, 1.9, Infinity]) {
    const s = spring({ ...example, settles })
    for (const next of [s.retarget(time, [[0.3, -1], [0.5, 4]]), s.retarget(time, 4), s.retarget(time, [[0.5, 4]], { damping: 1.5 }), s.retarget(time, 4, { frequency: 1, settles: true })]) {
      near(next.at(0), s.at(time), 0, 'value')
      near(next.velocity(0), s.velocity(time), 1e-12, 'speed')
      near(next.at(1e-6), s.at(time), 1e-4, 'soon')
    }
    assert.deepEqual([s.retarget(time, [[0.5, 4]]).at(0.5), s.retarget(time, 4).at(Infinity)], [4, 4])
  }
  const still = spring({ keys: [[0, 1], [1, 1]], settles: [true, true] }).retarget(0.5, 1)
  assert.deepEqual([still.at(0.7), still.duration], [1, 0])
  assert.deepEqual(spring({ keys: [[0, [0, 1]], [1, [2, 3]]] }).retarget(0.5, [[0.5, [7, 8]]], { damping: 1 }).at(0.5), [7, 8])
  assert.deepEqual(spring({ from: [0, 1], to: [2, 3] }).retarget(0.5, [7, 8]).at(Infinity), [7, 8])
})

test('retargets in each frame without running away', () => {
  for (const [damping, rate, ...places] of [
    ...[0.03, 0.3, 2].map((damping) => [damping, 60, 0.03, 0.06, 0.1, 0.15, 0.2, 0.25, 0.26, 0]),
    [0, 60, 0.06, 0.251, 0.26], [0, 20, 0.06, 0.251, 0.27, 0.29], [0, 8, 0.251, 0.35], // of a wind-up of 0.25 s, little or much in each frame
  ]) for (const ahead of places) {
    let s = spring({ from: 0, to: 0, damping }), most = 0
    for (let i = 0; i < 100 * rate; i++) {
      s = s.retarget(1 / rate, ahead ? [[ahead, 1]] : 1)
      most = Math.max(most, Math.abs(s.at(0)))
    }
    assert.ok(most < 2.1 && Math.abs(s.at(0) - 1) < 0.02, `${damping}, ${rate} Hz, ${ahead}: ${most}, ${s.at(0)}`)
  }
})

test('several properties are as many springs', () => {
  const columns = [[0, 5, 2], [1, -1, 0], [3, 3, 3]], times = [0, 0.37, 1], out = new Float64Array(3)
  const all = spring({ keys: times.map((time, i) => [time, columns.map((values) => values[i])]), velocity: [1, 2, 3] })
  assert.equal(all.at(0.5, out), out)
  const ones = columns.map((values, i) => spring({ keys: times.map((time, n) => [time, values[n]]), velocity: i + 1 }))
  assert.deepEqual([[...out], all.velocity(0.5)], [ones.map((one) => one.at(0.5)), ones.map((one) => one.velocity(0.5))])
  assert.equal(all.duration, Math.max(...ones.map((one) => one.duration)))
})

test('works behind proxies, unbound, with keys that change later, without WebAssembly, in workers and by require()', async () => {
  const keys = [[0, 0], [1, 1]], s = spring({ keys }), { at, retarget } = s, behind = new Proxy(s, {})
  keys[1][1] = 5
  assert.deepEqual([behind.at(1), behind.retarget(0.5, 2).at(0), behind.linear(), at(1), retarget(0.5, 2).at(0), { ...s }.duration], [1, s.at(0.5), s.linear(), 1, s.at(0.5), s.duration])
  assert.equal(createRequire(import.meta.url)(folder).spring(example).linear(), spring(example).linear())
  const code = 'delete globalThis.WebAssembly; import(process.env.WIGGLY_NPM + "/index.js").then(({ spring }) => require("node:worker_threads").parentPort.postMessage(spring({ keys: [[0, 0], [1, 1]] }).at(0.9)))'
  assert.deepEqual(await once(new Worker(code, { eval: true }), 'message'), [s.at(0.9)])
})

test('8,000 s of keys, read from end to end and back, take little memory', () => {
  const before = process.memoryUsage(), s = spring({ keys: Array.from({ length: 20000 }, (_, i) => [0.4 * i + 0.1 * Math.sin(i), Math.cos(3 * i)]) })
  let sum = 0
  for (let i = 0; i < 40000; i++) sum += s.at(0.2 * i) + s.at(8000 - 0.2 * i)
  const after = process.memoryUsage()
  assert.ok(sum !== 0 && after.heapUsed + after.arrayBuffers - before.heapUsed - before.arrayBuffers < 1e8)
})

/** The value of a CSS linear() at a part of its time, as browsers interpolate it; for parts in order. */
function easing(text) {
  const stops = text.slice(7, -1).split(', ').map((stop) => stop.split(' ').map(parseFloat))
  const at = stops.map(([, place], i) => (place ?? (i ? 100 : 0)) / 100)
  let i = 0
  return (p) => {
    while (i < stops.length - 2 && at[i + 1] <= p) i++
    return stops[i][0] + ((p - at[i]) / (at[i + 1] - at[i])) * (stops[i + 1][0] - stops[i][0])
  }
}

test('linear() is never off by more than its error, from 0 to its end, with few stops', () => {
  const keys = [[0, 0], [0.2, 1]]
  for (const [options, range] of [
    [example], [{ ...example, keys: [[1, 5], [1.4, 2], [3, 5]] }, [0, 10]], [{ keys, frequency: 8, damping: 0.05 }], [{ keys: [[5, 0], [6, 1]] }], [{ keys: [[-2, 3], [-0.1, 1], [1, 4]] }],
    [{ keys, damping: 0.001 }], [{ keys, damping: 1 }], [{ keys, damping: 30 }], [{ from: 0, to: 1, velocity: 900, damping: 8 }], [{ from: 0, to: 1, velocity: -50, bounce: 0.6 }], [{ keys, windUp: 3, settles: false }, [-1, 1]],
    ...[...springs(40)].map((options) => [options, [-100, 100]]),
  ]) {
    const s = spring(options), [from, to] = range ?? [s.at(-Infinity), s.at(Infinity)]
    for (const error of [0.02, 0.005, 0.0001]) {
      const text = s.linear(error, range), ease = easing(text), count = Math.min(3e4, 2000 * Math.ceil(s.duration * (options.frequency ?? 2)))
      assert.match(text, /^linear\(-?[\d.]+(, -?[\d.]+( [\d.]+%)?)+\)$/)
      for (let i = 0; i <= count; i++) near(from + ease(i / count) * (to - from), s.at((i / count) * s.duration), error * Math.abs(to - from) * 1.0001, [options, error, i / count])
    }
  }
  const long = spring({ keys: [[0, 0], [0.25, 1]], frequency: 2, damping: 0.09, rest: 0.01 }), count = long.linear(0.01).split(',').length
  assert.ok(long.duration > 3.5 && count <= 60, `few stops: ${count} for ${long.duration} s`)
  assert.match(spring(example).linear(), /^linear\(0, .*, 1\)$/)
  assert.equal(spring({ keys: [[0, [0, 5]], [1, [100, 5]]] }).linear()[1], 'linear(0, 0)')
})

test('refuses with one sentence', () => {
  const two = { keys: [[0, 0], [1, 1]] }
  for (const [run, Kind, sentence] of [
    [() => spring(), TypeError, 'expected an object such as { keys: [[0, 0], [0.4, 1]] }, got undefined'],
    [() => spring({}), TypeError, 'keys: expected [[time, value], …], at least one key'],
    [() => spring({ keys: [0, 1] }), TypeError, 'keys[0]: expected [time, value]'],
    [() => spring({ keys: [[0, 0], [0.2, '1']] }), TypeError, 'keys[1][1]: expected a number or an array of numbers, got string'],
    [() => spring({ keys: [[0, 0], [0.2, NaN]] }), RangeError, 'keys[1][1]: expected a finite number, got NaN'],
    [() => spring({ keys: [[0, [0, 0]], [0.2, [1]]] }), RangeError, 'keys[1][1]: expected 2 numbers, got 1'],
    [() => spring({ keys: [[0, 0], [0.4, 1], [0.4, 2]] }), RangeError, 'keys[2]: expected a time after 0.4, got 0.4'],
    [() => spring({ from: 0, keys: [[0, 1]] }), RangeError, 'keys[0]: expected a time after 0, got 0'],
    [() => spring({ from: 0 }), TypeError, 'from: also give to, or keys'],
    [() => spring({ ...two, to: 1 }), TypeError, 'to: also give from'],
    [() => spring({ ...example, frequency: 0 }), RangeError, 'frequency: expected 0.001 to 10000, got 0'],
    [() => spring({ ...example, damping: '0.2' }), TypeError, 'damping: expected a number, got string'],
    [() => spring({ ...example, velocity: [1, 2] }), RangeError, 'velocity: expected 1 number, got 2'],
    [() => spring({ ...example, velocity: NaN }), RangeError, 'velocity: expected a finite number, got NaN'],
    [() => spring({ ...example, settles: [true] }), RangeError, 'settles: expected 3 values, one a key, got 1'],
    [() => spring({ ...example, settles: 1 }), TypeError, 'settles: expected true, false or one of them a key, got number'],
    [() => spring({ ...example, rate: 60 }), RangeError, 'rate: expected 160 to 4000000, got 60'],
    [() => spring({ ...two, tension: 170 }), TypeError, 'tension: no such option; there are keys, from, to, velocity, frequency, damping, stiffness, mass, bounce, duration, windUp, settles, rest, rate'],
    [() => spring({ ...two, stiffness: 170, frequency: 2 }), TypeError, 'frequency, stiffness: cannot be mixed; give frequency and damping, or stiffness, damping and mass, or bounce and duration'],
    [() => spring({ ...two, damping: 1, bounce: 0 }), TypeError, 'damping, bounce: cannot be mixed; give frequency and damping, or stiffness, damping and mass, or bounce and duration'],
    [() => spring({ ...two, stiffness: 170 }), TypeError, 'damping: expected a number, got undefined'],
    [() => spring(example).retarget(0.2, [[0, 1]]), RangeError, 'keys[0]: expected a time after 0, got 0'],
    [() => spring(example).retarget(NaN, 1), TypeError, 'retarget: time: expected a number, got NaN'],
    [() => spring(example).retarget(1, [1, 2]), RangeError, 'retarget: to: expected 1 number, got 2'],
    [() => spring(example).retarget(1, 1, { velocity: 2 }), TypeError, 'velocity: no such option; there are frequency, damping, stiffness, mass, bounce, duration, windUp, settles, rest, rate'],
    [() => spring({ keys: [[0, 1], [1, 2], [2, 1]] }).linear(), RangeError, 'linear: it ends where it begins; give a range, as in linear(0.01, [0, 1])'],
    [() => spring(example).linear(0.01, [0, NaN]), RangeError, 'linear: range[1]: expected a finite number, got NaN'],
    [() => spring(example).linear(0.01, [1, 1]), RangeError, 'linear: range: expected two different numbers, got 1 twice'],
    [() => spring({ ...example, damping: 0 }).linear(), RangeError, 'linear: without damping there is no end'],
  ]) assert.throws(run, { name: Kind.name, message: `spring: ${sentence}` })
})
