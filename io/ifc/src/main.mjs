// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// node import-ifc.cjs FILE [property-sets]
//
// Reads an IFC file by web-ifc and writes its products to standard output, as io/import_stream.hpp describes; those of
// property sets only if asked for. It is started by impinge-import, which sets the limits.
import { setFlagsFromString } from 'node:v8';
import { FileProblem, readFile } from './file.mjs';
import * as frames from './frames.mjs';
import { writeGrids } from './grids.mjs';
import { kChords, Model, numberOf, referenceOf, referencesOf, textOf } from './model.mjs';
import { keepBodies, mendProfiles } from './mend.mjs';
import { Properties } from './properties.mjs';
import { shapeOf } from './shapes.mjs';
import { Placements, Structure } from './structure.mjs';
import { metresInLength } from './units.mjs';

const kOldestNode = 18;
// Names in a sentence about several products.
const kMostNamed = 20;

const kNoArea = 'a face without an area is left out';
const kGaps = 'its advanced B-rep is drawn with gaps between faces';
// What helps where web-ifc's drawing fails.
const kAdvice = "Export these elements' geometry as triangles or flat faces (tessellation, faceted B-rep).";
const kUndrawn = /incomplete shape|web-ifc/;

// Products that nobody can bump into: what is cut away, rooms, lines of drawings, of analysis and of axes.
const kNoParts =
  /^Ifc(Opening|VoidingFeature|ProjectionElement|Space|SpatialZone|ExternalSpatial|VirtualElement|Annotation|Grid|Structural|Alignment|Referent|Linear|PositioningElement|DistributionPort|Port$)/;
// What products are in, and what that is called among their properties.
const kPlaces = { IfcSpace: 'space', IfcBuildingStorey: 'storey', IfcBuilding: 'building', IfcSite: 'site' };
// Those that hold others, and need no shape of their own.
const kSpatial = /^Ifc(Site|Building$|BuildingStorey|Facility|Bridge|Road|Railway|MarineFacility|MarinePart|Tunnel)/;
const placeOf = (name) => kPlaces[name] ?? (kSpatial.test(name) ? 'facility' : 'assembly');

// Products of which the same is to be said.
class Remarks {
  #kinds = new Map();

  add(kind, label) {
    if (!this.#kinds.has(kind)) this.#kinds.set(kind, []);
    this.#kinds.get(kind).push(label);
  }

  #sentences() {
    return [...this.#kinds].map(([kind, labels]) => {
      const named = labels.slice(0, kMostNamed).join(', ');
      const more = labels.length > kMostNamed ? ` and ${labels.length - kMostNamed} more` : '';
      return `${kind}, ${labels.length}: ${named}${more}`;
    });
  }

  first() {
    return this.#sentences()[0];
  }

  write() {
    for (const sentence of this.#sentences())
      frames.missing(`Products ${sentence}.${kUndrawn.test(sentence.split(':')[0]) ? ` ${kAdvice}` : ''}`);
  }
}

// Writes the groups that products hang under, each once and its parents first.
class Groups {
  #structure;
  #numbers = new Map();

  constructor(structure) {
    this.#structure = structure;
  }

  numberFor(wholes) {
    let number;
    for (const whole of [...wholes].reverse()) {
      if (!this.#numbers.has(whole)) {
        frames.group(this.#structure.nameOf(whole), number);
        this.#numbers.set(whole, this.#numbers.size);
      }
      number = this.#numbers.get(whole);
    }
    return number;
  }
}

class Importer {
  #model;
  #structure;
  #properties;
  #placements;
  #groups;
  #remarks = new Remarks();
  #meshes = new Map();
  #written = 0;
  #keys = new Set();
  // Geometries, representations and products, and what web-ifc said when it made them, or what keeps it from making them rightly.
  #incomplete;

  constructor(model, withSets, incomplete) {
    this.#model = model;
    this.#incomplete = incomplete;
    this.#structure = new Structure(model);
    this.#properties = new Properties(model, withSets);
    this.#placements = new Placements(model);
    this.#groups = new Groups(this.#structure);
  }

