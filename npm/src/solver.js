// One oscillator that is pushed only shortly before its keys (docs/mathematics.md, Wind-up).
//
// The curve is o + q + Re w. o is where the oscillator rests: it moves to a key that settles, over the wind-up before that key. q swings
// freely, q″ + 2d q′ + k q = 0, and answers the moves of o. w is what the keys ask for: from a key on it swings by one pole, w′ = p w,
// and in the wind-up two poles, p ± jν, are pushed to the next key with the least sum of squares.
//
// With w_i = e^{p(i−n)h} z_i, n the key's sample, both poles have the same real filter, z_{i+1} = 2 cos(νh) z_i − z_{i−1} + ε_i. So z is
// C times what free motion would bring to the key, plus R times what is then missing there; C and R are real and depend on no value. Of a
// wind-up that begins in mid-motion, D is for the rest of its speed.

/**
 * Numbers of a state, one property after the other: o, its next move, q, q′, then the real and imaginary parts of w, of what the pushes add
 * to w at the next key, and of w′ − p w, which is not 0 where a wind-up goes on in mid-motion.
 */
export const members = 10

/** The weights of these in the value and in the speed, and how much of its move o has made. */
export const weight = { value: new Float64Array(members).fill(1, 0, 1), speed: new Float64Array(members), moved: 0 }

/**
 * What a spring is made of.
 * @param {number} windUp seconds before a key
 * @param {number} count samples of a wind-up; need not be whole
 * @param {number} least samples of a gap that is shorter than that
 * @param {boolean} isRefined whether to come closer to endlessly many samples; needs a whole count
 */
export function springLaw(frequency, damping, bandwidth, windUp, count, least, isRefined) {
  const natural = 2 * Math.PI * frequency, root = Math.sqrt(Math.abs(damping * damping - 1)), swings = damping <= 1
  return {
    d: damping * natural, k: natural * natural, root: root * natural, windUp, count, least, isRefined, apart: bandwidth * natural,
    decay: swings ? damping * natural : natural / (damping + root), // of the pole; beyond critical damping the slower one
    turn: swings ? root * natural : 0,
    tables: [],
  }
}

/** Turns the weight of a real number into those of a complex one: times x + iy, which swings by the pole. */
function setTurned({ decay, turn }, m, x, y) {
  const { value, speed } = weight, z = value[m], slope = speed[m]
  value[m] = x * z
  value[m + 1] = -y * z
  speed[m] = (-decay * x - turn * y) * z + x * slope
  speed[m + 1] = (decay * y - turn * x) * z - y * slope
}

/** Sets the weights for t seconds of free swing. */
function setFree(law, t) {
  const { d, k, decay, turn, root } = law, { value, speed } = weight, fall = Math.exp(-decay * t)
  const x = fall * Math.cos(turn * t), y = fall * Math.sin(turn * t)
  let cosine = x, sine = y / turn // of rt with the decay, the sine over r
  if (turn === 0) {
    const apart = Math.expm1(-2 * root * t)
    cosine = fall * (1 + apart / 2)
    sine = root > 0 ? (fall * -apart) / (2 * root) : fall * t
  }
  value[2] = cosine + d * sine
  value[3] = sine
  speed[2] = -k * sine
  speed[3] = cosine - d * sine
  value[4] = 1
  speed[4] = 0
  setTurned(law, 4, x, y)
}

/** How o moves. */
const smooth = (t) => (t > 0 ? t * t * t * (10 + t * (6 * t - 15)) : 0)

/** Of each sample of a wind-up: C, D, R and what o and q do for a move by 1, a value and a slope each. */
const C = 0, D = 2, R = 4, moved = 6, row = 8

/** The wind-up of n samples, h seconds each. */
function makeRows(law, n, h) {
  const last = Math.ceil(n - 1e-9), first = last + Math.floor(0.5 - n + 1e-9), off = first - last + n // the first sample is `off` after the start
  const nu = law.apart * h, twice = 2 * Math.cos(nu), fall = Math.exp(-2 * law.decay * h)
  const rows = new Float64Array(row * (last + 1)), push = new Float64Array(2 * last)

  // How far each push moves z at the key, ψ, and the end of the sum, τ; with their covariance.
  let psi = 1, before = 0, tau = 1, following = 0, variance = 1, knot = 0, both = 0, end = 0.5 / fall
  for (let i = last - 1; i >= first; i--) {
    following = tau
    tau = (twice / 2) * psi - before
    const q = variance * (i === first ? Math.min(1, off + 0.5) : 1)
    knot += q * psi * psi
    both += q * psi * tau
    end += q * tau * tau
    push[2 * i] = q * psi
    push[2 * i + 1] = q * tau
    variance *= fall
    ;[psi, before] = [twice * psi - before, psi]
  }

  // Free motion, also where the window begins between two samples.
  const m = 2 * Math.max(0, off), begin = Math.cos(nu * off), share = both / end, own = knot - both * share
  const next = (1 - m) * Math.cos(nu * (off + 1)) + m * (twice * begin - Math.cos(nu * (off - 1)))
  const fill = (column, start, second, ofPsi, ofTau) => {
    let old = twice * start - second, z = start
    for (let i = first, at = row * first + column; i <= last; i++, at += row) {
      rows[at] = z
      if (i === last) break
      const young = twice * z - old + ofPsi * push[2 * i] + ofTau * push[2 * i + 1]
      rows[at + 1] = i > 0 ? (young - old) / (2 * h) : 0
      ;[old, z] = [z, young]
    }
  }
  const turned = nu > 0 ? Math.sin(nu) / law.apart : h
  fill(C, begin, next, 0, (begin * following - next * tau) / end)
  fill(D, 0, turned, 0, (-turned * tau) / end)
  fill(R, 0, 0, 1 / own, -share / own)
  rows[C] = rows[D + 1] = 1

  // o is linear between samples; q′ jumps against its bends.
  setFree(law, h)
  const [, , stay, go] = weight.value, [, , pull, slow] = weight.speed
  let q = 0, speed = 0, slope = 0, place = 0
  for (let i = 0, at = moved; i <= last; i++, at += row) {
    rows[at] = place + q
    rows[at + 1] = speed + slope
    const to = smooth((i + 1 - last + n) / n), rise = (to - place) / h, jumped = speed - (rise - slope)
    speed = pull * q + slow * jumped
    q = stay * q + go * jumped
    place = to
    slope = rise
  }
  return rows
}

