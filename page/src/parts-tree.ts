// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The tree of files, groups and parts.
import { type Clash, searchText, wordsOf } from './clashes';
import type { Report, SceneBlock } from './data';
import { byId, button, el, nameOf, searchField } from './dom';
import { counted, fileName, nameText, plural } from './format';
import type { Store } from './store';
import { VirtualRows } from './virtual-rows';

interface Node {
  label: string;
  level: number;
  parent: number;
  children: number[];
  /** Id of the part, -1 for a file or a group. */
  part: number;
  /** Place among siblings, from 1. */
  place: number;
}

const kOpenAll = 400;
const kDeepestIndent = 10;
const kMostLevels = 40;

export class PartsTree {
  private readonly nodes: Node[] = [];
  private readonly roots: number[] = [];
  private readonly leafOf: Int32Array;
  private readonly texts: string[];
  private readonly clashesOf: Int32Array;
  private readonly fails: Uint8Array;
  private readonly open = new Set<number>();
  private shown: number[] = [];
  private readonly rows: VirtualRows;
  private readonly search = searchField('parts-search', 'Search parts', 'Search parts', 'parts-tree', () => this.list());

  constructor(
    private readonly report: Report,
    scene: SceneBlock | null,
    clashes: Clash[],
    private readonly store: Store,
    private readonly onFit: (parts: number[]) => void,
  ) {
    const { objects } = report;
    this.leafOf = new Int32Array(objects.length);
    this.texts = objects.map((part) => `${searchText(part)}\n${part.product.toLowerCase()}`);
    this.clashesOf = new Int32Array(objects.length);
    this.fails = new Uint8Array(objects.length);
    for (const { pair, first, second } of clashes) {
      if (!pair) continue;
      ++this.clashesOf[first];
      ++this.clashesOf[second];
      // What clashes at some time of a motion is what it is run for.
      if (pair.fails || pair.span) this.fails[first] = this.fails[second] = 1;
    }
    this.build(scene);
    this.rows = new VirtualRows(byId('parts-tree'), 'treeitem', {
      count: 0,
      fill: (row, i) => this.fill(row, this.shown[i]),
      onChoose: (i, event) => this.choose(this.shown[i], event),
      onKey: (i, event) => this.key(this.shown[i], event),
    });
    this.makeTools();
    if (objects.length <= kOpenAll) this.nodes.forEach((_, i) => this.open.add(i));
    else if (this.roots.length === 1) this.open.add(this.roots[0]);
    this.list();
    store.listen((state, changed) => {
      if (changed.has('part') && state.part >= 0) this.reveal(state.part);
      else if (['part', 'clash', 'hidden', 'filter'].some((key) => changed.has(key as 'part')))
        this.rows.refresh();
    });
  }

  /** Groups come from the scene, node by node: names are shared, numbered, and have a slash in them. */
  private build(scene: SceneBlock | null): void {
    const ofFile = new Map<string, number>();
    const groups = scene?.groups ?? [];
    const ofGroup = new Int32Array(groups.length).fill(-1);
    const nodeOf = (file: string, group: number | undefined): number => {
      const fresh: number[] = [];
      let above = group;
      for (; above !== undefined && ofGroup[above] < 0; above = groups[above].parent) fresh.push(above);
      let node = above === undefined ? ofFile.get(file) : ofGroup[above];
      if (node === undefined) ofFile.set(file, (node = this.addNode(fileName(file), -1, -1)));
      for (const index of fresh.reverse()) {
        if (this.nodes[node].level <= kMostLevels) node = this.addNode(groups[index].name, node, -1);
        ofGroup[index] = node;
      }
      return node;
    };
    this.report.objects.forEach((part, i) => {
      this.leafOf[part.id] = this.addNode(part.name, nodeOf(part.file, scene?.objects[i].group), part.id);
    });
  }

  private addNode(label: string, parent: number, part: number): number {
    const siblings = parent < 0 ? this.roots : this.nodes[parent].children;
    const level = parent < 0 ? 1 : this.nodes[parent].level + 1;
    siblings.push(this.nodes.length);
    this.nodes.push({ label, level, parent, children: [], part, place: siblings.length });
    return this.nodes.length - 1;
  }

  private partsUnder(index: number): number[] {
    const { part, children } = this.nodes[index];
    return part >= 0 ? [part] : children.flatMap((child) => this.partsUnder(child));
  }

  private makeTools(): void {
    const showAll = button('Show all', () => this.store.showAll(), { id: 'show-all' });
    const update = () => {
      const { size } = this.store.state.hidden;
      showAll.disabled = size === 0;
      const total = counted(this.report.objects.length);
      byId('parts-count').textContent = size ? `${total}, ${counted(size)} hidden` : total;
    };
    this.store.listen(update);
    update();
    byId('parts-tools').append(el('div', { class: 'line' }, this.search, showAll));
  }

