// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Poses between poses. In doubles, as all that knows world coordinates.

/** Row-major, 3 x 4. */
export type Pose = number[];
type Quaternion = [number, number, number, number];

/** Files hold rotations in single precision. */
const kRound = 1e-5;

function isRotation(p: Pose): boolean {
  const dot = (i: number, j: number) => p[i] * p[j] + p[i + 1] * p[j + 1] + p[i + 2] * p[j + 2];
  for (const i of [0, 4, 8]) {
    for (const j of [0, 4, 8]) if (Math.abs(dot(i, j) - Number(i === j)) > kRound) return false;
  }
  const turn =
    p[0] * (p[5] * p[10] - p[6] * p[9]) - p[1] * (p[4] * p[10] - p[6] * p[8]) + p[2] * (p[4] * p[9] - p[5] * p[8]);
  return turn > 0;
}

/** Shepperd's method: from the greatest of the four, so that nothing small is divided by. */
function quaternionOf(p: Pose): Quaternion {
  const [xx, yy, zz] = [p[0], p[5], p[10]];
  const squares = [1 + xx + yy + zz, 1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz];
  const greatest = squares.indexOf(Math.max(...squares));
  const [wx, wy, wz] = [p[9] - p[6], p[2] - p[8], p[4] - p[1]];
  const [xy, xz, yz] = [p[1] + p[4], p[2] + p[8], p[6] + p[9]];
  const square = squares[greatest];
  const rows: Quaternion[] = [
    [square, wx, wy, wz],
    [wx, square, xy, xz],
    [wy, xy, square, yz],
    [wz, xz, yz, square],
  ];
  const size = Math.hypot(...rows[greatest]);
  return rows[greatest].map((c) => c / size) as Quaternion;
}

function slerp(a: Quaternion, b: Quaternion, share: number): Quaternion {
  const cosine = a.reduce((sum, c, k) => sum + c * b[k], 0);
  // Both signs are the same rotation: the shorter way is taken.
  const sign = cosine < 0 ? -1 : 1;
  const angle = Math.acos(Math.min(1, Math.abs(cosine)));
  const sine = Math.sin(angle);
  const [u, v] =
    sine < 1e-6 ? [1 - share, share] : [Math.sin((1 - share) * angle) / sine, Math.sin(share * angle) / sine];
  const mixed = a.map((c, k) => u * c + v * sign * b[k]);
  const size = Math.hypot(...mixed);
  return mixed.map((c) => c / size) as Quaternion;
}

/** The rigid motion between two rigid poses; between others each number for itself. */
export function mixPoses(a: Pose, b: Pose, share: number): Pose {
  if (share <= 0 || a === b) return a;
  if (share >= 1) return b;
  const mixed = a.map((c, k) => c + (b[k] - c) * share);
  if (!isRotation(a) || !isRotation(b)) return mixed;
  const [w, x, y, z] = slerp(quaternionOf(a), quaternionOf(b), share);
  // prettier-ignore
  return [
    1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), mixed[3],
    2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), mixed[7],
    2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), mixed[11],
  ];
}
