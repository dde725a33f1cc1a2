// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Outlines of the standard's parametrised profiles, as points [x, y] about their own origins, counterclockwise.
import { kChords, numberOf } from './model.mjs';

// Fillets are small, and there are many in a steel structure: a chord lies within 0.9 % of their radius.
const kFilletChords = 24;
// Two tangent lengths on one edge may overlap by rounding, as those of a slot's round ends do.
const kSlack = 1e-9;

const orZero = (value) => (numberOf(value) > 0 ? numberOf(value) : 0);

// A polygon of corners [x, y, radius], the rounded ones by arcs; undefined where arcs do not fit on the edges.
function rounded(corners, chords) {
  const tangent = [];
  const turns = corners.map(([x, y, radius], i) => {
    const before = corners.at(i - 1);
    const after = corners[(i + 1) % corners.length];
    const [ax, ay, bx, by] = [x - before[0], y - before[1], after[0] - x, after[1] - y];
    const turn = Math.atan2(ax * by - ay * bx, ax * bx + ay * by);
    tangent.push(radius ? radius * Math.tan(Math.abs(turn) / 2) : 0);
    return turn;
  });
  const points = [];
  for (let i = 0; i < corners.length; ++i) {
    const [x, y, radius] = corners[i];
    const before = corners.at(i - 1);
    const length = Math.hypot(x - before[0], y - before[1]);
    if (!(tangent[i] + tangent.at(i - 1) <= length * (1 + kSlack))) return undefined;
    if (!radius || !turns[i]) {
      points.push([x, y]);
      continue;
    }
    // From the arc's first point on, along chords that each turn by a step.
    const count = Math.max(1, Math.round((Math.abs(turns[i]) * chords) / (2 * Math.PI)));
    const step = turns[i] / count;
    const chord = 2 * radius * Math.sin(Math.abs(step) / 2);
    let direction = Math.atan2(y - before[1], x - before[0]);
    let at = [x - tangent[i] * Math.cos(direction), y - tangent[i] * Math.sin(direction)];
    points.push(at);
    direction += step / 2;
    for (let k = 0; k < count; ++k, direction += step) {
      at = [at[0] + chord * Math.cos(direction), at[1] + chord * Math.sin(direction)];
      points.push(at);
    }
  }
  return points;
}

const mirrored = (right) => [...right, ...right.map(([x, y, radius]) => [-x, y, radius]).reverse()];

// About the middle of the web, the lower flange towards x.
function cornersOfZ(attributes) {
  const [depth, width, web, flange] = attributes.slice(3, 7).map(numberOf);
  const [fillet, edge] = attributes.slice(7, 9).map(orZero);
  const [x, y, t] = [width - web / 2, depth / 2, web / 2];
  const half = [
    [-t, -y, 0],
    [x, -y, 0],
    [x, flange - y, edge],
    [t, flange - y, fillet],
  ];
  return [...half, ...half.map(([px, py, radius]) => [-px, -py, radius])];
}

// The standard does not say where the thickness of a sloped flange is measured: here, as for T and in tables of rolled
// sections (EN 10024), at a quarter of the width.
function cornersOfI(depth, web, bottom, top) {
  const [y, t] = [depth / 2, web / 2];
  const thickness = ({ width, flange, slope }, x) => flange + (width / 4 - x) * Math.tan(slope);
  return mirrored([
    [bottom.width / 2, -y, 0],
    [bottom.width / 2, thickness(bottom, bottom.width / 2) - y, bottom.edge],
    [t, thickness(bottom, t) - y, bottom.fillet],
    [t, y - thickness(top, t), top.fillet],
    [top.width / 2, y - thickness(top, top.width / 2), top.edge],
    [top.width / 2, y, 0],
  ]);
}

function cornersOfSymmetricI(attributes, radians) {
  const [width, depth, web, flange] = attributes.slice(3, 7).map(numberOf);
  const [fillet, edge, slope] = [7, 8, 9].map((place) => orZero(attributes[place]));
  const both = { width, flange, fillet, edge, slope: slope * radians };
  return cornersOfI(depth, web, both, both);
}

