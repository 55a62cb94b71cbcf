/** Several properties at once, one number each. */
export type Numbers = readonly number[] | Float32Array | Float64Array
export type Value = number | Numbers

/** A time in seconds and the value there; in order of time. */
export type Key<V extends Value = number> = readonly [time: number, value: V]
export type Keys<V extends Value = number> = readonly Key<V>[] | (V extends number ? readonly (readonly number[])[] : never)

type Without<Names extends string> = { [name in Names]?: undefined }

/** How the spring feels, said in one of three ways; the latter two as Motion and react-spring mean them, a duration in seconds. */
export type Feel =
  | ({ frequency?: number; damping?: number } & Without<'stiffness' | 'mass' | 'bounce' | 'duration'>)
  | ({ stiffness: number; damping: number; mass?: number } & Without<'frequency' | 'bounce' | 'duration'>)
  | ({ bounce?: number; duration?: number } & Without<'frequency' | 'damping' | 'stiffness' | 'mass'>)

/** What retarget() may change. */
export type Changes = Feel & {
  /** How long before a key the motion turns to it, in periods of its frequency; 0.5 by default. */
  windUp?: number
  /** Whether keys move the place where the spring rests, all of them or one each; true by default. Else the motion only passes through. */
  settles?: boolean | readonly boolean[]
  /** The spring has settled when its swing stays below this part of the keys' range; 0.001 by default. */
  rest?: number
  /** Samples per second of the motion before keys; enough by default. */
  rate?: number
}

export type Options<V extends Value = number> = Changes & {
  /** At the start, per second; 0 by default. */
  velocity?: V | 0
} & (
    | ({ keys: Keys<V> } & Without<'from' | 'to'>) // begins at the first and rests at the last
    | { from: V; to: V; keys?: Keys<V> } // begins at 0 s
    | ({ from: V; keys: Keys<V> } & Without<'to'>)
  )

export interface Spring<V extends number | number[] = number> {
  /** Seconds until it has settled; Infinity without damping. */
  readonly duration: number
  /** The value at a time in seconds. An `out` receives the values of several properties. */
  at(time: number): V
  at<Out extends { [i: number]: number }>(time: number, out: Out): V extends number ? V : Out
  /** The speed there, per second. */
  velocity(time: number): V
  velocity<Out extends { [i: number]: number }>(time: number, out: Out): V extends number ? V : Out
  /** A new spring whose time 0 is `time` of this one. It goes on with the same value and speed, to a value or through keys after 0. */
  retarget(time: number, to: V extends number ? number | Keys<number> : Numbers | Keys<Numbers>, changes?: Changes): Spring<V>
  /**
   * A CSS linear() easing of `duration` seconds, from the first value (0) to where the spring rests (1); of several properties one each.
   * @param error largest difference, as a part of the range; 0.005 by default
   * @param range values for 0 and 1 instead of those
   */
  linear(error?: number, range?: readonly [from: number, to: number]): V extends number ? string : string[]
}

export function spring(options: Options<number>): Spring<number>
export function spring(options: Options<Numbers>): Spring<number[]>
export function spring(options: Options<number> | Options<Numbers> | Options<number[]>): Spring<number> | Spring<number[]>
