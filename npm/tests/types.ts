// Compiled by tsc --strict, never run.
import { spring, type Spring, type Options } from 'wiggly'

const options: Options = { keys: [[0, 0], [0.4, 1], [1.2, 0.3]], frequency: 2, damping: 0.2 }
const one: Spring = spring(options)
const value: number = one.at(0.5) + one.velocity(0.5) + one.duration
const easing: string = one.linear(0.01, [0, 1])
const next: Spring = one.retarget(0.5, [[0.3, 2]], { damping: 1 }).retarget(0.1, 3)

const many = spring({ keys: [[0, [0, 0]], [1, new Float64Array(2)]], velocity: [1, 2], settles: [true, false] })
const values: number[] = many.at(0.5)
const filled: Float32Array = many.at(0.5, new Float32Array(2))
const easings: string[] = many.linear()
const moved = many.retarget(0.5, [[1, [2, 3]]]).retarget(0.5, [4, 5])

const inferred = { keys: [[0, 0], [1, 1]], frequency: 3 }
const loose: number = spring(inferred).at(0.5)
declare const either: Options<number> | Options<number[]>
const any: number | number[] = spring(either).at(0.5)

const pair: number[] = spring({ from: [0, 0], to: [1, 2], stiffness: 170, damping: 26 }).at(0.5)
const single: number = spring({ from: 0, to: 1, velocity: 3, bounce: 0.2, duration: 0.5, keys: [[1, 2]] }).at(0.5)

// @ts-expect-error: keys are needed
spring({ frequency: 2 })
// @ts-expect-error: one number at first, an array later
spring({ keys: [[0, 0], [1, [1, 2]]] })
// @ts-expect-error: a time is a number
one.at('0.5')
// @ts-expect-error: two numbers, not one
many.retarget(0.2, [[0.5, 3]])
// @ts-expect-error: no such option
spring({ from: 0, to: 1, tension: 170 })
// @ts-expect-error: two ways at once
spring({ from: 0, to: 1, stiffness: 170, damping: 26, bounce: 0.2 })