// IFC2x3 ends with the centre of gravity in the place of the bottom's edge radius.
const kAttributesOfAsymmetricI = 15;

function cornersOfAsymmetricI(attributes, radians) {
  const [width, depth, web, flange] = attributes.slice(3, 7).map(numberOf);
  const soft = attributes.length < kAttributesOfAsymmetricI ? [0, 0, 0, 0] : attributes.slice(11, 15).map(orZero);
  const bottom = { width, flange, fillet: orZero(attributes[7]), edge: soft[0], slope: soft[1] * radians };
  const top = {
    width: numberOf(attributes[8]),
    flange: attributes[9] ? numberOf(attributes[9]) : flange,
    fillet: orZero(attributes[10]),
    edge: soft[2],
    slope: soft[3] * radians,
  };
  return cornersOfI(depth, web, bottom, top);
}

// Thicknesses of sloped legs and flanges are those in their middle, of a T's at a quarter of its width.
function cornersOfL(attributes, radians) {
  const [depth, , thickness] = attributes.slice(3, 6).map(numberOf);
  const width = attributes[4] ? numberOf(attributes[4]) : depth;
  const [fillet, edge, slope] = attributes.slice(6, 9).map(orZero);
  const [x, y, m] = [width / 2, depth / 2, Math.tan(slope * radians)];
  const [right, upper] = [thickness - x, thickness - y];
  // Where the inner faces Y = upper - m X and X = right - m Y meet.
  const inner = [(right - m * upper) / (1 - m * m), (upper - m * right) / (1 - m * m)];
  return [
    [-x, -y, 0],
    [x, -y, 0],
    [x, upper - m * x, edge],
    [...inner, fillet],
    [right - m * y, y, edge],
    [-x, y, 0],
  ];
}

function cornersOfU(attributes, radians) {
  const [depth, width, web, flange] = attributes.slice(3, 7).map(numberOf);
  const [fillet, edge, slope] = attributes.slice(7, 10).map(orZero);
  const [x, y, m] = [width / 2, depth / 2, Math.tan(slope * radians)];
  const lower = [
    [-x, -y, 0],
    [x, -y, 0],
    [x, flange - y - m * x, edge],
    [web - x, flange - y - m * (web - x), fillet],
  ];
  return [...lower, ...lower.map(([px, py, radius]) => [px, -py, radius]).reverse()];
}

function cornersOfT(attributes, radians) {
  const [depth, width, web, flange] = attributes.slice(3, 7).map(numberOf);
  const [fillet, edge, webEdge, webSlope, flangeSlope] = attributes.slice(7, 12).map(orZero);
  const [x, y] = [width / 2, depth / 2];
  const [m, n] = [Math.tan(webSlope * radians), Math.tan(flangeSlope * radians)];
  // The web's face X = web / 2 + m Y meets the flange's Y = y - flange + n (X - x / 2).
  const innerY = (y - flange + n * (web / 2 - x / 2)) / (1 - n * m);
  return mirrored([
    [web / 2 - m * y, -y, webEdge],
    [web / 2 + m * innerY, innerY, fillet],
    [x, y - flange + (n * x) / 2, edge],
    [x, y, 0],
  ]);
}

function cornersOfC(attributes) {
  const [depth, width, wall, girth] = attributes.slice(3, 7).map(numberOf);
  const inner = orZero(attributes[7]);
  const outer = inner > 0 ? inner + wall : 0;
  const [x, y] = [width / 2, depth / 2];
  const lower = [
    [-x, -y, outer],
    [x, -y, outer],
    [x, girth - y, 0],
    [x - wall, girth - y, 0],
    [x - wall, wall - y, inner],
    [wall - x, wall - y, inner],
  ];
  return [...lower, ...lower.map(([px, py, radius]) => [px, -py, radius]).reverse()];
}

const rectangle = (x, y, radius) => [
  [x, -y, radius],
  [x, y, radius],
  [-x, y, radius],
  [-x, -y, radius],
];

