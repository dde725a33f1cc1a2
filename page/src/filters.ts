// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The controls above the list of clashes: what is shown of it, in which order, in which groups.
import {
  changeOf,
  type Clash,
  countVerdicts,
  emptyFilter,
  type Filter,
  type GroupKey,
  isFiltering,
  isWorse,
  kChanges,
  kWorse,
  type SortKey,
  verdictName,
} from './clashes';
import type { Report } from './data';
import { byId, button, chooser, el, searchField, setPressed } from './dom';
import { counted, nameText } from './format';
import type { Store } from './store';

type Choice = [value: string, text: string];

const named = (id: string, label: string) => ({ id, 'aria-label': label, title: label });

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
  private readonly search = searchField('clash-search', 'Filter', 'Filter by part names', 'clash-list', () =>
    this.store.filterBy({ text: this.search.value }),
  );
  private readonly clear = button('Clear filters', () => this.reset(), { id: 'clear-filters', class: 'link' });
  private readonly partNote = el('span', { class: 'part-note' });

  constructor(
    private readonly report: Report,
    private readonly clashes: Clash[],
    private readonly store: Store,
    private readonly partName: (id: number) => string,
  ) {
    const state = el('div', { class: 'line filter-state' }, this.partNote, this.clear);
    this.host.append(this.makeChips(), this.makeLine(), this.makeMore(), state);
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
    toggle: (filter: Filter) => Partial<Filter>,
  ): HTMLButtonElement {
    const flip = () => this.store.filterBy(toggle(this.store.state.filter));
    const element = button('', flip, { class: `chip ${classes}` });
    element.append(text, ' ', el('b', {}, counted(count)));
    element.hidden = count === 0;
    this.chips.push({ element, isOn });
    return element;
  }

  private makeChips(): HTMLElement {
    const found = this.clashes.filter((clash) => clash.pair);
    const resolved = this.clashes.length - found.length;
    const failing = found.filter((clash) => clash.pair!.fails).length;
    return el(
      'div',
      { class: 'chips', role: 'group', 'aria-label': 'Show only' },
      this.chip('failing', failing, 'failing', (filter) => filter.failing, ({ failing }) => ({ failing: !failing })),
      ...countVerdicts(found).map(([verdict, count]) =>
        this.chip(
          verdictName(verdict),
          count,
          `verdict ${verdict}`,
          (filter) => filter.verdicts.has(verdict),
          (filter) => {
            const verdicts = new Set(filter.verdicts);
            if (!verdicts.delete(verdict)) verdicts.add(verdict);
            return { verdicts };
          },
        ),
      ),
      this.chip('resolved', resolved, 'resolved', (filter) => filter.resolved, ({ resolved }) => ({ resolved: !resolved })),
    );
  }

  private makeLine(): HTMLElement {
    const isMotion = this.report.pairs.some((pair) => pair.span);
    const sorts: [SortKey, string][] = [
      ['rank', isMotion ? 'by time' : 'worst first'],
      ['depth', 'by depth'],
      ['distance', 'by distance'],
      ['area', 'by size'],
      ['name', 'by name'],
    ];
    // A motion comes without distances and areas.
    if (isMotion) sorts.splice(2, 2);
    const groups: [GroupKey, string][] = [
      ['none', 'no groups'],
      ['part', 'in parts'],
      ['types', 'in pairs of types'],
    ];
    if (this.report.pairs.some((pair) => pair.test)) groups.push(['test', 'in tests']);
    return el(
      'div',
      { class: 'line' },
      this.search,
      chooser(sorts, (sort) => this.store.set({ sort }), named('sort', 'Sort by')),
      chooser(groups, (group) => this.store.set({ group }), named('group', 'Group by')),
    );
  }

  private makeMore(): HTMLElement {
    const fields: HTMLElement[] = [];
    const { settings } = this.report;
    if ((settings && settings.depth_precision !== null) || this.report.pairs.some((pair) => pair.span?.overlap_depth))
      fields.push(numberField('Depth from', 'depth-from', (depthFrom) => this.store.filterBy({ depthFrom })));
    if (settings?.clearance)
      fields.push(numberField('Distance to', 'distance-to', (distanceTo) => this.store.filterBy({ distanceTo })));
    for (const key of ['test', 'status', 'change'] as const) {
      const values = valuesOf(this.report, key);
      if (!values.length) continue;
      const choices: Choice[] = [['', `any ${key}`], ...values];
      const onChange = (value: string) => this.store.filterBy({ [key]: value });
      fields.push(chooser(choices, onChange, named(`filter-${key}`, `Only of ${key}`)));
    }
    const line = el('div', { class: 'line' }, ...fields);
    line.hidden = !fields.length;
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
    this.clear.parentElement!.hidden = this.clear.hidden;
  }
}
