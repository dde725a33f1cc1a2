// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// From where a contact can be seen: rays from points of it towards the viewer, against the triangles of its two parts.
import type { Vec3 } from './data';
import { add, cross, dot, length, scale, sub } from './vector';

export interface Obstacle {
  positions: Float32Array;
  corners: Uint32Array;
  /** Row-major 3 x 4, to the world. */
  pose: number[];
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

function toLocal(pose: number[]): { point: (p: Vec3) => Vec3; way: (d: Vec3) => Vec3 } | null {
  const [x, y, z]: Vec3[] = [0, 1, 2].map((k) => [pose[k], pose[4 + k], pose[8 + k]]);
  const det = dot(x, cross(y, z));
  if (!(Math.abs(det) > 0)) return null;
  const rows = [cross(y, z), cross(z, x), cross(x, y)].map((row) => scale(row, 1 / det));
  const way = (d: Vec3): Vec3 => [dot(rows[0], d), dot(rows[1], d), dot(rows[2], d)];
  return { way, point: (p) => way(sub(p, [pose[3], pose[7], pose[11]])) };
}

/** Möller and Trumbore's test, from a little way along the ray. */
function isBlocked({ positions: p, corners }: Obstacle, from: Vec3, d: Vec3): boolean {
  const [dx, dy, dz] = d;
  const [ox, oy, oz] = from;
  for (let t = 0; t < corners.length; t += 3) {
    const a = 3 * corners[t];
    const b = 3 * corners[t + 1];
    const c = 3 * corners[t + 2];
    const ux = p[b] - p[a];
    const uy = p[b + 1] - p[a + 1];
    const uz = p[b + 2] - p[a + 2];
    const vx = p[c] - p[a];
    const vy = p[c + 1] - p[a + 1];
    const vz = p[c + 2] - p[a + 2];
    const px = dy * vz - dz * vy;
    const py = dz * vx - dx * vz;
    const pz = dx * vy - dy * vx;
    const det = ux * px + uy * py + uz * pz;
    if (det === 0) continue;
    const sx = ox - p[a];
    const sy = oy - p[a + 1];
    const sz = oz - p[a + 2];
    const u = (sx * px + sy * py + sz * pz) / det;
    if (!(u >= 0 && u <= 1)) continue;
    const qx = sy * uz - sz * uy;
    const qy = sz * ux - sx * uz;
    const qz = sx * uy - sy * ux;
    const v = (dx * qx + dy * qy + dz * qz) / det;
    if (!(v >= 0 && u + v <= 1)) continue;
    if ((vx * qx + vy * qy + vz * qz) / det > 0) return true;
  }
  return false;
}

const kVertices = 24;

/** Corners of the triangles of a part, evenly taken, in the world. */
function verticesOf({ positions: p, corners, pose }: Obstacle): Vec3[] {
  const step = Math.max(1, Math.floor(corners.length / kVertices));
  const points: Vec3[] = [];
  for (let i = 0; i < corners.length && points.length < kVertices; i += step) {
    const [x, y, z] = [0, 1, 2].map((k) => p[3 * corners[i] + k]);
    points.push(
      [0, 4, 8].map((row) => pose[row] * x + pose[row + 1] * y + pose[row + 2] * z + pose[row + 3]) as Vec3,
    );
  }
  return points;
}

/** The share of the points that nothing hides from a far viewer in a direction. `gap`: what lies so near hides nothing. */
function seenShare(obstacles: Obstacle[], points: Vec3[], direction: Vec3, gap: number): number {
  let seen = 0;
  for (const point of points) {
    const from = add(point, scale(direction, gap));
    const hidden = obstacles.some((obstacle) => {
      const local = toLocal(obstacle.pose);
      return local !== null && isBlocked(obstacle, local.point(from), local.way(direction));
    });
    if (!hidden) ++seen;
  }
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
