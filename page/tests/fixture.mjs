// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Reports made by hand from boxes, with names of every kind.
import { compose, geometryText, sceneOf } from './compose.mjs';

/** A box about the origin, each side cut into n x n squares. */
export function box(x, y, z, n = 1) {
  const [positions, corners] = [[], []];
  for (const [u, v, w] of [
    [0, 1, 2],
    [1, 2, 0],
    [2, 0, 1],
  ]) {
    for (const side of [-1, 1]) {
      const base = positions.length / 3;
      for (let i = 0; i <= n; ++i) {
        for (let j = 0; j <= n; ++j) {
          const p = [0, 0, 0];
          p[u] = (i / n - 0.5) * [x, y, z][u];
          p[v] = (j / n - 0.5) * [x, y, z][v];
          p[w] = (side / 2) * [x, y, z][w];
          positions.push(...p);
        }
      }
      for (let i = 0; i < n; ++i) {
        for (let j = 0; j < n; ++j) {
          const a = base + i * (n + 1) + j;
          const quad =
            side > 0 ? [a, a + n + 1, a + n + 2, a, a + n + 2, a + 1] : [a, a + n + 2, a + n + 1, a, a + 1, a + n + 2];
          corners.push(...quad);
        }
      }
    }
  }
  return { positions, corners };
}

export const at = (x, y, z) => [1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z];

function part(id, name, group, file, triangles, volume) {
  const path = group ? `${group}/${name}` : name;
  return {
    id,
    name,
    path,
    product: '',
    file,
    triangles,
    closed: true,
    open_edges: 0,
    class: 'solid',
    first_open_edge: null,
    self_crossings: 0,
    first_self_crossing: null,
    volume,
    area: 6,
    inner_radius: volume / 3,
  };
}

/** Groups by ways such as 'frame/left', and the number of each way; nothing for the empty one. */
export function groupsOf(ways) {
  const groups = [];
  const numbers = new Map();
  const number = (way) => {
    if (!way || numbers.has(way)) return numbers.get(way);
    const cut = way.lastIndexOf('/');
    const parent = number(way.slice(0, Math.max(cut, 0)));
    groups.push({ name: way.slice(cut + 1), ...(parent !== undefined && { parent }) });
    numbers.set(way, groups.length - 1);
    return groups.length - 1;
  };
  return { numbers: ways.map(number), groups };
}

export const kMarkup = '<img src=x onerror="window.broken=1"></script><b>bold</b>';
export const kSteering = 'left\u202eright\nnext\u0000line';
export const kLong = 'long/'.repeat(2048);

const kSettings = {
  tolerance: 'auto',
  clearance: 0.5,
  depth_precision: 0.05,
  regions: true,
  volumes: true,
  fail_on: ['penetration', 'inside'],
  ignore: [],
};
const kCounts = { duplicate: 0, inside: 0, penetrating: 0, crossing: 0, touching: 0, apart: 0, fail: 0, candidates: 0 };
/** A pair of which nothing was found but what is given. */
const pairOf = (given) => ({
  crossing: 0,
  touching: 0,
  coplanar: 0,
  inner: null,
  note: null,
  tolerance: 1e-6,
  fails: true,
  fails_below: null,
  overlap_depth: null,
  ...given,
});

