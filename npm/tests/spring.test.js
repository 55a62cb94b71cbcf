// What the package promises; WIGGLY_NPM is its folder.
import assert from 'node:assert/strict'
import { test } from 'node:test'

const folder = process.env.WIGGLY_NPM
const { spring } = await import(`${folder}/index.js`)

const example = { keys: [[0, 0], [0.4, 1], [1.2, 0.3]], frequency: 2, damping: 0.2 }
const near = (actual, expected, error, what) => assert.ok(Math.abs(actual - expected) <= error, `${what}: ${actual}, expected ${expected}`)

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

test('passes through every key, whenever it is, and begins with its speed', () => {
  for (const options of springs(300)) {
    const s = spring(options)
    for (const [time, value] of options.keys) near(s.at(time), value, 1e-10, JSON.stringify(options))
    near(s.velocity(options.keys[0][0]), options.velocity, 1e-9, 'velocity')
  }
  const s = spring(example)
  assert.deepEqual(example.keys.map(([time]) => s.at(time)), [0, 1, 0.3])
  assert.equal(s.velocity(0), 0)
})

test('moves without a jump of value or speed', () => {
  for (const options of [example, ...springs(40)]) {
    const s = spring(options), begin = options.keys[0][0], end = options.keys.at(-1)[0] + 1, dt = 1e-5
    let fastest = 0, jump = 0, off = 0
    for (let i = 1; i < 3000; i++) {
      const t = begin + (i / 3000) * (end - begin)
      const change = (s.at(t + dt) - s.at(t - dt)) / (2 * dt)
      fastest = Math.max(fastest, Math.abs(change))
      off = Math.max(off, Math.abs(change - s.velocity(t)))
      jump = Math.max(jump, Math.abs(s.velocity(t + dt) - s.velocity(t - dt)))
    }
    assert.ok(off < 0.01 * fastest && jump < 0.01 * fastest, `${JSON.stringify(options)}: ${off}, ${jump} of ${fastest}`)
  }
})

test('is the textbook\'s oscillator after the last key', () => {
  const s = spring({ keys: [[0, 1]], frequency: 2, damping: 0.1, velocity: 3 }), d = 0.1 * 4 * Math.PI, w = 4 * Math.PI * Math.sqrt(0.99)
  for (const t of [0, 0.1, 0.7, 2]) near(s.at(t), 1 + (3 / w) * Math.exp(-d * t) * Math.sin(w * t), 1e-12, `at ${t}`)
  const k = spring(example), natural = 4 * Math.PI, dt = 1e-3
  for (const t of [1.3, 1.7, 2.5]) {
    const bend = (k.velocity(t + dt) - k.velocity(t - dt)) / (2 * dt)
    near(bend, -2 * 0.2 * natural * k.velocity(t) - natural ** 2 * (k.at(t) - 0.3), 2e-3, `force at ${t}`)
  }
})

test('settles at the last key', () => {
  for (const options of springs(100)) {
    const s = spring(options), last = options.keys.at(-1)[1], values = options.keys.map(([, value]) => value)
    const range = Math.max(...values) - Math.min(...values)
    for (let i = 0; i < 50; i++) near(s.at(s.duration + i * 0.05), last, 0.00101 * range, JSON.stringify(options))
    assert.ok(s.duration >= options.keys.at(-1)[0] && s.duration < Infinity)
    assert.equal(s.at(Infinity), last)
    assert.equal(s.velocity(Infinity), 0)
  }
  assert.equal(spring({ keys: [[0, 0], [1, 1]], damping: 0 }).duration, Infinity)
  assert.equal(spring({ keys: [[0.5, 2]] }).duration, 0.5)
  assert.equal(spring({ keys: [[0.5, 2]] }).at(7), 2)
})

test('stands still before the first key', () => {
  const s = spring({ ...example, velocity: 5 })
  assert.deepEqual([s.at(-1), s.velocity(-1), s.velocity(0)], [0, 0, 5])
  assert.ok(Number.isNaN(s.at(NaN)))
})

test('retargets with its value and speed', () => {
  for (const time of [0, 0.2, 0.4, 1.1, 1.9]) {
    const s = spring(example), next = s.retarget(time, [[0.3, -1], [0.5, 4]])
    near(next.at(0), s.at(time), 0, 'value')
    near(next.velocity(0), s.velocity(time), 1e-12, 'speed')
    near(next.at(0.5), 4, 1e-12, 'key')
  }
  const [x, y] = spring({ keys: [[0, [0, 1]], [1, [2, 3]]] }).retarget(0.5, [[0.5, [7, 8]]], { damping: 1 }).at(0.5)
  near(x, 7, 1e-12, 'x')
  near(y, 8, 1e-12, 'y')
})

