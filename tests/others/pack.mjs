// Makes tests/fuzz/seeds/gltf/draco.glb and meshopt.glb: a strip of 5 x 5 vertices at (x, y, x y), bent by two bones that a clip turns.
// node pack.mjs <folder>, beside @gltf-transform/functions, @gltf-transform/extensions, draco3dgltf and meshoptimizer of npm.
import { Document, NodeIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { draco, meshopt } from '@gltf-transform/functions';
import draco3d from 'draco3dgltf';
import { MeshoptEncoder } from 'meshoptimizer';

function strip() {
    const file = new Document(), buffer = file.createBuffer();
    const put = (type, array) => file.createAccessor().setType(type).setArray(array).setBuffer(buffer);
    const places = [...Array(25).keys()].map((n) => [(n % 5) / 4, Math.floor(n / 5) / 4]);
    const cells = [...Array(25).keys()].filter((n) => n % 5 < 4 && n < 20);
    const primitive = file.createPrimitive()
        .setAttribute('POSITION', put('VEC3', new Float32Array(places.flatMap(([x, y]) => [x, y, x * y]))))
        .setAttribute('NORMAL', put('VEC3', new Float32Array(places.flatMap(([x, y]) => [-y, -x, 1].map((c) => c / Math.hypot(x, y, 1))))))
        .setAttribute('JOINTS_0', put('VEC4', new Uint8Array(places.flatMap(() => [0, 1, 0, 0]))))
        .setAttribute('WEIGHTS_0', put('VEC4', new Float32Array(places.flatMap(([, y]) => [1 - y, y, 0, 0]))))
        .setIndices(put('SCALAR', new Uint16Array(cells.flatMap((n) => [n, n + 1, n + 5, n + 1, n + 6, n + 5]))));
    const tip = file.createNode('tip'), root = file.createNode('root').addChild(tip.setTranslation([0, 0.5, 0]));
    const binds = [0, -0.5].map((y) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, y, 0, 1]);
    const skin = file.createSkin().addJoint(root).addJoint(tip).setInverseBindMatrices(put('MAT4', new Float32Array(binds.flat())));
    const mesh = file.createNode('strip').setMesh(file.createMesh().addPrimitive(primitive)).setSkin(skin);
    file.createScene().addChild(root).addChild(mesh);
    const sampler = file.createAnimationSampler().setInput(put('SCALAR', new Float32Array([0, 1])))
        .setOutput(put('VEC4', new Float32Array([0, 0, 0, 1, 0, 0, 0.6, 0.8])));
    const channel = file.createAnimationChannel().setTargetNode(root).setTargetPath('rotation').setSampler(sampler);
    file.createAnimation('turn').addSampler(sampler).addChannel(channel);
    return file;
}

await MeshoptEncoder.ready;
const io = new NodeIO().registerExtensions(ALL_EXTENSIONS)
    .registerDependencies({ 'draco3d.encoder': await draco3d.createEncoderModule(), 'meshopt.encoder': MeshoptEncoder });
for (const [name, pack] of [['draco', draco()], ['meshopt', meshopt({ encoder: MeshoptEncoder, level: 'high' })]]) {
    const file = strip();
    await file.transform(pack);
    await io.write(`${process.argv[2]}/${name}.glb`, file);
}
