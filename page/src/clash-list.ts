// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The list of clashes.
import {
  changeOf,
  type Clash,
  countVerdicts,
  filterClashes,
  type Group,
  groupClashes,
  isFiltering,
  isWorse,
  type PartWords,
  sortClashes,
  toldDepth,
  verbOf,
  verdictName,
} from './clashes';
import { byId, el, intervalOf, lengthOf, nameOf, volumeOf } from './dom';
import { counted, nameText, plural, rounded, spanText, volumeText, wholeSpanText } from './format';
import type { Store } from './store';
import { VirtualRows } from './virtual-rows';

type Row = { clash: Clash } | { group: Group };

const kListed = byId('clash-list');

export class ClashList {
  /** What passes the filter, in order. */
  visible: Clash[] = [];
  private groups: Group[] = [];
  private rowsShown: Row[] = [];
  /** Keys of the groups that are not as they are at first. */
  private readonly turned = new Set<string>();
  private readonly rows: VirtualRows;

  constructor(
    private readonly clashes: Clash[],
    private readonly words: PartWords,
    private readonly store: Store,
  ) {
    this.rows = new VirtualRows(kListed, 'row', {
      count: 0,
      fill: (row, i) => this.fill(row, i),
      onChoose: (i) => this.choose(i),
      onKey: (i, event) => this.key(i, event),
    });
    store.listen((_, changed) => {
      if (changed.has('group')) this.turned.clear();
      if ((['filter', 'sort', 'group', 'link', 'decided'] as const).some((key) => changed.has(key))) this.update();
      else if (changed.has('clash')) this.reveal();
    });
    this.update();
  }

  private get total(): number {
    return this.clashes.filter((clash) => clash.pair).length;
  }

  private update(): void {
    const { filter, sort, group, link, clash } = this.store.state;
    this.visible = sortClashes(filterClashes(this.clashes, filter), sort);
    this.groups = group === 'none' ? [] : groupClashes(this.visible, group, this.words, link);
    if (group === 'none') {
      this.rowsShown = this.visible.map((one) => ({ clash: one }));
    } else {
      this.rowsShown = [];
      for (const one of this.groups) {
        // What is near nothing else needs no line to stand under.
        const isAlone = group === 'place' && one.clashes.length === 1;
        if (!isAlone) this.rowsShown.push({ group: one });
        if (isAlone || !this.isClosed(one)) for (const member of one.clashes) this.rowsShown.push({ clash: member });
      }
    }
    kListed.setAttribute('role', group === 'none' ? 'grid' : 'treegrid');
    kListed.setAttribute('aria-rowcount', String(this.rowsShown.length));
    const { total } = this;
    byId('clashes-count').textContent =
      this.visible.length === total ? counted(total) : `${counted(this.visible.length)} of ${counted(total)}`;
    this.rows.source.count = this.rowsShown.length;
    kListed.classList.toggle('empty', this.rowsShown.length === 0);
    kListed.dataset.empty = total ? 'No clash passes the filters.' : 'No two parts clash.';
    this.rows.current = clash ? this.rowsShown.findIndex((row) => 'clash' in row && row.clash === clash) : -1;
    this.rows.refresh();
  }

  private reveal(): void {
    const { clash } = this.store.state;
    const current = this.rowsShown[this.rows.current];
    // Under both of its parts a clash has two rows; the one that was chosen stays.
    if (clash && !(current && 'clash' in current && current.clash === clash)) {
      this.rows.moveTo(this.rowsShown.findIndex((row) => 'clash' in row && row.clash === clash));
    }
    this.rows.refresh();
  }

  /** The clashes that one stands with: those of its group, or without groups of a list that is filtered. */
  around(clash: Clash): Clash[] {
    const { group, filter } = this.store.state;
    if (group !== 'none') return this.groups.find((one) => one.clashes.includes(clash))?.clashes ?? [];
    return isFiltering(filter) && this.visible.includes(clash) ? this.visible : [];
  }

  /** The next clash of the list in a direction, from the chosen one. */
  step(by: 1 | -1): void {
    let i = this.rows.current;
    if (i < 0) i = by > 0 ? -1 : 0;
    for (i += by; i >= 0 && i < this.rowsShown.length; i += by) {
      const row = this.rowsShown[i];
      if (!('clash' in row)) continue;
      this.rows.moveTo(i);
      this.store.select(row.clash);
      return;
    }
  }

  private choose(index: number): void {
    const row = this.rowsShown[index];
    if ('group' in row) this.toggle(row.group);
    else this.store.select(row.clash);
  }

  /** Clusters are closed at first, and what people know to look for is open. */
  private isClosed(group: Group): boolean {
    return this.turned.has(group.key) !== (this.store.state.group === 'place');
  }

  private toggle(group: Group, isClosed = !this.isClosed(group)): void {
    const { scrollTop } = kListed;
    if (isClosed !== this.isClosed(group) && !this.turned.delete(group.key)) this.turned.add(group.key);
    this.update();
    kListed.scrollTop = scrollTop;
    this.rows.moveTo(this.rowsShown.findIndex((row) => 'group' in row && row.group.key === group.key));
  }

