// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The bar under the 3D view.
import type { Camera } from './camera';
import { byId, button, chooser, el, labelled, setPressed } from './dom';
import type { Explode } from './explode';
import type { Section } from './section';
import type { Store } from './store';

function checkbox(text: string, input: HTMLInputElement, key: string, onChange: (isOn: boolean) => void): HTMLElement {
  input.addEventListener('change', () => onChange(input.checked));
  return el('label', { class: 'check' }, input, ` ${text} `, el('kbd', { 'aria-hidden': 'true' }, key));
}

export interface ToolActions {
  fit: () => void;
  redraw: () => void;
  camera: Camera;
}

export class Tools {
  private readonly panels = new Map<string, { panel: HTMLElement; button: HTMLButtonElement }>();
  private readonly parallel = el('input', { type: 'checkbox', id: 'parallel' });
  private readonly host = byId('tools');

  constructor(
    private readonly store: Store,
    private readonly isMotion: boolean,
    section: Section,
    explode: Explode,
    private readonly actions: ToolActions,
  ) {
    const bar = el('div', { class: 'bar' });
    bar.append(button('Fit', actions.fit, { title: 'Fit (F)', id: 'fit' }));
    const look = this.lookPanel();
    for (const [name, title, panel] of [
      ['section', 'Section', section.panel],
      ['explode', 'Explode', explode.panel],
      ['look', 'Look', look],
    ] as const) {
      const opener = button(title, () => this.toggle(name), {
        id: `${name}-button`,
        'aria-expanded': 'false',
        'aria-controls': panel.id,
      });
      panel.hidden = true;
      this.panels.set(name, { panel, button: opener });
      bar.append(opener);
    }
    this.host.append(section.panel, explode.panel, look, bar);
  }

  private storedCheck(text: string, id: 'glass' | 'boxes', key: string): HTMLElement {
    const input = el('input', { type: 'checkbox', id });
    this.store.listen((state) => (input.checked = state[id]));
    return checkbox(text, input, key, (isOn) => this.store.set({ [id]: isOn }));
  }

  private lookPanel(): HTMLElement {
    const { camera } = this.actions;
    const colours = chooser(
      [
        ['type', 'by type'],
        ['file', 'by file'],
        ['verdict', this.isMotion ? 'by what clashes now' : 'by worst verdict'],
      ],
      (colourBy) => this.store.set({ colourBy }),
      { id: 'colour-by' },
    );
    colours.value = this.store.state.colourBy;
    const others = chooser(
      (['fade', 'hide', 'show'] as const).map((one) => [one, one]),
      (others) => this.store.set({ others }),
      { id: 'others' },
    );
    const upwards = chooser(
      [
        ['y', 'Y'],
        ['z', 'Z'],
      ],
      (up) => {
        camera.up = up;
        this.actions.redraw();
      },
      { id: 'up-axis' },
    );
    return el(
      'div',
      { class: 'tool-panel column', id: 'look-panel' },
      labelled('Colours', colours),
      labelled('Other parts', others),
      labelled('Upwards', upwards),
      this.storedCheck('See through A and B', 'glass', 'X'),
      this.storedCheck('Boxes of the regions', 'boxes', 'B'),
      checkbox('Parallel view', this.parallel, 'P', (isParallel) => this.setParallel(isParallel)),
    );
  }

  toggle(name: string): void {
    for (const [other, { panel, button: opener }] of this.panels) {
      panel.hidden = other !== name || !panel.hidden;
      opener.setAttribute('aria-expanded', String(!panel.hidden));
    }
    const { panel } = this.panels.get(name)!;
    if (!panel.hidden) panel.querySelector<HTMLElement>('button, input, select')!.focus();
    else this.panels.get(name)!.button.focus();
  }

  /** Closes the open panel; false if there is none. */
  close(): boolean {
    const open = [...this.panels].find(([, { panel }]) => !panel.hidden);
    if (open) this.toggle(open[0]);
    return open !== undefined;
  }

  mark(name: string, isOn: boolean): void {
    const opener = this.panels.get(name)?.button;
    if (opener) setPressed(opener, isOn);
  }

  setParallel(isParallel: boolean): void {
    this.parallel.checked = isParallel;
    this.actions.camera.isParallel = isParallel;
    this.actions.redraw();
  }
}
