import { easing } from './linear.js'
import { changeable, checkNames, fail, kindOf, number, numbers, readKeys, readLaw, readSettles } from './options.js'
import { members, setWeights, solveGap, weight } from './solver.js'

/**
 * A spring from a state at its first key on.
 * @param {boolean[]} settles of the keys after that
 * @param firstLaw up to the second key
 */
function run(settings, law, many, keys, settles, start, firstLaw = law) {
  const times = keys.map(([time]) => time), values = keys.map(([, value]) => value)
  const last = times.length - 1, size = values[0].length, states = [start], alone = [0]
  const { d, k, decay, turn, root } = law
  let gap = 0, duration

  const lawOf = (g) => (g ? law : firstLaw)
  const span = (g) => (g < last ? times[g + 1] - times[g] : Infinity)

  /** The state of the key before a time; sets its weights for that time. */
  function stateAt(time) {
    gap = 0
    for (let above = times.length; above - gap > 1;) {
      const middle = (gap + above) >> 1
      if (times[middle] <= time) gap = middle
      else above = middle
    }
    for (let g = states.length - 1; g < Math.min(last, gap + 1); g++) states.push(solveGap(lawOf(g), states[g], span(g), values[g + 1], settles[g]))
    setWeights(lawOf(gap), Math.max(0, time - times[gap]), span(gap))
    return states[gap]
  }

  /** Value or speed of property i. */
  function sum(state, i, weights) {
    let total = 0
    for (let m = 0, at = i * members; m < members; m++) total += weights[m] * state[at + m]
    return total
  }

  function read(time, moving, out) {
    const state = stateAt(time), t = time - times[gap]
    for (let i = 0; i < size; i++) {
      if (moving) out[i] = t < 0 ? 0 : sum(state, i, weight.speed)
      else out[i] = t <= 0 ? values[gap][i] : sum(state, i, weight.value)
    }
    return out
  }

  const show = (time, moving, out) => (many ? read(time, moving, out ?? new Array(size)) : read(time, moving, alone)[0])

  const spring = {
    /** By a bound of the swing that falls. */
    get duration() {
      if (duration !== undefined) return duration
      const state = stateAt(times[last])
      duration = times[last]
      for (let i = 0; i < size; i++) {
        const [o, , u, speed, re, im] = state.slice(i * members), q = u + re, v = speed - decay * re - turn * im, push = Math.abs(v + d * q)
        const range = values.reduce((far, one) => Math.max(far, one[i]), o) - values.reduce((far, one) => Math.min(far, one[i]), o)
        const least = law.rest * (range || Math.hypot(q, v / Math.sqrt(k)))
        if (v === 0 && Math.abs(q) <= least) continue
        if (d === 0) return (duration = Infinity)
        const most = turn > 0 ? Math.hypot(q, push / turn) : Infinity, limit = (turn > 0 ? 1 : 0.5) / root
        const peak = Math.max(0, Math.min(limit, 1 / decay - Math.abs(q) / push))
        const slow = (t) => Math.exp(-decay * t) * (Math.abs(q) + push * Math.min(t, limit))
        const swings = (t) => Math.min(Math.exp(-decay * t) * most, slow(Math.max(t, peak))) > least
        let before = 0, after = 1 / decay
        while (swings(after)) before = after, after *= 2
        while (after - before > 1e-6 * after) {
          const middle = (before + after) / 2
          if (swings(middle)) before = middle
          else after = middle
        }
        duration = Math.max(duration, times[last] + after)
      }
      return duration
    },

    at: (time, out) => show(time, 0, out),
    velocity: (time, out) => show(time, 1, out),

    retarget(time, goal, changes = {}) {
      if (typeof time !== 'number' || time !== time) fail(TypeError, `retarget: time: expected a number, got ${time === time ? kindOf(time) : time}`)
      checkNames(changes, changeable)
      const options = { ...settings, settles: Array.isArray(settings.settles) ? true : settings.settles, ...changes }
      const after = Object.keys(changes).length ? readLaw(options) : law, onwards = Array.isArray(goal) && Array.isArray(goal[0])
      const keys = onwards ? readKeys(goal, 0, size) : [], to = onwards ? null : numbers('retarget: to', goal, size), state = []
      const speeds = read(time, 1, []), here = read(time, 0, []), t = Math.max(0, time - times[gap])
      const goes = onwards && t < Infinity, [next] = keys // w goes on, or else all is q
      // So do its pushes, unless the next key is less than a quarter of a period away: again and again, they would then add up. A wind-up
      // that has begun is not put off: a little of one again and again would drive a spring without damping ever farther.
      const { windUp, count, decay, turn } = after, hasBegun = t > span(gap) - lawOf(gap).windUp && t <= windUp / 2
      const windsOn = goes && next[0] <= windUp * (hasBegun ? 1.5 : 1 + 1e-9) && next[0] * Math.sqrt(after.k) > Math.PI / 2
      const longer = windsOn && next[0] > windUp ? { ...after, windUp: next[0], count: Math.ceil((count * next[0]) / windUp), tables: [] } : after
      for (let i = 0; i < size; i++) {
        const [o, move, , , re, im, added, , more, moreIm] = states[gap].slice(i * members, (i + 1) * members)
        const rests = to ? to[i] : goes ? o + weight.moved * move : o
        const parts = ([, , , , a, b, r, own, c, d]) => [a * re + b * im + c * more + d * moreIm + r * added, a * im - b * re + c * moreIm - d * more - own * added]
        const [x, y] = goes ? parts(weight.value) : [0, 0], pole = [-decay * x - turn * y, turn * x - decay * y]
        const [dx, dy] = windsOn ? parts(weight.speed) : pole
        state.push(rests, 0, here[i] - rests - x, speeds[i] - dx, x, y, 0, 0, dx - pole[0], dy - pole[1])
      }
      return run(options, after, many, [[0, here], ...keys], readSettles(options.settles, keys.length), state, longer)
    },

    linear(error = 0.005, range) {
      number('linear: error', error, 1e-6, 1)
      const [from, to] = range === undefined ? [0, 1] : numbers('linear: range', range, 2)
      if (from === to) fail(RangeError, `linear: range: expected two different numbers, got ${from} twice`)
      if (!(spring.duration < Infinity)) fail(RangeError, 'linear: without damping there is no end')
      const goals = read(Infinity, 0, []), begin = Math.max(0, times[0])
      const edges = [begin, ...times.flatMap((time, g) => [time, Math.max(time, time + span(g) - lawOf(g).windUp)]).slice(0, -1), spring.duration]
      const valueAndSpeed = (time, i) => [sum(stateAt(time), i, weight.value), sum(states[gap], i, weight.speed)]
      const texts = goals.map((goal, i) => easing((time) => valueAndSpeed(time, i), law.turn && Math.sqrt(law.k), edges, goal, error, range ?? [values[0][i], goal]))
      return many ? texts : texts[0]
    },
  }
  return spring
}

