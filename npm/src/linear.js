// CSS linear(): an easing of few straight lines that stays within an error of a spring. Of the error, a tenth is for cubics, a fifth for lines
// between their points, 0.6 for those that replace them, and the rest for rounding.
import { fail } from './options.js'

/**
 * Times, values and speeds, one after the other, so close that cubics between them are within a tenth of the error.
 * @param read value and speed at a time
 * @param natural frequency, rad/s; 0 where nothing swings
 * @param edges between which the curve is smooth
 */
function trace(read, natural, edges, error) {
  const list = [edges[0], ...read(edges[0])], most = (natural > 0 ? 1 : 0.02) * error // the halves of a smooth curve are off by a 16th of the whole

  /** Goes on to a time, value and speed: halves the cubic until its middle shows that the halves are near enough. */
  function add(b, y, w) {
    const [a, x, v] = list.slice(-3), h = (b - a) / 2, middle = a + h, [z, s] = read(middle)
    const off = Math.abs(z - (x + y) / 2 - (h * (v - w)) / 4) + 6 * Math.abs(h * (s + (v + w) / 4) - 0.75 * (y - x))
    if (off > most && a < middle && middle < b) add(middle, z, s), add(b, y, w)
    else list.push(middle, z, s, b, y, w)
    if (list.length > 3e6) fail(RangeError, 'linear: it swings too often for one easing until it has settled')
  }

  let from = edges[0]
  for (const edge of edges) {
    for (let left = edge > from ? Math.ceil(((edge - from) * natural) / Math.PI) || 1 : 0; left > 0; left--) {
      from = left > 1 ? from + (edge - from) / left : edge
      add(from, ...read(from))
    }
  }
  return list
}

/**
 * The easing of one property, from 0 to the last edge: lines as long as the error allows, each ending on the side from which the next one
 * comes farther.
 * @param goal where it settles
 */
export function easing(read, natural, edges, goal, error, [zero, one]) {
  const range = one - zero, scale = 1 / (range || 1), list = trace(read, natural, edges, error * Math.abs(range) || Infinity), last = list.length - 3
  if (!range && list.some((value, i) => i % 3 === 1 && value !== zero)) fail(RangeError, 'linear: it ends where it begins; give a range, as in linear(0.01, [0, 1])')
  const end = list[last], aim = ((Math.abs(list[last + 1] - goal) <= 0.9 * error * Math.abs(range) ? goal : list[last + 1]) - zero) * scale
  const digits = 10 ** (Math.ceil(-Math.log10(error)) + 1), round = (value) => Math.round(value * digits) / digits
  const places = [0], heights = [round((list[1] - zero) * scale)], room = 0.6 * error
  let from = 0, y = heights[0], before = list[0], low = -room / before, high = room / before, steepest = 0 // slopes within the error, from (from, y)
  for (let i = 0; i < last; i += 3) {
    const a = list[i], h = list[i + 3] - a, x = (list[i + 1] - zero) * scale
    const step = (list[i + 4] - zero) * scale - x, v = list[i + 2] * h * scale, w = list[i + 5] * h * scale
    const square = 3 * step - 2 * v - w, cube = v + w - 2 * step, bend = Math.max(Math.abs(square), Math.abs(square + 3 * cube))
    const parts = Math.ceil(Math.sqrt(bend / (0.8 * error))) || 1
    for (let n = 1; n <= parts; ) {
      const isEnd = n === parts && i + 3 === last, u = n / parts, time = a + u * h, rise = (isEnd ? aim : x + u * (v + u * (square + u * cube))) - y
      const within = isEnd ? 0 : room
      const least = (rise - within) / (time - from), most = (rise + within) / (time - from)
      if (least > high || most < low) {
        steepest = Math.max(steepest, Math.abs(low), Math.abs(high))
        y = round(y + (least > high ? low : high) * (before - from))
        from = before
        places.push(from)
        heights.push(y)
        low = -Infinity
        high = Infinity
        continue
      }
      if (least > low) low = least
      if (most < high) high = most
      before = time
      n++
    }
  }
  const parts = 10 ** Math.max(0, Math.ceil(Math.log10((0.1 * Math.max(steepest, Math.abs(low)) * end) / error)))
  let text = `linear(${heights[0]}`
  for (let n = 1; n < places.length; n++) text += `, ${heights[n]} ${Math.round((100 * parts * places[n]) / end) / parts}%`
  return `${text}, ${end > 0 ? round(aim) : heights[0]})`
}
