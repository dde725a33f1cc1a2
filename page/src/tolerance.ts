// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// How many pairs fail at which tolerance: a chart, and a slider that leaves those in the list which still would.
import { type Clash, failsAt } from './clashes';
import type { Report } from './data';
import { byId, el } from './dom';
import { counted, plural, rounded } from './format';
import type { Store } from './store';

/** Stops of the slider: round numbers, twenty to a decade (R 20 of ISO 3), at most six decades of them. */
const kStops = 20;
const kMostStops = 6 * kStops;
const stopAt = (i: number): number => Number((10 ** (i / kStops)).toPrecision(2));
const placeOf = (tolerance: number): number => kStops * Math.log10(tolerance);

const [kWidth, kHeight] = [100, 40];

function svg(tag: string, attributes: Record<string, string | number>): SVGElement {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  return element;
}

/** The tolerance that was applied, of automatic ones the greatest. */
const appliedIn = ({ settings, pairs }: Report): number =>
  typeof settings?.tolerance === 'number'
    ? settings.tolerance
    : pairs.reduce((most, { tolerance }) => Math.max(most, tolerance ?? 0), 0);

interface Axis {
  first: number;
  last: number;
  /** The stop of the tolerance that was applied. */
  home: number;
}

/** From the tolerance that was applied, or what it excuses, to one that excuses all that any does. Lengths rise. */
function axisOf(lengths: number[], applied: number, isWhole: boolean): Axis {
  const most = lengths[lengths.length - 1];
  let last = Math.floor(placeOf(Math.max(most, applied)));
  while (stopAt(last) < most) ++last;
  const least = isWhole || applied === 0 ? Math.floor(placeOf(lengths[0])) - 1 : Infinity;
  const home = applied > 0 ? Math.round(placeOf(applied)) : -Infinity;
  const first = Math.max(Math.min(least, home > -Infinity ? home : least), last - kMostStops);
  return { first, last: Math.max(last, home, first + 1), home: Math.max(first, home) };
}

/** A line that goes down by one step for each of the lengths, left to right. */
function stepLine(shareOf: (tolerance: number) => number, lengths: number[], always: number): string {
  const all = always + lengths.length;
  const y = (count: number) => (kHeight * (1 - count / all)).toFixed(2);
  let count = always + lengths.filter((length) => shareOf(length) > 0).length;
  let line = `M0 ${y(count)}`;
  for (const length of lengths) {
    const share = shareOf(length);
    if (share > 0) line += `H${(kWidth * share).toFixed(3)}V${y(--count)}`;
  }
  return `${line}H${kWidth}`;
}

/** At powers of ten, no more than there is room for. */
function ticks({ first, last }: Axis, shareOf: (tolerance: number) => number): HTMLElement[] {
  const [from, to] = [Math.ceil(first / kStops), Math.floor(last / kStops)];
  const every = Math.ceil((to - from + 1) / 5);
  const found: HTMLElement[] = [];
  for (let power = from; power <= to; power += every) {
    const tick = el('span', { class: 'tick' }, rounded(Number(`1e${power}`)));
    tick.style.left = `${100 * shareOf(Number(`1e${power}`))}%`;
    found.push(tick);
  }
  return found;
}

/** Shows nothing where no tolerance excuses anything. */
export function showTolerance(report: Report, clashes: Clash[], store: Store): void {
  const { settings, tests } = report;
  const applied = appliedIn(report);
  // Smaller tolerances are of use where one was chosen for all. What it excuses may be none of what is new.
  const isWhole = settings?.tolerance !== 'auto' && !tests?.length && !settings?.fail_on.includes('new');
  const counts = clashes.filter((clash) => clash.pair && (clash.pair.fails || (isWhole && failsAt(clash, 0))));
  const isExcusable = (clash: Clash) => failsAt(clash, 0) && !failsAt(clash, Number.MAX_VALUE);
  const lengths = counts.filter(isExcusable).map((clash) => clash.failsBelow);
  if (!settings || report.pairs.length < 2 || !lengths.length) return;
  lengths.sort((x, y) => x - y);
  const axis = axisOf(lengths, applied, isWhole);
  const shareOf = (tolerance: number) =>
    Math.min(1, Math.max(0, (placeOf(tolerance) - axis.first) / (axis.last - axis.first)));

  const line = stepLine(shareOf, lengths, counts.length - lengths.length);
  const mark = (kind: string) => svg('path', { class: kind, 'vector-effect': 'non-scaling-stroke' });
  const [now, chosen, steps] = [mark('now'), mark('chosen'), mark('steps')];
  const stand = (element: SVGElement, share: number) => element.setAttribute('d', `M${kWidth * share} 0V${kHeight}`);
  stand(now, shareOf(applied));
  steps.setAttribute('d', line);
  const chart = svg('svg', { viewBox: `0 0 ${kWidth} ${kHeight}`, preserveAspectRatio: 'none', 'aria-hidden': 'true' });
  chart.append(svg('path', { class: 'area', d: `${line}V${kHeight}H0Z` }), now, steps, chosen);

  const slider = el('input', { type: 'range', id: 'tolerance-slider', min: axis.first, max: axis.last, step: 1 });
  const words = el('span', { class: 'tolerance-words' });
  const scale = el('div', { class: 'tolerance-scale', 'aria-hidden': 'true' }, ...ticks(axis, shareOf));
  const most = el('small', { 'aria-hidden': 'true' }, counted(counts.length));
  const plot = el('div', { class: 'tolerance-plot' }, chart, most);
  slider.addEventListener('input', () => {
    const stop = Number(slider.value);
    store.filterBy({ failsAt: stop === axis.home ? NaN : stopAt(stop) });
  });

  const unit = report.unit?.name ? `\u00a0${report.unit.name}` : '';
  const update = () => {
    const { failsAt: tolerance } = store.state.filter;
    const isNow = Number.isNaN(tolerance);
    slider.value = String(isNow ? axis.home : Math.round(placeOf(tolerance)));
    const doesFail = (clash: Clash) => (isNow ? clash.pair!.fails : failsAt(clash, tolerance));
    const count = counts.filter(doesFail).length;
    const told = count ? plural(count, 'pair fails', 'pairs fail') : 'no pair fails';
    words.textContent = `${isNow ? 'now' : `at ${rounded(tolerance)}${unit}`}: ${told}`;
    slider.setAttribute('aria-valuetext', words.textContent);
    stand(chosen, shareOf(isNow ? applied : tolerance));
  };
  store.listen((_, changed) => {
    if (changed.has('filter')) update();
  });
  update();
  const host = byId('tolerance');
  host.append(
    el('div', { class: 'line' }, el('label', { for: 'tolerance-slider' }, 'Tolerance'), words),
    el('div', {}, plot, slider, scale),
  );
  host.hidden = false;
}
