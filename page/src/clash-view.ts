// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// How the choices of the user look in 3D: which parts are solid, faded or hidden, and what is drawn over them.
import type { Assembly, Look } from './assembly';
import type { Clash } from './clashes';
import { calmColour, type Rgb, themeColour, worst } from './colours';
import { kVerdicts, type Pair, type Report, type SceneBlock, type Vec3, type Verdict } from './data';
import type { Stroke } from './overlay';
import { findSight, isHiddenBy, type Obstacle, samplesOf, type Sight } from './sight';
import type { State } from './store';
import { add, type Box, cornersOf, emptyBox, grow, isEmpty, length, middleOf, radiusOf, scale, sub, unite } from './vector';

const kGhost = 0.06;
const kGlass = 0.42;
const kThinGlass = 0.2;

export class ClashView {
  private readonly files: string[];
  private readonly worstOf: (Verdict | null)[];
  /** Null before a first time is taken: until then all pairs count, whenever it is that they clash. */
  private clashingNow: string | null = null;

  /** Which of the two parts of the chosen clash hide what there is to see of it: they are drawn as of glass. */
  private hiding: [boolean, boolean] = [false, false];

  constructor(
    private readonly report: Report,
    private readonly scene: SceneBlock,
    private readonly assembly: Assembly,
  ) {
    this.files = [...new Set(report.objects.map((part) => part.file))];
    this.worstOf = report.objects.map(() => null);
    this.gather(report.pairs);
  }

  private gather(pairs: Pair[]): void {
    this.worstOf.fill(null);
    for (const { a, b, verdict } of pairs) {
      for (const id of [a, b]) this.worstOf[id] = this.worstOf[id] ? worst(this.worstOf[id], verdict) : verdict;
    }
  }

  /** From now on the verdicts of the spans around this time count. True if they are others than before. */
  takeTime(time: number): boolean {
    const pairs = this.report.pairs.filter(({ span }) => span && span.start <= time && time <= span.end);
    const key = pairs.map(({ a, b, verdict }) => `${a} ${b} ${verdict}`).join();
    if (key === this.clashingNow) return false;
    this.clashingNow = key;
    this.gather(pairs);
    return true;
  }

  /** The colours of parts that are not chosen. */
  private baseColours(by: State['colourBy']): (id: number) => Rgb {
    if (by === 'file') return (id) => calmColour(this.files.indexOf(this.report.objects[id].file));
    if (by === 'type') return (id) => calmColour(this.scene.objects[id].mesh);
    const plain = themeColour('--plain-part');
    const colours = new Map(kVerdicts.map((verdict) => [verdict, themeColour(`--${verdict}`)]));
    return (id) => (this.worstOf[id] && colours.get(this.worstOf[id])) ?? plain;
  }

  private largerOf(clash: Clash): [boolean, boolean] {
    const [a, b] = [clash.first, clash.second].map((id) => (id < 0 ? 0 : radiusOf(this.assembly.boxes[id])));
    return [a >= b, b >= a];
  }

  applyLooks(state: State): void {
    const { clash, part, hidden, others, glass, colourBy } = state;
    const ghost: Look = [...themeColour('--ghost'), kGhost];
    const gone: Look = [0, 0, 0, 0];
    const [a, b] = [themeColour('--part-a'), themeColour('--part-b')];
    const [hidesA, hidesB] = this.hiding;
    const alphaOf = (hides: boolean) => (hides ? kThinGlass : glass ? kGlass : 1);
    const base = this.baseColours(colourBy);
    // Or duplicates would flicker.
    this.assembly.setRecessed(clash ? clash.second : -1);
    this.assembly.setLooks((id) => {
      if (clash) {
        if (id === clash.first) return [...a, alphaOf(hidesA)];
        if (id === clash.second) return [...b, alphaOf(hidesB)];
      }
      if (hidden.has(id)) return gone;
      if (clash && others !== 'show') return others === 'fade' ? ghost : gone;
      return [...(id === part ? a : base(id)), 1];
    });
  }

  /** From which direction to look at the chosen clash; the present one, if much of it is seen from there. */
  lookFrom(state: State, present: Vec3): Vec3 {
    const { clash, region } = state;
    this.hiding = [false, false];
    if (!clash) return present;
    const regions = clash.pair?.regions ?? [];
    const lines = (region >= 0 ? [regions[region]] : regions).flatMap((one) => one.lines);
    if (!lines.length && clash.pair?.nearest) lines.push(clash.pair.nearest);
    if (clash.pair?.span?.point) lines.push([clash.pair.span.point]);
    const obstacles = partsOf(clash).map((id) => this.assembly.obstacle(id)).filter((obstacle) => obstacle !== null);
    const gap = radiusOf(this.partsBox(clash)) * 2e-3;
    const sight = findSight(obstacles, samplesOf(lines), present, gap);
    this.hiding = this.whatHides(clash, obstacles, sight, gap);
    return sight.direction;
  }

