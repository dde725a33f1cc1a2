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
  // Two places in one cell are at most a link apart, and places that are linked at most two cells along each axis. Cells are
  // numbered by the numbers of their coordinates, which are fewer than the places.
  const side = link / Math.sqrt(3);
  const numbers = [0, 1, 2].map(() => new Map<number, number>());
  const numberOf = (cell: number[]): number =>
    cell.reduce((sum, c, axis) => sum * places.length + (numbers[axis].get(c) ?? NaN), 0);
  const cells = new Map<number, { cell: number[]; members: number[] }>();
  places.forEach((place, i) => {
    if (!place || !(side > 0)) return;
    const cell = place.map((c) => Math.floor(c / side));
    cell.forEach((c, axis) => numbers[axis].has(c) || numbers[axis].set(c, numbers[axis].size));
    const known = cells.get(numberOf(cell));
    if (known) known.members.push(i), unite(known.members[0], i);
    else cells.set(numberOf(cell), { cell, members: [i] });
  });
  const isLinked = (p: Vec3, q: Vec3) => (p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2 + (p[2] - q[2]) ** 2 <= link ** 2;
  const steps = [-2, -1, 0, 1, 2];
  // Half of the cells around, and none of their own: the others see them.
  const around = steps.flatMap((x) => steps.flatMap((y) => steps.map((z) => [x, y, z]))).slice(0, 62);
  for (const { cell, members } of cells.values())
    for (const step of around) {
      const others = cells.get(numberOf(cell.map((c, axis) => c + step[axis])))?.members;
      if (!others || root(others[0]) === root(members[0])) continue;
      if (members.some((i) => others.some((j) => isLinked(places[i]!, places[j]!)))) unite(members[0], others[0]);
    }
  return parent.map((_, i) => root(i));
}
