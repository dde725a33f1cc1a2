// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// What the user has chosen. Whoever shows some of it listens.
import { type Clash, emptyFilter, type Filter, type GroupKey, type SortKey } from './clashes';

export interface State {
  clash: Clash | null;
  /** Index of a region of the clash, -1 for all. */
  region: number;
  part: number;
  /** Of the motion, in seconds. */
  time: number;
  hidden: Set<number>;
  others: 'fade' | 'hide' | 'show';
  glass: boolean;
  boxes: boolean;
  colourBy: 'type' | 'file' | 'verdict';
  filter: Filter;
  sort: SortKey;
  group: GroupKey;
  /** The longest step within a cluster. */
  link: number;
  /** Rises with each decision. */
  decided: number;
}

type Listener = (state: State, changed: ReadonlySet<keyof State>) => void;

export class Store {
  state: State = {
    clash: null,
    region: -1,
    part: -1,
    time: 0,
    hidden: new Set(),
    others: 'fade',
    glass: false,
    boxes: false,
    colourBy: 'type',
    filter: emptyFilter(),
    sort: 'rank',
    group: 'none',
    link: 0,
    decided: 0,
  };
  private readonly listeners: Listener[] = [];

  constructor(private readonly parts: number) {}

  listen(listener: Listener): void {
    this.listeners.push(listener);
  }

  set(patch: Partial<State>): void {
    const changed = new Set<keyof State>();
    for (const key of Object.keys(patch) as (keyof State)[]) {
      if (!Object.is(this.state[key], patch[key])) changed.add(key);
    }
    if (changed.size === 0) return;
    this.state = { ...this.state, ...patch };
    for (const listener of this.listeners) listener(this.state, changed);
  }

  filterBy(patch: Partial<Filter>): void {
    this.set({ filter: { ...this.state.filter, ...patch } });
  }

  /** Hides all parts but these. */
  isolate(parts: number[]): void {
    const hidden = new Set(Array(this.parts).keys());
    for (const id of parts) hidden.delete(id);
    this.set({ hidden });
  }

  /** Hides the parts, or shows them if none of them is seen. */
  toggleHidden(parts: number[]): void {
    const hidden = new Set(this.state.hidden);
    const areShown = parts.some((id) => !hidden.has(id));
    for (const id of parts) {
      if (areShown) hidden.add(id);
      else hidden.delete(id);
    }
    this.set({ hidden });
  }

  showAll(): void {
    this.set({ hidden: new Set() });
  }

  select(clash: Clash | null): void {
    const span = clash?.pair?.span;
    this.set({ clash, region: -1, ...(clash ? { part: -1 } : {}), ...(span ? { time: span.start } : {}) });
  }
}
