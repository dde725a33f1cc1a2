// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The clashes of a report: ranked, filtered, sorted and grouped. Nothing here touches the page.
import { clusters } from './clusters';
import { type Interval, kVerdicts, type Pair, type Place, type Report, type Resolved, type Vec3, type Verdict } from './data';
import { fileName, plural, shown } from './format';

export interface Clash {
  /** From 1, in the order of the command's table. Resolved clashes follow. */
  rank: number;
  pair: Pair | null;
  resolved: Resolved | null;
  verdict: Verdict;
  /** Ids of the parts; -1 if a resolved clash names one that is gone. With `inside` the inner part stands first. */
  first: number;
  second: number;
  names: [string, string];
  parts: [Place, Place];
  /** The greater upper end of both overlap depths, NaN if none was measured. */
  depth: number;
  /** The greater lower end. */
  depthLeast: number;
  /** It fails at every tolerance below this; infinite: at every one. NaN where it is not known. */
  failsBelow: number;
  /** What both parts fill, NaN if it was not measured. */
  volume: number;
  distance: number;
  /** Sum of the areas of all regions, NaN without regions. */
  area: number;
  text: string;
}

const collator = new Intl.Collator('en', { numeric: true });
/** No two texts are equal. */
const compareTexts = (p: string, q: string): number => collator.compare(p, q) || Number(p > q) - Number(p < q);

export type SortKey = 'rank' | 'depth' | 'volume' | 'distance' | 'area' | 'name';

/** What parts are told apart by. */
export type Trait = 'class' | 'storey' | 'file';
export type GroupKey = 'none' | 'part' | 'types' | 'test' | 'place' | Trait;

/** All values that the file gives of a property; none where it does not say it. */
export const propertyOf = (part: Place, name: string): string[] => [part.properties?.[name] ?? []].flat();

/** The first value, or empty where the file does not say it. */
export const traitOf = (part: Place, trait: Trait): string =>
  trait === 'file' ? part.file : (propertyOf(part, trait)[0] ?? '');

export const traitName = (value: string, trait: Trait): string =>
  trait === 'file' ? fileName(value) : value || `without ${trait}`;

/** Those of both parts, in the order of the alphabet. */
export const traitsOf = ({ parts }: Clash, trait: Trait): [string, string] => {
  const [p, q] = parts.map((part) => traitOf(part, trait));
  return compareTexts(p, q) <= 0 ? [p, q] : [q, p];
};

export const traitTitle = ([p, q]: [string, string], trait: Trait): string =>
  p === q ? `both ${traitName(p, trait)}` : `${traitName(p, trait)} × ${traitName(q, trait)}`;

/** Each once, in the order of the alphabet. */
export const sorted = (texts: string[]): string[] => [...new Set(texts)].sort(compareTexts);

/** The values that a trait takes in the report. */
export const traitValues = (parts: Place[], trait: Trait): string[] =>
  sorted(parts.map((part) => traitOf(part, trait)));

export interface Filter {
  verdicts: Set<Verdict>;
  resolved: boolean;
  failing: boolean;
  text: string;
  /** A tolerance at which it would still fail; NaN for any. */
  failsAt: number;
  depthFrom: number;
  distanceTo: number;
  parts: Set<number> | null;
  test: string;
  status: string;
  assignee: string;
  change: string;
  /** Of one part at least. */
  class: string;
  storey: string;
  axes: string;
  /** Of both parts, as `traitsOf`. */
  traits: { trait: Trait; values: [string, string] } | null;
}

export const emptyFilter = (): Filter => ({
  verdicts: new Set(),
  resolved: false,
  failing: false,
  text: '',
  failsAt: NaN,
  depthFrom: NaN,
  distanceTo: NaN,
  parts: null,
  test: '',
  status: '',
  assignee: '',
  change: '',
  class: '',
  storey: '',
  axes: '',
  traits: null,
});

export const isFiltering = (filter: Filter): boolean =>
  Object.values(filter).some((value) => (value instanceof Set ? value.size > 0 : value === 0 || Boolean(value)));

/** The interval of the greater of both overlap depths: NaNs if none was measured. */
function depthOf(pair: Pair): Interval {
  const depths = [pair.overlap_depth?.a_in_b, pair.overlap_depth?.b_in_a].filter((d) => d != null);
  return depths.length ? [Math.max(...depths.map((d) => d[0])), Math.max(...depths.map((d) => d[1]))] : [NaN, NaN];
}

