// The package's solver against the library's vectors (tests/vectors, exact to 60 digits) of its kind: complex, wound up, of constant
// parameters, through plain knots. WIGGLY_NPM is the package's folder.
import assert from 'node:assert/strict'
import { readdirSync, readFileSync } from 'node:fs'
import { test } from 'node:test'

const { members, setWeights, solveGap, springLaw, weight } = await import(`${process.env.WIGGLY_NPM}/solver.js`)
const folder = new URL('../../tests/vectors/', import.meta.url)

const isPlain = ({ frame, value, settles, ...rest }) => value !== undefined && !Object.keys(rest).length
const isOurs = ({ mode = 'complex', passive = 'oscillator', start, frequency, damping = 0, equilibrium = 0, wind_up, knots = [] }) =>
  mode === 'complex' && passive === 'oscillator' && start !== 'loop' && wind_up > 0 && equilibrium === 0 && frequency > 0 && typeof damping === 'number' && knots.every(isPlain)

/** The total at each sample. */
function* totals({ fps = 24, substeps = 1, frames }, { frequency, damping = 0, bandwidth = 0.1, wind_up, start, knots }) {
  const rate = fps * substeps, count = Math.max(1, (wind_up / frequency) * rate), law = springLaw(frequency, damping, bandwidth, count / rate, count, 1, false)
  const keys = knots.map(({ frame, value, settles = false }) => ({ sample: Math.floor((frame - frames[0]) * substeps + 0.5), value, settles })).sort((a, b) => a.sample - b.sample)
  const [first] = keys, o = first.settles ? first.value : 0, rests = start === 'rest' && first.sample > 1
  const states = [rests ? new Array(members).fill(0) : [o, 0, 0, 0, first.value - o, 0, 0, 0, 0, 0]], samples = [rests ? 0 : first.sample]
  for (const { sample, value, settles } of rests ? keys : keys.slice(1)) {
    states.push(solveGap(law, states.at(-1), (sample - samples.at(-1)) / rate, [value], settles))
    samples.push(sample)
  }
  for (let i = 0; i <= (frames[1] - frames[0]) * substeps; i++) {
    const gap = Math.max(0, samples.findLastIndex((sample) => sample <= i))
    setWeights(law, Math.max(0, i - samples[gap]) / rate, ((samples[gap + 1] ?? Infinity) - samples[gap]) / rate)
    yield states[gap].reduce((sum, number, m) => sum + number * weight.value[m], 0)
  }
}

let met = 0
for (const name of readdirSync(folder).filter((name) => /^(wind|settles)_.*json$/.test(name))) {
  const scene = JSON.parse(readFileSync(new URL(name, folder)))
  const table = readFileSync(new URL(name.replace('.json', '.csv'), folder), 'utf8').trim().split('\n').slice(1).map((row) => row.split(',').map(Number))
  scene.splines.forEach((spline, i) => isOurs(spline) && test(`${name}, ${spline.name}`, () => {
    const exact = table.map((row) => row[1 + 3 * i]), size = Math.max(...exact.map(Math.abs)), ours = [...totals(scene, spline)]
    assert.equal(ours.length, exact.length)
    ours.forEach((value, n) => assert.ok(Math.abs(value - exact[n]) <= 1e-9 * size, `sample ${n}: ${value}, not ${exact[n]}`))
    met++
  }))
}

test('there are at least as many as the library has', () => assert.ok(met >= 20, `${met}`))
