// Whether a chain moves its own bones alone: plays the first clip of a file and the last one of our export in three.js (without a clip:
// the rest pose) and compares the vertices at ten times. Those that follow no bone from ROOT on must stay within 1e-5 of the size; the others
// move with a clip, and stay without one.
// Usage: node kept.mjs FOLDER-WITH-node_modules in.glb out.glb ROOT
import { readFileSync } from 'fs';
import { resolve } from 'path';

const [folder, before, after, root] = process.argv.slice(2);
const modules = resolve(folder, 'node_modules');
globalThis.self = globalThis; // which the loader asks for, outside of a browser
const THREE = await import(modules + '/three/build/three.module.js');
const { GLTFLoader } = await import(modules + '/three/examples/jsm/loaders/GLTFLoader.js');

async function load(file, which) {
  const bytes = readFileSync(file);
  const gltf = await new GLTFLoader().parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), '');
  const mixer = new THREE.AnimationMixer(gltf.scene), clip = gltf.animations.at(which), meshes = [];
  const action = clip && mixer.clipAction(clip).setLoop(THREE.LoopOnce);
  if (action) action.play().clampWhenFinished = true;
  gltf.scene.traverse((object) => object.isMesh && meshes.push(object));
  const pose = (time) => {
    if (action) action.paused = false, action.time = time;
    mixer.update(0);
    gltf.scene.updateMatrixWorld(true);
    meshes.forEach((mesh) => mesh.skeleton?.update());
  };
  return { meshes, pose, seconds: clip ? clip.duration : 0 };
}

function below(bone, name) {
  return bone !== null && (bone.name === name || below(bone.parent, name));
}

const files = [await load(before, 0), await load(after, -1)], seconds = files[0].seconds || files[1].seconds;
const name = THREE.PropertyBinding.sanitizeNodeName(root), box = new THREE.Box3();
const places = [new THREE.Vector3(), new THREE.Vector3()];
let kept = 0, moved = 0, most = 0, left = 0;
for (let n = 0; n < 10; n++) {
  files.forEach((file) => file.pose((seconds * n) / 9));
  files[0].meshes.forEach((mesh, m) => {
    const skin = mesh.geometry.attributes.skinIndex, weight = mesh.geometry.attributes.skinWeight;
    for (let v = 0; v < mesh.geometry.attributes.position.count; v++) {
      files.forEach((file, f) => file.meshes[m].getVertexPosition(v, places[f]).applyMatrix4(file.meshes[m].matrixWorld));
      box.expandByPoint(places[0]);
      const chained = mesh.skeleton
        ? [0, 1, 2, 3].some((k) => weight.getComponent(v, k) > 0 && below(mesh.skeleton.bones[skin.getComponent(v, k)], name))
        : below(mesh, name);
      const off = places[0].distanceTo(places[1]);
      if (chained) { moved++; most = Math.max(most, off); } else { kept++; left = Math.max(left, off); }
    }
  });
}
const size = box.getSize(new THREE.Vector3()).length();
console.log(`${moved / 10} vertices move by up to ${(most / size).toFixed(3)} of the size, ${kept / 10} by ${(left / size).toExponential(1)}`);
const follows = files[0].seconds > 0 ? most > 1e-3 * size : moved > 0 && most <= 1e-5 * size;
process.exit(follows && left <= 1e-5 * size ? 0 : 1);
