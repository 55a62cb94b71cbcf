// What a spring is given: read, or refused with one sentence.
import { springLaw } from './solver.js'

/** Refuses with one sentence. */
export const fail = (Kind, sentence) => { throw new Kind(`spring: ${sentence}`) }

export const kindOf = (value) => (value === null ? 'null' : typeof value)

export function number(name, value, low = -Infinity, high = Infinity) {
  if (typeof value !== 'number') fail(TypeError, `${name}: expected a number, got ${kindOf(value)}`)
  if (!(value >= low && value <= high && Math.abs(value) < Infinity)) {
    fail(RangeError, `${name}: expected ${high < Infinity ? `${low} to ${high}` : low > -Infinity ? `${low} or more` : 'a finite number'}, got ${value}`)
  }
  return value
}

/** A value of `size` numbers, as a list of its own. */
export function numbers(name, value, size) {
  const list = typeof value === 'number' ? [value] : Array.isArray(value) || ArrayBuffer.isView(value) ? Array.from(value) : null
  if (!list) fail(TypeError, `${name}: expected a number or an array of numbers, got ${kindOf(value)}`)
  if (size !== undefined && list.length !== size) fail(RangeError, `${name}: expected ${size} number${size > 1 ? 's' : ''}, got ${list.length}`)
  if (!list.length) fail(RangeError, `${name}: expected at least one number, got none`)
  list.forEach((one, i) => number(list.length > 1 ? `${name}[${i}]` : name, one))
  return list
}

/** Times and values of keys, all after a time. */
export function readKeys(keys, after, size) {
  if (!Array.isArray(keys) || !keys.length) fail(TypeError, 'keys: expected [[time, value], …], at least one key')
  return keys.map((key, i) => {
    if (!Array.isArray(key) || key.length !== 2) fail(TypeError, `keys[${i}]: expected [time, value]`)
    number(`keys[${i}][0]`, key[0])
    if (!(key[0] > after)) fail(RangeError, `keys[${i}]: expected a time after ${after}, got ${key[0]}`)
    after = key[0]
    const values = numbers(`keys[${i}][1]`, key[1], size)
    size = values.length
    return [key[0], values]
  })
}

/** Which keys settle. */
export function readSettles(settles = true, count) {
  const list = Array.isArray(settles) ? settles : new Array(count).fill(settles)
  if (list.length !== count) fail(RangeError, `settles: expected ${count} values, one a key, got ${list.length}`)
  for (const one of list) if (typeof one !== 'boolean') fail(TypeError, `settles: expected true, false or one of them a key, got ${kindOf(one)}`)
  return list
}

/** Three ways to say how a spring feels: of each number the usual one, the least and the most. */
const byFrequency = { frequency: [2, 1e-3, 1e4], damping: [0.3, 0, 100] }
const byStiffness = { stiffness: [undefined, 1e-9], damping: [undefined, 0], mass: [1, 1e-9] }
const byBounce = { bounce: [0.3, -1, 1], duration: [0.8, 0.01, 10] }
const feelNames = [...new Set([byFrequency, byStiffness, byBounce].flatMap(Object.keys))]

/** Options that retarget() may change. */
export const changeable = [...feelNames, 'windUp', 'settles', 'rest', 'rate']

export function checkNames(options, known) {
  if (options === null || typeof options !== 'object') fail(TypeError, `expected an object such as { keys: [[0, 0], [0.4, 1]] }, got ${kindOf(options)}`)
  for (const name of Object.keys(options)) if (!known.includes(name)) fail(TypeError, `${name}: no such option; there are ${known.join(', ')}`)
}

function feelOfStiffness(stiffness, damping, mass) {
  const natural = Math.sqrt(stiffness / mass)
  return [natural / (2 * Math.PI), damping / (2 * natural * mass)]
}

/** As Motion has it: at the end of `duration` a thousandth is left, of the envelope or, where nothing swings, of the critically damped spring. */
function feelOfBounce(bounce, duration) {
  const left = 1e-3, critical = 9.23341347645159, damping = bounce < 0 ? 1 / Math.max(1 + bounce, 0.05) : Math.max(1 - bounce, 0.05)
  const root = Math.sqrt(Math.abs(damping * damping - 1))
  let angle = damping < 1 ? Math.log(damping / root / left) / damping : critical
  if (damping > 1) {
    const slow = damping - root, fast = damping + root, goal = 2 * root * left
    for (let i = 0; i < 20; i++) angle += (fast * Math.exp(-slow * angle) - slow * Math.exp(-fast * angle) - goal) / (Math.exp(-slow * angle) - Math.exp(-fast * angle))
  }
  return [angle / duration / (2 * Math.PI), damping]
}

/** What a spring is made of. */
export function readLaw(options) {
  const given = feelNames.filter((name) => options[name] !== undefined), way = [byFrequency, byStiffness, byBounce].find((names) => given.every((name) => name in names))
  if (!way) fail(TypeError, `${given.join(', ')}: cannot be mixed; give frequency and damping, or stiffness, damping and mass, or bounce and duration`)
  const said = Object.entries(way).map(([name, [usual, low, high]]) => number(name, options[name] ?? usual, low, high))
  const [frequency, damping] = way === byFrequency ? said : way === byStiffness ? feelOfStiffness(...said) : feelOfBounce(...said)
  const windUp = number('windUp', options.windUp ?? 0.5, 0.01, 100), seconds = windUp / frequency
  let least = 40, count = Math.max(least, Math.ceil(80 * windUp)) // samples that keep the curve within 1e-4 of its range
  if (options.rate !== undefined) {
    const rate = number('rate', options.rate, Math.ceil(count / seconds), Math.floor(1e6 / seconds))
    least = Math.ceil((least * rate * seconds) / count)
    count = Math.ceil(rate * seconds)
  }
  const law = springLaw(frequency, damping, 0.1, seconds, count, least, true)
  law.rest = number('rest', options.rest ?? 0.001, 1e-12, 1)
  return law
}