function cornersOfRoundedRectangle(attributes) {
  const [width, height, radius] = attributes.slice(3, 6).map(numberOf);
  return rectangle(width / 2, height / 2, radius);
}

// Those that web-ifc 0.0.78 draws wrongly: all of `always`, the others where the attributes from `soft` on, radii and slopes,
// are not zero.
export const kParametrised = [
  { name: 'IFCZSHAPEPROFILEDEF', corners: cornersOfZ, chords: kFilletChords, always: true },
  { name: 'IFCASYMMETRICISHAPEPROFILEDEF', corners: cornersOfAsymmetricI, chords: kFilletChords, always: true },
  { name: 'IFCROUNDEDRECTANGLEPROFILEDEF', corners: cornersOfRoundedRectangle, chords: kChords, always: true },
  { name: 'IFCISHAPEPROFILEDEF', corners: cornersOfSymmetricI, chords: kFilletChords, soft: [7, 10] },
  { name: 'IFCLSHAPEPROFILEDEF', corners: cornersOfL, chords: kFilletChords, soft: [6, 9] },
  { name: 'IFCUSHAPEPROFILEDEF', corners: cornersOfU, chords: kFilletChords, soft: [7, 10] },
  { name: 'IFCTSHAPEPROFILEDEF', corners: cornersOfT, chords: kFilletChords, soft: [7, 12] },
  { name: 'IFCCSHAPEPROFILEDEF', corners: cornersOfC, chords: kFilletChords, soft: [7, 8] },
];

// The outline of a profile of `kind`, by its line's attributes and the radians in the file's unit of angle: undefined where
// web-ifc draws it rightly or numbers are missing. Where its radii do not fit, its corners are sharp.
export function outlineOf(kind, attributes, radians) {
  const isSoft = kind.always || attributes.slice(...kind.soft).some((value) => orZero(value) > 0);
  if (!isSoft) return undefined;
  const corners = kind.corners(attributes, radians);
  if (!corners.flat().every(Number.isFinite)) return undefined;
  const points = rounded(corners, kind.chords);
  return { points: points ?? corners.map(([x, y]) => [x, y]), fits: points !== undefined };
}

const cross = ([ax, ay], [bx, by]) => ax * by - ay * bx;

// The outlines of a wall of this thickness along a line of points, its joints mitred: one, or for a line that comes back to
// its beginning an outer and an inner. undefined where the line is no line, or turns back on itself.
export function alongCentreLine(line, thickness) {
  const points = line.filter((p, i) => i === 0 || Math.hypot(p[0] - line[i - 1][0], p[1] - line[i - 1][1]) > 0);
  const isClosed = points.length > 3 && points[0].every((value, k) => value === points.at(-1)[k]);
  if (isClosed) points.pop();
  if (points.length < 2 || !(thickness > 0)) return undefined;
  const edges = points.map((p, i) => {
    const next = points[(i + 1) % points.length];
    const length = Math.hypot(next[0] - p[0], next[1] - p[1]);
    return [(next[0] - p[0]) / length, (next[1] - p[1]) / length];
  });
  const half = thickness / 2;
  const left = [];
  const right = [];
  for (let i = 0; i < points.length; ++i) {
    const isEnd = !isClosed && (i === 0 || i === points.length - 1);
    const before = isEnd && i === 0 ? edges[0] : edges.at(i - 1);
    const after = isEnd ? before : edges[i];
    const cosine = before[0] * after[0] + before[1] * after[1];
    // A mitre longer than four thicknesses is none.
    if (cosine < -0.875) return undefined;
    const [mx, my] = [-(before[1] + after[1]) / (1 + cosine), (before[0] + after[0]) / (1 + cosine)];
    left.push([points[i][0] + half * mx, points[i][1] + half * my]);
    right.push([points[i][0] - half * mx, points[i][1] - half * my]);
  }
  if (!isClosed) return [[...right, ...left.reverse()]];
  const area = (loop) => loop.reduce((sum, p, i) => sum + cross(p, loop[(i + 1) % loop.length]), 0);
  return Math.abs(area(left)) > Math.abs(area(right)) ? [left, right] : [right, left];
}
