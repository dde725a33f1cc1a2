// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// The axes of the building's grids, where they stand.
import { curvePoints } from './curves.mjs';
import * as frames from './frames.mjs';
import { referenceOf, referencesOf, textOf } from './model.mjs';
import { radiansInAngle } from './units.mjs';

// An arc strays from its chords by a ten-thousandth of its radius.
const kChords = 240;
const kEndlessMetres = 10_000;
// Of a grid: far more than buildings have. Who reads the stream crosses all of them with each other.
const kMostAxes = 500;
const kMostPoints = 20_000;
const kMostPointsOfAll = 200_000;

// A grid's axes as { tag, family, points } in the file's axes and unit, family 0 to 2 for U, V and W; or the rest of a sentence
// on why they are not known.
function axesOf(model, grid, placements, options) {
  const attributes = model.attributes(grid);
  const lines = attributes.slice(7, 10).flatMap((list, family) => referencesOf(list).map((line) => ({ line, family })));
  if (lines.length > kMostAxes) return `it has ${lines.length} axes, more than ${kMostAxes}`;
  const place = placements.matrixOf(referenceOf(attributes[5]));
  if (!place) return 'its placement is on another grid or an alignment, or a line of it is missing or broken';
  const axes = [];
  for (const { line, family } of lines) {
    const [tag, curve] = model.attributes(line);
    const flat = curvePoints(model, referenceOf(curve), options);
    if (!(flat?.length >= 2 && flat.flat().every(Number.isFinite))) {
      const kind = model.classOf(referenceOf(curve) ?? 0) || 'nothing';
      return `its axis '${textOf(tag)}' is a curve that is not read (${kind}); export the axes as lines and arcs`;
    }
    const points = flat.flatMap(([x, y]) => [0, 1, 2].map((k) => place[k] * x + place[4 + k] * y + place[12 + k]));
    axes.push({ tag: textOf(tag), family, points });
  }
  return axes;
}

// Writes all grids but those of which some axis is not known, since the next one to it would be named in its place.
// Returns the circles that axes are on.
export function writeGrids(model, structure, placements, metres) {
  const options = { chords: kChords, radians: radiansInAngle(model), endless: kEndlessMetres / (metres ?? 1), circles: new Set() };
  let left = kMostPointsOfAll;
  for (const grid of model.ofClass('IFCGRID')) {
    const name = structure.nameOf(grid);
    const most = Math.min(kMostPoints, left);
    const own = { ...options, left: most };
    let axes;
    try {
      axes = axesOf(model, grid, placements, own);
    } catch {
      axes = 'a line of it is broken';
    }
    left -= most - Math.max(own.left, 0);
    if (own.left < 0) {
      axes =
        most < kMostPoints
          ? `it and the grids before it have more than ${kMostPointsOfAll} points`
          : `its axes have more than ${kMostPoints} points`;
    }
    if (Array.isArray(axes)) frames.grid(name, structure.storeyOf(grid), axes);
    else frames.warning(`Clashes are not named by the axes of the grid '${name}': ${axes}.`);
  }
  return options.circles;
}
