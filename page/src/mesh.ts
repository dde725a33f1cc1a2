// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// What is drawn of a mesh: vertices with normals that keep creases sharp, and the edges worth a line.
import type { RawMesh } from './geometry';

export interface DrawnMesh {
  positions: Float32Array;
  /** Signed bytes, four to a vertex. */
  normals: Int8Array;
  corners: Uint32Array;
  /** Both ends of each edge. */
  edges: Float32Array;
  min: [number, number, number];
  max: [number, number, number];
}

const kCrease = Math.cos((32 * Math.PI) / 180);

/** For each vertex the first one at the same place. */
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

/** Normals of length twice the area, and the volume that the triangles enclose if they are closed. */
function faceNormals({ positions: p, corners }: RawMesh): { faces: Float32Array; volume: number } {
  const faces = new Float32Array(corners.length);
  let volume = 0;
  for (let t = 0; t < corners.length; t += 3) {
    const [a, b, c] = [3 * corners[t], 3 * corners[t + 1], 3 * corners[t + 2]];
    const [ux, uy, uz] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
    const [vx, vy, vz] = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
    faces[t] = uy * vz - uz * vy;
    faces[t + 1] = uz * vx - ux * vz;
    faces[t + 2] = ux * vy - uy * vx;
    volume += p[a] * faces[t] + p[a + 1] * faces[t + 1] + p[a + 2] * faces[t + 2];
  }
  return { faces, volume };
}

interface Fans {
  start: Uint32Array;
  around: Uint32Array;
}

/** The corners (3 x triangle + 0..2) around each welded vertex. */
function fans(corners: Uint32Array, first: Uint32Array): Fans {
  const start = new Uint32Array(first.length + 1);
  for (const corner of corners) ++start[first[corner] + 1];
  for (let v = 0; v < first.length; ++v) start[v + 1] += start[v];
  const next = start.slice();
  const around = new Uint32Array(corners.length);
  for (let k = 0; k < corners.length; ++k) around[next[first[corners[k]]]++] = k;
  return { start, around };
}

const face = (corner: number): number => corner - (corner % 3);

function isSmooth(faces: Float32Array, s: number, t: number): boolean {
  const dot = faces[s] * faces[t] + faces[s + 1] * faces[t + 1] + faces[s + 2] * faces[t + 2];
  if (dot <= 0) return false;
  const [ls, lt] = [Math.hypot(faces[s], faces[s + 1], faces[s + 2]), Math.hypot(faces[t], faces[t + 1], faces[t + 2])];
  return dot >= kCrease * ls * lt;
}

/** Whether a triangle that goes on smoothly has an edge from `a` the same way as `b`: then the edge ends in a T, and is none. */
function goesOn(raw: RawMesh, first: Uint32Array, faces: Float32Array, fan: Fans, t: number, a: number, b: number): boolean {
  const { positions: p, corners } = raw;
  const way = (from: number, to: number) => [0, 1, 2].map((k) => p[3 * to + k] - p[3 * from + k]);
  const [x, y, z] = way(a, b);
  for (let i = fan.start[a]; i < fan.start[a + 1]; ++i) {
    const c = fan.around[i];
    const s = face(c);
    if (s === t || !isSmooth(faces, s, t)) continue;
    for (const step of [1, 2]) {
      const [u, v, w] = way(a, first[corners[s + ((c + step) % 3)]]);
      if (x * u + y * v + z * w > 0.99999 * Math.hypot(x, y, z) * Math.hypot(u, v, w)) return true;
    }
  }
  return false;
}

/** The other triangles that share the edge from a triangle's corner to its next. */
function across(raw: RawMesh, first: Uint32Array, fan: Fans, k: number, found: number[]): number[] {
  const { corners } = raw;
  const t = face(k);
  const a = first[corners[k]];
  const b = first[corners[t + ((k + 1) % 3)]];
  found.length = 0;
  for (let i = fan.start[a]; i < fan.start[a + 1]; ++i) {
    const c = fan.around[i];
    const s = face(c);
    if (s === t) continue;
    if (first[corners[s + ((c + 1) % 3)]] === b || first[corners[s + ((c + 2) % 3)]] === b) found.push(s);
  }
  return found;
}

/** Thinner than this share of the mesh, a triangle has a normal that rounding made. */
const kThin = 1e-5;

function thinTriangles({ positions: p, corners }: RawMesh, faces: Float32Array): Uint8Array {
  const { min, max } = bounds(p);
  const least = kThin * Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]);
  const thin = new Uint8Array(corners.length);
  for (let t = 0; t < corners.length; t += 3) {
    let longest = 0;
    for (let k = 0; k < 3; ++k) {
      const [a, b] = [3 * corners[t + k], 3 * corners[t + ((k + 1) % 3)]];
      longest = Math.max(longest, Math.hypot(p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]));
    }
    if (Math.hypot(faces[t], faces[t + 1], faces[t + 2]) <= least * longest) thin[t] = 1;
  }
  return thin;
}

