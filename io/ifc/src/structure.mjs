// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Where products belong: in storeys, assemblies and so on, up to the project.
import { numberOf, referenceOf, referencesOf, textOf } from './model.mjs';

// Relationships, with the places of the whole and of its parts.
const kRelationships = [
  ['IFCRELAGGREGATES', 4, 5],
  ['IFCRELNESTS', 4, 5],
  ['IFCRELCONTAINEDINSPATIALSTRUCTURE', 5, 4],
];

export class Structure {
  #model;
  #wholes = new Map();
  #withParts = new Set();
  // Of what fills an opening its opening, and of that the element that it is cut out of.
  #hosts = new Map();
  // Of elements what is added to their bodies.
  #projections = new Map();

  constructor(model) {
    this.#model = model;
    for (const [name, whole, parts] of kRelationships) {
      for (const line of model.ofClass(name)) {
        const attributes = model.attributes(line);
        const owner = referenceOf(attributes[whole]);
        if (!owner) continue;
        this.#withParts.add(owner);
        for (const part of referencesOf(attributes[parts])) if (!this.#wholes.has(part)) this.#wholes.set(part, owner);
      }
    }
    for (const line of model.ofClass('IFCRELVOIDSELEMENT', 'IFCRELFILLSELEMENT')) {
      const [, , , , host, part] = model.attributes(line).map(referenceOf);
      if (host && part) this.#hosts.set(part, host);
    }
    for (const line of model.ofClass('IFCRELPROJECTSELEMENT')) {
      const [element, projection] = model.attributes(line).slice(4, 6).map(referenceOf);
      if (projection) this.#projections.set(element, [...this.projectionsOf(element), projection]);
    }
  }

  // The element in whose opening the product is, and what that is a part of.
  hostsOf(product) {
    const host = this.#hosts.get(this.#hosts.get(product));
    if (!host) return [];
    const own = this.wholesOf(product);
    return [host, ...this.wholesOf(host).filter((whole) => !own.includes(whole))];
  }

  projectionsOf(element) {
    return this.#projections.get(element) ?? [];
  }

  hasParts(product) {
    return this.#withParts.has(product);
  }

  // What the product is in, the innermost first, without the project.
  wholesOf(product) {
    const wholes = [];
    const seen = new Set([product]);
    for (let at = this.#wholes.get(product); at && !seen.has(at); at = this.#wholes.get(at)) {
      if (this.#model.classOf(at) === 'IfcProject') break;
      seen.add(at);
      wholes.push(at);
    }
    return wholes;
  }

  // The name of the storey that the product is in; '' of others.
  storeyOf(product) {
    const storey = this.wholesOf(product).find((whole) => this.#model.classOf(whole) === 'IfcBuildingStorey');
    return storey ? this.nameOf(storey) : '';
  }

  nameOf(product) {
    return textOf(this.#model.attributes(product)[2]) || this.#model.classOf(product);
  }
}

// Placements relative to each other: whether they end at the world, and where. Those on a grid do not: web-ifc takes them for
// the origin.
export class Placements {
  #model;
  #known = new Map();

  constructor(model) {
    this.#model = model;
  }

  isKnown(placement) {
    const way = [];
    let known = true;
    for (let at = placement; at; at = referenceOf(this.#model.attributes(at)[0])) {
      if (this.#known.has(at)) {
        known &&= this.#known.get(at);
        break;
      }
      this.#known.set(at, false); // met again before the way has ended, it is a loop
      way.push(at);
      known &&= this.#model.classOf(at) !== 'IfcGridPlacement';
    }
    for (const at of way) this.#known.set(at, known);
    return known;
  }

  #hasNumbers(line, name) {
    const list = line && this.#model.classOf(line) === name ? this.#model.attributes(line)[0] : undefined;
    return Array.isArray(list) && list.length >= 2 && list.every((value) => Number.isFinite(numberOf(value)));
  }

  // Whether the placement and all that it is relative to are local ones, with points and directions that the file has. web-ifc
  // takes others for the origin, and complains of each once alone.
  #isLocal(placement) {
    for (let at = placement; at; ) {
      const [parent, position] = this.#model.attributes(at);
      const axes = referenceOf(position);
      if (this.#model.classOf(at) !== 'IfcLocalPlacement' || !axes) return false;
      if (!/^IfcAxis2Placement[23]D$/.test(this.#model.classOf(axes))) return false;
      const [location, ...directions] = this.#model.attributes(axes);
      if (!this.#hasNumbers(referenceOf(location), 'IfcCartesianPoint')) return false;
      if (!directions.every((axis) => !axis || this.#hasNumbers(referenceOf(axis), 'IfcDirection'))) return false;
      at = referenceOf(parent);
    }
    return true;
  }

  // The 16 numbers of the matrix of a local placement, column after column, to the file's axes; undefined where it is not known
  // or of another kind.
  matrixOf(placement) {
    if (!placement) return [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
    if (!this.isKnown(placement) || !this.#isLocal(placement)) return undefined;
    const matrix = this.#model.placementMatrix(placement);
    return matrix.every(Number.isFinite) ? matrix : undefined;
  }
}
