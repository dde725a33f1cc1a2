// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Flat curves of lines and arcs, as points [x, y]. Whoever calls says how many chords a circle becomes.
import { numberOf, referenceOf, referencesOf } from './model.mjs';

// A curve may be made of others, and these of others again; more steps than these are a loop.
const kDeepest = 8;
// So that a quarter circle, rounded, is not one chord more.
const kSlack = 1e-6;
const kTurn = 2 * Math.PI;

// A frame in the plane: its origin, and the cosine and sine of its first axis.
function frameOf(model, position) {
  if (!position) return [0, 0, 1, 0];
  const [location, axis] = model.attributes(position);
  const [ox, oy] = location ? pointOf(model, location) : [0, 0];
  const [ax, ay] = axis ? pointOf(model, axis) : [1, 0];
  const length = Math.hypot(ax, ay) || 1;
  return [ox, oy, ax / length, ay / length];
}

// Where an IfcAxis2Placement2D puts the points.
export function placed(model, position, points) {
  if (!position) return points;
  const [ox, oy, c, s] = frameOf(model, position);
  return points.map(([x, y]) => [ox + c * x - s * y, oy + s * x + c * y]);
}

// The points of an arc about (x, y), from one angle on, with its ends.
function arc(x, y, radius, first, angle, chords) {
  const count = Math.max(1, Math.ceil((Math.abs(angle) * chords) / kTurn - kSlack));
  return Array.from({ length: count + 1 }, (_, k) => {
    const at = first + (angle * k) / count;
    return [x + radius * Math.cos(at), y + radius * Math.sin(at)];
  });
}

// The chords of an arc from a point to another by one between them.
function arcPoints([a, b, c], chords) {
  const [bx, by, cx, cy] = [b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]];
  const twice = 2 * (bx * cy - by * cx);
  if (twice === 0) return [a, c];
  const [bb, cc] = [bx * bx + by * by, cx * cx + cy * cy];
  const [x, y] = [(cy * bb - by * cc) / twice, (bx * cc - cx * bb) / twice];
  const first = Math.atan2(-y, -x);
  let angle = Math.atan2(cy - y, cx - x) - first;
  if (angle * twice <= 0) angle += Math.sign(twice) * kTurn;
  return [a, ...arc(a[0] + x, a[1] + y, Math.hypot(x, y), first, angle, chords).slice(1, -1), c];
}

// The first numbers of a line's first list; NaN where the line has none.
function pointOf(model, value) {
  const list = model.attributes(referenceOf(value) ?? 0)[0];
  return [0, 1].map((k) => numberOf(Array.isArray(list) ? list[k] : undefined));
}

// Points of an IfcLine, each given as [x, y] or by a parameter.
function linePoints(model, [origin, vector], ends) {
  const start = pointOf(model, origin);
  const [orientation, magnitude] = model.attributes(referenceOf(vector) ?? 0);
  const direction = pointOf(model, orientation);
  const unit = numberOf(magnitude) / Math.hypot(...direction);
  return ends.map((end) => (Array.isArray(end) ? end : start.map((at, k) => at + end * unit * direction[k])));
}

// Points of an IfcCircle from one end to the other, which are given likewise; the whole circle where they are the same.
function circlePoints(model, line, ends, isForward, { chords, radians, circles }) {
  const [placement, radius] = model.attributes(line);
  const position = referenceOf(placement);
  circles?.add(line);
  if (!position || model.classOf(position) !== 'IfcAxis2Placement2D') return undefined;
  const [x, y, c, s] = frameOf(model, position);
  const [first, last] = ends.map((end) =>
    Array.isArray(end) ? Math.atan2(end[1] - y, end[0] - x) : Math.atan2(s, c) + end * radians,
  );
  const way = isForward ? 1 : -1;
  const angle = (((way * (last - first)) % kTurn) + kTurn) % kTurn || kTurn;
  const points = arc(x, y, numberOf(radius), first, way * angle, chords);
  if (angle === kTurn) points[points.length - 1] = points[0];
  return points;
}

function trimmedPoints(model, [basis, trim1, trim2, sense], options) {
  const line = referenceOf(basis);
  const ends = [trim1, trim2].map((trim) => {
    const values = Array.isArray(trim) ? trim : [];
    const point = values.find(referenceOf);
    return point ? pointOf(model, point) : numberOf(values[0]);
  });
  if (!line) return undefined;
  if (model.classOf(line) === 'IfcLine') return linePoints(model, model.attributes(line), ends);
  if (model.classOf(line) !== 'IfcCircle') return undefined;
  return circlePoints(model, line, ends, sense?.value !== false, options);
}

function partOf(model, line, options, steps) {
  const attributes = model.attributes(line);
  const kind = model.classOf(line);
  if (kind === 'IfcPolyline') return [attributes[0] ?? []].flat().map((point) => pointOf(model, point));
  if (kind === 'IfcIndexedPolyCurve') {
    const list = model.attributes(referenceOf(attributes[0]))[0].map((point) => point.slice(0, 2).map(numberOf));
    if (!attributes[1]) return list;
    return attributes[1].flatMap((segment) => {
      const points = [segment.value].flat().map((index) => list[numberOf(index) - 1]);
      return segment.typecode === model.codeOf('IFCARCINDEX') ? arcPoints(points, options.chords) : points;
    });
  }
  if (kind === 'IfcTrimmedCurve') return trimmedPoints(model, attributes, options);
  if (kind === 'IfcLine' && options.endless) {
    const far = options.endless / numberOf(model.attributes(referenceOf(attributes[1]) ?? 0)[1]);
    return linePoints(model, attributes, [-far, far]);
  }
  if (kind === 'IfcCircle') return circlePoints(model, line, [0, 0], true, options);
  if (kind === 'IfcCompositeCurveSegment') {
    const points = curvePoints(model, referenceOf(attributes[2]), options, steps - 1);
    return attributes[1]?.value === false ? points?.reverse() : points;
  }
  if (kind !== 'IfcCompositeCurve') return undefined;
  const parts = [];
  for (const segment of referencesOf(attributes[0])) {
    const part = curvePoints(model, segment, options, steps - 1);
    if (!part) return undefined;
    parts.push(part);
  }
  return parts.flat();
}

// The points of a curve of lines and arcs; undefined of other curves and of those with too many points. `options`: how many
// chords a circle becomes, how many radians an angle of the file has, how far a line goes that has no ends (without this one
// it is another curve), a set that circles are added to, and `left`, how many points may yet be made: curves that share their
// segments can be exponentially larger than the file. It is counted down, by composite curves and segments too, below 0
// where it is not enough.
export function curvePoints(model, line, options, steps = kDeepest) {
  if (!line || steps === 0 || options.left < 0) return undefined;
  const isLeaf = !model.classOf(line).startsWith('IfcCompositeCurve');
  if (!isLeaf) --options.left;
  const points = partOf(model, line, options, steps);
  if (isLeaf) options.left -= points?.length ?? 0;
  return options.left < 0 ? undefined : points;
}
