import { solve, swing } from './solver.js'

/** Refuses with one sentence. */
const fail = (Kind, sentence) => { throw new Kind(`spring: ${sentence}`) }

function number(name, value, low, high = Infinity) {
  if (typeof value !== 'number') fail(TypeError, `${name}: expected a number, got ${typeof value}`)
  if (!(value >= low && value <= high && Math.abs(value) < Infinity)) {
    fail(RangeError, `${name}: expected ${high < Infinity ? `${low} to ${high}` : low > -Infinity ? `${low} or more` : 'a finite number'}, got ${value}`)
  }
  return value
}

/** A value of `size` numbers, as a list. */
function numbers(name, value, size) {
  const list = typeof value === 'number' ? [value] : ArrayBuffer.isView(value) ? Array.from(value) : value
  if (!Array.isArray(list)) fail(TypeError, `${name}: expected a number or an array of numbers, got ${value === null ? 'null' : typeof value}`)
  if (size !== undefined && list.length !== size) fail(RangeError, `${name}: expected ${size} number${size > 1 ? 's' : ''}, got ${list.length}`)
  if (!list.length) fail(RangeError, `${name}: expected at least one number, got none`)
  list.forEach((one, i) => number(list.length > 1 ? `${name}[${i}]` : name, one, -Infinity))
  return list
}

function read(keys) {
  if (!Array.isArray(keys) || !keys.length) fail(TypeError, 'keys: expected [[time, value], …], at least one key')
  keys.forEach((key, i) => {
    if (!Array.isArray(key) || key.length !== 2) fail(TypeError, `keys[${i}]: expected [time, value]`)
    number(`keys[${i}][0]`, key[0], -Infinity)
    if (i && !(key[0] > keys[i - 1][0])) fail(RangeError, `keys[${i}]: expected a time after ${keys[i - 1][0]}, got ${key[0]}`)
  })
  const first = numbers('keys[0][1]', keys[0][1])
  return keys.map(([, value], i) => numbers(`keys[${i}][1]`, value, first.length))
}

/** Of a free swing, q″ + 2d q′ + k q = 0, a bound of |q| that only falls. */
function envelope(q, v, d, k, t) {
  const r2 = d * d - k, r = Math.sqrt(Math.abs(r2)), push = Math.abs(v + d * q)
  if (r2 < 0 && r * t > 1) return Math.exp(-d * t) * Math.hypot(q, push / r)
  const slow = Math.exp((r2 > 0 ? r - d : -d) * t)
  return slow * (Math.abs(q) + push * (r2 > 0 ? Math.min(t, 0.5 / r) : t))
}

class Spring {
  #options; #many; #begin; #rate; #d; #k; #tracks; #end

