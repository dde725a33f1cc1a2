// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The controls above the list of clashes: what is shown of it, in which order, in which groups.
import {
  changeOf,
  type Clash,
  emptyFilter,
  type Filter,
  type GroupKey,
  isFiltering,
  isWorse,
  kChanges,
  kWorse,
  type SortKey,
} from './clashes';
import { kVerdicts, type Report } from './data';
import { byId, button, el, setPressed } from './dom';
import { counted, nameText } from './format';
import type { Store } from './store';

type Choice = [value: string, text: string];

function chooser(label: string, choices: Choice[], onChange: (value: string) => void, id: string): HTMLSelectElement {
  const select = el('select', { id, 'aria-label': label, title: label });
  for (const [value, text] of choices) select.append(el('option', { value }, text));
  select.addEventListener('change', () => onChange(select.value));
  return select;
}

function numberField(label: string, id: string, onChange: (value: number) => void): HTMLLabelElement {
  const input = el('input', { type: 'number', min: 0, step: 'any', id, inputmode: 'decimal' });
  input.addEventListener('input', () => onChange(input.value === '' ? NaN : Number(input.value)));
  return el('label', { class: 'field' }, el('span', {}, label), input);
}

/** The values that a key of triage takes in the report: changes as they are counted, the others sorted. */
function valuesOf(report: Report, key: 'test' | 'status' | 'change'): Choice[] {
  if (key === 'change') {
    const changes = new Set(report.pairs.map(changeOf));
    const choices: Choice[] = kChanges
      .filter((one) => changes.has(one))
      .map((one) => [one, one === 'new region' ? `with a ${one}` : one]);
    if (report.pairs.some(isWorse)) choices.push([kWorse, 'worse than before']);
    return choices;
  }
  const values = new Set<string>();
  for (const pair of report.pairs) if (pair[key]) values.add(pair[key]);
  if (key === 'test') for (const resolved of report.resolved ?? []) if (resolved.test) values.add(resolved.test);
  return [...values].sort().map((value) => [value, nameText(value, 60)]);
}

export class Filters {
  private readonly host = byId('filters');
  private readonly chips: { element: HTMLButtonElement; isOn: (filter: Filter) => boolean }[] = [];
  private readonly search = el('input', {
    type: 'search',
    placeholder: 'Filter',
    'aria-label': 'Filter by part names',
    id: 'clash-search',
  });
  private readonly clear = button('Clear filters', () => this.reset(), { id: 'clear-filters', class: 'link' });
  private readonly partNote = el('span', { class: 'part-note' });

  constructor(
    private readonly report: Report,
    private readonly clashes: Clash[],
    private readonly store: Store,
    private readonly partName: (id: number) => string,
  ) {
    this.host.append(this.makeChips(), this.makeLine(), this.makeMore(), this.makeState());
    store.listen((_, changed) => {
      if (changed.has('filter')) this.update();
    });
    this.update();
  }

  private chip(
    text: string,
    count: number,
    classes: string,
    isOn: (filter: Filter) => boolean,
    toggle: () => void,
  ): HTMLButtonElement {
    const element = button('', toggle, { class: `chip ${classes}` });
    element.append(text, ' ', el('b', {}, counted(count)));
    this.chips.push({ element, isOn });
    return element;
  }

