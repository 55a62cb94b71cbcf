// How long springs take: node bench.mjs PACKAGE, the least of many runs.
const [, , folder] = process.argv
const { spring } = await import(`${folder}/index.js`)

function least(name, unit, scale, times, run) {
  let best = Infinity
  for (let round = 0; round < 50; round++) {
    const begin = performance.now()
    for (let i = 0; i < times; i++) run(i)
    best = Math.min(best, (performance.now() - begin) / times)
  }
  console.log(`${name}: ${(best * scale).toFixed(unit === 'ns' ? 0 : 1)} ${unit}`)
}

const begin = performance.now()
spring({ keys: [[0, 0], [1, 1]] })
console.log(`the first spring, which loads the solver: ${(performance.now() - begin).toFixed(1)} ms`)
const s = spring({ keys: [[0, 0], [0.4, 1], [1.2, 0.3]] }), out = new Float64Array(1000)
const many = spring({ keys: [[0, out], [0.4, out.map((_, i) => i)], [1.2, out]] })
let sum = 0
least('at() before the last key', 'ns', 1e6, 10000, (i) => { sum += s.at(i * 1e-4) })
least('at() after it', 'ns', 1e6, 10000, (i) => { sum += s.at(1.2 + i * 1e-4) })
least('at() of 1,000 properties', 'us', 1e3, 100, (i) => many.at(i * 0.01, out))
for (const [name, last] of [['on samples', 4], ['between samples', 3.9987]]) {
  least(`create, 4 s at 120 Hz, keys ${name}`, 'us', 1e3, 100, () => spring({ keys: [[0, 0], [last / 4, 1], [last, 0.3]], rate: 120 }))
}
least('create, 1.2 s', 'us', 1e3, 100, () => spring({ keys: [[0, 0], [0.4, 1], [1.2, 0.3]] }))
least('linear(0.01)', 'us', 1e3, 20, () => s.linear(0.01))
if (!sum) process.exit(1)