/** An edge is worth a line if no triangle goes on smoothly from it. Each edge is looked at once, from its first triangle. */
function findEdges(raw: RawMesh, first: Uint32Array, faces: Float32Array, fan: Fans): Float32Array {
  const { positions: p, corners } = raw;
  const thin = thinTriangles(raw, faces);
  const [beside, beyond]: number[][] = [[], []];
  // What lies beyond a thin triangle decides for it; if that is thin too, nothing can be told, and nothing is drawn.
  const goesOver = (t: number, s: number): boolean => {
    let isKnown = false;
    for (let k = s; k < s + 3; ++k) {
      for (const other of across(raw, first, fan, k, beyond)) {
        if (other === t || thin[other]) continue;
        if (isSmooth(faces, t, other)) return true;
        isKnown = true;
      }
    }
    return !isKnown;
  };
  const found: number[] = [];
  for (let k = 0; k < corners.length; ++k) {
    const t = face(k);
    const a = first[corners[k]];
    const b = first[corners[t + ((k + 1) % 3)]];
    if (a === b || thin[t]) continue;
    across(raw, first, fan, k, beside);
    if (beside.length === 0) {
      if (goesOn(raw, first, faces, fan, t, a, b) || goesOn(raw, first, faces, fan, t, b, a)) continue;
    } else if (beside.some((s) => !thin[s])) {
      if (beside.some((s) => !thin[s] && (s < t || isSmooth(faces, s, t)))) continue;
    } else if (beside.some((s) => goesOver(t, s))) {
      continue;
    }
    found.push(p[3 * a], p[3 * a + 1], p[3 * a + 2], p[3 * b], p[3 * b + 1], p[3 * b + 2]);
  }
  return Float32Array.from(found);
}

/** Vertices at which a great many triangles meet would make fans quadratic: there the face's own normal does. */
const kWidestFan = 512;

export function drawnMesh(raw: RawMesh, withEdges: boolean): DrawnMesh {
  const { positions: p } = raw;
  const first = weld(p);
  const { faces, volume } = faceNormals(raw);
  const fan = fans(raw.corners, first);
  const out = { positions: [] as number[], normals: [] as number[] };
  const corners = new Uint32Array(raw.corners.length);
  // The vertices made so far of each welded one, as a list through `next`.
  const head = new Int32Array(first.length).fill(-1);
  const next: number[] = [];
  const turn = volume < 0 ? -1 : 1;
  const edges = withEdges ? findEdges(raw, first, faces, fan) : new Float32Array(0);
  for (let k = 0; k < corners.length; ++k) {
    const t = face(k);
    const v = first[raw.corners[k]];
    let [x, y, z] = [0, 0, 0];
    const isWide = fan.start[v + 1] - fan.start[v] > kWidestFan;
    if (!isWide) {
      for (let i = fan.start[v]; i < fan.start[v + 1]; ++i) {
        const s = face(fan.around[i]);
        if (s !== t && !isSmooth(faces, s, t)) continue;
        x += faces[s];
        y += faces[s + 1];
        z += faces[s + 2];
      }
    }
    if (x === 0 && y === 0 && z === 0) [x, y, z] = [faces[t], faces[t + 1], faces[t + 2]];
    const scale = (127 * turn) / (Math.hypot(x, y, z) || 1);
    [x, y, z] = [Math.round(x * scale), Math.round(y * scale), Math.round(z * scale)];
    let made = head[v];
    while (made >= 0 && !(out.normals[4 * made] === x && out.normals[4 * made + 1] === y && out.normals[4 * made + 2] === z)) {
      made = next[made];
    }
    if (made < 0) {
      made = next.length;
      next.push(head[v]);
      head[v] = made;
      out.positions.push(p[3 * v], p[3 * v + 1], p[3 * v + 2]);
      out.normals.push(x, y, z, 0);
    }
    // A closed mesh whose normals look inwards is turned, so that its inside shows as such where it is cut open.
    corners[turn > 0 ? k : t + 2 - (k - t)] = made;
  }
  const positions = Float32Array.from(out.positions);
  return { positions, normals: Int8Array.from(out.normals), corners, edges, ...bounds(positions) };
}

function bounds(p: Float32Array): Pick<DrawnMesh, 'min' | 'max'> {
  const min: DrawnMesh['min'] = [Infinity, Infinity, Infinity];
  const max: DrawnMesh['max'] = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < p.length; i += 3) {
    for (let k = 0; k < 3; ++k) {
      if (p[i + k] < min[k]) min[k] = p[i + k];
      if (p[i + k] > max[k]) max[k] = p[i + k];
    }
  }
  return { min, max };
}
