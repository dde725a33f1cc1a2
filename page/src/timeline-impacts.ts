// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The impacts on the timeline: a mark at each moment at which two parts begin to clash, of another shape where that is
// over before the next frame. Marks that would lie on each other are one, and clicks on it go through its impacts.
import { type Clash, verbOf } from './clashes';
import { worst } from './colours';
import { button, el, setPressed } from './dom';
import { nameText, plural, rounded } from './format';

/** As wide as a mark is drawn. */
const kPixelsApart = 11;

interface Mark {
  /** By time. */
  impacts: Clash[];
  element: HTMLButtonElement;
}

const spanOf = (impact: Clash) => impact.pair!.span!;

export class Impacts {
  readonly field = el('div', { class: 'impacts-field', role: 'toolbar', 'aria-label': 'Impacts' });
  readonly row = el('div', { class: 'impacts' }, el('span', { class: 'impacts-name' }, 'Impacts'), this.field);
  private impacts: Clash[] = [];
  private marks: Mark[] = [];
  private chosen: Clash | null = null;

  constructor(
    private readonly shareOf: (time: number) => number,
    private readonly onChoose: (clash: Clash) => void,
  ) {
    this.field.addEventListener('keydown', (event) => this.key(event));
    new ResizeObserver(() => this.draw()).observe(this.field);
  }

  /** Of these clashes those whose beginning is known. */
  show(clashes: Clash[]): void {
    this.impacts = clashes.filter(({ pair }) => pair?.span && !pair.span.isFromStart);
    this.impacts.sort((x, y) => spanOf(x).start - spanOf(y).start || x.rank - y.rank);
    this.row.hidden = !this.impacts.length;
    this.draw();
  }

  choose(clash: Clash | null): void {
    this.chosen = clash;
    for (const mark of this.marks) setPressed(mark.element, clash !== null && mark.impacts.includes(clash));
    this.reach(this.marks.findIndex(({ impacts }) => clash && impacts.includes(clash)));
  }

  private draw(): void {
    const focused = this.marks.findIndex(({ element }) => element === document.activeElement);
    const hadFocus = this.marks[focused]?.impacts[0];
    const width = this.field.clientWidth;
    const placeOf = (impact: Clash) => this.shareOf(spanOf(impact).start) * width;
    const groups: Clash[][] = [];
    const last = new Map<boolean, Clash[]>();
    for (const impact of this.impacts) {
      const { isPassage } = spanOf(impact);
      const group = last.get(isPassage);
      if (group && placeOf(impact) - placeOf(group[0]) < kPixelsApart) {
        group.push(impact);
      } else {
        groups.push([impact]);
        last.set(isPassage, groups[groups.length - 1]);
      }
    }
    this.marks = groups.map((impacts) => this.makeMark(impacts));
    this.field.replaceChildren(...this.marks.map(({ element }) => element));
    this.choose(this.chosen);
    if (hadFocus) this.focus(this.marks.findIndex(({ impacts }) => impacts.includes(hadFocus)));
  }

  private makeMark(impacts: Clash[]): Mark {
    const [first, last] = [impacts[0], impacts[impacts.length - 1]].map((one) => spanOf(one).start);
    const text = impacts.length === 1 ? this.textOf(impacts[0]) : this.textOfMany(impacts, first, last);
    const verdict = impacts.map((one) => one.verdict).reduce(worst);
    const mark: Mark = {
      impacts,
      element: button('', () => this.onChoose(impacts[(impacts.indexOf(this.chosen!) + 1) % impacts.length]), {
        class: `impact verdict ${verdict}`,
        'aria-label': text,
        title: text,
      }),
    };
    mark.element.classList.toggle('passage', spanOf(impacts[0]).isPassage);
    mark.element.style.left = `${100 * this.shareOf(first)}%`;
    return mark;
  }

  private textOf(impact: Clash): string {
    const [a, b] = impact.names.map((name) => nameText(name, 80));
    const { start, isPassage } = spanOf(impact);
    return `${rounded(start)} s: ${a} ${verbOf(impact)} ${b}${isPassage ? ', between two frames only' : ''}`;
  }

  private textOfMany(impacts: Clash[], first: number, last: number): string {
    const times = rounded(first) === rounded(last) ? rounded(first) : `${rounded(first)} to ${rounded(last)}`;
    const only = spanOf(impacts[0]).isPassage ? ' between two frames only' : '';
    return `${times} s: ${plural(impacts.length, 'impact')}${only}; again for the next one`;
  }

  /** One of them is a stop of the Tab key, from which arrow keys go on. */
  private reach(index: number): void {
    const stop = index >= 0 ? index : Math.max(0, this.marks.findIndex(({ element }) => element.tabIndex === 0));
    this.marks.forEach(({ element }, i) => (element.tabIndex = i === stop ? 0 : -1));
  }

  private focus(index: number): void {
    this.reach(index);
    this.marks[index]?.element.focus();
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const last = this.marks.length - 1;
    const now = this.marks.findIndex(({ element }) => element === document.activeElement);
    const goal = { ArrowLeft: Math.max(0, now - 1), ArrowRight: Math.min(last, now + 1), Home: 0, End: last }[event.key];
    if (goal === undefined) return;
    this.focus(goal);
    event.preventDefault();
  }
}
