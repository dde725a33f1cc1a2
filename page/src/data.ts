// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The data blocks of the page as types, and their reading. README.md describes them.

import type { PlacedSpan } from './motion';

export type Vec3 = [number, number, number];
export type Interval = [number, number];
export type Verdict = 'duplicate' | 'inside' | 'penetrating' | 'crossing' | 'touching' | 'apart';

/** The verdicts in the order of the table, worst first. */
export const kVerdicts: readonly Verdict[] = ['duplicate', 'inside', 'penetrating', 'crossing', 'touching', 'apart'];

export interface Part {
  id: number;
  name: string;
  path: string;
  product: string;
  file: string;
  triangles: number;
  /** What the file says of it: of IFC "class", "GlobalId", "storey", "material" and so on; a list of several values. */
  properties?: Record<string, string | string[]>;
  /** What the reader left out of its shape. */
  incomplete?: string | null;
  open_edges?: number;
  class?: 'solid' | 'cracked' | 'surface' | null;
  turned?: number;
  unclear_edges?: number;
  first_unclear_edge?: [Vec3, Vec3] | null;
  first_open_edge?: [Vec3, Vec3] | null;
  self_crossings?: number;
  first_self_crossing?: { triangles: [number, number]; near: Vec3 } | null;
  volume?: number | null;
  area?: number | null;
  inner_radius?: number | null;
}

export interface Region {
  pairs: number;
  box: [Vec3, Vec3];
  area: number;
  length: number;
  centroid: Vec3;
  normal: Vec3;
  lines: Vec3[][];
  change?: string | null;
}

export interface Pair {
  a: number;
  b: number;
  crossing: number;
  touching: number;
  coplanar: number;
  verdict: Verdict;
  inner: number | null;
  note: string | null;
  tolerance: number | null;
  fails: boolean;
  /** The pair fails at every tolerance below this; null: at every one. */
  fails_below?: number | null;
  overlap_depth?: { a_in_b: Interval | null; b_in_a: Interval | null } | null;
  /** Only of solids that overlap, where it was asked for. */
  overlap_volume?: number | null;
  overlap_volume_error?: number | null;
  distance?: number | null;
  distance_error?: number | null;
  nearest?: [Vec3, Vec3] | null;
  /** Only with motion: the pair clashes for a while, and may do so again. */
  span?: PlacedSpan;
  regions?: Region[];
  id?: string;
  test?: string | null;
  change?: string | null;
  /** Those of a building's grid that cross by it: "B/3". */
  axes?: string | null;
  /** The earlier verdict, with a previous run. */
  was?: Verdict | null;
  status?: string | null;
  comment?: string | null;
  assignee?: string | null;
  /** A day such as 2024-06-14. */
  due?: string | null;
}

/** A part, as far as an earlier run names it. */
export type Place = Pick<Part, 'name' | 'path' | 'file' | 'properties'>;

export interface Resolved {
  a: Place;
  b: Place;
  verdict: Verdict;
  test?: string | null;
  centroid?: Vec3 | null;
}

export interface Settings {
  tolerance: 'auto' | number;
  clearance: number;
  /** Null where depths were not measured. */
  depth_precision: number | null;
  regions: boolean;
  volumes?: boolean;
  fail_on: string[];
  ignore?: unknown[];
  /** The report of an earlier run. */
  previous?: string | null;
}

export interface Report {
  version: number;
  /** Of lengths and places, where it is known. */
  unit?: { name: string | null; metres: number } | null;
  settings: Settings | null;
  objects: Part[];
  pairs: Pair[];
  /** What of the files is not in the parts. */
  missing?: string[];
  /** What was done about the files' units and axes, and what speaks against it. */
  warnings?: string[];
  counts: (Record<Verdict, number> & { fail: number; candidates: number }) | null;
  resolved?: Resolved[];
  /** All that were read, by pairs' ids or by names of parts, also those that match no pair. */
  decisions?: Record<string, Record<string, string>>;
  tests?: unknown[];
}

