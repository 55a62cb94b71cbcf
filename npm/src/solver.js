// The solver: two builds of one wasm module, with SIMD and without, packed as one (pack.py) and unpacked here, so that nothing needs to be
// fetched and nothing has to be awaited.
import { packed, lengths } from './wasm.js'

/** Unpacks LZMA with lc = 3, lp = pb = 0 until `to` is full. */
function unpack(from, to) {
  const odds = (count) => new Uint16Array(count).fill(1024)
  const lists = (count, size) => Array.from({ length: count }, () => odds(size))
  const isMatch = odds(12), isRep = lists(4, 12), isLong = odds(12), literals = lists(8, 768), slots = lists(4, 64)
  const special = odds(128), align = odds(16), sizes = [0, 1].map(() => [odds(2), odds(8), odds(8), odds(256)])
  let place = 5, range = -1, value = (from[1] << 24) | (from[2] << 16) | (from[3] << 8) | from[4] // both unsigned
  const bit = (list, i) => {
    const odd = list[i], bound = Math.imul(range >>> 11, odd), set = value >>> 0 >= bound >>> 0
    list[i] = set ? odd - (odd >> 5) : odd + ((2048 - odd) >> 5)
    range = set ? (range - bound) | 0 : bound
    if (set) value = (value - bound) | 0
    if (range >>> 24 === 0) {
      range <<= 8
      value = (value << 8) | from[place++]
    }
    return set ? 1 : 0
  }
  /** Bits from the highest on, each by what came before; or from the lowest on. */
  const tree = (list, count) => {
    let at = 1
    for (let i = 0; i < count; i++) at = 2 * at + bit(list, at)
    return at - (1 << count)
  }
  const reverse = (list, count, offset) => {
    let sum = 0
    for (let i = 0, at = 1; i < count; i++) {
      const next = bit(list, offset + at)
      at = 2 * at + next
      sum += next << i
    }
    return sum
  }
  const plain = (count) => {
    let sum = 0
    for (let i = 0; i < count; i++) {
      range >>>= 1
      const set = value >>> 0 >= range
      if (set) value = (value - range) | 0
      sum = 2 * sum + (set ? 1 : 0)
      if (range >>> 24 === 0) {
        range <<= 8
        value = (value << 8) | from[place++]
      }
    }
    return sum
  }
  const length = ([choice, low, middle, high]) => 2 + (!bit(choice, 0) ? tree(low, 3) : !bit(choice, 1) ? 8 + tree(middle, 3) : 16 + tree(high, 8))
  const distance = (count) => {
    const slot = tree(slots[Math.min(count - 2, 3)], 6), bits = (slot >> 1) - 1
    if (slot < 4) return slot + 1
    const base = (2 + (slot & 1)) * 2 ** bits
    return 1 + base + (slot < 14 ? reverse(special, bits, base - slot) : plain(bits - 4) * 16 + reverse(align, 4, 0))
  }
  let state = 0, back = [1, 1, 1, 1]
  for (let end = 0; end < to.length;) {
    if (!bit(isMatch, state)) {
      const list = literals[end ? to[end - 1] >> 5 : 0]
      let at = 1
      for (let match = to[end - back[0]], same = state > 6 ? 1 : 0; at < 256;) {
        const expected = (match >> 7) & 1, next = bit(list, same ? 256 * (1 + expected) + at : at)
        if (expected !== next) same = 0
        match <<= 1
        at = 2 * at + next
      }
      to[end++] = at
      state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6
      continue
    }
    let count = 0
    if (!bit(isRep[0], state)) {
      count = length(sizes[0])
      back = [distance(count), ...back.slice(0, 3)]
      state = state < 7 ? 7 : 10
    } else {
      const which = !bit(isRep[1], state) ? 0 : !bit(isRep[2], state) ? 1 : 2 + bit(isRep[3], state)
      const short = which === 0 && !bit(isLong, state)
      back = [...back.splice(which, 1), ...back]
      count = short ? 1 : length(sizes[1])
      state = (short ? 9 : 8) + (state < 7 ? 0 : short ? 2 : 3)
    }
    while (count--) to[end] = to[end++ - back[0]]
  }
  return to
}

/** A module that is valid only where there is SIMD: (func (result v128) (i8x16.splat (i32.const 0))). */
const simd = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 8, 1, 6, 0, 65, 0, 253, 15, 11)
const beyond = 'spring: these keys are beyond what can be solved'

function load(plain) {
  const text = atob(packed), from = new Uint8Array(text.length), [fast, slow] = lengths
  for (let i = 0; i < text.length; i++) from[i] = text.charCodeAt(i)
  const module = new WebAssembly.Module(unpack(from, new Uint8Array(plain ? fast + slow : fast)).subarray(plain ? fast : 0))
  const env = { variation_is_set: () => 0 }
  for (const { name } of WebAssembly.Module.imports(module)) {
    env[name] ??= Math[name.replace('js_', '')] ?? (() => { throw new RangeError(beyond) })
  }
  return new WebAssembly.Instance(module, { env }).exports
}

let wasm
/** Loads the solver: `plain` without SIMD. */
export const start = (plain = !WebAssembly.validate(simd)) => { wasm = load(plain) }

/**
 * The curve through keys: a value and a slope per sample, for every sample up to the last key.
 * @param {number[]} times from 0 on
 * @param {number[][]} columns the values of each property
 * @param {number[]} speeds at time 0
 */
export function solve(times, columns, speeds, rate, frequency, damping) {
  wasm ?? start()
  const keys = times.length, last = Math.floor(times[keys - 1] * rate + 0.5)
  const room = wasm.spring_room(keys, last + 2)
  if (!room) throw new RangeError(`spring: ${last} samples are more than memory holds`)
  const memory = new Float64Array(wasm.memory.buffer, room, 2 * keys + 2 * (last + 1))
  memory.set(times)
  return columns.map((values, column) => {
    memory.set(values, keys)
    if (wasm.spring_solve(rate, frequency, damping, speeds[column])) throw new RangeError(beyond)
    return memory.slice(2 * keys)
  })
}