/** A spring through keys, or from one value to another. */
export function spring(options) {
  checkNames(options, ['keys', 'from', 'to', 'velocity', ...changeable])
  const { keys, from, to, velocity, ...settings } = options, law = readLaw(options)
  if (to !== undefined && from === undefined) fail(TypeError, 'to: also give from')
  if (from !== undefined && to === undefined && keys === undefined) fail(TypeError, 'from: also give to, or keys')
  const first = from === undefined ? null : numbers('from', from)
  const all = keys === undefined && first ? [] : readKeys(keys, first ? 0 : -Infinity, first?.length), flags = readSettles(settings.settles, all.length)
  const many = typeof (from ?? keys[0][1]) !== 'number', size = (first ?? all[0][1]).length, goal = to === undefined ? first : numbers('to', to, size)
  if (first) all.unshift([0, first])
  const speeds = velocity === undefined ? null : velocity === 0 ? new Array(size).fill(0) : numbers('velocity', velocity, size), state = []
  all[0][1].forEach((value, i) => {
    const o = first ? goal[i] : flags[0] ? value : 0, w = first ? 0 : value - o
    state.push(o, 0, value - o - w, speeds ? speeds[i] + law.decay * w : 0, w, 0, 0, 0, 0, 0)
  })
  return run(settings, law, many, all, first ? flags : flags.slice(1), state)
}
