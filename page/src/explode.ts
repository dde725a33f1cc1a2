// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Drawing the parts away from the assembly's middle, or from the chosen clash.
import type { Vec3 } from './data';
import { chooser, el } from './dom';

export class Explode {
  readonly panel: HTMLElement;
  private readonly slider = el('input', {
    type: 'range',
    min: 0,
    max: 200,
    value: 0,
    id: 'explode-by',
    'aria-label': 'How far the parts are drawn apart',
  });
  private readonly about = chooser(
    [
      ['middle', 'from the middle'],
      ['clash', 'from the clash'],
    ],
    () => this.apply(),
    { id: 'explode-about', 'aria-label': 'Drawn apart from' },
  );

  constructor(
    private readonly middle: () => Vec3,
    private readonly clashPlace: () => Vec3 | null,
    private readonly onChange: (factor: number, centre: Vec3) => void,
  ) {
    this.slider.addEventListener('input', () => this.apply());
    this.panel = el('div', { class: 'tool-panel', id: 'explode-panel' }, this.slider, this.about);
  }

  get factor(): number {
    return Number(this.slider.value) / 100;
  }

  /** A new clash was chosen, or none. */
  follow(): void {
    if (this.factor > 0 && this.about.value === 'clash') this.apply();
  }

  private apply(): void {
    const centre = (this.about.value === 'clash' && this.clashPlace()) || this.middle();
    this.onChange(this.factor, centre);
  }
}
