// One motion, shown by each library: npm install && npm start, then index.html?motion and so on.
import { animated, useSpring } from '@react-spring/web'
import { Player } from '@remotion/player'
import { animate } from 'motion'
import { createRoot } from 'react-dom/client'
import { useCurrentFrame } from 'remotion'
import * as THREE from 'three'
import { spring } from 'wiggly'

const feel = { frequency: 2, damping: 0.2 }, s = spring({ keys: [[0, 0], [0.4, 200], [1.2, 60]], ...feel })
const ease = (part) => s.at(part * s.duration) / 60, main = document.querySelector('main')

const pages = {
  /** A click anywhere sends the box there, with the speed that it has. */
  waapi() {
    const box = document.querySelector('#box')
    let now, animation
    function play(next) {
      now = next
      const from = now.at(0), easing = now.linear(0.002, [from, from + 100])
      animation?.cancel()
      animation = box.animate({ translate: [`${from}px`, `${from + 100}px`] }, { duration: 1000 * now.duration, easing })
      box.style.translate = `${now.at(Infinity)}px` // where it stays
    }
    play(s)
    addEventListener('click', (event) => {
      const time = animation.playState === 'running' ? animation.currentTime / 1000 : now.duration
      play(now.retarget(time, [[0.3, event.clientX - 50]]))
    })
  },

  motion: () => animate('#box', { x: [0, 60] }, { duration: s.duration, ease }),

  'react-spring'() {
    const Box = () => <animated.div id="box" style={useSpring({ from: { x: 0 }, to: { x: 60 }, config: { duration: 1000 * s.duration, easing: ease } })} />
    createRoot(main).render(<Box />)
  },

  remotion() {
    const fps = 60, size = { fps, durationInFrames: Math.ceil(fps * s.duration), compositionWidth: 400, compositionHeight: 100 }
    const Box = () => <div id="box" style={{ translate: `${s.at(useCurrentFrame() / fps)}px` }} />
    createRoot(main).render(<Player component={Box} {...size} autoPlay initiallyMuted moveToBeginningWhenEnded={false} acknowledgeRemotionLicense />)
  },

  three() {
    const through = spring({ keys: [[0, [0, 0, 0]], [0.4, [200, 80, 0]], [1.2, [60, 0, 0]]], ...feel }), place = [0, 0, 0]
    const renderer = new THREE.WebGLRenderer({ antialias: true }), scene = new THREE.Scene(), output = document.createElement('output')
    const camera = new THREE.OrthographicCamera(-100, 400, 150, -150, -500, 500)
    const box = new THREE.Mesh(new THREE.BoxGeometry(60, 60, 60), new THREE.MeshNormalMaterial())
    scene.add(box)
    renderer.setSize(500, 300)
    main.replaceChildren(renderer.domElement, output)
    renderer.render(scene, camera) // its first picture takes long
    const begin = performance.now()
    renderer.setAnimationLoop((now) => {
      box.position.fromArray(through.at((now - begin) / 1000, place))
      output.value = box.position.x.toFixed(2)
      renderer.render(scene, camera)
    })
  },
}

pages[location.search.slice(1) || 'waapi']()
