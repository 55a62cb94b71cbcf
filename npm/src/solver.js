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
 * Numbers of a state, one property after the other: o, its next move, q, q′, Re w, Im w, what the pushes add at the next key, and the real
 * and imaginary part of w′ − p w, which is not 0 where a wind-up goes on in mid-motion.
 */
export const members = 9

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

/** A free swing after t seconds: what is left of q and of q′, the speeds of both, and the factor e^{pt} of w. */
function swing({ d, k, decay, turn, root }, t, out) {
  const fall = Math.exp(-decay * t)
  let x = fall, y = 0, cosine = fall, sine = fall * t // the last two: of rt with the decay, the sine over r
  if (turn > 0) {
    cosine = x = fall * Math.cos(turn * t)
    y = fall * Math.sin(turn * t)
    sine = y / turn
  } else if (root > 0) {
    const apart = Math.expm1(-2 * root * t)
    cosine = fall * (1 + apart / 2)
    sine = (fall * -apart) / (2 * root)
  }
  out[0] = cosine + d * sine
  out[1] = sine
  out[2] = -k * sine
  out[3] = cosine - d * sine
  out[4] = x
  out[5] = y
  return out
}

const free = new Float64Array(6)

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
    const q = variance * (i === first ? Math.min(1, off + 0.5) : 1), after = psi
    knot += q * psi * psi
    both += q * psi * tau
    end += q * tau * tau
    push[2 * i] = q * psi
    push[2 * i + 1] = q * tau
    variance *= fall
    psi = twice * psi - before
    before = after
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
      old = z
      z = young
    }
  }
  const turned = nu > 0 ? Math.sin(nu) / law.apart : h
  fill(C, begin, next, 0, (begin * following - next * tau) / end)
  fill(D, 0, turned, 0, (-turned * tau) / end)
  fill(R, 0, 0, 1 / own, -share / own)
  rows[C] = rows[D + 1] = 1

  // o is linear between samples; q′ jumps against its bends.
  const [stay, go, pull, slow] = swing(law, h, free)
  let q = 0, speed = 0, slope = 0, place = 0
  for (let i = 0, at = moved; i <= last; i++, at += row) {
    rows[at] = place + q
    rows[at + 1] = speed + slope
    const to = smooth((i + 1 - last + n) / n), rise = (to - place) / h, jumped = speed - (rise - slope), were = q
    q = stay * were + go * jumped
    speed = pull * were + slow * jumped
    place = to
    slope = rise
  }
  return rows
}

/** The wind-up table of a gap. A few are kept; those of long gaps are all the same. */
function tableOf(law, span) {
  const { tables } = law, key = Math.min(span, law.windUp)
  for (const table of tables) if (table.key === key) return table
  if (tables.length === 16) tables.shift()
  let n = law.count, h = law.windUp / n
  if (!(span - law.windUp > 1e-9 * law.windUp)) {
    n = Math.max(law.least, Math.ceil(span / h - 1e-9))
    h = span / n
  }
  const rows = makeRows(law, n, h)
  if (law.isRefined) { // the error is of second order: that of half the step is a quarter
    const half = makeRows(law, 2 * n, h / 2)
    for (let i = 0; i < rows.length; i++) rows[i] = (4 * half[2 * i - (i % row)] - rows[i]) / 3
  }
  const table = { key, h, last: Math.ceil(n - 1e-9), rows }
  tables.push(table)
  return table
}

/** Where the numbers of a state count: for the value, for the speed; then those of the pushes for Im w and its speed, and how much of its move o has made. */
export const weight = { value: new Float64Array(members), speed: new Float64Array(members), pushed: 0, pushedSpeed: 0, moved: 0 }

/** A cubic from a row to the next: value and speed to the weights of a number. */
function setBetween(rows, at, u, h, m) {
  const a = rows[at], slope = h * rows[at + 1], end = h * rows[at + row + 1], step = rows[at + row] - a
  const square = 3 * step - 2 * slope - end, cube = slope + end - 2 * step
  weight.value[m] = a + u * (slope + u * (square + u * cube))
  weight.speed[m] = (slope + u * (2 * square + u * 3 * cube)) / h
}

/** Such a cubic times what is left of w, for both of its parts. */
function setTurning(rows, at, u, h, first) {
  const { value, speed } = weight
  setBetween(rows, at, u, h, 6)
  const z = value[6], slope = speed[6]
  for (let m = 0; m < 2; m++) {
    speed[first + m] = speed[4 + m] * z + value[4 + m] * slope
    value[first + m] = value[4 + m] * z
  }
}

/** Sets the weights for t seconds after a key; `span` seconds lie between that and the next one (Infinity: there is none). */
export function setWeights(law, t, span) {
  const { decay, turn } = law, { value, speed } = weight, table = t > span - law.windUp * (1 + 1 / law.count) ? tableOf(law, span) : null
  const at = table ? (t - span) / table.h + table.last : -1
  swing(law, t, free)
  const x = free[4], y = free[5]
  value[0] = 1
  value[2] = free[0]
  value[3] = free[1]
  speed[2] = free[2]
  speed[3] = free[3]
  value[4] = x
  value[5] = -y
  speed[4] = -decay * x - turn * y
  speed[5] = decay * y - turn * x
  value[1] = speed[1] = weight.pushed = weight.pushedSpeed = weight.moved = 0
  for (let m = 6; m < members; m++) value[m] = speed[m] = 0
  if (!(at >= 0)) return
  const { h, last, rows } = table, i = Math.min(last - 1, Math.floor(at)), u = at - i
  setTurning(rows, row * i + D, u, h, 7)
  setTurning(rows, row * i + C, u, h, 4)
  setBetween(rows, row * i + moved, u, h, 1)
  setBetween(rows, row * i + R, u, h, 6)
  const rest = Math.exp(decay * (span - t)), cosine = rest * Math.cos(turn * (t - span)), sine = rest * Math.sin(turn * (t - span)), z = value[6], slope = speed[6]
  value[6] = cosine * z
  speed[6] = cosine * slope - (decay * cosine + turn * sine) * z
  weight.pushed = sine * z
  weight.pushedSpeed = sine * slope - (decay * sine - turn * cosine) * z
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
  const { rows, last } = tableOf(law, span), end = row * last, next = []
  const [fromQ, fromV, speedQ, speedV, x, y] = swing(law, span, free)
  for (let i = 0, at = 0; i < values.length; i++, at += members) {
    const o = state[at], q = state[at + 2], v = state[at + 3], re = state[at + 4], im = state[at + 5]
    const rests = settles ? values[i] : o, move = rests - o, to = fromQ * q + fromV * v + move * (rows[end + moved] - 1)
    const comes = rows[end + C] * re + rows[end + D] * state[at + 7], turned = rows[end + C] * im + rows[end + D] * state[at + 8], arrives = x * comes - y * turned, wanted = values[i] - rests - to
    state[at + 1] = move
    state[at + 6] = wanted - arrives
    next.push(rests, 0, to, speedQ * q + speedV * v + move * rows[end + moved + 1], wanted, y * comes + x * turned, 0, 0, 0)
  }
  return next
}
