// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Lines that web-ifc 0.0.78 draws wrongly are written anew before it draws them.
import { curvePoints, placed } from './curves.mjs';
import { kChords, kEnum, kReal, kReference, numberOf, referenceOf, referencesOf, textOf } from './model.mjs';
import { alongCentreLine, kParametrised, outlineOf } from './profiles.mjs';
import { radiansInAngle } from './units.mjs';

// Of a centre line.
const kMostPoints = 100_000;
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
// And in which of their places operators have their axes.
const kOperators = ['2D', '3D'].flatMap((kind) => {
  const name = `IFCCARTESIANTRANSFORMATIONOPERATOR${kind}`;
  const places = kind === '2D' ? [0, 1] : [0, 1, 4];
  return [[name, places], [`${name}NONUNIFORM`, places]]; // prettier-ignore
});
const kBooleans = ['IFCBOOLEANRESULT', 'IFCBOOLEANCLIPPINGRESULT'];
// web-ifc takes 2 s for 300, one within the other, and 14 s for 1,200.
const kDeepestDifference = 2000;
// Of one representation; they take some 600 MB.
const kMostMapped = 100_000;

// Of lengths and cosines.
const kSlack = 1e-9;

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const kBase = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]; // prettier-ignore
const unit = (a) => a.map((one) => one / Math.hypot(...a));
// What is left of a vector without its part along a unit vector.
const without = (a, along) => a.map((one, k) => one - dot(a, along) * along[k]);
const reference = (line) => ({ type: kReference, value: line });
const real = (value) => ({ type: kReal, value });

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

// The axes that an operator's three, of which some may be left out, stand for: IfcBaseAxis of the standard. Where that leaves
// the second open, it is that of a right-handed system.
function baseAxes([x, y, z], isFlat) {
  if (isFlat) {
    const [c, s] = unit(x ?? [y[1], -y[0]]);
    const sign = y && c * y[1] - s * y[0] < 0 ? -1 : 1;
    return [[c, s], [-sign * s, sign * c]]; // prettier-ignore
  }
  const third = unit(z ?? kBase[2]);
  const isAlongX = Math.abs(third[0]) > 1 - kSlack;
  const first = unit(without(x ?? (isAlongX ? kBase[1] : kBase[0]), third));
  const second = without(without(y ?? kBase[1], third), first);
  return [first, Math.hypot(...second) > kSlack ? unit(second) : cross(third, first), third];
}

// Directions have no length, but web-ifc extrudes by theirs. And of operators it takes each axis alone: what it maps is
// sheared where they are not at right angles. Where both are as they should be, nothing is written.
function straighten(model) {
  const known = new Map();
  const ratiosOf = (line) => {
    if (line && !known.has(line)) {
      const list = model.attributes(line)[0];
      known.set(line, Array.isArray(list) ? list.map(numberOf) : []);
    }
    return known.get(line);
  };
  for (const solid of model.ofClass('IFCEXTRUDEDAREASOLID')) ratiosOf(referenceOf(model.attributes(solid)[2]));
  for (const [line, ratios] of known) {
    const length = Math.hypot(...ratios);
    if (length > 0 && Math.abs(length - 1) > kSlack) model.rewrite(line, [ratios.map((one) => real(one / length))]);
  }
  for (const [name, places] of kOperators) {
    for (const line of model.ofClass(name)) {
      const attributes = model.attributes(line);
      const given = places.map((place) => ratiosOf(referenceOf(attributes[place])));
      if (!given.some(Boolean)) continue;
      const meant = baseAxes(given, places.length === 2);
      const taken = given.map((axis, k) => (axis ? unit(axis) : kBase[k]));
      if (meant.every((axis, k) => axis.every((one, i) => !(Math.abs(one - taken[k][i]) > kSlack)))) continue;
      places.forEach((place, k) => {
        attributes[place] = reference(model.append('IFCDIRECTION', [meant[k].map(real)]));
      });
      model.rewrite(line, attributes);
    }
  }
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
    const points = curvePoints(model, referenceOf(curve), { chords: kChords, radians, left: kMostPoints });
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

// Elements with openings that are not drawn in full, and the parts that these are made of, out of which openings are cut as well.
function spreadToHosts(model, reasons) {
  if (reasons.size === 0) return;
  const causes = new Map();
  for (const line of model.ofClass('IFCRELVOIDSELEMENT')) {
    const [host, opening] = model.attributes(line).slice(4, 6).map(referenceOf);
    const shape = opening && referenceOf(model.attributes(opening)[6]);
    const cause = shape && referencesOf(model.attributes(shape)[2]).find((one) => reasons.has(one));
    if (host && cause) causes.set(host, reasons.get(cause));
  }
  if (causes.size === 0) return;
  const partsOf = new Map();
  for (const line of model.ofClass('IFCRELAGGREGATES')) {
    const attributes = model.attributes(line);
    const whole = referenceOf(attributes[4]);
    partsOf.set(whole, [...(partsOf.get(whole) ?? []), ...referencesOf(attributes[5])]);
  }
  for (const [host, cause] of causes) {
    const elements = new Set([host]);
    for (const element of elements) {
      if (!reasons.has(element)) reasons.set(element, `an opening of it is not drawn in full: ${cause}`);
      for (const part of partsOf.get(element) ?? []) elements.add(part);
    }
  }
}

// Profiles that web-ifc draws wrongly or not at all become outlines of lines. Returns why shapes are incomplete, by the lines
// of their solids, representations and products.
export function mendProfiles(model) {
  writePlaces(model);
  straighten(model);
  const reasons = new Map();
  breakLoops(model, reasons);
  const made = replacements(model, reasons);
  spread(model, reasons);
  limitMapped(model, reasons);
  spreadToHosts(model, reasons);
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
