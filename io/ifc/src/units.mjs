// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The units that an IFC file's coordinates and angles are in.
import { enumOf, numberOf, referenceOf, referencesOf } from './model.mjs';

// IfcSIPrefix, as powers of ten.
const kPrefixes = {
  EXA: 18,
  PETA: 15,
  TERA: 12,
  GIGA: 9,
  MEGA: 6,
  KILO: 3,
  HECTO: 2,
  DECA: 1,
  DECI: -1,
  CENTI: -2,
  MILLI: -3,
  MICRO: -6,
  NANO: -9,
  PICO: -12,
  FEMTO: -15,
  ATTO: -18,
};
// A unit may be converted to one that is converted again; more steps than these are a loop.
const kMostSteps = 8;

// How many of SI's unit `name`, such as METRE, are in a unit of this type, such as LENGTHUNIT; NaN if its line does not say.
function inBaseUnits(model, line, type, name, steps = kMostSteps) {
  if (!line || steps === 0) return NaN;
  const attributes = model.attributes(line);
  const kind = model.classOf(line);
  if (kind === 'IfcSIUnit') {
    const words = attributes.map(enumOf);
    if (words.at(-1) !== name) return NaN;
    // The prefix stands after the type; a quotient, for 10 ** -3 is not the double nearest to a thousandth.
    const power = kPrefixes[words[words.indexOf(type) + 1]] ?? 0;
    return power < 0 ? 1 / 10 ** -power : 10 ** power;
  }
  if (kind !== 'IfcConversionBasedUnit' && kind !== 'IfcConversionBasedUnitWithOffset') return NaN;
  const [value, unit] = model.attributes(referenceOf(attributes[3]) ?? 0);
  return numberOf(value) * inBaseUnits(model, referenceOf(unit), type, name, steps - 1);
}

// That of the file's unit of this type; undefined if the file does not say.
function fileUnit(model, type, name) {
  const projects = model.ofClass('IFCPROJECT').map((line) => referenceOf(model.attributes(line)[8]));
  const assignments = projects.filter(Boolean).concat(model.ofClass('IFCUNITASSIGNMENT'));
  for (const assignment of assignments) {
    for (const unit of referencesOf(model.attributes(assignment)[0])) {
      if (!model.attributes(unit).some((value) => enumOf(value) === type)) continue;
      const size = inBaseUnits(model, unit, type, name);
      if (Number.isFinite(size) && size > 0) return size;
    }
  }
  return undefined;
}

// Metres in the file's unit of length; undefined if the file does not say.
export const metresInLength = (model) => fileUnit(model, 'LENGTHUNIT', 'METRE');
// Radians in the file's unit of plane angle.
export const radiansInAngle = (model) => fileUnit(model, 'PLANEANGLEUNIT', 'RADIAN') ?? 1;
