// Evaluates a clip of a .glb (CLIP in the environment, else the first) in three.js at ten of its keys and compares every vertex with
// point caches of the same rigs, one after the other. Usage: node three.mjs FOLDER-WITH-node_modules file.glb rig.pc2... Exit status 1 if anything is more than 1e-5 of the size away.
import { readFileSync } from 'fs';
import { resolve } from 'path';
import { readCache } from './pc2.mjs';

const [folder, file, ...cachePaths] = process.argv.slice(2);
const modules = resolve(folder, 'node_modules');
globalThis.self = globalThis; // which the loader asks for, outside of a browser
const THREE = await import(modules + '/three/build/three.module.js');
const { GLTFLoader } = await import(modules + '/three/examples/jsm/loaders/GLTFLoader.js');

const bytes = readFileSync(file);
const gltf = await new GLTFLoader().parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), '');
const meshes = [];
gltf.scene.traverse((object) => object.isMesh && meshes.push(object));
const caches = cachePaths.map(readCache), mixer = new THREE.AnimationMixer(gltf.scene);
const clip = process.env.CLIP ? gltf.animations.find((a) => a.name === process.env.CLIP) : gltf.animations[0];
const action = mixer.clipAction(clip).setLoop(THREE.LoopOnce);
action.clampWhenFinished = true;
action.play();

let largest = 0;
const place = new THREE.Vector3(), expected = new THREE.Vector3(), box = new THREE.Box3();
for (let n = 0; n < 10; n++) {
  const key = Math.round((n * (caches[0].frames - 1)) / 9);
  action.paused = false;
  action.time = (clip.duration * key) / (caches[0].frames - 1);
  mixer.update(0);
  gltf.scene.updateMatrixWorld(true);
  let next = 0;
  const all = caches.flatMap((cache) => Array.from({ length: cache.vertices }, (_, v) => cache.at(key, v)));
  for (const mesh of meshes) { // a mesh of several materials comes as several
    if (mesh.skeleton) mesh.skeleton.update();
    for (let v = 0; v < mesh.geometry.attributes.position.count; v++) {
      mesh.getVertexPosition(v, place); // in the node, where its cache stands
      expected.fromArray(all[next++]);
      box.expandByPoint(expected);
      largest = Math.max(largest, place.distanceTo(expected));
    }
  }
  if (next !== all.length) throw new Error('vertices are missing');
}
const size = box.getSize(place).length(), good = largest <= 1e-5 * size;
console.log(`three.js ${THREE.REVISION}: at most ${largest.toExponential(1)} m off, ${(largest / size).toExponential(1)} of the size`);
process.exit(good ? 0 : 1);
