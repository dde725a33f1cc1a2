// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// From web-ifc's bodies to meshes with places. Matrices are 3 rows of 4 numbers here, row after row: the upper rows of the
// stream's.

// Above this, a matrix is no rotation (contract 1.2 has 1e-6).
const kMostDefect = 1e-9;
// Of equal shapes in other places the bodies' places to each other differ by rounding alone.
const kPlacePrecision = 1e9;
// Four times a 32-bit float's rounding, of the largest coordinate.
const kRounding = 2 ** -22;
// Open edges times their ends; 2 ms. Surfaces that are meant to be open have more of them.
const kMostCompared = 100_000;

// From web-ifc's columns, with Y up, to the file's axes: its x y z is our x -z y. Signs and places alone change.
export function inFileAxes(m) {
  const row = (r, sign) => [0, 1, 2, 3].map((c) => sign * m[4 * c + r]);
  return [...row(0, 1), ...row(2, -1), ...row(1, 1)];
}

function determinant(m) {
  return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) + m[2] * (m[4] * m[9] - m[5] * m[8]);
}

function isRotation(m) {
  for (let i = 0; i < 3; ++i) {
    for (let j = i; j < 3; ++j) {
      const dot = m[i] * m[j] + m[4 + i] * m[4 + j] + m[8 + i] * m[8 + j];
      if (!(Math.abs(dot - (i === j ? 1 : 0)) <= kMostDefect)) return false;
    }
  }
  return determinant(m) > 0;
}

// Where `m` leads, seen from the frame of the rotation or shift `frame`.
function seenFrom(frame, m) {
  const out = [];
  const shift = [m[3] - frame[3], m[7] - frame[7], m[11] - frame[11]];
  for (let r = 0; r < 3; ++r) {
    for (let c = 0; c < 4; ++c) {
      const column = c === 3 ? shift : [m[c], m[4 + c], m[8 + c]];
      out.push(frame[r] * column[0] + frame[4 + r] * column[1] + frame[8 + r] * column[2]);
    }
  }
  return out;
}

// The frame that a product's mesh is in: its first body's, or where that is no rotation, one shifted there.
function frameOf(m) {
  return isRotation(m) ? m : [1, 0, 0, m[3], 0, 1, 0, m[7], 0, 0, 1, m[11]];
}

// Six times the volume, negative where the triangles face inwards.
function signedVolume({ vertices, corners }) {
  let sum = 0;
  for (let t = 0; t + 2 < corners.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => 6 * corners[t + k]);
    const [ax, ay, az] = [vertices[a], vertices[a + 1], vertices[a + 2]];
    const [bx, by, bz] = [vertices[b], vertices[b + 1], vertices[b + 2]];
    const [cx, cy, cz] = [vertices[c], vertices[c + 1], vertices[c + 2]];
    sum += ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx);
  }
  return sum;
}

// For each vertex of six floats the first with the same point: web-ifc repeats each for every normal.
function firstAlike(vertices) {
  const count = vertices.length / 6;
  const bits = new Uint32Array(vertices.buffer, vertices.byteOffset, vertices.length);
  const size = 2 ** Math.ceil(Math.log2(2 * count + 1));
  const table = new Int32Array(size).fill(-1); // open addressing
  const first = new Int32Array(count);
  for (let v = 0; v < count; ++v) {
    const at = 6 * v;
    for (let k = 0; k < 3; ++k) vertices[at + k] += 0; // -0 becomes 0
    let slot =
      Math.imul(bits[at], 0x9e3779b1) ^ Math.imul(bits[at + 1], 0x85ebca6b) ^ Math.imul(bits[at + 2], 0xc2b2ae35);
    slot = (slot ^ (slot >>> 15)) & (size - 1);
    for (;;) {
      const other = 6 * table[slot];
      if (other < 0) table[slot] = v;
      else if (bits[at] !== bits[other] || bits[at + 1] !== bits[other + 1] || bits[at + 2] !== bits[other + 2]) {
        slot = (slot + 1) & (size - 1);
        continue;
      }
      first[v] = table[slot];
      break;
    }
  }
  return first;
}

// Whether as many triangles run along each edge one way as the other: sums of a hash of each edge, once added and once
// taken away, are then zero, and otherwise as good as never.
function isClosed(corners, numbers) {
  let one = 0;
  let other = 0;
  for (let t = 0; t + 2 < corners.length; t += 3) {
    let a = numbers[corners[t + 2]];
    for (let k = 0; k < 3; ++k) {
      const b = numbers[corners[t + k]];
      const low = a < b ? a : b;
      let hash = Math.imul(low, 0x9e3779b1) ^ Math.imul((a < b ? b : a) + 1, 0x85ebca6b);
      hash = Math.imul(hash ^ (hash >>> 15), 0xc2b2ae35);
      hash ^= hash >>> 13;
      const second = Math.imul(hash, 0x27d4eb2f) ^ low;
      // Nothing of an edge between one vertex and itself.
      const sign = a < b ? 1 : a > b ? -1 : 0;
      one = (one + sign * hash) | 0;
      other = (other + sign * second) | 0;
      a = b;
    }
  }
  return one === 0 && other === 0;
}

