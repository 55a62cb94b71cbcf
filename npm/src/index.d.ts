/** One number, or several properties at once. */
export type Value = number | readonly number[] | Float32Array | Float64Array

/** A time in seconds and the value there. */
export type Key<V extends Value = number> = readonly [time: number, value: V]

export interface Options<V extends Value = number> {
  /** In order of time; at least one. The spring begins at the first, passes through each and settles at the last. */
  keys: readonly Key<V>[]
  /** Of its swing, Hz; 2 by default. */
  frequency?: number
  /** 0 swings on, 1 is critical, more creeps; 0.3 by default. */
  damping?: number
  /** Speed at the first key, per second; 0 by default. */
  velocity?: V
  /** The spring has settled when its swing stays below this part of the keys' range; 0.001 by default. */
  rest?: number
  /** Samples per second; by default 120, and more for fast springs and close keys. */
  rate?: number
}

export interface Spring<V = number, S = string> {
  /** Seconds until it has settled; Infinity without damping. */
  readonly duration: number
  /** The value at a time in seconds. An `out` receives the values of several properties. */
  at(time: number, out?: V): V
  /** The speed there, per second. */
  velocity(time: number, out?: V): V
  /**
   * A new spring, whose time 0 is `time` of this one: it goes on with the same value and speed, through keys that all
   * come after 0.
   */
  retarget(time: number, keys: readonly Key<V extends number ? number : Value>[], options?: Partial<Omit<Options, 'keys' | 'velocity'>>): Spring<V, S>
  /**
   * A CSS linear() easing of `duration` seconds, from the first key (0) to the last (1), with few stops; of several
   * properties one each.
   * @param error largest difference, as a part of the range; 0.005 by default
   * @param range values for 0 and 1 instead of the first and the last key
   */
  linear(error?: number, range?: readonly [from: number, to: number]): S
}

export function spring(options: Options<number>): Spring<number, string>
export function spring(options: Options<readonly number[] | Float32Array | Float64Array>): Spring<number[], string[]>