  private whatHides(clash: Clash, obstacles: Obstacle[], sight: Sight, gap: number): [boolean, boolean] {
    // The inner part stands first. Where it is not known which that is, it is the smaller one.
    if (clash.pair && clash.verdict === 'inside')
      return clash.pair.inner === null ? this.largerOf(clash) : [false, true];
    // What hides a buried contact is the larger part.
    if (sight.isBuried) return this.largerOf(clash);
    if (obstacles.length < 2) return [false, false];
    const [a, b] = obstacles;
    return [isHiddenBy(a, b, sight.direction, gap), isHiddenBy(b, a, sight.direction, gap)];
  }

  strokes(state: State): Stroke[] {
    const pair = state.clash?.pair;
    if (!pair) return state.clash?.resolved?.centroid ? [this.dot(state.clash.resolved.centroid, '--contact')] : [];
    if (pair.span?.point) return [this.dot(pair.span.point, '--contact')];
    const strokes: Stroke[] = [];
    (pair.regions ?? []).forEach((region, i) => {
      if (state.region >= 0 && state.region !== i) return;
      const colour = themeColour('--contact');
      for (const points of region.lines) strokes.push({ points, colour, width: points.length > 1 ? 1.25 : 3 });
      if (state.boxes) strokes.push(...boxStrokes(region.box), this.dot(region.centroid, '--contact'));
      if ((state.region === i || state.boxes) && region.normal.some((c) => c !== 0)) {
        const size = Math.max(
          length(sub(region.box[1], region.box[0])) / 2,
          radiusOf(this.partsBox(state.clash!)) / 12,
        );
        strokes.push({
          points: [region.centroid, add(region.centroid, scale(region.normal, size))],
          colour: themeColour('--part-b'),
          width: 1.75,
        });
      }
    });
    if (pair.nearest) {
      const [p, q] = pair.nearest;
      const isTurned = state.clash!.first !== pair.a;
      strokes.push({ points: [p, q], colour: themeColour('--contact'), width: 1.25 });
      strokes.push(this.dot(p, isTurned ? '--part-b' : '--part-a'), this.dot(q, isTurned ? '--part-a' : '--part-b'));
    }
    return strokes;
  }

  private dot(point: Vec3, colour: string): Stroke {
    return { points: [point, point], colour: themeColour(colour), width: 3.5 };
  }

  private partsBox(clash: Clash): Box {
    return unite(partsOf(clash).map((id) => this.assembly.boxes[id]));
  }

  /** What the camera flies to: the contact with so much of the smaller part around it that one sees what it belongs to. */
  focus(state: State): { middle: Vec3; radius: number } | null {
    const { clash } = state;
    if (!clash) return null;
    const box = emptyBox();
    const regions = clash.pair?.regions ?? [];
    for (const region of state.region >= 0 ? [regions[state.region]] : regions) grow(box, ...region.box);
    if (clash.pair?.nearest) grow(box, ...clash.pair.nearest);
    if (clash.resolved?.centroid) grow(box, clash.resolved.centroid);
    if (clash.pair?.span?.point) grow(box, clash.pair.span.point);
    else if (clash.pair?.span) growCommon(box, this.assembly.boxes[clash.first], this.assembly.boxes[clash.second]);
    const whole = this.partsBox(clash);
    const contact = radiusOf(box);
    if (isEmpty(box))
      return radiusOf(whole) > 0 ? { middle: middleOf(whole), radius: radiusOf(whole) } : null;
    const sizes = partsOf(clash).map((id) => radiusOf(this.assembly.boxes[id])).filter((size) => size > 0);
    const smaller = sizes.length || radiusOf(whole) ? Math.min(...sizes, radiusOf(whole) || Infinity) : 1;
    // Of a pipe in a wall the wall alone would fill the picture: a part of it with its edges says where one is.
    const around = Math.max(0.75 * smaller, Math.min(3 * smaller, Math.max(0, ...sizes) / 5));
    return {
      middle: middleOf(box),
      radius: Math.max(1.5 * contact, state.region >= 0 ? 0.18 * smaller : around, 1e-9),
    };
  }
}

/** Those of its two parts that are there still. */
const partsOf = ({ first, second }: Clash): number[] => [first, second].filter((id) => id >= 0);

/** Where two boxes meet is about where their parts do. */
function growCommon(box: Box, a: Box, b: Box): void {
  const min = a.min.map((c, k) => Math.max(c, b.min[k])) as Vec3;
  const max = a.max.map((c, k) => Math.min(c, b.max[k])) as Vec3;
  if (min.every((c, k) => c <= max[k])) grow(box, min, max);
}

function boxStrokes([min, max]: [Vec3, Vec3]): Stroke[] {
  const colour = themeColour('--box');
  const corners = cornersOf({ min, max });
  const strokes: Stroke[] = [];
  for (let i = 0; i < 8; ++i) {
    for (const bit of [1, 2, 4]) if (!(i & bit)) strokes.push({ points: [corners[i], corners[i | bit]], colour, width: 0.75 });
  }
  return strokes;
}
