// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Single-linkage clusters of places: two are in one cluster if steps of at most a given length lead from one to the other.
import type { Vec3 } from './data';

/** A length for a model of this size: a fiftieth of the diagonal of all places, to one digit. */
export function usualLink(places: Vec3[]): number {
  const extent = [0, 1, 2].map((axis) => {
    let [low, high] = [Infinity, -Infinity];
    for (const place of places) [low, high] = [Math.min(low, place[axis]), Math.max(high, place[axis])];
    return Math.max(0, high - low);
  });
  return Number((Math.hypot(...extent) / 50).toPrecision(1));
}

/** For each place the index of the first one of its cluster. A place that is not known is a cluster of its own. */
export function clusters(places: (Vec3 | null)[], link: number): number[] {
  const parent = places.map((_, i) => i);
  const root = (i: number): number => {
    while (parent[i] !== i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const unite = (i: number, j: number) => {
    const [p, q] = [root(i), root(j)];
    parent[Math.max(p, q)] = Math.min(p, q);
  };
  // Two places in one cell are at most a link apart, and so is what is linked at most two cells away along each axis.
  const side = link / Math.sqrt(3);
  const cells = new Map<string, { cell: number[]; members: number[] }>();
  const isLinked = (p: Vec3, q: Vec3) => Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) <= link;
  const keyOf = (cell: number[]) => cell.join();
  places.forEach((place, i) => {
    if (!place || !(side > 0)) return;
    const cell = place.map((c) => Math.floor(c / side));
    const known = cells.get(keyOf(cell));
    if (known) known.members.push(i), unite(known.members[0], i);
    else cells.set(keyOf(cell), { cell, members: [i] });
  });
  const steps = [-2, -1, 0, 1, 2];
  for (const { cell, members } of cells.values())
    for (const x of steps)
      for (const y of steps)
        for (const z of steps) {
          const others = cells.get(keyOf([cell[0] + x, cell[1] + y, cell[2] + z]))?.members;
          if (!others || root(others[0]) === root(members[0])) continue;
          if (members.some((i) => others.some((j) => isLinked(places[i]!, places[j]!)))) unite(members[0], others[0]);
        }
  return parent.map((_, i) => root(i));
}
