// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The unit of length that an IFC file's coordinates are in.
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

// Metres in a unit of length, NaN if its line does not say.
function metresIn(model, line, steps = kMostSteps) {
  if (!line || steps === 0) return NaN;
  const attributes = model.attributes(line);
  const kind = model.classOf(line);
  if (kind === 'IfcSIUnit') {
    const words = attributes.map(enumOf);
    if (words.at(-1) !== 'METRE') return NaN;
    // The prefix stands after the kind of unit; a quotient, for 10 ** -3 is not the double nearest to a thousandth.
    const power = kPrefixes[words[words.indexOf('LENGTHUNIT') + 1]] ?? 0;
    return power < 0 ? 1 / 10 ** -power : 10 ** power;
  }
  if (kind !== 'IfcConversionBasedUnit' && kind !== 'IfcConversionBasedUnitWithOffset') return NaN;
  const [value, unit] = model.attributes(referenceOf(attributes[3]) ?? 0);
  return numberOf(value) * metresIn(model, referenceOf(unit), steps - 1);
}

// Metres in the file's unit of length; undefined if the file does not say.
export function unitInMetres(model) {
  const projects = model.ofClass('IFCPROJECT').map((line) => referenceOf(model.attributes(line)[8]));
  const assignments = projects.filter(Boolean).concat(model.ofClass('IFCUNITASSIGNMENT'));
  for (const assignment of assignments) {
    for (const unit of referencesOf(model.attributes(assignment)[0])) {
      if (!model.attributes(unit).some((value) => enumOf(value) === 'LENGTHUNIT')) continue;
      const metres = metresIn(model, unit);
      if (Number.isFinite(metres) && metres > 0) return metres;
    }
  }
  return undefined;
}
