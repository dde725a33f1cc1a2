// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The readers of the data blocks, without a page: what is wrong with a block is said in a sentence. And figures.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';
import { blocksOf } from './compose.mjs';
import { review } from './fixture.mjs';
import { mechanism } from './mechanism.mjs';

const { outputFiles } = await build({
  stdin: {
    contents: "export * from './data'; export * from './format'; export * from './geometry'; export * from './motion';",
    resolveDir: fileURLToPath(new URL('../src', import.meta.url)),
  },
  bundle: true,
  format: 'esm',
  write: false,
});
const readers = await import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].text).toString('base64')}`);

/** Reads the blocks in the order of the page, and returns what is told of the first that cannot be read. */
async function toldOf(blocks) {
  const texts = Object.fromEntries(
    Object.entries(blocks).map(([id, block]) => [id, typeof block === 'string' ? block : JSON.stringify(block)]),
  );
  globalThis.document = { getElementById: (id) => (id in texts ? { textContent: texts[id], remove() {} } : null) };
  try {
    const parts = readers.readReport().objects.length;
    const scene = readers.readScene(parts);
    readers.readMotion(parts);
    await readers.readMeshes(readers.readGeometryText(), scene);
    return '';
  } catch (error) {
    assert.ok(error instanceof readers.BlockError, error);
    return error.message;
  }
}

test('blocks without faults are read', async () => {
  assert.equal(await toldOf(review()), '');
  assert.equal(await toldOf(mechanism()), '');
});

const { report, scene, geometry } = review();
const fewer = scene.meshes.map((mesh) => ({ ...mesh, triangles: mesh.triangles + 1 }));
for (const [what, blocks, words] of [
  ['no report', { scene, geometry }, /the block “report” is missing/],
  ['a report that is not JSON', { report: '{"version":1,', scene, geometry }, /“report” is not JSON/],
  ['another version', { report: { ...report, version: 7 }, scene, geometry }, /version 7, and this page reads version 1/],
  ['a pair of no parts', { report: { ...report, pairs: [{ ...report.pairs[0], b: 99 }] } }, /its pair 0 names no two parts/],
  ['no scene', { report, geometry }, /the block “scene” is missing/],
  ['a scene of another report', { report, scene: { ...scene, objects: [] } }, /0 objects, but the report has 12 parts/],
  [
    'a pose that is none',
    { report, scene: { ...scene, objects: scene.objects.map(() => ({ mesh: 0, pose: [1] })) } },
    /its object 0 has no mesh or no pose/,
  ],
  ['no geometry', { report, scene }, /the block “geometry” is missing/],
  ['geometry cut short', { report, scene, geometry: geometry.slice(0, 40) }, /geometry cannot be read/],
  ['geometry of noise', { report, scene, geometry: '!!!!' }, /geometry cannot be read/],
  ['geometry of too few bytes', { report, scene: { ...scene, meshes: fewer }, geometry }, /geometry cannot be read/],
]) {
  test(`tells of ${what}`, async () => assert.match(await toldOf(blocks), words));
}

for (const [what, spoil, words] of [
  ['another version', (m) => (m.version = 2), /version 2/],
  ['no times', (m) => (m.times = []), /no times/],
  ['times that fall', (m) => (m.times = [0, 2, 1, 3, 4]), /times do not rise/],
  ['no animation', (m) => delete m.animation, /no length/],
  ['a part that is none', (m) => (m.objects[0].id = 99), /object 0 names no part/],
  ['a part twice', (m) => (m.objects[1].id = 0), /object 1 names no part, or one twice/],
  ['a pose too few', (m) => m.objects[1].poses.pop(), /object 1 has not one pose/],
  ['a short pose', (m) => m.objects[1].poses[2].pop(), /object 1 is not twelve numbers/],
  ['a span of no part', (m) => (m.spans[1].b = -1), /span 1 names no two parts/],
  ['sentences that are none', (m) => (m.left_out = [1]), /what it leaves out is no list of sentences/],
  ['a span of no verdict', (m) => (m.spans[1].worst = 'bad'), /span 1 names no two parts, or no verdict/],
  ['a span that ends before it ends', (m) => (m.spans[2].to = [2, 1]), /span 2 has times/],
  ['a depth that is none', (m) => (m.spans[0].overlap_depth = { a_in_b: 3 }), /span 0 has a depth/],
  ['null in a list', (m) => (m.objects[0] = null), /object 0 names no part/],
]) {
  test(`tells of a motion with ${what}`, async () => {
    const blocks = mechanism();
    spoil(blocks.motion);
    const told = await toldOf(blocks);
    assert.match(told, /^The motion/);
    assert.match(told, words);
  });
}

test('tells of a motion that was cut short', async () => {
  const told = await toldOf({ ...mechanism(), motion: '{"version":1,"times":[0,' });
  assert.match(told, /The motion cannot be read.*cut short/);
});

test('blocks hold no sequence that ends them', () => {
  assert.equal(blocksOf({ report }).match(/<\/script/g).length, 1);
});

test('volumes are in a unit of their size', () => {
  for (const [metres, value, text] of [
    [0.001, 2.5e9, '2.5\u00a0m³'],
    [0.001, 12_345_678, '12.35\u00a0L'],
    [0.001, 999_999, '1000\u00a0cm³'],
    [0.001, 0.5, '0.5\u00a0mm³'],
    [1, 0.25, '250\u00a0L'],
    [1, 0, '0\u00a0mm³'],
    [0.3048, 2, '2\u00a0ft³'],
    [0.3048, 0.5, '864\u00a0in³'], // 12³ / 2
    [0.0254, 3456, '2\u00a0ft³'],
    [NaN, 12_345, '12345'],
  ]) {
    readers.setUnit(metres);
    assert.equal(readers.volumeText(value), text, `${value} of ${metres} m`);
  }
  readers.setUnit(0.001);
  assert.equal(readers.volumeText(3e6, 3), '3 ± 3e−6\u00a0L');
});
