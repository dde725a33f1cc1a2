// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
//
// Writes the records of io/import_stream.hpp, which says what they hold, to standard output.
import { writeSync } from 'node:fs';

const kNone = 0xffffffff;
const kStandardOutput = 1;

function writeAll(bytes) {
  for (let done = 0; done < bytes.length;) done += writeSync(kStandardOutput, bytes, done);
}

function u32(value) {
  const bytes = Buffer.alloc(4);
  bytes.writeUInt32LE(value);
  return bytes;
}

function u64(value) {
  const bytes = Buffer.alloc(8);
  bytes.writeBigUInt64LE(BigInt(value));
  return bytes;
}

const doubles = (values) => Buffer.from(Float64Array.from(values).buffer);

function text(value) {
  const length = Buffer.byteLength(value, 'utf8');
  const bytes = Buffer.allocUnsafe(4 + length);
  bytes.writeUInt32LE(length);
  bytes.write(value, 4, 'utf8');
  return bytes;
}

const kMostWaiting = 2 ** 20;
let waiting = [];
let waitingBytes = 0;

function flush() {
  writeAll(Buffer.concat(waiting));
  waiting = [];
  waitingBytes = 0;
}

function record(letter, ...fields) {
  for (const field of [Buffer.from(letter), ...fields]) {
    waiting.push(field);
    waitingBytes += field.length;
  }
  if (waitingBytes >= kMostWaiting) flush();
}

export const begin = () => record('impinge6');
export function end() {
  record('Z');
  flush();
}
export function error(message) {
  record('E', text(message));
  flush();
}
export const warning = (message) => record('W', text(message));
export const missing = (message) => record('X', text(message));

// How many metres one of the file's units has.
export const unit = (metres) => record('L', doubles([metres]));
export const exactPlaces = () => record('D');
export const group = (name, parent) => record('G', text(name), u32(parent ?? kNone));
export const property = (name, value) => record('P', text(name), text(value));
export const incomplete = (words) => record('I', text(words));

// Of a Float64Array and a Uint32Array, which nobody writes to afterwards.
export function mesh(xyz, triangles) {
  const bytes = (array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength);
  record('M', u64(xyz.length / 3), u64(triangles.length / 3), bytes(xyz), bytes(triangles));
}

export function object({ name, path, product, mesh, group, world }) {
  record('O', text(name), text(path), text(product), u32(mesh), u32(kNone), u32(group ?? kNone), doubles(world));
}

// Of axes as { tag, family, points }.
export function grid(name, storey, axes) {
  record('R', text(name), text(storey), u32(axes.length));
  for (const { tag, family, points } of axes)
    record('', text(tag), u32(family), u64(points.length / 3), doubles(points));
}
