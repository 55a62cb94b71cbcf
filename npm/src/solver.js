// The solver, in WebAssembly that is part of the package: nothing needs to be fetched and nothing has to be awaited.
import { wasm as text } from './wasm.js'

const beyond = 'spring: these keys are beyond what can be solved'
const absent = () => { throw new RangeError(beyond) }

function load() {
  const digit = (i) => { const code = text.charCodeAt(i); return code < 58 ? code - 48 : code - 87 }
  const bytes = new Uint8Array(text.length / 2).map((_, i) => 16 * digit(2 * i) + digit(2 * i + 1))
  const module = new WebAssembly.Module(bytes)
  const env = {}
  for (const { name } of WebAssembly.Module.imports(module)) env[name] = name === 'variation_is_set' ? () => 0 : absent
  return new WebAssembly.Instance(module, { env }).exports
}

let wasm

/**
 * The curve through keys: a value and a slope per sample, for every sample up to the last key.
 * @param {number[]} times from 0 on
 * @param {number[][]} columns the values of each property
 * @param {number[]} speeds at time 0
 */
export function solve(times, columns, speeds, rate, frequency, damping) {
  wasm ??= load()
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

/** A free swing from a value and a speed, t seconds later: its value or, if `moving`, its speed. */
export function swing(value, speed, d, k, t, moving) {
  wasm ??= load()
  return wasm.spring_swing(value, speed, d, k, t, moving)
}
