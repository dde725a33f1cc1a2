// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// A model opened by web-ifc: its lines, by the places of their attributes, which are those of every schema from IFC2x3 on.
import { join } from 'node:path';
import createModule from 'web-ifc-module';
import { FileProblem } from './file.mjs';

// Kinds of values in raw lines.
export const kText = 1;
export const kEnum = 3;
export const kReal = 4;
export const kReference = 5;
const kInteger = 10;

const kWarnings = 3;
// A circle becomes one chord less: 48.
export const kChords = 48;
const kSettings = {
  COORDINATE_TO_ORIGIN: false,
  CIRCLE_SEGMENTS: kChords + 1,
  TAPE_SIZE: 2 ** 26,
  MEMORY_LIMIT: 2 ** 31,
  LINEWRITER_BUFFER: 10000,
  TOLERANCE_PLANE_INTERSECTION: 1e-4,
  TOLERANCE_PLANE_DEVIATION: 1e-4,
  TOLERANCE_BACK_DEVIATION_DISTANCE: 1e-4,
  TOLERANCE_INSIDE_OUTSIDE_PERIMETER: 1e-10,
  TOLERANCE_SCALAR_EQUALITY: 1e-4,
  PLANE_REFIT_ITERATIONS: 1,
  BOOLEAN_UNION_THRESHOLD: 150,
};

export const textOf = (value) => (value?.type === kText ? value.value.trim() : '');
export const enumOf = (value) => (value?.type === kEnum ? value.value : '');
export const referenceOf = (value) => (value?.type === kReference ? value.value : undefined);
export const numberOf = (value) => (value === null || value === undefined ? NaN : Number(value.value));
export const referencesOf = (list) =>
  (Array.isArray(list) ? list.map(referenceOf) : [referenceOf(list)]).filter(Boolean);

// A number is read under one name, and written under another.
function asWritten(value) {
  if (Array.isArray(value)) return value.map(asWritten);
  return value?.type === kReal || value?.type === kInteger
    ? { ...value, _internalValue: value.value, internalValue: value.value }
    : value;
}

export class Model {
  #bytes;
  #id;
  #said = [];
  #mend;

  // Opens the file's bytes; `mend` is called with the model, and again whenever it is opened anew. Errors: FileProblem.
  static async open(bytes, mend) {
    const model = new Model();
    model.#bytes = bytes;
    model.#mend = mend;
    await model.reopen();
    return model;
  }

  // A fresh module: after a trap nothing that the old one holds can be relied on.
  async reopen() {
    // What it prints is about the product in work; standard output is the stream's alone.
    const print = (line) => this.#said.push(line);
    this.wasm = await createModule({
      noInitialRun: true,
      locateFile: (name) => join(__dirname, name),
      print,
      printErr: print,
    });
    this.wasm.SetLogLevel(kWarnings);
    const bytes = this.#bytes;
    this.#id = this.wasm.OpenModel(kSettings, (to, offset, size) => {
      const part = bytes.subarray(offset, Math.min(offset + size, bytes.length));
      this.wasm.HEAPU8.set(part, to);
      return part.length;
    });
    if (this.#id < 0) throw new FileProblem('web-ifc cannot open the file; export it again');
    this.#mend(this);
  }

  // What was printed since the last call.
  takeSaid() {
    const said = this.#said;
    this.#said = [];
    return said;
  }

  schema() {
    const code = this.wasm.GetTypeCodeFromName('FILE_SCHEMA');
    return textOf(this.wasm.GetHeaderLine(this.#id, code)?.arguments?.[0]?.[0]);
  }

  // The number that raw values of this class, a name in capitals, have as their typecode.
  codeOf(name) {
    return this.wasm.GetTypeCodeFromName(name);
  }

  // The numbers of all lines whose class has this name in capitals.
  ofClass(...names) {
    const found = this.wasm.GetLineIDsWithType(
      this.#id,
      names.map((name) => this.codeOf(name)),
    );
    return Array.from({ length: found.size() }, (_, i) => found.get(i));
  }

  // The numbers of all products' lines, in the file's order, with their classes.
  products() {
    const all = this.wasm.GetAllLines(this.#id);
    const classes = new Map();
    const products = [];
    for (let i = 0; i < all.size(); ++i) {
      const line = all.get(i);
      const type = this.wasm.GetLineType(this.#id, line);
      // By its name of elements alone, but web-ifc means all products.
      if (!classes.has(type)) {
        classes.set(type, this.wasm.IsIfcElement(type) ? this.wasm.GetNameFromTypeCode(type) : '');
      }
      if (classes.get(type)) products.push({ line, name: classes.get(type) });
    }
    return products;
  }

  classOf(line) {
    return this.wasm.GetNameFromTypeCode(this.wasm.GetLineType(this.#id, line));
  }

  attributes(line) {
    return this.wasm.GetLines(this.#id, [line])[0]?.arguments ?? [];
  }

  #write(line, type, attributes) {
    this.wasm.WriteLine(this.#id, line, type, attributes.map(asWritten));
  }

  // Adds a line to the model; returns its number.
  append(name, attributes) {
    const line = this.wasm.GetMaxExpressID(this.#id) + 1;
    this.#write(line, this.codeOf(name), attributes);
    return line;
  }

  // Gives a line of the model other attributes.
  rewrite(line, attributes) {
    this.#write(line, this.wasm.GetLineType(this.#id, line), attributes);
  }

  // The bodies of a product: geometry's number, and a matrix, column after column, to the file's axes with Y up. Throws
  // where the WebAssembly traps.
  bodiesOf(product) {
    const flat = this.wasm.GetFlatMesh(this.#id, product, false);
    const bodies = [];
    for (let i = 0; i < flat.geometries.size(); ++i) {
      const { geometryExpressID, flatTransformation } = flat.geometries.get(i);
      bodies.push({ geometry: geometryExpressID, matrix: flatTransformation });
    }
    flat.delete?.();
    return bodies;
  }

  // That of an IfcLocalPlacement: 16 numbers, column after column, to the file's axes.
  placementMatrix(line) {
    return Array.from(this.wasm.GetWorldTransformMatrix(this.#id, line));
  }

  // Vertices of six floats, the normal behind the point, and corners of triangles.
  geometry(number) {
    const geometry = this.wasm.GetGeometry(this.#id, number);
    const vertices = this.wasm.HEAPF32.slice(
      geometry.GetVertexData() / 4,
      geometry.GetVertexData() / 4 + geometry.GetVertexDataSize(),
    );
    const corners = this.wasm.HEAPU32.slice(
      geometry.GetIndexData() / 4,
      geometry.GetIndexData() / 4 + geometry.GetIndexDataSize(),
    );
    geometry.delete();
    return { vertices, corners };
  }
}
