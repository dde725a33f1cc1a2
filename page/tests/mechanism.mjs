// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// A mechanism made by hand: an arm that turns about z by a quarter in each step of a second, a slider that moves along x, a
// panel that grows, and a wall that stands still.
import { compose, geometryText, sceneOf } from './compose.mjs';
import { box, kMarkup } from './fixture.mjs';

export const kTimes = [0, 1, 2, 3, 4];

const turned = (angle, [x, y, z]) => {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return [c, -s, 0, x, s, c, 0, y, 0, 0, 1, z];
};
const placed = ([x, y, z], size = 1) => [size, 0, 0, x, 0, size, 0, y, 0, 0, size, z];

/** `lanes`: so many more pairs clash, for lists that are long. */
export function mechanism({ offset = [0, 0, 0], lanes = 0 } = {}) {
  const meshes = [box(4, 0.5, 0.5), box(1, 1, 1, 2), box(0.25, 3, 3)];
  const from = (x, y, z) => [x, y, z].map((c, k) => c + offset[k]);
  const moves = [
    { id: 0, poses: kTimes.map((t) => turned((t * Math.PI) / 2, from(0, 0, 0))) },
    { id: 1, poses: kTimes.map((t) => placed(from(-3 + 2 * t, 3, 0))) },
    { id: 3, poses: kTimes.map((t) => placed(from(0, -4, 0), 1 + t)) },
  ];
  const names = ['arm', 'slider', 'wall', kMarkup];
  const poses = [moves[0].poses[0], moves[1].poses[0], placed(from(4, 3, 0)), moves[2].poses[0]];
  const meshOf = [0, 1, 2, 1];
  for (let i = 0; i < lanes; ++i) {
    names.push(`peg ${i}`);
    poses.push(placed(from(-6 + i * 0.1, 6, 0)));
    meshOf.push(1);
  }
  const objects = names.map((name, id) => ({
    id,
    name,
    path: name,
    product: '',
    file: 'machine.glb',
    triangles: meshes[meshOf[id]].corners.length / 3,
    closed: null,
    class: null,
    volume: null,
  }));
  const depth = (d) => ({ a_in_b: [d * 0.99, d], b_in_a: null });
  const spans = [
    { a: 1, b: 2, from: [2.5, 2.50000003], point: [3.75, 3, 0], to: [3.5, 3.50000003], worst: 'penetrating', worst_at: 3, overlap_depth: depth(0.75) },
    { a: 0, b: 1, from: [1.25, 1.25000003], point: null, to: [1.75, 1.75000003], worst: 'penetrating', worst_at: 1.5, overlap_depth: depth(1.5) },
    { a: 0, b: 3, from: null, to: [0.5, 0.6], worst: 'crossing', worst_at: 0, overlap_depth: null },
    { a: 0, b: 1, from: [3.25, 3.5], to: null, worst: 'inside', worst_at: 4, overlap_depth: depth(0.5) },
  ]; // prettier-ignore
  for (let i = 0; i < lanes; ++i) {
    const start = 0.001 + (3 * i) / lanes;
    spans.push({ a: 2, b: 4 + i, from: [start, start], to: [start + 0.5, start + 0.5], worst: 'crossing', worst_at: start, overlap_depth: null }); // prettier-ignore
  }
  return {
    report: { version: 1, settings: null, objects, pairs: [], counts: null },
    scene: { ...sceneOf('machine.glb', meshes, meshOf.map((mesh, id) => ({ mesh, pose: poses[id] }))), up: 'y' }, // prettier-ignore
    geometry: geometryText(meshes),
    motion: {
      version: 1,
      animation: { name: 'run', seconds: 4, frames: 4, step: 1 },
      times: kTimes,
      objects: moves,
      spans,
    },
  };
}

export const mechanismPage = (options) => compose(mechanism(options));
