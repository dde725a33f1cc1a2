// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The little arithmetic on points that the page needs, in double precision.
import type { Vec3 } from './data';

export const add = (a: Vec3, b: Vec3): Vec3 => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a: Vec3, s: number): Vec3 => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const mix = (a: Vec3, b: Vec3, t: number): Vec3 => add(scale(a, 1 - t), scale(b, t));
export const cross = (a: Vec3, b: Vec3): Vec3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const length = (a: Vec3): number => Math.hypot(a[0], a[1], a[2]);

export interface Box {
  min: Vec3;
  max: Vec3;
}

export const emptyBox = (): Box => ({ min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] });
export const isEmpty = (box: Box): boolean => !(box.min[0] <= box.max[0]);
export const middleOf = (box: Box): Vec3 => (isEmpty(box) ? [0, 0, 0] : mix(box.min, box.max, 0.5));
export const radiusOf = (box: Box): number => (isEmpty(box) ? 0 : length(sub(box.max, box.min)) / 2);

export function grow(box: Box, ...points: Vec3[]): void {
  for (const p of points) {
    for (let k = 0; k < 3; ++k) {
      if (p[k] < box.min[k]) box.min[k] = p[k];
      if (p[k] > box.max[k]) box.max[k] = p[k];
    }
  }
}

export function unite(boxes: Iterable<Box>): Box {
  const all = emptyBox();
  for (const box of boxes) if (!isEmpty(box)) grow(all, box.min, box.max);
  return all;
}

export function cornersOf(box: Box): Vec3[] {
  return [...Array(8).keys()].map((i) => [
    (i & 1 ? box.max : box.min)[0],
    (i & 2 ? box.max : box.min)[1],
    (i & 4 ? box.max : box.min)[2],
  ]);
}
