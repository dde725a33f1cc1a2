// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Lines that web-ifc 0.0.78 draws wrongly are written anew before it draws them.
import { kChords, kEnum, kReal, kReference, numberOf, referenceOf, referencesOf, textOf } from './model.mjs';
import { alongCentreLine, kParametrised, outlineOf } from './profiles.mjs';
import { radiansInAngle } from './units.mjs';

const kSolidsOfProfiles = [
  'IFCEXTRUDEDAREASOLID',
  'IFCEXTRUDEDAREASOLIDTAPERED',
  'IFCREVOLVEDAREASOLID',
  'IFCREVOLVEDAREASOLIDTAPERED',
  'IFCFIXEDREFERENCESWEPTAREASOLID',
  'IFCSURFACECURVESWEPTAREASOLID',
];
// Lines that speak of profiles, and in which of their places.
const kUsersOfProfiles = [
  ...kSolidsOfProfiles.map((name) => [name, [0]]),
  ['IFCEXTRUDEDAREASOLIDTAPERED', [4]],
  ['IFCREVOLVEDAREASOLIDTAPERED', [4]],
  ['IFCCOMPOSITEPROFILEDEF', [2]],
  ['IFCDERIVEDPROFILEDEF', [2]],
];
const kBooleans = ['IFCBOOLEANRESULT', 'IFCBOOLEANCLIPPINGRESULT'];
// A curve may be made of others, and these of others again; more steps than these are a loop.
const kDeepestCurve = 8;
// web-ifc takes 2 s for 300, one within the other, and 14 s for 1,200.
const kDeepestDifference = 2000;
// Of one representation; they take some 600 MB.
const kMostMapped = 100_000;
// So that a quarter circle, rounded, is not one chord more.
const kSlack = 1e-6;

const reference = (line) => ({ type: kReference, value: line });
const real = (value) => ({ type: kReal, value });

// Where an IfcAxis2Placement2D puts the points.
function placed(model, position, points) {
  if (!position) return points;
  const [location, axis] = model.attributes(position);
  const numbers = (line) => (line ? (model.attributes(line)[0] ?? []).map(numberOf) : undefined);
  const [ox, oy] = numbers(referenceOf(location)) ?? [0, 0];
  const [ax, ay] = numbers(referenceOf(axis)) ?? [1, 0];
  const length = Math.hypot(ax, ay) || 1;
  const [c, s] = [ax / length, ay / length];
  return points.map(([x, y]) => [ox + c * x - s * y, oy + s * x + c * y]);
}

// The chords of an arc from a point to another by one between them.
function arcPoints([a, b, c]) {
  const [bx, by, cx, cy] = [b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]];
  const twice = 2 * (bx * cy - by * cx);
  if (twice === 0) return [a, c];
  const [bb, cc] = [bx * bx + by * by, cx * cx + cy * cy];
  const [x, y] = [(cy * bb - by * cc) / twice, (bx * cc - cx * bb) / twice];
  const [radius, first] = [Math.hypot(x, y), Math.atan2(-y, -x)];
  let angle = Math.atan2(cy - y, cx - x) - first;
  if (angle * twice <= 0) angle += Math.sign(twice) * 2 * Math.PI;
  const count = Math.max(1, Math.ceil((Math.abs(angle) * kChords) / (2 * Math.PI) - kSlack));
  const on = (k) => {
    const at = first + (angle * k) / count;
    return [a[0] + x + radius * Math.cos(at), a[1] + y + radius * Math.sin(at)];
  };
  return [a, ...Array.from({ length: count - 1 }, (_, k) => on(k + 1)), c];
}

