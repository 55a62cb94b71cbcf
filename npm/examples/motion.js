import { animate } from 'motion'
import { spring } from 'wiggly'

const s = spring({ keys: [[0, 0], [0.4, 200], [1.2, 60]], frequency: 2, damping: 0.2 })
const box = document.querySelector('main')
box.innerHTML = '<div id="box"></div>'
animate('#box', { x: [0, 60] }, { duration: s.duration, ease: (part) => s.at(part * s.duration) / 60 })