/** The lower end to tell of a depth: the upper one alone where the interval is no wider than a tenth of it. */
export const toldDepth = ({ depth, depthLeast }: Clash): Interval => [depthLeast < 0.9 * depth ? depthLeast : depth, depth];

/** All that a part is found by. */
export const searchText = (part: Place): string =>
  [part.path, part.name, ...Object.values(part.properties ?? {}).flat()].join('\n').toLowerCase();

/** A clash of two parts of which no more is known than their names. */
const clashOf = (verdict: Verdict, a: Place, b: Place): Clash => ({
  rank: 0,
  pair: null,
  resolved: null,
  verdict,
  first: -1,
  second: -1,
  names: [a.name, b.name],
  parts: [a, b],
  depth: NaN,
  depthLeast: NaN,
  failsBelow: NaN,
  volume: NaN,
  distance: NaN,
  area: NaN,
  text: `${searchText(a)}\n${searchText(b)}`,
});

function ofPair(report: Report, pair: Pair): Clash {
  const [first, second] = pair.inner === pair.b ? [pair.b, pair.a] : [pair.a, pair.b];
  const [depthLeast, depth] = depthOf(pair);
  const clash = clashOf(pair.verdict, report.objects[first], report.objects[second]);
  return {
    ...clash,
    text: `${clash.text}\n${(pair.axes ?? '').toLowerCase()}`,
    pair,
    first,
    second,
    depth,
    depthLeast,
    failsBelow: pair.fails_below === null ? Infinity : (pair.fails_below ?? NaN),
    volume: pair.overlap_volume ?? NaN,
    distance: pair.distance ?? NaN,
    area: pair.regions ? pair.regions.reduce((sum, region) => sum + region.area, 0) : NaN,
  };
}

/** Finds the part that an earlier run named: by path and name, since many may have one path; or by a path of its own. */
function partFinder(report: Report): (place: Place) => number {
  const wholly = new Map<string, number>();
  const byPath = new Map<string, number>();
  const keysOf = ({ file, path, name }: Place) => [JSON.stringify([file, path, name]), JSON.stringify([file, path])];
  report.objects.forEach((part, id) => {
    const [whole, path] = keysOf(part);
    wholly.set(whole, id);
    byPath.set(path, byPath.has(path) ? -1 : id);
  });
  return (place) => {
    const [whole, path] = keysOf(place);
    return wholly.get(whole) ?? byPath.get(path) ?? -1;
  };
}

/** NaN last, whatever the direction. */
function compare(x: number, y: number, sign: number): number {
  if (Number.isNaN(x) || Number.isNaN(y)) return Number(Number.isNaN(x)) - Number(Number.isNaN(y));
  return sign * (x - y);
}

export const verdictName = (verdict: Verdict): string => (verdict === 'apart' ? 'too near' : verdict);

/** The verdicts that occur, worst first, with the number of their clashes. */
export const countVerdicts = (clashes: Clash[]): [Verdict, number][] =>
  kVerdicts
    .map((verdict): [Verdict, number] => [verdict, clashes.filter((one) => one.verdict === verdict).length])
    .filter(([, count]) => count > 0);

const verdictRank = (verdict: Verdict): number => kVerdicts.indexOf(verdict);
/** The last of the verdicts on parts that reach into each other by more than the tolerance. */
const kMildest = verdictRank('crossing');

/** Whether a clash would fail at a tolerance. What touches and fails does so by the words of the call, at any. */
export function failsAt({ pair, verdict, failsBelow }: Clash, tolerance: number): boolean {
  if (!pair) return false;
  if (pair.fails) return verdictRank(verdict) > kMildest || !(tolerance >= failsBelow);
  return verdict === 'touching' && tolerance < failsBelow;
}

/**
 * All clashes in the order of the command's table: what fails by its verdict, what touches, what is near; of each what fails
 * at the largest tolerance first, then the deepest, then by verdict, area of contact and distance, then as in the file; those of
 * a motion in the order of time.
 */
