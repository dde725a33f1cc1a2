// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Poses between poses. In doubles, as all that knows world coordinates.
import { Matrix4, Quaternion } from 'three';

/** Row-major, 3 x 4. */
export type Pose = number[];

/** Files hold rotations in single precision. */
const kRound = 1e-5;

export const matrixOf = (p: Pose): Matrix4 =>
  new Matrix4(p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8], p[9], p[10], p[11], 0, 0, 0, 1);

function isRotation(p: Pose): boolean {
  const dot = (i: number, j: number) => p[i] * p[j] + p[i + 1] * p[j + 1] + p[i + 2] * p[j + 2];
  for (const i of [0, 4, 8]) {
    for (const j of [0, 4, 8]) if (Math.abs(dot(i, j) - Number(i === j)) > kRound) return false;
  }
  return matrixOf(p).determinant() > 0;
}

/** The rigid motion between two rigid poses; between others each number for itself. */
export function mixPoses(a: Pose, b: Pose, share: number): Pose {
  if (share <= 0 || a === b) return a;
  if (share >= 1) return b;
  const mixed = a.map((c, k) => c + (b[k] - c) * share);
  if (!isRotation(a) || !isRotation(b)) return mixed;
  const [from, to] = [a, b].map((pose) => new Quaternion().setFromRotationMatrix(matrixOf(pose)).normalize());
  // Three.js keeps matrices by columns.
  const turned = new Matrix4().makeRotationFromQuaternion(from.slerp(to, share)).elements;
  return mixed.map((c, k) => (k % 4 === 3 ? c : turned[4 * (k % 4) + (k >> 2)]));
}
