import { animated, useSpring } from '@react-spring/web'
import { createRoot } from 'react-dom/client'
import { spring } from 'wiggly'

const s = spring({ keys: [[0, 0], [0.4, 200], [1.2, 60]], frequency: 2, damping: 0.2 })
const config = { duration: 1000 * s.duration, easing: (part) => s.at(part * s.duration) / 60 }

function Box() {
  const { x } = useSpring({ from: { x: 0 }, to: { x: 60 }, config })
  return <animated.div id="box" style={{ x }} />
}

createRoot(document.querySelector('main')).render(<Box />)