  private makeChips(): HTMLElement {
    const chips = el('div', { class: 'chips', role: 'group', 'aria-label': 'Show only' });
    const failing = this.clashes.filter((clash) => clash.pair?.fails).length;
    if (failing) {
      const toggle = () => this.store.filterBy({ failing: !this.store.state.filter.failing });
      chips.append(this.chip('failing', failing, 'failing', (filter) => filter.failing, toggle));
    }
    for (const verdict of kVerdicts) {
      const count = this.clashes.filter((clash) => clash.pair && clash.verdict === verdict).length;
      if (!count) continue;
      const toggle = () => {
        const verdicts = new Set(this.store.state.filter.verdicts);
        if (!verdicts.delete(verdict)) verdicts.add(verdict);
        this.store.filterBy({ verdicts });
      };
      chips.append(
        this.chip(
          verdict === 'apart' ? 'too near' : verdict,
          count,
          `verdict ${verdict}`,
          (filter) => filter.verdicts.has(verdict),
          toggle,
        ),
      );
    }
    const resolved = this.report.resolved?.length ?? 0;
    if (resolved) {
      const toggle = () => this.store.filterBy({ resolved: !this.store.state.filter.resolved });
      chips.append(this.chip('resolved', resolved, 'resolved', (filter) => filter.resolved, toggle));
    }
    return chips;
  }

  private makeLine(): HTMLElement {
    this.search.addEventListener('input', () => this.store.filterBy({ text: this.search.value }));
    this.search.addEventListener('keydown', (event) => {
      if (event.key !== 'ArrowDown') return;
      event.preventDefault();
      byId('clash-list').focus();
    });
    const isMotion = this.report.pairs.some((pair) => pair.span);
    const sorts: Choice[] = [
      ['rank', isMotion ? 'by time' : 'by verdict'],
      ['depth', 'by depth'],
      ['distance', 'by distance'],
      ['area', 'by size'],
      ['name', 'by name'],
    ];
    // A motion comes without distances and areas.
    if (isMotion) sorts.splice(2, 2);
    const groups: Choice[] = [
      ['none', 'no groups'],
      ['part', 'in parts'],
      ['types', 'in pairs of types'],
    ];
    if (this.report.pairs.some((pair) => pair.test)) groups.push(['test', 'in tests']);
    return el(
      'div',
      { class: 'line' },
      this.search,
      chooser('Sort by', sorts, (value) => this.store.set({ sort: value as SortKey }), 'sort'),
      chooser('Group by', groups, (value) => this.store.set({ group: value as GroupKey }), 'group'),
    );
  }

  private makeMore(): HTMLElement {
    const fields: HTMLElement[] = [];
    const { settings } = this.report;
    if (settings?.depth || this.report.pairs.some((pair) => pair.span?.overlap_depth))
      fields.push(numberField('Depth from', 'depth-from', (depthFrom) => this.store.filterBy({ depthFrom })));
    if (settings?.clearance)
      fields.push(numberField('Distance to', 'distance-to', (distanceTo) => this.store.filterBy({ distanceTo })));
    for (const key of ['test', 'status', 'change'] as const) {
      const values = valuesOf(this.report, key);
      if (!values.length) continue;
      const choices: Choice[] = [['', `any ${key}`], ...values];
      fields.push(
        chooser(`Only of ${key}`, choices, (value) => this.store.filterBy({ [key]: value }), `filter-${key}`),
      );
    }
    const line = el('div', { class: 'line' }, ...fields);
    line.hidden = !fields.length;
    return line;
  }

  private makeState(): HTMLElement {
    const line = el('div', { class: 'line filter-state' }, this.partNote, this.clear);
    return line;
  }

  private reset(): void {
    for (const input of this.host.querySelectorAll('input')) input.value = '';
    for (const select of this.host.querySelectorAll<HTMLSelectElement>('select[id^=filter-]')) select.value = '';
    this.store.set({ filter: emptyFilter() });
    this.search.focus();
  }

  private update(): void {
    const { filter } = this.store.state;
    for (const { element, isOn } of this.chips) setPressed(element, isOn(filter));
    this.clear.hidden = !isFiltering(filter);
    const parts = filter.parts;
    this.partNote.textContent = !parts
      ? ''
      : parts.size === 1
        ? `only clashes of ${nameText(this.partName([...parts][0]), 60)}`
        : `only clashes of ${counted(parts.size)} parts`;
    this.clear.parentElement!.hidden = this.clear.hidden && !parts;
  }
}