// How far apart rounding puts what is one: of points about the origin of six floats each.
function roundingOf(vertices) {
  let largest = 0;
  for (let v = 0; v < vertices.length; v += 6) {
    largest = Math.max(largest, Math.abs(vertices[v]), Math.abs(vertices[v + 1]), Math.abs(vertices[v + 2]));
  }
  return largest * kRounding;
}

// Joins vertices that rounding alone parts, as it does where faces of advanced B-reps meet: `numbers` of those that go
// together become equal. Sorted by x, only those a little further on are compared.
function joinNear(vertices, numbers) {
  const near = roundingOf(vertices);
  const alone = [...numbers.keys()].filter((v) => numbers[v] === v).sort((a, b) => vertices[6 * a] - vertices[6 * b]);
  alone.forEach((v, i) => {
    if (numbers[v] !== v) return;
    for (let j = i + 1; j < alone.length; ++j) {
      const [at, other] = [6 * v, 6 * alone[j]];
      if (vertices[other] - vertices[at] > near) break;
      const isNear = [1, 2].every((k) => Math.abs(vertices[other + k] - vertices[at + k]) <= near);
      if (isNear && numbers[alone[j]] === alone[j]) numbers[alone[j]] = v;
    }
  });
  for (let v = 0; v < numbers.length; ++v) numbers[v] = numbers[numbers[v]];
}

// Those of the vertices that lie on the edge from a to b, within `near`, in their order on it and without its ends. They are many:
// whatever is outside the edge's box is left out first.
function verticesOn(vertices, a, b, among, near) {
  const start = vertices.subarray(6 * a, 6 * a + 3);
  const end = vertices.subarray(6 * b, 6 * b + 3);
  const [x, y, z] = [end[0] - start[0], end[1] - start[1], end[2] - start[2]];
  const length = Math.hypot(x, y, z);
  const isOutside = (at, k) =>
    at < (start[k] < end[k] ? start[k] : end[k]) - near || at > (start[k] < end[k] ? end[k] : start[k]) + near;
  const found = [];
  for (const v of among) {
    if (isOutside(vertices[6 * v], 0) || isOutside(vertices[6 * v + 1], 1) || isOutside(vertices[6 * v + 2], 2)) continue;
    const [u, w, t] = [vertices[6 * v] - start[0], vertices[6 * v + 1] - start[1], vertices[6 * v + 2] - start[2]];
    const along = (u * x + w * y + t * z) / length;
    const beside = Math.hypot(w * z - t * y, t * x - u * z, u * y - w * x) / length;
    if (along > near && along < length - near && beside <= near) found.push({ v, along });
  }
  return found.sort((p, q) => p.along - q.along).map(({ v }) => v);
}

// The corners of triangles whose edges are cut at vertices that lie on them, as they are where windows of a wall stand in one
// line: web-ifc leaves out the flat triangles between. Undefined where that does not close the surface, or where nearly
// collinear vertices lie on each other's edges, so that cutting would never end.
function cutAtVertices(vertices, corners, numbers) {
  const open = new Map(); // edges that run more often one way than the other: both ends, and by how much
  const keyOf = (a, b) => a * numbers.length + b;
  for (let t = 0; t + 2 < corners.length; t += 3) {
    for (let k = 0; k < 3; ++k) {
      const [a, b] = [numbers[corners[t + k]], numbers[corners[t + ((k + 1) % 3)]]];
      if (a === b) continue;
      const back = open.get(keyOf(b, a));
      if (!back) open.set(keyOf(a, b), { a, b, count: (open.get(keyOf(a, b))?.count ?? 0) + 1 });
      else if (--back.count === 0) open.delete(keyOf(b, a));
    }
  }
  const ends = [...new Set([...open.values()].flatMap(({ a, b }) => [a, b]))];
  if (open.size * ends.length > kMostCompared) return undefined;
  const near = roundingOf(vertices);
  const cuts = new Map();
  for (const [key, { a, b }] of open) {
    const on = verticesOn(vertices, a, b, ends, near);
    if (on.length > 0) cuts.set(key, on);
  }
  if (cuts.size === 0) return undefined;
  // A cut at n vertices replaces one triangle by n + 1, so each edge cut once visits fewer triangles than this.
  let steps = corners.length / 3;
  for (const on of cuts.values()) steps += 3 * on.length;
  const cut = [];
  const left = [];
  for (let t = 0; t + 2 < corners.length; t += 3) {
    left.push([0, 1, 2].map((k) => numbers[corners[t + k]]));
    while (left.length > 0) {
      if (--steps < 0) return undefined;
      const [a, b, c] = left.pop();
      const turns = [[a, b, c], [b, c, a], [c, a, b]]; // prettier-ignore
      const [p, q, r] = turns.find(([v, w]) => cuts.has(keyOf(v, w))) ?? [];
      if (p === undefined) {
        cut.push(a, b, c);
        continue;
      }
      const way = [p, ...cuts.get(keyOf(p, q)), q];
      for (let i = 1; i < way.length; ++i) left.push([way[i - 1], way[i], r]);
    }
  }
  return isClosed(cut, numbers) ? cut : undefined;
}

