// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// What is drawn of a mesh: vertices with normals that keep creases sharp, and edges.
import type { Vec3 } from './data';
import { findEdges } from './edges';
import type { RawMesh } from './geometry';
import { bounds, face, isSmooth, surfaceOf } from './surface';

export interface DrawnMesh {
  positions: Float32Array;
  /** Signed bytes, four to a vertex. */
  normals: Int8Array;
  corners: Uint32Array;
  /** Both ends of each edge. */
  edges: Float32Array;
  min: Vec3;
  max: Vec3;
}

/** Vertices at which a great many triangles meet would make fans quadratic: there the face's own normal does. */
const kWidestFan = 512;

export function drawnMesh(raw: RawMesh, withEdges: boolean): DrawnMesh {
  const surface = surfaceOf(raw);
  const { positions: p, first, faces, sizes, volume, start, around } = surface;
  const edges = withEdges ? findEdges(surface) : new Float32Array(0);
  const corners = new Uint32Array(raw.corners.length);
  // Room for a vertex at every corner; what is not needed is cut off in the end.
  const positions = new Float32Array(3 * corners.length);
  const normals = new Int8Array(4 * corners.length);
  // The vertices made so far of each welded one, as a list through `next`.
  const head = new Int32Array(first.length).fill(-1);
  const next = new Int32Array(corners.length);
  let made = 0;
  const turn = volume < 0 ? -1 : 1;
  for (let k = 0; k < corners.length; ++k) {
    const t = face(k);
    const v = first[raw.corners[k]];
    let x = 0;
    let y = 0;
    let z = 0;
    if (start[v + 1] - start[v] <= kWidestFan) {
      for (let i = start[v]; i < start[v + 1]; ++i) {
        const s = face(around[i]);
        if (s !== t && !isSmooth(surface, s, t)) continue;
        x += sizes[s] * faces[s];
        y += sizes[s] * faces[s + 1];
        z += sizes[s] * faces[s + 2];
      }
    }
    if (x === 0 && y === 0 && z === 0) {
      x = faces[t];
      y = faces[t + 1];
      z = faces[t + 2];
    }
    const scale = (127 * turn) / (Math.sqrt(x * x + y * y + z * z) || 1);
    x = Math.round(x * scale);
    y = Math.round(y * scale);
    z = Math.round(z * scale);
    let vertex = head[v];
    const isNormal = (i: number) => normals[4 * i] === x && normals[4 * i + 1] === y && normals[4 * i + 2] === z;
    while (vertex >= 0 && !isNormal(vertex)) vertex = next[vertex];
    if (vertex < 0) {
      vertex = made++;
      next[vertex] = head[v];
      head[v] = vertex;
      positions.set([p[3 * v], p[3 * v + 1], p[3 * v + 2]], 3 * vertex);
      normals.set([x, y, z], 4 * vertex);
    }
    // A closed mesh whose normals look inwards is turned, so that its inside shows as such where it is cut open.
    corners[turn > 0 ? k : t + 2 - (k - t)] = vertex;
  }
  const placed = positions.slice(0, 3 * made);
  return { positions: placed, normals: normals.slice(0, 4 * made), corners, edges, ...bounds(placed) };
}
