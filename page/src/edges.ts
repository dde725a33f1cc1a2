// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The edges of a mesh that are worth a line.
import { bounds, face, isSmooth, type Surface } from './surface';

/** Whether a triangle that goes on smoothly has an edge from `a` the same way as `b`: then the edge ends in a T, and is none. */
function goesOn(surface: Surface, t: number, a: number, b: number): boolean {
  const { positions: p, corners, first, start, around } = surface;
  const way = (from: number, to: number) => [0, 1, 2].map((k) => p[3 * to + k] - p[3 * from + k]);
  const [x, y, z] = way(a, b);
  for (let i = start[a]; i < start[a + 1]; ++i) {
    const c = around[i];
    const s = face(c);
    if (s === t || !isSmooth(surface, s, t)) continue;
    for (const step of [1, 2]) {
      const [u, v, w] = way(a, first[corners[s + ((c + step) % 3)]]);
      if (x * u + y * v + z * w > 0.99999 * Math.hypot(x, y, z) * Math.hypot(u, v, w)) return true;
    }
  }
  return false;
}

/** The other triangles that share the edge from a triangle's corner to its next. */
function across({ corners, first, start, around }: Surface, k: number, found: number[]): number[] {
  const t = face(k);
  const a = first[corners[k]];
  const b = first[corners[t + ((k + 1) % 3)]];
  found.length = 0;
  for (let i = start[a]; i < start[a + 1]; ++i) {
    const c = around[i];
    const s = face(c);
    if (s === t) continue;
    if (first[corners[s + ((c + 1) % 3)]] === b || first[corners[s + ((c + 2) % 3)]] === b) found.push(s);
  }
  return found;
}

/** Thinner than this share of the mesh, a triangle has a normal that rounding made. */
const kThin = 1e-5;
/** Corners of a mesh of which all edges may well be meant. */
const kRough = 6000;

function thinTriangles({ positions: p, corners, sizes }: Surface): Uint8Array {
  const { min, max } = bounds(p);
  const least = kThin * Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]);
  const thin = new Uint8Array(corners.length);
  for (let t = 0; t < corners.length; t += 3) {
    let longest = 0;
    for (let k = 0; k < 3; ++k) {
      const a = 3 * corners[t + k];
      const b = 3 * corners[t + ((k + 1) % 3)];
      const [x, y, z] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
      longest = Math.max(longest, x * x + y * y + z * z);
    }
    if (sizes[t] <= least * Math.sqrt(longest)) thin[t] = 1;
  }
  return thin;
}

/** An edge is worth a line if no triangle goes on smoothly from it. Each edge is looked at once, from its first triangle. */
export function findEdges(surface: Surface): Float32Array {
  const { positions: p, corners, first } = surface;
  const thin = thinTriangles(surface);
  const [beside, beyond]: number[][] = [[], []];
  // What lies beyond a thin triangle decides for it; if that is thin too, nothing can be told, and nothing is drawn.
  const goesOver = (t: number, s: number): boolean => {
    let isKnown = false;
    for (let k = s; k < s + 3; ++k) {
      for (const other of across(surface, k, beyond)) {
        if (other === t || thin[other]) continue;
        if (isSmooth(surface, t, other)) return true;
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
    across(surface, k, beside);
    if (beside.length === 0) {
      if (goesOn(surface, t, a, b) || goesOn(surface, t, b, a)) continue;
    } else if (beside.some((s) => !thin[s])) {
      if (beside.some((s) => !thin[s] && (s < t || isSmooth(surface, s, t)))) continue;
    } else if (beside.some((s) => goesOver(t, s))) {
      continue;
    }
    found.push(p[3 * a], p[3 * a + 1], p[3 * a + 2], p[3 * b], p[3 * b + 1], p[3 * b + 2]);
  }
  // Of a rough surface, as a scan is, nearly every edge is a crease: lines would blacken it.
  const isRough = corners.length > kRough && found.length / 6 > 0.7 * (corners.length / 3);
  return Float32Array.from(isRough ? [] : found);
}
