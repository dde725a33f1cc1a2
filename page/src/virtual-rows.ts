// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// A list of any length that keeps only the rows in sight in the document. The list itself has the focus; the row that the
// keyboard is at is told by aria-activedescendant.
import { el } from './dom';

/** Browsers give up on elements much taller than this. */
export const kTallest = 16_000_000;

/** A property of the style that is given in rem. */
export const pixelsOf = (element: HTMLElement, property: string): number =>
  parseFloat(getComputedStyle(element).getPropertyValue(property) || '1') *
  parseFloat(getComputedStyle(document.documentElement).fontSize);

export interface RowSource {
  count: number;
  /** Fills a new element. */
  fill: (row: HTMLElement, index: number) => void;
  /** Enter, space or a click. */
  onChoose: (index: number, event: Event) => void;
  /** Any other key; true if it was used. */
  onKey?: (index: number, event: KeyboardEvent) => boolean;
}

export class VirtualRows {
  current = -1;
  private readonly space = el('div', { class: 'rows-space', role: 'presentation' });
  private rows = new Map<number, HTMLElement>();
  private height = 1;
  private count = 0;
  private made = 0;
  private room = 0;

  constructor(
    readonly list: HTMLElement,
    private readonly role: string,
    readonly source: RowSource,
  ) {
    list.append(this.space);
    list.addEventListener('scroll', () => this.draw(), { passive: true });
    list.addEventListener('keydown', (event) => this.key(event));
    list.addEventListener('focus', () => {
      // The first in sight: a click on a row must find it where it was.
      if (this.current < 0 && this.count)
        this.moveTo(Math.min(this.count - 1, Math.ceil(list.scrollTop / this.height)));
    });
    this.space.addEventListener('click', (event) => {
      const row = (event.target as HTMLElement).closest<HTMLElement>('.row');
      if (!row) return;
      const index = Number(row.dataset.index);
      this.moveTo(index);
      this.source.onChoose(index, event);
    });
    new ResizeObserver(() => this.resized()).observe(list);
  }

  /** A row that was in sight stays in sight: choosing it may have opened a panel beside the list. */
  private resized(): void {
    const { scrollTop, clientHeight } = this.list;
    const top = this.current * this.height;
    const wasSeen = this.current >= 0 && top >= scrollTop && top + this.height <= scrollTop + this.room;
    this.room = clientHeight;
    this.refresh();
    if (wasSeen) this.moveTo(this.current);
  }

  /** Everything may have changed. */
  refresh(): void {
    this.height = pixelsOf(this.list, '--row');
    this.count = Math.min(this.source.count, Math.floor(kTallest / this.height));
    this.current = Math.min(this.current, this.count - 1);
    this.space.style.height = `${this.count * this.height}px`;
    this.space.replaceChildren();
    this.rows.clear();
    this.draw();
  }

  private draw(): void {
    const top = Math.floor(this.list.scrollTop / this.height) - 4;
    const end = Math.min(this.count, Math.ceil((this.list.scrollTop + this.list.clientHeight) / this.height) + 4);
    for (const [i, row] of this.rows) {
      if (i >= top && i < end) continue;
      row.remove();
      this.rows.delete(i);
    }
    for (let i = Math.max(0, top); i < end; ++i) if (!this.rows.has(i)) this.put(i);
    this.tellCurrent();
  }

  private put(index: number): void {
    const row = el('div', { role: this.role, class: 'row', id: `${this.list.id}-row-${this.made++}`, 'data-index': index });
    row.style.transform = `translateY(${index * this.height}px)`;
    this.source.fill(row, index);
    row.classList.toggle('current', index === this.current);
    // In the document's order, which is the one that is read out.
    let next: HTMLElement | null = null;
    for (const [i, other] of this.rows) if (i > index && (!next || i < Number(next.dataset.index))) next = other;
    this.space.insertBefore(row, next);
    this.rows.set(index, row);
  }

  private tellCurrent(): void {
    const row = this.rows.get(this.current);
    if (row) this.list.setAttribute('aria-activedescendant', row.id);
    else this.list.removeAttribute('aria-activedescendant');
  }

  moveTo(index: number): void {
    if (index < 0 || index >= this.count) return;
    this.rows.get(this.current)?.classList.remove('current');
    this.current = index;
    const top = index * this.height;
    const { scrollTop, clientHeight } = this.list;
    // One step scrolls by one row; from further away the row comes to the middle.
    const [above, below] = [scrollTop - top, top + this.height - scrollTop - clientHeight];
    if (Math.max(above, below) > 2 * this.height) this.list.scrollTop = top - (clientHeight - this.height) / 2;
    else if (above > 0) this.list.scrollTop = top;
    else if (below > 0) this.list.scrollTop = scrollTop + below;
    this.draw();
    this.rows.get(index)?.classList.add('current');
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target !== this.list) return;
    const page = Math.max(1, Math.floor(this.list.clientHeight / this.height) - 1);
    const goal = {
      ArrowDown: this.current + 1,
      ArrowUp: Math.max(0, this.current - 1),
      PageDown: Math.min(this.count - 1, this.current + page),
      PageUp: Math.max(0, this.current - page),
      Home: 0,
      End: this.count - 1,
    }[event.key];
    if (goal !== undefined) this.moveTo(goal);
    else if ((event.key === 'Enter' || event.key === ' ') && this.current >= 0)
      this.source.onChoose(this.current, event);
    else if (!(this.current >= 0 && this.source.onKey?.(this.current, event))) return;
    event.preventDefault();
    event.stopPropagation();
  }
}