export function rankClashes(report: Report): Clash[] {
  const clashes = report.pairs.map((pair) => ofPair(report, pair));
  clashes.sort(
    (x, y) =>
      compare(x.pair!.span?.start ?? 0, y.pair!.span?.start ?? 0, 1) ||
      Math.max(verdictRank(x.verdict), kMildest) - Math.max(verdictRank(y.verdict), kMildest) ||
      compare(x.failsBelow, y.failsBelow, -1) ||
      (y.depth || 0) - (x.depth || 0) ||
      verdictRank(x.verdict) - verdictRank(y.verdict) ||
      (y.area || 0) - (x.area || 0) ||
      (x.distance || 0) - (y.distance || 0),
  );
  const find = partFinder(report);
  for (const resolved of report.resolved ?? []) {
    const { verdict, a, b } = resolved;
    clashes.push({ ...clashOf(verdict, a, b), resolved, first: find(a), second: find(b) });
  }
  clashes.forEach((clash, i) => (clash.rank = i + 1));
  return clashes;
}

/** The distance, which of what shares a point is 0; NaN where it is not known, or more than the clearance. */
function reachOf({ pair, distance, verdict }: Clash): number {
  if (!pair || !Number.isNaN(distance) || verdict === 'apart') return distance;
  const isFree = verdict === 'inside' && pair.crossing + pair.touching + pair.coplanar === 0;
  return isFree ? NaN : 0;
}

function passes(clash: Clash, filter: Filter, words: string[]): boolean {
  const about = clash.pair ?? clash.resolved!;
  if (clash.resolved) {
    if (!filter.resolved) return false;
  } else if (filter.resolved && filter.verdicts.size === 0) {
    return false;
  }
  if (filter.verdicts.size && !filter.verdicts.has(clash.verdict)) return false;
  if (filter.failing && !clash.pair?.fails) return false;
  if (!Number.isNaN(filter.failsAt) && !failsAt(clash, filter.failsAt)) return false;
  if (!words.every((word) => clash.text.includes(word))) return false;
  // Whoever types a figure of the list means what stands there, and whoever takes one from the JSON that one.
  const { depthFrom, distanceTo } = filter;
  if (!Number.isNaN(depthFrom) && !(Math.max(clash.depth, shown(clash.depth)) >= depthFrom)) return false;
  const distance = reachOf(clash);
  if (!Number.isNaN(distanceTo) && !(Math.min(distance, shown(distance)) <= distanceTo)) return false;
  if (filter.parts && !filter.parts.has(clash.first) && !filter.parts.has(clash.second)) return false;
  if (filter.test && about.test !== filter.test) return false;
  if (filter.status && clash.pair?.status !== filter.status) return false;
  if (filter.assignee && clash.pair?.assignee !== filter.assignee) return false;
  if (filter.axes && clash.pair?.axes !== filter.axes) return false;
  for (const trait of ['class', 'storey'] as const)
    if (filter[trait] && !clash.parts.some((part) => propertyOf(part, trait).includes(filter[trait]))) return false;
  const { traits } = filter;
  if (traits && traitsOf(clash, traits.trait).join('\n') !== traits.values.join('\n')) return false;
  if (filter.change === kWorse) return isWorse(clash.pair);
  return !filter.change || (clash.pair !== null && changeOf(clash.pair) === filter.change);
}

/** The words of a search; what is found has all of them. */
export const wordsOf = (text: string): string[] => text.toLowerCase().split(/\s+/).filter(Boolean);

export function filterClashes(clashes: Clash[], filter: Filter): Clash[] {
  const words = wordsOf(filter.text);
  return clashes.filter((clash) => passes(clash, filter, words));
}

export function sortClashes(clashes: Clash[], key: SortKey): Clash[] {
  const by: Record<SortKey, (x: Clash, y: Clash) => number> = {
    rank: () => 0,
    depth: (x, y) => compare(x.depth, y.depth, -1),
    volume: (x, y) => compare(x.volume, y.volume, -1),
    distance: (x, y) => compare(x.distance, y.distance, 1),
    area: (x, y) => compare(x.area, y.area, -1),
    name: (x, y) => collator.compare(x.names[0], y.names[0]) || collator.compare(x.names[1], y.names[1]),
  };
  return [...clashes].sort((x, y) => by[key](x, y) || x.rank - y.rank);
}

export interface Group {
  key: string;
  title: string;
  clashes: Clash[];
}

/** How parts are called in the titles of groups. */
export interface PartWords {
  title: (id: number) => string;
  typeOf: (id: number) => { key: number; title: string };
}

type Membership = [key: string, title: () => string];