  constructor(options) {
    const { keys, frequency = 2, damping = 0.3, velocity = 0, rest = 0.001 } = options
    const columns = read(keys), size = columns[0].length
    number('frequency', frequency, 1e-3, 1e4)
    number('damping', damping, 0, 100)
    number('rest', rest, 1e-12, 1)
    const speeds = velocity === 0 ? new Array(size).fill(0) : numbers('velocity', velocity, size)
    this.#options = options
    this.#many = typeof keys[0][1] !== 'number'
    this.#begin = keys[0][0]
    const times = keys.map(([time]) => time - this.#begin), natural = 2 * Math.PI * frequency
    let gap = Infinity
    for (let i = 1; i < times.length; i++) gap = Math.min(gap, times[i] - times[i - 1])
    this.#rate = options.rate ?? Math.max(120, 48 * frequency * Math.max(1, damping), 4 / gap)
    number('rate', this.#rate, 4 / gap)
    if (times.at(-1) * this.#rate > 1e6) fail(RangeError, `keys: ${Math.round(times.at(-1) * this.#rate)} samples up to the last one are more than 1000000`)
    this.#d = damping * natural
    this.#k = natural * natural
    const properties = columns[0].map((_, i) => columns.map((values) => values[i]))
    const curves = times.length > 1 ? solve(times, properties, speeds, this.#rate, frequency, damping) : properties.map(([value], i) => Float64Array.of(value, speeds[i] / this.#rate))
    this.#tracks = curves.map((curve, i) => ({ curve, first: properties[i][0], goal: properties[i].at(-1), values: properties[i] }))
    this.#end = curves[0].length / 2 - 1
    this.duration = Math.max(keys.at(-1)[0], ...this.#tracks.map((track) => this.#begin + this.#settled(track, rest)))
  }

  /** Seconds from the first key on after which the swing stays below `rest` of the keys' range. */
  #settled({ curve, goal, values }, rest) {
    const last = this.#end, q = curve[2 * last] - goal, v = curve[2 * last + 1] * this.#rate, begin = last / this.#rate
    const bound = (t) => envelope(q, v, this.#d, this.#k, t)
    const least = rest * (Math.max(...values) - Math.min(...values) || Math.hypot(q, v / Math.sqrt(this.#k)))
    if (bound(0) <= least && v === 0) return begin
    if (this.#d === 0) return Infinity
    let low = 0, high = 1
    while (bound(high) > least) low = high, high *= 2
    while (high - low > 1e-6 * high) bound((low + high) / 2) > least ? (low = (low + high) / 2) : (high = (low + high) / 2)
    return begin + high
  }

  #read({ curve, first, goal }, time, moving) {
    const t = time - this.#begin, x = t * this.#rate, last = this.#end
    if (!(x >= 0)) return x < 0 ? (moving ? 0 : first) : NaN
    if (x === Infinity) return moving ? 0 : goal
    if (x >= last) return swing(curve[2 * last] - goal, curve[2 * last + 1] * this.#rate, this.#d, this.#k, t - last / this.#rate, moving) + (moving ? 0 : goal)
    const i = Math.floor(x), u = x - i, a = curve[2 * i], slope = curve[2 * i + 1], step = curve[2 * i + 2] - a
    const square = 3 * step - 2 * slope - curve[2 * i + 3], cube = slope + curve[2 * i + 3] - 2 * step
    return moving ? (slope + u * (2 * square + u * 3 * cube)) * this.#rate : a + u * (slope + u * (square + u * cube))
  }

  #all(time, moving, out) {
    if (!this.#many) return this.#read(this.#tracks[0], time, moving)
    const values = out ?? new Array(this.#tracks.length)
    for (let i = 0; i < this.#tracks.length; i++) values[i] = this.#read(this.#tracks[i], time, moving)
    return values
  }

  at(time, out) { return this.#all(time, 0, out) }

  velocity(time, out) { return this.#all(time, 1, out) }

  retarget(time, keys, options) {
    const [first] = Array.isArray(keys) && Array.isArray(keys[0]) ? keys : [[]]
    if (!(first[0] > 0)) fail(RangeError, `retarget: expected keys after 0, the moment of the change, got ${first[0]}`)
    return new Spring({ ...this.#options, ...options, keys: [[0, this.at(time)], ...keys], velocity: this.velocity(time) })
  }

  linear(error = 0.005, range) {
    number('linear: error', error, 1e-6, 1)
    if (!(this.duration < Infinity)) fail(RangeError, 'linear: without damping there is no end')
    const texts = this.#tracks.map((track) => {
      const [from, to] = range ?? [track.first, track.goal]
      if (from === to) fail(RangeError, 'linear: the first and the last key are equal; give a range, as in linear(0.01, [0, 1])')
      return stops((time) => ((time < this.duration ? this.#read(track, time, 0) : track.goal) - from) / (to - from), this.#begin, this.duration, error)
    })
    return this.#many ? texts : texts[0]
  }
}

/** From (i, y), the farthest place on the grid to which one line stays within the error, and the slopes that do. */
function reach(values, error, i, y) {
  let low = -Infinity, high = Infinity, j = i + 1
  for (; j < values.length; j++) {
    const room = j === values.length - 1 ? 0 : error
    const least = Math.max(low, (values[j] - room - y) / (j - i)), most = Math.min(high, (values[j] + room - y) / (j - i))
    if (least > most) break
    low = least
    high = most
  }
  return { to: j - 1, slopes: [low, high, (low + high) / 2] }
}

/** CSS linear(): lines from the start, each as long as the error allows, ending where the next one then comes farthest. */
function stops(progress, begin, duration, error) {
  const digits = Math.ceil(-Math.log10(error)) + 1, round = (value) => Number(value.toFixed(digits))
  let values, bend = Infinity
  for (let grid = 1000; bend > 0.1 * error && grid <= 10000; grid *= 10) { // places of one decimal, else of two
    values = Array.from({ length: grid + 1 }, (_, i) => progress(begin + ((duration - begin) * i) / grid))
    bend = 0
    for (let i = 1; i < grid; i++) bend = Math.max(bend, Math.abs(values[i - 1] - 2 * values[i] + values[i + 1]) / 8)
  }
  const last = values.length - 1, within = error - Math.min(bend, 0.2 * error) - 0.5 * 10 ** -digits, list = [[0, round(values[0])]]
  for (let [i, y] = list[0]; i < last;) {
    const { to, slopes } = reach(values, within, i, y)
    const ends = slopes.map((slope) => round(y + slope * (to - i))), far = ends.map((end) => (to < last ? reach(values, within, to, end).to : to))
    ;[i, y] = [to, ends[far.indexOf(Math.max(...far))]]
    list.push([i, y])
  }
  return `linear(${list.map(([i, y]) => `${y}${i % last ? ` ${(100 * i) / last}%` : ''}`).join(', ')})`
}

/**
 * A spring that passes through keys and settles at the last one.
 */
export function spring(options) {
  if (options === null || typeof options !== 'object') fail(TypeError, `expected an object such as { keys: [[0, 0], [0.4, 1]] }, got ${options === null ? 'null' : typeof options}`)
  return new Spring(options)
}
