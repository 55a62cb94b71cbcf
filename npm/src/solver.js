// The solver: two builds of one wasm module, with SIMD and without, packed as one (pack.py) and unpacked by a third, so
// that nothing needs to be fetched and nothing has to be awaited.
import { lengths, packed, unpacker } from './wasm.js'

/** A module that is valid only where there is SIMD: it returns i8x16.splat(0). */
const simd = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 8, 1, 6, 0, 65, 0, 253, 15, 11)
const beyond = 'spring: these keys are beyond what can be solved'

const instance = (bytes, imports) => {
  const module = new WebAssembly.Module(bytes), env = {}
  for (const { name } of WebAssembly.Module.imports(module)) env[name] = imports(name)
  return new WebAssembly.Instance(module, { env }).exports
}

function bytes(text, to) {
  for (let i = 0; i < text.length; i++) to[i] = text.charCodeAt(i)
  return to
}

function load(plain) {
  const code = atob(unpacker), data = atob(packed), { memory, unpack_from: begin, unpack } = instance(bytes(code, new Uint8Array(code.length)))
  bytes(data, new Uint8Array(memory.buffer, begin()))
  const [fast, slow] = lengths, at = unpack(plain ? fast + slow : fast)
  const absent = () => { throw new RangeError(beyond) }
  return instance(new Uint8Array(memory.buffer, plain ? at + fast : at, plain ? slow : fast),
    (name) => name === 'variation_is_set' ? () => 0 : Math[name.replace('js_', '')] ?? absent)
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
  if (!wasm) start()
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