  /** Lists the nodes to show: those that are open, or, when something is searched, what matches and the way to it. */
  private list(): void {
    const words = wordsOf(this.search.value);
    let wanted: Uint8Array | null = null;
    if (words.length) {
      wanted = new Uint8Array(this.nodes.length);
      for (const [part, text] of this.texts.entries()) {
        if (!words.every((word) => text.includes(word))) continue;
        for (let i = this.leafOf[part]; i >= 0 && !wanted[i]; i = this.nodes[i].parent) wanted[i] = 1;
      }
    }
    this.shown = [];
    const enter = (index: number) => {
      if (wanted && !wanted[index]) return;
      this.shown.push(index);
      if (wanted || this.open.has(index)) this.nodes[index].children.forEach(enter);
    };
    this.roots.forEach(enter);
    this.rows.source.count = this.shown.length;
    this.rows.refresh();
  }

  private fill(row: HTMLElement, index: number): void {
    const node = this.nodes[index];
    const { hidden, part, clash } = this.store.state;
    const parts = this.partsUnder(index);
    const isGone = parts.every((id) => hidden.has(id));
    const isOpen = this.search.value !== '' || this.open.has(index);
    const siblings = node.parent < 0 ? this.roots : this.nodes[node.parent].children;
    row.className = 'row part';
    row.classList.toggle('gone', isGone);
    row.classList.toggle('group', node.part < 0);
    row.classList.toggle('side-a', clash !== null && node.part >= 0 && node.part === clash.first);
    row.classList.toggle('side-b', clash !== null && node.part >= 0 && node.part === clash.second);
    row.setAttribute('aria-level', String(node.level));
    row.setAttribute('aria-posinset', String(node.place));
    row.setAttribute('aria-setsize', String(siblings.length));
    row.setAttribute('aria-selected', String(node.part >= 0 && node.part === part));
    if (node.part < 0) row.setAttribute('aria-expanded', String(isOpen));
    const indent = el('span', { class: 'indent', 'aria-hidden': 'true' }, node.part < 0 ? (isOpen ? '▾' : '▸') : '');
    indent.style.marginInlineStart = `${Math.min(kDeepestIndent, node.level - 1) * 0.8}rem`;
    const clashes = parts.reduce((sum, id) => sum + this.clashesOf[id], 0);
    const count = node.part < 0 ? `${counted(parts.length)}` : clashes ? counted(clashes) : '';
    const words = node.part < 0 ? plural(parts.length, 'part') : plural(clashes, 'clash', 'clashes');
    row.setAttribute('aria-label', `${nameText(node.label, 120)}, ${words}${isGone ? ', hidden' : ''}`);
    const badge = el('span', { class: 'badge', title: words }, count);
    badge.classList.toggle('failing', node.part >= 0 && this.fails[node.part] === 1);
    if (!count) badge.hidden = true;
    const eye = el('span', { class: 'eye', title: isGone ? 'Show (H)' : 'Hide (H)', 'data-act': 'hide' });
    row.replaceChildren(indent, nameOf(node.label), badge, eye);
  }

  private choose(index: number, event: Event): void {
    const node = this.nodes[index];
    if ((event.target as HTMLElement).dataset?.act === 'hide') {
      this.store.toggleHidden(this.partsUnder(index));
    } else if (node.part >= 0) {
      this.store.set({
        part: node.part === this.store.state.part && event.type === 'click' ? -1 : node.part,
        clash: null,
      });
      if (event instanceof MouseEvent && event.detail > 1) this.onFit([node.part]);
    } else {
      this.toggleOpen(index);
    }
  }

  private toggleOpen(index: number, wanted = !this.open.has(index)): void {
    if (wanted) this.open.add(index);
    else this.open.delete(index);
    this.list();
  }

  private key(index: number, event: KeyboardEvent): boolean {
    const node = this.nodes[index];
    const parts = this.partsUnder(index);
    if (event.key === 'ArrowRight' && node.part < 0) {
      if (!this.open.has(index)) this.toggleOpen(index, true);
      else this.rows.moveTo(this.rows.current + 1);
    } else if (event.key === 'ArrowLeft') {
      if (node.part < 0 && this.open.has(index) && !this.search.value) this.toggleOpen(index, false);
      else if (node.parent >= 0) this.rows.moveTo(this.shown.indexOf(node.parent));
    } else if (event.key === 'h') {
      this.store.toggleHidden(parts);
    } else if (event.key === 'i') {
      this.store.isolate(parts);
      this.onFit(parts);
    } else if (event.key === 'c') {
      this.store.filterBy({ parts: new Set(parts) });
    } else {
      return false;
    }
    return true;
  }

  private reveal(part: number): void {
    if (!this.shown.includes(this.leafOf[part])) this.search.value = '';
    for (let i = this.nodes[this.leafOf[part]].parent; i >= 0; i = this.nodes[i].parent) this.open.add(i);
    this.list();
    this.rows.moveTo(this.shown.indexOf(this.leafOf[part]));
  }
}