/** A frame of twelve boxes; the numbers of its pairs are made up, so that every order of the list is a different one. */
export function review({ offset = [0, 0, 0], triage = true } = {}) {
  const meshes = [box(1, 1, 1, 2), box(4, 0.25, 4), box(0.5, 2, 0.5)];
  const named = [
    ['bolt', 'frame/left', 'left.stl', 0],
    ['bolt (2)', 'frame/left', 'left.stl', 0],
    ['bolt (3)', 'frame/right', 'left.stl', 0],
    ['plate', 'frame', 'left.stl', 1],
    ['plate (2)', 'frame', 'left.stl', 1],
    ['post', '', 'left.stl', 2],
    ['post (2)', '', 'right.stl', 2],
    [kMarkup, '', 'right.stl', 0],
    [kSteering, '', 'right.stl', 0],
    [kLong, '', 'right.stl', 2],
    ['far bolt', 'far', 'right.stl', 0],
    ['nothing', 'far', 'right.stl', -1],
  ];
  const objects = named.map(([name, group, file, mesh], id) => ({
    ...part(id, name, group, file, mesh < 0 ? 0 : meshes[mesh].corners.length / 3, 1 + id),
    properties:
      file === 'right.stl'
        ? {}
        : {
            class: ['IfcFastener', 'IfcPlate', 'IfcColumn'][mesh],
            GlobalId: `0guid$${id}`,
            Tag: `T-${id}`,
            storey: id % 2 ? 'Level 2' : 'Level 10',
            material: id % 5 ? 'steel' : ['brick', 'mortar'],
          },
  }));
  const places = named.map((_, i) => [
    2.2 * (i % 4) + offset[0],
    2.2 * Math.floor(i / 4) + offset[1],
    (i % 3) * 0.8 + offset[2],
  ]);
  const { numbers, groups } = groupsOf(named.map(([, group]) => group));
  const scene = sceneOf(
    'frame.stl',
    meshes,
    named.map(([, , , mesh], i) => ({ mesh, pose: at(...places[i]), group: numbers[i] })),
    { groups },
  );
  const middle = (a, b) => places[a].map((c, k) => (c + places[b][k]) / 2);
  const square = ([x, y, z], s) => [
    [x - s, y - s, z],
    [x + s, y - s, z],
    [x + s, y + s, z],
    [x - s, y + s, z],
    [x - s, y - s, z],
  ];
  objects[3].incomplete = 'its <b>lid</b> is left out';
  const pairs = [];
  const put = (a, b, verdict, { depth, volume, distance, areas = [], ...more } = {}) => {
    const centre = middle(a, b);
    const given = {
      a,
      b,
      crossing: depth ? 12 : 0,
      touching: 3,
      coplanar: 1,
      verdict,
      fails: ['duplicate', 'inside', 'penetrating', 'crossing'].includes(verdict),
      fails_below: depth ? depth * 0.95 : verdict === 'touching' || verdict === 'apart' ? 0 : null,
      overlap_depth: depth ? { a_in_b: [depth * 0.99, depth], b_in_a: [depth * 0.9, depth * 0.95] } : null,
      overlap_volume: volume ?? null,
      overlap_volume_error: volume ? 1e-10 : null,
      distance: distance ?? null,
      distance_error: distance ? 1e-12 : null,
      nearest: distance ? [centre, centre.map((c, k) => c + (k === 0 ? distance : 0))] : null,
      regions: areas.map((area, i) => ({
        pairs: 4 + i,
        box: [centre.map((c) => c - 0.2), centre.map((c) => c + 0.2)],
        area,
        length: 1.6,
        centroid: centre,
        normal: [0, 0, 1],
        lines: [square(centre, 0.2 + 0.05 * i)],
      })),
      ...more,
    };
    pairs.push(pairOf(given));
  };
  put(0, 3, 'penetrating', { depth: 0.51234567, volume: 0.125, areas: [2, 0.5], axes: 'B/10' });
  put(0, 1, 'touching', { areas: [1.5], note: 'they overlap by no more than the tolerance' });
  put(1, 3, 'penetrating', { depth: 1.25, volume: 0.0625, areas: [0.25], axes: 'B/3' });
  put(2, 4, 'penetrating', { depth: 0.75, areas: [8] });
  put(3, 5, 'crossing', { fails_below: 0.6, areas: [3, 1] });
  put(4, 6, 'inside', { depth: 0.6, volume: 4.5, fails_below: 3, inner: 6, areas: [] });
  put(5, 6, 'apart', { distance: 0.4 });
  put(7, 8, 'apart', { distance: 0.1 });
  put(7, 9, 'duplicate', { areas: [0.125] });
  put(8, 10, 'apart', { distance: 0.25 });
  put(9, 10, 'touching', { areas: [] });
  put(0, 10, 'touching', { areas: [5] });
  const report = {
    version: 1,
    unit: { name: 'mm', metres: 0.001 },
    settings: kSettings,
    objects,
    pairs,
    counts: { duplicate: 1, inside: 1, penetrating: 3, crossing: 1, touching: 3, apart: 3, fail: 6, candidates: 17 },
  };
  if (triage) {
    pairs.forEach((pair, i) =>
      Object.assign(pair, {
        id: `0000-${i}`,
        test: i % 3 ? 'bolts against plates' : null,
        change: i % 2 ? 'new' : 'persisting',
        was: i % 2 ? null : i === 0 ? 'touching' : pair.verdict,
        status: i % 4 ? null : 'approved',
        comment: i ? null : 'seen by <b>two</b>\r\nnot by\u202e three\nor four',
      }),
    );
    pairs[4].regions.forEach((region, i) => Object.assign(region, { change: i ? 'new' : 'persisting' }));
    report.resolved = [
      {
        a: objects[0],
        b: { name: 'gone', path: 'gone', file: 'left.stl' },
        verdict: 'penetrating',
        test: null,
        centroid: places[0],
      },
      { a: objects[0], b: objects[1], verdict: 'touching', test: null, centroid: null },
    ];
  }
  return { report, scene, geometry: geometryText(meshes) };
}

export const reviewPage = (options) => compose(review(options));

