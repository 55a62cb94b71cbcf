import { BoxGeometry, Mesh, MeshNormalMaterial, OrthographicCamera, Scene, WebGLRenderer } from 'three'
import { spring } from 'wiggly'

const s = spring({ keys: [[0, [0, 0, 0]], [0.4, [200, 80, 0]], [1.2, [60, 0, 0]]], frequency: 2, damping: 0.2 })
const renderer = new WebGLRenderer({ antialias: true }), scene = new Scene(), place = [0, 0, 0]
const camera = new OrthographicCamera(-100, 400, 150, -150, -500, 500)
const box = new Mesh(new BoxGeometry(60, 60, 60), new MeshNormalMaterial())
scene.add(box)
renderer.setSize(500, 300)
document.querySelector('main').append(renderer.domElement, document.createElement('output'))
renderer.render(scene, camera) // its first picture takes long
const begin = performance.now()
renderer.setAnimationLoop((now) => {
  box.position.fromArray(s.at((now - begin) / 1000, place))
  document.querySelector('output').value = box.position.x.toFixed(2)
  renderer.render(scene, camera)
})
