// CSS linear(): an easing of few straight lines that stays within an error of a spring.
import { fail } from './options.js'

/**
 * Times and values from 0 to the end, so close that lines between them are within the error: cubics between places that follow the swing,
 * and on each as many points as its bend asks for. A cubic over h is off by at most max |x⁗| h⁴/384, and a tenth of the error is spent.
 * @param at value, speed and place of rest at a time
 */
function sample({ law, times, values, at }, end, error) {
  const { d, turn, windUp, root } = law, natural = Math.sqrt(law.k), last = times.length - 1
  const fastest = turn > 0 ? natural : d + root, slowest = turn > 0 ? natural : law.decay, begin = Math.max(0, times[0]), places = [0]
  let [before, rise, rests] = at(begin)
  const list = [times[0] > 0 ? values[0] : before], size = values.reduce((far, value) => Math.max(far, Math.abs(value - rests)), Math.abs(rise) / natural)
  if (begin > 0) places.push(begin), list.push(before)
  const follow = (swing) => Math.sqrt(Math.sqrt((128 * error) / swing)), all = 0.7 * follow(size)
  for (let from = begin, gap = 0; from < end; ) {
    while (times[gap + 1] <= from) gap++
    const next = gap < last ? Math.min(end, times[gap + 1]) : end, winds = gap < last ? Math.max(times[gap], next - windUp) : Infinity
    const q = before - rests, isFree = from < winds, edge = isFree ? Math.min(winds, next) : next
    const fades = Math.exp((fastest / 4) * (from - times[gap])) / fastest // the faster part of a slow spring
    const long = isFree && turn > 0 ? follow(Math.hypot(q, (rise + d * q) / turn)) / natural : all * Math.min(1 / slowest, isFree ? Infinity : (next - winds) / 4, fades)
    const to = from + 1.1 * long < edge ? from + long : edge, [after, slope, resting] = at(to), h = to - from, step = after - before
    const bend = Math.max(Math.abs(6 * step - h * (4 * rise + 2 * slope)), Math.abs(6 * step - h * (2 * rise + 4 * slope)))
    const parts = Math.ceil(Math.sqrt(bend / (8 * error))) || 1, square = 3 * step - h * (2 * rise + slope), cube = h * (rise + slope) - 2 * step
    for (let n = 1; n <= parts; n++) {
      const u = n / parts
      places.push(from + u * h)
      list.push(n < parts ? before + u * (h * rise + u * (square + u * cube)) : after)
    }
    if (list.length > 1e6) fail(RangeError, 'linear: it swings too often for one easing until it has settled')
    ;[from, before, rise, rests] = [to, after, slope, resting]
  }
  return [places, list]
}

/** Lines from the start, each as long as the error allows, ending where the next one then comes farthest. */
function stops(at, values, error) {
  const last = values.length - 1, within = 0.7 * error, digits = 10 ** (Math.ceil(-Math.log10(error)) + 1)
  let low, high

  /** From (i, y), the farthest place to which one line stays within the error; the slopes that do are low to high. */
  function reach(i, y) {
    low = -Infinity
    high = Infinity
    for (let j = i + 1; ; j++) {
      const room = j < last ? within : 0, run = at[j] - at[i], least = (values[j] - room - y) / run, most = (values[j] + room - y) / run
      if (least > high || most < low) return j - 1
      if (least > low) low = least
      if (most < high) high = most
      if (j === last) return last
    }
  }

  const places = [0], heights = [Math.round(values[0] * digits) / digits]
  let steepest = 0
  for (let i = 0, y = heights[0]; i < last; ) {
    const to = reach(i, y), run = at[to] - at[i]
    let best = -1, end
    for (const slope of [low, high]) {
      const there = Math.round((y + slope * run) * digits) / digits, far = to < last ? reach(to, there) : to
      if (far > best) [best, end] = [far, there]
    }
    steepest = Math.max(steepest, Math.abs((end - y) / run))
    ;[i, y] = [to, end]
    places.push(i)
    heights.push(y)
  }
  const parts = 10 ** Math.max(0, Math.ceil(Math.log10((10 * steepest * at[last]) / error / 100)))
  let text = `linear(${heights[0]}`
  for (let n = 1; n < places.length; n++) text += `, ${heights[n]}${places[n] < last ? ` ${Math.round((100 * parts * at[places[n]]) / at[last]) / parts}%` : ''}`
  return `${text})`
}

/**
 * The easing of one property, from 0 to its end in seconds.
 * @param goal where it settles
 */
export function easing(curve, end, goal, error, [from, to]) {
  const range = to - from || 1, [places, list] = end > 0 ? sample(curve, end, 0.15 * error * Math.abs(to - from) || Infinity) : [[0, 1], [goal, goal]]
  if (from === to && !list.every((value) => value === from)) fail(RangeError, 'linear: it ends where it begins; give a range, as in linear(0.01, [0, 1])')
  const progress = list.map((value) => (value - from) / range), last = list.length - 1, aim = (goal - from) / range
  if (Math.abs(progress[last] - aim) <= error) progress[last] = aim
  return stops(places, progress, error)
}