// A geometry's { xyz, triangles }, mapped, its triangles turned over if asked, and whether they are closed; undefined where a
// coordinate is not finite.
function mapped({ vertices, corners }, m, turned) {
  for (let v = 0; v < vertices.length; v += 6) {
    if (!Number.isFinite(vertices[v] + vertices[v + 1] + vertices[v + 2])) return undefined;
  }
  const first = firstAlike(vertices);
  let closed = isClosed(corners, first);
  if (!closed) {
    joinNear(vertices, first);
    closed = isClosed(corners, first);
  }
  const cut = closed ? undefined : cutAtVertices(vertices, corners, first);
  if (cut) [corners, closed] = [cut, true];
  const numbers = new Int32Array(first.length).fill(-1);
  const xyz = new Float64Array(3 * first.length);
  let count = 0;
  for (let i = 0; i < first.length; ++i) {
    const v = first[i];
    if (numbers[v] < 0) {
      const x = vertices[6 * v];
      const y = vertices[6 * v + 1];
      const z = vertices[6 * v + 2];
      for (let r = 0; r < 3; ++r) {
        xyz[3 * count + r] = m[4 * r] * x + m[4 * r + 1] * y + m[4 * r + 2] * z + m[4 * r + 3];
      }
      numbers[v] = count++;
    }
    numbers[i] = numbers[v];
  }
  const triangles = new Uint32Array(corners.length);
  let end = 0;
  for (let t = 0; t + 2 < corners.length; t += 3) {
    const a = numbers[corners[t]];
    const b = numbers[corners[t + (turned ? 2 : 1)]];
    const c = numbers[corners[t + (turned ? 1 : 2)]];
    if (a === b || b === c || c === a) continue;
    triangles[end] = a;
    triangles[end + 1] = b;
    triangles[end + 2] = c;
    end += 3;
  }
  return { xyz: xyz.subarray(0, 3 * count), triangles: triangles.subarray(0, end), closed };
}

// The meshes as one.
function joined(parts) {
  if (parts.length === 1) return parts[0];
  const sum = (name) => parts.reduce((length, part) => length + part[name].length, 0);
  const mesh = { xyz: new Float64Array(sum('xyz')), triangles: new Uint32Array(sum('triangles')) };
  let [vertices, corners] = [0, 0];
  for (const { xyz, triangles } of parts) {
    mesh.xyz.set(xyz, 3 * vertices);
    for (let i = 0; i < triangles.length; ++i) mesh.triangles[corners + i] = triangles[i] + vertices;
    vertices += xyz.length / 3;
    corners += triangles.length;
  }
  return mesh;
}

// One mesh for the bodies of a product, all in the frame of the first: { key, world, make() }. Products with the same key
// have the same mesh; `make` gives its numbers, which bodies are left out, as sentences' parts, whether all are closed, and
// whether one of them should be and is not.
export function shapeOf(bodies, model) {
  const places = bodies.map((body) => inFileAxes(body.matrix));
  const frame = frameOf(places[0]);
  const relative = places.map((place) =>
    place === frame ? [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0] : seenFrom(frame, place),
  );
  const key = bodies
    .map(({ geometry }, i) => [geometry, ...relative[i].map((n) => Math.round(n * kPlacePrecision) + 0)].join(' '))
    .join(';');
  const make = () => {
    // web-ifc turns the triangles of a geometry over where it is mirrored. Where it is shown both ways, they are as one of
    // these needs them.
    const hasMirrored = relative.some((m) => determinant(m) < 0);
    const problems = [];
    const parts = [];
    let hasGaps = false;
    bodies.forEach(({ geometry }, i) => {
      const numbers = model.geometry(geometry);
      if (numbers.corners.length < 3) {
        problems.push('a body without triangles');
        return;
      }
      const turned = hasMirrored && signedVolume(numbers) * determinant(relative[i]) < 0;
      const part = mapped(numbers, relative[i], turned);
      if (!part) {
        problems.push('a body with coordinates that are not finite');
        return;
      }
      parts.push(part);
      // Of other kinds of bodies, open ones may be meant.
      if (!part.closed) hasGaps ||= model.classOf(geometry).startsWith('IfcAdvancedBrep');
    });
    const areClosed = problems.length === 0 && parts.every(({ closed }) => closed);
    const { xyz, triangles } = joined(parts);
    return { xyz, triangles, problems, isClosed: areClosed, hasGaps };
  };
  return { key, world: [...frame, 0, 0, 0, 1], make };
}
