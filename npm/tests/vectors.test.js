// The library's vectors (tests/vectors, exact to 60 digits) under Node: the whole solver by the compiler of the package, VECTORS_WASM.
// Tolerances are those of tests/test_vectors.c.
import assert from 'node:assert/strict'
import { readdirSync, readFileSync } from 'node:fs'
import { test } from 'node:test'

const folder = new URL('../../tests/vectors/', import.meta.url)
const names = ['frequency', 'damping', 'bandwidth', 'equilibrium'], modes = ['complex', 'real', 'cubic'], starts = ['free', 'rest', 'loop']

const module = new WebAssembly.Module(readFileSync(process.env.VECTORS_WASM)), imports = {}
for (const { module: from, name } of WebAssembly.Module.imports(module)) (imports[from] ??= {})[name] = () => assert.fail(name)
const wasm = new WebAssembly.Instance(module, imports).exports
wasm._initialize()
const numbers = (count) => new Float64Array(wasm.memory.buffer, wasm.vector_numbers(), count)

/** Total, Re x and Im x of a spline of a scene, by one of the two solvers. */
function solve(scene, spline, method) {
  const { fps = 24, substeps = 1, frames } = scene, { knots = [], mode = 'complex', start = 'free', passive = 'oscillator', calm = 1, wind_up = 0 } = spline
  const n = (frames[1] - frames[0]) * substeps + 1, values = [0, 0, 0.1, 0], tracks = []
  if ('spring' in spline || 'friction' in spline) {
    wasm.vector_spring(spline.spring ?? 0, spline.friction ?? 0)
    values.splice(0, 2, ...numbers(2))
  }
  names.forEach((name, i) => {
    if (typeof spline[name] === 'number') values[i] = spline[name]
    else if (spline[name] instanceof Float64Array) tracks[i] = spline[name]
    else if (spline[name]) tracks[i] = solve(scene, scene.splines.find((other) => other.name === spline[name].spline), method).columns[0]
  })
  const all = numbers(4 + 4 * n + 9 * knots.length).fill(0)
  all.set(values)
  tracks.forEach((track, i) => all.set(track, 4 + i * n))
  knots.forEach(({ frame, value = 0, slope, im, still = false, settles = false, stiffness = 1000 }, i) => {
    const sample = Math.floor((frame - frames[0]) * substeps + 0.5)
    all.set([sample, slope !== undefined, im !== undefined && mode === 'complex', still, value, slope ?? 0, stiffness, im ?? 0, settles].map(Number), 4 + 4 * n + 9 * i)
  })
  const used = tracks.reduce((sum, track, i) => sum + (track ? 1 << i : 0), 0)
  const status = wasm.vector_solve(n, 1 / (fps * substeps), modes.indexOf(mode), starts.indexOf(start), passive === 'filter' ? 1 : 0, calm, wind_up, knots.length, used, method)
  return { status, columns: [0, 1, 2].map((i) => numbers(3 * n).slice(i * n, (i + 1) * n)) }
}

const scenes = readdirSync(folder).filter((name) => name.endsWith('.json'))

test('there are at least as many as the library has', () => assert.ok(scenes.length >= 90))

for (const name of scenes) {
  test(name, () => {
    const scene = JSON.parse(readFileSync(new URL(name, folder)))
    const table = readFileSync(new URL(name.replace('.json', '.csv'), folder), 'utf8').trim().split('\n').slice(1).map((row) => row.split(',').map(Number))
    scene.splines.forEach((spline, i) => {
      const totals = table.map((row) => row[1 + 3 * i]), low = Math.min(...totals), high = Math.max(...totals)
      const size = Math.max(high - low, Math.abs(low), Math.abs(high)) || 1
      for (const method of [0, 1]) {
        const { status, columns } = solve(scene, spline, method)
        assert.equal(status, name === 'loop_resonant.json' && spline.name === 'x' ? 1 : 0)
        let worst = 0
        columns.forEach((column, part) => column.forEach((value, row) => { worst = Math.max(worst, Math.abs(value - table[row][1 + 3 * i + part])) }))
        assert.ok(worst <= size * (spline.mode === 'cubic' ? 1e-9 : 1e-8), `${spline.name}: off by ${worst / size} of its range`)
      }
    })
  })
}

test('a spring is the library\'s: real, about an equilibrium that goes to each key as its oscillator lets it', async () => {
  const { spring } = await import(`${process.env.WIGGLY_NPM}/index.js`)
  const keys = [[0, 0], [0.4, 1], [1.2, 0.3]], frequency = 2, damping = 0.2, rate = 2000, lag = (2 * damping) / (2 * Math.PI * frequency)
  const goal = (t) => keys.slice(1).reduce((sum, [time, value], i) => {
    const past = t - (keys[i][0] + time) / 2 // y, for which y + (2d/k) y′ is the goal
    return sum + (past > 0 ? (value - keys[i][1]) * (1 - Math.exp(-past / lag)) : 0)
  }, keys[0][1])
  const scene = { fps: rate, frames: [0, 2 * rate] }, equilibrium = Float64Array.from({ length: 2 * rate + 1 }, (_, i) => goal(i / rate))
  const knots = keys.slice(1).map(([time, value]) => ({ frame: time * rate, value }))
  const { columns: [total] } = solve(scene, { mode: 'real', start: 'rest', frequency, damping, equilibrium, knots }, 0)
  const own = spring({ keys, frequency, damping, rate: 1000 })
  total.forEach((value, i) => assert.ok(Math.abs(own.at(i / rate) - value) < 3e-5, `${i / rate} s: ${own.at(i / rate)}, not ${value}`))
})
