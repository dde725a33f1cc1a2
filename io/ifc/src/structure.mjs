// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Where products belong: in storeys, assemblies and so on, up to the project.
import { referenceOf, referencesOf, textOf } from './model.mjs';

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
  }

  // The element in whose opening the product is, and what that is a part of.
  hostsOf(product) {
    const host = this.#hosts.get(this.#hosts.get(product));
    if (!host) return [];
    const own = this.wholesOf(product);
    return [host, ...this.wholesOf(host).filter((whole) => !own.includes(whole))];
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

  nameOf(product) {
    return textOf(this.#model.attributes(product)[2]) || this.#model.classOf(product);
  }
}

// Whether placements relative to each other end at the world.
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
        known = this.#known.get(at);
        break;
      }
      this.#known.set(at, false); // met again before the way has ended, it is a loop
      way.push(at);
    }
    for (const at of way) this.#known.set(at, known);
    return known;
  }
}
