// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The motion of parts: its data block, and where the parts are at any time of it. Nothing here touches the 3D view.
import { areNumbers, blockJson, BlockError, hasBlock, type Interval, isIndex, kVerdicts, type Pair, type Vec3, type Verdict } from './data';
import { mixPoses, type Pose } from './pose';

/** From when to when two parts clash. */
export interface Span {
  a: number;
  b: number;
  /** The last time known to be free and the first known to clash; null: they clash from the first frame on. */
  from: Interval | null;
  /** The last time known to clash and the first known to be free; null: they clash to the last frame. */
  to: Interval | null;
  /** A point of contact when the clash begins; null where it is not known. */
  point?: Vec3 | null;
  worst: Verdict;
  /** With `inside`, the part that lies in the other at `worst_at`. */
  inner?: number | null;
  note?: string | null;
  worst_at: number;
  fails_below?: number | null;
  overlap_depth: { a_in_b: Interval | null; b_in_a: Interval | null } | null;
}

/** With the first and the last time at which the clash is sure. */
export interface PlacedSpan extends Span {
  start: number;
  end: number;
  isFromStart: boolean;
  isToEnd: boolean;
  /** It begins and ends between two frames, neither of which shows it. */
  isPassage: boolean;
}

export interface Motion {
  version: number;
  animation: { name: string; seconds: number; frames: number; step: number };
  times: number[];
  objects: { id: number; poses: Pose[] }[];
  /** Sentences on what the animation does and was not run. */
  left_out?: string[];
  spans: Span[];
}

const isInterval = (value: unknown) => areNumbers(value, 2) && value[0] <= value[1];
const isNone = (value: unknown) => value === null || value === undefined;

function bad(why: string): BlockError {
  return new BlockError(`The motion cannot be read: ${why}.`);
}

function checkTimes({ animation, times }: Motion): void {
  const figures = [animation?.seconds, animation?.frames, animation?.step];
  if (!figures.every(Number.isFinite)) throw bad('its animation has no length, no frames or no step');
  if (!Array.isArray(times) || times.length === 0 || !times.every(Number.isFinite)) throw bad('it lists no times');
  if (times.some((time, i) => i > 0 && time <= times[i - 1])) throw bad('its times do not rise');
}

function checkObjects({ objects, times }: Motion, parts: number): void {
  if (!Array.isArray(objects)) throw bad('it lists no objects');
  const seen = new Set<number>();
  objects.forEach((object, i) => {
    if (!isIndex(object?.id, parts) || seen.has(object.id)) throw bad(`its object ${i} names no part, or one twice`);
    seen.add(object.id);
    const { poses } = object;
    if (!Array.isArray(poses) || poses.length !== times.length) {
      throw bad(`its object ${i} has not one pose for each of the ${times.length} times`);
    }
    if (!poses.every((pose) => areNumbers(pose, 12))) throw bad(`a pose of its object ${i} is not twelve numbers`);
  });
}

function checkLeftOut({ left_out: list }: Motion): void {
  if (isNone(list)) return;
  const areTexts = Array.isArray(list) && list.every((one) => typeof one === 'string');
  if (!areTexts) throw bad('what it leaves out is no list of sentences');
}

function checkSpans({ spans }: Motion, parts: number): void {
  if (!Array.isArray(spans)) throw bad('it lists no spans');
  spans.forEach((span, i) => {
    if (!isIndex(span?.a, parts) || !isIndex(span.b, parts) || !kVerdicts.includes(span.worst)) {
      throw bad(`its span ${i} names no two parts, or no verdict`);
    }
    const areTimes = [span.from, span.to].every((one) => isNone(one) || isInterval(one));
    if (!isNone(span.point) && !areNumbers(span.point, 3)) throw bad(`its span ${i} has a point that is none`);
    if (!areTimes || !Number.isFinite(span.worst_at)) throw bad(`its span ${i} has times that are none`);
    const { overlap_depth: depth } = span;
    if (!isNone(depth) && ![depth!.a_in_b, depth!.b_in_a].every((one) => isNone(one) || isInterval(one))) {
      throw bad(`its span ${i} has a depth that is none`);
    }
  });
}

/** Null on a page without motion. */
export function readMotion(parts: number): Motion | null {
  if (!hasBlock('motion')) return null;
  const motion = blockJson('motion', 'motion') as unknown as Motion;
  checkTimes(motion);
  checkObjects(motion, parts);
  checkSpans(motion, parts);
  checkLeftOut(motion);
  return motion;
}

/** The spans as pairs of a report, in the order of time: all that shows pairs shows spans. */
export function pairsOf({ spans, times }: Motion): Pair[] {
  const [first, last] = [times[0], times[times.length - 1]];
  const within = (time: number) => Math.min(last, Math.max(first, time));
  const isPassage = ({ from, to }: Span) => !!from && !!to && times[frameAt(times, to[0])] < from[1];
  const pairs = spans.map((span): Pair & { span: PlacedSpan } => ({
    a: span.a,
    b: span.b,
    crossing: 0,
    touching: 0,
    coplanar: 0,
    verdict: span.worst,
    inner: span.inner ?? null,
    note: span.note ?? null,
    tolerance: null,
    fails: false,
    fails_below: span.fails_below,
    overlap_depth: span.overlap_depth,
    span: {
      ...span,
      worst_at: within(span.worst_at),
      start: span.from ? within(span.from[1]) : first,
      end: span.to ? within(span.to[0]) : last,
      isFromStart: !span.from,
      isToEnd: !span.to,
      isPassage: isPassage(span),
    },
  }));
  return pairs.sort((x, y) => x.span.start - y.span.start);
}

/** The last frame that is not after a time. */
export function frameAt(times: number[], time: number): number {
  let [low, high] = [0, times.length];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return low;
}

/** Where the moving parts are at a time. */
export function posesAt({ times, objects }: Motion, time: number): { id: number; pose: Pose }[] {
  const frame = frameAt(times, time);
  const next = Math.min(frame + 1, times.length - 1);
  const share = next > frame ? Math.min(1, Math.max(0, (time - times[frame]) / (times[next] - times[frame]))) : 0;
  return objects.map(({ id, poses }) => ({ id, pose: mixPoses(poses[frame], poses[next], share) }));
}