// The points of a flat curve of lines and arcs; undefined of other curves.
function curvePoints(model, line, steps = kDeepestCurve) {
  if (!line || steps === 0) return undefined;
  const attributes = model.attributes(line);
  const kind = model.classOf(line);
  if (kind === 'IfcPolyline') {
    return referencesOf(attributes[0]).map((point) => model.attributes(point)[0].slice(0, 2).map(numberOf));
  }
  if (kind === 'IfcIndexedPolyCurve') {
    const list = model.attributes(referenceOf(attributes[0]))[0].map((point) => point.slice(0, 2).map(numberOf));
    if (!attributes[1]) return list;
    return attributes[1].flatMap((segment) => {
      const points = [segment.value].flat().map((index) => list[numberOf(index) - 1]);
      return segment.typecode === model.codeOf('IFCARCINDEX') ? arcPoints(points) : points;
    });
  }
  if (kind !== 'IfcCompositeCurve' && kind !== 'IfcCompositeCurveSegment') return undefined;
  if (kind === 'IfcCompositeCurveSegment') {
    const points = curvePoints(model, referenceOf(attributes[2]), steps - 1);
    return attributes[1]?.value === 'F' ? points?.reverse() : points;
  }
  const parts = referencesOf(attributes[0]).map((segment) => curvePoints(model, segment, steps - 1));
  return parts.every(Boolean) ? parts.flat() : undefined;
}

const kPlacedProfiles = [
  'ASYMMETRICISHAPE',
  'CIRCLE',
  'CIRCLEHOLLOW',
  'CSHAPE',
  'ELLIPSE',
  'ISHAPE',
  'LSHAPE',
  'RECTANGLE',
  'RECTANGLEHOLLOW',
  'ROUNDEDRECTANGLE',
  'TRAPEZIUM',
  'TSHAPE',
  'USHAPE',
  'ZSHAPE',
].map((name) => `IFC${name}PROFILEDEF`);

// Places that IFC4 allows to be left out are written, since web-ifc complains of them.
function writePlaces(model) {
  const zero = (...values) => model.append('IFCCARTESIANPOINT', [values.map((value) => ({ type: kReal, value }))]);
  const fill = (names, place, make) => {
    const without = model.ofClass(...names).filter((line) => !model.attributes(line)[place]);
    if (without.length === 0) return;
    const made = reference(make());
    for (const line of without) {
      const attributes = model.attributes(line);
      attributes[place] = made;
      model.rewrite(line, attributes);
    }
  };
  fill(kPlacedProfiles, 2, () => model.append('IFCAXIS2PLACEMENT2D', [reference(zero(0, 0)), null]));
  fill(kSolidsOfProfiles, 1, () => model.append('IFCAXIS2PLACEMENT3D', [reference(zero(0, 0, 0)), null, null]));
}

// A profile of one outline, or of an outer and an inner.
function appendProfile(model, outlines) {
  const [outer, ...inner] = outlines.map((points) => {
    const list = model.append('IFCCARTESIANPOINTLIST2D', [[...points, points[0]].map((point) => point.map(real))]);
    return reference(model.append('IFCINDEXEDPOLYCURVE', [reference(list), null, null]));
  });
  const area = { type: kEnum, value: 'AREA' };
  return inner.length === 0
    ? model.append('IFCARBITRARYCLOSEDPROFILEDEF', [area, null, outer])
    : model.append('IFCARBITRARYPROFILEDEFWITHVOIDS', [area, null, outer, inner]);
}

// The profiles that stand for others, by these; adds to `reasons` why those that are not as the file says are not.
function replacements(model, reasons) {
  const made = new Map();
  const radians = radiansInAngle(model);
  for (const kind of kParametrised) {
    for (const line of model.ofClass(kind.name)) {
      const attributes = model.attributes(line);
      const outline = outlineOf(kind, attributes, radians);
      if (!outline) continue;
      made.set(line, appendProfile(model, [placed(model, referenceOf(attributes[2]), outline.points)]));
      if (!outline.fits) reasons.set(line, 'the radii of its profile do not fit, and its corners are drawn sharp');
    }
  }
  for (const line of model.ofClass('IFCCENTERLINEPROFILEDEF')) {
    const [, , curve, thickness] = model.attributes(line);
    const points = curvePoints(model, referenceOf(curve));
    const outlines = points?.flat().every(Number.isFinite) && alongCentreLine(points, numberOf(thickness));
    if (outlines) made.set(line, appendProfile(model, outlines));
  }
  // web-ifc has derived profiles, but none of this kind of them.
  const mirrored = model.ofClass('IFCMIRROREDPROFILEDEF');
  if (mirrored.length > 0) {
    const direction = (...values) => reference(model.append('IFCDIRECTION', [values.map(real)]));
    const origin = reference(model.append('IFCCARTESIANPOINT', [[0, 0].map(real)]));
    const axes = [direction(-1, 0), direction(0, 1), origin, real(1)];
    const flip = model.append('IFCCARTESIANTRANSFORMATIONOPERATOR2D', axes);
    for (const line of mirrored) {
      const [type, name, parent] = model.attributes(line);
      made.set(line, model.append('IFCDERIVEDPROFILEDEF', [type, name, parent, reference(flip), null]));
    }
  }
  return made;
}

