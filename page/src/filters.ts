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
  propertyOf,
  sorted,
  type SortKey,
  type Trait,
  traitTitle,
  traitValues,
  verdictName,
} from './clashes';
import type { Report } from './data';
import { byId, button, chooser, el, labelled, searchField, setPressed } from './dom';
import { counted, nameText } from './format';
import type { Store } from './store';

type Choice = [value: string, text: string];

const named = (id: string, label: string) => ({ id, 'aria-label': label, title: label });

function numberField(id: string, value: number, onChange: (value: number) => void): HTMLInputElement {
  const input = el('input', { type: 'number', min: 0, step: 'any', id, inputmode: 'decimal' });
  if (!Number.isNaN(value)) input.value = String(value);
  input.addEventListener('input', () => onChange(input.value === '' ? NaN : Number(input.value)));
  return input;
}

const kChosen = ['test', 'status', 'assignee', 'change', 'class', 'storey', 'axes'] as const;

/** The values that something takes in the report: changes as they are counted, the others sorted. */
function valuesOf(report: Report, key: (typeof kChosen)[number]): Choice[] {
  if (key === 'class' || key === 'storey')
    return sorted(report.objects.flatMap((part) => propertyOf(part, key))).map((value) => [value, nameText(value, 60)]);
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
  return sorted([...values]).map((value) => [value, nameText(value, 60)]);
}

export class Filters {
  private readonly host = byId('filters');
  private readonly chips: { element: HTMLButtonElement; isOn: (filter: Filter) => boolean }[] = [];
  private readonly search = searchField(
    'clash-search',
    'Filter',
    'Filter by names, classes, storeys, tags and GlobalIds of the parts, and by axes',
    'clash-list',
    () => this.store.filterBy({ text: this.search.value }),
  );
  private readonly clear = button('Clear filters', () => this.reset(), { id: 'clear-filters', class: 'link' });
  private readonly partNote = el('span', { class: 'part-note' });
  private readonly choosers = new Map<(typeof kChosen)[number], HTMLSelectElement>();
  /** What is typed, and what of the filter it is. */
  private readonly typed: [HTMLInputElement, 'text' | 'depthFrom' | 'distanceTo'][] = [[this.search, 'text']];
  private readonly link: HTMLElement;

  constructor(
    private readonly report: Report,
    private readonly clashes: Clash[],
    private readonly store: Store,
    private readonly partName: (id: number) => string,
  ) {
    this.link = labelled(
      'linked within',
      numberField('link', store.state.link, (link) => this.store.set({ link })),
    );
    const state = el('div', { class: 'line filter-state' }, this.partNote, this.clear);
    this.host.append(this.makeChips(), this.makeLine(), this.makeMore(), state);
    store.listen((_, changed) => {
      if (changed.has('decided')) this.fillChoosers();
      if (changed.has('filter') || changed.has('group')) this.update();
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
    if (this.report.settings?.volumes) sorts.splice(2, 0, ['volume', 'by volume']);
    const groups: [GroupKey, string][] = [
      ['none', 'no groups'],
      ['part', 'in parts'],
      ['types', 'in pairs of types'],
    ];
    if (this.report.pairs.some((pair) => pair.test)) groups.push(['test', 'in tests']);
    const traits: [Trait, string][] = [
      ['storey', 'in storeys'],
      ['class', 'in pairs of classes'],
      ['file', 'in pairs of files'],
    ];
    groups.push(...traits.filter(([trait]) => traitValues(this.report.objects, trait).length > 1));
    if (!isMotion) groups.push(['place', 'in clusters']);
    return el(
      'div',
      { class: 'line' },
      this.search,
      chooser(sorts, (sort) => this.store.set({ sort }), named('sort', 'Sort by')),
      chooser(groups, (group) => this.store.set({ group }), named('group', 'Group by')),
    );
  }

  private makeMore(): HTMLElement {
    const fields = [this.link];
    const { settings } = this.report;
    if ((settings && settings.depth_precision !== null) || this.report.pairs.some((pair) => pair.span?.overlap_depth))
      fields.push(this.limit('Depth from', 'depth-from', 'depthFrom'));
    if (settings?.clearance) fields.push(this.limit('Distance to', 'distance-to', 'distanceTo'));
    for (const key of kChosen) {
      const onChange = (value: string) => this.store.filterBy({ [key]: value });
      this.choosers.set(key, chooser([], onChange, named(`filter-${key}`, `Only of ${key}`)));
    }
    this.fillChoosers();
    return el('div', { class: 'line more' }, ...fields, ...this.choosers.values());
  }

  private limit(label: string, id: string, key: 'depthFrom' | 'distanceTo'): HTMLElement {
    const input = numberField(id, NaN, (value) => this.store.filterBy({ [key]: value }));
    this.typed.push([input, key]);
    const unit = this.report.unit?.name;
    return labelled(unit ? `${label} (${unit})` : label, input);
  }

  private fillChoosers(): void {
    const { filter } = this.store.state;
    for (const [key, element] of this.choosers) {
      const values = valuesOf(this.report, key);
      // What is chosen stays, though nothing has it any more.
      if (filter[key] && !values.some(([value]) => value === filter[key])) values.push([filter[key], filter[key]]);
      const choices: Choice[] = [['', `any ${key}`], ...values];
      element.replaceChildren(...choices.map(([value, text]) => el('option', { value }, text)));
      element.value = filter[key];
      element.hidden = !values.length;
    }
  }

  private reset(): void {
    this.store.set({ filter: emptyFilter() });
    this.search.focus();
  }

  private update(): void {
    const { filter, group } = this.store.state;
    this.link.hidden = group !== 'place';
    for (const [key, element] of this.choosers) element.value = filter[key];
    for (const [input, key] of this.typed)
      if (input !== document.activeElement && (filter[key] === '' || Number.isNaN(filter[key]))) input.value = '';
    for (const { element, isOn } of this.chips) setPressed(element, isOn(filter));
    this.clear.hidden = !isFiltering(filter);
    const { parts, traits } = filter;
    const notes: string[] = [];
    if (parts?.size === 1) notes.push(`only clashes of ${nameText(this.partName([...parts][0]), 60)}`);
    else if (parts) notes.push(`only clashes of ${counted(parts.size)} parts`);
    if (traits) notes.push(`only ${nameText(traitTitle(traits.values, traits.trait), 120)}`);
    this.partNote.textContent = notes.join('; ');
    this.clear.parentElement!.hidden = this.clear.hidden;
  }
}
