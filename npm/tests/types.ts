// Compiled by tsc --strict, never run.
import { spring, type Spring, type Options } from 'wiggly'

const options: Options = { keys: [[0, 0], [0.4, 1], [1.2, 0.3]], frequency: 2, damping: 0.2 }
const one: Spring = spring(options)
const value: number = one.at(0.5) + one.velocity(0.5) + one.duration
const easing: string = one.linear(0.01, [0, 1])
const next: Spring = one.retarget(0.5, [[0.3, 2]], { damping: 1 })

const many = spring({ keys: [[0, [0, 0]], [1, new Float64Array(2)]], velocity: [1, 2] })
const values: number[] = many.at(0.5)
const easings: string[] = many.linear()
const moved = many.retarget(0.5, [[1, [2, 3]]])

// @ts-expect-error: keys are needed
spring({ frequency: 2 })
// @ts-expect-error: one number at first, an array later
spring({ keys: [[0, 0], [1, [1, 2]]] })
// @ts-expect-error: a time is a number
one.at('0.5')

export { value, easing, next, values, easings, moved }
