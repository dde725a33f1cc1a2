// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Writes the data blocks into the template, from the description in README.md and not from the program that reads them.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { deflateSync } from 'node:zlib';

const template = fileURLToPath(new URL('../../build/page/report.html', import.meta.url));
export const kMarker = '<!-- impinge: data -->';

/** meshes: [{ positions: [x, y, z, ...], corners: [i, j, k, ...] }] */
export function geometryText(meshes) {
  const chunks = meshes.flatMap(({ positions, corners }) => [
    Buffer.from(Float32Array.from(positions).buffer),
    Buffer.from(Uint32Array.from(corners).buffer),
  ]);
  return deflateSync(Buffer.concat(chunks)).toString('base64');
}

export function sceneOf(title, meshes, objects, { shown, groups = [] } = {}) {
  const triangles = objects.reduce((sum, { mesh }) => sum + (mesh < 0 ? 0 : meshes[mesh].corners.length / 3), 0);
  return {
    version: 1,
    title,
    up: 'z',
    triangles,
    shown: shown ?? triangles,
    meshes: meshes.map(({ positions, corners }) => ({ vertices: positions.length / 3, triangles: corners.length / 3 })),
    groups,
    objects,
  };
}

const escaped = (value) => JSON.stringify(value).replace(/</g, '\\u003c');

const kTypes = { report: 'application/json', scene: 'application/json', geometry: 'text/plain', motion: 'application/json' };

/** What is a text already is written as it is. */
export const blocksOf = (blocks) =>
  Object.entries(kTypes)
    .filter(([id]) => blocks[id] !== undefined)
    .map(([id, type]) => {
      const text = typeof blocks[id] === 'string' ? blocks[id] : escaped(blocks[id]);
      return `<script type="${type}" id="${id}">${text}</script>`;
    })
    .join('\n');

export function compose(blocks) {
  return readFileSync(template, 'utf8').replace(kMarker, () => blocksOf(blocks));
}
