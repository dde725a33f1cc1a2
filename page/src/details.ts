// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The figures of the chosen clash or part.
import { type Clash, isWorse, newRegionsOf, propertyOf, sorted, verbOf } from './clashes';
import type { Interval, Pair, Part, Region, Report, Vec3 } from './data';
import { type Decisions, kDecisionKeys, saidOf } from './decisions';
import { byId, button, chooser, countOf, el, intervalOf, lengthOf, letterOf, nameOf, numberOf, volumeOf } from './dom';
import { counted, fileName, nameText } from './format';
import type { PlacedSpan } from './motion';
import type { Store } from './store';

function changeText(clash: Clash): string[] | null {
  if (clash.resolved) return ['resolved'];
  if (!clash.pair?.change) return null;
  const { change, was, verdict } = clash.pair;
  const fresh = newRegionsOf(clash.pair);
  const regions = fresh === 0 ? '' : fresh === 1 ? ', with a new region' : `, with ${counted(fresh)} new regions`;
  if (!was || was === verdict) return [change + regions];
  return [`${change}${regions}${isWorse(clash.pair) ? ', and worse' : ''}: it was ${was}`];
}

type Value = (Node | string)[];

const kindOf = (part: Part): string => (part.class === 'cracked' ? 'cracked solid' : (part.class ?? ''));

/** Up to which tolerance it fails; nothing of what does not overlap. */
function failsBelowText({ failsBelow }: Clash): Value | null {
  if (failsBelow === Infinity) return ['any tolerance'];
  return failsBelow > 0 ? ['a tolerance of ', lengthOf(failsBelow)] : null;
}

const kPropertyNames: Record<string, string> = { class: 'Class', storey: 'Storey', building: 'Building', ObjectType: 'Type' };
const kRegionsAtOnce = 60;

const storeysOf = ({ parts }: Clash): string => sorted(parts.flatMap((part) => propertyOf(part, 'storey'))).join(' / ');

const triple = (p: Vec3, last: HTMLElement): Value => [numberOf(p[0]), ', ', numberOf(p[1]), ', ', last];
const point = (p: Vec3): Value => triple(p, lengthOf(p[2]));

const measured = (value: number | null | undefined, power: 1 | 2 = 1): Value | null =>
  value == null ? null : [lengthOf(value, power)];

const texts = (values: string[]): Value | null =>
  values.length ? values.flatMap((value, i) => [i ? ', ' : '', nameOf(value, 2000)]) : null;

function figures(rows: [string, Value | null][]): HTMLElement {
  const list = el('dl');
  for (const [term, value] of rows) {
    if (value) list.append(el('dt', {}, term), el('dd', {}, ...value));
  }
  return list;
}

export class Details {
  private readonly body = byId('details-body');
  private all: HTMLButtonElement | null = null;

  constructor(
    private readonly report: Report,
    private readonly decisions: Decisions,
    private readonly clashesOf: (part: number) => number,
    private readonly store: Store,
    private readonly around: (clash: Clash) => Clash[],
    private readonly fit: (parts: number[]) => void,
  ) {
    store.listen((_, changed) => {
      if (changed.has('clash') || changed.has('part')) this.show();
      else if (changed.has('region')) this.markRegion();
      else if (changed.has('hidden')) this.show();
      if ((['decided', 'filter', 'group', 'link'] as const).some((key) => changed.has(key))) this.offerAll();
    });
    this.show();
  }

  private show(): void {
    const { clash, part } = this.store.state;
    document.body.classList.toggle('idle', !clash && part < 0);
    if (clash) this.body.replaceChildren(...this.ofClash(clash));
    else if (part >= 0) this.body.replaceChildren(...this.ofPart(this.report.objects[part]));
    else this.body.replaceChildren(el('p', { class: 'hint' }, this.hint()));
    this.body.scrollTop = 0;
  }

  private hint(): string {
    return this.report.pairs.length
      ? 'Choose a clash in the list, or a part in the view, to see its figures. J and K go through the clashes.'
      : 'Choose a part, in the view or in the tree, to see its figures.';
  }