/** Cubes with something in them, or nearly so, far from each other. A cube that pokes out stands on a corner of its own. */
export function nestedPage() {
  const [r2, r3, r6] = [Math.SQRT1_2, Math.sqrt(1 / 3), Math.sqrt(1 / 6)];
  const onCorner = (x, y, z) => [r2, -r2, 0, x, r6, r6, -2 * r6, y, r3, r3, r3, z];
  const meshes = [box(10, 10, 10), box(2, 2, 2), box(4, 4, 4, 3), box(2, 2, 30), box(2, 2, 10)];
  const placed = [
    [1, at(0, 0, 0)],
    [0, at(0, 0, 0)],
    [0, at(100, 0, 0)],
    [4, at(100, 0, 0)], // from face to face
    [2, onCorner(200, 0, 2)], // its upper corner is at 2 + sqrt(12), the cube around it ends at 5
    [0, at(200, 0, 0)],
    [3, at(300, 0, 0)],
    [0, at(300, 0, 0)],
    [0, at(400, 0, 0)],
    [2, onCorner(400, 0, 2)],
  ];
  const objects = placed.map(([mesh], id) => part(id, `cube ${id}`, '', 'nested.stl', meshes[mesh].corners.length / 3, 1));
  const square = (x, z, s) => ({
    pairs: 4,
    box: [
      [x - s, -s, z],
      [x + s, s, z],
    ],
    area: 4 * s * s,
    length: 8 * s,
    centroid: [x, 0, z],
    normal: [0, 0, 1],
    lines: [[[x - s, -s, z], [x + s, -s, z], [x + s, s, z], [x - s, s, z], [x - s, -s, z]]],
  });
  const pair = (a, b, verdict, inner, regions) => pairOf({ id: `pair ${a / 2}`, a, b, verdict, inner, regions });
  const pairs = [
    pair(0, 1, 'inside', 0, []),
    pair(2, 3, 'inside', 3, [square(100, 5, 1), square(100, -5, 1)]),
    pair(4, 5, 'penetrating', null, [square(200, 5, 0.6)]),
    pair(6, 7, 'penetrating', null, [square(300, 5, 1), square(300, -5, 1)]),
    pair(8, 9, 'penetrating', null, [square(400, 5, 0.6)]),
  ];
  const { report } = review({ triage: false });
  const counts = { ...report.counts, inside: 2, penetrating: 3, fail: 5 };
  const scene = sceneOf(
    'nested.stl',
    meshes,
    placed.map(([mesh, pose]) => ({ mesh, pose })),
  );
  return compose({ report: { ...report, objects, pairs, counts }, scene, geometry: geometryText(meshes) });
}

/** One box twice, cut into other triangles, askew and far away, so that no two of its depths are rounded alike. */
export function twinsPage() {
  const meshes = [box(3, 2, 1, 2), box(3, 2, 1, 7)];
  const [c, s] = [Math.cos(0.7), Math.sin(0.7)];
  const pose = [c, -s * c, s * s, 1234.567, s, c * c, -s * c, 89.1, 0, s, c, 0.23];
  const { report } = review({ triage: false });
  const objects = meshes.map(({ corners }, id) => part(id, `twin ${id}`, '', 'twins.stl', corners.length / 3, 6));
  const pairs = [{ ...report.pairs[8], a: 0, b: 1, regions: [] }];
  const scene = sceneOf('twins.stl', meshes, meshes.map((_, mesh) => ({ mesh, pose }))); // prettier-ignore
  return compose({ report: { ...report, objects, pairs }, scene, geometry: geometryText(meshes) });
}

/** 10,000 parts and 15,000 pairs. */
export function plantPage() {
  const n = 100;
  const meshes = [box(1, 1, 1), box(0.5, 2, 0.7)];
  const objects = [];
  const poses = [];
  const ways = [];
  for (let i = 0; i < n * n; ++i) {
    const [x, y] = [i % n, Math.floor(i / n)];
    ways.push(`hall ${Math.floor(y / 10)}/row ${y}`);
    objects.push(part(i, `part ${i}`, ways[i], 'plant.stl', 12, 1));
    poses.push({ mesh: i % 2, pose: at(1.2 * x, 1.2 * y, 0.3 * (i % 7)) });
  }
  const pairs = [];
  for (let i = 0; pairs.length < 15000; ++i) {
    const a = i % (n * n - n);
    const b = i < n * n - n ? a + 1 : a + n;
    const depth = { a_in_b: [0.001 * i, 0.001 * i], b_in_a: [0.0005 * i, 0.0005 * i] };
    if (i % 5) pairs.push(pairOf({ a, b, crossing: 1, verdict: 'touching', fails: false, fails_below: 0 }));
    else pairs.push(pairOf({ a, b, crossing: 1, verdict: 'penetrating', fails_below: 0.001 * i, overlap_depth: depth }));
  }
  const penetrating = pairs.filter((pair) => pair.fails).length;
  const report = {
    version: 1,
    settings: { ...kSettings, tolerance: 1e-6, clearance: 0, regions: false, fail_on: ['penetration'] },
    objects,
    pairs,
    counts: { ...kCounts, penetrating, touching: 15000 - penetrating, fail: penetrating, candidates: 20000 },
  };
  const { numbers, groups } = groupsOf(ways);
  poses.forEach((pose, i) => (pose.group = numbers[i]));
  return compose({ report, scene: sceneOf('plant.stl', meshes, poses, { groups }), geometry: geometryText(meshes) });
}
