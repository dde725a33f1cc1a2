// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Mouse, pen, touch and keyboard on the 3D view.
import type { View } from './view';

interface Held {
  x: number;
  y: number;
}

const kClick = 5; // CSS pixels that a pointer may stray in a click

export interface Wishes {
  onClick: (part: number, isTwice: boolean) => void;
  onRest: (part: number, x: number, y: number) => void;
  onLeave: () => void;
}

export class Controls {
  private readonly held = new Map<number, Held>();
  private strayed = 0;
  private rest = 0;
  private isPanning = false;

  constructor(
    private readonly view: View,
    private readonly wishes: Wishes,
  ) {
    const { canvas } = view;
    canvas.addEventListener('pointerdown', (event) => this.down(event));
    canvas.addEventListener('pointermove', (event) => this.move(event));
    canvas.addEventListener('pointerup', (event) => this.upOrGone(event, true));
    canvas.addEventListener('pointercancel', (event) => this.upOrGone(event, false));
    canvas.addEventListener('pointerleave', () => this.leave());
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    canvas.addEventListener('keydown', (event) => this.key(event));
  }

  private down(event: PointerEvent): void {
    this.view.canvas.setPointerCapture(event.pointerId);
    this.held.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
    if (this.held.size === 1) this.strayed = 0;
    this.isPanning = event.button !== 0 || event.shiftKey;
    this.leave();
  }

  private move(event: PointerEvent): void {
    const before = this.held.get(event.pointerId);
    if (!before) {
      this.waitForRest(event);
      return;
    }
    const now = { x: event.offsetX, y: event.offsetY };
    const [dx, dy] = [now.x - before.x, now.y - before.y];
    const { camera, canvas } = this.view;
    const half = canvas.clientHeight / 2;
    this.strayed += Math.hypot(dx, dy);
    if (this.held.size === 1) {
      if (this.strayed > kClick) {
        if (this.isPanning) camera.pan(dx / half, -dy / half);
        else camera.turn(-dx * 0.008, dy * 0.008);
      }
    } else if (this.held.size === 2) {
      const other = [...this.held].find(([id]) => id !== event.pointerId)![1];
      const spread = Math.hypot(before.x - other.x, before.y - other.y) / Math.hypot(now.x - other.x, now.y - other.y);
      camera.pan(dx / half / 2, -dy / half / 2);
      if (Number.isFinite(spread) && spread > 0)
        camera.zoom(spread, ...this.placeOf((now.x + other.x) / 2, (now.y + other.y) / 2));
    }
    this.held.set(event.pointerId, now);
  }

  private upOrGone(event: PointerEvent, isUp: boolean): void {
    const isLast = this.held.delete(event.pointerId) && this.held.size === 0;
    if (isLast && isUp && this.strayed <= kClick && event.button === 0) {
      this.wishes.onClick(this.view.pick(event.offsetX, event.offsetY), event.detail > 1);
    }
  }

  private waitForRest(event: PointerEvent): void {
    this.leave();
    if (event.pointerType !== 'mouse' || event.buttons) return;
    const { offsetX: x, offsetY: y } = event;
    this.rest = window.setTimeout(() => this.wishes.onRest(this.view.pick(x, y), x, y), 90);
  }

  private leave(): void {
    clearTimeout(this.rest);
    this.wishes.onLeave();
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    this.leave();
    const pixels = event.deltaY * [1, 16, 400][event.deltaMode];
    this.view.camera.zoom(
      Math.exp(Math.max(-1, Math.min(1, pixels * 0.0016))),
      ...this.placeOf(event.offsetX, event.offsetY),
    );
  }

  private placeOf(x: number, y: number): [number, number] {
    const { clientWidth: width, clientHeight: height } = this.view.canvas;
    return [(2 * x) / width - 1, 1 - (2 * y) / height];
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { camera } = this.view;
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (way && event.shiftKey) camera.pan(-way[0] * 0.15, -way[1] * 0.15);
    else if (way) camera.turn(way[0] * 0.12, way[1] * 0.12);
    else if (event.key === '+' || event.key === '=') camera.zoom(1 / 1.25);
    else if (event.key === '-') camera.zoom(1.25);
    else return;
    event.preventDefault();
  }
}