  private ofClash(clash: Clash): Node[] {
    const nodes: Node[] = [
      el(
        'div',
        { class: `sentence verdict ${clash.verdict}` },
        this.partLink(clash, 0),
        el('span', { class: 'verb' }, verbOf(clash)),
        this.partLink(clash, 1),
      ),
    ];
    const about = clash.pair ?? clash.resolved!;
    if (clash.pair?.id) nodes.push(this.decision(clash, clash.pair));
    if (clash.pair?.note) nodes.push(el('p', { class: 'note' }, `Note: ${clash.pair.note}.`));
    for (const [letter, id] of [
      ['A', clash.first],
      ['B', clash.second],
    ] as const) {
      const lost = this.report.objects[id]?.incomplete;
      if (lost) nodes.push(el('p', { class: 'note' }, `Shape of ${letter} incomplete: `, nameOf(lost, 300), '.'));
    }
    nodes.push(
      figures([
        ['Change', changeText(clash)],
        ['Test', about.test ? [nameOf(about.test)] : null],
        ['Axes', clash.pair?.axes ? [nameOf([clash.pair.axes, storeysOf(clash)].filter(Boolean).join(', '))] : null],
      ]),
    );
    const span = clash.pair?.span;
    if (clash.pair) nodes.push(this.measures(clash, clash.pair));
    if (span) nodes.push(this.ofSpan(clash, span));
    else if (clash.pair) nodes.push(this.facts(clash, clash.pair), ...this.regions(clash.pair));
    return nodes;
  }

  /** The fields of a decision, each of which is kept as it is typed: the list may change under a click that ends typing. */
  private decision(clash: Clash, pair: Pair): HTMLElement {
    const statuses = this.decisions.statuses.map((one): [string, string] => [one, nameText(one, 60)]);
    const fields = {
      status: chooser([['', '–'], ...statuses], (status) => this.decisions.decide([pair], { status }), {}),
      assignee: el('input', { type: 'text', dir: 'auto', autocomplete: 'off' }),
      due: el('input', { type: 'date', max: '9999-12-31' }),
      comment: el('textarea', { rows: 2, dir: 'auto' }),
    };
    this.all = button('', () => this.decideAll(clash, pair), { id: 'decide-all' });
    this.offerAll();
    const host = el('div', { class: 'decision', role: 'group', 'aria-label': 'Decision' });
    for (const key of kDecisionKeys) {
      const field = fields[key];
      field.id = `decided-${key}`;
      field.value = pair[key] ?? '';
      if (key !== 'status')
        field.addEventListener('input', () => this.decisions.decide([pair], { [key]: field.value.trim() }));
      host.append(el('label', { for: field.id }, key[0].toUpperCase() + key.slice(1)), field);
    }
    host.append(this.all);
    return host;
  }

  private offerAll(): void {
    const { clash, group } = this.store.state;
    if (!this.all || !clash?.pair) return;
    const count = this.around(clash).length;
    this.all.hidden = count < 2 || Object.keys(saidOf(clash.pair)).length === 0;
    this.all.textContent = `Same for all ${counted(count)} of the ${group === 'none' ? 'list' : 'group'}`;
  }

  /** What is not said of the one stays as it is of the others. */
  private decideAll(clash: Clash, pair: Pair): void {
    const pairs = this.around(clash).flatMap((one) => one.pair ?? []);
    if (!confirm(`Decide the same about ${counted(pairs.length)} clashes? It replaces what was decided about them.`)) return;
    this.decisions.decide(pairs, saidOf(pair));
  }

  private partLink(clash: Clash, side: 0 | 1): HTMLElement {
    const id = side === 0 ? clash.first : clash.second;
    const letter = letterOf(side);
    const name = clash.names[side];
    if (id < 0) return el('span', { class: 'part-link' }, letter, nameOf(name, 2000));
    const link = button('', () => this.store.set({ clash: null, part: id }), {
      class: 'link',
      title: 'Show this part',
    });
    link.append(nameOf(name, 2000));
    const part = this.report.objects[id];
    const where = el(
      'small',
      {},
      nameOf(part.path === part.name ? fileName(part.file) : `${fileName(part.file)} / ${part.path}`, 300),
    );
    const about = ['class', 'storey'].flatMap((name) => propertyOf(part, name)).join(' · ');
    return el(
      'div',
      { class: 'part-link' },
      letter,
      el('div', {}, link, where, about !== '' && el('small', {}, nameOf(about, 300))),
    );
  }