/** The wind-up table of a gap. A few are kept; those of long gaps are all the same. */
function tableOf(law, span) {
  const { tables, windUp, count } = law, seconds = Math.min(span, windUp)
  for (const table of tables) if (table.seconds === seconds) return table
  if (tables.length === 16) tables.shift()
  const n = span > (1 + 1e-9) * windUp ? count : Math.max(law.least, Math.ceil(seconds / (windUp / count) - 1e-9)), h = seconds / n, rows = makeRows(law, n, h)
  if (law.isRefined) { // the error is of second order: that of half the step is a quarter
    const half = makeRows(law, 2 * n, h / 2)
    for (let i = 0; i < rows.length; i++) rows[i] = (4 * half[2 * i - (i % row)] - rows[i]) / 3
  }
  const table = { seconds, h, last: rows.length / row - 1, rows }
  tables.push(table)
  return table
}

/** A cubic from a row to the next: value and speed to the weights of a number. */
function setBetween(rows, at, u, h, m) {
  const a = rows[at], slope = h * rows[at + 1], end = h * rows[at + row + 1], step = rows[at + row] - a
  const square = 3 * step - 2 * slope - end, cube = slope + end - 2 * step
  weight.value[m] = a + u * (slope + u * (square + u * cube))
  weight.speed[m] = (slope + u * (2 * square + u * 3 * cube)) / h
}

/** Sets the weights for t seconds after a key; `span` seconds lie between that and the next one (Infinity: there is none). */
export function setWeights(law, t, span) {
  const { value, speed } = weight, table = span < Infinity ? tableOf(law, span) : null, at = table ? (t - span) / table.h + table.last : -1
  value[1] = speed[1] = weight.moved = 0
  for (let m = 6; m < members; m++) value[m] = speed[m] = 0
  setFree(law, t)
  if (t === Infinity) value.fill(0, 1), speed.fill(0)
  if (!(at >= 0)) return
  const { h, last, rows } = table, i = Math.min(last - 1, Math.floor(at)), u = at - i, fall = Math.exp(law.decay * (span - t)), angle = law.turn * (t - span)
  const x = value[4], y = -value[5]
  setBetween(rows, row * i + moved, u, h, 1)
  setBetween(rows, row * i + C, u, h, 4)
  setTurned(law, 4, x, y)
  setBetween(rows, row * i + R, u, h, 6)
  setTurned(law, 6, fall * Math.cos(angle), fall * Math.sin(angle))
  setBetween(rows, row * i + D, u, h, 8)
  setTurned(law, 8, x, y)
  weight.moved = smooth(1 + (t - span) / Math.min(span, law.windUp))
}

/**
 * Solves the gap from a key to the next, `span` seconds later: completes the key's state with the move of o and the pushes, and returns
 * the state at the next one.
 * @param {number[]} state is written to
 * @param {number[]} values at the next key
 * @param {boolean} settles whether o moves there
 */
export function solveGap(law, state, span, values, settles) {
  const { rows, last } = tableOf(law, span), end = row * last, next = [], { value, speed } = weight
  setFree(law, span)
  for (let i = 0, at = 0; i < values.length; i++, at += members) {
    const [o, , q, v, re, im, , , more, moreIm] = state.slice(at, at + members), rests = settles ? values[i] : o, move = rests - o
    const to = value[2] * q + value[3] * v + move * (rows[end + moved] - 1), wanted = values[i] - rests - to
    const comes = rows[end + C] * re + rows[end + D] * more, turned = rows[end + C] * im + rows[end + D] * moreIm
    state[at + 1] = move
    state[at + 6] = wanted - (value[4] * comes + value[5] * turned)
    next.push(rests, 0, to, speed[2] * q + speed[3] * v + move * rows[end + moved + 1], wanted, value[4] * turned - value[5] * comes, 0, 0, 0, 0)
  }
  return next
}