// Solids and their differences, by what they are made of, that have a reason to be called incomplete.
function spread(model, reasons) {
  if (reasons.size === 0) return;
  for (const [name, places] of kUsersOfProfiles) {
    for (const line of model.ofClass(name)) {
      const profiles = places.flatMap((place) => referencesOf(model.attributes(line)[place]));
      const profile = profiles.find((one) => reasons.has(one));
      if (profile) reasons.set(line, reasons.get(profile));
    }
  }
  // A difference may stand before those that it is made of.
  const differences = model.ofClass(...kBooleans);
  for (let size = -1; size !== reasons.size; ) {
    size = reasons.size;
    for (const line of differences) {
      const operand = model.attributes(line).map(referenceOf).find((part) => reasons.has(part));
      if (operand && !reasons.has(line)) reasons.set(line, reasons.get(operand));
    }
  }
}

// Visits lines that are made of each other, what a line is made of before it: `visit` is told of the line and of what it
// visited for those; `loop` of a line and one that it is made of and that is made of it.
function eachAfterItsParts(lines, partsOf, visit, loop) {
  const found = new Map(); // undefined of those on the way
  for (const first of lines) {
    const way = found.has(first) ? [] : [{ line: first, parts: partsOf(first), at: 0 }];
    if (way.length > 0) found.set(first, undefined);
    while (way.length > 0) {
      const top = way.at(-1);
      const part = top.parts[top.at++];
      if (part === undefined) {
        found.set(top.line, visit(top.line, top.parts, found));
        way.pop();
      } else if (!found.has(part)) {
        found.set(part, undefined);
        way.push({ line: part, parts: partsOf(part), at: 0 });
      } else if (found.get(part) === undefined) {
        loop(top.line, part);
      }
    }
  }
}

// A difference that is made of itself, or of too many one within the other, loses the operand that leads there: web-ifc would
// take minutes or gigabytes. Adds to `reasons` those of too many.
function breakLoops(model, reasons) {
  const differences = new Set(model.ofClass(...kBooleans));
  const operandsOf = (line) => model.attributes(line).map(referenceOf).filter((part) => differences.has(part));
  const cut = (line, operand) =>
    model.rewrite(line, model.attributes(line).map((value) => (referenceOf(value) === operand ? null : value)));
  const depthOf = (line, operands, depths) => {
    const depth = 1 + Math.max(0, ...operands.map((one) => depths.get(one) ?? 0));
    if (depth > kDeepestDifference) {
      for (const operand of operands) cut(line, operand);
      reasons.set(line, `${depth} differences within each other; more than ${kDeepestDifference} are not drawn`);
    }
    return depth;
  };
  eachAfterItsParts(differences, operandsOf, depthOf, cut);
}

