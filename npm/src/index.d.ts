/** Several properties at once, one number each. */
export type Numbers = readonly number[] | Float32Array | Float64Array

/** One number, or several properties at once. */
export type Value = number | Numbers

/** A time in seconds and the value there. */
export type Key<V extends Value = number> = readonly [time: number, value: V]

/** In order of time. */
export type Keys<V extends Value = number> = readonly Key<V>[] | (V extends number ? readonly (readonly number[])[] : never)

interface Common {
  /** How long before a key the motion turns to it, in periods of its frequency; 0.5 by default. */
  windUp?: number
  /** Whether keys move the place where the spring rests, all of them or one each; true by default. Else the motion only passes through. */
  settles?: boolean | readonly boolean[]
  /** How far the frequency may give way before a key, as a part of itself; 0.1 by default. */
  bandwidth?: number
  /** The spring has settled when its swing stays below this part of the keys' range; 0.001 by default. */
  rest?: number
  /** Samples per second of the motion before keys; more than enough by default. */
  rate?: number
}

/** How the spring feels, said in one of three ways. */
export type Feel =
  | {
      /** Of its swing, Hz; 2 by default. */
      frequency?: number
      /** 0 swings on, 1 is critical, more creeps; 0.3 by default. */
      damping?: number
      stiffness?: undefined; mass?: undefined; bounce?: undefined; duration?: undefined
    }
  | {
      /** As in Motion and react-spring. */
      stiffness: number
      damping: number
      /** 1 by default. */
      mass?: number
      frequency?: undefined; bounce?: undefined; duration?: undefined
    }
  | {
      /** As in Motion: -1 to 1; 0.3 by default. */
      bounce?: number
      /** As in Motion: seconds; 0.8 by default. */
      duration?: number
      frequency?: undefined; damping?: undefined; stiffness?: undefined; mass?: undefined
    }

/** What retarget() may change. */
export type Changes = Common & Feel

export type Options<V extends Value = number> = Changes & {
  /** Speed at the start, per second; 0 by default. */
  velocity?: V | 0
} & (
    | {
        /** The spring begins at the first, passes through each and rests at the last. */
        keys: Keys<V>
        from?: undefined; to?: undefined
      }
    | {
        /** The value at 0 s. */
        from: V
        /** Where it rests from then on. */
        to: V
        /** After 0 s. */
        keys?: Keys<V>
      }
    | { from: V; to?: undefined; keys: Keys<V> }
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
  /**
   * A new spring, whose time 0 is `time` of this one: it goes on with the same value and speed, to a value or through keys that all come
   * after 0.
   */
  retarget(time: number, to: V extends number ? number | Keys<number> : Numbers | Keys<Numbers>, changes?: Changes): Spring<V>
  /**
   * A CSS linear() easing of `duration` seconds, from the first value (0) to where the spring rests (1), with few stops; of several
   * properties one each.
   * @param error largest difference, as a part of the range; 0.005 by default
   * @param range values for 0 and 1 instead of those
   */
  linear(error?: number, range?: readonly [from: number, to: number]): V extends number ? string : string[]
}

export function spring(options: Options<number>): Spring<number>
export function spring(options: Options<Numbers>): Spring<number[]>
export function spring(options: Options<number> | Options<Numbers> | Options<number[]>): Spring<number> | Spring<number[]>