  /** What was measured, large. `a` and `b` of the report are turned where the inner part stands first. */
  private measures(clash: Clash, pair: Pair): HTMLElement {
    const { a_in_b: a, b_in_a: b } = pair.overlap_depth ?? {};
    const [first, second] = clash.first === pair.a ? [a, b] : [b, a];
    const rows: [string, Value | null][] = [
      ['Depth of A in B', first ? intervalOf(...first) : null],
      ['Depth of B in A', second ? intervalOf(...second) : null],
      [
        'Volume in common',
        pair.overlap_volume != null
          ? [volumeOf(pair.overlap_volume, pair.overlap_volume_error ?? 0)]
          : null,
      ],
      ['Distance', pair.distance != null ? [lengthOf(pair.distance), ' ± ', lengthOf(pair.distance_error)] : null],
      ['Area of contact', clash.area > 0 ? [lengthOf(clash.area, 2)] : null],
    ];
    const list = figures(rows);
    list.classList.add('measures');
    return list;
  }

  /** When, with links that go there. */
  private ofSpan(clash: Clash, span: PlacedSpan): HTMLElement {
    const go = (time: number, title: string): HTMLElement => {
      const link = button('', () => this.store.set({ time }), { class: 'link', title });
      link.append(numberOf(time), ' s');
      return link;
    };
    const known = (bracket: Interval | null, time: number, title: string, otherwise: string): Value =>
      bracket ? [go(time, title), ', within ', numberOf(bracket[1] - bracket[0]), ' s'] : [otherwise];
    return figures([
      ['From', known(span.from, span.start, 'Go to its start', 'the first frame')],
      ['First contact', span.point ? point(span.point) : null],
      ['To', known(span.to, span.end, 'Go to its end', 'the last frame')],
      ['Seen', span.isPassage ? ['between two frames only'] : null],
      ['Lasts', [numberOf(span.end - span.start), ' s']],
      ['Worst at', [go(span.worst_at, 'Go to the worst moment')]],
      ['Worst verdict', [clash.verdict]],
      ['Part numbers', [countOf(clash.first), ' and ', countOf(clash.second)]],
    ]);
  }

  private facts(clash: Clash, pair: Pair): HTMLElement {
    const parts = [this.report.objects[clash.first], this.report.objects[clash.second]];
    const kinds = ['crossing', 'touching', 'coplanar'] as const;
    const nearest = pair.nearest && (clash.first === pair.a ? pair.nearest : [pair.nearest[1], pair.nearest[0]]);
    return figures([
      ['Verdict', [pair.verdict, pair.fails ? ', fails' : ', does not fail']],
      ['Triangle pairs', kinds.flatMap((kind, i) => [i ? ', ' : '', countOf(pair[kind]), ` ${kind}`])],
      ['Fails below', failsBelowText(clash)],
      ['Nearest point of A', nearest ? point(nearest[0]) : null],
      ['Nearest point of B', nearest ? point(nearest[1]) : null],
      ['Tolerance applied', measured(pair.tolerance)],
      ['Kind', parts.every(kindOf) ? [`A is a ${kindOf(parts[0])}, B is a ${kindOf(parts[1])}`] : null],
      ['Inner radius of A', measured(parts[0].inner_radius)],
      ['Inner radius of B', measured(parts[1].inner_radius)],
      ['Part numbers', [countOf(clash.first), ' and ', countOf(clash.second)]],
      ...['GlobalId', 'Tag'].flatMap((name) =>
        parts.map((part, side): [string, Value | null] => [`${name} of ${'AB'[side]}`, texts(propertyOf(part, name))]),
      ),
      ['Id', pair.id ? [nameOf(pair.id)] : null],
    ]);
  }

