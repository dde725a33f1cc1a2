// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// A mesh as a surface: which vertices are one, which triangles are around them, which way these face.
import { Box3 } from 'three';
import type { RawMesh } from './geometry';
import type { Box } from './vector';

const kCrease = Math.cos((32 * Math.PI) / 180);

export interface Surface extends RawMesh {
  /** For each vertex the first one at the same place. */
  first: Uint32Array;
  /** Unit normals, zero for a triangle without area. */
  faces: Float32Array;
  /** Twice the area of each triangle, at the place of its first corner. */
  sizes: Float32Array;
  /** What the triangles enclose if they are closed, times six. */
  volume: number;
  /** Of each welded vertex the place in `around` from which its corners stand. */
  start: Uint32Array;
  /** The corners (3 x triangle + 0..2) around each welded vertex. */
  around: Uint32Array;
}

export function surfaceOf(raw: RawMesh): Surface {
  const first = weld(raw.positions);
  return { ...raw, first, ...faceNormals(raw), ...fans(raw.corners, first) };
}

function weld(positions: Float32Array): Uint32Array {
  const n = positions.length / 3;
  const bits = new Uint32Array(positions.buffer, positions.byteOffset, positions.length);
  let size = 16;
  while (size < 2 * n) size *= 2;
  const table = new Int32Array(size).fill(-1);
  const first = new Uint32Array(n);
  for (let v = 0; v < n; ++v) {
    // Minus zero is zero's place too.
    const x = positions[3 * v] === 0 ? 0 : bits[3 * v];
    const y = positions[3 * v + 1] === 0 ? 0 : bits[3 * v + 1];
    const z = positions[3 * v + 2] === 0 ? 0 : bits[3 * v + 2];
    let slot = (Math.imul(x, 73856093) ^ Math.imul(y, 19349663) ^ Math.imul(z, 83492791)) >>> 0;
    slot = (slot ^ (slot >>> 15)) & (size - 1);
    for (;;) {
      const other = table[slot];
      if (other < 0) {
        table[slot] = v;
        first[v] = v;
        break;
      }
      if (
        positions[3 * other] === positions[3 * v] &&
        positions[3 * other + 1] === positions[3 * v + 1] &&
        positions[3 * other + 2] === positions[3 * v + 2]
      ) {
        first[v] = other;
        break;
      }
      slot = (slot + 1) & (size - 1);
    }
  }
  return first;
}

function faceNormals({ positions: p, corners }: RawMesh) {
  const faces = new Float32Array(corners.length);
  const sizes = new Float32Array(corners.length);
  let volume = 0;
  for (let t = 0; t < corners.length; t += 3) {
    const a = 3 * corners[t];
    const b = 3 * corners[t + 1];
    const c = 3 * corners[t + 2];
    const ux = p[b] - p[a];
    const uy = p[b + 1] - p[a + 1];
    const uz = p[b + 2] - p[a + 2];
    const vx = p[c] - p[a];
    const vy = p[c + 1] - p[a + 1];
    const vz = p[c + 2] - p[a + 2];
    const x = uy * vz - uz * vy;
    const y = uz * vx - ux * vz;
    const z = ux * vy - uy * vx;
    volume += p[a] * x + p[a + 1] * y + p[a + 2] * z;
    const size = Math.sqrt(x * x + y * y + z * z);
    sizes[t] = size;
    if (size === 0) continue;
    faces[t] = x / size;
    faces[t + 1] = y / size;
    faces[t + 2] = z / size;
  }
  return { faces, sizes, volume };
}

function fans(corners: Uint32Array, first: Uint32Array) {
  const start = new Uint32Array(first.length + 1);
  for (const corner of corners) ++start[first[corner] + 1];
  for (let v = 0; v < first.length; ++v) start[v + 1] += start[v];
  const next = start.slice();
  const around = new Uint32Array(corners.length);
  for (let k = 0; k < corners.length; ++k) around[next[first[corners[k]]]++] = k;
  return { start, around };
}

export const face = (corner: number): number => corner - (corner % 3);

export function isSmooth({ faces }: Surface, s: number, t: number): boolean {
  return faces[s] * faces[t] + faces[s + 1] * faces[t + 1] + faces[s + 2] * faces[t + 2] >= kCrease;
}

export function bounds(positions: Float32Array): Box {
  const { min, max } = new Box3().setFromArray(positions);
  return { min: min.toArray(), max: max.toArray() };
}