export interface SceneBlock {
  version: number;
  title: string;
  /** Which axis is up: what wrote the page knows the files. */
  up?: 'y' | 'z';
  triangles: number;
  shown: number;
  /** How many were to be drawn at most; parts may need more to keep their shape. */
  asked?: number;
  meshes: { vertices: number; triangles: number }[];
  /** The named nodes that parts hang under, parents first; without a parent one stands under its file. */
  groups?: { name: string; parent?: number }[];
  objects: { mesh: number; pose: number[]; group?: number }[];
}

/** What the page says instead of showing a block that it cannot read. */
export class BlockError extends Error {}

function blockText(id: string, what: string): string {
  const element = document.getElementById(id);
  if (!element) throw new BlockError(`This page holds no ${what}: the block “${id}” is missing.`);
  const text = element.textContent ?? '';
  element.remove();
  return text;
}

export const hasBlock = (id: string): boolean => document.getElementById(id) !== null;

export function blockJson(id: string, what: string): Record<string, unknown> {
  const text = blockText(id, what);
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    throw new BlockError(`The ${what} cannot be read: the block “${id}” is not JSON, or was cut short.`);
  }
  if (typeof value !== 'object' || value === null || Array.isArray(value)) {
    throw new BlockError(`The ${what} cannot be read: the block “${id}” holds no object.`);
  }
  const version = (value as { version?: unknown }).version;
  if (version !== 1) {
    throw new BlockError(`The ${what} is of version ${String(version)}, and this page reads version 1.`);
  }
  return value as Record<string, unknown>;
}

export const isIndex = (value: unknown, size: number) =>
  Number.isInteger(value) && Number(value) >= 0 && Number(value) < size;

/** So many numbers, none of them infinite. */
export const areNumbers = (value: unknown, count: number): value is number[] =>
  Array.isArray(value) && value.length === count && value.every(Number.isFinite);

export function readReport(): Report {
  const report = blockJson('report', 'report') as unknown as Report;
  if (!Array.isArray(report.objects)) throw new BlockError('The report cannot be read: it lists no parts.');
  if (!Array.isArray(report.pairs)) throw new BlockError('The report cannot be read: it lists no pairs.');
  const parts = report.objects.length;
  report.pairs.forEach((pair, i) => {
    if (!isIndex(pair.a, parts) || !isIndex(pair.b, parts) || !kVerdicts.includes(pair.verdict)) {
      throw new BlockError(`The report cannot be read: its pair ${i} names no two parts of it, or no verdict.`);
    }
  });
  for (const key of ['missing', 'warnings'] as const)
    report[key] = (Array.isArray(report[key]) ? report[key] : []).map(String);
  report.resolved = (report.resolved ?? []).filter((r) => r.a && r.b && kVerdicts.includes(r.verdict));
  return report;
}

export function readScene(parts: number): SceneBlock {
  const scene = blockJson('scene', '3D scene') as unknown as SceneBlock;
  if (!Array.isArray(scene.meshes) || !Array.isArray(scene.objects)) {
    throw new BlockError('The 3D scene cannot be read: it lists no meshes or no objects.');
  }
  if (scene.objects.length !== parts) {
    throw new BlockError(
      `The 3D scene has ${scene.objects.length} objects, but the report has ${parts} parts: they do not belong together.`,
    );
  }
  const groups = scene.groups ?? [];
  const isKnown = (group: number | undefined, size: number) => group === undefined || isIndex(group, size);
  const isGroup = (group: { name: string; parent?: number } | null, i: number) =>
    typeof group?.name === 'string' && isKnown(group.parent, i);
  if (!Array.isArray(groups) || !groups.every(isGroup)) {
    throw new BlockError('The 3D scene cannot be read: a group of it has no name, or its parent does not come before it.');
  }
  scene.objects.forEach((object, i) => {
    if (object.mesh !== -1 && !(isIndex(object.mesh, scene.meshes.length) && areNumbers(object.pose, 12))) {
      throw new BlockError(`The 3D scene cannot be read: its object ${i} has no mesh or no pose.`);
    }
    if (!isKnown(object.group, groups.length)) {
      throw new BlockError(`The 3D scene cannot be read: its object ${i} is in no group of it.`);
    }
  });
  return scene;
}

export const readGeometryText = (): string => blockText('geometry', '3D geometry').trim();