/** The groups that a clash is in: by part, one under each of its parts. */
function membershipsOf(clash: Clash, by: Exclude<GroupKey, 'none' | 'place'>, words: PartWords): Membership[] {
  if (by === 'test') {
    const test = (clash.pair ?? clash.resolved!).test ?? '';
    return [[test, () => test || 'No named test']];
  }
  const ids = [clash.first, clash.second];
  if (by === 'part')
    return ids.map((id, side) =>
      id < 0 ? [`gone ${clash.names[side]}`, () => clash.names[side]] : [String(id), () => words.title(id)],
    );
  if (by === 'types') {
    const types = ids.map((id, side) => (id < 0 ? { key: -1, title: clash.names[side] } : words.typeOf(id)));
    types.sort((x, y) => x.key - y.key);
    const key = types.map((type) => (type.key < 0 ? type.title : String(type.key))).join('\n');
    return [[key, () => `${types[0].title} × ${types[1].title}`]];
  }
  const values = traitsOf(clash, by);
  return [[values.join('\n'), () => traitTitle(values, by)]];
}

/** The part that is in most of the clashes, and how many others there are; both parts where there are no more. */
function clusterTitle(members: Clash[], words: PartWords): string {
  const seen = new Map<string, { title: () => string; count: number; against: Set<string> }>();
  for (const clash of members) {
    const parts = membershipsOf(clash, 'part', words);
    parts.forEach(([key, title], side) => {
      const part = seen.get(key) ?? { title, count: 0, against: new Set() };
      ++part.count;
      part.against.add(parts[1 - side][0]);
      seen.set(key, part);
    });
  }
  if (seen.size === 2) return members[0].names.join(' × ');
  const { title, count, against } = [...seen.values()].reduce((best, one) => (one.count > best.count ? one : best));
  const rest = members.length - count;
  return `${title()} × ${plural(against.size, 'part')}${rest ? ` and ${plural(rest, 'other')}` : ''}`;
}

/** Groups in the order of their first clash; by place, of clashes that are linked by steps of at most `within`. */
export function groupClashes(
  clashes: Clash[],
  by: Exclude<GroupKey, 'none'>,
  words: PartWords,
  within: number,
): Group[] {
  const groups = new Map<string, Group>();
  const put = (key: string, title: () => string, clash: Clash) => {
    const group = groups.get(key);
    if (group) group.clashes.push(clash);
    else groups.set(key, { key, title: title(), clashes: [clash] });
  };
  if (by === 'place') {
    const numbers = clusters(clashes.map(placeOf), within);
    clashes.forEach((clash, i) => put(String(clashes[numbers[i]].rank), () => '', clash));
    for (const group of groups.values()) group.title = clusterTitle(group.clashes, words);
  } else {
    for (const clash of clashes)
      for (const [key, title] of membershipsOf(clash, by, words)) put(key, title, clash);
  }
  return [...groups.values()];
}

/** The middle of what there is to see of a clash, if the report says where it is. */
export function placeOf(clash: Clash): Vec3 | null {
  if (clash.resolved) return clash.resolved.centroid ?? null;
  const pair = clash.pair!;
  if (pair.span?.point) return pair.span.point;
  if (pair.regions?.length) return pair.regions[0].centroid;
  if (pair.nearest) {
    const [p, q] = pair.nearest;
    return [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2];
  }
  return null;
}

const kVerbs: Record<Verdict, string> = {
  duplicate: 'is a duplicate of',
  inside: 'lies inside',
  penetrating: 'penetrates',
  crossing: 'crosses',
  touching: 'touches',
  apart: 'is too near',
};

/** What a pair is since the previous run, as the table counts it; null without one. */
export type Change = 'new' | 'new region' | 'persisting';
export const kChanges: readonly Change[] = ['new', 'new region', 'persisting'];

export const newRegionsOf = (pair: Pair): number =>
  pair.change === 'persisting' ? (pair.regions ?? []).filter((region) => region.change === 'new').length : 0;

export function changeOf(pair: Pair): Change | null {
  if (pair.change === 'new') return 'new';
  if (pair.change !== 'persisting') return null;
  return newRegionsOf(pair) ? 'new region' : 'persisting';
}

/** Of a pair that persists: its verdict comes before the earlier one. */
export const isWorse = (pair: Pair | null): boolean =>
  pair?.change === 'persisting' && pair.was != null && kVerdicts.indexOf(pair.verdict) < kVerdicts.indexOf(pair.was);

/** What the filter of changes calls these; they are among those that persist. */
export const kWorse = 'worse';

/** A motion that an earlier version wrote does not tell which of two parts is the inner one. */
export const verbOf = ({ verdict, pair }: Clash): string =>
  verdict === 'inside' && pair?.span && pair.inner === null ? 'lies inside or around' : kVerbs[verdict];
