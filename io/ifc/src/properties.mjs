// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// What a product is related to beside its place: its type, materials, classifications, layers, systems and groups, and the
// property sets of itself and of its type.
import { enumOf, referenceOf, referencesOf, textOf } from './model.mjs';

const kSystems = /^Ifc(System|BuildingSystem|BuiltSystem|DistributionSystem|DistributionCircuit|StructuralAnalysisModel)$/;
// Products of IFC2x3 with a PredefinedType; of others the first enumeration is another thing.
const kPredefined2x3 = /^Ifc(Slab|Covering|Railing|Footing|Pile|ElementAssembly|Tendon)$/;
// What stands before it.
const kFirstOfProduct = { IfcElementAssembly: 9 };
const kNotPredefined = /^Ifc(Proxy|Site|Building|BuildingStorey)$/;
// Material sets lead to their layers, profiles or constituents, and these to materials.
const kDeepest = 8;

// A value of a property as a text; undefined where there is none.
function valueText(value) {
  if (value?.value === undefined || value.value === null || referenceOf(value)) return undefined;
  return typeof value.value === 'boolean' ? String(value.value).toUpperCase() : String(value.value).trim();
}

export class Properties {
  #model;
  #known = new Map();
  #materials;
  #types;
  #groups;
  #classifications;
  #layers;
  #sets;
  #is2x3;
  // PredefinedTypes of types.
  #typesDefined = new Map();

  // Property sets are looked up only where they are asked for: they are most of many files.
  constructor(model, withSets) {
    this.#model = model;
    this.#types = this.#related(['IFCRELDEFINESBYTYPE'], 4, 5);
    this.#materials = this.#related(['IFCRELASSOCIATESMATERIAL'], 4, 5);
    this.#classifications = this.#related(['IFCRELASSOCIATESCLASSIFICATION'], 4, 5);
    this.#is2x3 = /^IFC2/i.test(model.schema());
    this.#groups = this.#related(['IFCRELASSIGNSTOGROUP', 'IFCRELASSIGNSTOGROUPBYFACTOR'], 4, 6);
    this.#layers = this.#related(['IFCPRESENTATIONLAYERASSIGNMENT', 'IFCPRESENTATIONLAYERWITHSTYLE'], 2);
    this.#sets = withSets ? this.#related(['IFCRELDEFINESBYPROPERTIES'], 4, 5) : undefined;
  }

  // For each line at the place `from` of these relationships those at the place `to`, or else the relationships.
  #related(names, from, to) {
    const found = new Map();
    for (const line of this.#model.ofClass(...names)) {
      const attributes = this.#model.attributes(line);
      const others = to === undefined ? [line] : referencesOf(attributes[to]);
      for (const part of referencesOf(attributes[from])) {
        if (!found.has(part)) found.set(part, []);
        found.get(part).push(...others);
      }
    }
    return found;
  }

  // What `make` finds in a line, found once; `loop` to whom it asks on the way.
  #once(line, make, loop) {
    if (!this.#known.has(line)) {
      this.#known.set(line, loop);
      this.#known.set(line, make(this.#model.attributes(line)));
    }
    return this.#known.get(line);
  }

  #nameOf(line) {
    return this.#once(line, (attributes) => textOf(attributes[2]));
  }

  // The names of the materials below a material, a list or a set of them.
  #materialsOf(line, steps = kDeepest) {
    const name = this.#model.classOf(line);
    if (steps === 0 || !name.startsWith('IfcMaterial')) return [];
    const make = (attributes) => {
      if (name === 'IfcMaterial') return [textOf(attributes[0])];
      const parts = new Set(attributes.flatMap(referencesOf));
      return [...new Set([...parts].flatMap((part) => this.#materialsOf(part, steps - 1)))];
    };
    return this.#once(line, make, []);
  }

  // The properties of a set, as names with the set's before them and values: single ones, and those of lists.
  #propertiesOf(set) {
    return this.#once(set, (attributes) => {
      if (this.#model.classOf(set) !== 'IfcPropertySet') return [];
      return referencesOf(attributes[4]).flatMap((line) => {
        if (!/^IfcProperty(Single|Enumerated|List)Value$/.test(this.#model.classOf(line))) return [];
        const [name, , values] = this.#model.attributes(line);
        const texts = (Array.isArray(values) ? values : [values]).map(valueText);
        return texts.filter(Boolean).map((text) => [`${textOf(attributes[2])}.${textOf(name)}`, text]);
      });
    });
  }

  #layersOf(shape) {
    if (this.#layers.size === 0) return [];
    const shown = referencesOf(this.#model.attributes(shape)[2]);
    const items = shown.flatMap((line) => referencesOf(this.#model.attributes(line)[3]));
    return [...shown, ...items].flatMap((line) => this.#layers.get(line) ?? []);
  }

  // The PredefinedType, which is the first enumeration from a place on: that of the type, or else of the product; what the
  // user defined is the text at another place. '' for none.
  #predefinedType(name, attributes, type) {
    const from = (values, place, own) => {
      const word = enumOf(values.slice(place).find((value) => enumOf(value).length > 1)); // no logical value
      return word === 'USERDEFINED' ? textOf(own) : word === 'NOTDEFINED' ? '' : word;
    };
    const isType = type && this.#model.classOf(type).endsWith('Type');
    if (isType && !this.#typesDefined.has(type)) {
      const values = this.#model.attributes(type);
      this.#typesDefined.set(type, from(values, 9, values[8]));
    }
    const ofType = this.#typesDefined.get(type) ?? '';
    if (ofType || kNotPredefined.test(name) || (this.#is2x3 && !kPredefined2x3.test(name))) return ofType;
    return from(attributes, kFirstOfProduct[name] ?? 8, attributes[4]);
  }

  // The identification and the name of a reference; the name of a system of classification.
  #classified(line) {
    return this.#once(line, (attributes) => {
      const places = this.#model.classOf(line) === 'IfcClassification' ? [3] : [1, 2];
      return places.map((place) => textOf(attributes[place]));
    });
  }

  // Names and values; a product in several systems, of several materials and so on has one for each.
  of(product, name, attributes) {
    const shape = referenceOf(attributes[6]);
    const type = this.#types.get(product)?.[0];
    const found = [];
    const add = (name, values) => {
      for (const value of new Set(values)) if (value) found.push([name, value]);
    };
    add('PredefinedType', [this.#predefinedType(name, attributes, type)]);
    add('type', type ? [this.#nameOf(type)] : []);
    const materials = this.#materials.get(product) ?? this.#materials.get(type) ?? [];
    add('material', materials.flatMap((line) => this.#materialsOf(line)));
    const references = [product, type].flatMap((line) => this.#classifications.get(line) ?? []);
    add('classification', references.flatMap((line) => this.#classified(line)));
    add('layer', this.#layersOf(shape).map((line) => this.#once(line, ([name]) => textOf(name))));
    const groups = this.#groups.get(product) ?? [];
    const isSystem = (line) => kSystems.test(this.#model.classOf(line));
    add('system', groups.filter(isSystem).map((line) => this.#nameOf(line)));
    add('group', groups.filter((line) => !isSystem(line)).map((line) => this.#nameOf(line)));
    if (!this.#sets) return found;
    const own = [...new Set(this.#sets.get(product))].flatMap((set) => this.#propertiesOf(set));
    const names = new Set(own.map(([name]) => name));
    const ofType = type ? referencesOf(this.#model.attributes(type)[5]).flatMap((set) => this.#propertiesOf(set)) : [];
    // A product says otherwise than its type.
    return [...found, ...own, ...ofType.filter(([name]) => !names.has(name))];
  }
}