// Mapped items may show mapped items, and these again: twice as many shapes a step. Representations that show too many so lose
// their items, before web-ifc runs out of memory. Adds to `reasons` the representations that are not drawn in full.
function limitMapped(model, reasons) {
  const mapped = new Set(model.ofClass('IFCMAPPEDITEM'));
  const shownBy = new Map();
  for (const map of model.ofClass('IFCREPRESENTATIONMAP')) shownBy.set(map, referenceOf(model.attributes(map)[1]));
  const itemsOf = (shown) => referencesOf(model.attributes(shown)[3]);
  const shown = new Set([...shownBy.values()].filter(Boolean));
  const mapping = new Set([...shown].filter((one) => itemsOf(one).some((item) => mapped.has(item))));
  if (mapping.size === 0 && reasons.size === 0) return;
  const partsOf = (one) => {
    const items = itemsOf(one).filter((item) => mapped.has(item));
    return items.map((item) => shownBy.get(referenceOf(model.attributes(item)[0]))).filter(Boolean);
  };
  const count = (one, parts, counts) => {
    const items = itemsOf(one);
    const cause = [...items, ...parts].find((line) => reasons.has(line));
    if (cause) reasons.set(one, reasons.get(cause));
    // What shows nothing counts too, as web-ifc visits it each time.
    const sum = parts.reduce((total, part) => total + (counts.get(part) ?? 1), 0);
    const shapes = Math.max(1, items.length - parts.length + sum);
    if (shapes <= kMostMapped || !parts.some((part) => mapping.has(part))) return shapes;
    model.rewrite(one, model.attributes(one).map((value, at) => (at === 3 ? [] : value)));
    reasons.set(
      one,
      `its mapped items of mapped items show more than ${kMostMapped} shapes; export them as parts of their own`,
    );
    return 1;
  };
  const shapes = model.ofClass('IFCPRODUCTDEFINITIONSHAPE');
  const ofProducts = shapes.flatMap((shape) => referencesOf(model.attributes(shape)[2]));
  eachAfterItsParts([...shown, ...ofProducts], partsOf, count, () => {});
}

// Elements with openings that are not drawn in full.
function spreadToHosts(model, reasons) {
  if (reasons.size === 0) return;
  for (const line of model.ofClass('IFCRELVOIDSELEMENT')) {
    const [host, opening] = model.attributes(line).slice(4, 6).map(referenceOf);
    const shape = opening && referenceOf(model.attributes(opening)[6]);
    const cause = shape && referencesOf(model.attributes(shape)[2]).find((one) => reasons.has(one));
    if (host && cause) reasons.set(host, `an opening of it is not drawn in full: ${reasons.get(cause)}`);
  }
}

// Profiles that web-ifc draws wrongly or not at all become outlines of lines. Returns why shapes are incomplete, by the lines
// of their solids, representations and products.
export function mendProfiles(model) {
  writePlaces(model);
  const reasons = new Map();
  breakLoops(model, reasons);
  limitMapped(model, reasons);
  spreadToHosts(model, reasons);
  const made = replacements(model, reasons);
  spread(model, reasons);
  if (made.size > 0) {
    const standIn = (value) => {
      if (Array.isArray(value)) return value.map(standIn);
      const other = made.get(referenceOf(value));
      return other ? reference(other) : value;
    };
    for (const [name, places] of kUsersOfProfiles) {
      for (const line of model.ofClass(name)) {
        const attributes = model.attributes(line);
        const isUser = places.some((place) => referencesOf(attributes[place]).some((profile) => made.has(profile)));
        const changed = attributes.map((value, at) => (places.includes(at) ? standIn(value) : value));
        if (isUser) model.rewrite(line, changed);
      }
    }
  }
  return reasons;
}

// Of a product's representations only the bodies are drawn: no axis, outline, box or room that it is to have free.
const kNoBodies =
  /^(Annotation|Axis|Body-?Fallback|Box|Clearance|CoG|FootPrint|Lighting|Plan|Profile|Reference|SurveyPoints)$/i;

export function keepBodies(model, shape) {
  const attributes = model.attributes(shape);
  const all = referencesOf(attributes[2]);
  const bodies = all.filter((line) => !kNoBodies.test(textOf(model.attributes(line)[1])));
  if (bodies.length > 0 && bodies.length < all.length) {
    model.rewrite(shape, [attributes[0], attributes[1], bodies.map(reference)]);
  }
  return bodies.length > 0;
}
