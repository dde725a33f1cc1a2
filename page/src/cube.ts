// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The cube in the corner that shows how the model stands; each of its faces is a button that turns it to the front.
import { type Camera, turned } from './camera';
import type { Vec3 } from './data';
import { button, el } from './dom';

interface Face {
  name: string;
  key: string;
  yaw: number;
  pitch: number;
  /** CSS: how the face is turned out of the front's plane. */
  turn: string;
  /** Outwards, in a frame whose third axis is up. */
  normal: Vec3;
}

const q = Math.PI / 2;

// prettier-ignore
export const kFaces: Face[] = [
  { name: 'Front', key: '1', yaw: 0, pitch: 0, turn: 'rotateY(0deg)', normal: [0, -1, 0] },
  { name: 'Back', key: '2', yaw: 2 * q, pitch: 0, turn: 'rotateY(180deg)', normal: [0, 1, 0] },
  { name: 'Left', key: '3', yaw: -q, pitch: 0, turn: 'rotateY(-90deg)', normal: [-1, 0, 0] },
  { name: 'Right', key: '4', yaw: q, pitch: 0, turn: 'rotateY(90deg)', normal: [1, 0, 0] },
  { name: 'Top', key: '5', yaw: 0, pitch: q, turn: 'rotateX(90deg)', normal: [0, 0, 1] },
  { name: 'Bottom', key: '6', yaw: 0, pitch: -q, turn: 'rotateX(-90deg)', normal: [0, 0, -1] },
];

export const faceTo = (camera: Camera, face: Face): void =>
  camera.fly({ yaw: face.yaw, pitch: face.pitch });

const axisName = (world: Vec3): string => {
  const k = world.findIndex((c) => c !== 0);
  return `${world[k] < 0 ? '−' : '+'}${'XYZ'[k]}`;
};

export class Cube {
  private readonly body = el('div', { class: 'cube-body' });
  private readonly buttons: HTMLButtonElement[];

  constructor(
    host: HTMLElement,
    private readonly camera: Camera,
  ) {
    this.buttons = kFaces.map((face) => {
      const side = button('', () => faceTo(camera, face));
      side.append(el('span', {}, face.name), el('small', {}));
      side.style.transform = `${face.turn} translateZ(calc(var(--cube) / 2))`;
      return side;
    });
    this.body.append(...this.buttons);
    host.append(this.body);
    this.update();
  }

  update(): void {
    const { yaw, pitch } = this.camera.stand;
    this.body.style.transform = `translateZ(calc(var(--cube) / -2)) rotateX(${-pitch}rad) rotateY(${-yaw}rad)`;
    kFaces.forEach((face, i) => {
      const name = axisName(turned(face.normal, this.camera.up));
      const [label, small] = [this.buttons[i].getAttribute('aria-label'), this.buttons[i].lastElementChild!];
      const wanted = `View from the ${face.name.toLowerCase()} (${name})`;
      if (label !== wanted) this.buttons[i].setAttribute('aria-label', wanted);
      if (small.textContent !== name) small.textContent = name;
    });
  }
}