  private key(index: number, event: KeyboardEvent): boolean {
    const row = this.rowsShown[index];
    if (!('group' in row)) return false;
    if (event.key !== 'ArrowLeft' && event.key !== 'ArrowRight') return false;
    this.toggle(row.group, event.key === 'ArrowLeft');
    return true;
  }

  private fill(row: HTMLElement, index: number): void {
    const shown = this.rowsShown[index];
    row.setAttribute('aria-rowindex', String(index + 1));
    if ('group' in shown) this.fillGroup(row, shown.group);
    else this.fillClash(row, shown.clash);
  }

  private fillGroup(row: HTMLElement, group: Group): void {
    const isOpen = !this.isClosed(group);
    row.className = 'row clash-group';
    row.setAttribute('aria-level', '1');
    row.setAttribute('aria-expanded', String(isOpen));
    const worst = group.clashes.reduce((best, clash) => (clash.rank < best.rank ? clash : best));
    row.replaceChildren(
      el(
        'span',
        { role: 'gridcell', class: `group-title verdict ${worst.verdict}` },
        el('span', { class: 'indent', 'aria-hidden': 'true' }, isOpen ? '▾' : '▸'),
        el('span', { class: 'names' }, nameOf(group.title), el('small', {}, verdictsOf(group))),
      ),
      el(
        'span',
        { role: 'gridcell', class: 'badge', title: plural(group.clashes.length, 'clash', 'clashes') },
        counted(group.clashes.length),
      ),
    );
  }

  private fillClash(row: HTMLElement, clash: Clash): void {
    row.className = `row clash verdict ${clash.verdict}`;
    row.classList.toggle('is-resolved', clash.resolved !== null);
    row.setAttribute('aria-selected', String(clash === this.store.state.clash));
    if (this.store.state.group !== 'none') row.setAttribute('aria-level', '2');
    const verb = verbOf(clash);
    const second = el('span', { class: 'second' }, el('span', { class: 'verb' }, `${verb} `), nameOf(clash.names[1]));
    const tags = el('span', { class: 'tags' });
    if (clash.resolved) tags.append(el('span', { class: 'tag' }, 'resolved'));
    const change = clash.pair && changeOf(clash.pair);
    if (change && change !== 'persisting') tags.append(el('span', { class: 'tag new' }, change));
    if (isWorse(clash.pair)) tags.append(el('span', { class: 'tag new' }, 'worse'));
    if (clash.pair?.status) tags.append(el('span', { class: 'tag' }, nameText(clash.pair.status, 24)));
    row.replaceChildren(
      el('span', { role: 'gridcell', class: 'rank' }, counted(clash.rank)),
      el('span', { role: 'gridcell', class: 'names' }, el('span', { class: 'first' }, nameOf(clash.names[0])), second),
      el('span', { role: 'gridcell', class: 'figures' }, this.mainFigure(clash), this.sideFigure(clash, tags)),
    );
  }

  private mainFigure(clash: Clash): HTMLElement {
    const main = el('span', { class: 'main' });
    if (!Number.isNaN(clash.depth)) main.append(el('small', {}, 'depth '), ...intervalOf(...toldDepth(clash)));
    else if (!Number.isNaN(clash.distance)) main.append(el('small', {}, 'gap '), lengthOf(clash.distance));
    return main;
  }

  private sideFigure(clash: Clash, tags: HTMLElement): HTMLElement {
    if (tags.childNodes.length) return tags;
    const side = el('span', { class: 'side' });
    const span = clash.pair?.span;
    const regions = clash.pair?.regions?.length ?? 0;
    if (span) side.append(el('small', {}, spanText(span)));
    else if (!Number.isNaN(clash.volume)) side.append(el('small', {}, 'volume '), volumeOf(clash.volume));
    else if (clash.area > 0) side.append(el('small', {}, 'area '), lengthOf(clash.area, 2));
    else if (regions) side.append(el('small', {}, plural(regions, 'region')));
    return side;
  }
}

/** How many of each verdict. */
function verdictsOf(group: Group): string {
  return countVerdicts(group.clashes)
    .map(([verdict, count]) => `${counted(count)} ${verdictName(verdict)}`)
    .join(', ');
}

/** One sentence, as it is read out. */
export function sentenceOf(clash: Clash, place: string): string {
  const [a, b] = clash.names.map((name) => nameText(name, 80));
  const parts = [`${a} ${verbOf(clash)} ${b}`];
  if (!Number.isNaN(clash.depth)) parts.push(`depth ${[...new Set(toldDepth(clash))].map(rounded).join(' to ')}`);
  if (!Number.isNaN(clash.volume)) parts.push(`volume ${volumeText(clash.volume)}`);
  if (!Number.isNaN(clash.distance)) parts.push(`distance ${rounded(clash.distance)}`);
  if (clash.pair?.span) parts.push(wholeSpanText(clash.pair.span));
  return `${clash.resolved ? 'Resolved clash' : 'Clash'} ${place}: ${parts.join(', ')}`;
}