  // What web-ifc gives of a product; undefined where it traps.
  async #bodiesOf(product, label) {
    this.#model.takeSaid();
    try {
      return this.#model.bodiesOf(product);
    } catch (trap) {
      this.#remarks.add(
        'that web-ifc cannot draw, and that are left out',
        `${label} (it stopped: ${trap.message ?? 'an exception'})`,
      );
      await this.#model.reopen();
      return undefined;
    }
  }

  // What is known of the product and its representations, or else what web-ifc said while the bodies were made, then or for an
  // earlier product that shows them too.
  #complaintAbout(product, shape, bodies) {
    const said = this.#model.takeSaid().find((line) => /error|warn/i.test(line));
    const plain = said && this.#plain(said);
    if (plain) for (const { geometry } of bodies) this.#incomplete.set(geometry, plain);
    const known = (lines) => lines.map((line) => this.#incomplete.get(line)).find(Boolean);
    const representations = referencesOf(this.#model.attributes(shape)[2]);
    return known([product, ...representations]) ?? plain ?? known(bodies.map(({ geometry }) => geometry));
  }

  // The bodies of a product and of what projects from it, and what keeps them from being complete; undefined where web-ifc
  // traps on the product itself.
  async #drawn(line, shape, label) {
    const bodies = await this.#bodiesOf(line, label);
    if (!bodies) return undefined;
    let complaint = this.#complaintAbout(line, shape, bodies);
    for (const projection of this.#structure.projectionsOf(line)) {
      const attributes = this.#model.attributes(projection);
      const added = referenceOf(attributes[6]);
      const isKnown = added && this.#placements.isKnown(referenceOf(attributes[5])) && keepBodies(this.#model, added);
      const more = isKnown ? await this.#bodiesOf(projection, `what projects from ${label}`) : undefined;
      complaint ??= more ? this.#complaintAbout(projection, added, more) : 'what projects from it is not drawn';
      if (isKnown && !more) {
        // The module that the bodies were made in is gone.
        keepBodies(this.#model, shape);
        const own = await this.#bodiesOf(line, label);
        return own && { bodies: own, complaint };
      }
      bodies.push(...(more ?? []));
    }
    return { bodies, complaint };
  }

  // In the words of who wrote the file: web-ifc names a line that it does not draw by its number.
  #plain(said) {
    const words = said.replace(/^(\[[^\]]*\])+ */, '');
    const absent = /Invalid ExpressID (\d+)/.exec(words);
    if (absent) return `the file lacks its line #${absent[1]}`;
    if (words.startsWith('No basis found')) return kNoArea;
    const [, what] = /^un(?:expected|supported) (.*?) type\b/i.exec(words) ?? [];
    if (!what) return `web-ifc says '${words}'`;
    if (what === 'token') return 'a line of its geometry lacks what it refers to, or leads back to itself';
    const line = Number(/\d+$/.exec(words)?.[0]);
    const name = line > 0 ? this.#model.classOf(line) : '';
    this.#model.takeSaid();
    return `web-ifc does not draw its ${/^Ifc/.test(name) ? name : `kind of ${what}`}`;
  }

  #keyOf(name, title, guid) {
    const base = `${name}_${title}_${guid}`;
    let key = base;
    for (let number = 2; this.#keys.has(key); ++number) key = `${base} (${number})`;
    this.#keys.add(key);
    return key;
  }

  async write({ line, name }) {
    if (kNoParts.test(name)) return;
    const attributes = this.#model.attributes(line);
    const title = textOf(attributes[2]);
    const guid = textOf(attributes[0]);
    const label = `'${title || name}' (${name} ${guid})`;
    if (!referenceOf(attributes[6])) {
      if (!kSpatial.test(name) && !this.#structure.hasParts(line)) this.#remarks.add('without a shape', label);
      return;
    }
    if (!this.#placements.isKnown(referenceOf(attributes[5]))) {
      this.#remarks.add('whose placement is on a grid or depends on itself, and that are left out', label);
      return;
    }
    if (!keepBodies(this.#model, referenceOf(attributes[6]))) {
      this.#remarks.add('without a body', label);
      return;
    }
    const made = await this.#drawn(line, referenceOf(attributes[6]), label);
    if (!made) return;
    const { bodies } = made;
    let { complaint } = made;
    const lost = [];
    if (bodies.length === 0) {
      this.#remarks.add('without a body that web-ifc can draw', complaint ? `${label} (${complaint})` : label);
      return;
    }
    const drawn = bodies.filter(({ matrix }) => matrix.every(Number.isFinite));
    if (drawn.length < bodies.length) {
      this.#remarks.add('with bodies in no finite place, which are left out', label);
      lost.push('a body is in no finite place');
    }
    if (drawn.length === 0) return;
    const mesh = this.#meshFor(drawn, label, lost);
    if (mesh.number === undefined) return;
    // Around a face without an area that is left out all others meet.
    if (complaint === kNoArea && mesh.isClosed) complaint = undefined;
    if (!complaint && mesh.hasGaps) complaint = kGaps;
    if (complaint) {
      this.#remarks.add('with an incomplete shape', `${label} (${complaint})`);
      lost.push(complaint);
    }
    this.#writeObject({ line, name, title, guid, attributes, ...mesh });
    if (lost.length > 0) frames.incomplete(lost.join('; '));
  }

  #meshFor(bodies, label, lost) {
    const shape = shapeOf(bodies, this.#model);
    if (!this.#meshes.has(shape.key)) {
      const { xyz, triangles, ...about } = shape.make();
      const number = triangles.length > 0 ? this.#written++ : undefined;
      if (number !== undefined) frames.mesh(xyz, triangles);
      this.#meshes.set(shape.key, { number, ...about });
    }
    const { number, problems, isClosed, hasGaps } = this.#meshes.get(shape.key);
    for (const problem of new Set(problems)) {
      this.#remarks.add(`with ${problem}, which is left out`, label);
      lost.push(`${problem} is left out`);
    }
    return { number, isClosed, hasGaps, world: shape.world };
  }

  #writeObject({ line, name, title, guid, attributes, number, world }) {
    const wholes = this.#structure.wholesOf(line);
    const names = [...wholes].reverse().map((whole) => this.#structure.nameOf(whole));
    frames.object({
      name: title || name,
      path: [...names, title || name].join('/'),
      product: this.#keyOf(name, title, guid),
      mesh: number,
      group: this.#groups.numberFor(wholes),
      world,
    });
    const properties = [
      ['class', name],
      ['GlobalId', guid],
      // Of elements and proxies alone.
      ['Tag', /^Ifc(Site|Building$|BuildingStorey)/.test(name) ? '' : textOf(attributes[7])],
      ['Description', textOf(attributes[3])],
      ['ObjectType', textOf(attributes[4])],
      ...wholes.map((whole) => [placeOf(this.#model.classOf(whole)), this.#structure.nameOf(whole)]),
      ...this.#structure.hostsOf(line).map((host) => ['host', this.#structure.nameOf(host)]),
      ...this.#properties.of(line, name, attributes),
    ];
    for (const [key, value] of properties) if (key && value) frames.property(key, value);
  }

  // Returns circles that nothing is drawn of. Errors: FileProblem, of a file with nothing to draw.
  finish(metres) {
    this.#remarks.write();
    if (this.#written > 0) return writeGrids(this.#model, this.#structure, this.#placements, metres);
    const about = this.#remarks.first();
    throw new FileProblem(
      about
        ? `no product has a shape that can be drawn: products ${about}; export the building with its elements' bodies`
        : 'the file holds no product that one could bump into; export the building with its elements',
    );
  }
}

// How far chords stray from the largest circle, in the file's unit.
function warnOfCurves(model, undrawn) {
  const radii = [];
  for (const [name, place] of [
    ['IFCCIRCLE', 1],
    ['IFCCIRCLEPROFILEDEF', 3],
    ['IFCCIRCLEHOLLOWPROFILEDEF', 3],
    ['IFCSWEPTDISKSOLID', 1],
  ]) {
    for (const line of model.ofClass(name)) if (!undrawn.has(line)) radii.push(numberOf(model.attributes(line)[place]));
  }
  const largest = radii.filter(Number.isFinite).reduce((a, b) => Math.max(a, b), 0);
  const splines = model.ofClass(
    'IFCBSPLINECURVEWITHKNOTS',
    'IFCRATIONALBSPLINECURVEWITHKNOTS',
    'IFCBSPLINESURFACEWITHKNOTS',
    'IFCRATIONALBSPLINESURFACEWITHKNOTS',
  );
  if (largest > 0) {
    const deviation = largest * (1 - Math.cos(Math.PI / kChords));
    frames.warning(
      `Circles are drawn by ${kChords} chords, which lie up to ${deviation.toPrecision(3)} within the largest, of radius ${Number(largest.toPrecision(6))}.`,
    );
  }
  if (splines.length > 0)
    frames.warning(
      `${splines.length} B-spline curves or surfaces are drawn by flat pieces; how far these stray is not known.`,
    );
}

function checkSchema(schema) {
  if (/^IFC(2X2|2X3|4)/i.test(schema)) return;
  if (!schema) throw new FileProblem('its header names no schema (FILE_SCHEMA); export it as IFC2x3, IFC4 or IFC4x3');
  const what = /^IFC/i.test(schema) ? 'another version of IFC' : 'not IFC, but STEP of another kind';
  throw new FileProblem(`its schema '${schema.slice(0, 80)}' is ${what}; export it as IFC2x3, IFC4 or IFC4x3`);
}

async function run(path, withSets) {
  let incomplete;
  const model = await Model.open(readFile(path), (opened) => {
    checkSchema(opened.schema());
    incomplete = mendProfiles(opened);
  });
  const metres = metresInLength(model);
  if (metres) frames.unit(metres);
  else frames.warning('The file does not say its unit of length.');
  frames.exactPlaces();
  const products = model.products();
  if (products.length === 0) throw new FileProblem('the file holds no product; export the building with its elements');
  const importer = new Importer(model, withSets, incomplete);
  for (const product of products) await importer.write(product);
  warnOfCurves(model, importer.finish(metres));
}

// V8 compiles each WebAssembly function once more, to faster code, when it has run so many bytes: by default so soon that
// a usual file waits longer for that than it gains. Where V8 knows no such setting, it says so and goes on.
setFlagsFromString('--wasm-tiering-budget=2000000000');
const major = Number(process.versions.node.split('.')[0]);
frames.begin();
if (major < kOldestNode) {
  frames.error(
    `Node.js ${kOldestNode} or newer is needed to read IFC, and this is ${process.versions.node}; install a newer one`,
  );
} else {
  run(process.argv[2], process.argv[3] === 'property-sets').then(
    () => frames.end(),
    (problem) => {
      const isKnown = problem instanceof FileProblem;
      frames.error(
        isKnown ? problem.message : `web-ifc cannot read the file (${problem?.message ?? problem}); export it again`,
      );
    },
  );
}
