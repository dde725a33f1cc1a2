// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The lanes under the timeline: one for each pair of parts that clash, with a bar from the start to the end of each clash.
// Only the lanes in sight are in the document.
import { type Clash, verbOf } from './clashes';
import { button, el, nameOf, setPressed } from './dom';
import { nameText, wholeSpanText } from './format';
import { kTallest, pixelsOf } from './virtual-rows';

export class Lanes {
  readonly space = el('div', { class: 'lanes', role: 'group', 'aria-label': 'When parts clash' });
  private lanes: Clash[][] = [];
  private readonly laneOf = new Map<Clash, number>();
  private drawn = new Map<number, HTMLElement>();
  private chosen: Clash | null = null;
  private height = 1;

  constructor(
    private readonly host: HTMLElement,
    private readonly shareOf: (time: number) => number,
    private readonly onChoose: (clash: Clash) => void,
  ) {
    host.addEventListener('scroll', () => this.draw(), { passive: true });
    new ResizeObserver(() => this.redraw()).observe(host);
  }

  show(clashes: Clash[]): void {
    const byPair = new Map<string, Clash[]>();
    for (const clash of clashes) {
      const key = `${clash.first} ${clash.second}`;
      const lane = byPair.get(key);
      if (lane) lane.push(clash);
      else byPair.set(key, [clash]);
    }
    this.lanes = [...byPair.values()];
    this.laneOf.clear();
    this.lanes.forEach((lane, i) => lane.forEach((clash) => this.laneOf.set(clash, i)));
    this.redraw();
  }

  choose(clash: Clash | null): void {
    this.chosen = clash;
    this.space.classList.toggle('has-chosen', clash !== null);
    const lane = clash ? this.laneOf.get(clash) : undefined;
    if (lane !== undefined) this.reveal(lane);
    for (const element of this.space.querySelectorAll<HTMLElement>('.span')) this.mark(element);
  }

  private mark(element: HTMLElement): void {
    setPressed(element, Number(element.dataset.rank) === this.chosen?.rank);
  }

  private reveal(lane: number): void {
    const { host, space } = this;
    const room = host.clientHeight - space.offsetTop;
    const top = lane * this.height;
    if (top < host.scrollTop) host.scrollTop = top;
    else if (top + this.height > host.scrollTop + room) host.scrollTop = top + this.height - room;
    this.draw();
  }

  private redraw(): void {
    this.height = pixelsOf(this.host, '--lane');
    this.space.style.height = `${Math.min(kTallest, this.lanes.length * this.height)}px`;
    for (const lane of this.drawn.values()) lane.remove();
    this.drawn.clear();
    this.draw();
  }

  private draw(): void {
    const top = Math.max(0, Math.floor(this.host.scrollTop / this.height) - 2);
    const end = Math.min(this.lanes.length, top + Math.ceil(this.host.clientHeight / this.height) + 4);
    for (const [i, lane] of this.drawn) {
      // What has the focus would lose it.
      if ((i >= top && i < end) || lane.contains(document.activeElement)) continue;
      lane.remove();
      this.drawn.delete(i);
    }
    for (let i = top; i < end; ++i) {
      if (this.drawn.has(i)) continue;
      const lane = this.makeLane(this.lanes[i]);
      lane.style.transform = `translateY(${i * this.height}px)`;
      this.drawn.set(i, lane);
      const after = [...this.drawn.keys()].filter((other) => other > i);
      this.space.insertBefore(lane, after.length ? this.drawn.get(Math.min(...after))! : null);
    }
  }

  private makeLane(clashes: Clash[]): HTMLElement {
    const [a, b] = clashes[0].names;
    const name = el('span', { class: 'lane-name', 'aria-hidden': 'true' }, nameOf(a, 60), ' × ', nameOf(b, 60));
    const field = el('div', { class: 'lane-field' }, ...clashes.map((clash) => this.makeSpan(clash)));
    return el('div', { class: 'lane' }, name, field);
  }

  private makeSpan(clash: Clash): HTMLElement {
    const span = clash.pair!.span!;
    const [from, to] = [this.shareOf(span.start), this.shareOf(span.end)];
    const [a, b] = clash.names.map((name) => nameText(name, 80));
    const text = `${a} ${verbOf(clash)} ${b}, ${wholeSpanText(span)}`;
    const element = button('', () => this.onChoose(clash), {
      class: `span verdict ${clash.verdict}`,
      'data-rank': String(clash.rank),
      'aria-label': text,
      title: text,
    });
    element.classList.toggle('from-start', span.isFromStart);
    element.classList.toggle('to-end', span.isToEnd);
    element.classList.toggle('passage', span.isPassage);
    element.style.left = `${100 * from}%`;
    element.style.width = `${100 * (to - from)}%`;
    const worst = el('span', { class: 'worst', 'aria-hidden': 'true' });
    const share = to > from ? (this.shareOf(span.worst_at) - from) / (to - from) : 0.5;
    worst.style.left = `${100 * Math.min(1, Math.max(0, share))}%`;
    element.append(worst);
    this.mark(element);
    return element;
  }
}