test('several properties are as many springs', () => {
  const columns = [[0, 5, 2], [1, -1, 0], [3, 3, 3]], times = [0, 0.37, 1]
  const all = spring({ keys: times.map((time, i) => [time, columns.map((values) => values[i])]), velocity: [1, 2, 3] })
  const out = new Float64Array(3)
  assert.equal(all.at(0.5, out), out)
  columns.forEach((values, i) => {
    const one = spring({ keys: times.map((time, n) => [time, values[n]]), velocity: i + 1 })
    assert.equal(out[i], one.at(0.5))
    assert.equal(all.velocity(0.5)[i], one.velocity(0.5))
    assert.ok(all.duration >= one.duration)
  })
})

/** The value of a CSS linear() at a part of its time, as browsers interpolate it. */
function easing(text) {
  const stops = text.slice(7, -1).split(', ').map((stop) => stop.split(' ').map(parseFloat))
  const at = stops.map(([, place], i) => (place ?? (i ? 100 : 0)) / 100)
  return (p) => {
    const i = Math.max(0, Math.min(stops.length - 2, at.findLastIndex((place) => place <= p)))
    return stops[i][0] + ((p - at[i]) / (at[i + 1] - at[i])) * (stops[i + 1][0] - stops[i][0])
  }
}

test('linear() is within its error and ends at the last key', () => {
  for (const [options, range] of [[example], [{ ...example, keys: [[1, 5], [1.4, 2], [3, 5]] }, [0, 10]], [{ keys: [[0, 0], [0.2, 1]], frequency: 8, damping: 0.05 }]]) {
    const s = spring(options), begin = options.keys[0][0], [from, to] = range ?? [options.keys[0][1], options.keys.at(-1)[1]]
    for (const error of [0.02, 0.01, 0.001]) {
      const text = s.linear(error, range), ease = easing(text)
      assert.match(text, /^linear\(-?[\d.]+(, -?[\d.]+( [\d.]+%)?)+\)$/)
      for (let p = 0; p < 1; p += 0.00037) near(from + ease(p) * (to - from), s.at(begin + p * (s.duration - begin)), 1.05 * error * Math.abs(to - from), `${text.length} characters, at ${p}`)
      near(ease(1), (options.keys.at(-1)[1] - from) / (to - from), error / 10, 'end')
    }
  }
})

test('linear() has few stops: four seconds of 2 Hz need at most 60 for 1 %', () => {
  const s = spring({ keys: [[0, 0], [0.25, 1]], frequency: 2, damping: 0.09, rest: 0.01 })
  near(s.duration, 4, 0.5, 'duration')
  assert.ok(s.linear(0.01).split(',').length <= 60, `${s.linear(0.01).split(',').length} stops`)
})

test('refuses with one sentence', () => {
  for (const [run, Kind, sentence] of [
    [() => spring(), TypeError, 'expected an object such as { keys: [[0, 0], [0.4, 1]] }, got undefined'],
    [() => spring({}), TypeError, 'keys: expected [[time, value], …], at least one key'],
    [() => spring({ keys: [0, 1] }), TypeError, 'keys[0]: expected [time, value]'],
    [() => spring({ keys: [[0, 0], [0.2, '1']] }), TypeError, 'keys[1][1]: expected a number or an array of numbers, got string'],
    [() => spring({ keys: [[0, 0], [0.2, NaN]] }), RangeError, 'keys[1][1]: expected a finite number, got NaN'],
    [() => spring({ keys: [[0, [0, 0]], [0.2, [1]]] }), RangeError, 'keys[1][1]: expected 2 numbers, got 1'],
    [() => spring({ keys: [[0, 0], [0.4, 1], [0.4, 2]] }), RangeError, 'keys[2]: expected a time after 0.4, got 0.4'],
    [() => spring({ ...example, frequency: 0 }), RangeError, 'frequency: expected 0.001 to 10000, got 0'],
    [() => spring({ ...example, damping: '0.2' }), TypeError, 'damping: expected a number, got string'],
    [() => spring({ ...example, velocity: [1, 2] }), RangeError, 'velocity: expected 1 number, got 2'],
    [() => spring({ keys: [[0, 0], [1e5, 1]] }), RangeError, 'keys: 12000000 samples up to the last one are more than 1000000'],
    [() => spring(example).retarget(0.2, [[0, 1]]), RangeError, 'retarget: expected keys after 0, the moment of the change, got 0'],
    [() => spring({ keys: [[0, 1], [1, 1]] }).linear(), RangeError, 'linear: the first and the last key are equal; give a range, as in linear(0.01, [0, 1])'],
    [() => spring({ ...example, damping: 0 }).linear(), RangeError, 'linear: without damping there is no end'],
  ]) {
    assert.throws(run, (error) => (error instanceof Kind && error.message === `spring: ${sentence}`) || assert.fail(String(error)))
  }
})
