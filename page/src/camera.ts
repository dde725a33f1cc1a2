// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// A camera that turns about a target as on a turntable, and flies. All of it in doubles.
import { MathUtils, PerspectiveCamera, Vector3 } from 'three';
import type { Vec3 } from './data';
import { add, type Box, cornersOf, cross, dot, middleOf, mix, scale, sub } from './vector';

export type UpAxis = 'y' | 'z';

export interface Stand {
  target: Vec3;
  /** Radians: 0 looks from the front, a quarter turn from the right. */
  yaw: number;
  /** Radians above the horizon. */
  pitch: number;
  distance: number;
}

const kHalfAngle = (17 * Math.PI) / 180;
const kFlight = 420; // milliseconds
const kMargin = 1.1;
const kQuarter = Math.PI / 2;

/** From a frame whose third axis is up to the world. */
export const turned = ([x, y, z]: Vec3, up: UpAxis): Vec3 => (up === 'z' ? [x, y, z] : [x, z, -y]);

export class Camera {
  readonly eye = new PerspectiveCamera();
  stand: Stand = { target: [0, 0, 0], yaw: -0.65, pitch: 0.45, distance: 10 };
  up: UpAxis = 'z';
  isParallel = false;
  aspect = 1;
  private flight: { from: Stand; to: Stand; start: number } | null = null;

  constructor(
    private readonly isStill: () => boolean,
    private readonly onMove: () => void,
  ) {
    this.eye.matrixAutoUpdate = false;
  }

  /** Unit vectors to the right, up, and towards the viewer. */
  axes({ yaw, pitch }: Pick<Stand, 'yaw' | 'pitch'> = this.stand): { right: Vec3; up: Vec3; back: Vec3 } {
    const back: Vec3 = [Math.sin(yaw) * Math.cos(pitch), -Math.cos(yaw) * Math.cos(pitch), Math.sin(pitch)];
    const right: Vec3 = [Math.cos(yaw), Math.sin(yaw), 0];
    return { right: turned(right, this.up), up: turned(cross(back, right), this.up), back: turned(back, this.up) };
  }

  /** The angles from which one looks when the viewer is in a direction. */
  anglesTo(direction: Vec3): { yaw: number; pitch: number } {
    const [x, y, z] = this.up === 'z' ? direction : [direction[0], -direction[2], direction[1]];
    const pitch = Math.asin(MathUtils.clamp(z, -1, 1));
    return { yaw: Math.hypot(x, y) > 1e-9 ? Math.atan2(x, -y) : this.stand.yaw, pitch };
  }

  /** Towards the viewer at the end of the flight. */
  goalBack(): Vec3 {
    return this.axes(this.flight?.to ?? this.stand).back;
  }

  get isFlying(): boolean {
    return this.flight !== null;
  }

  fly(to: Partial<Stand>): void {
    const goal = { ...(this.flight?.to ?? this.stand), ...to };
    goal.yaw = this.stand.yaw + turnBetween(this.stand.yaw, goal.yaw);
    if (this.isStill()) {
      this.flight = null;
      this.stand = goal;
    } else {
      this.flight = { from: this.stand, to: goal, start: performance.now() };
    }
    this.onMove();
  }

  /** Takes the next step of a flight. */
  step(now: number): void {
    if (!this.flight) return;
    const { from, to, start } = this.flight;
    const t = Math.min(1, Math.max(0, (now - start) / kFlight));
    const s = t < 0.5 ? 4 * t * t * t : 1 - (-2 * t + 2) ** 3 / 2;
    this.stand = {
      target: mix(from.target, to.target, s),
      yaw: from.yaw + s * (to.yaw - from.yaw),
      pitch: from.pitch + s * (to.pitch - from.pitch),
      distance: from.distance ** (1 - s) * to.distance ** s,
    };
    if (t >= 1) this.flight = null;
  }

  /** How far away a ball must be to fill the view. */
  distanceFor(radius: number): number {
    const narrow = Math.min(1, this.aspect);
    return radius / Math.sin(Math.atan(Math.tan(kHalfAngle) * narrow));
  }

  /** How far from a box's middle it fills the view, as the camera stands. */
  distanceForBox(box: Box): number {
    const { right, up, back } = this.axes();
    const middle = middleOf(box);
    const rise = Math.tan(kHalfAngle);
    let distance = 0;
    for (const corner of cornersOf(box)) {
      const from = sub(corner, middle);
      const needed = Math.max(Math.abs(dot(from, up)), Math.abs(dot(from, right)) / this.aspect) / rise;
      distance = Math.max(distance, needed + dot(from, back));
    }
    return distance * kMargin;
  }

  turn(yaw: number, pitch: number): void {
    this.flight = null;
    this.stand.yaw += yaw;
    this.stand.pitch = MathUtils.clamp(this.stand.pitch + pitch, -kQuarter, kQuarter);
    this.onMove();
  }

  /** Half the height of what is seen at the target's distance. */
  halfHeight(): number {
    return this.stand.distance * Math.tan(kHalfAngle);
  }

  /** By fractions of half the view's height. */
  pan(x: number, y: number): void {
    this.flight = null;
    const { right, up } = this.axes();
    const size = this.halfHeight();
    this.stand.target = add(this.stand.target, add(scale(right, -x * size), scale(up, -y * size)));
    this.onMove();
  }

  /** Nearer by the factor, towards the place of the view (-1 to 1 both ways) that it is done at. */
  zoom(factor: number, x = 0, y = 0): void {
    this.flight = null;
    const distance = Math.max(1e-12, this.stand.distance * factor);
    const change = 1 - distance / this.stand.distance;
    this.pan(-x * this.aspect * change, -y * change);
    this.stand.distance = distance;
    this.onMove();
  }

  /** Sets the matrices for a world given relative to `origin`, of which the ball is to be seen. */
  update(origin: Vec3, middle: Vec3, radius: number): void {
    const { right, up, back } = this.axes();
    const { target, distance } = this.stand;
    const [x, y, z] = [right, up, back].map((axis) => new Vector3(...axis));
    this.eye.matrixWorld.makeBasis(x, y, z).setPosition(...add(sub(target, origin), scale(back, distance)));
    this.eye.matrixWorldInverse.copy(this.eye.matrixWorld).invert();
    this.eye.matrixWorldAutoUpdate = false;
    const depth = dot(sub(target, middle), back) + distance;
    const top = this.halfHeight();
    const reach = Math.max(radius, 1e-12) * 1.02;
    if (this.isParallel) {
      const wide = top * this.aspect;
      this.eye.projectionMatrix.makeOrthographic(-wide, wide, top, -top, depth - reach, depth + reach);
    } else {
      const far = Math.max(depth + reach, distance * 1e-3);
      const near = Math.max(depth - reach, Math.min(distance, far) * 0.02);
      const size = (top / distance) * near;
      this.eye.projectionMatrix.makePerspective(-size * this.aspect, size * this.aspect, size, -size, near, far);
    }
    this.eye.projectionMatrixInverse.copy(this.eye.projectionMatrix).invert();
  }
}

/** The shorter way round, in radians. */
const turnBetween = (from: number, to: number): number =>
  MathUtils.euclideanModulo(to - from + Math.PI, 2 * Math.PI) - Math.PI;
