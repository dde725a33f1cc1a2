// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Lines that web-ifc 0.0.78 draws wrongly are written anew before it draws them.
import { kChords, kEnum, kReal, kReference, numberOf, referenceOf, referencesOf, textOf } from './model.mjs';

const kSolidsOfProfiles = [
  'IFCEXTRUDEDAREASOLID',
  'IFCEXTRUDEDAREASOLIDTAPERED',
  'IFCREVOLVEDAREASOLID',
  'IFCREVOLVEDAREASOLIDTAPERED',
  'IFCFIXEDREFERENCESWEPTAREASOLID',
  'IFCSURFACECURVESWEPTAREASOLID',
];

const reference = (line) => ({ type: kReference, value: line });

// Z, of which web-ifc draws three quarters: about the middle of the web, the lower flange towards x.
function outlineOfZ(attributes) {
  const [depth, width, web, flange] = attributes.slice(3, 7).map(numberOf);
  const [x, y, t] = [width - web / 2, depth / 2, web / 2];
  return [
    [-t, -y],
    [x, -y],
    [x, flange - y],
    [t, flange - y],
    [t, y],
    [-x, y],
    [-x, y - flange],
    [-t, y - flange],
  ];
}

// An I with unequal flanges, which web-ifc does not draw: about the middle of its bounding box.
function outlineOfAsymmetricI(attributes) {
  const [width, depth, web, flange] = attributes.slice(3, 7).map(numberOf);
  const top = numberOf(attributes[8]);
  const topFlange = attributes[9] ? numberOf(attributes[9]) : flange;
  const [x, y, t, u] = [width / 2, depth / 2, web / 2, top / 2];
  const right = [
    [x, -y],
    [x, flange - y],
    [t, flange - y],
    [t, y - topFlange],
    [u, y - topFlange],
    [u, y],
  ];
  return [...right, ...right.map(([px, py]) => [-px, py]).reverse()];
}

// A rectangle with round corners, which web-ifc draws sharp.
function outlineOfRoundedRectangle(attributes) {
  const [width, height, radius] = attributes.slice(3, 6).map(numberOf);
  const [x, y] = [width / 2 - radius, height / 2 - radius];
  const points = [];
  for (let chord = 0; chord < kChords + 4; ++chord) {
    const quarter = Math.floor(chord / (kChords / 4 + 1)); // each has the points at both of its ends
    const angle = ((chord - quarter) * 2 * Math.PI) / kChords;
    const [sx, sy] = [quarter === 0 || quarter === 3 ? x : -x, quarter < 2 ? y : -y];
    points.push([sx + radius * Math.cos(angle), sy + radius * Math.sin(angle)]);
  }
  return points;
}

const kOutlines = [
  ['IFCZSHAPEPROFILEDEF', outlineOfZ],
  ['IFCASYMMETRICISHAPEPROFILEDEF', outlineOfAsymmetricI],
  ['IFCROUNDEDRECTANGLEPROFILEDEF', outlineOfRoundedRectangle],
];

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

// Profiles that web-ifc draws wrongly or not at all become outlines of lines.
export function mendProfiles(model) {
  writePlaces(model);
  const made = new Map();
  for (const [name, outline] of kOutlines) {
    for (const line of model.ofClass(name)) {
      const attributes = model.attributes(line);
      const points = placed(model, referenceOf(attributes[2]), outline(attributes));
      if (!points.flat().every(Number.isFinite)) continue;
      const corners = points.map((p) =>
        model.append('IFCCARTESIANPOINT', [p.map((value) => ({ type: kReal, value }))]),
      );
      const curve = model.append('IFCPOLYLINE', [[...corners, corners[0]].map(reference)]);
      made.set(
        line,
        model.append('IFCARBITRARYCLOSEDPROFILEDEF', [{ type: kEnum, value: 'AREA' }, null, reference(curve)]),
      );
    }
  }
  if (made.size > 0) {
    for (const solid of model.ofClass(...kSolidsOfProfiles)) {
      const attributes = model.attributes(solid);
      const profile = made.get(referenceOf(attributes[0]));
      if (profile) model.rewrite(solid, [reference(profile), ...attributes.slice(1)]);
    }
  }
  // A C with a radius within would be flat.
  for (const line of model.ofClass('IFCCSHAPEPROFILEDEF')) {
    const attributes = model.attributes(line);
    if (attributes[7]) model.rewrite(line, [...attributes.slice(0, 7), null, ...attributes.slice(8)]);
  }
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
