// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// From where a contact can be seen: rays from points of it towards the viewer, against the triangles of its two parts.
import { Ray, Vector3 } from 'three';
import type { Vec3 } from './data';
import { matrixOf, type Pose } from './pose';
import { add, dot, length, scale } from './vector';

export interface Obstacle {
  positions: Float32Array;
  corners: Uint32Array;
  /** To the world. */
  pose: Pose;
}

/** So many ray and triangle tests are done while nobody notices. */
const kMostTests = 8_000_000;
const kPoints = 12;

/** Points of polylines, evenly taken. */
export function samplesOf(lines: Vec3[][]): Vec3[] {
  const points = lines.flat();
  const step = Math.max(1, Math.floor(points.length / kPoints));
  return points.filter((_, i) => i % step === 0).slice(0, kPoints);
}

const [kA, kB, kC, kHit] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];

function isBlocked({ positions, corners }: Obstacle, ray: Ray): boolean {
  for (let t = 0; t < corners.length; t += 3) {
    kA.fromArray(positions, 3 * corners[t]);
    kB.fromArray(positions, 3 * corners[t + 1]);
    kC.fromArray(positions, 3 * corners[t + 2]);
    if (ray.intersectTriangle(kA, kB, kC, false, kHit)) return true;
  }
  return false;
}

const kVertices = 24;

/** Corners of the triangles of a part, evenly taken, in the world. */
function verticesOf({ positions: p, corners, pose }: Obstacle): Vec3[] {
  const step = Math.max(1, Math.floor(corners.length / kVertices));
  const toWorld = matrixOf(pose);
  const points: Vec3[] = [];
  for (let i = 0; i < corners.length && points.length < kVertices; i += step) {
    points.push(new Vector3().fromArray(p, 3 * corners[i]).applyMatrix4(toWorld).toArray());
  }
  return points;
}

/** The share of the points that nothing hides from a far viewer in a direction. `gap`: what lies so near hides nothing. */
function seenShare(obstacles: Obstacle[], points: Vec3[], direction: Vec3, gap: number): number {
  // A flat pose has no way back, and what it places hides next to nothing.
  const solids = obstacles
    .map((obstacle) => ({ obstacle, toWorld: matrixOf(obstacle.pose) }))
    .filter(({ toWorld }) => toWorld.determinant() !== 0)
    .map(({ obstacle, toWorld }) => ({ obstacle, toLocal: toWorld.invert() }));
  const isHidden = (point: Vec3) => {
    const from = new Vector3(...add(point, scale(direction, gap)));
    return solids.some(({ obstacle, toLocal }) =>
      isBlocked(obstacle, new Ray(from.clone(), new Vector3(...direction)).applyMatrix4(toLocal)),
    );
  };
  const seen = points.filter((point) => !isHidden(point)).length;
  return seen / points.length;
}

export interface Sight {
  direction: Vec3;
  /** From none of the directions is much of it seen. */
  isBuried: boolean;
}

const kEnough = 0.6;
const kTooLittle = 0.25;

/** The direction to look from that is nearest to the present one and sees enough of the points. */
export function findSight(obstacles: Obstacle[], points: Vec3[], present: Vec3, gap: number): Sight {
  const triangles = obstacles.reduce((sum, { corners }) => sum + corners.length / 3, 0);
  const affordable = Math.floor(kMostTests / (triangles * points.length || 1));
  if (points.length === 0 || affordable < 1) return { direction: present, isBuried: false };
  const around: Vec3[] = [];
  for (let i = 0; i < 27; ++i) {
    const way: Vec3 = [(i % 3) - 1, (Math.floor(i / 3) % 3) - 1, Math.floor(i / 9) - 1];
    if (i !== 13) around.push(scale(way, 1 / length(way)));
  }
  around.sort((x, y) => dot(y, present) - dot(x, present));
  let best = { share: -1, direction: present };
  for (const direction of [present, ...around].slice(0, affordable)) {
    const share = seenShare(obstacles, points, direction, gap);
    if (share > best.share + 1e-9) best = { share, direction };
    if (best.share >= kEnough) break;
  }
  // Turning for nothing would only confuse.
  return best.share < kTooLittle
    ? { direction: present, isBuried: true }
    : { direction: best.direction, isBuried: false };
}

/** Whether next to nothing of a part is seen from a direction, as the other one is in the way. */
export function isHiddenBy(other: Obstacle, part: Obstacle, direction: Vec3, gap: number): boolean {
  if ((kVertices * other.corners.length) / 3 > kMostTests) return false;
  return seenShare([other], verticesOf(part), direction, gap) < kTooLittle;
}