  private regions(pair: Pair): Node[] {
    const regions = pair.regions ?? [];
    if (!regions.length) return [];
    const count = regions.length === 1 ? 'One region' : `${counted(regions.length)} regions`;
    const head = el('h3', {}, `${count} of contact`);
    const list = el('div', { class: 'regions', role: 'group', 'aria-label': 'Regions of contact' });
    const add = (from: number, to: number) => {
      for (let i = from; i < Math.min(to, regions.length); ++i) list.append(this.region(regions[i], i));
    };
    add(0, kRegionsAtOnce);
    const nodes: Node[] = [head, list];
    if (regions.length > kRegionsAtOnce) {
      const more = button(`Show all ${counted(regions.length)} regions`, () => {
        add(kRegionsAtOnce, regions.length);
        more.remove();
      });
      nodes.push(more);
    }
    return nodes;
  }

  private region(region: Region, index: number): HTMLElement {
    const element = button('', () => this.store.set({ region: this.store.state.region === index ? -1 : index }), {
      class: 'region',
      'aria-pressed': 'false',
      'data-region': String(index),
    });
    const hasNormal = region.normal.some((c) => c !== 0);
    element.append(
      el('span', { class: 'rank' }, String(index + 1)),
      el(
        'span',
        { class: 'region-figures' },
        el('span', {}, el('small', {}, 'area '), lengthOf(region.area, 2)),
        el('span', {}, el('small', {}, 'length '), lengthOf(region.length)),
        el('span', {}, el('small', {}, 'pairs '), countOf(region.pairs)),
        el('span', { class: 'wide' }, el('small', {}, 'centre '), ...point(region.centroid)),
        hasNormal && el('span', { class: 'wide' }, el('small', {}, 'normal '), ...triple(region.normal, numberOf(region.normal[2]))),
        region.change && el('span', { class: 'tag' }, region.change),
      ),
    );
    return element;
  }

  private markRegion(): void {
    for (const element of this.body.querySelectorAll<HTMLElement>('.region')) {
      element.setAttribute('aria-pressed', String(Number(element.dataset.region) === this.store.state.region));
    }
  }

  private ofPart(part: Part): Node[] {
    const isHidden = this.store.state.hidden.has(part.id);
    const clashes = this.clashesOf(part.id);
    const actions = el(
      'div',
      { class: 'line' },
      button('Fit', () => this.fit([part.id])),
      button(isHidden ? 'Show' : 'Hide', () => this.store.toggleHidden([part.id])),
      button('Isolate', () => this.store.isolate([part.id])),
    );
    if (clashes) actions.append(button('Only its clashes', () => this.store.filterBy({ parts: new Set([part.id]) })));
    const open = part.first_open_edge;
    const crossing = part.first_self_crossing;
    const unclear = part.first_unclear_edge;
    return [
      el('div', { class: 'sentence part-name' }, nameOf(part.name, 2000)),
      actions,
      figures([
        ['File', [nameOf(part.file, 2000)]],
        ['Path', [nameOf(part.path, 2000)]],
        ...Object.keys(part.properties ?? {}).map((name): [string, Value | null] => [
          kPropertyNames[name] ?? nameText(name, 40),
          texts(propertyOf(part, name)),
        ]),
        ['Part number', [countOf(part.id)]],
        ['Clashes', this.report.settings || clashes ? [countOf(clashes)] : null],
        ['Triangles', [countOf(part.triangles)]],
        ['Shape incomplete', part.incomplete ? [nameOf(part.incomplete, 300)] : null],
        ['Kind', kindOf(part) ? [kindOf(part)] : null],
        ['Not found', part.class === 'surface' ? ['what lies wholly within: a surface has no inside'] : null],
        ['Open edges', part.open_edges ? [countOf(part.open_edges)] : null],
        ['First open edge', open ? [...point(open[0]), ' to ', ...point(open[1])] : null],
        ['Inside unclear at', part.unclear_edges ? [countOf(part.unclear_edges), ' of them'] : null],
        ['First of them', unclear ? [...point(unclear[0]), ' to ', ...point(unclear[1])] : null],
        ['Triangles turned', part.turned ? [countOf(part.turned)] : null],
        ['Self-crossings', part.self_crossings ? [countOf(part.self_crossings)] : null],
        ['First of them near', crossing ? point(crossing.near) : null],
        ['Volume', part.volume != null ? [volumeOf(part.volume)] : null],
        ['Area', measured(part.area, 2)],
        ['Inner radius', measured(part.inner_radius)],
      ]),
    ];
  }
}
