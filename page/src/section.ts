// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The sectioning plane: along an axis, or through the chosen clash and facing the viewer.
import type { Plane } from './assembly';
import type { Vec3 } from './data';
import { button, el, setPressed } from './dom';
import { type Box, cornersOf, dot, isEmpty, scale } from './vector';

type Axis = 'none' | 'x' | 'y' | 'z' | 'clash';

const kAxes: Record<'x' | 'y' | 'z', Vec3> = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
const kSteps = 1000;

export interface SectionWorld {
  bounds: () => Box;
  /** Towards the viewer. */
  back: () => Vec3;
  clashPlace: () => Vec3 | null;
  cut: (plane: Plane | null) => void;
}

export class Section {
  readonly panel: HTMLElement;
  private axis: Axis = 'none';
  private normal: Vec3 = kAxes.x;
  private isFlipped = false;
  private readonly slider = el('input', {
    type: 'range',
    min: 0,
    max: kSteps,
    value: kSteps / 2,
    id: 'section-place',
    'aria-label': 'Place of the section',
  });
  private readonly flip = button('Flip', () => this.turnOver(), { id: 'section-flip' });
  private readonly axes = new Map<Axis, HTMLButtonElement>();

  constructor(
    private readonly world: SectionWorld,
    private readonly onChange: (isOn: boolean) => void,
  ) {
    const names: [Axis, string, string][] = [
      ['none', 'Off', 'No section'],
      ['x', 'X', 'Across the X axis'],
      ['y', 'Y', 'Across the Y axis'],
      ['z', 'Z', 'Across the Z axis'],
      ['clash', 'Clash', 'Through the chosen clash, facing you'],
    ];
    const group = el('div', { class: 'segments', role: 'group', 'aria-label': 'Section' });
    for (const [axis, text, title] of names) {
      const choice = button(text, () => this.setAxis(axis), { title, 'data-axis': axis });
      this.axes.set(axis, choice);
      group.append(choice);
    }
    this.slider.addEventListener('input', () => this.apply());
    this.panel = el('div', { class: 'tool-panel', id: 'section-panel' }, group, this.slider, this.flip);
    this.update();
  }

  private get isOn(): boolean {
    return this.axis !== 'none';
  }

  private turnOver(): void {
    this.isFlipped = !this.isFlipped;
    this.apply();
  }

  private setAxis(axis: Axis): void {
    this.axis = axis;
    this.isFlipped = false;
    if (axis === 'clash') this.normal = this.world.back();
    else if (axis !== 'none') this.normal = kAxes[axis];
    const place = this.world.clashPlace();
    this.slider.value = String(kSteps / 2);
    if (axis !== 'none' && place) this.moveThrough(place);
    this.apply();
  }

  /** A new clash was chosen, or none. */
  follow(): void {
    const place = this.world.clashPlace();
    if (this.axis === 'clash' && place) this.moveThrough(place);
    this.apply();
  }

  private range(): [number, number] {
    const bounds = this.world.bounds();
    if (isEmpty(bounds)) return [0, 0];
    const along = cornersOf(bounds).map((corner) => dot(corner, this.normal));
    return [Math.min(...along), Math.max(...along)];
  }

  private through: Vec3 | null = null;

  private moveThrough(place: Vec3): void {
    const [low, high] = this.range();
    this.slider.value = String(Math.round((kSteps * (dot(place, this.normal) - low)) / (high - low || 1)));
    this.through = place;
  }

  private apply(): void {
    const [low, high] = this.range();
    let offset = low + (Number(this.slider.value) / kSteps) * (high - low);
    // Exactly through the clash, until the slider is moved off it.
    if (this.through) {
      const exact = dot(this.through, this.normal);
      if (Math.abs(exact - offset) <= (high - low) / kSteps) offset = exact;
    }
    const sign = this.isFlipped ? -1 : 1;
    this.world.cut(this.isOn ? { normal: scale(this.normal, sign), offset: sign * offset } : null);
    this.update();
  }

  private update(): void {
    for (const [axis, choice] of this.axes) setPressed(choice, axis === this.axis);
    this.axes.get('clash')!.disabled = !this.world.clashPlace() && this.axis !== 'clash';
    this.slider.disabled = this.flip.disabled = !this.isOn;
    setPressed(this.flip, this.isFlipped);
    this.onChange(this.isOn);
  }
}
